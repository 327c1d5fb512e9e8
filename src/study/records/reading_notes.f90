!> What there is to report of how records were read: samples that were ignored, columns that were not read, files that may be
!> cut off. The metadata hold it under the key `reading`; a sentence that is true of several records is reported once.
module dondolo_records_reading_notes
   use dondolo_base_lines, only : lines_type
   use dondolo_base_plain, only : visible
   use dondolo_base_text, only : to_text
   use dondolo_record, only : record_type
   implicit none
   private

   public :: list_reading_notes

contains

   !> List what there is to report of records
   subroutine list_reading_notes(records, notes)
      type(record_type), intent(in) :: records(:)
      !> A sentence for each kind of remark, with the first record that it is true of; added at the end
      type(lines_type), intent(inout) :: notes

      type(lines_type) :: kinds
      character(len=:), allocatable :: text
      integer, allocatable :: first(:), count(:)
      integer :: i, kind

      allocate (first(size(records)), count(size(records)), source=0)
      do i = 1, size(records)
         text = records(i)%metadata%get('reading')
         if (len(text) == 0) cycle
         do kind = 1, kinds%count
            if (kinds%line(kind)%text == text) exit
         end do
         if (kind > kinds%count) then
            call kinds%add(text)
            first(kind) = i
         end if
         count(kind) = count(kind) + 1
      end do
      do kind = 1, kinds%count
         text = visible('record '''//records(first(kind))%name//''': '//kinds%line(kind)%text)
         if (count(kind) > 1) text = text//' ('//to_text(count(kind))//' of '//to_text(size(records))//' records)'
         call notes%add(text)
      end do
   end subroutine list_reading_notes

end module dondolo_records_reading_notes
