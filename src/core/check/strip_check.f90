!> The check of a wall by a building code, which of a strip is at its weakest hinge.
!>
!> The principle asks for the hinge at which alpha_0 is least (C8.7.1.2.1.1, and the kinematic theorem). A hinge that is given, and
!> whose alpha_0 is more than 1 % greater, is that of the histories; in the sheet it stands beside, as method 'assigned'.
!>
!> The least safety index over the hinges is that of the curve that is taken, with all ties or without some.
module dondolo_check_strip_check
   use dondolo_base_error, only : error_type
   use dondolo_base_kinds, only : wp
   use dondolo_check_checked_wall, only : find_checked, move_hinge
   use dondolo_check_input, only : check_input_type
   use dondolo_check_free_rows, only : check_branch
   use dondolo_check_kinematic, only : kinematic_type, new_kinematic
   use dondolo_check_nonlinear, only : capacity_displacement, find_governing, safety_index
   use dondolo_check_ntc_check, only : check_ntc
   use dondolo_check_sheet, only : sheet_row_type, sheet_type
   use dondolo_check_tie_curves, only : make_tie_curves, tie_curve_type
   use dondolo_fragility, only : fragility_type
   use dondolo_wall, only : wall_type
   use dondolo_wall_two_block_model, only : two_block_model_type
   implicit none
   private

   public :: check_by_ntc

   !> Hinges of the grid on which the least safety index is looked for
   integer, parameter :: grid = 81

   !> Numbers of the check at the hinge that is given: part of the check and quantity
   character(len=*), parameter :: beside(2, 16) = reshape([character(len=15) :: &
      & 'mechanism', 'hinge', 'mechanism', 'alpha_0', 'mechanism', 'mass_ratio', 'mechanism', 'a_0', 'mechanism', 'd_0', &
      & 'linear', 'zeta_e', 'nonlinear', 'displacement', 'nonlinear', 'acceleration', 'nonlinear', 'period', &
      & 'nonlinear', 'spectral_demand', 'nonlinear', 'demand', 'nonlinear', 'ratio', 'nonlinear', 'zeta_e', &
      & 'mechanism', 'floor_top', 'mechanism', 'floor_base', 'mechanism', 'friction_needed'], [2, 16])

