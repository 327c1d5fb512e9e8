!> Which records belong together: those of one earthquake are no independent evidence.
!>
!> Earthquakes of one name are told apart by their dates: a valley may have several. Dates of one earthquake may differ by a day, as
!> one header has the local time and another that of Greenwich. A date may be any of several days (dondolo_records_days).
module dondolo_records_clusters
   use dondolo_base_kinds, only : wp
   use dondolo_base_lines, only : lines_type
   use dondolo_files_name_index, only : name_index_type
   use dondolo_record, only : record_type
   use dondolo_record_metadata, only : metadata_type
   use dondolo_record_suite, only : new_suite, suite_type
   use dondolo_records_dates, only : day_number
   use dondolo_records_days, only : days_type, find_days, stated_date
   use dondolo_records_direction, only : is_vertical
   use dondolo_records_earthquake, only : find_date, find_earthquake
   implicit none
   private

   public :: gather_suite, cluster_records, cluster_label

contains

   !> Make a suite of accelerograms, and cluster them by what their metadata say
   subroutine gather_suite(suite, records, threads)
      type(suite_type), intent(out) :: suite
      !> Accelerograms, one at least; they are moved into the suite
      type(record_type), allocatable, intent(inout) :: records(:)
      !> Number of threads that join them, 0: all that OpenMP gives; one if absent
      integer, intent(in), optional :: threads

      character(len=:), allocatable :: earthquake
      integer :: i

      call new_suite(suite, records, threads)
      do i = 1, size(suite%records)
         call find_earthquake(suite%records(i)%metadata, earthquake)
         suite%has_event(i) = len(earthquake) > 0
      end do
      call cluster_records(suite%records, suite%clusters, suite%labels)
      do i = 1, size(suite%records)
         suite%is_vertical(i) = is_vertical(suite%records(i)%metadata, suite%records(i)%name)
         if (suite%has_event(i)) suite%has_vague_date(i) = cannot_be_compared(suite, i)
      end do
   end subroutine gather_suite

   !> Has a record a date that cannot be read, and another one of its cluster another date?
   logical function cannot_be_compared(suite, number)
      type(suite_type), intent(in) :: suite
      !> Number of the record
      integer, intent(in) :: number

      type(days_type) :: days
      character(len=:), allocatable :: date, other
      integer :: k

      cannot_be_compared = .false.
      call stated_date(suite%records(number)%metadata, date)
      call find_days(date, days)
      if (len(date) == 0 .or. days%count > 0) return
      do k = 1, size(suite%records)
         if (suite%clusters(k) /= suite%clusters(number)) cycle
         call stated_date(suite%records(k)%metadata, other)
         cannot_be_compared = len(other) > 0 .and. other /= date
         if (cannot_be_compared) return
      end do
   end function cannot_be_compared

   !> Number the clusters of records, from 1 in the order in which they appear. A record without a label is one by itself, with
   !> those that are the same motion
   subroutine cluster_records(records, clusters, labels)
      type(record_type), intent(in) :: records(:)
      !> Number of the cluster of each
      integer, intent(out) :: clusters(:)
      !> Label of the cluster of each, with the date of its earthquake after that of an earlier one of the same name; empty if there
      !> is none
      type(lines_type), intent(out) :: labels

      type(name_index_type) :: known_labels
      character(len=:), allocatable :: label, date, day
      ! Of each cluster its first record, the days that it may be of, and the next cluster of the same name
      integer :: first(size(records)), next(size(records))
      type(days_type) :: days(size(records)), own
      integer :: i, known, count

      count = 0
      first = 0
      next = 0
      do i = 1, size(records)
         call cluster_label(records(i)%metadata, label)
         call stated_date(records(i)%metadata, date)
         call find_days(date, own)
         known = 0
         if (len(label) > 0) then
            call known_labels%note(label, count + 1, known)
            if (known > 0) call find_same_day(days, next, own, known)
            if (known < 0) then
               next(-known) = count + 1
               known = 0
               call find_date(records(i)%metadata, day)
               if (len(day) == 0) day = date
               if (day_number(day) > 0) day = day(:10)
               label = label//' '//day
            end if
         else
            call find_same_motion(records, clusters, i, known)
         end if
         if (known == 0) then
            count = count + 1
            known = count
            first(count) = i
         end if
         if (own%count > 0 .and. (days(known)%count == 0 .or. own%length() < days(known)%length())) days(known) = own
         clusters(i) = known
         if (len(label) > 0 .and. first(known) < i) label = labels%line(first(known))%text
         call labels%add(label)
      end do
   end subroutine cluster_records

   !> Among the clusters of one name that of a day
   pure subroutine find_same_day(days, next, own, known)
      !> Days of each cluster, and the next one of the same name, 0 for the last
      type(days_type), intent(in) :: days(:)
      integer, intent(in) :: next(:)
      !> The days
      type(days_type), intent(in) :: own
      !> First cluster of the name; out: that of the days, or the last one with a minus if none is
      integer, intent(inout) :: known

      do
         if (own%may_be(days(known))) return
         if (next(known) == 0) exit
         known = next(known)
      end do
      known = -known
   end subroutine find_same_day

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

end module dondolo_records_clusters
