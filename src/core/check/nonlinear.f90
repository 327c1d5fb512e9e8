!> What the nonlinear check compares: displacement that a wall withstands, equivalent period, and demand of the spectrum.
!>
!> The better of the curves of a wall with ties, and the sheet (dondolo_check_nonlinear_rows), are made of it.
module dondolo_check_nonlinear
   use dondolo_base_kinds, only : wp
   use dondolo_check_activation, only : nonlinear_factor
   use dondolo_check_building_state, only : damaged, is_searched, last_state, spectrum_of
   use dondolo_check_floor_spectrum, only : floor_spectrum_type
   use dondolo_check_input, only : check_input_type
   use dondolo_check_kinematic, only : kinematic_type
   use dondolo_check_tie_curves, only : tie_curve_type
   implicit none
   private

   public :: capacity_displacement, compute_nonlinear, find_governing, index_at, index_with, safety_index
   public :: dampings, period_factors, shares

   !> Factors of the period and damping ratios of the nonlinear check, SLV and SLC
   real(wp), parameter :: period_factors(2:3) = [1.68_wp, 1.56_wp], dampings(2:3) = [0.08_wp, 0.10_wp]
   !> Displacements that it allows / d_0*
   real(wp), parameter :: shares(2:3) = [0.4_wp, 0.6_wp]

contains

   !> Displacement that the nonlinear check allows in a limit state [m]
   pure real(wp) function capacity_displacement(kinematic, state) result(d)
      type(kinematic_type), intent(in) :: kinematic
      !> 2: SLV, 3: SLC
      integer, intent(in) :: state

      ! The text names the loss of a seat for SLC alone, but SLV comes first
      d = min(shares(state)*kinematic%end_displacement, kinematic%unseating)
      if (state == 2) d = min(d, kinematic%tie_fracture)
   end function capacity_displacement

   !> Displacement and acceleration of capacity, period and demand of a nonlinear check
   subroutine compute_nonlinear(kinematic, input, spectrum, state, d, a, period, demand)
      type(kinematic_type), intent(in) :: kinematic
      type(check_input_type), intent(in) :: input
      type(floor_spectrum_type), intent(in) :: spectrum
      !> 2: SLV, 3: SLC
      integer, intent(in) :: state
      !> d_C [m], a(d_C) [m/s2], T [s] and d_D [m]
      real(wp), intent(out) :: d, a, period, demand

      real(wp), parameter :: pi = acos(-1.0_wp)

      d = capacity_displacement(kinematic, state)
      a = kinematic%capacity(d, input%knowledge_factor)
      period = period_factors(state)*pi*sqrt(d/a)
      demand = spectrum%displacement(period, dampings(state), kinematic%gravity)
   end subroutine compute_nonlinear

   !> Safety index of one curve, with one state of the building
   real(wp) function index_at(kinematic, input, state, at)
      type(kinematic_type), intent(in) :: kinematic
      type(check_input_type), intent(in) :: input
      !> 2: SLV, 3: SLC
      integer, intent(in) :: state
      !> Number of the state of the building
      integer, intent(in) :: at

      real(wp) :: d, a, period, demand

      call compute_nonlinear(kinematic, input, damaged(kinematic, input, state, at), state, d, a, period, demand)
      index_at = nonlinear_factor(kinematic, input, spectrum_of(kinematic, input, state), d/demand)
   end function index_at

   !> Safety index of the nonlinear check in a limit state, of one curve
   real(wp) function safety_index(kinematic, input, state)
      type(kinematic_type), intent(in) :: kinematic
      type(check_input_type), intent(in) :: input
      !> 2: SLV, 3: SLC
      integer, intent(in) :: state

      real(wp) :: d, a, period, demand, least
      type(floor_spectrum_type) :: spectrum
      integer :: at

      least = huge(least)
      ! d_C, a and T are those of all states of the building
      call compute_nonlinear(kinematic, input, damaged(kinematic, input, state, 1), state, d, a, period, demand)
      do at = 1, merge(last_state, 1, is_searched(kinematic, input))
         spectrum = damaged(kinematic, input, state, at)
         least = min(least, d/spectrum%displacement(period, dampings(state), kinematic%gravity))
      end do
      safety_index = nonlinear_factor(kinematic, input, spectrum_of(kinematic, input, state), least)
   end function safety_index

   !> The state of the building for which the greatest index over the curves of a wall is least, and the curve that has it then
   subroutine find_governing(kinematic, curves, input, state, at, best)
      type(kinematic_type), intent(in) :: kinematic
      !> Curves without some ties, of size 0 where there are none
      type(tie_curve_type), intent(in) :: curves(:)
      type(check_input_type), intent(in) :: input
      !> 2: SLV, 3: SLC
      integer, intent(in) :: state
      !> Number of the state of the building; 1 where none is searched
      integer, intent(out) :: at
      !> Which of the curves is greater than that with all ties; 0: none
      integer, intent(out) :: best

      real(wp) :: least, greatest, found
      integer :: i, k, better

      least = huge(least)
      at = 1
      best = 0
      do i = 1, merge(last_state, 1, is_searched(kinematic, input))
         greatest = index_at(kinematic, input, state, i)
         better = 0
         do k = 1, size(curves)
            found = index_at(curves(k)%kinematic, input, state, i)
            if (.not. found > greatest) cycle
            greatest = found
            better = k
         end do
         if (.not. greatest < least) cycle
         least = greatest
         at = i
         best = better
      end do
   end subroutine find_governing

   !> Greatest safety index over the curves of a wall, with a spectrum of the building
   real(wp) function index_with(kinematic, curves, input, spectrum, state) result(greatest)
      type(kinematic_type), intent(in) :: kinematic
      type(tie_curve_type), intent(in) :: curves(:)
      type(check_input_type), intent(in) :: input
      type(floor_spectrum_type), intent(in) :: spectrum
      !> 2: SLV, 3: SLC
      integer, intent(in) :: state

      integer :: k

      greatest = of_curve(kinematic)
      do k = 1, size(curves)
         greatest = max(greatest, of_curve(curves(k)%kinematic))
      end do

   contains

      !> That of one curve
      real(wp) function of_curve(one)
         type(kinematic_type), intent(in) :: one

         real(wp) :: d, a, period, demand

         call compute_nonlinear(one, input, spectrum, state, d, a, period, demand)
         of_curve = nonlinear_factor(one, input, spectrum_of(one, input, state), d/demand)
      end function of_curve

   end function index_with

end module dondolo_check_nonlinear
