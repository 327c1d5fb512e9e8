!> What --benchmark prints: how fast this build is on this machine, and a fingerprint of what it computes.
module dondolo_benchmark
   use, intrinsic :: iso_fortran_env, only : compiler_version, int64, output_unit
   use dondolo_base_error, only : error_type
   use dondolo_base_kinds, only : wp
   use dondolo_base_text, only : counted, rounded, to_text
   use dondolo_benchmark_walls, only : make_work, operations_per_step, repeat_walls, walls_of_each
   use dondolo_case, only : case_type
   use dondolo_files_version, only : dondolo_version_text
   use dondolo_fragility_stripes, only : multiple_stripe, stripes_type
   use dondolo_fragility_study, only : study_type
   use dondolo_machine, only : arithmetic_rate, processor_name, seconds_since, surroundings
   use dondolo_motion_ensemble, only : name_engines
   use dondolo_motion_lane_variants, only : engine_options
   use dondolo_motion_work, only : work_type
   use dondolo_population_row_result, only : row_result_type
   use dondolo_population_run_rows, only : run_rows
   use dondolo_population_wall_row, only : wall_row_type
   use dondolo_wall, only : masonry_names
   implicit none
   private

   public :: run_benchmark

   !> Times that everything is measured; the median counts
   integer, parameter :: times = 3

   !> What the work gives, once
   type :: outcome_type
      !> Collapses and histories of each mechanism
      integer :: collapses(size(masonry_names)) = 0, histories(size(masonry_names)) = 0
      !> Sum of all EDPs, each rounded to a millionth [1e-6]
      integer(int64) :: edps = 0
   end type outcome_type

   !> Time of some walls, and what was computed in it
   type :: measured_type
      !> Median of several measurements [s]
      real(wp) :: seconds = 0.0_wp
      !> Counts of one of them
      type(work_type) :: work
      !> Multiplications and additions of the steps of one of them
      real(wp) :: operations = 0.0_wp
   contains
      !> Histories a second
      procedure :: histories_per_second
      !> Multiplications and additions of the steps a second
      procedure :: operations_per_second
   end type measured_type

