!> Text files of the Python package eqsig: a line with a label, a line with count and time step, then one value a line.
!> The label may state what a line above plain columns may.
module dondolo_records_format_eqsig
   use dondolo_base_error, only : error_type
   use dondolo_base_kinds, only : wp
   use dondolo_base_numbers, only : parse_integer, parse_real
   use dondolo_base_plain, only : shown
   use dondolo_base_text, only : blanks, first_word
   use dondolo_files_text_file, only : text_file_type
   use dondolo_records_column_statements, only : statements_type
   use dondolo_records_format, only : given_type, raise_at, read_block, samples_type
   implicit none
   private

   public :: recognises_eqsig, read_eqsig

contains

   !> Is a text in this format? The first line is a label and no number, the second holds count and step, the third a
   !> single number
   logical function recognises_eqsig(text) result(recognised)
      type(text_file_type), intent(in) :: text

      real(wp) :: value, dt
      integer :: count
      logical :: ok

      recognised = .false.
      if (text%lines() < 3) return
      call parse_real(first_word(text%line(1), blanks//',;'), value, ok)
      if (ok) return
      call read_count(text%line(2), count, dt, ok)
      if (.not. ok) return
      call parse_real(text%line(3), value, recognised)
   end function recognises_eqsig

   !> Read a file
   subroutine read_eqsig(text, samples, error)
      type(text_file_type), intent(in) :: text
      !> What it says
      type(samples_type), intent(out) :: samples
      !> What is wrong, with file and line
      type(error_type), allocatable, intent(out) :: error

      type(given_type) :: given
      type(statements_type) :: label
      integer :: count
      logical :: ok

      given%units = ''
      given%columns = ''
      call label%take(text, 1, text%line(1), given, 1, error)
      if (.not. allocated(error) .and. label%other_line > 0) call raise_at(error, text, 1, ''''//shown(label%other)// &
         & ''' is not an acceleration')
      if (allocated(error)) return
      allocate (samples%channels(1))
      if (label%units_line > 0) samples%channels(1)%units = label%units
      call read_count(text%line(2), count, samples%channels(1)%dt, ok)
      if (.not. ok) then
         call raise_at(error, text, min(2, text%lines()), ''''//shown(trim(text%line(2)))// &
            & ''': must be the number of values and their step, both positive')
         return
      end if
      call label%take_count(text, 2, count, error)
      if (.not. allocated(error)) call label%take_step(text, 2, samples%channels(1)%dt, error)
      if (allocated(error)) return
      call read_block(text, 3, count, samples%channels(1)%values, error, samples%metadata)
      call samples%metadata%set('label', text%line(1))
   end subroutine read_eqsig

   !> Find count and time step in the second line
   subroutine read_count(line, count, dt, ok)
      !> The line
      character(len=*), intent(in) :: line
      !> Number of values
      integer, intent(out) :: count
      !> Time step [s]
      real(wp), intent(out) :: dt
      !> It holds the two and no more, and they are positive
      logical, intent(out) :: ok

      character(len=:), allocatable :: word

      word = first_word(line, blanks)
      dt = 0.0_wp
      call parse_integer(word, count, ok)
      if (ok) call parse_real(line(index(line, word) + len(word):), dt, ok)
      if (ok) ok = count > 0 .and. dt > 0.0_wp
   end subroutine read_count

end module dondolo_records_format_eqsig
