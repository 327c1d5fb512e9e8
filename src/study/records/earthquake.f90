!> Which earthquake a record is of, and when: what its metadata say of it, where that can be relied on.
!>
!> The only place where `event` and `date` are judged, for the headers of all formats, for catalogues and for Python. An
!> earthquake without a name is known by its origin: records that state the same time and epicentre are of one.
module dondolo_records_earthquake
   use dondolo_base_kinds, only : wp
   use dondolo_base_numbers, only : parse_real
   use dondolo_base_text, only : to_text
   use dondolo_record_metadata, only : metadata_type
   use dondolo_records_dates, only : find_moment, make_stamp
   use dondolo_records_days, only : days_type, find_days, stated_date
   use dondolo_records_event_name, only : clean_event
   implicit none
   private

   public :: find_date, find_difference, find_earthquake, settle_labels

   !> Parts of a degree that epicentres are compared in
   real(wp), parameter :: parts = 1000.0_wp

contains

   !> Keep the event and the date of a record where they are such, and what else was stated under other keys
   pure subroutine settle_labels(metadata)
      !> Metadata of a record, with `event time`, `event latitude` and `event longitude` where its header states the origin
      type(metadata_type), intent(inout) :: metadata

      character(len=:), allocatable :: found

      call find_earthquake(metadata, found)
      call settle(metadata, 'event', found)
      call find_date(metadata, found)
      call settle(metadata, 'date', found)
   end subroutine settle_labels

   !> Keep a label
   pure subroutine settle(metadata, key, label)
      !> Metadata of the record
      type(metadata_type), intent(inout) :: metadata
      !> Key of the label, and what it is; empty: not known
      character(len=*), intent(in) :: key, label

      character(len=:), allocatable :: stated

      stated = metadata%get(key)
      if (len(label) > 0) then
         call metadata%set(key, label)
      else
         call metadata%set('stated '//key, stated)
         call metadata%remove(key)
      end if
   end subroutine settle

   !> The earthquake of a record: its name, or its origin
   pure subroutine find_earthquake(metadata, earthquake)
      !> Metadata of the record
      type(metadata_type), intent(in) :: metadata
      !> Label; empty if neither is known
      character(len=:), allocatable, intent(out) :: earthquake

      character(len=:), allocatable :: moment, stamp, place
      real(wp) :: latitude, longitude
      logical :: ok(2)

      call clean_event(metadata%get('event'), earthquake)
      if (len(earthquake) > 0) return
      call find_moment(metadata%get('event time'), '', moment)
      call make_stamp(moment, stamp)
      call parse_real(metadata%get('event latitude'), latitude, ok(1))
      call parse_real(metadata%get('event longitude'), longitude, ok(2))
      if (len(stamp) == 0 .or. .not. all(ok)) return
      ! A pair of zeros is no epicentre, but a blank of a table
      if (abs(latitude) > 90.0_wp .or. abs(longitude) > 360.0_wp .or. .not. abs(latitude) + abs(longitude) > 0.0_wp) return
      call write_degrees(latitude, 'NS', place)
      earthquake = stamp//' '//place
      call write_degrees(longitude, 'EW', place)
      earthquake = earthquake//' '//place
   end subroutine find_earthquake

   !> The date of a record, as ISO 8601 has it
   pure subroutine find_date(metadata, date)
      !> Metadata of the record
      type(metadata_type), intent(in) :: metadata
      !> Date, and time if it is known; empty if there is no date
      character(len=:), allocatable, intent(out) :: date

      character(len=:), allocatable :: moment

      call find_moment(metadata%get('date'), '', date)
      if (len(date) > 0) return
      ! 03/04/2009 is a date, whichever of the two is the month: it is left as it is written
      call find_moment(metadata%get('date'), 'dmy', moment)
      if (len(moment) > 0) date = metadata%get('date')
   end subroutine find_date

   !> Find what two records differ in that are to be components of one motion: their station, their date or their earthquake
   pure subroutine find_difference(first, second, key, one, other)
      !> Metadata of the two
      type(metadata_type), intent(in) :: first, second
      !> The key, and its two values; empty where all that both know is the same
      character(len=:), allocatable, intent(out) :: key, one, other

      type(days_type) :: days(2)

      key = 'station'
      one = first%get(key)
      other = second%get(key)
      if (are_different()) return
      key = 'date'
      call find_date(first, one)
      call find_date(second, other)
      if (are_different()) return
      call stated_date(first, one)
      call stated_date(second, other)
      call find_days(one, days(1))
      call find_days(other, days(2))
      if (.not. days(1)%may_be(days(2))) return
      key = 'event'
      call find_earthquake(first, one)
      call find_earthquake(second, other)
      if (are_different()) return
      key = ''
      one = ''
      other = ''

   contains

      !> Are the two values known, and not the same?
      pure logical function are_different()
         are_different = len(one) > 0 .and. len(other) > 0 .and. one /= other
      end function are_different

   end subroutine find_difference

   !> A coordinate with the side that it lies on
   pure subroutine write_degrees(angle, sides, text)
      !> Angle [degrees]
      real(wp), intent(in) :: angle
      !> Letters of the positive and the negative side
      character(len=2), intent(in) :: sides
      !> 35.785N
      character(len=:), allocatable, intent(out) :: text

      integer :: side

      side = merge(2, 1, angle < 0.0_wp)
      text = to_text(anint(parts*abs(angle))/parts)//sides(side:side)
   end subroutine write_degrees

end module dondolo_records_earthquake
