!> The rows of a population: to which wall each belongs, how often it counts and in which group. Geometry is not kept.
module dondolo_roster
   use dondolo_kinds, only : wp
   use dondolo_lines, only : lines_type
   use dondolo_member, only : member_type
   use dondolo_wall, only : mechanism_names
   implicit none
   private

   public :: roster_type, roster_row_type, number_of_group

   !> A row: one mechanism of a wall
   type :: roster_row_type
      !> Is it a further mechanism of the wall in the row before?
      logical :: continues = .false.
      !> Number of the mechanism among mechanism_names
      integer :: mechanism = 0
      !> Number of the group of the wall; 0: none
      integer :: group = 0
      !> Weight of the wall, >= 0
      real(wp) :: weight = 1.0_wp
      !> Probability that the mechanism can occur
      real(wp) :: p_occ = 1.0_wp
   end type roster_row_type

   !> All rows; those of a wall stand one after the other
   type :: roster_type
      !> How many rows there are
      integer :: count = 0
      !> The rows; those beyond `count` are room
      type(roster_row_type), allocatable :: row(:)
      !> Names of the groups, in the order in which they appear
      type(lines_type) :: groups
   contains
      !> Add a row that was read
      procedure :: add
      !> First row of each wall, and behind them the number of rows + 1
      procedure :: first_rows
   end type roster_type

contains

   !> Add a row that was read
   subroutine add(self, member)
      class(roster_type), intent(inout) :: self
      type(member_type), intent(in) :: member

      type(roster_row_type), allocatable :: more(:)

      if (.not. allocated(self%row)) allocate (self%row(64))
      if (self%count == size(self%row)) then
         allocate (more(2*self%count))
         more(:self%count) = self%row
         call move_alloc(more, self%row)
      end if
      self%count = self%count + 1
      if (len(member%group) > 0 .and. number_of_group(self%groups, member%group) == 0) call self%groups%add(member%group)
      self%row(self%count) = roster_row_type(member%continues, &
         & findloc(mechanism_names == member%wall%mechanism_name(), .true., dim=1), &
         & number_of_group(self%groups, member%group), member%weight, member%p_occ)
   end subroutine add

   !> First row of each wall, and behind them the number of rows + 1
   pure function first_rows(self) result(first)
      class(roster_type), intent(in) :: self
      !> Rows
      integer, allocatable :: first(:)

      integer :: i

      first = [pack([(i, i=1, self%count)], .not. self%row(:self%count)%continues), self%count + 1]
   end function first_rows

   !> Number of a group
   pure integer function number_of_group(groups, name) result(number)
      !> Names of the groups
      type(lines_type), intent(in) :: groups
      !> Name of a group; there is none of an empty name
      character(len=*), intent(in) :: name

      do number = groups%count, 1, -1
         if (groups%line(number)%text == name) exit
      end do
   end function number_of_group

end module dondolo_roster
