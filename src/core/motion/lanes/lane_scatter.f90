!> Scatter of the restitution in the lanes of the engine lanes: the speed ratio of the next impact of each history.
!>
!> The ratios of a history depend on its record and polarity and on how many impacts there were (dondolo_wall_restitution_scatter):
!> all levels of a record begin alike, and a lane goes on from there by itself.
module dondolo_motion_lane_scatter
   use dondolo_base_kinds, only : wp
   use dondolo_motion_lane_state, only : lane_width
   use dondolo_record, only : record_type
   use dondolo_record_random, only : jumps_type, new_jumps
   use dondolo_wall_mechanism, only : mechanism_type
   use dondolo_wall_restitution_scatter, only : restitution_scatter_type
   implicit none
   private

   public :: lane_scatter_type

   !> The ratios of a record of one polarity before its first impact
   type :: beginning_type
      logical :: is_known = .false.
      type(restitution_scatter_type) :: ratios
   end type beginning_type

   !> The ratios of the histories in all lanes
   type :: lane_scatter_type
      !> Ratio of the next impact in each lane
      real(wp), allocatable :: next(:)
      !> Where those after it come from
      type(restitution_scatter_type), allocatable, private :: lane(:)
      !> The beginnings of each record as it is, and reversed; made when a history first needs them
      type(beginning_type), allocatable, private :: beginning(:, :)
      type(jumps_type), private :: jumps
      !> Is a record the same to the wall whatever its polarity?
      logical, private :: is_symmetric = .false.
   contains
      !> No history yet
      procedure :: make
      !> The start of a history
      procedure :: begin
      !> An impact has had its ratio
      procedure :: go_on
      !> The state of a lane goes to another
      procedure :: move
   end type lane_scatter_type

contains

   !> Make room for the records
   pure subroutine make(self, mechanism, records)
      class(lane_scatter_type), intent(inout) :: self
      class(mechanism_type), intent(in) :: mechanism
      !> Their number
      integer, intent(in) :: records

      allocate (self%next(lane_width), source=0.0_wp)
      allocate (self%lane(lane_width), self%beginning(records, 2))
      self%beginning%ratios = mechanism%scatter
      self%jumps = new_jumps()
      self%is_symmetric = mechanism%is_symmetric()
   end subroutine make

   !> Begin a history
   pure subroutine begin(self, i, records, number, scale)
      class(lane_scatter_type), intent(inout) :: self
      !> The lane
      integer, intent(in) :: i
      type(record_type), intent(in) :: records(:)
      !> The record
      integer, intent(in) :: number
      !> Factor on it
      real(wp), intent(in) :: scale

      logical :: is_reversed

      ! The mirror image of the motion of a wall that is the same to both sides is the same motion.
      is_reversed = scale < 0.0_wp .and. .not. self%is_symmetric
      associate (beginning => self%beginning(number, merge(2, 1, is_reversed)))
         if (.not. beginning%is_known) call beginning%ratios%begin(records(number)%name, is_reversed, self%jumps)
         beginning%is_known = .true.
         self%lane(i) = beginning%ratios
      end associate
      call self%go_on(i)
   end subroutine begin

   !> An impact has had its ratio: draw that of the one after it
   pure subroutine go_on(self, i)
      class(lane_scatter_type), intent(inout) :: self
      !> The lane
      integer, intent(in) :: i

      call self%lane(i)%draw(self%next(i))
   end subroutine go_on

   !> Move the state of a lane to another
   pure subroutine move(self, from, to)
      class(lane_scatter_type), intent(inout) :: self
      !> The lane, and where it goes
      integer, intent(in) :: from, to

      self%lane(to) = self%lane(from)
      self%next(to) = self%next(from)
   end subroutine move

end module dondolo_motion_lane_scatter
