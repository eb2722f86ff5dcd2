! Copyright Isotach contributors. SPDX-License-Identifier: BSD-3-Clause
! Plane strain and axisymmetry (NTENS = 4) are the three-dimensional law with 13 and 23 left out: the same bits.
program plane
  use material_point
  use checks
  implicit none

  integer, parameter :: plane_components(4) = [1, 2, 3, 4]
  real(dp) :: props(n_props), stress(4), statev(n_statev), ddsdde(4, 4), full_ddsdde(6, 6), dstran(6), turned(6)
  real(dp) :: drot(3, 3), pnewdt
  type(point_t) :: full
  logical :: same_stress, same_state, same_tangent
  integer :: k

  props = set_a()
  props(i_c1) = 0.05_dp
  props(i_c2:i_c3) = [30.0_dp, 0.4_dp]
  props(i_tolerance) = 1e-6_dp
  full%stress = [-100.0_dp, -65.0_dp, -80.0_dp, 10.0_dp, 0.0_dp, 0.0_dp]
  full%statev(1:7) = [1.45_dp, -0.2_dp, 0.12_dp, 0.08_dp, 0.03_dp, 0.0_dp, 0.0_dp]
  stress = full%stress(plane_components)
  statev = full%statev
  drot = rotation([0.0_dp, 0.0_dp, 1.0_dp], 0.1_dp)
  same_stress = .true.; same_state = .true.; same_tangent = .true.
  do k = 1, 20
    dstran = [-6.0_dp, 2.0_dp, 1.0_dp, 3.0_dp * cos(0.2_dp * k), 0.0_dp, 0.0_dp] * 1e-3_dp
    turned = turned_stress(full%stress, drot)
    full%stress = turned
    stress = turned(plane_components)
    call advance(props, full, dstran, 5e3_dp, full_ddsdde, drot)
    call advance_with(props, stress, statev, ddsdde, dstran(plane_components), 5e3_dp, drot, pnewdt)
    if (pnewdt < 1) error stop 'the UMAT asked for a shorter increment'
    same_stress = same_stress .and. all(stress == full%stress(plane_components)) .and. all(full%stress(5:6) == 0)
    same_state = same_state .and. all(statev == full%statev)
    same_tangent = same_tangent .and. all(ddsdde == full_ddsdde(plane_components, plane_components))
  end do
  call expect_true('NTENS = 4 gives the stress of NTENS = 6', same_stress)
  call expect_true('NTENS = 4 gives the state of NTENS = 6', same_state)
  call expect_true('NTENS = 4 gives DDSDDE of NTENS = 6', same_tangent)

  ! An Omega that leans out of the plane has no place in it.
  statev(6) = 0.1_dp
  call advance_with(props, stress, statev, ddsdde, dstran(plane_components), 5e3_dp, drot, pnewdt)
  call expect_true('Omega out of the plane is refused', pnewdt > 0 .and. pnewdt < 1e-6_dp)
  call finish()

end program
