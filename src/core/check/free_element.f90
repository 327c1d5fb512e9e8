!> Free elements, such as parapets and pinnacles, which nothing holds above their base: Circolare 7/2019, C8.7.1.2.1.3 and .5.
!>
!> Before such a wall rocks it vibrates as an elastic cantilever of height L, thickness t and weight W per volume,
!>
!>     T_0 = kappa lambda L sqrt(W/(E g))     lambda = L/t     kappa = 6.2                         C8.7.1.7
!>
!> so that what starts the mechanism is the spectral acceleration S_eZ(T_0) at 5 %, and not the peak acceleration of the level.
!>
!> A range of E gives a range of T_0, and the demand is the greatest in it. So does what the formula does not know: sections of
!> different thickness or width (the stiffest with the lightest, the softest with the heaviest), masses that move along (the
!> squares of the periods added, after Dunkerley), and ties and springs, with which the period may be any shorter one. By Rayleigh's
!> principle the period of the wall lies between.
module dondolo_check_free_element
   use dondolo_base_kinds, only : pi, wp
   use dondolo_base_order, only : make_order
   use dondolo_check_floor_spectrum, only : floor_spectrum_type, lower, upper
   use dondolo_wall, only : wall_type
   use dondolo_wall_body, only : wall_body_type
   use dondolo_wall_one_block_model, only : one_block_model_type
   use dondolo_wall_rigid_body, only : same
   implicit none
   private

   public :: elastic_damping, free_element_type, new_free_element

   !> Damping ratio of the spectrum
   real(wp), parameter :: elastic_damping = 0.05_wp
   !> Factor of the period of a cantilever
   real(wp), parameter :: kappa = 6.2_wp

   !> A wall as an elastic cantilever
   type :: free_element_type
      !> Is it a free element? And if the user does not say so, may it be one?
      logical :: is_free = .false., may_be_free = .false.
      !> Young's modulus E, least and greatest [Pa]; 0: not given
      real(wp) :: modulus(2) = 0.0_wp
      !> Period T_0 by the formula with the greatest modulus [s]
      real(wp) :: period = 0.0_wp
      !> Height, thickness [m] and density [kg/m3] of the formula
      real(wp) :: height = 0.0_wp, thickness = 0.0_wp, density = 0.0_wp
      !> Least and greatest period that the wall may have [s]
      real(wp) :: shortest = 0.0_wp, longest = 0.0_wp
      !> Is it bare and of constant section, as the formula assumes?
      logical :: is_uniform = .true.
   contains
      procedure :: has_period
      procedure :: is_unknown
      procedure :: find_demand
   end type free_element_type

