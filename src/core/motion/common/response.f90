!> Result of a motion: its peak and outcome, and its time history on request.
module dondolo_motion_response
   use dondolo_base_invariant, only : assert, checked
   use dondolo_base_kinds, only : wp
   use dondolo_motion_work, only : work_type
   implicit none
   private

   public :: response_type, tie_response_type, trace_type
   public :: intervals_after, largest_sure_error, never

   !> A history whose EDP has a larger estimated error than this is called ill-conditioned
   real(wp), parameter :: largest_sure_error = 1.0e-6_wp

   !> Safety factor on the estimated error, where a doubt or a collapse is at stake; and the estimated error beyond which no outcome
   !> is certain, since errors have grown to the size of the motion
   real(wp), parameter :: safety = 2.0_wp, saturated = 1.0e-2_wp

   !> Result of one history
   type :: response_type
      !> Engineering demand parameter: largest rotation / capacity, equation (6) of Nale et al.;
      !> equal to the limit for a collapse
      real(wp) :: edp = 0.0_wp
      !> Did it reach the limit?
      logical :: collapsed = .false.
      !> Impacts located before the end of the record; chains of bounces that are closed at once are not counted
      integer :: impacts = 0
      !> Time of the largest rotation, or of reaching the limit [s]
      real(wp) :: time_of_peak = 0.0_wp
      !> Estimated error of the EDP; 0 unless the solver was asked for it
      real(wp) :: edp_error = 0.0_wp
      !> Was it computed to its end? If not, there is no result: it was given up at the time of the peak
      logical :: is_whole = .true.
   contains
      !> Is the EDP in doubt?
      procedure :: is_ill_conditioned
      !> Is it in doubt whether the wall collapses?
      procedure :: is_unsure
      !> Is either?
      procedure :: is_doubtful
   end type response_type

   !> Time of what has not happened
   real(wp), parameter :: never = -1.0_wp

   !> What a history does to a tie
   type :: tie_response_type
      !> Largest plastic elongation [m] and energy that it dissipates [J/m]
      real(wp) :: plastic_elongation = 0.0_wp, energy = 0.0_wp
      !> Does it break?
      logical :: broken = .false.
      !> When it first yields and when it breaks [s]; negative: never
      real(wp) :: time_of_yield = never, time_of_fracture = never
   end type tie_response_type

   !> Time after the record for which a time history goes on [s], and most sample intervals of it: a time step may be tiny
   real(wp), parameter :: trace_after = 10.0_wp, most_after = 1.0e5_wp

   !> Time history: rows at every sample and before and after every impact
   type :: trace_type
      !> Whether it has rows at the start of rocking and after every step too, between which the motion is smooth
      logical :: every_step = .false.
      !> Number of rows
      integer :: rows = 0
      !> Is there no memory for more rows? The last one is missing then
      logical :: lacks_memory = .false.
      !> Was the motion computed to its end?
      logical :: is_whole = .true.
      !> Time [s]
      real(wp), allocatable :: time(:)
      !> Scaled ground acceleration [m/s2]
      real(wp), allocatable :: acceleration(:)
      !> Rotation, side * q [rad]
      real(wp), allocatable :: rotation(:)
      !> Angular velocity, side * q' [rad/s]
      real(wp), allocatable :: velocity(:)
      !> Side, +1 or -1; at rest that of the last motion
      real(wp), allocatable :: side(:)
      !> Whether the row is the one just after an impact; the row before it, of the same time, is just before it
      logical, allocatable :: after_impact(:)
      !> What the motion does to each of the ties; none for a wall without ties
      type(tie_response_type), allocatable :: ties(:)
      !> What was computed for the result, without the rows
      type(work_type) :: work
   contains
      !> Add a row
      procedure :: add
      !> Give back the room that was not used
      procedure :: trim_rows
   end type trace_type

