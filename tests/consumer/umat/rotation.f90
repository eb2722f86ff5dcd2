! Copyright Isotach contributors. SPDX-License-Identifier: BSD-3-Clause
! Objectivity with an ellipse that rotates (C_2, C_3 > 0): what turns the whole problem turns the answer.
!
! Rotating a tensor rounds at 1e-16 of its largest component and the law forgets its start, so round-off of some
! thousand substeps is all that may differ: 1e-12 relative. A term that is not objective would show at 1e-2.
program rotated_problem
  use material_point
  use checks
  implicit none

  integer, parameter :: increments = 40
  real(dp), parameter :: dtime = 5e3_dp, tolerance = 1e-12_dp
  real(dp) :: props(n_props), r(3, 3), step(3, 3), total(3, 3), dstran(6), ddsdde(6, 6), turned_ddsdde(6, 6), unit(6)
  type(point_t) :: reference, turned, start
  real(dp) :: worst_stress, worst_omega, worst_tangent
  integer :: k, j

  props = set_a()
  props(i_c1) = 0.05_dp
  props(i_c2:i_c3) = [30.0_dp, 0.4_dp]
  props(i_tolerance) = 1e-6_dp
  start%stress = [-100.0_dp, -65.0_dp, -80.0_dp, 10.0_dp, 0.0_dp, -5.0_dp]
  start%statev(1:7) = [1.45_dp, 0.1_dp, -0.06_dp, -0.04_dp, -0.05_dp, 0.0_dp, 0.02_dp]

  ! Axes that are turned once: stress, Omega and strain in other axes give the same answer in those axes.
  r = rotation([1.0_dp, 2.0_dp, 2.0_dp] / 3, 0.7_dp)
  reference = start
  turned = start
  turned%stress = turned_stress(start%stress, r)
  turned%statev(2:7) = turned_stress(start%statev(2:7), r)
  worst_stress = 0; worst_omega = 0; worst_tangent = 0
  do k = 1, increments
    dstran = strain_of(k)
    call advance(props, reference, dstran, dtime, ddsdde)
    call advance(props, turned, turned_strain(dstran, r), dtime, turned_ddsdde)
    call compare(r)
    do j = 1, 6
      unit = 0
      unit(j) = 1
      worst_tangent = max(worst_tangent, maxval(abs(turned_stress(matmul(ddsdde, unit), r) &
                          - matmul(turned_ddsdde, turned_strain(unit, r)))) / maxval(abs(ddsdde)))
    end do
  end do
  call expect_true('Omega has moved by more than 0.1 on the way', &
                   maxval(abs(reference%statev(2:7) - start%statev(2:7))) > 0.1_dp)
  call report('other axes')
  call expect_near('other axes: DDSDDE', worst_tangent, 0.0_dp, tolerance)

  ! A body that turns: before each call the code has turned STRESS by DROT and leaves Omega to the UMAT; the strain
  ! increment stands in the turned axes.
  step = rotation([2.0_dp, -1.0_dp, 2.0_dp] / 3, 0.11_dp)
  total = identity()
  reference = start
  turned = start
  worst_stress = 0; worst_omega = 0
  do k = 1, increments
    dstran = strain_of(k)
    call advance(props, reference, dstran, dtime)
    total = matmul(step, total)
    turned%stress = turned_stress(turned%stress, step)
    call advance(props, turned, turned_strain(dstran, total), dtime, drot=step)
    call compare(total)
  end do
  call report('turning body')

  ! Without strain and time a rotation is all that happens.
  call advance(props, turned, [(0.0_dp, j=1, 6)], 0.0_dp, drot=transpose(total))
  call expect_near('turned back: Omega', maxval(abs(turned%statev(2:7) - reference%statev(2:7))), 0.0_dp, tolerance)
  call finish()

contains

  ! Strain increments that change direction as they go, about 1 % each.
  pure function strain_of(k) result(strain)
    integer, intent(in) :: k
    real(dp) :: strain(6)
    strain = [-6.0_dp, 2.0_dp, 1.0_dp, 3.0_dp * cos(0.2_dp * k), 2.0_dp * sin(0.3_dp * k), -1.5_dp] * 1e-3_dp
  end function

  subroutine compare(turn)
    real(dp), intent(in) :: turn(3, 3)
    worst_stress = max(worst_stress, maxval(abs(turned%stress - turned_stress(reference%stress, turn))) &
                       / maxval(abs(reference%stress)))
    worst_omega = max(worst_omega, maxval(abs(turned%statev(2:7) - turned_stress(reference%statev(2:7), turn))))
  end subroutine

  subroutine report(what)
    character(*), intent(in) :: what
    call expect_near(what//': stress, relative', worst_stress, 0.0_dp, tolerance)
    call expect_near(what//': Omega', worst_omega, 0.0_dp, tolerance)
    call expect_near(what//': void ratio', turned%statev(1), reference%statev(1), tolerance)
  end subroutine

end program
