!> Static quantities of a wall, by name.
module dondolo_interface_wall_statics
   use dondolo_base_kinds, only : wp
   use dondolo_wall, only : wall_type
   use dondolo_wall_tie_statics, only : greatest_acceleration, plastic_acceleration
   implicit none
   private

   public :: static_names, statics_of

   !> Their names: lengths in m, angles in rad, accelerations in m/s2, p in 1/s, the support's share and the
   !> misfit of a table without unit, the support's tilt in 1/s2; of joints that bend q_y/q_c and e_0, 0 without them
   character(len=23), parameter :: static_names(16) = [character(len=23) :: 'gravity', 'radius', 'slenderness_angle', &
      & 'frequency_parameter', 'trigger_acceleration', 'capacity_angle', 'restitution_coefficient', 'base_hinge_depth', &
      & 'greatest_acceleration', 'plastic_acceleration', 'support_share', 'support_tilt', &
      & 'misfit', 'opening_edp', 'opening_acceleration', 'elastic_restitution']

contains

   !> Their values
   function statics_of(wall) result(values)
      type(wall_type), intent(in) :: wall
      !> In the order of the names
      real(wp) :: values(size(static_names))

      real(wp) :: with_ties(2), support(2), joint(3)

      associate (mechanism => wall%mechanism)
         ! Without ties both are the trigger acceleration.
         with_ties = mechanism%trigger_acceleration()
         if (allocated(mechanism%restraints)) with_ties = [greatest_acceleration(mechanism), plastic_acceleration(mechanism)]
         support = 0.0_wp
         if (allocated(wall%building)) support = [wall%building%share, wall%building%tilt]
         joint = 0.0_wp
         if (mechanism%joint%exists) joint = [mechanism%joint%opening/mechanism%capacity, &
            & mechanism%joint%opening_acceleration(), mechanism%joint%restitution]
         values = [wall%gravity, wall%model%radius, wall%model%alpha, mechanism%frequency_parameter(), &
            & mechanism%trigger_acceleration(), mechanism%capacity, mechanism%restitution, wall%model%hinge_depth, with_ties, &
            & support, wall%model%misfit, joint]
      end associate
   end function statics_of

end module dondolo_interface_wall_statics
