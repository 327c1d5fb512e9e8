!> Units of acceleration in which records are written.
module dondolo_records_units
   use dondolo_base_error, only : error_type, not_a_word, raise_input
   use dondolo_base_kinds, only : wp
   use dondolo_base_odd_character, only : odd_character
   use dondolo_base_text, only : join, lower, replaced
   use dondolo_base_unit_hint, only : standard_gravity
   implicit none
   private

   public :: unit_factor

   !> Units that are known
   character(len=*), parameter :: known(5) = [character(len=5) :: 'm/s2', 'cm/s2', 'gal', 'mm/s2', 'g']

   !> Their sizes [m/s2]
   real(wp), parameter :: factors(5) = [1.0_wp, 0.01_wp, 0.01_wp, 0.001_wp, standard_gravity]

contains

   !> Find the size of a unit
   subroutine unit_factor(units, factor, error)
      !> Name of the unit, in any usual spelling (m/s2, m/s^2, m/s**2, m/s/s, m/sec2, cm/sec/sec, ...)
      character(len=*), intent(in) :: units
      !> Its size [m/s2]
      real(wp), intent(out) :: factor
      !> The unit is not known
      type(error_type), allocatable, intent(out) :: error

      integer :: i

      factor = 0.0_wp
      i = findloc(known == plain_spelling(units), .true., dim=1)
      if (i == 0) then
         call raise_input(error, 'units = '''//trim(units)//''': must be one of '//join(known), not_a_word, 'units')
         if (len_trim(odd_character(units)) > 0) error%message = error%message//'; it has '//trim(odd_character(units))
         return
      end if
      factor = factors(i)
   end subroutine unit_factor

   !> Spell a unit the way this module does
   pure function plain_spelling(units) result(plain)
      !> Name of a unit
      character(len=*), intent(in) :: units
      !> Lower case, without blanks and marks of powers, seconds as s, s squared as s2; filled up with blanks
      character(len=len(units)) :: plain

      plain = lower(adjustl(units))
      plain = replaced(plain, ' ', '')
      plain = replaced(plain, '^', '')
      plain = replaced(plain, '*', '')
      plain = replaced(plain, achar(194)//achar(178), '2')
      plain = replaced(plain, 'sec', 's')
      plain = replaced(plain, '/s/s', '/s2')
      plain = replaced(plain, 's-2', '/s2')
   end function plain_spelling

end module dondolo_records_units
