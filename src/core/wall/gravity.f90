!> Gravity: what walls have of their place.
module dondolo_wall_gravity
   use dondolo_base_kinds, only : wp
   use dondolo_base_property, only : property_type
   implicit none
   private

   public :: gravity_property, standard_gravity

   !> Gravity unless the user sets it [m/s2]
   real(wp), parameter :: standard_gravity = 9.81_wp

   !> What walls have of their place; in namelists it stands in &solver, for all walls
   type(property_type), parameter :: gravity_property = property_type('gravity', unit='m/s2', &
      & default=standard_gravity, positive=.true., smallest=1.0e-3_wp, largest=1.0e3_wp, usual_least=9.7_wp, usual_most=10.0_wp, &
      & if_less='is it in g?', if_more='is it in cm/s2 or ft/s2?', meaning='acceleration of gravity')

end module dondolo_wall_gravity
