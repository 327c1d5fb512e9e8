!> Files of the archives ITACA and ESM (DYNA 1.0 to 1.2, ITACA 1.1): lines `KEY: value`, then one value a line.
module dondolo_format_dyna
   use dondolo_error, only : error_type
   use dondolo_kinds, only : wp
   use dondolo_numbers, only : parse_real
   use dondolo_record_format, only : format_type, raise_at, read_block, samples_type
   use dondolo_text, only : lower, to_text
   use dondolo_text_file, only : text_file_type
   implicit none
   private

   public :: dyna_format_type

   !> The DYNA format
   type, extends(format_type) :: dyna_format_type
   contains
      !> Name of the format: one word in lower case
      procedure, nopass :: name
      !> Is a text in this format?
      procedure, nopass :: recognises
      !> Read a text in this format
      procedure, nopass :: read => read_dyna
   end type dyna_format_type

   !> Key of the largest value, in the units it names
   character(len=*), parameter :: peak_key = 'PGA_CM/S^2'

contains

   !> Name of the format: one word in lower case
   pure function name()
      !> Name
      character(len=:), allocatable :: name

      name = 'dyna'
   end function name

   !> Is a text in this format?
   function recognises(text) result(recognised)
      !> The file
      type(text_file_type), intent(in) :: text
      !> It begins with lines `KEY: value`, among them the sampling interval
      logical :: recognised

      recognised = line_of(text, 'SAMPLING_INTERVAL_S') > 0
   end function recognises

   !> Read a DYNA file
   subroutine read_dyna(text, samples, error)
      !> The file
      type(text_file_type), intent(in) :: text
      !> What it says
      type(samples_type), intent(out) :: samples
      !> What is wrong, with file and line
      type(error_type), allocatable, intent(out) :: error

      real(wp) :: count

      allocate (samples%channels(1))
      call check_quantity(text, error)
      if (allocated(error)) return
      associate (channel => samples%channels(1))
         call get_number(text, 'SAMPLING_INTERVAL_S', channel%dt, error)
         if (allocated(error)) return
         if (.not. channel%dt > 0.0_wp) then
            call raise_at(error, text, line_of(text, 'SAMPLING_INTERVAL_S'), 'SAMPLING_INTERVAL_S = '// &
               & to_text(channel%dt)//': must be positive')
            return
         end if
         call get_number(text, 'NDATA', count, error)
         if (allocated(error)) return
         if (.not. (count >= 1.0_wp .and. count <= real(huge(1), wp) .and. count == anint(count))) then
            call raise_at(error, text, line_of(text, 'NDATA'), 'NDATA = '//to_text(count)// &
               & ': must be a positive integer')
            return
         end if
         channel%units = value_of(text, 'UNITS')
         channel%peak = value_of(text, peak_key)
         channel%peak_units = 'cm/s2'
         channel%peak_line = line_of(text, peak_key)
         call read_block(text, header_lines(text) + 1, nint(count), channel%values, error)
      end associate
   end subroutine read_dyna

   !> The values must be accelerations
   subroutine check_quantity(text, error)
      !> The file
      type(text_file_type), intent(in) :: text
      !> They are something else, or the file does not say
      type(error_type), allocatable, intent(out) :: error

      integer :: line

      select case (lower(value_of(text, 'DATA_TYPE')))
      case ('acceleration', 'corrected acceleration', 'unprocessed acceleration')
      case default
         line = max(line_of(text, 'DATA_TYPE'), 1)
         call raise_at(error, text, line, 'DATA_TYPE = '''//value_of(text, 'DATA_TYPE')//''': must be ACCELERATION')
      end select
   end subroutine check_quantity

   !> Read a number of the header
   subroutine get_number(text, key, value, error)
      !> The file
      type(text_file_type), intent(in) :: text
      !> Key
      character(len=*), intent(in) :: key
      !> Its value
      real(wp), intent(out) :: value
      !> The key is missing or its value is no number
      type(error_type), allocatable, intent(out) :: error

      logical :: ok

      call parse_real(value_of(text, key), value, ok)
      if (.not. ok) then
         call raise_at(error, text, max(line_of(text, key), 1), key//' = '''//value_of(text, key)// &
            & ''': must be a number')
      end if
   end subroutine get_number

   !> Number of lines `KEY: value` at the top
   pure function header_lines(text) result(count)
      !> The file
      type(text_file_type), intent(in) :: text
      !> Number of lines before the first that holds no colon
      integer :: count

      do count = 0, text%lines() - 1
         if (index(text%text(text%first(count + 1):text%last(count + 1)), ':') == 0) exit
      end do
   end function header_lines

   !> Line of a key in the header
   pure function line_of(text, key) result(line)
      !> The file
      type(text_file_type), intent(in) :: text
      !> Key
      character(len=*), intent(in) :: key
      !> Number of the line, 0 if there is none
      integer :: line

      do line = header_lines(text), 1, -1
         if (index(text%line(line), key//':') == 1) exit
      end do
   end function line_of

   !> Value of a key in the header
   pure function value_of(text, key) result(value)
      !> The file
      type(text_file_type), intent(in) :: text
      !> Key
      character(len=*), intent(in) :: key
      !> Its value without blanks around it, empty if there is none
      character(len=:), allocatable :: value

      integer :: line

      value = ''
      line = line_of(text, key)
      if (line == 0) return
      value = text%line(line)
      value = trim(adjustl(value(len(key) + 2:)))
   end function value_of

end module dondolo_format_dyna
