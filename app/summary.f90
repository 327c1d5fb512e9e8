!> What a run prints at its end: the results at a glance.
module dondolo_summary
   use, intrinsic :: iso_fortran_env, only : int64, output_unit
   use dondolo_base_kinds, only : wp
   use dondolo_base_lines, only : lines_type
   use dondolo_base_plain, only : visible
   use dondolo_base_text, only : counted, left, right, rounded, to_text
   use dondolo_base_warning, only : warnings_type
   use dondolo_case, only : case_type
   use dondolo_case_design_rows, only : make_design_sentence, make_safety_sentence
   use dondolo_case_job_group, only : history_task, stripes_task, typology_task
   use dondolo_case_results, only : results_type, row_counts_type, shown_rows
   use dondolo_case_source_rows, only : make_model_sentence, make_source_sentence
   use dondolo_case_tie_rows, only : make_tie_sentence
   use dondolo_check_lines, only : print_check, print_verdicts
   use dondolo_fit_lines, only : bar, fractiles, make_head, name_width, occurring, print_fit, print_population_errors
   use dondolo_fragility, only : fit_status_names
   use dondolo_fragility_drift_note, only : make_drift_note, share_of
   use dondolo_motion_certified, only : in_double, in_quadruple, not_computable
   use dondolo_motion_error_estimate, only : runs_of_estimate
   use dondolo_plan_wall, only : print_wall
   use dondolo_population_designs, only : design_type
   use dondolo_population_typology, only : whole_population
   use dondolo_union_lines, only : print_facade, print_unions, print_verdict_rows
   use dondolo_wall_support_notes, only : supports_type
   use dondolo_wall_tested_restitution, only : make_restitution_sentence
   implicit none
   private

   public :: print_summary

