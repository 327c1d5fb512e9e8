!> What the caller, or the row of a catalogue, says of plain columns: `time`, `acceleration` or `other` for each of them, or `rows`
!> where values go along the rows; and the row to write where it must say so.
module dondolo_records_column_layout
   use dondolo_base_error, only : error_type, not_a_word, raise_input
   use dondolo_base_limits, only : most_columns
   use dondolo_base_plain, only : shown
   use dondolo_base_text, only : lower, to_text
   use dondolo_files_text_file, only : text_file_type
   use dondolo_records_format, only : given_type, raise_at
   implicit none
   private

   public :: layout_type, read_layout, raise_unclear
   public :: a_time, an_acceleration, another

   !> What a column is
   integer, parameter :: another = 0, a_time = 1, an_acceleration = 2

   !> Their words
   character(len=*), parameter :: words(0:2) = [character(len=12) :: 'other', 'time', 'acceleration']

   !> What is said of the columns
   type :: layout_type
      !> Is anything?
      logical :: is_given = .false.
      !> Do values go along the rows?
      logical :: is_rows = .false.
      !> Are step and units given as well, so that what stands above the values is passed over?
      logical :: passes = .false.
      !> What each column is
      integer, allocatable :: kinds(:)
   end type layout_type

contains

   !> Read what is said of the columns
   subroutine read_layout(given, layout, error)
      type(given_type), intent(in) :: given
      type(layout_type), intent(out) :: layout
      !> A word that is not known, no accelerations, or two times
      type(error_type), allocatable, intent(out) :: error

      character(len=:), allocatable :: rest
      integer :: kind, comma
      logical :: is_known

      allocate (layout%kinds(0))
      layout%is_given = len_trim(given%columns) > 0
      if (.not. layout%is_given) return
      layout%is_rows = lower(trim(adjustl(given%columns))) == 'rows'
      if (layout%is_rows) layout%kinds = [an_acceleration]
      rest = lower(given%columns)//','
      is_known = .true.
      do while (is_known .and. .not. layout%is_rows .and. len(rest) > 0)
         comma = index(rest, ',')
         kind = findloc(words == adjustl(rest(:comma - 1)), .true., dim=1) - 1
         is_known = kind >= 0 .and. size(layout%kinds) < most_columns
         layout%kinds = [layout%kinds, kind]
         rest = rest(comma + 1:)
      end do
      if (.not. is_known .or. count(layout%kinds == an_acceleration) == 0 .or. count(layout%kinds == a_time) > 1) then
         call raise_input(error, 'columns = '''//shown(given%columns)//''': must be ''rows'' for values along the rows, or '// &
            & '''time'', ''acceleration'' or ''other'' for each column, separated by commas, with one acceleration at '// &
            & 'least and at most one time', not_a_word, 'columns')
         return
      end if
      layout%passes = len_trim(given%units) > 0 .and. (allocated(given%dt) .or. any(layout%kinds == a_time))
   end subroutine read_layout

   !> Refuse what a file does not say clearly, with the row of a catalogue that says it
   subroutine raise_unclear(error, text, line, problem, given, columns)
      type(error_type), allocatable, intent(out) :: error
      type(text_file_type), intent(in) :: text
      !> Number of the line
      integer, intent(in) :: line
      !> What is not clear
      character(len=*), intent(in) :: problem
      type(given_type), intent(in) :: given
      !> Number of columns
      integer, intent(in) :: columns

      character(len=:), allocatable :: step, units, kinds

      step = 'STEP'
      if (allocated(given%dt)) step = to_text(given%dt)
      units = 'UNITS'
      if (len_trim(given%units) > 0) units = trim(given%units)
      kinds = 'acceleration'
      if (columns > 1) kinds = 'COLUMNS'
      if (columns == 2 .and. .not. allocated(given%dt)) then
         step = ''
         kinds = '"time, acceleration"'
      end if
      if (len_trim(given%columns) > 0) kinds = '"'//trim(given%columns)//'"'
      call raise_at(error, text, line, problem//': a row of a catalogue must say what the file holds, as ''file,dt_s,units,'// &
         & 'columns'' and '''//text%file(scan(text%file, '/\', back=.true.) + 1:)//','//step//','//units//','//kinds// &
         & '''; columns are rows where values go along the rows, else time, acceleration or other for each')
   end subroutine raise_unclear

end module dondolo_records_column_layout
