!> What --check prints: what would run.
module dondolo_plan
   use, intrinsic :: iso_fortran_env, only : output_unit
   use dondolo_base_error, only : error_type
   use dondolo_base_kinds, only : wp
   use dondolo_base_lines, only : lines_type
   use dondolo_base_plain, only : visible
   use dondolo_base_text, only : counted, rounded, to_text
   use dondolo_base_warning, only : warnings_type
   use dondolo_case, only : case_type
   use dondolo_case_check_rows, only : check_wall
   use dondolo_case_event_warnings, only : warn_of_events
   use dondolo_case_job_group, only : history_task, task_names, typology_task
   use dondolo_case_motion_warnings, only : scale_warnings_type, warn_of_records
   use dondolo_case_population_case, only : find_start
   use dondolo_case_result_warnings, only : warn_of_plan
   use dondolo_case_results, only : shown_rows
   use dondolo_case_run_case, only : plan_case
   use dondolo_case_wall_warnings, only : wall_warnings_type
   use dondolo_check_lines, only : print_check
   use dondolo_check_sheet, only : sheet_type
   use dondolo_fit_lines, only : name_width
   use dondolo_motion_work, only : work_type
   use dondolo_plan_wall, only : print_body, print_building, print_head, print_row, print_wall
   use dondolo_population_reader, only : population_reader_type
   use dondolo_population_store, only : store_type
   use dondolo_population_wall_row, only : wall_row_type
   use dondolo_record, only : record_type
   use dondolo_records_record_table, only : record_table
   implicit none
   private

   public :: print_plan

