!> The properties of walls: one row each, from which readers, messages, templates, tables of results, the boundary to
!> Python and Python's own signatures derive.
!>
!> To add one: a row here, and its value where a mechanism is built (dondolo_wall).
module dondolo_wall_properties
   use dondolo_base_kinds, only : wp
   use dondolo_base_property, only : blank, choices_length, find_name, find_property, is_integer, is_list, is_text, is_words, &
      & most_choices, property_type
   use dondolo_base_settings, only : settings_type
   use dondolo_building_input, only : building_rows
   use dondolo_wall_restitution, only : restitution_models
   implicit none
   private

   public :: wall_input_type, wall_properties, gravity_property
   public :: absent_value, is_beyond_bare, is_extra, is_of_building, mechanism_names, load_inertias, own_properties, &
      & standard_gravity, wall_numbers

   !> Names of the mechanisms
   character(len=choices_length), parameter :: mechanism_names(*) = &
      & [character(len=choices_length) :: 'one_sided', 'free_standing', 'two_block']

   !> Where an overburden can bear on the top of a wall
   character(len=choices_length), parameter :: bearing_names(*) = &
      & [character(len=choices_length) :: 'inner', 'outer', 'centre']

   !> Which mass a load brings: none, one that the wall lifts, one that it lifts and pushes
   character(len=choices_length), parameter :: load_inertias(*) = &
      & [character(len=choices_length) :: 'none', 'vertical', 'both']

   !> Gravity unless the user sets it [m/s2]
   real(wp), parameter :: standard_gravity = 9.81_wp

   !> Owners of what only a wall of two blocks has
   character(len=choices_length), parameter :: two_block(most_choices) = &
      & reshape([character(len=choices_length) :: 'two_block'], [most_choices], pad=blank)

   !> Owners of what only one block has
   character(len=choices_length), parameter :: one_block(most_choices) = &
      & reshape([character(len=choices_length) :: 'one_sided', 'free_standing'], [most_choices], pad=blank)

   !> Owners of what only a wall against transverse walls has
   character(len=choices_length), parameter :: one_sided(most_choices) = &
      & reshape([character(len=choices_length) :: 'one_sided'], [most_choices], pad=blank)

   !> Owners of what all walls have, once they are more than rectangles on their edge
   character(len=choices_length), parameter :: all_walls(most_choices) = &
      & reshape(mechanism_names, [most_choices], pad=blank)

   !> The rows of the wall itself, in the order in which a user thinks of them
   type(property_type), parameter :: own_rows(*) = [ &
      & property_type('name', is_text, word='wall', column='wall', changes_results=.false., meaning='name in the results'), &
      & property_type('mechanism', is_text, required=.true., choices=reshape(mechanism_names, [most_choices], pad=blank), &
      &   example='one_sided', meaning='how the wall rocks'), &
      & property_type('height', unit='m', required=.true., positive=.true., smallest=1.0e-3_wp, largest=1.0e3_wp, &
      &   example='3.0', meaning='height of the wall', instead='section_height', usual_most=60.0_wp), &
      & property_type('thickness', unit='m', required=.true., positive=.true., smallest=1.0e-3_wp, largest=1.0e3_wp, &
      &   example='0.25', meaning='thickness of the wall', instead='section_thickness', usual_most=3.0_wp), &
      & property_type('density', unit='kg/m3', default=1800.0_wp, positive=.true., smallest=1.0e-3_wp, &
      &   largest=1.0e5_wp, meaning='density of the masonry', usual_least=500.0_wp, usual_most=4000.0_wp, &
      &   if_less='is it in kN/m3 or t/m3?', if_more='is it in N/m3?'), &
      & property_type('section_height', is_list, unit='m', owners=one_block, optional=.true., positive=.true., &
      &   smallest=1.0e-3_wp, largest=1.0e3_wp, usual_most=20.0_wp, example='4.0, 3.5', &
      &   meaning='heights of the storeys from the bottom, instead of height'), &
      & property_type('section_thickness', is_list, unit='m', owners=one_block, optional=.true., positive=.true., &
      &   smallest=1.0e-3_wp, largest=1.0e3_wp, usual_most=3.0_wp, example='0.60, 0.45', &
      &   meaning='their thicknesses, instead of thickness'), &
      & property_type('section_fill', is_list, owners=one_block, optional=.true., positive=.true., largest=1.0_wp, &
      &   example='0.8, 1.0', meaning='part of each storey that is masonry, 1 if not given'), &
      & property_type('section_offset', is_list, unit='m', owners=one_block, optional=.true., smallest=-1.0e3_wp, &
      &   largest=1.0e3_wp, example='0.0, 0.1', &
      &   usual_most=3.0_wp, &
      &   meaning='depth of the outer face of each storey behind that of the lowest, 0 if not given'), &
      & property_type('section_base_width', is_list, owners=one_block, optional=.true., smallest=0.0_wp, &
      &   largest=1.0e3_wp, example='1.0, 1.0', &
      &   meaning='width of each elevation at its bottom / width that values per metre refer to, 1 if not given'), &
      & property_type('section_top_width', is_list, owners=one_block, optional=.true., smallest=0.0_wp, largest=1.0e3_wp, &
      &   example='1.0, 0.0', one_each=.true., &
      &   meaning='the same at its top, as at its bottom if not given; 0 for a gable'), &
      & property_type('leaves', is_integer, owners=one_sided, optional=.true., smallest=1.0_wp, largest=10.0_wp, &
      &   example='2', meaning='number of equal leaves that nothing connects: each rocks alone with its part of the '// &
      &   'thickness'), &
      & property_type('hinge_level', is_list, unit='m', owners=one_sided, optional=.true., replaced=.true., &
      &   smallest=0.0_wp, largest=1.0e3_wp, example='0.0, 4.0, 7.5', &
      &   usual_most=60.0_wp, &
      &   meaning='heights of hinges: each makes a wall of what is above it', &
      &   more='one for a single wall, several for a facade in a population'), &
      & property_type('hinge_at', is_text, owners=one_sided, optional=.true., replaced=.true., &
      &   choices=reshape([character(len=choices_length) :: 'storeys'], [most_choices], pad=blank), example='storeys', &
      &   meaning='a hinge at the bottom of every section, instead of hinge_level'), &
      & property_type('mass', unit='kg/m', owners=one_block, optional=.true., positive=.true., &
      &   smallest=1.0e-3_wp, largest=1.0e9_wp, example='1350.0', usual_least=20.0_wp, &
      &   meaning='mass of the body, instead of its density'), &
      & property_type('centroid_depth', unit='m', owners=one_block, optional=.true., smallest=0.0_wp, &
      &   largest=1.0e3_wp, example='0.125', usual_most=3.0_wp, &
      &   meaning='depth of its centroid behind the outer face, with mass'), &
      & property_type('centroid_height', unit='m', owners=one_block, optional=.true., positive=.true., &
      &   largest=1.0e3_wp, example='1.5', usual_most=60.0_wp, &
      &   meaning='height of its centroid, with mass'), &
      & property_type('hinge_inertia', unit='kg m2/m', owners=one_block, optional=.true., positive=.true., &
      &   column='hinge_inertia_kg_m', example='4078.0', usual_least=5.0_wp, &
      &   meaning='its inertia about the hinge, with mass'), &
      & property_type('hinge_depth', unit='m', owners=all_walls, optional=.true., smallest=0.0_wp, &
      &   largest=1.0e3_wp, example='0.02', &
      &   usual_most=1.0_wp, &
      &   meaning='depth of the hinge behind the outer face, of each hinge of two_block behind its face'), &
      & property_type('compressive_strength', unit='Pa', owners=all_walls, optional=.true., positive=.true., &
      &   largest=1.0e12_wp, usual_least=1.0e5_wp, usual_most=1.0e8_wp, &
      &   example='2.0e6', &
      &   meaning='strength of the masonry, from which that depth follows'), &
      & property_type('stress_block', owners=all_walls, optional=.true., positive=.true., largest=1.0_wp, example='0.85', &
      &   meaning='stress in the compressed part of the base / that strength, 0.85 if not given'), &
      & property_type('edge_radius', unit='m', owners=one_block, optional=.true., smallest=0.0_wp, &
      &   largest=1.0e3_wp, example='0.02', &
      &   usual_most=1.0_wp, &
      &   meaning='radius of the edge that the wall rolls on, which is also the depth of its hinge at rest'), &
      & property_type('load', is_list, unit='N/m', owners=one_block, optional=.true., smallest=0.0_wp, largest=1.0e9_wp, &
      &   usual_least=100.0_wp, usual_most=1.0e6_wp, if_more='is it per metre of wall?', &
      &   example='12.0e3, 6.0e3', meaning='vertical loads that go with the wall, per metre of wall'), &
      & property_type('load_depth', is_list, unit='m', owners=one_block, optional=.true., example='0.5, 0.35', &
      &   usual_most=3.0_wp, &
      &   meaning='depth of each load behind the outer face'), &
      & property_type('load_height', is_list, unit='m', owners=one_block, optional=.true., example='4.0, 7.5', &
      &   one_each=.true., usual_most=60.0_wp, &
      &   meaning='height of each load above the base'), &
      & property_type('load_inertia', is_words, owners=one_block, optional=.true., &
      &   choices=reshape(load_inertias, [most_choices], pad=blank), more='one for all loads, or one for each', &
      &   example='''both''', meaning='which mass of each load the wall moves'), &
      & property_type('load_lifted', is_list, owners=one_block, optional=.true., smallest=0.0_wp, largest=1.0_wp, &
      &   example='1.0, 0.5', meaning='part of each load whose mass the wall lifts, with load_pushed instead of load_inertia'), &
      & property_type('load_pushed', is_list, owners=one_block, optional=.true., smallest=0.0_wp, largest=1.0_wp, &
      &   example='0.3, 0.0', meaning='part of each load whose mass the wall pushes'), &
      & property_type('load_seat', is_list, unit='m', owners=one_block, optional=.true., positive=.true., &
      &   example='0.15, 0.15', usual_most=2.0_wp, &
      &   meaning='horizontal travel at which each load loses its seat'), &
      & property_type('inertia_mass', is_list, unit='kg/m', owners=one_block, optional=.true., smallest=0.0_wp, &
      &   largest=1.0e9_wp, example='600.0', usual_least=5.0_wp, &
      &   meaning='masses that the wall pushes and does not carry, per metre of wall'), &
      & property_type('inertia_depth', is_list, unit='m', owners=one_block, optional=.true., example='0.175', &
      &   usual_most=3.0_wp, &
      &   meaning='depth of each of them behind the outer face'), &
      & property_type('inertia_height', is_list, unit='m', owners=one_block, optional=.true., example='3.0', &
      &   one_each=.true., usual_most=60.0_wp, &
      &   meaning='height of each of them above the base'), &
      & property_type('thrust', is_list, unit='N/m', owners=one_block, optional=.true., smallest=0.0_wp, &
      &   largest=1.0e9_wp, usual_least=10.0_wp, usual_most=1.0e5_wp, &
      &   if_more='is it per metre of wall?', example='1.0e3', meaning='horizontal forces outwards, per metre of wall'), &
      & property_type('thrust_depth', is_list, unit='m', owners=one_block, optional=.true., example='0.3', &
      &   usual_most=3.0_wp, &
      &   meaning='depth of each thrust behind the outer face, the inner face if not given'), &
      & property_type('thrust_height', is_list, unit='m', owners=one_block, optional=.true., example='7.5', &
      &   one_each=.true., usual_most=60.0_wp, &
      &   meaning='height of each thrust above the base'), &
      & property_type('thrust_decay', is_list, unit='m', owners=one_block, optional=.true., smallest=1.0e-4_wp, &
      &   example='0.05', usual_most=3.0_wp, &
      &   meaning='travel over which each thrust falls to 1/e, constant if not given'), &
      & property_type('spring', is_list, unit='N/m2', owners=one_block, optional=.true., smallest=0.0_wp, &
      &   largest=1.0e9_wp, example='50.0e3', usual_least=500.0_wp, &
      &   meaning='stiffness of springs that pull and push, per metre of wall'), &
      & property_type('spring_depth', is_list, unit='m', owners=one_block, optional=.true., example='0.0', &
      &   usual_most=3.0_wp, &
      &   meaning='depth of each spring behind the outer face'), &
      & property_type('spring_height', is_list, unit='m', owners=one_block, optional=.true., example='3.0', &
      &   one_each=.true., usual_most=60.0_wp, &
      &   meaning='height of each spring above the base'), &
      & property_type('bed', is_list, unit='N/m3', owners=one_block, optional=.true., smallest=0.0_wp, largest=1.0e9_wp, &
      &   example='20.0e3', usual_least=500.0_wp, &
      &   meaning='stiffness of springs spread over a height, per metre of wall and of height'), &
      & property_type('bed_depth', is_list, unit='m', owners=one_block, optional=.true., example='0.25', &
      &   usual_most=3.0_wp, &
      &   meaning='depth of each bed behind the outer face'), &
      & property_type('bed_bottom', is_list, unit='m', owners=one_block, optional=.true., example='0.0', &
      &   usual_most=60.0_wp, &
      &   meaning='height at which each bed begins'), &
      & property_type('bed_top', is_list, unit='m', owners=one_block, optional=.true., example='3.0', &
      &   usual_most=60.0_wp, &
      &   meaning='height at which each bed ends'), &
      & property_type('tie_height', is_list, unit='m', owners=one_sided, optional=.true., example='7.4', &
      &   usual_most=60.0_wp, &
      &   meaning='height of the anchor of each tie above the base'), &
      & property_type('tie_depth', is_list, unit='m', owners=one_sided, optional=.true., example='0.0', &
      &   absent=0.0_wp, usual_most=3.0_wp, &
      &   meaning='depth of each anchor behind the outer face, 0 if not given'), &
      & property_type('tie_area', is_list, unit='m2/m', owners=one_sided, optional=.true., positive=.true., &
      &   largest=1.0e-2_wp, usual_least=1.0e-6_wp, usual_most=1.0e-3_wp, &
      &   example='5.0e-5', &
      &   meaning='section of each tie per metre of wall: that of a bar / distance of two bars'), &
      & property_type('tie_length', is_list, unit='m', owners=one_sided, optional=.true., positive=.true., &
      &   smallest=0.1_wp, largest=1.0e3_wp, usual_most=60.0_wp, example='8.0', &
      &   meaning='length of each tie that is free to stretch, as a rule up to its other anchor'), &
      ! Where none are given: modulus and yield stress of historic iron, and the strain that anchorages leave
      & property_type('tie_modulus', is_list, unit='Pa', owners=one_sided, optional=.true., positive=.true., &
      &   smallest=1.0e8_wp, largest=1.0e12_wp, usual_least=1.0e9_wp, usual_most=5.0e11_wp, &
      &   example='2.06e11', absent=2.06e11_wp, &
      &   meaning='modulus of elasticity of each tie, 2.06e11 if not given'), &
      & property_type('tie_strength', is_list, unit='Pa', owners=one_sided, optional=.true., positive=.true., &
      &   largest=1.0e10_wp, usual_least=1.0e7_wp, usual_most=3.0e9_wp, &
      &   example='1.8e8', absent=1.8e8_wp, meaning='yield stress of each tie, 1.8e8 if not given'), &
      & property_type('tie_preload', is_list, unit='Pa', owners=one_sided, optional=.true., smallest=0.0_wp, &
      &   largest=1.0e10_wp, usual_least=1.0e5_wp, if_less='is it in MPa, or a force?', example='0.0', &
      &   absent=0.0_wp, meaning='stress of each tie at rest, less than its yield stress, 0 if not given'), &
      & property_type('tie_strain', is_list, owners=one_sided, optional=.true., positive=.true., largest=1.0_wp, &
      &   usual_most=0.3_wp, if_more='is it in per cent?', example='0.02', &
      &   absent=0.02_wp, meaning='strain of each tie at which it or its anchorage breaks, 0.02 if not given'), &
      & property_type('tie_anchor_force', is_list, unit='N/m', owners=one_sided, optional=.true., smallest=1.0e-9_wp, &
      &   largest=1.0e9_wp, usual_least=100.0_wp, usual_most=1.0e6_wp, &
      &   if_more='is it per metre of wall?', example='6.0e3', &
      &   meaning='force per metre of wall at which each anchor gives way at once; none if not given'), &
      & property_type('interlock_overlap', unit='m', owners=one_sided, optional=.true., positive=.true., &
      &   largest=10.0_wp, usual_most=1.0_wp, example='0.12', &
      &   meaning='length by which stones of the wall overlap those of transverse walls, whose friction holds it'), &
      & property_type('interlock_course', unit='m', owners=one_sided, optional=.true., positive=.true., &
      &   smallest=1.0e-3_wp, largest=1.0e3_wp, usual_least=0.03_wp, usual_most=1.0_wp, &
      &   if_less='is it the height of a joint?', example='0.10', &
      &   meaning='height of a course there'), &
      & property_type('interlock_thickness', unit='m', owners=one_sided, optional=.true., positive=.true., &
      &   largest=10.0_wp, usual_most=3.0_wp, example='0.25', &
      &   meaning='thickness of a transverse wall'), &
      & property_type('interlock_spacing', unit='m', owners=one_sided, optional=.true., positive=.true., &
      &   smallest=0.1_wp, largest=1.0e3_wp, usual_least=1.0_wp, usual_most=50.0_wp, &
      &   if_less='is it a thickness?', example='5.0', &
      &   meaning='distance of two transverse walls'), &
      & property_type('interlock_friction', owners=one_sided, optional=.true., positive=.true., largest=2.0_wp, &
      &   usual_most=1.0_wp, if_more='is it an angle, or in per cent?', example='0.577', &
      &   absent=0.577_wp, meaning='coefficient of friction in the overlaps, 0.577 if not given'), &
      & property_type('hinge', default=0.5_wp, smallest=0.01_wp, largest=0.99_wp, owners=two_block, &
      &   meaning='height of the intermediate hinge / height of the wall'), &
      & property_type('restitution', is_text, word='default', checked_by_owner=.true., column='restitution_model', &
      &   choices=reshape(restitution_models, [most_choices], pad=blank), meaning='model of the impacts'), &
      & property_type('restitution_value', optional=.true., smallest=0.0_wp, largest=1.0_wp, less=.true., &
      &   example='0.9', meaning='speed after / before an impact, only with restitution = ''constant'''), &
      & property_type('restitution_factor', default=1.0_wp, positive=.true., &
      &   usual_most=1.5_wp, &
      &   meaning='factor on the speed ratio of any model'), &
      & property_type('overburden', unit='N/m', default=0.0_wp, smallest=0.0_wp, largest=1.0e9_wp, owners=two_block, &
      &   meaning='vertical load on the top, per metre of wall', usual_least=200.0_wp, usual_most=1.0e6_wp, &
      &   if_more='is it per metre of wall?'), &
      & property_type('overburden_inertia', smallest=0.0_wp, largest=1.0_wp, owners=two_block, optional=.true., &
      &   example='1.0', meaning='part of that load whose mass the wall lifts', &
      &   more='0 for a force alone (springs, tendons), 1 for a storey above; given with it'), &
      & property_type('eccentricity', unit='m', default=0.0_wp, owners=two_block, usual_most=3.0_wp, &
      &   meaning='distance of that load '// &
      &   'from the centreline towards the active top hinge', more='the outer face where the wall folds outwards; '// &
      &   'negative for an inner bearing'), &
      & property_type('bearing', is_text, optional=.true., owners=two_block, replaced=.true., example='centre', &
      &   choices=reshape(bearing_names, [most_choices], pad=blank), meaning='where that load bears, '// &
      &   'instead of the eccentricity'), &
      & property_type('bearing_distance', unit='m', optional=.true., owners=two_block, replaced=.true., &
      &   example='0.06', usual_most=3.0_wp, &
      &   meaning='distance of the load''s resultant from the inner or the outer face', &
      &   more='half the length that joists bear')]

   !> The same, and those of the building that a wall stands on
   type(property_type), parameter :: rows(*) = [own_rows, building_rows]

   !> The same where pointers can point
   type(property_type), target, protected :: wall_properties(size(rows)) = rows

   !> Their names, close together: they are looked for all the time
   character(len=len(rows%name)), parameter :: names(size(rows)) = rows%name

   !> How many of them are of the wall itself: those that stand before the others
   integer, parameter :: own_properties = size(own_rows)

   integer :: k

   !> Properties of the building
   logical, parameter :: is_of_building(size(rows)) = [(k > own_properties, k=1, size(rows))]

   !> Properties that bare rectangles with hinges at their edges do not have
   logical, parameter :: is_beyond_bare(size(rows)) = rows%optional .and. rows%owners(1) /= blank(1) .and. .not. rows%replaced

   !> Those that tables show only where a wall has them
   logical, parameter :: is_extra(size(rows)) = is_beyond_bare .or. is_of_building

   !> What walls have of their place; in namelists it stands in &solver, for all walls
   type(property_type), parameter :: gravity_property = property_type('gravity', unit='m/s2', &
      & default=standard_gravity, positive=.true., smallest=1.0e-3_wp, largest=1.0e3_wp, usual_least=9.7_wp, usual_most=10.0_wp, &
      & if_less='is it in g?', if_more='is it in cm/s2 or ft/s2?', meaning='acceleration of gravity')

   !> How many of them are numbers
   integer, parameter :: wall_numbers = count(rows%kind /= is_text .and. rows%kind /= is_words)

   !> What a user says of a wall
   type, extends(settings_type) :: wall_input_type
   contains
      procedure :: get_table
      procedure :: find
   end type wall_input_type

contains

   !> What stands in the place of a number that is not given beside the others of its kind
   pure real(wp) function absent_value(name)
      !> Name of the property, in lower case
      character(len=*), intent(in) :: name

      absent_value = wall_properties(find_property(wall_properties, name))%absent
   end function absent_value

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
      find = find_name(names, name)
   end function find

end module dondolo_wall_properties
