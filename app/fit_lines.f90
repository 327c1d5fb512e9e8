!> What is printed of a fitted curve, and columns of tables on the terminal.
module dondolo_fit_lines
   use, intrinsic :: iso_fortran_env, only : output_unit
   use dondolo_base_kinds, only : wp
   use dondolo_base_text, only : counted, right, rounded, to_text
   use dondolo_case, only : case_type
   use dondolo_fragility, only : fit_status_names, fragility_type
   use dondolo_fragility_clustered, only : fewest_clusters, parameter_intervals
   use dondolo_population_typology, only : typology_type
   implicit none
   private

   public :: print_fit, print_population_errors, fractiles, occurring, bar, make_head, name_width

   !> Widest bar of a table
   integer, parameter :: bar_width = 40
   !> Least and largest width of a column of names
   integer, parameter :: narrowest = 12, widest = 80

contains

   !> Print a curve, or why there is none
   subroutine print_fit(case, curve, upper_asymptote)
      type(case_type), intent(in) :: case
      type(fragility_type), intent(in) :: curve
      !> Probability that the mechanisms can occur; absent: 1
      real(wp), intent(in), optional :: upper_asymptote

      real(wp) :: share

      share = 1.0_wp
      if (present(upper_asymptote)) share = upper_asymptote
      if (curve%has_fit()) then
         write (output_unit, '(a)') 'theta = '//rounded(curve%theta)//case%stripes%scaling%unit_after_blank()// &
            & ', beta = '//rounded(curve%beta)//', status '//trim(fit_status_names(curve%status))
         call print_errors(curve)
         write (output_unit, '(a)') case%stripes%scaling%name//' at a probability of 16, 50, 84 %: '// &
            & trim(fractiles(case, curve, share))//trim(occurring(share))
      else
         write (output_unit, '(a)') 'no fragility curve, status '//trim(fit_status_names(curve%status))
      end if
   end subroutine print_fit

   !> Print the standard errors and intervals of a curve, or why it has none
   subroutine print_errors(curve)
      type(fragility_type), intent(in) :: curve

      real(wp) :: bounds(2, 2)

      if (.not. curve%has_errors()) then
         write (output_unit, '(a)') 'no standard errors: '//trim(why_none(curve))
      else
         bounds = parameter_intervals(curve)
         write (output_unit, '(a)') 'standard errors: '//rounded(curve%se_ln_theta())//' of ln theta, '// &
            & rounded(curve%se_beta())//' of beta; 95 % intervals: theta '//rounded(bounds(1, 1))//' to '// &
            & rounded(bounds(2, 1))//', beta '//rounded(bounds(1, 2))//' to '//trim(upper_end(bounds(2, 2))), &
            & '('//counted(curve%clusters, 'cluster')//' of records, '//to_text(curve%clusters - 1)// &
            & ' degrees of freedom; naive standard errors, as if all histories were independent: '// &
            & rounded(sqrt(curve%naive(1, 1)))//' and '//rounded(sqrt(curve%naive(2, 2)))//')'
      end if
   end subroutine print_errors

   !> Why a curve has no standard errors, filled up with blanks
   pure function why_none(curve) result(text)
      type(fragility_type), intent(in) :: curve
      character(len=80) :: text

      select case (curve%errors)
      case ('few_clusters')
         text = counted(curve%clusters, 'cluster')//' of records, at least '//to_text(fewest_clusters)//' are needed'
      case ('few_walls')
         text = counted(curve%clusters, 'wall')//', at least '//to_text(fewest_clusters)//' are needed for the spread between walls'
      case ('one_wall')
         text = 'without one of the walls no curve can be fitted'
      case default
         text = 'one cluster of records determines the curve'
      end select
   end function why_none

   !> Levels at which 16, 50 and 84 % collapse
   pure function fractiles(case, curve, upper_asymptote) result(text)
      type(case_type), intent(in) :: case
      type(fragility_type), intent(in) :: curve
      !> Share that can collapse
      real(wp), intent(in) :: upper_asymptote
      !> The levels and their unit, then 'never' where so many cannot collapse; filled up with blanks
      character(len=160) :: text

      real(wp), parameter :: shares(3) = [0.16_wp, 0.50_wp, 0.84_wp]
      integer :: i

      ! The shares increase, so that those that are never reached come last
      text = ''
      do i = 1, size(shares)
         if (shares(i) < upper_asymptote) then
            text = trim(text)//' '//rounded(curve%level(shares(i)/upper_asymptote))
            if (i == count(shares < upper_asymptote)) text = trim(text)//case%stripes%scaling%unit_after_blank()
         else
            text = trim(text)//' never'
         end if
         if (i < size(shares)) text = trim(text)//','
      end do
      text = adjustl(text)
   end function fractiles

   !> The share that can collapse, in brackets after a blank; empty if all can
   pure function occurring(upper_asymptote) result(text)
      real(wp), intent(in) :: upper_asymptote
      character(len=40) :: text

      text = ''
      if (upper_asymptote < 1.0_wp) text = ' (can occur: '//rounded(100.0_wp*upper_asymptote)//' %)'
   end function occurring

   !> Print the standard errors of a curve of the population and their intervals, or why it has none
   subroutine print_population_errors(typology)
      type(typology_type), intent(in) :: typology

      real(wp) :: bounds(2, 2)

      associate (fit => typology%fit)
         if (fit%has_errors()) then
            bounds = parameter_intervals(fit)
            write (output_unit, '(a)') '  standard errors over records'//trim(merge(' and walls', '          ', &
               & typology%walls > 1))//': '//rounded(fit%se_ln_theta())// &
               & ' of ln theta, '//rounded(fit%se_beta())//' of beta; 95 % intervals: theta '//rounded(bounds(1, 1))// &
               & ' to '//rounded(bounds(2, 1))//', beta '//rounded(bounds(1, 2))//' to '//trim(upper_end(bounds(2, 2)))
         else
            write (output_unit, '(a)') '  no standard errors: '//trim(why_none(fit))
         end if
      end associate
   end subroutine print_population_errors

   !> The upper end of an interval of beta, filled up with blanks
   pure function upper_end(bound) result(text)
      !> Huge if there is none
      real(wp), intent(in) :: bound
      character(len=24) :: text

      text = 'infinity'
      if (bound < huge(bound)) text = rounded(bound)
   end function upper_end

   !> A bar as long as a fraction
   pure function bar(fraction)
      !> Fraction, 0 to 1
      real(wp), intent(in) :: fraction
      !> Bar
      character(len=nint(fraction*real(bar_width, wp))) :: bar

      bar = repeat('#', len(bar))
   end function bar

   !> Make the head of a column of levels: the measure and its unit
   pure subroutine make_head(case, head)
      type(case_type), intent(in) :: case
      !> Head, at least as wide as a number
      character(len=:), allocatable, intent(out) :: head

      head = case%stripes%scaling%name//case%stripes%scaling%unit_after_blank()
      head = right(head, max(12, len(head) + 1))
   end subroutine make_head

   !> Width of a column of names, one blank after the longest name included
   pure integer function name_width(longest)
      !> Length of the longest name
      integer, intent(in) :: longest

      name_width = min(max(narrowest, longest + 1), widest)
   end function name_width

end module dondolo_fit_lines
