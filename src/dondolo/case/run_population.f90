!> A population, from its table to its curves, within a memory that does not depend on the number of its walls.
!>
!> Blocks of rows are read, run, and their counts appended to a file. When that is complete the curves are made of it
!> (dondolo_combine_rows). A run that was killed goes on with the file that it left; files that hold parts of the
!> population are taken together.
module dondolo_run_population
   use dondolo_case, only : case_type
   use dondolo_combine_rows, only : combine_rows
   use dondolo_counts, only : counts_type, shape_type
   use dondolo_counts_file, only : append_counts, counts_file_type, counts_key_type, create_counts, inspect_counts
   use dondolo_error, only : error_type, raise_failure, raise_input
   use dondolo_fingerprint, only : fingerprint_type
   use dondolo_kinds, only : wp
   use dondolo_lane_variants, only : build_variant
   use dondolo_lines, only : lines_type
   use dondolo_population, only : member_type, population_reader_type
   use dondolo_queue, only : progress_interface
   use dondolo_result_files, only : make_folders
   use dondolo_results, only : results_type
   use dondolo_run_rows, only : run_rows
   use dondolo_settings, only : group_settings_type
   use dondolo_settings_key, only : add_settings
   use dondolo_study, only : study_type
   use dondolo_survey, only : check_size, fingerprint_lines, number_of_group
   use dondolo_system, only : cut_file, remove_file
   use dondolo_text, only : to_text
   use dondolo_threads, only : team_of
   use dondolo_version, only : dondolo_version_text
   use dondolo_work, only : work_type
   implicit none
   private

   public :: run_population, merge_population, find_start, counts_path

   !> Histories that a block has for each thread: a second or two of work, which is what a run that is killed loses
   integer, parameter :: histories_of_thread = 100000

   !> Rows that it has for each thread at most: about 1 kB each
   integer, parameter :: rows_of_thread = 4000

