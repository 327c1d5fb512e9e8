!> The unit that an implausible value is most likely in: the question that refusals and warnings ask of it.
!>
!> A value beyond the plausible range of its property (dondolo_base_property) is converted from each other unit of its kind. Of the
!> units that put it into the range the one is asked for that brings it nearest to a usual value.
module dondolo_base_unit_hint
   use dondolo_base_kinds, only : wp
   implicit none
   private

   public :: unit_hint, unit_question, hint_length, standard_gravity

   !> Length of a question
   integer, parameter :: hint_length = 48

   !> Another unit of a quantity: a value in it times the factor, or the factor over the value, is one in the unit of the
   !> property
   type :: other_unit_type
      character(len=8) :: unit = ''
      character(len=32) :: name = ''
      real(wp) :: factor = 1.0_wp
      logical :: is_inverse = .false.
   end type other_unit_type

   !> The unit g [m/s2]: standard gravity, by definition of the unit (3rd CGPM, 1901). The gravity in which walls stand is another
   !> number (dondolo_wall)
   real(wp), parameter :: standard_gravity = 9.80665_wp

   !> Other units. Of densities and of gravity the rows of their properties ask
   type(other_unit_type), parameter :: others(*) = [ &
      & other_unit_type('m', 'millimetres', 1.0e-3_wp), &
      & other_unit_type('m', 'centimetres', 1.0e-2_wp), &
      & other_unit_type('m2/m', 'mm2 per metre of wall', 1.0e-6_wp), &
      & other_unit_type('m2/m', 'cm2 per metre of wall', 1.0e-4_wp), &
      & other_unit_type('Pa', 'kPa', 1.0e3_wp), &
      & other_unit_type('Pa', 'MPa', 1.0e6_wp), &
      & other_unit_type('Pa', 'GPa', 1.0e9_wp), &
      & other_unit_type('N/m', 'kN/m', 1.0e3_wp), &
      & other_unit_type('N', 'kN', 1.0e3_wp), &
      & other_unit_type('N/m2', 'kN/m2', 1.0e3_wp), &
      & other_unit_type('N/m2', 'N/mm2', 1.0e6_wp), &
      & other_unit_type('N/m3', 'kN/m3', 1.0e3_wp), &
      & other_unit_type('N/m3', 'N/mm3', 1.0e9_wp), &
      & other_unit_type('kg/m', 't/m', 1.0e3_wp), &
      & other_unit_type('kg m2/m', 't m2/m', 1.0e3_wp), &
      & other_unit_type('s', 'milliseconds', 1.0e-3_wp), &
      & other_unit_type('s', 'Hz, a frequency', 1.0_wp, is_inverse=.true.), &
      & other_unit_type('g', 'm/s2', 1.0_wp/standard_gravity), &
      & other_unit_type('g', 'cm/s2', 0.01_wp/standard_gravity), &
      & other_unit_type('g', 'per cent of g', 0.01_wp), &
      & other_unit_type('', 'per cent', 0.01_wp)]

   !> Converted values farther from the example than this are no better than the value itself
   real(wp), parameter :: farthest = 30.0_wp

contains

   !> The question to ask of a value beyond its range: 'is it in millimetres?'
   pure function unit_hint(unit, value, low, high, usual) result(text)
      !> Unit that the value should have; empty for a number without one
      character(len=*), intent(in) :: unit
      !> A positive value beyond the range
      real(wp), intent(in) :: value
      !> Plausible range, and a usual value; 0: none is known
      real(wp), intent(in) :: low, high, usual
      !> The question, blanks after it; empty: no unit makes the value plausible
      character(len=hint_length) :: text

      real(wp) :: converted, distance, nearest
      integer :: i

      text = ''
      nearest = log(farthest)
      do i = 1, size(others)
         if (others(i)%unit /= unit) cycle
         converted = others(i)%factor*value
         if (others(i)%is_inverse) converted = others(i)%factor/value
         if (converted < low .or. converted > high) cycle
         distance = 0.0_wp
         if (usual > 0.0_wp) distance = abs(log(converted/usual))
         if (distance > nearest) cycle
         nearest = distance
         text = 'is it in '//trim(others(i)%name)//'?'
      end do
   end function unit_hint

   !> The same after a colon, to follow a message
   pure function unit_question(unit, value, low, high, usual) result(text)
      !> Unit that the value should have
      character(len=*), intent(in) :: unit
      !> A value beyond the range
      real(wp), intent(in) :: value
      !> Range, and a usual value
      real(wp), intent(in) :: low, high, usual
      !> ': is it in millimetres?', blanks after it
      character(len=hint_length + 2) :: text

      text = ''
      if (value > 0.0_wp .and. value <= huge(value)) text = unit_hint(unit, value, low, high, usual)
      if (len_trim(text) > 0) text = ': '//trim(text)
   end function unit_question

end module dondolo_base_unit_hint
