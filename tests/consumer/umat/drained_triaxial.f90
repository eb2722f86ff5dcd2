! Copyright Isotach contributors. SPDX-License-Identifier: BSD-3-Clause
! Stress-controlled tests as a finite element code runs them: Newton's method with DDSDDE on the strains that are free.
program drained_triaxial
  use material_point
  use checks
  implicit none

  integer, parameter :: max_iterations = 20
  logical, parameter :: triaxial(6) = [.true., .false., .false., .false., .false., .false.]
  logical, parameter :: creep(6) = .false.
  real(dp), parameter :: rate = 1e-6_dp, radial = 100, m = 0.9838315888_dp
  real(dp), parameter :: done = 1e-9_dp  ! kPa, of Newton's method
  type(point_t) :: point
  real(dp) :: props(n_props)

  ! Substeps cost tolerance^-1/2; their error, near 1e-8, stays far below that of the increments.
  props = set_a()
  props(i_tolerance) = 1e-8_dp
  call against_creep()
  props(i_c1) = 0.1_dp
  call against_runge_kutta()
  call against_critical_state()
  call quadratic_convergence()
  call finish()

contains

  ! Creep at isotropic stress over 1e6 s, in increments that grow with time as creep slows down. Within an increment
  ! the strain rate is constant and the stress is not, so that a stress-controlled test is second order in the
  ! increments' length: the error falls by 4 when they are halved, and extrapolating it away leaves the expected value.
  subroutine against_creep()
    real(dp) :: e(3)
    integer :: k
    do k = 1, 3
      point = run(creep, 0.0_dp, 1e6_dp, 100 * 2**k, grading=3)
      e(k) = point%statev(1)
    end do
    call expect_second_order('isotropic creep over 1e6 s: void ratio', e, 1.427927958_dp, 1e-7_dp)
  end subroutine

  ! Set A with C_1 = 0.1, radial stress held, to an axial strain of 0.1. Expected: an independent program (principal
  ! axes, classical Runge-Kutta; 2000 to 16000 steps agree in the digits given).
  subroutine against_runge_kutta()
    real(dp) :: axial(3), e(3)
    integer :: k
    do k = 1, 3
      point = run(triaxial, -rate, 1e5_dp, 100 * 2**k, grading=2)
      axial(k) = -point%stress(1)
      e(k) = point%statev(1)
    end do
    call expect_second_order('drained compression to 0.1: axial stress', axial, 182.83253242_dp, 1e-7_dp)
    call expect_second_order('drained compression to 0.1: void ratio', e, 1.3522216094_dp, 1e-7_dp)
    ! what Newton's method leaves, 1e-9 kPa, in each of 400 increments
    call expect_near('drained compression to 0.1: radial stress', -point%stress(3), radial, 400 * done)
  end subroutine

  ! At the critical state q = M p, so q = M radial/(1 - M/3); approached exponentially.
  subroutine against_critical_state()
    point = run(triaxial, -rate, 2e6_dp, 100, grading=1)
    call expect_relative('drained compression to 2: q at the critical state', axial_q(point), &
                         m * radial / (1 - m / 3), 1e-5_dp)
  end subroutine

  ! Increments of 1 % axial strain from no guess at all: each residual is at most a constant times the square of the one
  ! before, down to round-off. Newton's method with a tangent that is off by a part f would gain no more than that part
  ! from one to the next.
  subroutine quadratic_convergence()
    real(dp), parameter :: largest_factor = 0.01_dp  ! 1/kPa, near 1/p
    real(dp), parameter :: round_off = 1e-9_dp       ! kPa
    real(dp) :: residuals(max_iterations), factor
    integer :: k, i, count, most
    point = isotropic()
    factor = 0
    most = 0
    do k = 1, 10
      call increment(point, triaxial, -rate, 1e4_dp, residuals, count)
      write (*, '(a, i3, a, 10es10.2)') '      increment', k, ', residuals (kPa):', residuals(1:count)
      do i = 2, count
        if (residuals(i) > round_off) factor = max(factor, residuals(i) / residuals(i - 1)**2)
      end do
      most = max(most, count)
    end do
    call expect_near('largest of r_k+1/r_k^2 (1/kPa)', factor, 0.0_dp, largest_factor)
    call expect_true('no increment takes more than 5 solutions', most <= 6)
  end subroutine

  type(point_t) function isotropic()
    isotropic%stress = principal(radial, radial, radial)
  end function

  ! A test from isotropic stress in increments that end at duration (k/increments)^grading.
  function run(prescribed, axial_rate, duration, increments, grading) result(end_point)
    logical, intent(in) :: prescribed(6)
    real(dp), intent(in) :: axial_rate, duration
    integer, intent(in) :: increments, grading
    type(point_t) :: end_point
    real(dp) :: residuals(max_iterations), from, until
    integer :: k, count
    end_point = isotropic()
    until = 0
    do k = 1, increments
      from = until
      until = duration * (real(k, dp) / increments)**grading
      call increment(end_point, prescribed, axial_rate, until - from, residuals, count)
    end do
  end function

  ! Values at n, 2n and 4n increments.
  subroutine expect_second_order(what, values, expected, tolerance)
    character(*), intent(in) :: what
    real(dp), intent(in) :: values(3), expected, tolerance
    write (*, '(3a, 3es10.2)') '      ', what, ', relative errors', values / expected - 1
    call expect_near(what//', fall of the error', (values(2) - values(1)) / (values(3) - values(2)), 4.0_dp, 0.4_dp)
    call expect_relative(what//', extrapolated', values(3) + (values(3) - values(2)) / 3, expected, tolerance)
  end subroutine

  ! One increment: the axial strain rate as said where prescribed; components that are not keep their stress.
  subroutine increment(state, prescribed, axial_rate, dtime, residuals, count)
    type(point_t), intent(inout) :: state
    logical, intent(in) :: prescribed(6)
    real(dp), intent(in) :: axial_rate, dtime
    real(dp), intent(out) :: residuals(max_iterations)
    integer, intent(out) :: count
    type(point_t) :: trial
    real(dp) :: dstran(6), ddsdde(6, 6), matrix(6, 6), right(6)
    integer :: i
    dstran = 0
    if (prescribed(1)) dstran(1) = axial_rate * dtime
    do count = 1, max_iterations
      trial = state
      call advance(props, trial, dstran, dtime, ddsdde)
      right = merge(0.0_dp, state%stress - trial%stress, prescribed)
      residuals(count) = maxval(abs(right))
      if (residuals(count) <= done) then
        state = trial
        return
      end if
      matrix = ddsdde
      do i = 1, 6
        if (prescribed(i)) then
          matrix(i, :) = 0
          matrix(i, i) = 1
        end if
      end do
      dstran = dstran + solution(matrix, right)
    end do
    error stop 'Newton''s method did not converge'
  end subroutine

  ! Gauss-Jordan elimination with row exchange.
  pure function solution(matrix, right) result(x)
    real(dp), intent(in) :: matrix(6, 6), right(6)
    real(dp) :: x(6), a(6, 7), row(7)
    integer :: i, j, pivot
    a(:, 1:6) = matrix
    a(:, 7) = right
    do i = 1, 6
      pivot = i - 1 + maxloc(abs(a(i:6, i)), dim=1)
      row = a(i, :)
      a(i, :) = a(pivot, :)
      a(pivot, :) = row
      a(i, :) = a(i, :) / a(i, i)
      do j = 1, 6
        if (j /= i) a(j, :) = a(j, :) - a(j, i) * a(i, :)
      end do
    end do
    x = a(:, 7)
  end function

end program