contains

   !> Check what would run, and print it; what a run would warn of beforehand stands last, where it is seen
   subroutine print_plan(case, quiet, warnings, error)
      type(case_type), intent(in) :: case
      !> Print nothing?
      logical, intent(in) :: quiet
      !> What a run would warn of beforehand
      type(lines_type), intent(out) :: warnings
      !> What cannot be run
      type(error_type), allocatable, intent(out) :: error

      type(scale_warnings_type) :: scales
      type(store_type) :: store
      type(work_type) :: work
      type(sheet_type) :: sheet
      integer :: i

      if (case%job%task /= history_task) call plan_case(case, work, scales, error)
      if (allocated(error)) return
      if (case%job%task == typology_task) then
         call find_start(case, store, error)
      else if (allocated(case%check)) then
         call check_wall(case%wall, case%check, case%stripes%scaling%name, sheet, error)
      end if
      if (allocated(error)) return
      call collect_warnings(case, work, scales, warnings)
      if (quiet) return
      write (output_unit, '(a)') visible(case%file)//': correct, nothing was run', ''
      write (output_unit, '(a)') 'task: '//trim(task_names(case%job%task))
      if (len(case%job%title) > 0) write (output_unit, '(a)') 'title: '//case%job%title
      write (output_unit, '(a)') 'results: '//case%job%output//'_*.csv', ''
      if (case%job%task == typology_task) then
         call print_population(case, error)
         if (allocated(error)) return
      else
         call print_wall(case%wall)
         call print_body(case%wall)
         if (allocated(case%wall%building)) call print_building(case%wall%building, used_records(case))
         write (output_unit, '(a)') ''
         if (allocated(case%check)) call print_check(sheet, was_run=.false.)
      end if
      call print_records(case)
      if (case%job%task == history_task) then
         write (output_unit, '(a)') 'one history: record '''//case%suite%records(case%history%record)%name// &
            & ''', scale '//rounded(case%history_scale())
      else
         call print_histories(case, work, scales, store)
      end if
      if (warnings%count > 0) write (output_unit, '(a)') ''
      do i = 1, warnings%count
         write (output_unit, '(a)') 'warning: '//visible(warnings%line(i)%text)
      end do
   end subroutine print_plan

   !> The records that would run: of a time history one
   function used_records(case) result(records)
      type(case_type), intent(in) :: case
      type(record_type), allocatable :: records(:)

      records = case%suite%records
      if (case%job%task == history_task) records = [case%suite%records(case%history%record)]
   end function used_records

   !> Print which histories would run
   subroutine print_histories(case, work, scales, store)
      type(case_type), intent(in) :: case
      !> Work of all
      type(work_type), intent(in) :: work
      !> The largest scale factor
      type(scale_warnings_type), intent(in) :: scales
      !> What an earlier run has done
      type(store_type), intent(in) :: store

      write (output_unit, '(a)') to_text(size(case%stripes%levels))//' levels of '//case%stripes%scaling%name//':'// &
         & trim(list(case%stripes%levels))//case%stripes%scaling%unit_after_blank()
      if (size(case%stripes%thresholds) > 1) then
         write (output_unit, '(a)') 'EDP thresholds:'//trim(list(case%stripes%thresholds))
      end if
      call print_clusters(case)
      write (output_unit, '(a)') to_text(work%histories)//' histories, polarity '//case%records_input%polarity
      write (output_unit, '(a)') 'of them '//to_text(work%still)//' stay below the trigger and never move; '// &
         & to_text(work%histories - work%still)//' will be integrated'
      if (store%done > 0) write (output_unit, '(a)') 'of these an earlier run has completed '// &
         & to_text(store%work%histories)//', '//to_text(store%done)//' of '// &
         & to_text(case%survey%last - case%survey%first + 1)//' rows, in '//visible(store%path)
      write (output_unit, '(a)') 'largest scale factor: '//rounded(scales%largest)// &
         & ' (record '''//scales%record//''' at level '//to_text(scales%level)//')'
   end subroutine print_histories

   !> Print which records are taken as independent of each other: standard errors rest on that
   subroutine print_clusters(case)
      type(case_type), intent(in) :: case

      character(len=:), allocatable :: line
      integer :: unknown, i

      unknown = 0
      do i = 1, size(case%suite%records)
         if (len(case%suite%labels%line(i)%text) == 0) unknown = unknown + 1
      end do
      line = counted(size(case%suite%records), 'record')//' in '//counted(maxval(case%suite%clusters), 'cluster')
      if (unknown == 0) then
         line = line//' by event, or by station and date'
      else if (size(case%suite%records) > 1) then
         line = line//'; '//to_text(unknown)//' without event, or station and date, taken as independent of all others but copies'
      end if
      write (output_unit, '(a)') line
   end subroutine print_clusters

   !> What a run would warn of beforehand
   subroutine collect_warnings(case, work, scales, sentences)
      type(case_type), intent(in) :: case
      !> Work of all histories
      type(work_type), intent(in) :: work
      !> What there is to say of scale factors
      type(scale_warnings_type), intent(in) :: scales
      !> What to say
      type(lines_type), intent(out) :: sentences

      type(wall_warnings_type) :: wall_warnings
      type(warnings_type) :: warnings

      if (case%job%task == typology_task) then
         wall_warnings = case%survey%wall_warnings
      else
         call wall_warnings%look(case%wall)
      end if
      if (case%job%task == history_task) then
         call wall_warnings%warn(warnings, case%suite%records(case%history%record:case%history%record))
         call warn_of_records(case%suite, case%solver%gravity, warnings, case%history%record)
      else
         call wall_warnings%warn(warnings, case%suite%records, case%stripes%thresholds)
         call warn_of_records(case%suite, case%solver%gravity, warnings)
         call warn_of_events(case%suite, warnings)
         call warn_of_plan(size(case%stripes%levels), case%suite%clusters, work, warnings)
      end if
      call scales%warn(warnings)
      if (case%job%task == typology_task) call case%survey%occurrence_warnings%warn(warnings)
      call warnings%put_sentences(sentences)
   end subroutine collect_warnings

   !> Print the first rows of the population
   subroutine print_population(case, error)
      type(case_type), intent(in) :: case
      !> A row that is wrong
      type(error_type), allocatable, intent(out) :: error

      type(population_reader_type) :: reader
      type(wall_row_type) :: rows(shown_rows)
      logical :: found
      integer :: i, shown, longest

      associate (survey => case%survey)
         shown = min(survey%last - survey%first + 1, shown_rows)
         reader%names%is_checked = .false.
         call reader%skip(case%table, survey%first - 1, error)
         if (allocated(error)) return
         if (survey%walls < survey%rows) write (output_unit, '(a)') counted(survey%walls, 'wall')//', with '// &
            & to_text(survey%rows)//' mechanisms in all'
         if (survey%is_part) write (output_unit, '(a)') 'rows '// &
            & to_text(survey%first)//' to '//to_text(survey%last)//' of '//to_text(survey%rows)
         longest = 0
         do i = 1, shown
            call reader%next(case%table, rows(i), found, error)
            if (allocated(error)) return
            longest = max(longest, len(rows(i)%wall%name()))
         end do
         call print_head(name_width(longest))
         do i = 1, shown
            call print_row(rows(i)%wall, name_width(longest))
         end do
         associate (more => survey%last - survey%first + 1 - shown)
            if (more > 0) write (output_unit, '(a)') '... and '//to_text(more)//' more'
         end associate
      end associate
      write (output_unit, '(a)') ''
   end subroutine print_population

   !> Print the records
   subroutine print_records(case)
      type(case_type), intent(in) :: case

      type(lines_type) :: table
      integer :: i

      associate (scaling => case%stripes%scaling)
         ! The PGA stands there anyway
         if (case%is_scaled() .and. scaling%measure%kind /= 'pga') then
            table = record_table(case%suite%records, case%solver%gravity, scaling%measure%name, scaling%measure%unit(), &
               & case%suite%values(scaling%measure, case%job%threads)/scaling%measure%level_size(case%solver%gravity))
         else
            table = record_table(case%suite%records, case%solver%gravity)
         end if
      end associate
      do i = 1, table%count
         write (output_unit, '(a)') table%line(i)%text
      end do
      write (output_unit, '(a)') ''
   end subroutine print_records

   !> Numbers with blanks between them
   pure function list(values) result(text)
      !> Numbers
      real(wp), intent(in) :: values(:)
      !> Their texts, filled up with blanks
      character(len=48*size(values)) :: text

      integer :: i

      text = ''
      do i = 1, size(values)
         text = trim(text)//' '//to_text(values(i))
      end do
   end function list

end module dondolo_plan
