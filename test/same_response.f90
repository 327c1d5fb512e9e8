!> Equality of responses: what must not depend on threads, grouping, polarity or a time history.
module same_response
   use dondolo_motion_response, only : response_type
   implicit none
   private

   public :: is_same

contains

   !> Are two responses the same to the bit?
   elemental logical function is_same(one, other)
      type(response_type), intent(in) :: one, other

      is_same = one%edp == other%edp .and. one%time_of_peak == other%time_of_peak .and. one%impacts == other%impacts &
         & .and. (one%collapsed .eqv. other%collapsed)
   end function is_same

end module same_response