contains

   !> Measure and print
   subroutine run_benchmark(seconds, threads, quiet, error)
      !> How long one measurement on one thread shall take [s]
      real(wp), intent(in) :: seconds
      !> Most threads
      integer, intent(in) :: threads
      !> Print the figure of merit only?
      logical, intent(in) :: quiet
      !> It could not be run
      type(error_type), allocatable, intent(out) :: error

      type(case_type) :: work
      type(wall_row_type), allocatable :: walls(:)
      type(outcome_type) :: fingerprint
      type(measured_type) :: once, alone, strong, weak
      character(len=160) :: line
      real(wp) :: limit
      integer :: copies, team

      call make_work(work, walls, error)
      if (.not. allocated(error)) call compute_fingerprint(work, walls, fingerprint, error)
      if (.not. allocated(error)) call measure(work, walls, 1, 1, once, error)
      if (allocated(error)) return
      copies = max(1, nint(seconds/once%seconds))
      if (.not. quiet) call print_head(work, size(walls), once%work, copies)
      team = 1
      do
         call measure(work, walls, copies, team, strong, error)
         if (.not. allocated(error)) weak = strong
         if (.not. allocated(error) .and. team > 1) call measure(work, walls, copies*team, team, weak, error)
         if (allocated(error)) return
         if (team == 1) alone = strong
         associate (gain => alone%seconds/strong%seconds, efficiency => alone%seconds/weak%seconds)
            write (line, '(i7, 2(i14, f10.2, f12.3))') team, nint(strong%histories_per_second()), gain, &
               & gain/real(team, wp), nint(weak%histories_per_second()), real(team, wp)*efficiency, efficiency
         end associate
         if (.not. quiet) write (output_unit, '(a)') trim(line)
         flush (output_unit)
         if (team == threads) exit
         team = min(2*team, threads)
      end do
      if (.not. quiet) write (output_unit, '(a)') ''
      write (output_unit, '(a)') 'figure of merit: '//to_text(nint(weak%histories_per_second()))// &
         & ' histories a second on '//counted(team, 'thread')//', '// &
         & to_text(nint(weak%histories_per_second()/real(team, wp)))//' on each'
      if (quiet) return
      limit = best_arithmetic(team, 0.1_wp*seconds)
      write (output_unit, '(a)') 'arithmetic of the steps: '//rounded(1.0e-9_wp*weak%operations_per_second())// &
         & 'e9 operations a second, '//rounded(100.0_wp*weak%operations_per_second()/limit)//' % of the '// &
         & rounded(1.0e-9_wp*limit)//'e9 of a loop of multiplications and additions', &
         & '   (the loop as this executable is compiled: an engine with wider vectors can exceed 100 %)'
      call print_mechanisms(work, walls, copies*team, team, limit, error)
      if (.not. allocated(error)) call print_fingerprint(fingerprint)
   end subroutine run_benchmark

   !> Run the work once, and keep what can be compared
   subroutine compute_fingerprint(case, walls, fingerprint, error)
      type(case_type), intent(in), target :: case
      type(wall_row_type), intent(in) :: walls(:)
      !> What it gives
      type(outcome_type), intent(out) :: fingerprint
      !> It could not be run
      type(error_type), allocatable, intent(out) :: error

      type(study_type) :: study
      type(stripes_type) :: stripes
      integer :: i, kind

      call case%make_study(study)
      ! All EDPs are compared
      study%solver%collapses_only = .false.
      do i = 1, size(walls)
         associate (wall => walls(i)%wall)
            call multiple_stripe(stripes, wall, study, error)
            if (allocated(error)) return
            kind = findloc(masonry_names == wall%mechanism_name(), .true., dim=1)
         end associate
         fingerprint%collapses(kind) = fingerprint%collapses(kind) + sum(stripes%collapses())
         fingerprint%histories(kind) = fingerprint%histories(kind) + size(stripes%response)
         fingerprint%edps = fingerprint%edps + sum(nint(1.0e6_wp*stripes%response%edp, int64))
      end do
   end subroutine compute_fingerprint

   !> Time that the work takes, several times over
   subroutine measure(case, walls, copies, threads, found, error)
      type(case_type), intent(in), target :: case
      type(wall_row_type), intent(in) :: walls(:)
      !> How many times over
      integer, intent(in) :: copies
      !> Number of threads
      integer, intent(in) :: threads
      !> Time, and what was computed in it
      type(measured_type), intent(out) :: found
      !> It could not be run
      type(error_type), allocatable, intent(out) :: error

      type(study_type) :: study
      type(row_result_type), allocatable :: rows(:)
      integer(int64) :: start
      real(wp) :: spent(times)
      integer :: i

      call case%make_study(study, threads)
      do i = 1, times
         call system_clock(start)
         call run_rows(study, repeat_walls(walls, copies), rows, error, 0, 0)
         if (allocated(error)) return
         spent(i) = seconds_since(start)
      end do
      ! The median of three
      found%seconds = sum(spent) - maxval(spent) - minval(spent)
      do i = 1, size(rows)
         call found%work%add(rows(i)%work)
         found%operations = found%operations + real(rows(i)%work%steps, wp) &
            & *real(operations_per_step(case, walls(modulo(i - 1, size(walls)) + 1)%wall), wp)
      end do
   end subroutine measure

   !> Histories a second
   pure real(wp) function histories_per_second(self)
      class(measured_type), intent(in) :: self

      histories_per_second = real(self%work%histories, wp)/self%seconds
   end function histories_per_second

   !> Multiplications and additions of the steps a second
   pure real(wp) function operations_per_second(self)
      class(measured_type), intent(in) :: self

      operations_per_second = self%operations/self%seconds
   end function operations_per_second

   !> The fastest of several measurements: what the machine can do
   real(wp) function best_arithmetic(threads, seconds)
      !> Number of threads
      integer, intent(in) :: threads
      !> How long one measurement takes [s]
      real(wp), intent(in) :: seconds

      integer :: i

      best_arithmetic = 0.0_wp
      do i = 1, times
         best_arithmetic = max(best_arithmetic, arithmetic_rate(threads, seconds))
      end do
   end function best_arithmetic

   !> Print what is measured, and of what
   subroutine print_head(case, walls, work, copies)
      type(case_type), intent(in) :: case
      !> Number of its walls
      integer, intent(in) :: walls
      !> What is computed, once
      type(work_type), intent(in) :: work
      !> How many times over it is done
      integer, intent(in) :: copies

      character(len=:), allocatable :: engines, options

      call name_engines(work, engines)
      call engine_options(options)
      write (output_unit, '(a)') 'dondolo '//dondolo_version_text//', benchmark', '', &
         & 'processor: '//trim(processor_name()), &
         & 'machine: '//trim(surroundings()), &
         & 'compiler: '//compiler_version()//', real'//to_text(storage_size(1.0_wp)), &
         & 'options: '//options, &
         & 'engine: '//engines
      write (output_unit, '(a)') 'work: '//to_text(walls)//' walls, '// &
         & to_text(size(case%suite%records))//' synthetic accelerograms, '//to_text(size(case%stripes%levels))// &
         & ' levels, '//to_text(copies)//' times over', &
         & '   '//to_text(work%histories)//' histories, '//to_text(work%still)//' of them never move; '// &
         & to_text(work%intervals)//' sample intervals, the wall rocks in '//to_text(work%rocked)//'; '// &
         & to_text(work%steps)//' steps', ''
      write (output_unit, '(a7, 2a36)') '', 'this work', 'this work for each thread'
      write (output_unit, '(a7, 2(a14, a10, a12))') 'threads', 'histories/s', 'speed-up', 'efficiency', &
         & 'histories/s', 'speed-up', 'efficiency'
   end subroutine print_head

   !> Measure the walls of each mechanism by themselves, and print it
   subroutine print_mechanisms(case, walls, copies, threads, limit, error)
      type(case_type), intent(in) :: case
      type(wall_row_type), intent(in) :: walls(:)
      !> How many times over
      integer, intent(in) :: copies
      !> Number of threads
      integer, intent(in) :: threads
      !> Multiplications and additions a second of a loop of nothing else
      real(wp), intent(in) :: limit
      !> It could not be run
      type(error_type), allocatable, intent(out) :: error

      type(measured_type) :: found
      character(len=80) :: line
      integer :: i

      write (output_unit, '(a16, 3a20)') 'mechanism', 'histories/s', '1e9 operations/s', '% of the loop'
      do i = 1, size(masonry_names)
         call measure(case, walls((i - 1)*walls_of_each + 1:i*walls_of_each), copies, threads, found, error)
         if (allocated(error)) return
         write (line, '(a16, i20, 2f20.2)') trim(masonry_names(i)), nint(found%histories_per_second()), &
            & 1.0e-9_wp*found%operations_per_second(), 100.0_wp*found%operations_per_second()/limit
         write (output_unit, '(a)') trim(line)
      end do
      write (output_unit, '(a)') ''
   end subroutine print_mechanisms

   !> Print what can be compared with other machines
   subroutine print_fingerprint(fingerprint)
      !> What the work gives
      type(outcome_type), intent(in) :: fingerprint

      integer :: i

      write (output_unit, '(a)') 'fingerprint of the results:'
      do i = 1, size(masonry_names)
         write (output_unit, '(a)') '   '//trim(masonry_names(i))//': '//to_text(fingerprint%collapses(i))// &
            & ' collapses in '//to_text(fingerprint%histories(i))//' histories'
      end do
      write (output_unit, '(a)') '   sum of the EDPs: '//to_text(fingerprint%edps)//' millionths', &
         & 'Collapses agree between machines, compilers and variants, but for histories on the edge of collapse; the', &
         & 'sum may differ by some hundreds, since rocking amplifies rounding errors, and in a few histories they show.'
   end subroutine print_fingerprint

end module dondolo_benchmark
