!> What starts a mechanism: a_0* against the acceleration of the level, its peak a_Z, or of a free element S_eZ(T_0)
!> (dondolo_check_free_element).
module dondolo_check_activation
   use dondolo_base_kinds, only : wp
   use dondolo_check_floor_spectrum, only : floor_spectrum_type
   use dondolo_check_input, only : check_input_type
   use dondolo_check_kinematic, only : kinematic_type
   implicit none
   private

   public :: activation, nonlinear_factor, starting_demand, starting_symbol

contains

   !> Acceleration of the level that starts the mechanism: its peak, of a free element that at its elastic period [g]
   real(wp) function starting_demand(kinematic, spectrum) result(demand)
      type(kinematic_type), intent(in) :: kinematic
      type(floor_spectrum_type), intent(in) :: spectrum

      real(wp) :: period

      demand = spectrum%peak_acceleration()
      if (kinematic%element%has_period()) call kinematic%element%find_demand(spectrum, demand, period)
   end function starting_demand

   !> Its symbol
   pure function starting_symbol(kinematic) result(symbol)
      type(kinematic_type), intent(in) :: kinematic
      character(len=merge(9, 3, kinematic%element%has_period())) :: symbol

      symbol = 'a_Z'
      if (kinematic%element%has_period()) symbol = 'S_eZ(T_0)'
   end function starting_symbol

   !> Factor on the site's a_g at which the mechanism starts
   real(wp) function activation(kinematic, input, spectrum) result(factor)
      type(kinematic_type), intent(in) :: kinematic
      type(check_input_type), intent(in) :: input
      type(floor_spectrum_type), intent(in) :: spectrum

      factor = kinematic%capacity(0.0_wp, input%knowledge_factor)/(kinematic%gravity*starting_demand(kinematic, spectrum))
   end function activation

   !> Factor on the site's a_g of a nonlinear check: that of its displacements, not below the one that starts the mechanism; what
   !> starts a free element is not known without its period
   real(wp) function nonlinear_factor(kinematic, input, spectrum, of_displacements) result(factor)
      type(kinematic_type), intent(in) :: kinematic
      type(check_input_type), intent(in) :: input
      type(floor_spectrum_type), intent(in) :: spectrum
      !> d_C/d_D
      real(wp), intent(in) :: of_displacements

      factor = of_displacements
      if (.not. kinematic%element%is_unknown()) factor = max(factor, activation(kinematic, input, spectrum))
   end function nonlinear_factor

end module dondolo_check_activation
