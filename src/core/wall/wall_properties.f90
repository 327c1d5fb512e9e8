!> The properties of walls: one row each, from which readers, messages, templates, tables of results, the boundary to
!> Python and Python's own signatures derive.
!>
!> Here are those that all walls share, and the list of all. A property of one mechanism is a row in the file of its model.
module dondolo_wall_properties
   use dondolo_base_kinds, only : wp
   use dondolo_base_lines, only : lines_type
   use dondolo_base_property, only : blank, choices_length, find_name, is_integer, is_text, is_words, most_choices, property_type
   use dondolo_base_settings, only : settings_type
   use dondolo_building_input, only : building_rows
   use dondolo_wall_axis, only : axis_rows
   use dondolo_wall_chain_model, only : chain_rows
   use dondolo_wall_corner, only : corner_name, corner_rows
   use dondolo_wall_elevation, only : elevation_rows
   use dondolo_wall_free_wall, only : free_rows
   use dondolo_wall_horizontal, only : horizontal_rows
   use dondolo_wall_one_block_model, only : one_block_action_rows, one_block_body_rows, one_block_names
   use dondolo_wall_restitution, only : restitution_models
   use dondolo_wall_tabulated_model, only : chain_name, horizontal_name, tabulated_name, tabulated_rows
   use dondolo_wall_two_block_model, only : two_block_hinge_rows, two_block_joint_rows, &
      & two_block_load_rows, two_block_name
   use dondolo_wall_wedge, only : wedge_rows
   implicit none
   private

   public :: wall_input_type, wall_properties
   public :: is_beyond_bare, is_extra, is_of_building, is_of_tie, masonry_names, mechanism_names, own_properties
   public :: wall_numbers

   !> Names of the mechanisms of blocks of masonry, and of all
   character(len=choices_length), parameter :: masonry_names(*) = [one_block_names, two_block_name]
   character(len=choices_length), parameter :: mechanism_names(*) = [masonry_names, corner_name, tabulated_name, &
      & chain_name, horizontal_name]

   !> Owners of what walls with a thickness have
   character(len=choices_length), parameter :: of_blocks(most_choices) = &
      & reshape([masonry_names, corner_name, horizontal_name], [most_choices], pad=blank)

   !> What every wall has
   type(property_type), parameter :: general_rows(*) = [ &
      & property_type('name', is_text, word='wall', column='wall', changes_results=.false., meaning='name in the results'), &
      & property_type('mechanism', is_text, required=.true., choices=reshape(mechanism_names, [most_choices], pad=blank), &
      &   checked_by_owner=.true., example='one_sided', meaning='how the wall rocks'), &
      & property_type('height', unit='m', required=.true., positive=.true., smallest=1.0e-3_wp, largest=1.0e3_wp, &
      &   example='3.0', meaning='height of the wall', instead='section_height, elevation_z, length', &
      &   usual_most=60.0_wp), &
      & property_type('thickness', unit='m', owners=of_blocks, required=.true., positive=.true., smallest=1.0e-3_wp, &
      &   largest=1.0e3_wp, example='0.25', meaning='thickness of the wall', instead='section_thickness', usual_most=3.0_wp), &
      & property_type('density', unit='kg/m3', owners=of_blocks, default=1800.0_wp, positive=.true., &
      &   smallest=1.0e-3_wp, largest=1.0e5_wp, meaning='density of the masonry', usual_least=500.0_wp, usual_most=4000.0_wp, &
      &   if_less='is it in kN/m3 or t/m3?', if_more='is it in N/m3?')]

   !> Depth of the hinges behind the faces
   type(property_type), parameter :: hinge_rows(*) = [ &
      & property_type('hinge_depth', unit='m', owners=of_blocks, optional=.true., smallest=0.0_wp, &
      &   largest=1.0e3_wp, example='0.02', not_with='compressive_strength', neutral=0.0_wp, &
      &   usual_most=1.0_wp, &
      &   meaning='depth of the hinge behind the outer face, of two_block and horizontal of each hinge behind its face'), &
      & property_type('compressive_strength', unit='Pa', owners=of_blocks, optional=.true., positive=.true., &
      &   largest=1.0e12_wp, usual_least=1.0e5_wp, usual_most=1.0e8_wp, &
      &   example='2.0e6', &
      &   meaning='strength of the masonry, from which that depth follows'), &
      & property_type('stress_block', owners=of_blocks, optional=.true., positive=.true., largest=1.0_wp, example='0.85', &
      &   meaning='stress in the compressed part of the base / that strength, 0.85 if not given')]

   !> Properties of the place and of impacts, of every wall
   type(property_type), parameter :: impact_rows(*) = [ &
      & property_type('base_level', unit='m', optional=.true., smallest=0.0_wp, largest=1.0e3_wp, usual_most=150.0_wp, &
      &   example='8.0', changes_results=.false., &
      &   meaning='height of its base above the ground, on a building that is not given: a check by a code has no spectrum '// &
      &   'there; hinge_level sets it'), &
      & property_type('restitution', is_text, word='default', checked_by_owner=.true., column='restitution_model', &
      &   choices=reshape(restitution_models, [most_choices], pad=blank), meaning='model of the impacts', &
      &   more='none where restitution_value is given'), &
      & property_type('restitution_value', optional=.true., smallest=0.0_wp, largest=1.0_wp, less=.true., &
      &   example='0.9', meaning='speed after / before an impact, instead of a model'), &
      & property_type('restitution_factor', default=1.0_wp, positive=.true., &
      &   usual_most=1.5_wp, &
      &   meaning='factor on the restitution e of any model'), &
      & property_type('restitution_sd', optional=.true., smallest=0.0_wp, largest=0.5_wp, less=.true., example='0.02', &
      &   meaning='standard deviation of the restitution e, which then varies from impact to impact, uniformly about that of '// &
      &   'the model'), &
      & property_type('restitution_seed', is_integer, optional=.true., smallest=1.0_wp, largest=1.0e6_wp, absent=1.0_wp, &
      &   example='1', meaning='seed of the random numbers of these ratios, 1 if not given')]

   !> Names of those that few walls have: of a ratio that varies, and of a base above the ground
   character(len=*), parameter :: rare_names(3) = [character(len=16) :: 'restitution_sd', 'restitution_seed', 'base_level']

   !> The rows of the wall itself, in the order in which a user thinks of them
   type(property_type), parameter :: own_rows(*) = [general_rows, one_block_body_rows, wedge_rows, elevation_rows, &
      & axis_rows, corner_rows, hinge_rows, &
      & one_block_action_rows, free_rows, two_block_hinge_rows, two_block_joint_rows, impact_rows, two_block_load_rows, &
      & tabulated_rows, chain_rows, horizontal_rows]

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

   !> Properties that not all walls of a mechanism have
   logical, parameter :: is_of_some(size(rows)) = rows%optional .and. rows%owners(1) /= blank(1) .and. .not. rows%replaced

   !> Properties of wedges of transverse walls
   logical, parameter :: is_of_wedge(size(rows)) = index(rows%name, 'wedge_') == 1 .or. rows%name == 'facade_length'

   !> Those of them that bare rectangles with hinges at their edges do not have; what only checks need changes no motion, and
   !> wedges count if they have a mass
   logical, parameter :: is_beyond_bare(size(rows)) = is_of_some .and. rows%changes_results .and. .not. is_of_wedge

   !> Properties of ties, and of the masonry that their plates bear on
   logical, parameter :: is_of_tie(size(rows)) = index(rows%name, 'tie_') == 1 .or. index(rows%name, 'masonry_') == 1 &
      & .or. rows%name == 'bearing_factor'

   !> Those that tables show only where a wall has them; every strip has a hinge, given or found
   logical, parameter :: is_extra(size(rows)) = (is_of_some .and. rows%name /= 'hinge') .or. is_of_building &
      & .or. rows%name == rare_names(1) .or. rows%name == rare_names(2) .or. rows%name == rare_names(3)

   !> How many of them are numbers
   integer, parameter :: wall_numbers = count(rows%kind /= is_text .and. rows%kind /= is_words)

   !> What a user says of a wall
   type, extends(settings_type) :: wall_input_type
      !> File that the terms of a tabulated wall were read from; not allocated: they are lists
      character(len=:), allocatable :: table_file
      !> Those that a chain was read from
      type(lines_type) :: chain_files
   contains
      procedure :: get_table
      procedure :: find
   end type wall_input_type

contains

   !> The table
   subroutine get_table(self, table)
      !> Input of a wall
      class(wall_input_type), intent(in) :: self
      !> The properties of walls
      type(property_type), pointer, intent(out) :: table(:)

      associate (of => self)
      end associate
      table => wall_properties
   end subroutine get_table

   !> Place of a property in the table
   pure integer function find(self, name)
      !> Input of a wall
      class(wall_input_type), intent(in) :: self
      !> Name of the property, in lower case
      character(len=*), intent(in) :: name

      associate (of => self)
      end associate
      find = find_name(names, name)
   end function find

end module dondolo_wall_properties