contains

   !> Run the rows of a population that the case asks for, or those that an earlier run has left
   subroutine run_population(case, results, error, team, progress)
      !> The case
      type(case_type), intent(in) :: case
      !> Its results
      type(results_type), intent(inout) :: results
      !> What cannot be run
      type(error_type), allocatable, intent(out) :: error
      !> Number of threads; 0: all
      integer, intent(in) :: team
      !> Hears how far the work is
      procedure(progress_interface), optional :: progress

      type(counts_file_type) :: file

      call check_size(case%population_path(), case%survey%histories, error)
      if (.not. allocated(error)) call start(case, file, results%resumed, error)
      if (.not. allocated(error)) call run_blocks(case, file, error, team, progress)
      if (allocated(error)) return
      allocate (results%counts%files(1))
      results%counts%files(1) = file
      results%work = file%work
      if (.not. case%survey%is_part) call combine_rows(case, results, error)
   end subroutine run_population

   !> Take the files that hold the parts of a population together
   subroutine merge_population(case, paths, results, error)
      !> The case
      type(case_type), intent(in) :: case
      !> Paths of the files, in any order
      type(lines_type), intent(in) :: paths
      !> Results: counts, work, curves and warnings
      type(results_type), intent(out) :: results
      !> The case has no population, a file is none of this case or not complete, rows are missing or stand in two
      !> files, or they cannot be combined
      type(error_type), allocatable, intent(out) :: error

      type(counts_file_type), allocatable :: files(:)
      type(counts_key_type) :: key
      logical, allocatable :: is_left(:)
      integer :: i, j, done
      logical :: exists

      if (case%job%task /= 'typology') then
         call raise_input(error, '--merge: only for task = ''typology''')
         return
      end if
      allocate (files(paths%count))
      key = key_of(case)
      do i = 1, size(files)
         call inspect_counts(paths%line(i)%text, files(i), exists, error)
         if (allocated(error)) return
         if (.not. exists) then
            call raise_input(error, paths%line(i)%text//': no such file, or nothing in it')
            return
         end if
         if (i == 1) key%variant = files(1)%key%variant
         call check_key(files(i), key, error)
         if (allocated(error)) return
         if (files(i)%done < files(i)%last) then
            call raise_input(error, files(i)%path//': is whole to row '//to_text(files(i)%done)//', its last is '// &
               & to_text(files(i)%last)//': run it again to complete it')
            return
         end if
      end do
      done = 0
      is_left = spread(.true., 1, size(files))
      allocate (results%counts%files(size(files)))
      do i = 1, size(files)
         j = minloc(files%first, dim=1, mask=is_left)
         if (files(j)%first > done + 1) exit
         if (files(j)%first <= done) then
            call raise_input(error, files(j)%path//': row '//to_text(files(j)%first)//' stands in another file too')
            return
         end if
         is_left(j) = .false.
         results%counts%files(i) = files(j)
         done = files(j)%last
         call results%work%add(files(j)%work)
      end do
      if (done < case%survey%rows) then
         call raise_input(error, '--merge: row '//to_text(done + 1)//' of '//to_text(case%survey%rows)// &
            & ' stands in none of the files')
         return
      end if
      call combine_rows(case, results, error)
   end subroutine merge_population

   !> Path of the file of counts: that of a part stays, that of a whole population is there while it runs
   pure function counts_path(case) result(path)
      !> The case
      type(case_type), intent(in) :: case
      !> Path
      character(len=:), allocatable :: path

      path = case%job%output//'.checkpoint'
      if (case%survey%is_part) path = case%job%output//'_walls_'//to_text(case%survey%first)//'-'// &
         & to_text(case%survey%last)//'.counts'
   end function counts_path

   !> What files of counts of a case have in common
   function key_of(case) result(key)
      !> The case
      type(case_type), intent(in) :: case
      !> Key
      type(counts_key_type) :: key

      type(fingerprint_type) :: records, settings
      type(group_settings_type) :: group
      integer :: i

      key%walls = case%survey%fingerprint%text()
      do i = 1, size(case%suite%records)
         call records%add_text(case%suite%records(i)%name)
         call records%add_reals([case%suite%records(i)%dt])
         call records%add_reals(case%suite%records(i)%acceleration)
      end do
      key%records = records%text()
      call settings%add_text(dondolo_version_text)
      call case%records_input%put(group)
      call add_settings(settings, group)
      call case%stripes%put(group)
      call add_settings(settings, group)
      call case%solver%put(group)
      call add_settings(settings, group)
      key%settings = settings%text()
      key%variant = build_variant()
      key%shape = shape_type(size(case%stripes%levels), size(case%stripes%thresholds), case%job%histories)
   end function key_of

   !> Check that a file belongs to a case
   subroutine check_key(file, key, error)
      !> The file
      type(counts_file_type), intent(in) :: file
      !> Key of the case
      type(counts_key_type), intent(in) :: key
      !> It does not
      type(error_type), allocatable, intent(out) :: error

      if (file%key%walls /= key%walls) then
         call raise_input(error, file%path//': is of another table of walls')
      else if (file%key%records /= key%records) then
         call raise_input(error, file%path//': is of other accelerograms')
      else if (file%key%settings /= key%settings .or. file%key%shape%levels /= key%shape%levels .or. &
         & file%key%shape%thresholds /= key%shape%thresholds) then
         call raise_input(error, file%path//': is of other levels, thresholds, polarity or solver, or of another version')
      else if (file%key%shape%keeps_histories .neqv. key%shape%keeps_histories) then
         call raise_input(error, file%path//': was made with another value of &job: histories')
      else if (file%key%variant /= key%variant) then
         call raise_input(error, file%path//': was made by build variant '//trim(file%key%variant)//', not '// &
            & trim(key%variant)//' (DONDOLO_VARIANT='//trim(file%key%variant)//' asks for it)')
      end if
   end subroutine check_key

   !> Look for the file that an earlier run has left
   subroutine find_start(case, file, exists, error)
      !> The case
      type(case_type), intent(in) :: case
      !> The file
      type(counts_file_type), intent(out) :: file
      !> Is there one?
      logical, intent(out) :: exists
      !> It is of another case, or of other rows
      type(error_type), allocatable, intent(out) :: error

      call inspect_counts(counts_path(case), file, exists, error)
      if (allocated(error) .or. .not. exists) return
      call check_key(file, key_of(case), error)
      associate (survey => case%survey)
         if (.not. allocated(error) .and. (file%first /= survey%first .or. file%last /= survey%last)) &
            & call raise_input(error, file%path//': is of rows '//to_text(file%first)//' to '//to_text(file%last))
      end associate
      if (allocated(error)) error%message = error%message//'; remove it to begin anew, unless another run is writing it'
   end subroutine find_start

   !> Go on with the file that an earlier run has left, or begin one
   subroutine start(case, file, resumed, error)
      !> The case
      type(case_type), intent(in) :: case
      !> The file
      type(counts_file_type), intent(out) :: file
      !> Last row that it has; 0 if it has none
      integer, intent(out) :: resumed
      !> It is of another case, or cannot be written
      type(error_type), allocatable, intent(out) :: error

      type(lines_type) :: made
      logical :: exists, ok

      resumed = 0
      call find_start(case, file, exists, error)
      if (allocated(error)) return
      if (exists) then
         if (file%done >= file%first) resumed = file%done
         ! What a killed run left of a block
         call cut_file(file%path, file%bytes, ok)
         if (.not. ok) call raise_failure(error, file%path//': cannot be written')
         return
      end if
      call make_folders(case%job%output, made, ok)
      if (.not. ok) then
         call raise_failure(error, case%job%output//': its folder cannot be made')
         return
      end if
      call create_counts(counts_path(case), key_of(case), case%survey%first, case%survey%last, error)
      if (.not. allocated(error)) call inspect_counts(counts_path(case), file, exists, error)
   end subroutine start

   !> Run block after block
   subroutine run_blocks(case, file, error, team, progress)
      !> The case
      type(case_type), intent(in), target :: case
      !> The file of counts; complete at the end
      type(counts_file_type), intent(inout) :: file
      !> What cannot be run
      type(error_type), allocatable, intent(out) :: error
      !> Number of threads; 0: all
      integer, intent(in) :: team
      !> Hears how far the work is
      procedure(progress_interface), optional :: progress

      type(study_type) :: study
      type(population_reader_type) :: reader
      type(member_type), allocatable :: members(:)
      type(counts_type), allocatable :: rows(:)
      type(work_type) :: work
      integer :: block, count, i
      logical :: found

      associate (survey => case%survey)
         call case%make_study(study, team)
         block = block_size(case, team)
         call reader%open(case%population_path(), error, case%solver%gravity, is_checked=.false.)
         if (.not. allocated(error)) call reader%skip(file%done, error)
         do while (file%done < survey%last .and. .not. allocated(error))
            count = min(block, survey%last - file%done)
            allocate (members(count))
            do i = 1, count
               call reader%next(members(i), found, error)
               if (.not. found .and. .not. allocated(error)) &
                  & call raise_failure(error, case%population_path()//': has changed while it was read')
               if (allocated(error)) exit
            end do
            if (allocated(error)) exit
            call run_rows(study, members, rows, work, error, int(file%work%histories), int(survey%histories), progress)
            if (allocated(error)) exit
            do i = 1, count
               rows(i)%row = file%done + i
               rows(i)%group = number_of_group(survey%groups, members(i)%group)
            end do
            call append_counts(file, rows, work, error)
            deallocate (members)
         end do
         call reader%close()
         if (.not. allocated(error)) call check_table(case, file, error)
         if (present(progress) .and. .not. allocated(error)) &
            & call progress(int(file%work%histories), int(survey%histories))
      end associate
   end subroutine run_blocks

   !> Check that the table is still the one that was surveyed; if not, what was computed may be of either
   subroutine check_table(case, file, error)
      !> The case
      type(case_type), intent(in) :: case
      !> The file of counts
      type(counts_file_type), intent(in) :: file
      !> It is not; the file of counts is removed
      type(error_type), allocatable, intent(out) :: error

      type(fingerprint_type) :: now

      call fingerprint_lines(case%population_path(), now, error)
      if (allocated(error)) return
      if (now%text() == case%survey%fingerprint%text()) return
      call remove_file(file%path)
      call raise_failure(error, case%population_path()//': has changed during the run, which must begin anew')
   end subroutine check_table

   !> Rows of a block, a multiple of the number of threads
   integer function block_size(case, team)
      !> The case
      type(case_type), intent(in) :: case
      !> Number of threads; 0: all
      integer, intent(in) :: team

      integer :: threads, of_a_row

      threads = team_of(team, huge(1))
      of_a_row = max(1, int(case%survey%histories/(case%survey%last - case%survey%first + 1)))
      block_size = threads*min(rows_of_thread, max(1, histories_of_thread/of_a_row))
   end function block_size

end module dondolo_run_population
