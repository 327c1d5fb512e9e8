!> Which format takes which file, and damaged files of every format.
program test_damaged_files
   use checks, only : check, check_error, check_ok, check_text, finish, suite
   use dondolo_base_error, only : error_type
   use dondolo_base_kinds, only : wp
   use dondolo_base_text, only : to_text
   use dondolo_record, only : largest_acceleration, record_type
   use dondolo_records_record_reader, only : read_records
   use small_files, only : list_contents, sample_type, smtk_content, write_file
   implicit none

   character(len=*), parameter :: scratch = 'build/test_damaged_files'
   character(len=*), parameter :: cr = achar(13), lf = achar(10)

   call execute_command_line('mkdir -p '//scratch)
   call test_format_given()
   call test_damaged()
   call finish()

contains

   !> A format that is named
   subroutine test_format_given()
      type(sample_type), allocatable :: all(:)
      type(record_type), allocatable :: records(:)
      type(error_type), allocatable :: error
      integer :: i, k

      call suite('format given')
      call list_contents(all)
      do i = 1, size(all)
         call write_file(scratch//'/content.dat', all(i)%content)
         do k = 1, size(all)
            call read_records(scratch//'/content.dat', records, error, format=all(k)%format)
            if (allocated(error)) then
               if (index(error%message, 'must be given') > 0) call read_records(scratch//'/content.dat', records, &
                  & error, units='g', format=all(k)%format)
            end if
            if (i == k .or. all(i)%format == all(k)%format) then
               call check_ok(error, all(i)%format//' as itself')
            else if (all(k)%format == 'columns' .and. all(i)%format == 'eqsig') then
               ! Its header is a line of words, and one of count and step, to the other
               call check(.not. allocated(error), all(i)%format//' as columns')
            else
               call check(allocated(error), all(i)%format//' as '//all(k)%format//' is refused')
            end if
         end do
         call read_records(scratch//'/content.dat', records, error)
         if (allocated(error)) call read_records(scratch//'/content.dat', records, error, units='g')
         call check_ok(error, all(i)%format//' is recognised')
         if (.not. allocated(error)) call check_text( &
            & records(1)%metadata%get('format'), all(i)%format, 'format')
      end do
      call read_records(scratch//'/content.dat', records, error, format='EQSIG', units='g')
      call check_error(error, '# Origin Time, 2031/12/31 23:59:00'' is no statement that is read', 'upper case')
      call read_records(scratch//'/content.dat', records, error, format='excel')
      call check_error(error, 'content.dat: format = ''excel'': must be one of ''peer'', ''dyna''', 'no such format')
      call write_file(scratch//'/content.dat', 'SAMPLING_INTERVAL_S: 0.01'//lf//smtk_content())
      call read_records(scratch//'/content.dat', records, error)
      call check_error(error, 'may be in the format ''dyna'', ''smtk'': format must name one of them', 'two formats')
   end subroutine test_format_given

   !> Damaged files give a record or an error: DONDOLO_FUZZ says how many, 400 if it is not set
   subroutine test_damaged()
      type(sample_type), allocatable :: all(:)
      type(record_type), allocatable :: records(:)
      type(error_type), allocatable :: error
      character(len=:), allocatable :: content
      character(len=16) :: setting
      integer :: i, k, cases, state, wrong, read_anyway, stat

      call suite('damaged files')
      call get_environment_variable('DONDOLO_FUZZ', setting)
      read (setting, *, iostat=stat) cases
      if (stat /= 0) cases = 400
      call list_contents(all)
      state = 20241105
      wrong = 0
      read_anyway = 0
      do i = 1, cases
         content = damaged(all(modulo(i, size(all)) + 1)%content, all(modulo(3*i, size(all)) + 1)%content, state)
         call write_file(scratch//'/damaged.dat', content)
         do k = 0, size(all)
            if (k == 0) then
               call read_records(scratch//'/damaged.dat', records, error)
               if (allocated(error)) then
                  if (index(error%message, 'must be given') > 0) call read_records(scratch//'/damaged.dat', records, &
                     & error, 0.01_wp, 'm/s2')
               end if
            else
               call read_records(scratch//'/damaged.dat', records, error, units='g', format=all(k)%format)
            end if
            if (is_sound(records, error)) then
               if (.not. allocated(error)) read_anyway = read_anyway + 1
               cycle
            end if
            wrong = wrong + 1
            call write_file(scratch//'/wrong.dat', content)
         end do
      end do
      call check(wrong == 0, to_text(wrong)//' readings of '//to_text(cases)// &
         & ' damaged files give no record and no error')
      call check(read_anyway > cases/20, 'some damaged files can be read: '//to_text(read_anyway))
   end subroutine test_damaged

   !> Either records that can be, or an error that names the file
   function is_sound(records, error)
      type(record_type), allocatable, intent(in) :: records(:)
      type(error_type), allocatable, intent(in) :: error
      logical :: is_sound
      integer :: i

      if (allocated(error)) then
         is_sound = .not. allocated(records) .and. index(error%message, scratch//'/damaged.dat: ') == 1
         return
      end if
      is_sound = allocated(records)
      if (.not. is_sound) return
      is_sound = size(records) > 0
      do i = 1, size(records)
         is_sound = is_sound .and. records(i)%dt > 0.0_wp .and. size(records(i)%acceleration) > 1
         if (is_sound) is_sound = all(abs(records(i)%acceleration) <= largest_acceleration)
      end do
   end function is_sound

   !> Damage a content: cut, flip bits, drop, double, insert, mix with another
   function damaged(content, other, state) result(changed)
      character(len=*), intent(in) :: content, other
      integer, intent(inout) :: state
      character(len=:), allocatable :: changed
      character(len=*), parameter :: odd = '-+.eE*,;:#/() '//achar(9)//lf//cr//achar(0)//char(255)//'0179nN'
      integer :: steps, i, at, length, to

      changed = content
      steps = 1 + random_below(state, 3)
      do i = 1, steps
         if (len(changed) < 2) return
         at = 1 + random_below(state, len(changed))
         length = min(random_below(state, 40), len(changed) - at)
         select case (random_below(state, 9))
         case (0)
            changed = changed(:at)
         case (1)
            changed(at:at) = achar(ieor(iachar(changed(at:at)), ishft(1, random_below(state, 8))))
         case (2)
            changed = changed(:at - 1)//changed(at + length:)
         case (3)
            changed = changed(:at + length)//changed(at:)
         case (4)
            to = 1 + random_below(state, len(odd))
            changed = changed(:at - 1)//odd(to:to)//changed(at:)
         case (5)
            to = 1 + random_below(state, len(odd))
            changed(at:at) = odd(to:to)
         case (6)
            to = min(at, len(other))
            changed = changed(:at)//other(to:)
         case (7)
            changed = changed(:at - 1)//repeat('9', 1 + random_below(state, 25))//changed(at:)
         case (8)
            do to = at, at + length
               changed(to:to) = achar(random_below(state, 256))
            end do
         end select
      end do
   end function damaged

   !> A random integer from 0 to below a bound (Lehmer's generator of Park and Miller, 1988)
   function random_below(state, bound) result(number)
      integer, intent(inout) :: state
      integer, intent(in) :: bound
      integer :: number
      integer, parameter :: long = selected_int_kind(18)

      state = int(modulo(int(state, long)*48271_long, 2147483647_long))
      number = modulo(state/11, bound)
   end function random_below

end program test_damaged_files
