!> Walls and facades with several mechanisms, counted in the same histories, out of what the stores of a population hold.
module dondolo_unite_rows
   use dondolo_case, only : case_type
   use dondolo_error, only : error_type
   use dondolo_kinds, only : wp
   use dondolo_memory, only : check_room
   use dondolo_member, only : member_type
   use dondolo_results, only : results_type
   use dondolo_row_result, only : row_result_type
   use dondolo_rows_again, only : rows_again_type
   use dondolo_study, only : runs_of, study_type
   use dondolo_unions, only : mean_unions, union_builder_type, union_type, unions_type, wall_union
   implicit none
   private

   public :: unite_rows

contains

   !> Unions of the walls with several mechanisms, one wall in memory at a time, and their means
   subroutine unite_rows(case, results, study, error)
      type(case_type), intent(in) :: case
      !> Its results: curves are there, unions are set
      type(results_type), intent(inout) :: results
      type(study_type), intent(in) :: study
      !> A store has changed, or the table, or what cannot be fitted
      type(error_type), allocatable, intent(out) :: error

      type(union_builder_type) :: builder
      type(union_type) :: union
      type(row_result_type) :: row
      logical :: runs(size(study%suite%clusters), size(study%levels))
      integer :: i, k, wall, number

      associate (population => results%population)
         number = count(population%is_several([(i, i=1, population%walls)]))
         if (number == 0) return
         call check_room(real(number, wp)*real(size(study%levels)*16*(size(population%curve, 1) + 1), wp) &
            & + real(population%rows + population%walls, wp)*real(size(study%levels)*8, wp), error)
         if (allocated(error)) return
         call results%unions%reserve(number, size(study%levels), size(population%curve, 1))
         runs = runs_of(study)
         wall = 1
         number = 0
         do k = 1, size(results%stores)
            associate (store => results%stores(k))
               do i = store%identity%first, store%identity%last
                  if (i == population%first(wall + 1)) wall = wall + 1
                  if (.not. population%is_several(wall)) cycle
                  call store%read(i, row, error)
                  if (allocated(error)) exit
                  call builder%add(row, population%row(i)%p_occ)
                  if (i < population%first(wall + 1) - 1) cycle
                  number = number + 1
                  call wall_union(union, builder, population, wall, study%suite%clusters, runs, error)
                  if (allocated(error)) exit
                  call results%unions%keep(number, wall, union)
                  deallocate (builder%survival)
               end do
               call store%close()
               if (allocated(error)) return
            end associate
         end do
         call name_unions(case, results%unions, population%first, error)
         if (.not. allocated(error)) call mean_unions(results%unions, population, results%typologies, error)
      end associate
   end subroutine unite_rows

   !> Name the unions after their facades, or after their walls
   subroutine name_unions(case, unions, first, error)
      type(case_type), intent(in) :: case
      !> Unions of walls, in the order of rows: names are set
      type(unions_type), intent(inout) :: unions
      !> First row of each wall
      integer, intent(in) :: first(:)
      !> The table has changed
      type(error_type), allocatable, intent(out) :: error

      type(rows_again_type) :: rows
      type(member_type) :: member
      integer :: i, next

      next = 1
      call rows%open(case, error)
      do i = 1, first(unions%wall(size(unions%wall)))
         call rows%next(member, error)
         if (allocated(error)) exit
         if (first(unions%wall(next)) /= i) cycle
         unions%name(next)%text = member%wall%name()
         if (len(member%facade) > 0) unions%name(next)%text = member%facade
         next = next + 1
      end do
      call rows%close()
   end subroutine name_unions

end module dondolo_unite_rows
