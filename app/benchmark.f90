!> What --benchmark prints: how fast this build is on this machine, and a fingerprint of what it computes.
module dondolo_benchmark
   use, intrinsic :: iso_fortran_env, only : compiler_options, compiler_version, int64, output_unit
   use dondolo_benchmark_walls, only : make_work, operations_per_step, repeat_walls
   use dondolo_case, only : case_type
   use dondolo_ensemble, only : name_engines
   use dondolo_error, only : error_type
   use dondolo_kinds, only : wp
   use dondolo_machine, only : arithmetic_rate, processor_name, seconds_since, surroundings
   use dondolo_member, only : member_type
   use dondolo_row_result, only : row_result_type
   use dondolo_run_rows, only : run_rows
   use dondolo_stripes, only : multiple_stripe, stripes_type
   use dondolo_study, only : study_type
   use dondolo_text, only : counted, rounded, to_text
   use dondolo_version, only : dondolo_version_text
   use dondolo_wall, only : mechanism_names
   use dondolo_work, only : work_type
   implicit none
   private

   public :: run_benchmark

   !> Times that everything is measured; the median counts
   integer, parameter :: times = 3

   !> What the work gives, once
   type :: outcome_type
      !> Collapses and histories of each mechanism
      integer :: collapses(size(mechanism_names)) = 0, histories(size(mechanism_names)) = 0
      !> Sum of all EDPs, each rounded to a millionth [1e-6]
      integer(int64) :: edps = 0
      !> What was computed, and multiplications and additions of its steps
      type(work_type) :: work
      real(wp) :: operations = 0.0_wp
   end type outcome_type

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
      type(member_type), allocatable :: walls(:)
      type(outcome_type) :: fingerprint
      character(len=160) :: line
      real(wp) :: once, alone, strong, weak, histories, arithmetic
      integer :: copies, team

      call make_work(work, walls, error)
      if (.not. allocated(error)) call find_fingerprint(work, walls, fingerprint, error)
      if (.not. allocated(error)) call measure(work, walls, 1, 1, once, error)
      if (allocated(error)) return
      copies = max(1, nint(seconds/once))
      histories = real(copies, wp)*real(sum(fingerprint%histories), wp)
      if (.not. quiet) call print_head(work, size(walls), fingerprint, copies)
      team = 1
      do
         call measure(work, walls, copies, team, strong, error)
         if (.not. allocated(error)) weak = strong
         if (.not. allocated(error) .and. team > 1) call measure(work, walls, copies*team, team, weak, error)
         if (allocated(error)) return
         if (team == 1) alone = strong
         write (line, '(i7, 2(i14, f10.2, f12.3))') team, nint(histories/strong), alone/strong, &
            & alone/(strong*real(team, wp)), nint(histories*real(team, wp)/weak), real(team, wp)*alone/weak, alone/weak
         if (.not. quiet) write (output_unit, '(a)') trim(line)
         flush (output_unit)
         if (team == threads) exit
         team = min(2*team, threads)
      end do
      if (.not. quiet) write (output_unit, '(a)') ''
      write (output_unit, '(a)') 'figure of merit: '//to_text(nint(histories*real(team, wp)/weak))// &
         & ' histories a second on '//counted(team, 'thread')//', '//to_text(nint(histories/weak))//' on each'
      if (quiet) return
      arithmetic = best_arithmetic(team, 0.1_wp*seconds)
      write (output_unit, '(a)') 'arithmetic of the steps: '//rounded(1.0e-9_wp*rate_of(fingerprint, once=weak, &
         & copies=copies*team))//'e9 operations a second, '//rounded(100.0_wp*rate_of(fingerprint, once=weak, &
         & copies=copies*team)/arithmetic)//' % of the '//rounded(1.0e-9_wp*arithmetic)// &
         & 'e9 of a loop of multiplications and additions', &
         & '   (the loop as this executable is compiled: an engine with wider vectors can exceed 100 %)', ''
      call print_fingerprint(fingerprint)
   end subroutine run_benchmark

   !> Run the work once, and keep what can be compared
   subroutine find_fingerprint(case, walls, fingerprint, error)
      type(case_type), intent(in), target :: case
      type(member_type), intent(in) :: walls(:)
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
            kind = findloc(mechanism_names == wall%mechanism_name(), .true., dim=1)
         end associate
         fingerprint%collapses(kind) = fingerprint%collapses(kind) + sum(stripes%collapses())
         fingerprint%histories(kind) = fingerprint%histories(kind) + size(stripes%response)
         fingerprint%edps = fingerprint%edps + sum(nint(1.0e6_wp*stripes%response%edp, int64))
         fingerprint%operations = fingerprint%operations + real(operations_per_step(case, walls(i)%wall), wp) &
            & *real(stripes%work%steps, wp)
         call fingerprint%work%add(stripes%work)
      end do
   end subroutine find_fingerprint

   !> Time that the work takes, several times over
   subroutine measure(case, walls, copies, threads, seconds, error)
      type(case_type), intent(in), target :: case
      type(member_type), intent(in) :: walls(:)
      !> How many times over
      integer, intent(in) :: copies
      !> Number of threads
      integer, intent(in) :: threads
      !> Median of several measurements [s]
      real(wp), intent(out) :: seconds
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
      seconds = sum(spent) - maxval(spent) - minval(spent)
   end subroutine measure

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

   !> Multiplications and additions of steps a second
   pure real(wp) function rate_of(fingerprint, once, copies)
      !> What the work gives
      type(outcome_type), intent(in) :: fingerprint
      !> Time of a measurement [s]
      real(wp), intent(in) :: once
      !> How many times over the work was done in it
      integer, intent(in) :: copies

      rate_of = fingerprint%operations*real(copies, wp)/once
   end function rate_of

   !> Print what is measured, and of what
   subroutine print_head(case, walls, fingerprint, copies)
      type(case_type), intent(in) :: case
      !> Number of its walls
      integer, intent(in) :: walls
      !> What it gives
      type(outcome_type), intent(in) :: fingerprint
      !> How many times over it is done
      integer, intent(in) :: copies

      character(len=:), allocatable :: engines

      call name_engines(fingerprint%work, engines)
      write (output_unit, '(a)') 'dondolo '//dondolo_version_text//', benchmark', '', &
         & 'processor: '//trim(processor_name()), &
         & 'machine: '//trim(surroundings()), &
         & 'compiler: '//compiler_version()//', real'//to_text(storage_size(1.0_wp)), &
         & 'options: '//compiler_options(), &
         & 'engine: '//engines
      associate (work => fingerprint%work)
         write (output_unit, '(a)') 'work: '//to_text(walls)//' walls, '// &
            & to_text(size(case%suite%records))//' synthetic accelerograms, '//to_text(size(case%stripes%levels))// &
            & ' levels, '//to_text(copies)//' times over', &
            & '   '//to_text(work%histories)//' histories, '//to_text(work%still)//' of them never move; '// &
            & to_text(work%intervals)//' sample intervals, the wall rocks in '//to_text(work%rocked)//'; '// &
            & to_text(work%steps)//' steps', ''
      end associate
      write (output_unit, '(a7, 2a36)') '', 'this work', 'this work for each thread'
      write (output_unit, '(a7, 2(a14, a10, a12))') 'threads', 'histories/s', 'speed-up', 'efficiency', &
         & 'histories/s', 'speed-up', 'efficiency'
   end subroutine print_head

   !> Print what can be compared with other machines
   subroutine print_fingerprint(fingerprint)
      !> What the work gives
      type(outcome_type), intent(in) :: fingerprint

      integer :: i

      write (output_unit, '(a)') 'fingerprint of the results:'
      do i = 1, size(mechanism_names)
         write (output_unit, '(a)') '   '//trim(mechanism_names(i))//': '//to_text(fingerprint%collapses(i))// &
            & ' collapses in '//to_text(fingerprint%histories(i))//' histories'
      end do
      write (output_unit, '(a)') '   sum of the EDPs: '//to_text(fingerprint%edps)//' millionths', &
         & 'Collapses agree between machines, compilers and variants, but for histories on the edge of collapse; the', &
         & 'sum may differ by some hundreds, since rocking amplifies rounding errors, and in a few histories they show.'
   end subroutine print_fingerprint

end module dondolo_benchmark
