!> The result files of a case: CSV tables with a head of comment lines, and the run as JSON; whole or not at all.
module dondolo_case_reports
   use, intrinsic :: iso_fortran_env, only : compiler_version, int64
   use dondolo_base_error, only : add_place, error_type
   use dondolo_base_kinds, only : wp
   use dondolo_base_lines, only : lines_type
   use dondolo_base_text, only : to_text
   use dondolo_case, only : case_type
   use dondolo_case_csv_table, only : csv_table_type
   use dondolo_case_echo, only : echo_type
   use dondolo_case_job_group, only : history_task
   use dondolo_case_result_files, only : check_output, result_files_type, run_suffix, suffix_length
   use dondolo_case_result_tables, only : list_tables, table_kind_type
   use dondolo_case_results, only : results_type
   use dondolo_case_run_file, only : make_run, shape_names, shape_of
   use dondolo_motion_work, only : work_names
   implicit none
   private

   public :: check_reports, write_reports

contains

   !> Try, before anything is computed, whether the reports of a case can be written
   subroutine check_reports(case, error)
      type(case_type), intent(in) :: case
      !> They cannot
      type(error_type), allocatable, intent(out) :: error

      type(lines_type) :: inputs

      call case%inputs(inputs)
      call check_output(case%job%output, files_of(case), inputs, error)
      if (allocated(error)) error%message = error%message//case%job%output_line
      call add_place(error, case%file//': &job: output = '''//case%job%output//'''')
   end subroutine check_reports

   !> What the names of the result files of a case end with
   function files_of(case) result(names)
      type(case_type), intent(in) :: case
      !> Ends of the names
      character(len=suffix_length), allocatable :: names(:)

      type(table_kind_type), allocatable :: kinds(:)
      integer :: i

      call list_tables(kinds)
      names = [character(len=suffix_length) :: pack(kinds%suffix, [(kinds(i)%is_of(case), i=1, size(kinds))]), run_suffix]
   end function files_of

   !> Write the reports of a case; those of an earlier run that they do not replace are removed
   subroutine write_reports(case, results, files, error)
      type(case_type), intent(in), target :: case
      type(results_type), intent(inout) :: results
      !> The files, claimed
      type(result_files_type), intent(inout), target :: files
      !> They could not be written
      type(error_type), allocatable, intent(out) :: error

      type(lines_type) :: inputs
      type(table_kind_type), allocatable :: kinds(:)
      character(len=:), allocatable :: text
      integer :: i

      call list_tables(kinds)
      do i = 1, size(kinds)
         if (.not. kinds(i)%is_of(case)) cycle
         call write_table(case, results, kinds(i), files, error)
         if (allocated(error)) return
      end do
      call files%begin(run_suffix, error)
      if (allocated(error)) return
      call make_run(case, results, files%lock%run, files%written(:size(files%written) - 1), text)
      call files%line(text)
      call files%finish(error)
      if (allocated(error)) return
      call case%inputs(inputs)
      call files%publish(inputs, error)
   end subroutine write_reports

   !> Write one table
   subroutine write_table(case, results, kind, files, error)
      type(case_type), intent(in), target :: case
      type(results_type), intent(inout) :: results
      !> Which table
      type(table_kind_type), intent(in) :: kind
      type(result_files_type), intent(inout), target :: files
      !> It could not be written, or a file that is read again has changed
      type(error_type), allocatable, intent(out) :: error

      type(csv_table_type) :: table

      call files%begin(trim(kind%suffix), error)
      if (allocated(error)) return
      call write_head(case, results, kind, files)
      table%files => files
      table%is_safe = case%job%spreadsheet_safe
      call kind%fill(case, results, table, error)
      if (.not. allocated(error)) call files%finish(error)
   end subroutine write_table

   !> Comment lines: which program, which case, what was computed, and what to beware of
   subroutine write_head(case, results, kind, files)
      type(case_type), intent(in) :: case
      type(results_type), intent(in) :: results
      !> Which table
      type(table_kind_type), intent(in) :: kind
      type(result_files_type), intent(inout) :: files

      type(echo_type) :: echo
      type(lines_type) :: lines, warnings, facts
      character(len=:), allocatable :: engines, unit, counts
      integer :: i

      call list_counts(shape_names, int(shape_of(case), int64), counts)
      call files%line('# shape: '//counts)
      call files%line('# compiler: '//compiler_version()//', real'//to_text(storage_size(1.0_wp)))
      call results%name_engines(engines)
      call files%line('# engine and build variant: '//engines)
      call case%echo(echo)
      call echo%to_namelist(lines)
      do i = 1, lines%count
         call files%line('# '//lines%line(i)%text)
      end do
      if (case%job%task /= history_task) then
         unit = case%stripes%scaling%unit()
         if (len(unit) == 0) unit = '1'
         call files%line('# unit of im_level and theta: '//unit)
         call list_counts(work_names, results%work%counts(), counts)
         call files%line('# work: '//counts)
      end if
      do i = 1, case%notes%count
         call files%line('# note: '//case%notes%line(i)%text)
      end do
      call results%warnings%put_sentences(warnings)
      do i = 1, warnings%count
         call files%line('# warning: '//warnings%line(i)%text)
      end do
      if (.not. associated(kind%facts)) return
      call kind%facts(case, results, facts)
      do i = 1, facts%count
         call files%line('# '//facts%line(i)%text)
      end do
   end subroutine write_head

   !> List counts, for the head of a file
   pure subroutine list_counts(names, counts, text)
      !> Their names
      character(len=*), intent(in) :: names(:)
      integer(int64), intent(in) :: counts(:)
      !> Names and counts
      character(len=:), allocatable, intent(out) :: text

      integer :: i

      text = trim(names(1))//' = '//to_text(counts(1))
      do i = 2, size(counts)
         text = text//', '//trim(names(i))//' = '//to_text(counts(i))
      end do
   end subroutine list_counts

end module dondolo_case_reports
