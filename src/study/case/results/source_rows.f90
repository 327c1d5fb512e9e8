!> What the curve of a wall with variants owes to each of its uncertain properties: for people and tables.
module dondolo_case_source_rows
   use dondolo_base_kinds, only : wp
   use dondolo_base_text, only : rounded, to_text
   use dondolo_case, only : case_type
   use dondolo_case_results, only : results_type
   use dondolo_case_table, only : table_type
   use dondolo_fragility, only : fit_status_names, fragility_type
   use dondolo_population_sensitivity, only : sensitivity_type
   use dondolo_population_typology, only : whole_population
   implicit none
   private

   public :: put_source, collapse_of, make_source_sentence, make_model_sentence

contains

   !> A source as a row
   subroutine put_source(table, name, distribution, values, curves, source, sensitivity)
      class(table_type), intent(inout) :: table
      !> The property, and its distribution
      character(len=*), intent(in) :: name, distribution
      !> Its 5 %, 50 % and 95 % fractiles
      real(wp), intent(in) :: values(3)
      !> Curves of collapse at the first and at the last of these
      type(fragility_type), intent(in) :: curves(2)
      !> Its number among those that have Sobol indices
      integer, intent(in) :: source
      !> These, if there are any
      type(sensitivity_type), intent(in), optional :: sensitivity

      real(wp) :: first(3), total(3)
      logical :: given

      given = present(sensitivity)
      first = 0.0_wp
      total = 0.0_wp
      if (given) then
         first = [sensitivity%first(source), sensitivity%first_interval(:, source)]
         total = [sensitivity%total(source), sensitivity%total_interval(:, source)]
      end if
      call table%put('source', name)
      call table%put('distribution', distribution)
      call table%put('value_5', values(1))
      call table%put('value_50', values(2))
      call table%put('value_95', values(3))
      call table%put('theta_5', curves(1)%theta, curves(1)%has_fit())
      call table%put('theta_95', curves(2)%theta, curves(2)%has_fit())
      call table%put('first', first(1), given)
      call table%put('first_low', first(2), given)
      call table%put('first_high', first(3), given)
      call table%put('total', total(1), given)
      call table%put('total_low', total(2), given)
      call table%put('total_high', total(3), given)
   end subroutine put_source

   !> A source in words
   subroutine make_source_sentence(case, results, source, line)
      type(case_type), intent(in) :: case
      type(results_type), intent(in) :: results
      !> Its number
      integer, intent(in) :: source
      !> Line
      character(len=:), allocatable, intent(out) :: line

      type(fragility_type) :: curve
      integer :: i

      associate (wall => case%table%base_wall)
         line = '   '//trim(wall%sources(source))//' from '//rounded(wall%values(source, wall%row_of_end(source, 1)))// &
            & ' to '//rounded(wall%values(source, wall%row_of_end(source, 2)))//': theta'
         do i = 1, 2
            curve = collapse_of(results, wall%row_of_end(source, i))
            line = line//trim(merge(' from', ' to  ', i == 1))//' '
            if (curve%has_fit()) line = line//rounded(curve%theta)
            if (.not. curve%has_fit()) line = line//'('//trim(fit_status_names(curve%status))//')'
         end do
      end associate
      line = line//case%stripes%scaling%unit_after_blank()
      if (.not. allocated(results%sensitivity)) return
      associate (found => results%sensitivity)
         line = line//'; '//to_text(nint(100.0_wp*found%first(source)))//' % of the variance of ln theta in the sample, '// &
            & to_text(nint(100.0_wp*found%total(source)))//' % with the others'
      end associate
   end subroutine make_source_sentence

   !> Dispersions of the model and of the records, in words
   subroutine make_model_sentence(case, results, line)
      type(case_type), intent(in) :: case
      type(results_type), intent(in) :: results
      !> Line
      character(len=:), allocatable, intent(out) :: line

      type(fragility_type) :: given, middle
      integer :: i, last, fitted

      last = size(results%typologies, 2)
      middle = collapse_of(results, case%table%base_wall%samples + 2)
      associate (whole => results%typologies(whole_population(results%typologies(:, last)), last))
         line = 'beta of the model '//rounded(whole%beta_walls)//', of the records '//rounded(whole%beta_records)// &
            & ', in all '//rounded(hypot(whole%beta_walls, whole%beta_records))
      end associate
      fitted = 0
      do i = 1, case%table%base_wall%samples
         given = collapse_of(results, i)
         if (given%has_fit()) fitted = fitted + 1
      end do
      if (fitted < case%table%base_wall%samples) line = line//' (of the '//to_text(fitted)//' of '// &
         & to_text(case%table%base_wall%samples)//' variants that have a fit)'
      given = collapse_of(results, case%table%base_wall%samples + 1)
      if (given%has_fit()) line = line//'; theta of the wall as given '//rounded(given%theta)
      if (middle%has_fit()) line = line//', with all sources at their medians '//rounded(middle%theta)
      line = line//'; sources from their 5 to their 95 % fractiles:'
   end subroutine make_model_sentence

   !> Curve of collapse of a row
   pure type(fragility_type) function collapse_of(results, row) result(curve)
      type(results_type), intent(in) :: results
      integer, intent(in) :: row

      curve = results%population%curve(size(results%population%curve, 1), row)
   end function collapse_of

end module dondolo_case_source_rows
