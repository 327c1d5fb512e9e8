!> Which records belong together: those of one earthquake are no independent evidence.
module dondolo_record_clusters
   use dondolo_base_kinds, only : wp
   use dondolo_base_name_index, only : name_index_type
   use dondolo_record, only : record_type
   use dondolo_record_earthquake, only : find_date, find_earthquake
   use dondolo_record_metadata, only : metadata_type
   implicit none
   private

   public :: cluster_records, cluster_label

contains

   !> Number the clusters of records, from 1 in the order in which they appear. A record without a label is one by itself, with
   !> those that are the same motion
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
         if (len(label) > 0) then
            call labels%note(label, count + 1, known)
         else
            call find_same_motion(records, clusters, i, known)
         end if
         if (known == 0) then
            count = count + 1
            known = count
         end if
         clusters(i) = known
      end do
   end subroutine cluster_records

   !> Cluster of a record without a label among those before: that of the same motion, 0 if there is none
   pure subroutine find_same_motion(records, clusters, number, known)
      type(record_type), intent(in) :: records(:)
      !> Clusters of the records before
      integer, intent(in) :: clusters(:)
      !> Number of the record
      integer, intent(in) :: number
      !> Its cluster
      integer, intent(out) :: known

      integer :: i

      known = 0
      associate (own => records(number))
         do i = 1, number - 1
            associate (other => records(i))
               if (size(own%acceleration) /= size(other%acceleration) .or. abs(own%dt - other%dt) > 0.0_wp) cycle
               if (allocated(own%vertical) .neqv. allocated(other%vertical)) cycle
               if (any(abs(own%acceleration - other%acceleration) > 0.0_wp)) cycle
               if (allocated(own%vertical)) then
                  if (any(abs(own%vertical - other%vertical) > 0.0_wp)) cycle
               end if
               known = clusters(i)
               return
            end associate
         end do
      end associate
   end subroutine find_same_motion

   !> Label of a record: its earthquake, else the station and the date of its recording, else nothing
   pure subroutine cluster_label(metadata, label)
      !> Metadata of the record
      type(metadata_type), intent(in) :: metadata
      !> Label; empty if the metadata give none
      character(len=:), allocatable, intent(out) :: label

      character(len=:), allocatable :: date

      call find_earthquake(metadata, label)
      if (len(label) > 0 .or. len(metadata%get('station')) == 0) return
      call find_date(metadata, date)
      if (len(date) > 0) label = metadata%get('station')//' '//date
   end subroutine cluster_label

end module dondolo_record_clusters
