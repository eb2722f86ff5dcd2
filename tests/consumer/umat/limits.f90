! Copyright Isotach contributors. SPDX-License-Identifier: BSD-3-Clause
! Calls without strain, without time and without either, against closed forms; and calls that fail.
program limits
  use material_point
  use checks
  implicit none

  real(dp), parameter :: kappa = 0.02_dp, a = 3.7346174448_dp  ! a of set A, from the reference numbers
  real(dp) :: props(n_props), ddsdde(6, 6), untouched(6, 6), p, f_b, pnewdt
  type(point_t) :: point, before
  integer :: i

  props = set_a()
  props(i_c1) = 0.1_dp
  props(i_c2:i_c3) = [10.0_dp, 0.3_dp]

  ! No strain, no time: every bit of stress and state stays; the tangent is E.
  point%stress = [-100.0_dp / 3, -20.1_dp, -23.7_dp, 1.0_dp / 7, 0.3_dp, -0.1_dp]
  point%statev(1:7) = [1.3_dp, -0.1_dp, 0.03_dp, 0.07_dp, 1.0_dp / 30, -0.01_dp, 0.02_dp]
  before = point
  call advance(props, point, [(0.0_dp, i=1, 6)], 0.0_dp, ddsdde)
  call expect_true('no strain and no time: stress stays', all(point%stress == before%stress))
  call expect_true('no strain and no time: e and Omega stay', all(point%statev(1:7) == before%statev(1:7)))
  call expect_true('no strain and no time: nothing integrated', all(point%statev(9:10) == 0.0_dp))
  point = isotropic(50.0_dp)
  call advance(props, point, [(0.0_dp, i=1, 6)], 0.0_dp, ddsdde)
  ! E = f_b (I + a^2/9 1 (x) 1) there, f_b = 3p/((1 + a^2/3) kappa); engineering shear takes half of f_b
  f_b = 3 * 50 / ((1 + a**2 / 3) * kappa)
  call expect_relative('the same: E_1111', ddsdde(1, 1), f_b * (1 + a**2 / 9), 1e-9_dp)
  call expect_relative('the same: E_1122', ddsdde(1, 2), f_b * a**2 / 9, 1e-9_dp)
  call expect_relative('the same: E_1212', ddsdde(4, 4), f_b / 2, 1e-9_dp)
  call expect_relative('the same: bulk stiffness p/kappa', sum(ddsdde(1:3, 1:3)) / 9, 50 / kappa, 1e-12_dp)
  call expect_true('the same: no coupling of shear', all(ddsdde(1:3, 4:6) == 0) .and. all(ddsdde(4:6, 1:3) == 0))
  call expect_true('the same: e0 was taken from PROPS', point%statev(1) == 1.5_dp)

  ! Strain without time: p = p0 exp(eps_v (1 -+ C_1)/kappa), tangent (p/kappa)(1 -+ C_1).
  point = isotropic(50.0_dp)
  call advance(props, point, principal(0.004_dp, 0.004_dp, 0.004_dp), 0.0_dp, ddsdde)
  p = 50 * exp(0.012_dp * 0.9_dp / kappa)
  call expect_relative('loading without time: p', mean_pressure(point), p, 1e-9_dp)
  call expect_relative('loading without time: bulk stiffness', sum(ddsdde(1:3, 1:3)) / 9, p / kappa * 0.9_dp, 1e-8_dp)
  call expect_relative('loading without time: e', point%statev(1), 2.5_dp * exp(-0.012_dp) - 1, 1e-9_dp)
  call expect_true('loading without time: Omega stays', all(point%statev(2:7) == 0))
  point = isotropic(50.0_dp)
  call advance(props, point, principal(-0.004_dp, -0.004_dp, -0.004_dp), 0.0_dp, ddsdde)
  p = 50 * exp(-0.012_dp * 1.1_dp / kappa)
  call expect_relative('unloading without time: p', mean_pressure(point), p, 1e-9_dp)
  call expect_relative('unloading without time: bulk stiffness', sum(ddsdde(1:3, 1:3)) / 9, p / kappa * 1.1_dp, &
                       1e-8_dp)
  ! the same at OCR 1e-3, where creep would be 1e60 times as fast: it has no time all the same
  props(i_e0) = 2.5_dp * 1000**0.1_dp - 1  ! p_B is 0.1 kPa there
  point = isotropic(100.0_dp)
  call advance(props, point, principal(0.001_dp, 0.001_dp, 0.001_dp), 0.0_dp, ddsdde)
  call expect_relative('loading without time far below OCR 1: p', mean_pressure(point), &
                       100 * exp(0.003_dp * 0.9_dp / kappa), 1e-9_dp)
  props(i_e0) = 1.5_dp

  ! An OCR to start from: p_B = OCR p at isotropic stress.
  props(i_e0) = 0
  props(i_ocr0) = 2
  point = isotropic(100.0_dp)
  call advance(props, point, [(0.0_dp, i=1, 6)], 0.0_dp)
  call expect_relative('OCR 2 at 100 kPa: e at p_B = 200 kPa', point%statev(1), 1.3325824788_dp, 1e-10_dp)
  call expect_relative('OCR 2 at 100 kPa: OCR', point%statev(8), 2.0_dp, 1e-12_dp)
  props(i_e0) = 1.5_dp
  props(i_ocr0) = 0

  ! Failures within the increment: a void ratio that would fall below zero, and too many substeps. A shorter increment
  ! is asked for, and nothing else changes.
  untouched = -1
  props(i_tolerance) = 1e-6_dp
  point = isotropic(100.0_dp)
  point%statev(1) = 1.5_dp
  before = point
  call advance_with(props, point%stress, point%statev, untouched, principal(0.4_dp, 0.3_dp, 0.3_dp), 1e6_dp, &
                    identity(), pnewdt)
  call expect_true('compression beyond e = 0: a shorter increment is asked for', pnewdt == 0.25_dp)
  call unchanged('compression beyond e = 0')
  props(i_max_substeps) = 5
  call advance_with(props, point%stress, point%statev, untouched, principal(0.1_dp, 0.0_dp, 0.0_dp), 1e5_dp, &
                    identity(), pnewdt)
  call expect_true('too many substeps: a shorter increment is asked for', pnewdt == 0.25_dp)
  call unchanged('too many substeps')
  props(i_max_substeps) = 0
  point%stress = principal(-1.0_dp, -1.0_dp, -1.0_dp)
  before = point
  call advance_with(props, point%stress, point%statev, untouched, principal(0.1_dp, 0.0_dp, 0.0_dp), 1e5_dp, &
                    identity(), pnewdt)
  call expect_true('tensile stress: refused, the analysis is to end', pnewdt > 0 .and. pnewdt < 1e-6_dp)
  call unchanged('tensile stress')
  call finish()

contains

  type(point_t) function isotropic(pressure)
    real(dp), intent(in) :: pressure
    isotropic%stress = principal(pressure, pressure, pressure)
  end function

  subroutine unchanged(what)
    character(*), intent(in) :: what
    call expect_true(what//': STRESS, STATEV and DDSDDE untouched', all(point%stress == before%stress) .and. &
                     all(point%statev == before%statev) .and. all(untouched == -1))
  end subroutine

end program
