!> Are printed times equally spaced, as far as their print can tell?
!>
!> A print rounds: to its last decimal, or to its number of significant digits, whichever is coarser for a given
!> time. Steps may differ by that much and by 1 % of a step, so that a missing or doubled sample is always found
!> where the print resolves a quarter of a step.
!>
!> The time step is the shortest decimal that all times allow: 0.02 of 0.019999999552965164, 0.03999999910593033 ..., which a
!> program had in single precision before it printed them.
!>
!> Where the print does not resolve a step, as two decimals do not at 200 Hz, a step that is known is taken if it fits all times:
!> some first instant puts every sample within half a unit of the last decimal of its printed time. Then samples that are missing
!> or doubled are found once they make up more than that unit.
module dondolo_records_equal_steps
   use, intrinsic :: iso_fortran_env, only : real32
   use dondolo_base_error, only : error_type
   use dondolo_base_kinds, only : wp
   use dondolo_base_text, only : brief, to_text
   use dondolo_files_text_file, only : text_file_type
   use dondolo_records_format, only : raise_at
   implicit none
   private

   public :: check_equal_steps, step_type

   !> The time step of printed times
   type :: step_type
      !> The shortest decimal within the rounding of the times, or the known one [s]
      real(wp) :: dt = 0.0_wp
      !> By how much the rounding of the times may have moved it [s]
      real(wp) :: doubt = 0.0_wp
      !> That times are coarser than the known step, which was taken; empty otherwise
      character(len=:), allocatable :: note
   end type step_type

   !> Part of a step by which times may be off beyond their rounding
   real(wp), parameter :: slack = 0.01_wp

   !> Part of a step that the print must resolve
   real(wp), parameter :: resolved = 0.25_wp

   !> Most steps in a unit of the last decimal where the step is known
   real(wp), parameter :: coarsest = 10.0_wp

   !> Most significant digits of a step
   integer, parameter :: most_digits = 15

   !> Of times that were added up, whose errors add up too: most significant digits of a step, and largest relative doubt
   integer, parameter :: few_digits = 2
   real(wp), parameter :: largest_doubt = 1.0e-4_wp

