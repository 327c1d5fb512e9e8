!> The short way to what most files of plain columns hold: accelerations alone, one a line, without titles and comments.
!>
!> Such a text is read in one go. No other format recognises it, for their headers have words; of any other text nothing is
!> taken here, and the readers of the formats say what it is or what is wrong with it.
module dondolo_single_column
   use dondolo_kinds, only : wp
   use dondolo_numbers, only : take_column
   use dondolo_record_format, only : samples_type
   use dondolo_text_file, only : find_content, text_file_type
   implicit none
   private

   public :: read_single_column

contains

   !> Read a single column of numbers
   subroutine read_single_column(text, samples, is_column)
      !> Text file whose lines need not be known
      type(text_file_type), intent(in) :: text
      !> One channel, as the format `columns` has it, if it is such a column
      type(samples_type), intent(out) :: samples
      !> Is it?
      logical, intent(out) :: is_column

      real(wp), allocatable :: values(:)
      integer :: begin, finish, count

      is_column = .false.
      call find_content(text%text, begin, finish)
      if (finish < begin) return
      ! Each has two characters at least but the last, which may have no line end
      allocate (values((finish - begin)/2 + 1))
      call take_column(text%text(begin:finish), values, count, is_column)
      if (.not. is_column) return
      allocate (samples%channels(1))
      samples%channels(1)%values = values(:count)
   end subroutine read_single_column

end module dondolo_single_column
