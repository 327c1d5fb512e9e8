!> Case files.
module cases
   use, intrinsic :: iso_c_binding, only : c_double, c_f_pointer, c_int, c_int64_t, c_loc, c_null_ptr, c_ptr
   use dondolo_base_error, only : error_type
   use dondolo_base_interrupt, only : stop_at
   use dondolo_base_json, only : json_type
   use dondolo_case, only : case_type
   use dondolo_case_echo, only : echo_type
   use dondolo_case_job_group, only : history_task, task_names, typology_task
   use dondolo_case_read_case, only : load_case => read_case
   use dondolo_case_result_tables, only : table_suffixes
   use dondolo_case_results, only : results_type
   use dondolo_case_run_case, only : run => run_case
   use dondolo_fragility_study, only : runs_of, study_type
   use dondolo_interface_handles, only : find_suite
   use dondolo_parcel, only : parcel_type, send
   use dondolo_population_wall_row, only : wall_row_type
   use dondolo_record_parcel, only : pack_records
   use dondolo_record_suite, only : suite_type
   use dondolo_results_parcel, only : pack_results
   use dondolo_store_parcel, only : pack_store
   use dondolo_wall_parcel, only : walls_parcel_type
   implicit none
   private

   public :: read_case, read_text, run_case, result_tables

   !> What the run of a thread shares with who watches it: how many histories are done, and how many there are. The library
   !> calls back in the thread that runs, and a callback carries no data of its own
   integer(c_int), pointer :: told(:) => null()
   !$omp threadprivate(told)

