!> Every reader of the library as test/attack calls it: many files in one process.
!>
!> With the argument `attack` the program answers lines `FAMILY PATH` of standard input, one line each: what the reader
!> made of the file, `read`, `refused`, or `UNSOUND` where it took something that cannot be. With `samples FOLDER` it
!> writes a small accelerogram of every format. Without arguments it checks that the answers can be told from each other.
program test_readers
   use, intrinsic :: ieee_arithmetic, only : ieee_is_finite
   use, intrinsic :: iso_fortran_env, only : input_unit, output_unit
   use archive_files, only : cosmos, cosmos_type, csmip, geonet, smc, with_crlf
   use checks, only : check, finish, suite
   use dondolo_base_error, only : error_type
   use dondolo_base_kinds, only : wp
   use dondolo_base_lines, only : lines_type
   use dondolo_base_text, only : to_text
   use dondolo_case, only : case_type
   use dondolo_case_read_case, only : read_case
   use dondolo_files_csv_row, only : cell_type
   use dondolo_files_number_table, only : read_number_table
   use dondolo_population_reader, only : read_population
   use dondolo_population_row_result, only : row_result_type
   use dondolo_population_store, only : look_into_store, store_type
   use dondolo_population_wall_row, only : wall_row_type
   use dondolo_record, only : largest_acceleration, record_type
   use dondolo_records_catalogue, only : read_catalogue
   use dondolo_records_record_reader, only : read_records
   use small_files, only : asa_content, columns_content, cwa_content, dyna_content, eqsig_content, knet_content, &
      & peer_content, smtk_content, write_file
   implicit none

   character(len=*), parameter :: scratch = 'build/test_readers'
   character(len=7) :: argument

   call get_command_argument(1, argument)
   if (argument == 'attack') then
      call answer_all()
   else if (argument == 'samples') then
      call write_samples()
   else
      call test_answers()
      call finish()
   end if

