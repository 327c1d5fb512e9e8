!> The properties of walls: one row each, from which readers, messages, templates, tables of results, the boundary to
!> Python and Python's own signatures derive.
!>
!> To add one: a row here, and its value where a mechanism is built (dondolo_wall).
module dondolo_wall_properties
   use dondolo_kinds, only : wp
   use dondolo_property, only : blank, choices_length, find_property, is_text, most_choices, property_type
   use dondolo_restitution, only : restitution_models
   use dondolo_settings, only : settings_type
   implicit none
   private

   public :: wall_input_type, wall_properties, gravity_property
   public :: mechanism_names, standard_gravity, wall_numbers

   !> Names of the mechanisms
   character(len=choices_length), parameter :: mechanism_names(*) = &
      & [character(len=choices_length) :: 'one_sided', 'free_standing', 'two_block']

   !> Where an overburden can bear on the top of a wall
   character(len=choices_length), parameter :: bearing_names(*) = &
      & [character(len=choices_length) :: 'inner', 'outer', 'centre']

   !> Gravity unless the user sets it [m/s2]
   real(wp), parameter :: standard_gravity = 9.81_wp

   !> Owners of what only a wall of two blocks has
   character(len=choices_length), parameter :: two_block(most_choices) = &
      & reshape([character(len=choices_length) :: 'two_block'], [most_choices], pad=blank)

   !> The rows, in the order in which a user thinks of them
   type(property_type), parameter :: rows(*) = [ &
      & property_type('name', is_text, word='wall', column='wall', changes_results=.false., meaning='name in the results'), &
      & property_type('mechanism', is_text, required=.true., choices=reshape(mechanism_names, [most_choices], pad=blank), &
      &   example='one_sided', meaning='how the wall rocks'), &
      & property_type('height', unit='m', required=.true., positive=.true., smallest=1.0e-3_wp, largest=1.0e3_wp, &
      &   example='3.0', meaning='height of the wall', usual_most=60.0_wp, if_more='is it in centimetres?'), &
      & property_type('thickness', unit='m', required=.true., positive=.true., smallest=1.0e-3_wp, largest=1.0e3_wp, &
      &   example='0.25', meaning='thickness of the wall', usual_most=3.0_wp, if_more='is it in centimetres?'), &
      & property_type('density', unit='kg/m3', default=1800.0_wp, positive=.true., smallest=1.0e-3_wp, &
      &   largest=1.0e5_wp, meaning='density of the masonry', usual_least=500.0_wp, usual_most=4000.0_wp, &
      &   if_less='is it in kN/m3 or t/m3?', if_more='is it in N/m3?'), &
      & property_type('hinge', default=0.5_wp, smallest=0.01_wp, largest=0.99_wp, owners=two_block, &
      &   meaning='height of the intermediate hinge / height of the wall'), &
      & property_type('restitution', is_text, word='default', checked_by_owner=.true., column='restitution_model', &
      &   choices=reshape(restitution_models, [most_choices], pad=blank), meaning='model of the impacts'), &
      & property_type('restitution_value', optional=.true., smallest=0.0_wp, largest=1.0_wp, less=.true., &
      &   example='0.9', meaning='speed after / before an impact, only with restitution = ''constant'''), &
      & property_type('restitution_factor', default=1.0_wp, positive=.true., &
      &   meaning='factor on the speed ratio of any model'), &
      & property_type('overburden', unit='N/m', default=0.0_wp, smallest=0.0_wp, largest=1.0e9_wp, owners=two_block, &
      &   meaning='vertical load on the top, per metre of wall', usual_least=200.0_wp, usual_most=1.0e6_wp, &
      &   if_less='is it in kN/m?', if_more='is it per metre of wall?'), &
      & property_type('eccentricity', unit='m', default=0.0_wp, owners=two_block, meaning='distance of that load '// &
      &   'from the centreline towards the active top hinge', more='the outer face where the wall folds outwards; '// &
      &   'negative for an inner bearing'), &
      & property_type('bearing', is_text, optional=.true., owners=two_block, replaced=.true., example='centre', &
      &   choices=reshape(bearing_names, [most_choices], pad=blank), meaning='where that load bears, '// &
      &   'instead of the eccentricity'), &
      & property_type('bearing_distance', unit='m', optional=.true., owners=two_block, replaced=.true., &
      &   example='0.06', meaning='distance of the load''s resultant from the inner or the outer face', &
      &   more='half the length that joists bear')]

   !> The same where pointers can point
   type(property_type), target, protected :: wall_properties(size(rows)) = rows

   !> What walls have of their place; in namelists it stands in &solver, for all walls
   type(property_type), parameter :: gravity_property = property_type('gravity', unit='m/s2', &
      & default=standard_gravity, positive=.true., smallest=1.0e-3_wp, largest=1.0e3_wp, &
      & meaning='acceleration of gravity')

   !> How many of them are numbers
   integer, parameter :: wall_numbers = count(rows%kind /= is_text)

   !> What a user says of a wall
   type, extends(settings_type) :: wall_input_type
   contains
      procedure :: get_table
      procedure :: find
   end type wall_input_type

contains

   !> The table
   subroutine get_table(self, table)
      !> What is said of a wall
      class(wall_input_type), intent(in) :: self
      !> The properties of walls
      type(property_type), pointer, intent(out) :: table(:)

      associate (of => self)
      end associate
      table => wall_properties
   end subroutine get_table

   !> Place of a property in the table
   pure integer function find(self, name)
      !> What is said of a wall
      class(wall_input_type), intent(in) :: self
      !> Name of the property, in lower case
      character(len=*), intent(in) :: name

      associate (of => self)
      end associate
      find = find_property(wall_properties, name)
   end function find

end module dondolo_wall_properties