contains

   !> Check the times of a file and find the time step
   subroutine check_equal_steps(text, begin, time, first, last, step, error, known)
      type(text_file_type), intent(in) :: text
      !> Line of the first time; the others stand in the lines after it
      integer, intent(in) :: begin
      !> Times [s]
      real(wp), intent(in) :: time(:)
      !> Position in the file's text of the first character of each time
      integer, intent(in) :: first(:)
      !> Position of the last character of each time
      integer, intent(in) :: last(:)
      !> Time step
      type(step_type), intent(out) :: step
      !> Times decrease or are not equally spaced
      type(error_type), allocatable, intent(out) :: error
      !> Time step that is given, or stated elsewhere in the file; not positive: none [s]
      real(wp), intent(in), optional :: known

      character(len=:), allocatable :: hint
      integer :: i, n, odd, decimals, digits
      real(wp) :: rounding, rounding_of_last, allowed

      step%note = ''
      n = size(time)
      if (n < 2) then
         call raise_at(error, text, begin, '1 sample: a record needs at least two')
         return
      end if
      do i = 2, n
         if (time(i) >= time(i - 1)) cycle
         call raise_at(error, text, begin + i - 1, 'time '//to_text(time(i))//' after '//to_text(time(i - 1))// &
            & ': times must increase')
         return
      end do
      step%dt = (time(n) - time(1))/real(n - 1, wp)
      if (.not. step%dt > 0.0_wp) then
         call raise_at(error, text, begin + 1, 'all times are '//to_text(time(1))//': must increase')
         return
      end if
      call print_of_times(text, first, last, decimals, digits)
      rounding_of_last = rounding_of(time(n), step%dt, decimals, digits)
      ! Most times are within the rounding of their last decimal, which is quickly seen
      allowed = min(10.0_wp**(-decimals), resolved*step%dt) + slack*step%dt
      do i = 2, n
         if (abs(time(i) - time(i - 1) - step%dt) <= allowed .and. &
            & abs(time(i) - time(1) - real(i - 1, wp)*step%dt) <= allowed) cycle
         rounding = rounding_of(time(i), step%dt, decimals, digits)
         if (abs(time(i) - time(i - 1) - step%dt) <= rounding + slack*step%dt .and. &
            & abs(time(i) - time(1) - real(i - 1, wp)*step%dt) <= max(rounding, rounding_of_last) + slack*step%dt) cycle
         if (present(known)) then
            if (fits(time, 10.0_wp**(-decimals), known)) then
               step%dt = known
               step%note = 'times are printed to '//brief(10.0_wp**(-decimals))//' s, coarser than the step of '// &
                  & brief(step%dt)//' s, which fits all of them'
               return
            end if
         end if
         ! The step that differs most is where a sample is missing or doubled
         odd = maxloc(abs(time(2:) - time(:n - 1) - step%dt), dim=1) + 1
         hint = ''
         if (10.0_wp**(-decimals) > resolved*step%dt) hint = '; times with so few decimals are read with a dt_s, or dt, that '// &
            & 'fits them'
         call raise_at(error, text, begin + odd - 1, 'time '//to_text(time(odd))//' after '//to_text(time(odd - 1))// &
            & ': times must be equally spaced, the mean step is '//brief(step%dt)//hint)
         return
      end do
      call find_step(time, decimals, digits, step%dt, step%doubt)
   end subroutine check_equal_steps

   !> Does a step fit all times, which are rounded to a unit?
   pure logical function fits(time, unit, step)
      !> Times [s]
      real(wp), intent(in) :: time(:)
      !> Unit of their last decimal, and step [s]
      real(wp), intent(in) :: unit, step

      ! Of what decimals lose in double precision
      real(wp), parameter :: rounding = 1.0e-6_wp
      real(wp) :: off, low, high
      integer :: i

      fits = step > 0.0_wp .and. unit <= coarsest*step
      if (.not. fits) return
      low = 0.0_wp
      high = 0.0_wp
      do i = 2, size(time)
         off = time(i) - time(1) - real(i - 1, wp)*step
         low = min(low, off)
         high = max(high, off)
      end do
      fits = high - low <= unit*(1.0_wp + rounding)
   end function fits

   !> Find the shortest decimal among the steps that the print of the times allows
   pure subroutine find_step(time, decimals, digits, dt, doubt)
      !> Times [s]
      real(wp), intent(in) :: time(:)
      !> Decimals and significant digits of their print
      integer, intent(in) :: decimals, digits
      !> Time step: the mean one, then the shortest decimal [s]
      real(wp), intent(inout) :: dt
      !> By how much it may be off [s]
      real(wp), intent(out) :: doubt

      real(wp) :: low, high, rounding, mean, precision_of_times
      logical :: is_single
      integer :: i, n

      mean = dt
      n = size(time)
      is_single = .true.
      do i = 2, n
         if (abs(time(i) - real(real(time(i), real32), wp)) <= rounding_of(time(i), dt, decimals, digits)) cycle
         is_single = .false.
         exit
      end do
      precision_of_times = epsilon(1.0_wp)
      if (is_single) precision_of_times = real(epsilon(1.0_real32), wp)
      low = 0.0_wp
      high = huge(high)
      do i = 2, n
         rounding = max(rounding_of(time(i), dt, decimals, digits), 2.0_wp*precision_of_times*abs(time(i)))
         low = max(low, (time(i) - time(1) - rounding)/real(i - 1, wp))
         high = min(high, (time(i) - time(1) + rounding)/real(i - 1, wp))
      end do
      if (low <= high) then
         call shorten(dt, low, high, most_digits)
      else
         ! Each time is the sum of a step and the one before, rounded
         rounding = min(0.5_wp*real(n, wp)*precision_of_times, largest_doubt)
         low = mean*(1.0_wp - rounding)
         high = mean*(1.0_wp + rounding)
         call shorten(dt, low, high, few_digits)
      end if
      doubt = max(abs(dt - low), abs(high - dt), abs(mean - dt))
   end subroutine find_step

   !> Replace a number by the shortest decimal of a range
   pure subroutine shorten(value, low, high, most)
      !> Number, positive; stays where there is no such decimal
      real(wp), intent(inout) :: value
      !> The range
      real(wp), intent(in) :: low, high
      !> Most significant digits
      integer, intent(in) :: most

      real(wp) :: candidate
      integer :: digits, power

      do digits = 1, most
         power = digits - 1 - floor(log10(value))
         candidate = anint(value*10.0_wp**power)
         ! Over an exact power of ten: the number nearest to the decimal
         if (power >= 0) candidate = candidate/10.0_wp**power
         if (power < 0) candidate = candidate*10.0_wp**(-power)
         if (candidate < low .or. candidate > high) cycle
         value = candidate
         return
      end do
   end subroutine shorten

   !> By how much the print of a time may have moved it
   pure function rounding_of(time, dt, decimals, digits) result(rounding)
      !> Time [s]
      real(wp), intent(in) :: time
      !> Time step [s]
      real(wp), intent(in) :: dt
      !> Decimals of the print
      integer, intent(in) :: decimals
      !> Significant digits of the print
      integer, intent(in) :: digits
      !> One unit of the last printed digit, bounded where the print never resolves a step [s]
      real(wp) :: rounding

      rounding = 10.0_wp**(-decimals)
      if (rounding > resolved*dt) then
         rounding = resolved*dt
         return
      end if
      if (abs(time) > 0.0_wp) rounding = max(rounding, 10.0_wp**(floor(log10(abs(time))) + 1 - digits))
   end function rounding_of

   !> How times are printed
   pure subroutine print_of_times(text, first, last, decimals, digits)
      type(text_file_type), intent(in) :: text
      !> Position of the first character of each time
      integer, intent(in) :: first(:)
      !> Position of the last character of each time
      integer, intent(in) :: last(:)
      !> Most decimals of any
      integer, intent(out) :: decimals
      !> Most significant digits of any
      integer, intent(out) :: digits

      integer :: i, k, after, exponent, significant
      logical :: point

      decimals = 0
      digits = 1
      do i = 1, size(first)
         exponent = 0
         point = .false.
         after = 0
         significant = 0
         do k = first(i), last(i)
            select case (text%text(k:k))
            case ('0':'9')
               if (point) after = after + 1
               if (significant > 0 .or. text%text(k:k) /= '0') significant = significant + 1
            case ('.')
               point = .true.
            case ('e', 'E', 'd', 'D')
               read (text%text(k + 1:last(i)), *) exponent
               exit
            end select
         end do
         decimals = max(decimals, after - exponent)
         digits = max(digits, significant)
      end do
   end subroutine print_of_times

end module dondolo_records_equal_steps
