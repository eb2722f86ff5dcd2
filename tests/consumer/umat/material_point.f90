! Copyright Isotach contributors. SPDX-License-Identifier: BSD-3-Clause
! A material point as a finite element code keeps it, and the call of the UMAT that advances it.
module material_point
  use, intrinsic :: iso_fortran_env, only: dp => real64
  implicit none
  private
  public :: dp, point_t, properties, set_a, principal, advance, advance_with, identity, rotation, turned_stress, &
            turned_strain, mean_pressure, axial_q

  integer, parameter, public :: n_props = 17
  integer, parameter, public :: n_statev = 11
  ! places in PROPS
  integer, parameter, public :: i_c1 = 7, i_c2 = 8, i_c3 = 9, i_tolerance = 11, i_max_substeps = 13, &
                                i_stress_unit = 14, i_time_unit = 15, i_e0 = 16, i_ocr0 = 17

  type point_t
    real(dp) :: stress(6) = 0  ! tension positive, 11 22 33 12 13 23
    real(dp) :: statev(n_statev) = 0
  end type

contains

  ! PROPS of a material (lambda, ...: as in docs/umat.md), Matsuoka-Nakai, in kPa and s, e0 = 1.5.
  ! Tolerance of a substep 1e-10 without an absolute part: the global error, about proportional to it, is then near
  ! 1e-10 too.
  pure function properties(e100, lambda, kappa, i_v, d_r, phi_c, c_1) result(props)
    real(dp), intent(in) :: e100, lambda, kappa, i_v, d_r, phi_c, c_1
    real(dp) :: props(n_props)
    props = 0
    props(1:7) = [e100, lambda, kappa, i_v, d_r, phi_c, c_1]
    props(10) = 1
    props(i_tolerance) = 1e-10_dp
    props(i_max_substeps) = 1e6_dp
    props(i_stress_unit) = 1e3_dp
    props(i_time_unit) = 1
    props(i_e0) = 1.5_dp
  end function

  ! Set A of the reference numbers.
  pure function set_a() result(props)
    real(dp) :: props(n_props)
    props = properties(1.5_dp, 0.1_dp, 0.02_dp, 0.05_dp, 1e-6_dp, 25.0_dp, 0.0_dp)
  end function

  ! A tensor with these principal values, given compression positive.
  pure function principal(s11, s22, s33) result(tensor)
    real(dp), intent(in) :: s11, s22, s33
    real(dp) :: tensor(6)
    tensor = -[s11, s22, s33, 0.0_dp, 0.0_dp, 0.0_dp]
  end function

  pure function identity() result(r)
    real(dp) :: r(3, 3)
    integer :: i
    r = 0
    do i = 1, 3
      r(i, i) = 1
    end do
  end function

  ! Rotation by an angle (rad) about a unit vector (Rodrigues).
  pure function rotation(axis, angle) result(r)
    real(dp), intent(in) :: axis(3), angle
    real(dp) :: r(3, 3), k(3, 3)
    k = reshape([0.0_dp, axis(3), -axis(2), -axis(3), 0.0_dp, axis(1), axis(2), -axis(1), 0.0_dp], [3, 3])
    r = identity() + sin(angle) * k + (1 - cos(angle)) * matmul(k, k)
  end function

  ! R A R^T of stress components.
  pure function turned_stress(a, r) result(b)
    real(dp), intent(in) :: a(6), r(3, 3)
    real(dp) :: b(6), m(3, 3)
    m = reshape([a(1), a(4), a(5), a(4), a(2), a(6), a(5), a(6), a(3)], [3, 3])
    m = matmul(r, matmul(m, transpose(r)))
    b = [m(1, 1), m(2, 2), m(3, 3), m(1, 2), m(1, 3), m(2, 3)]
  end function

  ! The same of strain components with engineering shear.
  pure function turned_strain(a, r) result(b)
    real(dp), intent(in) :: a(6), r(3, 3)
    real(dp) :: b(6)
    b = turned_stress([a(1:3), 0.5_dp * a(4:6)], r)
    b(4:6) = 2 * b(4:6)
  end function

  pure real(dp) function mean_pressure(point)
    type(point_t), intent(in) :: point
    mean_pressure = -sum(point%stress(1:3)) / 3
  end function

  ! q of a triaxial test with axis 1, with its sign.
  pure real(dp) function axial_q(point)
    type(point_t), intent(in) :: point
    axial_q = point%stress(2) - point%stress(1)
  end function

  ! Advances a point in three dimensions; stops where the UMAT asks for a shorter increment.
  subroutine advance(props, point, dstran, dtime, ddsdde, drot)
    real(dp), intent(in) :: props(n_props), dstran(6), dtime
    type(point_t), intent(inout) :: point
    real(dp), intent(out), optional :: ddsdde(6, 6)
    real(dp), intent(in), optional :: drot(3, 3)
    real(dp) :: tangent(6, 6), r(3, 3), pnewdt
    r = identity()
    if (present(drot)) r = drot
    call advance_with(props, point%stress, point%statev, tangent, dstran, dtime, r, pnewdt)
    if (pnewdt < 1) error stop 'the UMAT asked for a shorter increment'
    if (present(ddsdde)) ddsdde = tangent
  end subroutine

  ! The call itself, with the arguments an analysis passes; 4 or 6 components by the size of `stress`.
  subroutine advance_with(props, stress, statev, ddsdde, dstran, dtime, drot, pnewdt)
    real(dp), intent(in) :: props(:), dstran(:), dtime, drot(3, 3)
    real(dp), intent(inout) :: stress(:), statev(:)
    real(dp), intent(inout) :: ddsdde(:, :)
    real(dp), intent(out) :: pnewdt
    external :: umat  ! as Abaqus calls it: with an implicit interface
    character(80) :: cmname
    real(dp) :: sse, spd, scd, rpl, ddsddt(6), drplde(6), drpldt, stran(6), time(2), predef(1), dpred(1), &
                coords(3), f0(3, 3), f1(3, 3)
    integer :: n
    n = size(stress)
    cmname = 'ISOTACH'
    sse = 0; spd = 0; scd = 0; rpl = 0; ddsddt = 0; drplde = 0; drpldt = 0; stran = 0; time = 0; predef = 0
    dpred = 0; coords = 0; f0 = identity(); f1 = identity()
    pnewdt = 1
    call umat(stress, statev, ddsdde, sse, spd, scd, rpl, ddsddt, drplde, drpldt, stran, dstran, time, dtime, &
              20.0_dp, 0.0_dp, predef, dpred, cmname, 3, n - 3, n, size(statev), props, size(props), coords, drot, &
              pnewdt, 1.0_dp, f0, f1, 1, 1, 1, 1, 1, 1)
  end subroutine

end module
