!> Files of the strong-motion toolkit of the Global Earthquake Model (.cor.acc): lines `key : value`, a line that names
!> quantity and units, then five values a line in columns of 14 characters that may touch.
module dondolo_records_format_smtk
   use dondolo_base_error, only : error_type
   use dondolo_base_plain, only : shown
   use dondolo_base_text, only : lower
   use dondolo_files_text_file, only : text_file_type
   use dondolo_records_header_fields, only : field_type, header_type
   use dondolo_records_labels, only : labels_type, read_labels
   use dondolo_records_format, only : block_type, raise_at, read_fixed, samples_type
   implicit none
   private

   public :: recognises_smtk, read_smtk

   !> Words between the quantity and its units
   character(len=*), parameter :: series = 'time series in '

   !> Most lines of a header
   integer, parameter :: most_lines = 40

   !> What the header says
   type(field_type), parameter :: fields(4) = [ &
      & field_type('date', 'Event Date & Time', 'dmy'), &
      & field_type('station', 'Station Code / Name', until='_/_'), &
      & field_type('component', 'Orientation'), &
      & field_type('processing', 'Processing Info')]

contains

   !> Is a text in this format? Its header states step and number, and a line names quantity and units
   logical function recognises_smtk(text) result(recognised)
      type(text_file_type), intent(in) :: text

      type(labels_type) :: labels

      call read_labels(text, 1, quantity_line(text), labels)
      recognised = labels%line_of('Time Increment (s)') > 0 .and. labels%line_of('Number of Data') > 0
   end function recognises_smtk

   !> Read a file
   subroutine read_smtk(text, samples, error)
      type(text_file_type), intent(in) :: text
      !> What it says
      type(samples_type), intent(out) :: samples
      !> What is wrong, with file and line
      type(error_type), allocatable, intent(out) :: error

      type(header_type) :: header
      character(len=:), allocatable :: line
      integer :: last, count, next

      last = quantity_line(text)
      call read_labels(text, 1, last, header%labels)
      line = trim(adjustl(text%line(last)))
      ! Some files spell it so: Accelaration
      if (index(lower(line), 'accel') /= 1) then
         call raise_at(error, text, max(last, 1), ''''//shown(line)//''': must be Acceleration '//series//'...')
         return
      end if
      allocate (samples%channels(1))
      associate (channel => samples%channels(1), labels => header%labels)
         call labels%get_positive(text, 'Time Increment (s)', channel%dt, error)
         if (.not. allocated(error)) call labels%get_count(text, 'Number of Data', count, error)
         if (allocated(error)) return
         channel%units = line(index(line, series) + len(series):)
         channel%name = labels%value_of('Orientation')
         channel%peak = labels%value_of('PGA (m/s/s)')
         channel%peak_units = 'm/s2'
         channel%peak_line = max(labels%line_of('PGA (m/s/s)'), 1)
         call read_fixed(text, block_type(last + 1, count, width=14, per_line=5), channel%values, error, next, samples%metadata)
         if (allocated(error)) return
         if (next <= text%lines()) then
            call raise_at(error, text, next, 'more values than the '// &
               & labels%value_of('Number of Data')//' that the header states')
            return
         end if
         call header%keep(text, fields, samples%metadata)
         call labels%add_to(samples%metadata)
      end associate
   end subroutine read_smtk

   !> Line that names quantity and units
   pure function quantity_line(text) result(line)
      type(text_file_type), intent(in) :: text
      !> Number of the line, 0 if there is none
      integer :: line

      do line = min(most_lines, text%lines()), 1, -1
         if (index(text%text(text%first(line):text%last(line)), series) > 0) exit
      end do
   end function quantity_line

end module dondolo_records_format_smtk