contains

   !> Read a case, as pack_case says
   subroutine read_case(path, sent)
      character(len=*), intent(in) :: path
      integer(c_int64_t), intent(out) :: sent(5)
      type(case_type), allocatable :: case
      type(parcel_type) :: parcel
      type(error_type), allocatable :: error

      ! On the heap: stacks may be small.
      allocate (case)
      call load_case(path, case, error)
      if (.not. allocated(error)) call pack_case(case, parcel, error)
      call send(parcel, error, sent)
   end subroutine read_case

   !> Read a case from its text, with accelerograms that were uploaded, which are not sent back. name: that of the case in messages
   subroutine read_text(name, text, records, sent)
      character(len=*), intent(in) :: name, text
      integer(c_int64_t), intent(in) :: records
      integer(c_int64_t), intent(out) :: sent(5)
      type(case_type), allocatable :: case
      type(suite_type), pointer :: suite
      type(parcel_type) :: parcel
      type(error_type), allocatable :: error

      ! On the heap: stacks may be small.
      allocate (case)
      call find_suite(records, suite, error)
      if (.not. allocated(error)) call load_case(name, case, error, text=text, suite=suite)
      if (.not. allocated(error)) call pack_case(case, parcel, error, with_records=.false.)
      call send(parcel, error, sent)
   end subroutine read_text

   !> Run a case. Three parcels are sent: the case (pack_case); the rows of its population (pack_store), which after Ctrl-C are
   !> those that are complete, with 1 or 0 for each record (records, levels) that runs at a level behind the integers and
   !> counts of what was computed behind the reals; and its results (pack_results). With an error the first two are sent as far
   !> as they are there. shared: address of three integers: the histories that are done, and all of them, are written to the
   !> first two meanwhile, and once another thread has set the third, the run is broken off as by Ctrl-C
   subroutine run_case(path, shared, sent_case, sent_rows, sent_results)
      !f2py threadsafe
      character(len=*), intent(in) :: path
      integer(c_int64_t), intent(in) :: shared
      integer(c_int64_t), intent(out) :: sent_case(5), sent_rows(5), sent_results(5)
      type(case_type), allocatable, target :: case
      type(results_type), allocatable :: results
      type(study_type) :: study
      type(parcel_type) :: parcel, rows, tables
      type(error_type), allocatable :: error, fault, none
      type(c_ptr) :: address

      sent_case = 0
      sent_rows = 0
      sent_results = 0
      ! On the heap: stacks may be small.
      allocate (case, results)
      call load_case(path, case, error)
      if (allocated(error)) then
         call send(tables, error, sent_results)
         return
      end if
      address = transfer(shared, address)
      call c_f_pointer(address, told, [3])
      call stop_at(c_loc(told(3)))
      call run(case, results, error, progress=hear, in_memory=.true.)
      call stop_at(c_null_ptr)
      if (allocated(results%stores)) then
         call pack_store(results%stores(1), rows, fault)
         if (.not. allocated(fault)) then
            call case%make_study(study)
            associate (runs => merge(1, 0, runs_of(study)))
               call rows%put('runs', int(pack(runs, .true.), c_int), shape(runs))
            end associate
            call rows%put('work', real(results%stores(1)%work%counts(), c_double))
            call send(rows, none, sent_rows)
         else if (.not. allocated(error)) then
            call move_alloc(fault, error)
         end if
      end if
      if (.not. allocated(error)) call pack_results(case, results, tables, error)
      ! The samples of its records are moved away.
      call pack_case(case, parcel, fault)
      if (.not. allocated(fault)) then
         call send(parcel, none, sent_case)
      else if (.not. allocated(error)) then
         call move_alloc(fault, error)
      end if
      call send(tables, error, sent_results)
   end subroutine run_case

   !> Hear how far the run of this thread is
   subroutine hear(done, total)
      integer, intent(in) :: done, total

      told(:2) = [done, total]
   end subroutine hear

   !> A case: each of its values under its name, as Python's Case has it, the JSON of its groups (settings), its walls
   !> (walls_parcel_type) and its records (pack_records)
   subroutine pack_case(case, parcel, error, with_records)
      type(case_type), intent(inout) :: case
      !> Empty
      type(parcel_type), intent(inout) :: parcel
      !> Lack of memory, or the table of walls has changed
      type(error_type), allocatable, intent(out) :: error
      !> Are its records packed? Yes if absent
      logical, intent(in), optional :: with_records

      type(walls_parcel_type) :: packed
      type(wall_row_type) :: row
      type(echo_type) :: echoed
      type(json_type) :: json
      character(len=:), allocatable :: settings
      real(c_double) :: scale
      logical :: packs

      if (case%job%task == typology_task) then
         call packed%add_rows(case%table, error)
      else
         row%wall = case%wall
         row%group = ''
         row%facade = ''
         row%alternative = ''
         call packed%add_row(row)
      end if
      if (.not. allocated(error)) then
         if (.not. allocated(case%stripes%levels)) allocate (case%stripes%levels(0))
         scale = 1
         if (case%job%task == history_task) scale = case%history_scale()
         call parcel%put('task', trim(task_names(case%job%task)))
         call parcel%put('title', case%job%title)
         call parcel%put('output', case%job%output)
         call parcel%put('im', case%stripes%scaling%name)
         call parcel%put('polarity', case%records_input%polarity)
         call parcel%put('engine', trim(case%solver%solver%engine))
         call parcel%put('states', case%stripes%states)
         call parcel%put('threads', case%job%threads)
         call parcel%put('record', case%history%record)
         call parcel%put('designs', merge(1, 0, case%designs))
         call parcel%put('estimate_error', merge(1, 0, case%solver%solver%estimate_error))
         call parcel%put('certify', merge(1, 0, case%solver%solver%certify))
         call parcel%put('rtol', case%solver%solver%rtol)
         call parcel%put('atol', case%solver%solver%atol)
         call parcel%put('edp_limit', case%solver%solver%edp_limit)
         call parcel%put('scale', scale)
         call parcel%put('initial_rotation', case%history%initial%rotation)
         call parcel%put('initial_velocity', case%history%initial%velocity)
         call parcel%put('levels', case%stripes%levels)
         call parcel%put('edp_thresholds', case%stripes%thresholds)
         call parcel%put('notes', case%notes)
         call case%echo(echoed)
         json%is_compact = .true.
         call json%open_object()
         call echoed%to_json(json)
         call json%close_object()
         call json%get(settings)
         call parcel%put('settings', settings)
         call packed%put_rows(case%table%notes, parcel)
         packs = .true.
         if (present(with_records)) packs = with_records
         if (packs) call pack_records(case%suite%records, parcel, error)
      end if
   end subroutine pack_case

   !> What the names of the tables of results end with, of any case: a line each
   subroutine result_tables(sent)
      integer(c_int64_t), intent(out) :: sent(5)
      type(parcel_type) :: parcel
      type(error_type), allocatable :: error
      integer :: i

      associate (suffixes => table_suffixes())
         do i = 1, size(suffixes)
            call parcel%lines%add(trim(suffixes(i)))
         end do
      end associate
      call send(parcel, error, sent)
   end subroutine result_tables

end module cases
