!> Which records run at which levels, and with which factors, as the rows of a catalogue say.
module dondolo_record_rows
   use dondolo_base_kinds, only : wp
   use dondolo_base_lines, only : lines_type
   implicit none
   private

   public :: record_rows_type

   !> Rows of a catalogue
   type :: record_rows_type
      !> Has the catalogue a column level?
      logical :: have_levels = .false.
      !> Record of each row
      integer, allocatable :: record(:)
      !> Level at which it runs, in the unit of the measure; 0: every level
      real(wp), allocatable :: level(:)
      !> Factor on it; 0: computed from the measure
      real(wp), allocatable :: factor(:)
      !> Where each row is, for messages
      type(lines_type) :: place
   end type record_rows_type

end module dondolo_record_rows
