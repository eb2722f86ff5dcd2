! Copyright Isotach contributors. SPDX-License-Identifier: BSD-3-Clause
! The UMAT in many increments against set A of the reference numbers, which were computed outside the project
! (implicit Radau, rtol 1e-11).
!
! Tolerances: rows of ten digits to a relative 1e-9, ten times the tolerance of a substep; rows of fewer digits to
! half a unit of their last one. The number of increments must not matter: each is integrated to the same tolerance.
program set_a_rows
  use material_point
  use checks
  implicit none

  real(dp), parameter :: rate = 1e-6_dp, day = 86400
  real(dp) :: props(n_props)
  type(point_t) :: point
  integer :: i

  props = set_a()

  point = run(props, principal(100.0_dp, 100.0_dp, 100.0_dp), principal(rate, rate, rate) / 3, 5e3_dp, 50)
  call expect_relative('isotropic compression to a volumetric strain of 0.005: p', mean_pressure(point), &
                       101.1943521_dp, 1e-9_dp)

  point = run(props, principal(100.0_dp, 100.0_dp, 100.0_dp), [(0.0_dp, i=1, 6)], 1e6_dp, 100)
  call expect_relative('isotropic relaxation over 1e6 s: p', mean_pressure(point), 68.87465481_dp, 1e-9_dp)
  call expect_near('the same: void ratio stays', point%statev(1), 1.5_dp, 0.0_dp)

  point = run(props, principal(100.0_dp, 65.0_dp, 65.0_dp), principal(rate, 0.0_dp, 0.0_dp), 2e5_dp, 1000)
  call expect_relative('oedometric compression: axial stress', -point%stress(1), 806.17380535_dp, 1e-9_dp)
  call expect_near('the same: K0', point%stress(2) / point%stress(1), 0.72005924_dp, 5e-9_dp)
  call expect_near('the same: void ratio', point%statev(1), 1.04682688_dp, 5e-9_dp)

  ! another axis, in Pa and days
  props(i_stress_unit) = 1
  props(i_time_unit) = day
  point = run(props, principal(65e3_dp, 65e3_dp, 100e3_dp), principal(0.0_dp, 0.0_dp, 10 * rate) * day, &
              2e4_dp / day, 300)
  call expect_relative('oedometric compression at the tenfold rate, Pa and days', -point%stress(3) / 1e3_dp, &
                       904.54188285_dp, 1e-9_dp)
  props = set_a()

  point = run(props, principal(100.0_dp, 100.0_dp, 100.0_dp), principal(2 * rate, -rate, -rate) / 2, 3e5_dp, 500)
  call expect_relative('undrained compression: p', mean_pressure(point), 50.51454122_dp, 1e-9_dp)
  call expect_relative('undrained compression: q', axial_q(point), 49.69261978_dp, 1e-9_dp)
  point = run(props, principal(100.0_dp, 100.0_dp, 100.0_dp), principal(20 * rate, -10 * rate, -10 * rate) / 2, &
              3e4_dp, 7)
  call expect_relative('undrained compression at the tenfold rate: p', mean_pressure(point), 56.67816676_dp, 1e-9_dp)
  call expect_relative('undrained compression at the tenfold rate: q', axial_q(point), 55.75603852_dp, 1e-9_dp)
  point = run(props, principal(100.0_dp, 100.0_dp, 100.0_dp), principal(-2 * rate, rate, rate) / 2, 3e5_dp, 100)
  call expect_relative('undrained extension: p', mean_pressure(point), 50.54583972_dp, 1e-9_dp)
  call expect_relative('undrained extension: q', axial_q(point), -37.42704193_dp, 1e-9_dp)

  ! D_12 = 5e-7 /s is an engineering shear rate of 1e-6 /s
  point = run(props, principal(100.0_dp, 80.0_dp, 80.0_dp), [0.0_dp, 0.0_dp, 0.0_dp, rate, 0.0_dp, 0.0_dp], 5e5_dp, 200)
  call expect_near('simple shear: sigma 11', -point%stress(1), 49.15989_dp, 5e-6_dp)
  call expect_near('simple shear: sigma 22', -point%stress(2), 49.15938_dp, 5e-6_dp)
  call expect_near('simple shear: sigma 33', -point%stress(3), 49.15938_dp, 5e-6_dp)
  call expect_near('simple shear: tau 12', point%stress(4), 23.29878_dp, 5e-6_dp)

  call finish()

contains

  ! A history at a constant strain rate, in equal increments.
  function run(material, stress, strain_rate, duration, increments) result(end_point)
    real(dp), intent(in) :: material(n_props), stress(6), strain_rate(6), duration
    integer, intent(in) :: increments
    type(point_t) :: end_point
    real(dp) :: dtime
    integer :: k
    end_point%stress = stress
    dtime = duration / increments
    do k = 1, increments
      call advance(material, end_point, strain_rate * dtime, dtime)
    end do
  end function

end program
