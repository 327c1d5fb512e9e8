!> Task 'typology': a population, from its table to its curves. A run that was killed goes on with the store that it left;
!> stores that hold parts of the population are taken together.
module dondolo_case_population_case
   use dondolo_base_error, only : error_type, raise_failure, raise_input
   use dondolo_base_lines, only : lines_type
   use dondolo_base_text, only : to_text
   use dondolo_building_floors, only : floors_type
   use dondolo_case, only : case_type
   use dondolo_case_combine_rows, only : combine_rows
   use dondolo_case_job_group, only : typology_task
   use dondolo_case_result_files, only : make_folders
   use dondolo_case_results, only : results_type
   use dondolo_case_survey, only : check_size
   use dondolo_fragility_study, only : study_type
   use dondolo_motion_queue, only : progress_interface
   use dondolo_population_identity, only : study_identity
   use dondolo_population_run_population, only : run_population
   use dondolo_population_store, only : look_into_store, open_store, store_type
   use dondolo_population_store_format, only : identity_type
   implicit none
   private

   public :: run_population_case, merge_population, find_start, store_path

contains

   !> Run the rows of a population that the case asks for, or those that an earlier run has left
   subroutine run_population_case(case, results, error, team, in_memory, progress)
      !> The case: its rows are handed over to the results
      type(case_type), intent(inout), target :: case
      type(results_type), intent(inout) :: results
      !> What cannot be run
      type(error_type), allocatable, intent(out) :: error
      !> Number of threads; 0: all
      integer, intent(in) :: team
      !> Does the store stay in memory?
      logical, intent(in) :: in_memory
      !> Hears how far the work is
      procedure(progress_interface), optional :: progress

      type(study_type) :: study
      type(floors_type), target :: floors

      allocate (results%stores(1))
      associate (store => results%stores(1))
         call check_size(case%population_path(), case%survey%histories, error)
         if (.not. allocated(error) .and. in_memory) call begin_in_memory(case, store, error)
         if (.not. allocated(error) .and. .not. in_memory) call find_start(case, store, error)
         if (allocated(error)) return
         results%resumed = store%done
         if (.not. in_memory) call begin(case, store, error)
         if (allocated(error)) return
         call case%make_study(study, team)
         study%floors => floors
         call run_population(study, case%table, store, int(case%survey%histories), error, progress)
         call store%close()
         if (allocated(error)) return
         results%work = store%work
      end associate
      if (.not. case%survey%is_part) call combine_rows(case, results, error)
   end subroutine run_population_case

   !> Take the stores that hold the parts of a population together
   subroutine merge_population(case, paths, results, error)
      !> The case: its rows are handed over to the results
      type(case_type), intent(inout) :: case
      !> Paths of the stores, in any order
      type(lines_type), intent(in) :: paths
      !> Results: stores, work, curves and warnings
      type(results_type), intent(out) :: results
      !> The case has no population, a store is none of this case or not complete, rows are missing or stand in two
      !> stores, or they cannot be combined
      type(error_type), allocatable, intent(out) :: error

      type(store_type), allocatable :: stores(:)
      integer, allocatable :: first(:)
      logical, allocatable :: is_left(:)
      integer :: i, j, done

      if (case%job%task /= typology_task) then
         call raise_input(error, '--merge: only for task = ''typology''')
         return
      end if
      allocate (stores(paths%count))
      call look_into_parts(case, paths, stores, error)
      if (allocated(error)) return
      done = 0
      first = stores%identity%first
      is_left = spread(.true., 1, size(stores))
      allocate (results%stores(size(stores)))
      do i = 1, size(stores)
         j = minloc(first, dim=1, mask=is_left)
         if (first(j) > done + 1) exit
         if (first(j) <= done) then
            call raise_input(error, stores(j)%path//': row '//to_text(first(j))//' also occurs in another file')
            return
         end if
         is_left(j) = .false.
         results%stores(i) = stores(j)
         done = stores(j)%identity%last
         call results%work%add(stores(j)%work)
      end do
      if (done < case%survey%rows) then
         call raise_input(error, '--merge: row '//to_text(done + 1)//' of '//to_text(case%survey%rows)// &
            & ' is missing from the files')
         return
      end if
      ! Places of many rows would not fit twice.
      deallocate (stores)
      call combine_rows(case, results, error)
   end subroutine merge_population

   !> Look into stores that are to be merged
   subroutine look_into_parts(case, paths, stores, error)
      type(case_type), intent(in) :: case
      !> Paths of the stores
      type(lines_type), intent(in) :: paths
      !> The stores, complete
      type(store_type), intent(inout) :: stores(:)
      !> One is none of this case, or not complete
      type(error_type), allocatable, intent(out) :: error

      type(identity_type) :: identity
      character(len=:), allocatable :: variant
      integer :: i
      logical :: exists

      call make_identity(case, identity)
      do i = 1, size(stores)
         call look_into_store(stores(i), paths%line(i)%text, exists, error)
         if (allocated(error)) return
         associate (store => stores(i))
            if (.not. exists) then
               call raise_input(error, paths%line(i)%text//': no such file, or nothing in it')
               return
            end if
            ! Parts may have run elsewhere, all by one variant.
            if (i == 1) call store%identity%key%get('build variant', variant)
            if (i == 1 .and. allocated(variant)) call identity%key%replace('build variant', variant)
            call identity%key%compare(store%identity%key, store%path, error)
            if (allocated(error)) return
            if (store%is_complete()) cycle
            call raise_input(error, store%path//': has '//to_text(store%done)//' of '// &
               & to_text(store%identity%last - store%identity%first + 1)//' rows: run it again to complete it')
            return
         end associate
      end do
   end subroutine look_into_parts

   !> Path of the store: that of a part stays, that of a whole population is there while it runs
   pure function store_path(case) result(path)
      type(case_type), intent(in) :: case
      !> Path
      character(len=len(case%job%output) + 40) :: path

      path = case%job%output//'.checkpoint'
      if (case%survey%is_part) path = case%job%output//'_walls_'//to_text(case%survey%first)//'-'// &
         & to_text(case%survey%last)//'.counts'
   end function store_path

   !> What the store of a case is for
   subroutine make_identity(case, identity)
      type(case_type), intent(in), target :: case
      !> Its study and rows
      type(identity_type), intent(out) :: identity

      type(study_type) :: study

      call case%make_study(study)
      associate (survey => case%survey)
         call study_identity(study, survey%walls_fingerprint, survey%rows, survey%first, survey%last, identity)
      end associate
   end subroutine make_identity

   !> Look for the store that an earlier run has left
   subroutine find_start(case, store, error)
      type(case_type), intent(in) :: case
      !> The store; empty if there was none
      type(store_type), intent(out) :: store
      !> It is of another case, or of other rows
      type(error_type), allocatable, intent(out) :: error

      type(identity_type) :: identity

      call make_identity(case, identity)
      call open_store(store, trim(store_path(case)), identity, error)
      if (allocated(error)) error%message = error%message//'; remove it to begin anew, unless another run is writing it'
   end subroutine find_start

   !> Begin to put rows into a store in memory
   subroutine begin_in_memory(case, store, error)
      type(case_type), intent(in) :: case
      !> The store, empty
      type(store_type), intent(out) :: store
      !> Lack of memory
      type(error_type), allocatable, intent(out) :: error

      type(identity_type) :: identity

      call make_identity(case, identity)
      call open_store(store, '', identity, error)
      if (.not. allocated(error)) call store%claim(error)
   end subroutine begin_in_memory

   !> Begin to put rows into a store
   subroutine begin(case, store, error)
      type(case_type), intent(in) :: case
      type(store_type), intent(inout) :: store
      !> It cannot be written
      type(error_type), allocatable, intent(out) :: error

      type(lines_type) :: made
      logical :: ok

      call make_folders(case%job%output, made, ok)
      if (.not. ok) then
         call raise_failure(error, case%job%output//': its folder cannot be made')
         return
      end if
      call store%claim(error)
   end subroutine begin

end module dondolo_case_population_case
