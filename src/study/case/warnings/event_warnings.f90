!> Warnings of what records say of their earthquakes: none, or a date that cannot be read.
module dondolo_case_event_warnings
   use dondolo_base_text, only : to_text
   use dondolo_base_warning, only : warning_type, warnings_type
   use dondolo_record_suite, only : suite_type
   use dondolo_records_days, only : stated_date
   implicit none
   private

   public :: warn_of_events

   !> Codes
   character(len=*), parameter :: records_without_event = 'records_without_event', records_unread_date = 'records_unread_date'

contains

   !> Warn of records whose earthquake is not known, which standard errors therefore take as independent, and of dates
   subroutine warn_of_events(suite, warnings)
      type(suite_type), intent(in) :: suite
      !> Warnings to add to
      type(warnings_type), intent(inout) :: warnings

      type(warning_type) :: warning

      call warn_of_dates(suite, warnings)
      if (all(suite%has_event) .or. maxval(suite%clusters) == 1) return
      associate (first => suite%records(findloc(suite%has_event, .false., dim=1)), beyond => count(.not. suite%has_event), &
         & records => size(suite%records))
         warning = warning_type(records_without_event)
         call warning%about('record', first%name)
         call warning%with('records_beyond', beyond)
         call warning%with('records', records)
         call warnings%add(warning, 'no event is given for '//to_text(beyond)//' of '//to_text(records)//' records '// &
            & '(the first is '''//first%name//'''): standard errors treat them as independent, and are too small if several '// &
            & 'belong to one earthquake; name it in the column event of the catalogue, or the metadata')
      end associate
   end subroutine warn_of_events

   !> Warn of dates that cannot be compared with others of the same event, which is therefore taken for one earthquake
   subroutine warn_of_dates(suite, warnings)
      type(suite_type), intent(in) :: suite
      !> Warnings to add to
      type(warnings_type), intent(inout) :: warnings

      type(warning_type) :: warning
      character(len=:), allocatable :: date
      integer :: first, beyond

      beyond = count(suite%has_vague_date)
      if (beyond == 0) return
      first = findloc(suite%has_vague_date, .true., dim=1)
      call stated_date(suite%records(first)%metadata, date)
      warning = warning_type(records_unread_date)
      call warning%about('record', suite%records(first)%name)
      call warning%with('records_beyond', beyond)
      call warning%with('records', size(suite%records))
      call warnings%add(warning, 'record '''//suite%records(first)%name//''': its date '''//date//''' cannot be compared with '// &
         & 'those of other records of its event, which is taken for one earthquake ('//to_text(beyond)//' of '// &
         & to_text(size(suite%records))//' records): must be such as 1976-05-06')
   end subroutine warn_of_dates

end module dondolo_case_event_warnings