contains

   !> Sample intervals after the record for which a time history goes on
   elemental integer function intervals_after(dt)
      !> Time step of the record [s]
      real(wp), intent(in) :: dt

      intervals_after = ceiling(min(trace_after/dt, most_after))
   end function intervals_after

   !> Is the EDP in doubt?
   elemental logical function is_ill_conditioned(self)
      !> Result with its estimated error
      class(response_type), intent(in) :: self

      is_ill_conditioned = self%edp_error > largest_sure_error
   end function is_ill_conditioned

   !> Is it in doubt whether the wall collapses?
   elemental logical function is_unsure(self, edp_limit)
      !> Result with its estimated error
      class(response_type), intent(in) :: self
      !> Rotation / capacity at which the wall has collapsed
      real(wp), intent(in) :: edp_limit

      is_unsure = self%edp_error > 0.0_wp .and. &
         & (self%edp + safety*self%edp_error >= edp_limit .or. self%edp_error > saturated*edp_limit)
   end function is_unsure

   !> Is the EDP in doubt, or whether the wall collapses?
   elemental logical function is_doubtful(self, edp_limit)
      !> Result with its estimated error
      class(response_type), intent(in) :: self
      !> Rotation / capacity at which the wall has collapsed
      real(wp), intent(in) :: edp_limit

      is_doubtful = safety*self%edp_error > largest_sure_error .or. self%is_unsure(edp_limit)
   end function is_doubtful

   !> Add a row; that after an impact is marked by its caller
   pure subroutine add(self, time, acceleration, rotation, velocity, side)
      class(trace_type), intent(inout) :: self
      !> Time [s]
      real(wp), intent(in) :: time
      !> Scaled ground acceleration [m/s2]
      real(wp), intent(in) :: acceleration
      !> Signed rotation [rad]
      real(wp), intent(in) :: rotation
      !> Signed angular velocity [rad/s]
      real(wp), intent(in) :: velocity
      !> Side, +1 or -1
      real(wp), intent(in) :: side

      if (.not. allocated(self%time)) then
         call resize(self, 1024)
      else if (self%rows == size(self%time)) then
         call resize(self, 2*min(self%rows, huge(self%rows)/2 - 1))
      end if
      if (self%lacks_memory) return
      self%rows = self%rows + 1
      self%time(self%rows) = time
      if (checked) call assert(time >= self%time(max(self%rows - 1, 1)), 'the times of a time history do not fall')
      self%acceleration(self%rows) = acceleration
      self%rotation(self%rows) = rotation
      self%velocity(self%rows) = velocity
      self%side(self%rows) = side
      self%after_impact(self%rows) = .false.
   end subroutine add

   !> Give back the room that was not used
   pure subroutine trim_rows(self)
      class(trace_type), intent(inout) :: self

      if (.not. self%lacks_memory) call resize(self, self%rows)
   end subroutine trim_rows

   !> Room for a number of rows; the present rows are kept as far as they fit
   pure subroutine resize(self, room)
      class(trace_type), intent(inout) :: self
      !> Rows there shall be room for
      integer, intent(in) :: room

      logical, allocatable :: wider(:)
      logical :: ok(6)
      integer :: stat

      call resize_column(self%time, self%rows, room, ok(1))
      call resize_column(self%acceleration, self%rows, room, ok(2))
      call resize_column(self%rotation, self%rows, room, ok(3))
      call resize_column(self%velocity, self%rows, room, ok(4))
      call resize_column(self%side, self%rows, room, ok(5))
      allocate (wider(room), source=.false., stat=stat)
      ok(6) = stat == 0 .and. room >= self%rows
      if (ok(6)) then
         if (allocated(self%after_impact)) wider(:min(self%rows, room)) = self%after_impact(:min(self%rows, room))
         call move_alloc(wider, self%after_impact)
      end if
      self%lacks_memory = self%lacks_memory .or. .not. all(ok)
   end subroutine resize

   !> Room in one column
   pure subroutine resize_column(column, rows, room, ok)
      !> The column
      real(wp), allocatable, intent(inout) :: column(:)
      !> Rows in use
      integer, intent(in) :: rows
      !> Rows there shall be room for
      integer, intent(in) :: room
      !> Is there memory for it? If not, the column stays as it is
      logical, intent(out) :: ok

      real(wp), allocatable :: wider(:)
      integer :: stat

      allocate(wider(room), stat=stat)
      ok = stat == 0 .and. room >= rows
      if (.not. ok) return
      if (allocated(column)) wider(:min(rows, room)) = column(:min(rows, room))
      call move_alloc(wider, column)
   end subroutine resize_column

end module dondolo_motion_response