contains

   !> Kinematic check of a wall
   subroutine check_by_ntc(sheet, wall, given, error, curve, searches)
      type(sheet_type), intent(out) :: sheet
      type(wall_type), intent(in) :: wall
      type(check_input_type), intent(in) :: given
      !> The wall cannot be checked so
      type(error_type), allocatable, intent(out) :: error
      !> Curve of collapse over the peak acceleration at the site [g]: the sheet then has probabilities
      type(fragility_type), intent(in), optional :: curve
      !> Is the least safety index of a strip looked for, over all its hinges? No, if absent
      logical, intent(in), optional :: searches

      type(check_input_type) :: input
      type(kinematic_type) :: kinematic, assigned
      type(tie_curve_type), allocatable :: curves(:)
      type(wall_type) :: checked
      logical :: is_moved
      integer :: at, k

      call find_checked(wall, checked, is_moved, error)
      if (.not. allocated(error)) call new_kinematic(kinematic, checked, error)
      if (.not. allocated(error) .and. is_moved) call new_kinematic(assigned, wall, error)
      if (allocated(error)) return
      input = given
      if (.not. wall%input%has('compressive_strength')) call input%hold_knowledge()
      call check_branch(kinematic, input%knowledge_factor, capacity_displacement(kinematic, 2), error)
      if (allocated(error)) return
      call make_tie_curves(curves, wall)
      call check_ntc(sheet, kinematic, input, curve, curves)
      if (present(searches)) then
         if (searches .and. kinematic%hinge > 0.0_wp .and. .not. kinematic%is_without_spectrum) then
            call find_governing(kinematic, curves, input, 2, at, k)
            if (k > 0) checked = curves(k)%wall
            call put_least_index(sheet, checked, input)
         end if
      end if
      if (is_moved) call put_assigned(sheet, assigned, input)
   end subroutine check_by_ntc

   !> Put the numbers at the hinge that is given
   subroutine put_assigned(sheet, assigned, input)
      type(sheet_type), intent(inout) :: sheet
      !> Chain of the wall with that hinge
      type(kinematic_type), intent(in) :: assigned
      type(check_input_type), intent(in) :: input

      type(sheet_type) :: other
      type(sheet_row_type) :: row
      integer :: i

      call check_ntc(other, assigned, input)
      do i = 1, size(other%rows)
         row = other%rows(i)
         if (.not. any(beside(1, :) == row%method .and. beside(2, :) == row%quantity%name)) cycle
         if (row%method == 'linear') row%quantity%name = 'linear_zeta_e'
         row%method = 'assigned'
         call sheet%append(row)
      end do
   end subroutine put_assigned

   !> Put the least safety index of SLV over the hinges: on a grid, then by the golden section to both sides of each lowest point of
   !> it, where kinks may lie
   subroutine put_least_index(sheet, wall, input)
      type(sheet_type), intent(inout) :: sheet
      !> A strip
      type(wall_type), intent(in) :: wall
      type(check_input_type), intent(in) :: input

      real(wp) :: hinge(grid), index(grid), least, at
      type(wall_type) :: other
      integer :: i

      other = wall
      select type (model => wall%model)
      type is (two_block_model_type)
         hinge = [(model%hinge_range(1) + (model%hinge_range(2) - model%hinge_range(1))*real(i - 1, wp)/real(grid - 1, wp), &
            & i=1, grid)]
      end select
      index = [(index_at(hinge(i)), i=1, grid)]
      least = minval(index)
      at = hinge(minloc(index, dim=1))
      do i = 1, grid
         if (index(i) > minval(index(max(1, i - 1):min(grid, i + 1)))) cycle
         if (i > 1) call narrow(hinge(i - 1), hinge(i))
         if (i < grid) call narrow(hinge(i), hinge(i + 1))
      end do
      call sheet%add('nonlinear', 'SLV', 'least_zeta', least, 'NTC 8.3, C8.3')
      call sheet%add('nonlinear', 'SLV', 'least_zeta_hinge', at)

   contains

      !> Safety index at a hinge; huge: the strip does not stand
      real(wp) function index_at(r)
         real(wp), intent(in) :: r

         type(kinematic_type) :: kinematic
         type(error_type), allocatable :: error

         index_at = huge(index_at)
         call move_hinge(other, r, error)
         if (.not. allocated(error)) call new_kinematic(kinematic, other, error)
         if (.not. allocated(error)) index_at = safety_index(kinematic, input, 2)
      end function index_at

      !> Look for the least between two hinges by the golden section
      subroutine narrow(from, to)
         real(wp), intent(in) :: from, to

         real(wp), parameter :: golden = 0.5_wp*(sqrt(5.0_wp) - 1.0_wp)
         integer, parameter :: cuts = 70
         real(wp) :: low, high, first, second, at_first, at_second
         integer :: k

         low = from
         high = to
         first = high - golden*(high - low)
         second = low + golden*(high - low)
         at_first = index_at(first)
         at_second = index_at(second)
         do k = 1, cuts
            if (at_first < at_second) then
               high = second
               second = first
               at_second = at_first
               first = high - golden*(high - low)
               at_first = index_at(first)
            else
               low = first
               first = second
               at_first = at_second
               second = low + golden*(high - low)
               at_second = index_at(second)
            end if
         end do
         if (min(at_first, at_second) >= least) return
         least = min(at_first, at_second)
         at = merge(first, second, at_first < at_second)
      end subroutine narrow

   end subroutine put_least_index

end module dondolo_check_strip_check
