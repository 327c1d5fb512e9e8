!> A building that a wall stands on and leans on: linear, its modes by period, damping and participation at the base of the
!> wall and at its top, where a flexible diaphragm may hold it (docs/theory.md, section 1).
module dondolo_building
   use dondolo_base_kinds, only : pi, wp
   implicit none
   private

   public :: building_type, diaphragm_type, most_parts

   !> Part of the amplitude of a mode by which straight lines between refined samples may miss it
   real(wp), parameter :: tolerance = 1.0e-3_wp

   !> Part of its amplitude that the free vibration after a record is followed to, and the most periods that it is
   real(wp), parameter :: still = 1.0e-4_wp, most_periods = 300.0_wp

   !> Free vibration of a diaphragm on a building, over that of the longer lasting of the two: two of equal period and damping in
   !> series die as x exp(-x), down to the same part at x = 12.8 in place of 9.2
   real(wp), parameter :: in_series = 1.4_wp

   !> Most parts that a step of a record is divided into
   integer, parameter :: most_parts = 100

   !> A flexible floor between the building and the top of a wall
   type :: diaphragm_type
      !> Period [s]; 0: the floor is rigid
      real(wp) :: period = 0.0_wp
      !> Damping ratio, at least 0 and below 1
      real(wp) :: damping = 0.0_wp
      !> Participation factor times shape where the wall is
      real(wp) :: participation = 0.0_wp
   end type diaphragm_type

   !> A building as one wall sees it
   type :: building_type
      !> Periods of its modes [s]
      real(wp), allocatable :: period(:)
      !> Their damping ratios, at least 0 and below 1
      real(wp), allocatable :: damping(:)
      !> Their participation factors times their shapes at the base of the wall, and at its top
      real(wp), allocatable :: participation(:), participation_top(:)
      !> What holds the top
      type(diaphragm_type) :: diaphragm
      !> Height of the line from the base to the top [m]; 0: the wall touches nothing but its base
      real(wp) :: height = 0.0_wp
      !> Level of the top above the ground, where modes follow from levels [m]
      real(wp) :: level_top = 0.0_wp
      !> Share k of the relative acceleration of top and base that moves the wall, and tilt tau, which their relative
      !> displacement is taken times [1/s2]; 0 where the wall is not known
      real(wp) :: share = 0.0_wp, tilt = 0.0_wp
      !> Parts of a step; 0: as many as it needs
      integer :: refine = 0
   contains
      !> Let a wall lean on it
      procedure :: lean
      !> Participation of its modes as the wall feels them
      procedure :: felt
      !> Relative displacement of top and base for a unit of each mode
      procedure :: drifts
      !> Does a flexible diaphragm move the wall?
      procedure :: has_diaphragm
      !> Parts that a step of a record is divided into
      procedure :: parts
      !> How long it vibrates after a record
      procedure :: free_vibration
      !> The same for walls that may feel any of its modes
      procedure :: longest_vibration
      !> Is another building the same?
      procedure :: equals
   end type building_type

