! Copyright Isotach contributors. SPDX-License-Identifier: BSD-3-Clause
! documented_input FILE: the material of the input shown in docs/umat.md is accepted, and is set A with another
! tolerance.
program documented_input
  use material_point
  use checks
  implicit none

  real(dp) :: props(n_props), expected(n_props)
  type(point_t) :: point
  integer :: i

  props = constants()
  expected = set_a()
  expected([i_tolerance, i_time_unit]) = [1e-5_dp, 86400.0_dp]
  do i = 1, n_props
    if (i /= i_max_substeps) call expect_relative('PROPS', props(i), expected(i), 0.0_dp)
  end do
  point%stress = principal(100.0_dp, 65.0_dp, 65.0_dp)
  call advance(props, point, principal(1e-3_dp, 0.0_dp, 0.0_dp), 0.01_dp)
  call expect_true('the point has been compressed', -point%stress(1) > 100 .and. point%statev(1) < 1.5_dp)
  call finish()

contains

  ! The numbers that follow *USER MATERIAL, up to the next keyword; lines with ** are comments.
  function constants() result(values)
    real(dp) :: values(n_props)
    character(1000) :: name, line, text
    integer :: unit, status
    logical :: inside
    call get_command_argument(1, name)
    open (newunit=unit, file=trim(name), status='old', action='read')
    inside = .false.
    text = ''
    do
      read (unit, '(a)', iostat=status) line
      if (status /= 0) exit
      line = adjustl(line)
      if (line(1:2) == '**') cycle
      if (inside .and. line(1:1) == '*') exit
      if (inside) text = trim(text)//' '//trim(line)
      inside = inside .or. line(1:15) == '*USER MATERIAL,'
    end do
    close (unit)
    read (text, *) values
  end function

end program
