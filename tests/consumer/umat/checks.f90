! Copyright Isotach contributors. SPDX-License-Identifier: BSD-3-Clause
! Comparisons that say what was got, what was expected and within what; the program fails if one of them does.
module checks
  use, intrinsic :: iso_fortran_env, only: dp => real64, output_unit
  implicit none
  private
  public :: expect_relative, expect_near, expect_true, finish

  integer :: failures = 0

contains

  subroutine expect_relative(what, got, expected, tolerance)
    character(*), intent(in) :: what
    real(dp), intent(in) :: got, expected, tolerance
    call expect_near(what, got, expected, tolerance * abs(expected))
  end subroutine

  ! Written so that NaN fails.
  subroutine expect_near(what, got, expected, tolerance)
    character(*), intent(in) :: what
    real(dp), intent(in) :: got, expected, tolerance
    logical :: good
    good = abs(got - expected) <= tolerance
    write (output_unit, '(a4, 2x, a, t62, 3(es20.12))') merge('ok  ', 'FAIL', good), what, got, expected, tolerance
    if (.not. good) failures = failures + 1
  end subroutine

  subroutine expect_true(what, good)
    character(*), intent(in) :: what
    logical, intent(in) :: good
    write (output_unit, '(a4, 2x, a)') merge('ok  ', 'FAIL', good), what
    if (.not. good) failures = failures + 1
  end subroutine

  subroutine finish()
    if (failures > 0) error stop 'comparisons failed'
  end subroutine

end module
