!> Texts that several threads make at once are those that one alone makes: no length of a text is shared.
!>
!> DONDOLO_SENTENCES is the number of texts, 1e5 if it is not set. Compiled with -fsanitize=thread the program also shows
!> races that happen not to spoil a text.
program test_sentences
   use checks, only : check, finish, suite
   use dondolo_base_error, only : error_type
   use dondolo_base_kinds, only : wp
   use dondolo_base_lines, only : lines_type
   use dondolo_base_numbers, only : parse_integer
   use dondolo_base_plain, only : shown
   use dondolo_base_text, only : counted, first_word, join, rounded, stripped, to_table, to_text
   use dondolo_files_text_file, only : text_file_type
   use dondolo_fragility_scaling, only : new_scaling, scaling_type
   use dondolo_record, only : new_record, record_type
   use dondolo_record_intensity, only : measure_type, new_measure
   use dondolo_record_metadata, only : metadata_type
   use dondolo_records_dates, only : find_moment
   use dondolo_records_formats, only : find_format, format_type
   use dondolo_records_header_text, only : after, before, leading_number, squeezed
   use dondolo_records_units, only : unit_factor
   implicit none

   integer, parameter :: threads = 8, kinds = 10, sizes = 12
   type(lines_type) :: right
   character(len=:), allocatable :: text
   character(len=16) :: wanted
   integer :: i, k, number, stat, wrong
   logical :: ok

   call suite('sentences')
   number = 100000
   call get_environment_variable('DONDOLO_SENTENCES', wanted, status=stat)
   if (stat == 0) call parse_integer(wanted, number, ok)
   do k = 1, kinds*sizes
      call make(k, text)
      call right%add(text)
   end do
   wrong = 0
   !$omp parallel do num_threads(threads) schedule(static) reduction(+ : wrong)
   do i = 1, number
      if (.not. is_whole(modulo(i, kinds*sizes) + 1)) wrong = wrong + 1
   end do
   !$omp end parallel do
   call check(wrong == 0, to_text(wrong)//' of '//to_text(number)//' texts of '//to_text(threads)//' threads are not whole')
   call finish()

contains

   !> Is a text the one that was made alone? Here, since a private text of OpenMP shares its length (gfortran 12)
   logical function is_whole(k)
      !> Which
      integer, intent(in) :: k

      character(len=:), allocatable :: text

      call make(k, text)
      is_whole = len(text) == len(right%line(k)%text)
      if (is_whole) is_whole = text == right%line(k)%text
   end function is_whole

   !> Make a text
   subroutine make(k, text)
      !> Which
      integer, intent(in) :: k
      !> The text
      character(len=:), allocatable, intent(out) :: text

      type(error_type), allocatable :: error
      type(format_type) :: format
      type(measure_type) :: measure
      type(metadata_type) :: metadata
      type(record_type) :: record
      type(scaling_type) :: scaling
      type(text_file_type) :: file
      character(len=:), allocatable :: moment
      real(wp) :: small, factor
      integer :: n

      n = (k - 1)/kinds + 1
      small = 10.0_wp**(-n)
      text = ''
      select case (modulo(k, kinds))
      case (0)
         call new_record(record, [0.0_wp, 1.0_wp], -small, 'a record', error)
      case (1)
         call unit_factor(repeat('x', n), factor, error)
      case (2)
         call new_measure(measure, 'pga'//repeat('x', n), error)
      case (3)
         call find_format('peer'//repeat('x', n), format, error)
      case (4)
         call new_scaling(scaling, 'sa('//to_text(20.0_wp + small)//')', error)
      case (5)
         file%file = repeat('f', n)
         file%text = 'a short line'//repeat(' longer', n)
         file%first = [1, 3]
         file%last = [1, len(file%text)]
         text = file%place(n)//': '//file%line(2)//file%line(3)//shown(repeat('y', 10*n))
      case (6)
         text = to_table(small)//' '//rounded(1.23456_wp*small)//' '//to_text(10**min(n, 9))//' '// &
            & first_word(repeat('w', n)//' next', ' ')//stripped(repeat(' ', n)//'s ')//counted(n, 'thread')
      case (7)
         call metadata%set('key', repeat('v', n))
         text = metadata%get('key')//metadata%get('none')//join(['a ', 'bc'])
      case (8)
         call find_moment(repeat(' ', n)//'06/16/2005, 20:53:26.1 UTC', 'mdy', moment)
         text = moment//after('Label:'//repeat('x', n), 'label:')//before(repeat('y', n)//'(', '(')// &
            & squeezed(repeat('z  ', n))//leading_number(repeat('1', min(n, 9))//'N')
      case (9)
         call new_record(record, [0.0_wp, 100.0_wp*real(n, wp)], 0.01_wp, repeat('r', n), error)
         call new_scaling(scaling, 'saavg(0.1:'//to_text(real(n, wp))//')', error)
         text = scaling%title()//scaling%unit_after_blank()
      end select
      if (allocated(error)) text = error%message
   end subroutine make

end program test_sentences
