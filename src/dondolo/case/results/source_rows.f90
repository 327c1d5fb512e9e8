!> What the curve of a wall with variants owes to each of its uncertain properties: for people and tables.
module dondolo_source_rows
   use dondolo_case, only : case_type
   use dondolo_csv_row, only : text_cell
   use dondolo_fragility, only : fragility_type
   use dondolo_kinds, only : wp
   use dondolo_results, only : results_type
   use dondolo_text, only : rounded, to_table, to_text
   use dondolo_typology, only : whole_population
   implicit none
   private

   public :: source_head, make_source_row, make_source_sentence, make_model_sentence

   !> Names of the columns of the table of sources
   character(len=*), parameter :: source_head = 'source,distribution,value_5,value_50,value_95,theta_5,theta_95,first,'// &
      & 'first_low,first_high,total,total_low,total_high'

contains

   !> A source as a row
   subroutine make_source_row(case, results, source, row)
      type(case_type), intent(in) :: case
      type(results_type), intent(in) :: results
      !> Its number
      integer, intent(in) :: source
      !> Row
      character(len=:), allocatable, intent(out) :: row

      type(fragility_type) :: curve
      integer :: i

      associate (wall => case%facade, name => case%facade%sources(source))
         row = trim(name)//','//text_cell(case%uncertainty%word(trim(name)), case%job%spreadsheet_safe)//','// &
            & to_table(wall%values(source, wall%row_of_end(source, 1)))//','// &
            & to_table(wall%values(source, wall%samples + 2))//','// &
            & to_table(wall%values(source, wall%row_of_end(source, 2)))
         do i = 1, 2
            row = row//','
            curve = collapse_of(results, wall%row_of_end(source, i))
            if (curve%has_fit()) row = row//to_table(curve%theta)
         end do
      end associate
      if (allocated(results%sensitivity)) then
         associate (found => results%sensitivity)
            row = row//','//to_table(found%first(source))//','//to_table(found%first_interval(1, source))//','// &
               & to_table(found%first_interval(2, source))//','//to_table(found%total(source))//','// &
               & to_table(found%total_interval(1, source))//','//to_table(found%total_interval(2, source))
         end associate
      else
         row = row//',,,,,,'
      end if
   end subroutine make_source_row

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

      associate (wall => case%facade)
         line = '   '//trim(wall%sources(source))//' from '//rounded(wall%values(source, wall%row_of_end(source, 1)))// &
            & ' to '//rounded(wall%values(source, wall%row_of_end(source, 2)))//': theta'
         do i = 1, 2
            curve = collapse_of(results, wall%row_of_end(source, i))
            line = line//trim(merge(' from', ' to  ', i == 1))//' '
            if (curve%has_fit()) line = line//rounded(curve%theta)
            if (.not. curve%has_fit()) line = line//'('//trim(curve%status)//')'
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
      middle = collapse_of(results, case%facade%samples + 2)
      associate (whole => results%typologies(whole_population(results%typologies(:, last)), last))
         line = 'beta of the model '//rounded(whole%beta_walls)//', of the records '//rounded(whole%beta_records)// &
            & ', in all '//rounded(hypot(whole%beta_walls, whole%beta_records))
      end associate
      fitted = 0
      do i = 1, case%facade%samples
         given = collapse_of(results, i)
         if (given%has_fit()) fitted = fitted + 1
      end do
      if (fitted < case%facade%samples) line = line//' (of the '//to_text(fitted)//' of '//to_text(case%facade%samples)// &
         & ' variants that have a fit)'
      given = collapse_of(results, case%facade%samples + 1)
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

end module dondolo_source_rows
