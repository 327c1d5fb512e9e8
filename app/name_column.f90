!> The column of names in tables on the terminal: as wide as the longest of them, within limits.
module dondolo_name_column
   implicit none
   private

   public :: name_width

   !> Least and largest width
   integer, parameter :: narrowest = 30, widest = 80

contains

   !> Width of a column, one blank after the longest name included
   pure integer function name_width(longest)
      !> Length of the longest name
      integer, intent(in) :: longest

      name_width = min(max(narrowest, longest + 1), widest)
   end function name_width

end module dondolo_name_column