contains

   !> Answer the lines of standard input
   subroutine answer_all()
      character(len=4096) :: line
      character(len=:), allocatable :: said
      integer :: stat, blank

      do
         read (input_unit, '(a)', iostat=stat) line
         if (stat /= 0) exit
         blank = index(line, ' ')
         call answer(line(:blank - 1), trim(line(blank + 1:)), said)
         write (output_unit, '(a)') said
         flush (output_unit)
      end do
   end subroutine answer_all

   !> Write a small accelerogram of every format to the folder that the second argument names
   subroutine write_samples()
      character(len=*), parameter :: lf = new_line('a')

      call write_sample('peer', peer_content('Valley, 1/2/1990, Hall, 67', ''))
      call write_sample('dyna', dyna_content('STREAM: HNE'))
      call write_sample('smtk', smtk_content())
      call write_sample('knet', knet_content('N-S'))
      call write_sample('cwa', cwa_content())
      call write_sample('asa', asa_content('7'))
      call write_sample('eqsig', eqsig_content('7'))
      call write_sample('columns_1', columns_content('# remark: x'//lf//'t,acc x,acc y,acc z'//lf))
      call write_sample('columns_2', '0 1'//lf//'.01 2'//lf//'.02 -1.5'//lf)
      call write_sample('cosmos_1', cosmos(cosmos_type()))
      call write_sample('cosmos_2', cosmos(cosmos_type())//with_crlf(cosmos(cosmos_type(format='(1E15.6)'))))
      call write_sample('csmip_1', csmip('90 DEG', '13', '.02 SEC. (UNITS: CM/SEC/SEC)', '(8F10.3)', 10.0_wp))
      call write_sample('csmip_2', csmip('UP', '13', '.02 sec, in cm/sec2. (5f11.6)', '(5f11.6)', 0.1_wp))
      call write_sample('geonet', geonet('S16W', 13, 10.0_wp)//with_crlf(geonet('Up', 12, 10.0_wp)))
      call write_sample('smc_1', smc('2 CORRECTED ACCELEROGRAM', 13, 2))
      call write_sample('smc_2', smc('2 CORRECTED ACCELEROGRAM', 13, 0, 7))
   end subroutine write_samples

   !> Write a sample to the folder that the second argument names
   subroutine write_sample(name, content)
      character(len=*), intent(in) :: name, content
      character(len=4000) :: folder

      call get_command_argument(2, folder)
      call write_file(trim(folder)//'/'//name, content)
   end subroutine write_sample

   !> The answers to files that are right, wrong and missing
   subroutine test_answers()
      character(len=*), parameter :: families(*) = [character(len=9) :: 'records', 'numbers', 'walls', 'catalogue', 'case', &
         & 'store']
      character(len=:), allocatable :: said
      integer :: i

      call execute_command_line('mkdir -p '//scratch)
      call suite('answers')
      call write_file(scratch//'/peer', peer_content('Valley, 1/2/1990, Hall, 67', ''))
      call answer('records', scratch//'/peer', said)
      call check(said == 'read 1', said)
      call write_file(scratch//'/numbers', 'pga,annual_frequency'//new_line('a')//'0.1,0.01'//new_line('a')//'0.2,0.001')
      call answer('numbers', scratch//'/numbers', said)
      call check(said == 'read 4', said)
      call write_file(scratch//'/walls', 'mechanism,height,thickness'//new_line('a')//'one_sided,2,0.3')
      call answer('walls', scratch//'/walls', said)
      call check(said == 'read 1', said)
      call write_file(scratch//'/far', 'mechanism,height,thickness'//new_line('a')//'one_sided,2,0.3'//repeat(' ', 1000000)// &
         & char(233))
      call answer('walls', scratch//'/far', said)
      call check(index(said, 'byte 1000016 (E9) is not UTF-8') > 0, said)
      do i = 1, size(families)
         call answer(trim(families(i)), scratch//'/nothing', said)
         call check(index(said, 'refused ') == 1 .or. said == 'read 0', said)
         call write_file(scratch//'/wrong', char(0)//'&job')
         call answer(trim(families(i)), scratch//'/wrong', said)
         call check(index(said, 'refused ') == 1, said)
      end do
   end subroutine test_answers

   !> Read a file, and say what came of it
   subroutine answer(family, path, said)
      character(len=*), intent(in) :: family, path
      character(len=:), allocatable, intent(out) :: said
      type(error_type), allocatable :: error
      integer :: count
      logical :: is_sound

      count = 0
      is_sound = .true.
      select case (family)
      case ('records')
         call try_records(path, count, is_sound, error)
      case ('catalogue')
         call try_catalogue(path, count, is_sound, error)
      case ('walls')
         call try_walls(path, count, is_sound, error)
      case ('numbers')
         call try_numbers(path, count, is_sound, error)
      case ('case')
         call try_case(path, count, is_sound, error)
      case ('store')
         call try_store(path, count, is_sound, error)
      case default
         said = 'UNSOUND no such family'
         return
      end select
      if (allocated(error)) then
         said = 'refused '//on_one_line(error%message)
      else if (is_sound) then
         said = 'read '//to_text(count)
      else
         said = 'UNSOUND '//to_text(count)
      end if
   end subroutine answer

   !> Messages of several lines on one, with a bar between them
   function on_one_line(message)
      character(len=*), intent(in) :: message
      character(len=len(message)) :: on_one_line
      integer :: i

      on_one_line = message
      do i = 1, len(message)
         if (message(i:i) == new_line('a')) on_one_line(i:i) = '|'
      end do
   end function on_one_line

   !> Accelerograms, in the format that is recognised, with step and units where they are asked for
   subroutine try_records(path, count, is_sound, error)
      character(len=*), intent(in) :: path
      integer, intent(inout) :: count
      logical, intent(inout) :: is_sound
      type(error_type), allocatable, intent(out) :: error
      type(record_type), allocatable :: records(:)

      call read_records(path, records, error)
      if (allocated(error)) then
         if (index(error%message, 'must be given') > 0) call read_records(path, records, error, 0.01_wp, 'm/s2')
      end if
      if (allocated(error)) return
      count = size(records)
      is_sound = are_sound(records)
   end subroutine try_records

   !> Can these be accelerograms?
   pure logical function are_sound(records)
      type(record_type), intent(in) :: records(:)
      integer :: i

      are_sound = size(records) > 0
      do i = 1, size(records)
         are_sound = are_sound .and. records(i)%dt > 0.0_wp .and. size(records(i)%acceleration) > 1
         if (are_sound) are_sound = all(abs(records(i)%acceleration) <= largest_acceleration)
      end do
   end function are_sound

   !> A catalogue and its accelerograms
   subroutine try_catalogue(path, count, is_sound, error)
      character(len=*), intent(in) :: path
      integer, intent(inout) :: count
      logical, intent(inout) :: is_sound
      type(error_type), allocatable, intent(out) :: error
      type(record_type), allocatable :: records(:)
      character(len=:), allocatable :: note

      call read_catalogue(path, records, error, note)
      if (allocated(error)) return
      count = size(records)
      is_sound = are_sound(records)
   end subroutine try_catalogue

   !> A table of walls
   subroutine try_walls(path, count, is_sound, error)
      character(len=*), intent(in) :: path
      integer, intent(inout) :: count
      logical, intent(inout) :: is_sound
      type(error_type), allocatable, intent(out) :: error
      type(wall_row_type), allocatable :: rows(:)
      integer :: i

      call read_population(path, rows, error)
      if (allocated(error)) return
      count = size(rows)
      is_sound = count > 0
      do i = 1, count
         associate (wall => rows(i)%wall)
            is_sound = is_sound .and. wall%model%radius > 0.0_wp .and. wall%model%radius < huge(1.0_wp) &
               & .and. wall%model%alpha > 0.0_wp .and. wall%model%alpha < 1.6_wp .and. rows(i)%weight >= 0.0_wp &
               & .and. rows(i)%weight < huge(1.0_wp) &
               & .and. rows(i)%p_occ >= 0.0_wp .and. rows(i)%p_occ <= 1.0_wp .and. len(wall%name()) > 0
         end associate
      end do
   end subroutine try_walls

   !> A table of numbers
   subroutine try_numbers(path, count, is_sound, error)
      character(len=*), intent(in) :: path
      integer, intent(inout) :: count
      logical, intent(inout) :: is_sound
      type(error_type), allocatable, intent(out) :: error
      type(cell_type), allocatable :: columns(:)
      real(wp), allocatable :: values(:, :)
      character(len=:), allocatable :: note

      call read_number_table(path, columns, values, note, error)
      if (allocated(error)) return
      count = size(values)
      is_sound = size(columns) == size(values, 1) .and. all(ieee_is_finite(values))
   end subroutine try_numbers

   !> A case with all that it names
   subroutine try_case(path, count, is_sound, error)
      character(len=*), intent(in) :: path
      integer, intent(inout) :: count
      logical, intent(inout) :: is_sound
      type(error_type), allocatable, intent(out) :: error
      type(case_type) :: case
      type(lines_type) :: inputs

      call read_case(path, case, error)
      if (allocated(error)) return
      call case%inputs(inputs)
      count = inputs%count
      is_sound = count >= 2 .and. are_sound(case%suite%records)
      if (allocated(case%stripes%levels)) is_sound = is_sound .and. size(case%stripes%levels) > 0 .and. &
         & all(case%stripes%levels > 0.0_wp .and. ieee_is_finite(case%stripes%levels))
   end subroutine try_case

   !> A checkpoint: all rows that it has
   subroutine try_store(path, count, is_sound, error)
      character(len=*), intent(in) :: path
      integer, intent(inout) :: count
      logical, intent(inout) :: is_sound
      type(error_type), allocatable, intent(out) :: error
      type(store_type) :: store
      type(row_result_type) :: row
      logical :: exists
      integer :: i

      call look_into_store(store, path, exists, error)
      if (allocated(error) .or. .not. exists) return
      do i = store%identity%first, store%identity%last
         if (.not. store%has(i)) cycle
         call store%read(i, row, error)
         if (allocated(error)) exit
         count = count + 1
         associate (form => store%identity%shape)
            is_sound = is_sound .and. row%histories > 0 .and. all(shape(row%flags) == [row%histories, form%levels, form%states])
         end associate
      end do
      is_sound = is_sound .and. count == store%done
      call store%close()
   end subroutine try_store

end program test_readers