contains

   !> Print the results at a glance
   subroutine print_summary(case, results, paths, seconds, threads)
      type(case_type), intent(in) :: case
      type(results_type), intent(in) :: results
      !> The files that were written
      type(lines_type), intent(in) :: paths
      !> Time of the computation [s]; 0: nothing was computed, counts were merged
      real(wp), intent(in) :: seconds
      !> Number of threads
      integer, intent(in) :: threads

      type(supports_type) :: supports
      type(lines_type) :: notes
      type(warnings_type) :: found
      integer :: i

      if (len(case%job%title) > 0) write (output_unit, '(a)') case%job%title, ''
      select case (case%job%task)
      case (history_task)
         call print_wall(case%wall)
         write (output_unit, '(a)') ''
         call print_history(case, results)
      case (stripes_task)
         call print_wall(case%wall)
         write (output_unit, '(a)') ''
         call print_stripes(case, results)
         if (allocated(case%check)) then
            write (output_unit, '(a)') ''
            call print_check(results%check, was_run=.true.)
         end if
      case (typology_task)
         if (allocated(results%typologies)) then
            call print_curves(case, results)
            if (allocated(results%designs)) then
               call print_designs(results%designs)
            else if (case%survey%walls == 1) then
               call print_facade(case, results)
            else
               call print_typology(case, results)
               if (results%unions%count() > 0) call print_unions(case, results)
            end if
            if (allocated(case%check)) then
               write (output_unit, '(a)') ''
               call print_verdicts(results%verdicts, case%check)
               call print_verdict_rows(case, results)
            end if
            if (allocated(case%uncertainty)) call print_sources(case, results)
         else
            write (output_unit, '(a)') 'rows '//to_text(case%survey%first)//' to '//to_text(case%survey%last)//' of '// &
               & to_text(case%survey%rows)//' are complete; when all are, merge them:', &
               & '   dondolo --merge '//visible(case%file)//' '//case%job%output//'_walls_*.counts'
         end if
      end select
      if (case%job%task /= typology_task) call print_restitution(case)
      if (case%suite%has_vertical) write (output_unit, '(a)') 'note: vertical ground motion is applied: the recorded '// &
         & 'components, scaled as their records'//trim(factor_note(case))
      call find_supports(case, supports)
      call supports%make_notes(found)
      call found%put_sentences(notes)
      do i = 1, notes%count
         write (output_unit, '(a)') 'note: '//notes%line(i)%text
      end do
      write (output_unit, '(a)') ''
      if (case%job%task /= history_task) call print_work(case, results, seconds, threads)
      do i = 1, paths%count
         write (output_unit, '(a)') 'written: '//paths%line(i)%text
      end do
   end subroutine print_summary

   !> What moves the walls of a case
   subroutine find_supports(case, supports)
      type(case_type), intent(in) :: case
      type(supports_type), intent(out) :: supports

      if (case%job%task == typology_task) then
         supports = case%survey%supports
      else
         call supports%look(case%wall)
      end if
   end subroutine find_supports

   !> Print what the restitution of a wall of two blocks assumes
   subroutine print_restitution(case)
      type(case_type), intent(in) :: case

      character(len=:), allocatable :: line

      call make_restitution_sentence(case%wall, line)
      if (len(line) > 0) write (output_unit, '(a)') 'note: restitution is '//line
   end subroutine print_restitution

   !> Print what the medians of the variants of a wall are owed to
   subroutine print_sources(case, results)
      type(case_type), intent(in) :: case
      type(results_type), intent(in) :: results

      character(len=:), allocatable :: line
      integer :: i

      call make_model_sentence(case, results, line)
      write (output_unit, '(a)') '', line
      do i = 1, size(case%table%base_wall%sources)
         call make_source_sentence(case, results, i, line)
         write (output_unit, '(a)') line
      end do
      if (allocated(results%no_sensitivity)) write (output_unit, '(a)') 'no indices: '//results%no_sensitivity
   end subroutine print_sources

   !> The factor on vertical components, where it is not 1
   function factor_note(case) result(text)
      type(case_type), intent(in) :: case
      !> What follows the note
      character(len=40) :: text

      text = ''
      associate (factor => case%records_input%vertical_factor)
         if (factor < 1.0_wp .or. factor > 1.0_wp) text = ', times '//to_text(factor)
      end associate
   end function factor_note

   !> Print how much was computed, how fast, and how much of it took no work
   subroutine print_work(case, results, seconds, threads)
      type(case_type), intent(in) :: case
      type(results_type), intent(in) :: results
      !> Time of the computation [s]
      real(wp), intent(in) :: seconds
      !> Number of threads
      integer, intent(in) :: threads

      character(len=:), allocatable :: engines, drift
      integer(int64) :: histories

      call results%name_engines(engines)
      histories = results%work%histories
      if (case%solver%solver%estimate_error) histories = histories/runs_of_estimate
      if (results%resumed > 0) then
         write (output_unit, '(a)') to_text(histories)//' histories, those of '//counted(results%resumed, 'row')// &
            & ' by an earlier run, engine '//engines
      else if (seconds > 0.0_wp) then
         write (output_unit, '(a)') to_text(histories)//' histories in '//rounded(seconds)//' s, '// &
            & to_text(nint(real(histories, wp)/seconds, int64))//' a second on '// &
            & counted(int(min(int(threads, int64), histories)), 'thread')//', engine '//engines
      else
         write (output_unit, '(a)') to_text(histories)//' histories, engine '//engines
      end if
      associate (work => results%work)
         write (output_unit, '(a)') 'never moved: '//trim(share_of(work%still, work%histories))//' histories; rocking: '// &
            & trim(share_of(work%rocked, work%intervals))//' sample intervals'
         call make_drift_note(work, drift)
         if (len(drift) > 0) write (output_unit, '(a)') 'note: '//drift
         if (case%solver%solver%estimate_error) write (output_unit, '(a)') &
            & '(to estimate errors every history was run twice more)'
      end associate
   end subroutine print_work

   !> Print the response of a time history
   subroutine print_history(case, results)
      type(case_type), intent(in) :: case
      type(results_type), intent(in) :: results

      character(len=:), allocatable :: line
      integer :: i

      associate (response => results%response, record => case%suite%records(case%history%record))
         write (output_unit, '(a)') 'record '''//record%name//''', scale '//rounded(case%history_scale())// &
            & ', peak acceleration '//rounded(abs(case%history_scale())*record%pga()/case%solver%gravity)//' g'
         if (response%collapsed) then
            write (output_unit, '(a)') 'collapse: EDP reaches its limit '//rounded(response%edp)//' at '// &
               & rounded(response%time_of_peak)//' s, after '//counted(response%impacts, 'impact')
         else if (response%edp > 0.0_wp) then
            write (output_unit, '(a)') 'no collapse: largest EDP '//rounded(response%edp)//' at '// &
               & rounded(response%time_of_peak)//' s, '//counted(response%impacts, 'impact')
         else
            write (output_unit, '(a)') 'no motion: EDP 0'
         end if
         do i = 1, size(results%trace%ties)
            call make_tie_sentence(i, results%trace%ties(i), line)
            write (output_unit, '(a)') line
         end do
         if (case%solver%solver%estimate_error) then
            if (response%collapsed .and. .not. response%edp_error > 0.0_wp) then
               write (output_unit, '(a)') 'it collapses in both repeated runs too'
            else
               write (output_unit, '(a)') 'estimated error of the EDP: '//rounded(response%edp_error)
            end if
         end if
      end associate
   end subroutine print_history

   !> Print the stripes of the one wall
   subroutine print_stripes(case, results)
      type(case_type), intent(in) :: case
      type(results_type), intent(in) :: results

      character(len=:), allocatable :: head
      character(len=120) :: line
      character(len=24) :: counts
      real(wp) :: fraction
      integer :: j, k

      call make_head(case, head)
      write (output_unit, '(a, a12, a10)') head, 'collapses', 'fraction'
      do j = 1, size(case%stripes%levels)
         associate (collapses => results%row%reached(j, size(results%row%reached, 2)), &
            & histories => results%row%histories(j))
            counts = to_text(collapses)//'/'//to_text(histories)
            fraction = real(collapses, wp)/real(histories, wp)
         end associate
         write (line, '(a, a12, f10.3, 2x, a)') right(rounded(case%stripes%levels(j)), len(head)), &
            & trim(adjustl(counts)), fraction, bar(fraction)
         write (output_unit, '(a)') trim(line)
      end do
      write (output_unit, '(a)') ''
      do k = 1, size(results%row%curve) - 1
         write (output_unit, '(a)', advance='no') 'EDP '//rounded(case%stripes%thresholds(k))//': '
         call print_fit(case, results%row%curve(k))
      end do
      if (size(results%row%curve) > 1) write (output_unit, '(a)', advance='no') 'collapse: '
      call print_fit(case, results%row%curve(size(results%row%curve)))
      if (case%solver%solver%certify) then
         call print_certificates(case, results%row)
      else if (case%solver%solver%estimate_error) then
         write (output_unit, '(a)') 'estimated errors of the EDP: at most '// &
            & rounded(maxval(results%row%response%edp_error))
      end if
   end subroutine print_stripes

   !> Print how the histories are certified
   subroutine print_certificates(case, row)
      type(case_type), intent(in) :: case
      !> The stripes of the one wall
      type(row_counts_type), intent(in) :: row

      character(len=:), allocatable :: state
      integer :: k

      write (output_unit, '(a)') 'certified: '//to_text(count(row%certified%status == in_double))// &
         & ' histories in double precision, '//to_text(count(row%certified%status == in_quadruple))// &
         & ' in 33 digits, '//to_text(count(row%certified%status == not_computable))// &
         & ' not computable from this input'
      associate (bounds => row%bounds(size(row%bounds)))
         if (bounds%rounded > 0) then
            write (output_unit, '(a)') 'within half a unit of the last printed digit of the records, '// &
               & to_text(bounds%changed)//' of '//to_text(bounds%rounded)//' outcomes change'
         else
            write (output_unit, '(a)') 'the records have no printed digits whose rounding could be tried'
         end if
      end associate
      if (.not. any(row%certified%status == not_computable)) return
      do k = 1, size(row%bounds)
         state = ''
         if (k < size(row%bounds)) state = ' of EDP '//rounded(case%stripes%thresholds(k))
         associate (bounds => row%bounds(k))
            if (min(bounds%theta_lowest, bounds%theta_highest) > 0.0_wp) write (output_unit, '(a)') &
               & 'with those not computable as survivals or as collapses, theta'//state//' lies between '// &
               & rounded(bounds%theta_lowest)//' and '//rounded(bounds%theta_highest)
         end associate
      end do
   end subroutine print_certificates

   !> Print the curves of a population
   subroutine print_curves(case, results)
      type(case_type), intent(in) :: case
      type(results_type), intent(in) :: results

      character(len=12) :: theta
      character(len=10) :: beta
      character(len=6) :: heading
      integer :: width, longest, i, more

      heading = 'wall'
      if (allocated(results%designs)) heading = 'design'
      longest = 0
      do i = 1, size(results%shown)
         longest = max(longest, len(results%shown(i)%name))
      end do
      width = name_width(longest)
      theta = 'theta'//case%stripes%scaling%unit_after_blank()
      write (output_unit, '(a, a15, 2a10, 2x, a)') left(trim(heading), width), 'mechanism', trim(theta), 'beta', 'status'
      do i = 1, size(results%shown)
         theta = '-'
         beta = '-'
         associate (curve => results%shown(i)%curve)
            if (curve%has_fit()) then
               theta = rounded(curve%theta)
               beta = rounded(curve%beta)
            end if
            write (output_unit, '(a, a15, 2a10, 2x, a)') left(results%shown(i)%name, width), results%shown(i)%mechanism, &
               & trim(theta), adjustr(beta), trim(fit_status_names(curve%status))
         end associate
      end do
      more = case%survey%rows - size(results%shown)
      if (more > 0) write (output_unit, '(a)') '... and '//to_text(more)//' more'
      write (output_unit, '(a)') ''
   end subroutine print_curves

   !> Print the curves of the population: the fits, and the mean curve of all walls
   subroutine print_typology(case, results)
      type(case_type), intent(in) :: case
      type(results_type), intent(in) :: results

      character(len=:), allocatable :: head, who
      character(len=120) :: line
      integer :: i, j, k, thresholds

      call make_head(case, head)
      thresholds = size(results%typologies, 2)
      associate (typology => results%typologies(whole_population(results%typologies(:, thresholds)), thresholds))
         write (output_unit, '(a, a15, a12)') head, 'mean fraction', 'mean curve'
         do j = 1, size(typology%levels)
            write (line, '(a, f15.3, f12.3, 2x, a)') right(rounded(typology%levels(j)), len(head)), &
               & typology%mean_fraction(j), typology%mean_curve(j), bar(typology%mean_curve(j))
            write (output_unit, '(a)') trim(line)
         end do
         write (output_unit, '(a)') ''
      end associate
      do k = 1, thresholds
         do i = 1, size(results%typologies, 1)
            associate (typology => results%typologies(i, k))
               who = 'population, '//typology%mechanism
               if (len(typology%group) > 0) who = 'group '''//typology%group//''', '//typology%mechanism
               if (k < thresholds) who = who//', EDP '//rounded(case%stripes%thresholds(k))
               who = who//trim(occurring(typology%upper_asymptote))
               if (typology%fit%has_fit()) then
                  write (output_unit, '(a)') who//': theta = '//rounded(typology%fit%theta)// &
                     & case%stripes%scaling%unit_after_blank()//', beta = '//rounded(typology%fit%beta)// &
                     & ' (walls '//rounded(typology%beta_walls)//', records '//rounded(typology%beta_records)// &
                     & '), status '//trim(fit_status_names(typology%fit%status))//'; at 16, 50, 84 %: '// &
                     & trim(fractiles(case, typology%fit, typology%upper_asymptote))
                  call print_population_errors(typology)
               else
                  write (output_unit, '(a)') who//': no fragility curve, status '//trim(fit_status_names(typology%fit%status))
               end if
            end associate
         end do
      end do
   end subroutine print_typology

   !> Print what each design gains
   subroutine print_designs(designs)
      !> The designs, compared
      type(design_type), intent(in) :: designs(:)

      character(len=:), allocatable :: line
      integer :: i

      write (output_unit, '(a)') 'designs against '''//designs(1)%name//''', with 95 % intervals from paired records:'
      do i = 2, min(size(designs), shown_rows)
         call make_design_sentence(designs(i), designs(1), line)
         write (output_unit, '(a)') '   '//line
      end do
      if (size(designs) > shown_rows) write (output_unit, '(a)') '   ... and '//to_text(size(designs) - shown_rows)//' more'
      if (.not. any(designs%safety%is_known)) return
      write (output_unit, '(a)') 'checks of the designs by NTC 2018, zeta_E of SLV, with differences to '''//designs(1)%name//''':'
      do i = 1, min(size(designs), shown_rows)
         call make_safety_sentence(designs(i), designs(1), line)
         write (output_unit, '(a)') '   '//line
      end do
   end subroutine print_designs

end module dondolo_summary
