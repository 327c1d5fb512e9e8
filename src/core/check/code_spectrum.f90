!> Elastic spectra of building codes, of the form that NTC 2018 (3.2.3.2.1) and EN 1998-1 (3.2.2.2) share, and the
!> parameters that NTC 2018 gives it.
!>
!>     T < T_B:           S_e = a_g S [1 + T/T_B (eta F_0 - 1)]
!>     T_B <= T < T_C:    S_e = a_g S eta F_0
!>     T_C <= T < T_D:    S_e = a_g S eta F_0 T_C/T
!>     T_D <= T:          S_e = a_g S eta F_0 T_C T_D/T^2
module dondolo_check_code_spectrum
   use dondolo_base_kinds, only : wp
   implicit none
   private

   public :: elastic_spectrum_type, ntc_spectrum, damping_factor
   public :: soil_names, topography_names

   !> Classes of soil and of topography
   character(len=*), parameter :: soil_names(5) = [character(len=1) :: 'A', 'B', 'C', 'D', 'E']
   character(len=*), parameter :: topography_names(4) = [character(len=2) :: 'T1', 'T2', 'T3', 'T4']

   !> NTC 2018, table 3.2.IV, a row a class: S_S = a - b F_0 a_g between the first and the second, C_C = c (T_C*)^d
   real(wp), parameter :: soils(6, 5) = reshape([ &
      & 1.0_wp, 1.0_wp, 1.0_wp, 0.0_wp, 1.00_wp, 0.00_wp, &
      & 1.0_wp, 1.2_wp, 1.4_wp, 0.4_wp, 1.10_wp, -0.20_wp, &
      & 1.0_wp, 1.5_wp, 1.7_wp, 0.6_wp, 1.05_wp, -0.33_wp, &
      & 0.9_wp, 1.8_wp, 2.4_wp, 1.5_wp, 1.25_wp, -0.50_wp, &
      & 1.0_wp, 1.6_wp, 2.0_wp, 1.1_wp, 1.15_wp, -0.40_wp], [6, 5])

   !> Table 3.2.V: S_T
   real(wp), parameter :: topographies(4) = [1.0_wp, 1.2_wp, 1.2_wp, 1.4_wp]

   !> An elastic spectrum
   type :: elastic_spectrum_type
      !> Factor S of soil and topography, and the second of its two factors, S_T
      real(wp) :: soil_factor = 1.0_wp
      real(wp) :: topography_factor = 1.0_wp
      !> Peak acceleration at the site a_g S [g]
      real(wp) :: pga = 0.0_wp
      !> Largest amplification F_0 at a damping of 5 %
      real(wp) :: amplification = 2.5_wp
      !> Periods T_B, T_C and T_D [s]
      real(wp) :: corners(3) = 1.0_wp
   contains
      !> Its ordinate
      procedure :: acceleration
   end type elastic_spectrum_type

contains

   !> Spectrum of NTC 2018
   pure function ntc_spectrum(ag, f0, tc_star, soil, topography) result(spectrum)
      !> Peak acceleration on rigid, level ground [g]
      real(wp), intent(in) :: ag
      !> Largest amplification there
      real(wp), intent(in) :: f0
      !> Period at which the constant velocity begins there [s]
      real(wp), intent(in) :: tc_star
      !> One of soil_names and one of topography_names
      character(len=*), intent(in) :: soil, topography
      !> The spectrum
      type(elastic_spectrum_type) :: spectrum

      real(wp) :: tc

      spectrum%topography_factor = topographies(findloc(topography_names, topography, dim=1))
      associate (row => soils(:, findloc(soil_names, soil, dim=1)))
         spectrum%soil_factor = min(max(row(3) - row(4)*f0*ag, row(1)), row(2)) &
            & *spectrum%topography_factor
         tc = row(5)*tc_star**(1.0_wp + row(6))
      end associate
      spectrum%pga = ag*spectrum%soil_factor
      spectrum%amplification = f0
      spectrum%corners = [tc/3.0_wp, tc, 4.0_wp*ag + 1.6_wp]
   end function ntc_spectrum

   !> Factor of damping eta = sqrt(10/(5 + 100 xi)), at least 0.55
   elemental real(wp) function damping_factor(damping) result(eta)
      !> Damping ratio xi
      real(wp), intent(in) :: damping

      eta = max(sqrt(10.0_wp/(5.0_wp + 100.0_wp*damping)), 0.55_wp)
   end function damping_factor

   !> Spectral acceleration S_e [g]
   elemental real(wp) function acceleration(self, period, damping)
      class(elastic_spectrum_type), intent(in) :: self
      !> Period T [s]
      real(wp), intent(in) :: period
      !> Damping ratio
      real(wp), intent(in) :: damping

      real(wp) :: peak

      peak = damping_factor(damping)*self%amplification
      associate (tb => self%corners(1), tc => self%corners(2), td => self%corners(3))
         if (period < tb) then
            acceleration = 1.0_wp + period/tb*(peak - 1.0_wp)
         else if (period < tc) then
            acceleration = peak
         else if (period < td) then
            acceleration = peak*tc/period
         else
            acceleration = peak*tc*td/period**2
         end if
      end associate
      acceleration = self%pga*acceleration
   end function acceleration

end module dondolo_check_code_spectrum
