!> The result files of a case: CSV tables with a head of comment lines, and the run as JSON; whole or not at all.
module dondolo_reports
   use, intrinsic :: iso_fortran_env, only : compiler_version, int64
   use dondolo_case, only : case_type
   use dondolo_check_sheet, only : sheet_head
   use dondolo_design_rows, only : design_head, make_design_row
   use dondolo_error, only : add_place, error_type
   use dondolo_kinds, only : wp
   use dondolo_lines, only : lines_type
   use dondolo_property, only : find_property
   use dondolo_report_rows, only : make_typology_row, make_union_row, typology_head, union_head
   use dondolo_result_files, only : check_output, result_files_type, run_suffix
   use dondolo_results, only : results_type
   use dondolo_row_reports, only : write_one_row, write_rows
   use dondolo_run_file, only : shape_names, shape_of, write_run
   use dondolo_echo, only : echo_type
   use dondolo_source_rows, only : make_source_row, source_head
   use dondolo_text, only : to_table, to_text
   use dondolo_tie_rows, only : make_tie_comment
   use dondolo_warning_sentence, only : warning_sentences
   use dondolo_work, only : work_names
   use dondolo_unions, only : union_type
   use dondolo_wall_properties, only : wall_properties
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
      call check_output(case%job%output, suffixes(case), inputs, error)
      if (allocated(error)) error%message = error%message//case%job%output_line
      call add_place(error, case%file//': &job: output = '''//case%job%output//'''')
   end subroutine check_reports

   !> What the names of the result files of a case end with
   pure function suffixes(case) result(names)
      type(case_type), intent(in) :: case
      !> Ends of the names
      character(len=15), allocatable :: names(:)

      select case (case%job%task)
      case ('history')
         names = [character(len=15) :: '_walls.csv', '_history.csv', run_suffix]
      case ('stripes')
         names = [character(len=15) :: '_walls.csv', '_histories.csv', '_stripes.csv', '_fragility.csv', &
            & run_suffix]
         if (case%wall%mechanism%ties > 0) names = [names(:size(names) - 1), [character(len=15) :: '_ties.csv', &
            & run_suffix]]
         if (allocated(case%check)) names = [names(:size(names) - 1), [character(len=15) :: '_check.csv', run_suffix]]
      case default
         names = [character(len=15) :: '_walls.csv', '_stripes.csv', '_fragility.csv', '_typology.csv', &
            & run_suffix]
         if (case%designs) names = pack(names, names /= '_typology.csv')
         if (case%job%histories) names = [character(len=15) :: '_walls.csv', '_histories.csv', names(2:)]
         if (case%survey%lengths(find_property(wall_properties, 'tie_height')) > 0) then
            names = [names(:size(names) - 1), [character(len=15) :: '_ties.csv', run_suffix]]
         end if
         if (case%survey%walls < case%survey%rows) names = [names(:size(names) - 1), [character(len=15) :: '_unions.csv', &
            & run_suffix]]
         if (case%designs) names = [names(:size(names) - 1), [character(len=15) :: '_designs.csv', run_suffix]]
         if (allocated(case%check)) names = [names(:size(names) - 1), [character(len=15) :: '_checks.csv', run_suffix]]
         if (allocated(case%uncertainty)) names = [names(:size(names) - 1), [character(len=15) :: '_sources.csv', run_suffix]]
      end select
   end function suffixes

   !> Write the reports of a case; those of an earlier run that they do not replace are removed
   subroutine write_reports(case, results, files, error)
      type(case_type), intent(in) :: case
      type(results_type), intent(inout) :: results
      !> The files, claimed
      type(result_files_type), intent(inout) :: files
      !> They could not be written
      type(error_type), allocatable, intent(out) :: error

      type(lines_type) :: inputs
      character(len=15), allocatable :: names(:)
      integer :: i

      names = suffixes(case)
      do i = 1, size(names)
         call files%begin(trim(names(i)), error)
         if (allocated(error)) return
         if (names(i) == run_suffix) then
            call write_run(case, results, files)
         else
            call write_head(case, results, files)
            call write_table(case, results, trim(names(i)), files, error)
         end if
         if (.not. allocated(error)) call files%finish(error)
         if (allocated(error)) return
      end do
      call case%inputs(inputs)
      call files%publish(inputs, error)
   end subroutine write_reports

   !> Write one table
   subroutine write_table(case, results, name, files, error)
      type(case_type), intent(in) :: case
      type(results_type), intent(inout) :: results
      !> What the name of the file ends with
      character(len=*), intent(in) :: name
      type(result_files_type), intent(inout) :: files
      !> A file that is read again has changed
      type(error_type), allocatable, intent(out) :: error

      if (name == '_typology.csv') then
         call write_typology(case, results, files)
      else if (name == '_unions.csv') then
         call write_unions(case, results, files)
      else if (name == '_designs.csv') then
         call write_designs(case, results, files)
      else if (name == '_sources.csv') then
         call write_sources(case, results, files)
      else if (name == '_check.csv') then
         call write_check(results, files)
      else if (name == '_history.csv') then
         call write_history(case, results, files)
      else if (case%job%task == 'typology') then
         call write_rows(case, results, name, files, error)
      else
         call write_one_row(case, results%row, name, files, error)
      end if
   end subroutine write_table

   !> Comment lines: which program, which case, what was computed, and what to beware of
   subroutine write_head(case, results, files)
      type(case_type), intent(in) :: case
      type(results_type), intent(in) :: results
      type(result_files_type), intent(inout) :: files

      type(echo_type) :: echo
      type(lines_type) :: lines, warnings
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
      if (case%job%task /= 'history') then
         unit = case%stripes%scaling%unit()
         if (len(unit) == 0) unit = '1'
         call files%line('# unit of im_level and theta: '//unit)
         call list_counts(work_names, results%work%counts(), counts)
         call files%line('# work: '//counts)
      end if
      do i = 1, case%notes%count
         call files%line('# note: '//case%notes%line(i)%text)
      end do
      call warning_sentences(results%warnings, warnings)
      do i = 1, warnings%count
         call files%line('# warning: '//warnings%line(i)%text)
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

   !> Curves of the population
   subroutine write_typology(case, results, files)
      type(case_type), intent(in) :: case
      type(results_type), intent(in) :: results
      type(result_files_type), intent(inout) :: files

      character(len=:), allocatable :: line
      integer :: i, j, k

      call files%line(typology_head)
      do k = 1, size(case%stripes%thresholds)
         do i = 1, size(results%typologies, 1)
            do j = 1, size(case%stripes%levels)
               call make_typology_row(results%typologies(i, k), case%stripes%scaling%name, j, &
                  & case%stripes%thresholds(k), case%job%spreadsheet_safe, line)
               call files%line(line)
            end do
         end do
      end do
   end subroutine write_typology

   !> Walls with several mechanisms, of the same histories
   subroutine write_unions(case, results, files)
      type(case_type), intent(in) :: case
      type(results_type), intent(in) :: results
      type(result_files_type), intent(inout) :: files

      type(union_type) :: union
      character(len=:), allocatable :: line
      integer :: i, j, k

      call files%line(union_head)
      do i = 1, results%unions%count()
         call results%unions%get(i, results%population, union)
         do k = 1, size(case%stripes%thresholds)
            do j = 1, size(case%stripes%levels)
               call make_union_row(union, case%stripes%scaling%name, case%stripes%levels(j), j, k, &
                  & case%stripes%thresholds(k), case%job%spreadsheet_safe, line)
               call files%line(line)
            end do
         end do
      end do
   end subroutine write_unions

   !> Designs of one wall, each beside the first
   subroutine write_designs(case, results, files)
      type(case_type), intent(in) :: case
      type(results_type), intent(in) :: results
      type(result_files_type), intent(inout) :: files

      character(len=:), allocatable :: line
      integer :: i

      call files%line(design_head)
      do i = 1, size(results%designs)
         call make_design_row(results%designs(i), results%designs(1), case%stripes%scaling%name, case%job%spreadsheet_safe, &
            & line)
         call files%line(line)
      end do
   end subroutine write_designs

   !> The uncertain properties of a wall with variants
   subroutine write_sources(case, results, files)
      type(case_type), intent(in) :: case
      type(results_type), intent(in) :: results
      type(result_files_type), intent(inout) :: files

      character(len=:), allocatable :: line
      integer :: i

      call files%line(source_head)
      do i = 1, size(case%facade%sources)
         call make_source_row(case, results, i, line)
         call files%line(line)
      end do
   end subroutine write_sources

   !> The sheet of the check
   subroutine write_check(results, files)
      type(results_type), intent(in) :: results
      type(result_files_type), intent(inout) :: files

      character(len=:), allocatable :: line
      integer :: i

      call files%line(sheet_head)
      do i = 1, size(results%check%rows)
         call results%check%make_row(i, line)
         call files%line(line)
      end do
   end subroutine write_check

   !> The time history
   subroutine write_history(case, results, files)
      type(case_type), intent(in) :: case
      type(results_type), intent(in) :: results
      type(result_files_type), intent(inout) :: files

      character(len=:), allocatable :: line
      real(wp) :: capacity
      integer :: i

      associate (response => results%response, trace => results%trace)
         call files%line('# record: '//case%suite%records(case%history%record)%name)
         call files%line('# scale: '//to_table(case%history_scale()))
         call files%line('# edp: '//to_table(response%edp))
         call files%line('# collapsed: '//to_text(merge(1, 0, response%collapsed)))
         call files%line('# impacts: '//to_text(response%impacts))
         call files%line('# time_of_peak_s: '//to_table(response%time_of_peak))
         if (case%solver%solver%estimate_error) call files%line('# edp_error: '//to_table(response%edp_error))
         do i = 1, size(results%trace%ties)
            call make_tie_comment(i, results%trace%ties(i), line)
            call files%line(line)
         end do
         call files%line('time_s,ground_acceleration_m_s2,rotation_rad,velocity_rad_s,edp,side,after_impact')
         capacity = case%wall%mechanism%capacity
         do i = 1, trace%rows
            call files%line(to_table(trace%time(i))//','//to_table(trace%acceleration(i))//','// &
               & to_table(trace%rotation(i))//','//to_table(trace%velocity(i))//','// &
               & to_table(abs(trace%rotation(i))/capacity)//','//to_text(nint(trace%side(i)))//','// &
               & to_text(merge(1, 0, trace%after_impact(i))))
         end do
      end associate
   end subroutine write_history

end module dondolo_reports
