!> Period and damping of the building that a wall stands on, in each limit state: Circolare 7/2019, C8.7.1.2.1.4 and C8.7.1.2.1.8.
!>
!> At SLV and SLC a masonry building has periods that are 50 to 100 % longer and a damping of 10 to 20 %. Longer periods are worse
!> for some walls and better for others, so that none of them is safe for all: unless the user gives them, the least d_C/d_D
!> counts over 21 periods from T to 2 T, the damping of each mode growing in proportion from its own to 10 % at 1.5 T and to 20 % at
!> 2 T. SLD, the linear check and the activation have the building as it is given.
module dondolo_check_building_state
   use dondolo_base_kinds, only : wp
   use dondolo_check_floor_spectrum, only : floor_spectrum_type, new_floor_spectrum
   use dondolo_check_input, only : check_input_type
   use dondolo_check_kinematic, only : kinematic_type
   implicit none
   private

   public :: damaged, is_searched, last_state, longest, softened, spectrum_of

   !> States of the building between which the worst is looked for: the first as given, the last with twice the period
   integer, parameter :: last_state = 21
   !> Periods / those of the building as given, where damping ratios are known, and these ratios
   real(wp), parameter :: middle = 1.5_wp, longest = 2.0_wp, at_middle = 0.10_wp, at_longest = 0.20_wp

contains

   !> Is the worst state of the building looked for? On the ground there is none, and given ones are taken
   pure logical function is_searched(kinematic, input)
      type(kinematic_type), intent(in) :: kinematic
      type(check_input_type), intent(in) :: input

      is_searched = size(kinematic%period) > 0 .and. .not. input%has_building_period()
   end function is_searched

   !> Period of the building / that as given, in one of the states that are searched
   pure real(wp) function lengthening(at)
      !> Number of the state
      integer, intent(in) :: at

      lengthening = 1.0_wp + (longest - 1.0_wp)*real(at - 1, wp)/real(last_state - 1, wp)
   end function lengthening

   !> Spectrum of a limit state at the level of the wall, with the building as given: that of SLD
   pure function spectrum_of(kinematic, input, state) result(spectrum)
      type(kinematic_type), intent(in) :: kinematic
      type(check_input_type), intent(in) :: input
      !> Number of the limit state whose hazard it is
      integer, intent(in) :: state
      !> The spectrum
      type(floor_spectrum_type) :: spectrum

      spectrum = as_given(kinematic, input, state, 1)
   end function spectrum_of

   !> The same with period and damping that are given for a limit state
   pure function as_given(kinematic, input, state, of_building) result(spectrum)
      type(kinematic_type), intent(in) :: kinematic
      type(check_input_type), intent(in) :: input
      !> Numbers of the limit states: of the hazard, and of the building
      integer, intent(in) :: state, of_building
      !> The spectrum
      type(floor_spectrum_type) :: spectrum

      real(wp) :: damping(size(kinematic%period)), ratio

      damping = kinematic%damping
      ratio = 1.0_wp
      ! Other modes keep their ratio to the first
      if (input%has_building_period() .and. size(damping) > 0) then
         ratio = input%building_period(of_building)/kinematic%first_period
      end if
      if (input%has_building_damping()) damping = input%building_damping(of_building)
      spectrum = new_floor_spectrum(input%spectrum(state), ratio*kinematic%period, damping, kinematic%participation)
   end function as_given

   !> The same of a building whose period is longer, with the damping that belongs to it
   pure function damaged(kinematic, input, state, at) result(spectrum)
      type(kinematic_type), intent(in) :: kinematic
      type(check_input_type), intent(in) :: input
      !> Number of the limit state
      integer, intent(in) :: state
      !> Number of the state of the building; ignored where none is searched
      integer, intent(in) :: at
      !> The spectrum
      type(floor_spectrum_type) :: spectrum

      real(wp) :: damping(size(kinematic%period)), ratio

      if (.not. is_searched(kinematic, input)) then
         spectrum = as_given(kinematic, input, state, state)
         return
      end if
      ratio = lengthening(at)
      if (ratio > middle) then
         damping = at_middle + (at_longest - at_middle)*(ratio - middle)/(longest - middle)
      else
         damping = kinematic%damping + (at_middle - kinematic%damping)*(ratio - 1.0_wp)/(middle - 1.0_wp)
      end if
      spectrum = softened(kinematic, input, state, ratio, damping)
   end function damaged

   !> The same with a ratio of periods and damping ratios
   pure function softened(kinematic, input, state, ratio, damping) result(spectrum)
      type(kinematic_type), intent(in) :: kinematic
      type(check_input_type), intent(in) :: input
      !> Number of the limit state
      integer, intent(in) :: state
      !> Period / that of the building as given, and damping ratios of the modes
      real(wp), intent(in) :: ratio, damping(:)
      !> The spectrum
      type(floor_spectrum_type) :: spectrum

      spectrum = new_floor_spectrum(input%spectrum(state), ratio*kinematic%period, damping, kinematic%participation)
   end function softened

end module dondolo_check_building_state
