!> Designs of one wall at the end of a run.
module dondolo_design_lines
   use, intrinsic :: iso_fortran_env, only : output_unit
   use dondolo_base_text, only : to_text
   use dondolo_case_design_rows, only : make_design_sentence
   use dondolo_case_results, only : shown_rows
   use dondolo_population_designs, only : design_type
   implicit none
   private

   public :: print_designs

contains

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
   end subroutine print_designs

end module dondolo_design_lines
