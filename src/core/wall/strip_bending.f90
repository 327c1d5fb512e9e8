!> Strips between two floors bend before their joints open, which rigid blocks leave out (docs/theory.md, section 7).
!>
!> A strip of mass m = rho t per height and I = t^3/12, pinned at both ends, has with the load N on top and its weight W the period
!>
!>     T_1 = (2/pi) H^2 sqrt[m/(E I c)]      c = 1 - (N + W/2) H^2/(pi^2 E I)
!>
!> By how much bending lowers the median of collapse depends on s = p T_1/(2 pi) alone, p the frequency parameter. The reductions
!> are those of an elastic branch up to the restoring moment of the rigid blocks, damping 5 %, under 44 recorded components, load
!> as a dead force; good to 0.04.
module dondolo_wall_strip_bending
   use dondolo_base_kinds, only : wp
   implicit none
   private

   public :: bends_before_opening, median_reduction, pinned_period, shown_periods

   real(wp), parameter :: pi = acos(-1.0_wp)
   !> Modulus of elasticity at which a strip is looked at [Pa]: of masonry that is not cracked, on the low side
   real(wp), parameter :: usual_modulus = 1.0e9_wp
   !> s from which bending matters
   real(wp), parameter :: least_slowness = 0.06_wp
   !> Periods of strips that were measured in the laboratory lie between these [s]
   real(wp), parameter :: shown_periods(2) = [0.10_wp, 0.15_wp]
   !> s, and median with bending / median of rigid blocks there
   real(wp), parameter :: slowness(8) = [0.0_wp, 0.06_wp, 0.09_wp, 0.12_wp, 0.15_wp, 0.165_wp, 0.23_wp, 0.31_wp], &
      & ratios(8) = [1.0_wp, 0.97_wp, 0.93_wp, 0.91_wp, 0.86_wp, 0.83_wp, 0.75_wp, 0.63_wp]

contains

   !> Does a strip bend enough before it opens to lower its median?
   pure logical function bends_before_opening(height, thickness, density, load, gravity, frequency) result(bends)
      !> Height and thickness [m]
      real(wp), intent(in) :: height, thickness
      !> Density [kg/m3]
      real(wp), intent(in) :: density
      !> Load on top [N/m]
      real(wp), intent(in) :: load
      !> Gravity [m/s2]
      real(wp), intent(in) :: gravity
      !> Frequency parameter p [1/s]
      real(wp), intent(in) :: frequency

      bends = frequency*pinned_period(height, thickness, density, load, gravity, usual_modulus) > 2.0_wp*pi*least_slowness
   end function bends_before_opening

   !> Period of small vibrations of a strip, pinned at both ends; beyond all others where its load buckles it [s]
   pure real(wp) function pinned_period(height, thickness, density, load, gravity, modulus) result(period)
      !> Height and thickness [m]
      real(wp), intent(in) :: height, thickness
      !> Density [kg/m3]
      real(wp), intent(in) :: density
      !> Load on top [N/m]
      real(wp), intent(in) :: load
      !> Gravity [m/s2]
      real(wp), intent(in) :: gravity
      !> Modulus of elasticity [Pa]
      real(wp), intent(in) :: modulus

      real(wp) :: mass, stiffness, rest

      mass = density*thickness
      stiffness = modulus*thickness**3/12.0_wp
      rest = 1.0_wp - (load + 0.5_wp*mass*gravity*height)*height**2/(pi**2*stiffness)
      period = sqrt(huge(1.0_wp))
      if (rest > 0.0_wp) period = min(period, 2.0_wp/pi*height**2*sqrt(mass/(stiffness*rest)))
   end function pinned_period

   !> Part by which bending lowers the median of collapse; beyond the largest s that was computed that of this one
   elemental real(wp) function median_reduction(turns) result(reduction)
      !> p T, frequency parameter times period of the strip
      real(wp), intent(in) :: turns

      real(wp) :: s
      integer :: i

      s = min(turns/(2.0_wp*pi), slowness(size(slowness)))
      i = max(2, min(size(slowness), count(slowness < s) + 1))
      reduction = 1.0_wp - ratios(i - 1) - (ratios(i) - ratios(i - 1))*(s - slowness(i - 1))/(slowness(i) - slowness(i - 1))
   end function median_reduction

end module dondolo_wall_strip_bending
