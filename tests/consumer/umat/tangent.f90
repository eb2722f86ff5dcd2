! Copyright Isotach contributors. SPDX-License-Identifier: BSD-3-Clause
! DDSDDE against central differences of the UMAT itself, column by column, engineering shear included, at a general
! state with every part of the law at work.
!
! In one substep the map is a fixed formula, and DDSDDE its exact derivative: five-point differences of a relative step
! of 1e-3 agree to 1e-9 of the largest entry. Over many substeps the differences also see the substeps change size
! with the strain, which DDSDDE leaves out. That moves the stress by a part of the tolerance, 1e-10, over a strain of the
! order of the increment's, 2e-3, which is 1e-8 of a stiffness of 50 |T|.
program tangent
  use material_point
  use checks
  implicit none

  real(dp) :: props(n_props), dstran(6)
  type(point_t) :: start

  props = properties(1.5_dp, 0.1_dp, 0.02_dp, 0.05_dp, 1e-6_dp, 25.0_dp, 0.1_dp)
  props(i_c2) = 20
  props(i_c3) = 0.3_dp
  start%stress = [-100.0_dp, -70.0_dp, -80.0_dp, 12.0_dp, -7.0_dp, 5.0_dp]
  start%statev(1) = 1.4_dp
  start%statev(2:7) = [-0.1_dp, 0.06_dp, 0.04_dp, 0.05_dp, -0.02_dp, 0.03_dp]
  dstran = [-2.0_dp, 0.5_dp, -0.7_dp, 1.1_dp, -0.6_dp, 0.4_dp] * 1e-3_dp

  props(i_tolerance) = 0.5_dp
  call compare('one substep, with creep', 1000.0_dp, 1e-9_dp)
  call compare('one substep, rate-independent', 0.0_dp, 1e-9_dp)
  props(i_tolerance) = 1e-10_dp
  call compare('many substeps, with creep', 1000.0_dp, 1e-8_dp)
  call compare('many substeps, rate-independent', 0.0_dp, 1e-8_dp)
  props(10) = 0
  call compare('many substeps, no Lode dependence', 1000.0_dp, 1e-8_dp)
  props(10) = 1
  props(i_c2:i_c3) = 0
  start%statev(2:7) = 0
  call compare('many substeps, isotropic', 1000.0_dp, 1e-8_dp)
  ! E and the derivative of C_1 m |D| alike: kPa in, kPa out
  props(i_stress_unit) = 1
  start%stress = start%stress * 1e3_dp
  call compare('many substeps, in Pa', 1000.0_dp, 1e-8_dp)
  call finish()

contains

  subroutine compare(what, dtime, tolerance)
    character(*), intent(in) :: what
    real(dp), intent(in) :: dtime, tolerance
    real(dp), parameter :: step = 3e-6_dp
    real(dp) :: ddsdde(6, 6), column(6), largest
    character(1) :: digit
    type(point_t) :: point
    integer :: j
    point = start
    call advance(props, point, dstran, dtime, ddsdde)
    write (*, '(3a, 2(i0, a))') '      ', what, ': ', nint(point%statev(9)), ' substeps accepted, ', &
      nint(point%statev(10)), ' rejected'
    largest = maxval(abs(ddsdde))
    do j = 1, 6
      column = (8 * (stress_at(j, step, dtime) - stress_at(j, -step, dtime)) &
                - (stress_at(j, 2 * step, dtime) - stress_at(j, -2 * step, dtime))) / (12 * step)
      write (digit, '(i1)') j
      call expect_near(what//': column '//digit, maxval(abs(ddsdde(:, j) - column)) / largest, 0.0_dp, tolerance)
    end do
  end subroutine

  function stress_at(component, change, dtime) result(stress)
    integer, intent(in) :: component
    real(dp), intent(in) :: change, dtime
    real(dp) :: stress(6), changed(6)
    type(point_t) :: point
    point = start
    changed = dstran
    changed(component) = changed(component) + change
    call advance(props, point, changed, dtime)
    stress = point%stress
  end function

end program