contains

   !> A wall as a free element
   subroutine new_free_element(element, wall)
      type(free_element_type), intent(out) :: element
      type(wall_type), intent(in) :: wall

      real(wp), allocatable :: moduli(:)

      select type (model => wall%model)
      type is (one_block_model_type)
         associate (input => wall%input)
            element%is_free = model%two_sided .or. input%has('young_modulus')
            if (input%has('free')) element%is_free = element%is_free .or. input%holds('free')
            element%may_be_free = .not. (element%is_free .or. input%has('free')) .and. size(model%body%actions%restraints) == 0 &
               & .and. is_above(wall) .and. .not. allocated(model%body%corner)
            if (.not. input%has('young_modulus')) return
            moduli = input%list('young_modulus')
            element%modulus = [minval(moduli), maxval(moduli)]
            element%height = input%number('height')
            element%density = input%number('density')
            call compute_periods(element, model%body, wall%gravity)
         end associate
      end select
   end subroutine new_free_element

   !> Does a wall begin above the ground, or end above its building?
   logical function is_above(wall)
      type(wall_type), intent(in) :: wall

      is_above = wall%input%has('level') .and. wall%input%has('building_height')
      if (.not. is_above) return
      associate (level => wall%input%number('level'), tall => wall%input%number('building_height'))
         is_above = level > 0.0_wp .or. level + wall%input%number('height') > tall*(1.0_wp + same)
      end associate
   end function is_above

   !> Compute the periods
   pure subroutine compute_periods(element, body, gravity)
      type(free_element_type), intent(inout) :: element
      type(wall_body_type), intent(in) :: body
      !> [m/s2]
      real(wp), intent(in) :: gravity

      real(wp) :: stiffness(2), area(2), added

      associate (sections => body%sections, base => body%sections%base_width, top => body%sections%top_width)
         element%thickness = sections(1)%thickness
         area = [minval(sections%fill*sections%thickness*min(base, top)), maxval(sections%fill*sections%thickness*max(base, top))]
         stiffness = [minval(sections%fill*sections%thickness**3*min(base, top)), &
            & maxval(sections%fill*sections%thickness**3*max(base, top))]
      end associate
      element%period = period_of(element, element%modulus(2), element%thickness**2)
      element%shortest = period_of(element, element%modulus(2), stiffness(2)/area(1))
      element%longest = period_of(element, element%modulus(1), stiffness(1)/area(2))
      ! Each mass alone on the cantilever: omega^2 = 3 E I/(m z^3)
      associate (carried => body%actions%carried)
         added = sum(max(carried%weight/gravity, carried%pushed)*carried%height**3)
      end associate
      element%longest = sqrt(element%longest**2 + 4.0_wp*pi**2*added/(3.0_wp*element%modulus(1)*stiffness(1)/12.0_wp))
      if (size(body%actions%restraints) + size(body%actions%springs) > 0) element%shortest = 0.0_wp
      element%is_uniform = area(2) - area(1) <= same*area(2) .and. stiffness(2) - stiffness(1) <= same*stiffness(2) .and. &
         & .not. added > 0.0_wp .and. element%shortest > 0.0_wp
      if (.not. element%is_uniform) return
      ! The same to the last digit, whatever the openings
      element%shortest = element%period
      element%longest = period_of(element, element%modulus(1), element%thickness**2)
   end subroutine compute_periods

   !> Period T_0 of a cantilever
   pure real(wp) function period_of(element, modulus, square) result(period)
      type(free_element_type), intent(in) :: element
      !> [Pa]
      real(wp), intent(in) :: modulus
      !> Square of its thickness [m2]
      real(wp), intent(in) :: square

      period = kappa*element%height**2*sqrt(element%density/(modulus*square))
   end function period_of

   !> Is the period known?
   pure logical function has_period(self)
      class(free_element_type), intent(in) :: self

      has_period = self%modulus(1) > 0.0_wp
   end function has_period

   !> Is it a free element of unknown period?
   pure logical function is_unknown(self)
      class(free_element_type), intent(in) :: self

      is_unknown = self%is_free .and. .not. self%has_period()
   end function is_unknown

   !> Greatest S_eZ(T_0) between the least and the greatest period
   subroutine find_demand(self, spectrum, demand, period)
      class(free_element_type), intent(in) :: self
      type(floor_spectrum_type), intent(in) :: spectrum
      !> It [g], and its period [s]
      real(wp), intent(out) :: demand, period

      !> Parts of the interval between two kinks of the spectrum
      integer, parameter :: parts = 16
      real(wp), allocatable :: kinks(:)
      integer, allocatable :: order(:)
      integer :: i, k

      period = self%shortest
      demand = spectrum%acceleration(period, elastic_damping)
      if (.not. self%longest > self%shortest) return
      kinks = [self%shortest, spectrum%ground%corners, lower*spectrum%period, upper*spectrum%period, self%longest]
      kinks = min(max(kinks, self%shortest), self%longest)
      call make_order(kinks, order)
      kinks = kinks(order)
      do i = 2, size(kinks)
         if (.not. kinks(i) > kinks(i - 1)) cycle
         do k = 1, parts
            call look_between(kinks(i - 1) + (kinks(i) - kinks(i - 1))*real(k - 1, wp)/real(parts, wp), &
               & merge(kinks(i), kinks(i - 1) + (kinks(i) - kinks(i - 1))*real(k, wp)/real(parts, wp), k == parts))
         end do
      end do

   contains

      !> Look for a greater one between two periods, at their ends and by the golden section
      subroutine look_between(from, to)
         real(wp), intent(in) :: from, to

         real(wp), parameter :: golden = 0.5_wp*(sqrt(5.0_wp) - 1.0_wp)
         integer, parameter :: cuts = 40
         real(wp) :: low, high, first, second
         integer :: j

         low = from
         high = to
         call take(low)
         call take(high)
         do j = 1, cuts
            first = high - golden*(high - low)
            second = low + golden*(high - low)
            if (spectrum%acceleration(first, elastic_damping) < spectrum%acceleration(second, elastic_damping)) then
               low = first
            else
               high = second
            end if
         end do
         call take(0.5_wp*(low + high))
      end subroutine look_between

      !> Take a period whose ordinate is greater
      subroutine take(at)
         real(wp), intent(in) :: at

         if (.not. spectrum%acceleration(at, elastic_damping) > demand) return
         demand = spectrum%acceleration(at, elastic_damping)
         period = at
      end subroutine take

   end subroutine find_demand

end module dondolo_check_free_element
