!> Spectra at the level of a wall in a building: Circolare 7/2019, C7.2.3.
!>
!> Of each mode k of the building, with its damping xi_k and its participation times its shape at the level, gamma psi:
!>
!>     a_Zk = S_e(T_k, xi_k) |gamma psi| sqrt(1 + 0.0004 (100 xi_k)^2)             a_Z = sqrt(sum a_Zk^2), at least a_g S
!>     S_eZk = amp a_Zk/(1 + (amp - 1)(1 - T/(a T_k))^1.6)     T < a T_k           amp = 1.1 eta(xi)/sqrt(xi_k)
!>             amp a_Zk                                        a T_k <= T < b T_k
!>             amp a_Zk/(1 + (amp - 1)(T/(b T_k) - 1)^1.2)     b T_k <= T          a = 0.8, b = 1.1
!>     S_eZ = sqrt(sum S_eZk^2), at least S_e(T, xi)
!>
!> The text has the ground as a bound of S_eZ for T > T_1 only. Towards the ground the sums vanish, so that dondolo takes it at
!> every period and for a_Z too, by analogy with [C7.2.11], which has alpha S as the least of a_Z.
!>
!> The text gives xi_k in per cent. That is right in a_Zk; in amp it would make resonance smaller than the motion of the
!> floor (amp = 0.43 at 5 %), so that xi_k is a fraction there (amp = 4.3).
module dondolo_check_floor_spectrum
   use dondolo_base_kinds, only : wp
   use dondolo_check_code_spectrum, only : damping_factor, elastic_spectrum_type
   implicit none
   private

   public :: floor_spectrum_type, lower, new_floor_spectrum, upper

   !> Bounds of resonance, as parts of the period of a mode
   real(wp), parameter :: lower = 0.8_wp, upper = 1.1_wp

   !> Spectrum at the level of a wall; without modes that of the ground
   type :: floor_spectrum_type
      !> Spectrum of the ground
      type(elastic_spectrum_type) :: ground
      !> Periods of the modes [s] and their damping ratios
      real(wp), allocatable :: period(:), damping(:)
      !> Peak acceleration that each gives the floor a_Zk [g]
      real(wp), allocatable :: peak(:)
      !> Its participation times its shape at the level
      real(wp), allocatable :: shape(:)
   contains
      !> Peak acceleration of the floor a_Z
      procedure :: peak_acceleration
      !> Spectral acceleration S_eZ
      procedure :: acceleration
      !> What the modes alone give of both
      procedure :: modal_peak, modal_acceleration
      !> Demand of displacement
      procedure :: displacement
   end type floor_spectrum_type

contains

   !> Spectrum of a level of a building
   pure function new_floor_spectrum(ground, period, damping, shape) result(spectrum)
      !> Spectrum of the ground
      type(elastic_spectrum_type), intent(in) :: ground
      !> Periods of the modes [s], damping ratios, and participation times shape at the level; of size 0 on the ground
      real(wp), intent(in) :: period(:), damping(:), shape(:)
      !> The spectrum
      type(floor_spectrum_type) :: spectrum

      spectrum%ground = ground
      spectrum%period = period
      spectrum%damping = damping
      spectrum%shape = shape
      spectrum%peak = ground%acceleration(period, damping)*abs(shape)*sqrt(1.0_wp + 0.0004_wp*(100.0_wp*damping)**2)
   end function new_floor_spectrum

   !> Peak acceleration of the floor a_Z, on the ground a_g S [g]
   pure real(wp) function peak_acceleration(self) result(peak)
      class(floor_spectrum_type), intent(in) :: self

      peak = max(self%ground%pga, self%modal_peak())
   end function peak_acceleration

   !> Spectral acceleration S_eZ, on the ground S_e [g]
   pure real(wp) function acceleration(self, period, damping)
      class(floor_spectrum_type), intent(in) :: self
      !> Period T [s] and damping ratio xi of the wall
      real(wp), intent(in) :: period, damping

      acceleration = max(self%ground%acceleration(period, damping), self%modal_acceleration(period, damping))
   end function acceleration

   !> Peak acceleration that the modes give the floor, 0 on the ground [g]
   pure real(wp) function modal_peak(self)
      class(floor_spectrum_type), intent(in) :: self

      modal_peak = norm2(self%peak)
   end function modal_peak

   !> Spectral acceleration that the modes give, 0 on the ground [g]
   pure real(wp) function modal_acceleration(self, period, damping)
      class(floor_spectrum_type), intent(in) :: self
      !> Period T [s] and damping ratio xi of the wall
      real(wp), intent(in) :: period, damping

      real(wp) :: parts(size(self%period))
      integer :: k

      do k = 1, size(parts)
         parts(k) = resonance(period/self%period(k), 1.1_wp*damping_factor(damping)/sqrt(self%damping(k)))*self%peak(k)
      end do
      modal_acceleration = norm2(parts)
   end function modal_acceleration

   !> Amplification of the motion of a mode
   pure real(wp) function resonance(ratio, largest)
      !> Period of the wall / that of the mode
      real(wp), intent(in) :: ratio
      !> Amplification at resonance
      real(wp), intent(in) :: largest

      if (ratio < lower) then
         resonance = largest/(1.0_wp + (largest - 1.0_wp)*(1.0_wp - ratio/lower)**1.6_wp)
      else if (ratio < upper) then
         resonance = largest
      else
         resonance = largest/(1.0_wp + (largest - 1.0_wp)*(ratio/upper - 1.0_wp)**1.2_wp)
      end if
   end function resonance

   !> Demand of displacement S_eZ T^2/(4 pi^2); in a building, beyond resonance with its first mode, not less than there:
   !> C8.7.1.12
   pure real(wp) function displacement(self, period, damping, gravity)
      class(floor_spectrum_type), intent(in) :: self
      !> Period T [s] and damping ratio xi of the wall
      real(wp), intent(in) :: period, damping
      !> Gravity [m/s2]
      real(wp), intent(in) :: gravity

      real(wp), parameter :: turn = 2.0_wp*acos(-1.0_wp)
      real(wp) :: first

      displacement = self%acceleration(period, damping)*gravity*(period/turn)**2
      if (size(self%period) == 0) return
      first = maxval(self%period)
      if (period > upper*first) displacement = max(displacement, &
         & self%acceleration(first, damping)*gravity*(upper*first/turn)**2)
   end function displacement

end module dondolo_check_floor_spectrum