contains

   !> Let a wall lean on it
   pure subroutine lean(self, share, tilt)
      class(building_type), intent(inout) :: self
      !> k h [m] and tau h [m/s2] of its mechanism
      real(wp), intent(in) :: share, tilt

      if (.not. self%height > 0.0_wp) return
      self%share = share/self%height
      self%tilt = tilt/self%height
   end subroutine lean

   !> Participation of the modes as the wall feels them; equal ones at base and top stay the same to the bit
   pure function felt(self)
      class(building_type), intent(in) :: self
      !> P = p + k (p' - p)
      real(wp) :: felt(size(self%period))

      felt = self%participation + self%share*(self%participation_top - self%participation)
   end function felt

   !> Relative displacement of top and base for a unit of each mode
   pure function drifts(self)
      class(building_type), intent(in) :: self
      !> p' - p
      real(wp) :: drifts(size(self%period))

      drifts = self%participation_top - self%participation
   end function drifts

   !> Does a flexible diaphragm move the wall?
   pure logical function has_diaphragm(self)
      class(building_type), intent(in) :: self

      has_diaphragm = self%diaphragm%period > 0.0_wp .and. abs(self%share) > 0.0_wp
   end function has_diaphragm

   !> Parts that a step of a record is divided into, so that straight lines between their ends miss no more of a mode's
   !> amplitude than the tolerance: (omega dt/n)**2/8. Beyond most_parts the mode follows the ground
   pure integer function parts(self, dt)
      class(building_type), intent(in) :: self
      !> Step of the record [s]
      real(wp), intent(in) :: dt

      real(wp) :: needed

      parts = self%refine
      if (parts > 0) return
      needed = maxval([0.0_wp, 1.0_wp/pack(self%period, moves(self))])
      if (self%has_diaphragm()) needed = max(needed, 1.0_wp/self%diaphragm%period)
      needed = 2.0_wp*pi*dt/sqrt(8.0_wp*tolerance)*needed
      parts = max(1, ceiling(min(needed, real(most_parts, wp))))
   end function parts

   !> How long it vibrates after a record, until little is left of every mode's amplitude [s]
   pure real(wp) function free_vibration(self) result(time)
      class(building_type), intent(in) :: self

      time = maxval([0.0_wp, pack(lasting(self%period, self%damping), moves(self))])
      if (self%has_diaphragm()) time = in_series*max(time, lasting(self%diaphragm%period, self%diaphragm%damping))
   end function free_vibration

   !> How long it vibrates after a record for walls that may lean on it at any level and feel all of its modes [s]
   pure real(wp) function longest_vibration(self) result(time)
      class(building_type), intent(in) :: self

      time = maxval(lasting(self%period, self%damping))
      if (self%diaphragm%period > 0.0_wp) time = in_series*max(time, lasting(self%diaphragm%period, self%diaphragm%damping))
   end function longest_vibration

   !> How long a mode vibrates freely, until little is left of its amplitude [s]
   elemental real(wp) function lasting(period, damping)
      !> [s]
      real(wp), intent(in) :: period
      !> Damping ratio
      real(wp), intent(in) :: damping

      lasting = period*min(most_periods, -log(still)/(2.0_wp*pi*max(damping, tiny(damping))))
   end function lasting

   !> Is another building the same?
   pure logical function equals(self, other)
      class(building_type), intent(in) :: self
      type(building_type), intent(in) :: other

      equals = size(self%period) == size(other%period) .and. self%refine == other%refine &
         & .and. (self%has_diaphragm() .eqv. other%has_diaphragm())
      if (equals) equals = .not. any(abs(self%period - other%period) + abs(self%damping - other%damping) &
         & + abs(self%felt() - other%felt()) + abs(self%tilt*self%drifts() - other%tilt*other%drifts()) > 0.0_wp)
      if (equals .and. self%has_diaphragm()) equals = .not. any(abs(of_diaphragm(self) - of_diaphragm(other)) > 0.0_wp) &
         & .and. .not. any(abs(self%participation_top - other%participation_top) > 0.0_wp)
   end function equals

   !> What the motion of a wall under a diaphragm depends on besides its modes
   pure function of_diaphragm(building) result(numbers)
      type(building_type), intent(in) :: building
      real(wp) :: numbers(5)

      associate (diaphragm => building%diaphragm)
         numbers = [diaphragm%period, diaphragm%damping, diaphragm%participation, building%share, building%tilt]
      end associate
   end function of_diaphragm

   !> Which modes move the wall at all?
   pure function moves(building)
      class(building_type), intent(in) :: building
      !> An answer for each mode
      logical :: moves(size(building%period))

      moves = abs(building%felt()) > 0.0_wp .or. abs(building%tilt*building%drifts()) > 0.0_wp &
         & .or. (building%has_diaphragm() .and. abs(building%participation_top) > 0.0_wp)
   end function moves

end module dondolo_building
