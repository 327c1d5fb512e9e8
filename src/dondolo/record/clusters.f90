!> Which records belong together: those of one earthquake are no independent evidence.
module dondolo_clusters
   use dondolo_metadata, only : metadata_type
   use dondolo_name_index, only : name_index_type
   use dondolo_record, only : record_type
   implicit none
   private

   public :: cluster_records, cluster_label

contains

   !> Number the clusters of records, from 1 in the order in which they appear. A record without a label is one by itself
   subroutine cluster_records(records, clusters)
      type(record_type), intent(in) :: records(:)
      !> Number of the cluster of each
      integer, intent(out) :: clusters(:)

      type(name_index_type) :: labels
      character(len=:), allocatable :: label
      integer :: i, known, count

      count = 0
      do i = 1, size(records)
         call cluster_label(records(i)%metadata, label)
         known = 0
         if (len(label) > 0) call labels%note(label, count + 1, known)
         if (known == 0) then
            count = count + 1
            known = count
         end if
         clusters(i) = known
      end do
   end subroutine cluster_records

   !> Label of a record: its earthquake, else the station and the date of its recording, else nothing
   pure subroutine cluster_label(metadata, label)
      !> Metadata of the record
      type(metadata_type), intent(in) :: metadata
      !> Label; empty if the metadata give none
      character(len=:), allocatable, intent(out) :: label

      label = metadata%get('event')
      if (len(label) > 0) return
      if (len(metadata%get('station')) > 0 .and. len(metadata%get('date')) > 0) then
         label = metadata%get('station')//' '//metadata%get('date')
      end if
   end subroutine cluster_label

end module dondolo_clusters
