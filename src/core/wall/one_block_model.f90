!> Walls of one block: 'one_sided', 'free_standing' and 'corner'. Their names, their properties, and how one becomes a mechanism.
!>
!> A one-sided wall, such as a facade or a parapet, leans on transverse walls and can only fall outwards. A free-standing wall,
!> such as a pinnacle, rocks to both sides. A bare rectangle is equation (1) of Nale et al. (dondolo_wall_single_block); with
!> storeys, loads, springs, ties or a hinge behind the face it is a dondolo_wall_loaded_block.
module dondolo_wall_one_block_model
   use dondolo_base_error, only : error_type, problems_type
   use dondolo_base_kinds, only : wp
   use dondolo_base_lines, only : lines_type
   use dondolo_base_property, only : blank, choices_length, is_integer, is_list, is_text, is_words, most_choices, property_type
   use dondolo_base_settings, only : settings_type
   use dondolo_base_text, only : rounded
   use dondolo_building_input, only : leans
   use dondolo_wall_axis, only : axis_of, axis_type
   use dondolo_wall_block, only : block_type, new_block
   use dondolo_wall_body, only : read_corner_body, read_wall_body, take_sections, wall_body_type
   use dondolo_wall_carried, only : describe_actions
   use dondolo_wall_corner, only : body_of_wing, corner_name
   use dondolo_wall_free_wall, only : check_free
   use dondolo_wall_loaded_block, only : loaded_block_type, new_loaded_block
   use dondolo_wall_loaded_impact, only : one_sided_impulse, two_sided_impulse
   use dondolo_wall_mechanism, only : mechanism_type
   use dondolo_wall_model, only : wall_model_type
   use dondolo_wall_restitution, only : impact_models_type
   use dondolo_wall_rigid_body, only : rigid_body_type
   use dondolo_wall_single_block, only : housner_restitution, new_single_block, one_sided_restitution, single_block_type
   use dondolo_wall_two_block_model, only : two_block_name
   implicit none
   private

   public :: one_block_model_type, one_block_names, one_block_body_rows, one_block_action_rows

   !> Names of the mechanisms
   character(len=choices_length), parameter :: one_block_names(2) = &
      & [character(len=choices_length) :: 'one_sided', 'free_standing']

   !> Owners of what both have
   character(len=choices_length), parameter :: one_block(most_choices) = reshape(one_block_names, [most_choices], pad=blank)

   !> Owners of what only a wall against transverse walls has
   character(len=choices_length), parameter :: one_sided(most_choices) = reshape(one_block_names(:1), [most_choices], pad=blank)

   !> Why what acts on the wall does not go with several leaves: one of them would have all of it, the others nothing
   character(len=*), parameter :: on_one_leaf = 'it acts on one leaf; describe each leaf as a wall of its own thickness, '// &
      & 'both in one facade'

   !> Owner of what only a corner has
   character(len=choices_length), parameter :: corner(most_choices) = reshape([corner_name], [most_choices], pad=blank)

   !> Owners of what a corner has too: places of loads and thrusts, which may change as they travel; hinges above the base
   character(len=choices_length), parameter :: loaded(most_choices) = &
      & reshape([one_block_names, two_block_name, corner_name], [most_choices], pad=blank)
   character(len=choices_length), parameter :: seated(most_choices) = &
      & reshape([one_block_names, corner_name], [most_choices], pad=blank)
   character(len=choices_length), parameter :: leaning(most_choices) = &
      & reshape([one_block_names(:1), corner_name], [most_choices], pad=blank)

   !> Owners of what strips between floors have too: loads, masses and thrusts; ties
   character(len=choices_length), parameter :: carrying(most_choices) = &
      & reshape([one_block_names, two_block_name], [most_choices], pad=blank)
   character(len=choices_length), parameter :: tied(most_choices) = reshape([one_block_names(:1), two_block_name], &
      & [most_choices], pad=blank)
   character(len=choices_length), parameter :: barred(most_choices) = &
      & reshape([one_block_names(:1), two_block_name, corner_name], [most_choices], pad=blank)

   !> Which mass a load brings: none, one that the wall lifts, one that it lifts and pushes
   character(len=choices_length), parameter :: load_inertias(*) = &
      & [character(len=choices_length) :: 'none', 'vertical', 'both']

   !> Properties of the masonry
   type(property_type), parameter :: one_block_body_rows(*) = [ &
      & property_type('section_height', is_list, unit='m', owners=one_block, optional=.true., positive=.true., &
      &   smallest=1.0e-3_wp, largest=1.0e3_wp, usual_most=20.0_wp, example='4.0, 3.5', &
      &   not_with='mass', because='which does not say how much of it each storey has', &
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
      &   example='2', neutral=1.0_wp, &
      &   meaning='number of equal leaves that nothing connects: each rocks alone with its part of the thickness'), &
      & property_type('hinge_level', is_list, unit='m', owners=leaning, optional=.true., replaced=.true., &
      &   smallest=0.0_wp, largest=1.0e3_wp, example='0.0, 4.0, 7.5', neutral=0.0_wp, &
      &   not_with='mass', because='which does not say how much of it is above', usual_most=60.0_wp, &
      &   meaning='heights of hinges: each makes a wall of what is above it', &
      &   more='one for a single wall, several for a facade in a population'), &
      & property_type('hinge_at', is_text, owners=one_sided, optional=.true., replaced=.true., &
      &   choices=reshape([character(len=choices_length) :: 'storeys'], [most_choices], pad=blank), example='storeys', &
      &   meaning='a hinge at the bottom of every section, instead of hinge_level'), &
      & property_type('mass', unit='kg/m', owners=one_block, optional=.true., positive=.true., &
      &   smallest=1.0e-3_wp, largest=1.0e9_wp, example='1350.0', usual_least=20.0_wp, &
      &   not_with='leaves', because=on_one_leaf, &
      &   meaning='mass of the body, instead of its density'), &
      & property_type('centroid_depth', unit='m', owners=one_block, optional=.true., smallest=0.0_wp, &
      &   largest=1.0e3_wp, example='0.125', usual_most=3.0_wp, &
      &   meaning='depth of its centroid behind the outer face, with mass'), &
      & property_type('centroid_height', unit='m', owners=one_block, optional=.true., positive=.true., &
      &   largest=1.0e3_wp, example='1.5', usual_most=60.0_wp, &
      &   meaning='height of its centroid, with mass'), &
      & property_type('hinge_inertia', unit='kg m2/m', owners=one_block, optional=.true., positive=.true., &
      &   column='hinge_inertia_kg_m', example='4078.0', usual_least=5.0_wp, &
      &   meaning='its inertia about the hinge, with mass')]

   !> Properties of its edge and of what acts on it
   type(property_type), parameter :: one_block_action_rows(*) = [ &
      & property_type('edge_radius', unit='m', owners=one_block, optional=.true., smallest=0.0_wp, &
      &   largest=1.0e3_wp, example='0.02', neutral=0.0_wp, &
      &   not_with='hinge_depth, compressive_strength', because='the hinge is where the edge begins', usual_most=1.0_wp, &
      &   meaning='radius of the edge that the wall rolls on, which is also the depth of its hinge at rest'), &
      & property_type('load', is_list, unit='N/m', owners=carrying, optional=.true., smallest=0.0_wp, largest=1.0e9_wp, &
      &   usual_least=100.0_wp, usual_most=1.0e6_wp, if_more='is it per metre of wall?', &
      &   not_with='leaves', because=on_one_leaf, &
      &   example='12.0e3, 6.0e3', meaning='vertical loads that go with the wall, per metre of wall'), &
      & property_type('load_depth', is_list, unit='m', owners=loaded, optional=.true., example='0.5, 0.35', &
      &   usual_most=3.0_wp, &
      &   meaning='depth of each load behind the outer face'), &
      & property_type('load_height', is_list, unit='m', owners=loaded, optional=.true., example='4.0, 7.5', &
      &   one_each=.true., usual_most=60.0_wp, &
      &   meaning='height of each load above the base'), &
      & property_type('load_inertia', is_words, owners=loaded, optional=.true., &
      &   choices=reshape(load_inertias, [most_choices], pad=blank), more='one for all loads, or one for each', &
      &   not_with='load_lifted, load_pushed', &
      &   example='''both''', meaning='which mass of each load the wall moves'), &
      & property_type('load_lifted', is_list, owners=loaded, optional=.true., smallest=0.0_wp, largest=1.0_wp, &
      &   example='1.0, 0.5', meaning='part of each load whose mass the wall lifts, with load_pushed instead of load_inertia'), &
      & property_type('load_pushed', is_list, owners=loaded, optional=.true., smallest=0.0_wp, largest=1.0_wp, &
      &   example='0.3, 0.0', meaning='part of each load whose mass the wall pushes'), &
      & property_type('load_seat', is_list, unit='m', owners=seated, optional=.true., positive=.true., &
      &   example='0.15, 0.15', usual_most=2.0_wp, &
      &   meaning='horizontal travel at which each load loses its seat'), &
      & property_type('load_total', is_list, unit='N', owners=corner, optional=.true., smallest=0.0_wp, largest=1.0e9_wp, &
      &   usual_least=100.0_wp, usual_most=1.0e6_wp, example='6.0e3, 4.0e3', &
      &   meaning='vertical loads that go with a corner, each in all and not per metre'), &
      & property_type('load_x', is_list, unit='m', owners=one_sided, optional=.true., smallest=-1.0e3_wp, largest=1.0e3_wp, &
      &   usual_least=-1.0e3_wp, example='3.0, 3.0', one_each=.true., meaning='place of each load along the facade, with axis_x'), &
      & property_type('inertia_mass', is_list, unit='kg/m', owners=carrying, optional=.true., smallest=0.0_wp, &
      &   largest=1.0e9_wp, example='600.0', usual_least=5.0_wp, not_with='leaves', because=on_one_leaf, &
      &   meaning='masses that the wall pushes and does not carry, per metre of wall'), &
      & property_type('inertia_depth', is_list, unit='m', owners=carrying, optional=.true., example='0.175', &
      &   usual_most=3.0_wp, &
      &   meaning='depth of each of them behind the outer face'), &
      & property_type('inertia_height', is_list, unit='m', owners=carrying, optional=.true., example='3.0', &
      &   one_each=.true., usual_most=60.0_wp, &
      &   meaning='height of each of them above the base'), &
      & property_type('inertia_x', is_list, unit='m', owners=one_sided, optional=.true., smallest=-1.0e3_wp, largest=1.0e3_wp, &
      &   usual_least=-1.0e3_wp, example='3.0', one_each=.true., meaning='place of each of them along the facade, with axis_x'), &
      & property_type('thrust', is_list, unit='N/m', owners=carrying, optional=.true., smallest=0.0_wp, &
      &   largest=1.0e9_wp, usual_least=10.0_wp, usual_most=1.0e5_wp, not_with='leaves', because=on_one_leaf, &
      &   if_more='is it per metre of wall?', example='1.0e3', meaning='horizontal forces outwards, per metre of wall'), &
      & property_type('thrust_depth', is_list, unit='m', owners=loaded, optional=.true., example='0.3', &
      &   usual_most=3.0_wp, &
      &   meaning='depth of each thrust behind the outer face, the inner face if not given'), &
      & property_type('thrust_height', is_list, unit='m', owners=loaded, optional=.true., example='7.5', &
      &   one_each=.true., usual_most=60.0_wp, &
      &   meaning='height of each thrust above the base'), &
      & property_type('thrust_decay', is_list, unit='m', owners=seated, optional=.true., smallest=1.0e-4_wp, &
      &   example='0.05', usual_most=3.0_wp, &
      &   meaning='travel over which each thrust falls to 1/e, constant if not given'), &
      & property_type('thrust_total', is_list, unit='N', owners=corner, optional=.true., smallest=0.0_wp, largest=1.0e9_wp, &
      &   usual_least=10.0_wp, usual_most=1.0e5_wp, example='2.0e3', &
      &   meaning='horizontal forces outwards along the bisector of a corner, each in all and not per metre'), &
      & property_type('thrust_x', is_list, unit='m', owners=one_sided, optional=.true., smallest=-1.0e3_wp, largest=1.0e3_wp, &
      &   usual_least=-1.0e3_wp, example='3.0', one_each=.true., meaning='place of each thrust along the facade, with axis_x'), &
      & property_type('spring', is_list, unit='N/m2', owners=one_block, optional=.true., smallest=0.0_wp, &
      &   largest=1.0e9_wp, example='50.0e3', usual_least=500.0_wp, not_with='leaves', because=on_one_leaf, &
      &   meaning='stiffness of springs that pull and push, per metre of wall'), &
      & property_type('spring_depth', is_list, unit='m', owners=one_block, optional=.true., example='0.0', &
      &   usual_most=3.0_wp, &
      &   meaning='depth of each spring behind the outer face'), &
      & property_type('spring_height', is_list, unit='m', owners=one_block, optional=.true., example='3.0', &
      &   one_each=.true., usual_most=60.0_wp, &
      &   meaning='height of each spring above the base'), &
      & property_type('distributed_spring', is_list, unit='N/m3', owners=one_block, optional=.true., smallest=0.0_wp, &
      &   largest=1.0e9_wp, example='20.0e3', usual_least=500.0_wp, not_with='leaves', because=on_one_leaf, &
      &   meaning='stiffness of springs spread over a height, per metre of wall and of height'), &
      & property_type('distributed_spring_depth', is_list, unit='m', owners=one_block, optional=.true., example='0.25', &
      &   usual_most=3.0_wp, &
      &   meaning='depth of each of them behind the outer face'), &
      & property_type('distributed_spring_bottom', is_list, unit='m', owners=one_block, optional=.true., example='0.0', &
      &   usual_most=60.0_wp, &
      &   meaning='height at which each of them begins'), &
      & property_type('distributed_spring_top', is_list, unit='m', owners=one_block, optional=.true., example='3.0', &
      &   usual_most=60.0_wp, &
      &   meaning='height at which each of them ends'), &
      & property_type('tie_height', is_list, unit='m', owners=barred, optional=.true., example='7.4', &
      &   usual_most=60.0_wp, not_with='leaves', because=on_one_leaf, &
      &   meaning='height of the anchor of each tie above the base'), &
      & property_type('tie_depth', is_list, unit='m', owners=barred, optional=.true., example='0.0', &
      &   absent=0.0_wp, usual_most=3.0_wp, &
      &   meaning='depth of each anchor behind the outer face, 0 if not given'), &
      & property_type('tie_area', is_list, unit='m2/m', owners=tied, optional=.true., smallest=0.0_wp, &
      &   largest=1.0e-2_wp, usual_least=1.0e-6_wp, usual_most=1.0e-3_wp, &
      &   example='5.0e-5', absent=0.0_wp, zero='none', &
      &   meaning='section of each tie per metre of wall: that of a bar / distance of two bars'), &
      & property_type('tie_bar', is_list, unit='m', owners=barred, optional=.true., smallest=0.0_wp, largest=1.0_wp, &
      &   usual_least=5.0e-3_wp, usual_most=0.1_wp, example='0.024', absent=0.0_wp, zero='none', &
      &   meaning='diameter of the bar of each tie, with tie_spacing instead of tie_area; of a corner without a '// &
      &   'spacing'), &
      & property_type('tie_spacing', is_list, unit='m', owners=tied, optional=.true., smallest=0.0_wp, largest=1.0e3_wp, &
      &   usual_least=0.3_wp, usual_most=20.0_wp, example='2.5', absent=0.0_wp, zero='none', &
      &   meaning='distance of two bars of each tie along the wall'), &
      & property_type('tie_length', is_list, unit='m', owners=barred, optional=.true., positive=.true., &
      &   smallest=0.1_wp, largest=1.0e3_wp, usual_most=60.0_wp, example='8.0', &
      &   meaning='length of each tie that is free to stretch, as a rule up to its other anchor'), &
      ! Where none are given: modulus and yield stress of historic iron, and the strain that anchorages leave
      & property_type('tie_modulus', is_list, unit='Pa', owners=barred, optional=.true., positive=.true., &
      &   smallest=1.0e8_wp, largest=1.0e12_wp, usual_least=1.0e9_wp, usual_most=5.0e11_wp, &
      &   example='2.06e11', absent=2.06e11_wp, &
      &   meaning='modulus of elasticity of each tie, 2.06e11 if not given'), &
      & property_type('tie_strength', is_list, unit='Pa', owners=barred, optional=.true., positive=.true., &
      &   largest=1.0e10_wp, usual_least=1.0e7_wp, usual_most=3.0e9_wp, &
      &   example='1.8e8', absent=1.8e8_wp, meaning='yield stress of each tie, 1.8e8 if not given'), &
      & property_type('tie_preload', is_list, unit='Pa', owners=leaning, optional=.true., smallest=0.0_wp, &
      &   largest=1.0e10_wp, usual_least=1.0e5_wp, if_less='is it in MPa, or a force?', example='0.0', &
      &   absent=0.0_wp, meaning='stress of each tie at rest, less than its yield stress, 0 if not given'), &
      & property_type('tie_strain', is_list, owners=barred, optional=.true., positive=.true., largest=1.0_wp, &
      &   usual_most=0.3_wp, if_more='is it in per cent?', example='0.02', &
      &   absent=0.02_wp, meaning='strain of each tie at which it or its anchorage breaks, 0.02 if not given'), &
      & property_type('tie_anchor_force', is_list, unit='N/m', owners=tied, optional=.true., smallest=1.0e-9_wp, &
      &   largest=1.0e9_wp, usual_least=100.0_wp, usual_most=1.0e6_wp, &
      &   if_more='is it per metre of wall?', example='6.0e3', &
      &   meaning='force per metre of wall at which each anchor gives way at once; none if not given'), &
      & property_type('tie_anchor_total', is_list, unit='N', owners=corner, optional=.true., smallest=1.0e-9_wp, &
      &   largest=1.0e9_wp, usual_least=100.0_wp, usual_most=1.0e6_wp, example='20.0e3', &
      &   meaning='force at which the anchor of each tie of a corner gives way at once, in all and not per metre; none if not '// &
      &   'given'), &
      & property_type('tie_plate_width', is_list, unit='m', owners=tied, optional=.true., smallest=0.0_wp, largest=10.0_wp, &
      &   usual_least=0.03_wp, usual_most=1.5_wp, example='0.35', absent=0.0_wp, zero='none', &
      &   meaning='width of the plate of each tie, from which the force of its anchor follows instead of tie_anchor_force'), &
      & property_type('tie_plate_height', is_list, unit='m', owners=tied, optional=.true., smallest=0.0_wp, &
      &   largest=10.0_wp, usual_least=0.03_wp, usual_most=1.5_wp, example='0.35', absent=0.0_wp, zero='none', &
      &   meaning='height of that plate'), &
      & property_type('tie_plate_diameter', is_list, unit='m', owners=tied, optional=.true., smallest=0.0_wp, &
      &   largest=10.0_wp, usual_least=0.03_wp, usual_most=1.5_wp, example='0.30', absent=0.0_wp, zero='none', &
      &   meaning='diameter of a circular plate, instead of width and height'), &
      & property_type('tie_plate_thickness', is_list, unit='m', owners=tied, optional=.true., smallest=0.0_wp, &
      &   largest=1.0_wp, usual_least=3.0e-3_wp, usual_most=0.1_wp, example='0.02', absent=0.0_wp, zero='none', &
      &   meaning='thickness of that plate, of steel like that of the bar'), &
      & property_type('tie_leaf', is_list, unit='m', owners=tied, optional=.true., smallest=0.0_wp, largest=10.0_wp, &
      &   usual_least=0.05_wp, usual_most=3.0_wp, example='0.25', absent=0.0_wp, zero='wall', &
      &   meaning='thickness of the masonry that the plate of each tie bears on: one leaf of a wall whose leaves are not '// &
      &   'connected; else the whole wall, the thinner storey where two are near'), &
      & property_type('tie_compression', is_list, unit='Pa', owners=tied, optional=.true., smallest=0.0_wp, &
      &   largest=1.0e8_wp, usual_least=1.0e3_wp, usual_most=1.0e6_wp, if_less='is it in MPa?', example='5.0e4', &
      &   absent=0.0_wp, zero='none', &
      &   meaning='vertical stress of the masonry at the plate of each tie, with masonry_friction; no friction if not given'), &
      & property_type('masonry_compression', unit='Pa', owners=tied, optional=.true., positive=.true., &
      &   largest=1.0e12_wp, usual_least=1.0e5_wp, usual_most=1.0e8_wp, example='2.0e6', &
      &   meaning='mean strength of the masonry in compression at plates of ties; compressive_strength if not given'), &
      & property_type('masonry_shear', unit='Pa', owners=tied, optional=.true., positive=.true., &
      &   largest=1.0e12_wp, usual_least=1.0e3_wp, usual_most=1.0e6_wp, if_less='is it in MPa?', example='4.0e4', &
      &   meaning='mean shear strength without compression there'), &
      & property_type('masonry_tension', unit='Pa', owners=tied, optional=.true., positive=.true., &
      &   largest=1.0e12_wp, usual_least=1.0e3_wp, usual_most=1.0e6_wp, if_less='is it in MPa?', example='5.0e4', &
      &   meaning='mean tensile strength there'), &
      & property_type('masonry_friction', owners=tied, optional=.true., positive=.true., largest=2.0_wp, &
      &   usual_most=1.0_wp, if_more='is it an angle, or in per cent?', example='0.4', &
      &   meaning='coefficient of friction there, with tie_compression'), &
      & property_type('masonry_knowledge_factor', owners=tied, optional=.true., smallest=1.0_wp, largest=1.35_wp, &
      &   example='1.35', &
      &   meaning='confidence factor FC of these strengths, which are divided by 2 FC; 1.35 if not given'), &
      & property_type('bearing_factor', owners=tied, optional=.true., positive=.true., largest=5.0_wp, &
      &   example='1.0', &
      &   meaning='strength under a plate / strength of the masonry, of the engineer; 1.0 if not given'), &
      & property_type('interlock_overlap', unit='m', owners=one_sided, optional=.true., positive=.true., &
      &   largest=10.0_wp, usual_most=1.0_wp, example='0.12', not_with='leaves', because=on_one_leaf, &
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
      &   absent=0.577_wp, meaning='coefficient of friction in the overlaps, 0.577 if not given')]

   !> A wall of one block
   type, extends(wall_model_type) :: one_block_model_type
      !> Does it rock to both sides?
      logical :: two_sided = .false.
      !> Its storeys, its masonry and what acts on it
      type(wall_body_type) :: body
   contains
      procedure :: prepare
      procedure :: read
      procedure :: make_mechanism
      procedure :: describe
      !> Does it take wedges of transverse walls along?
      procedure :: has_wedges
   end type one_block_model_type

contains

   !> Set height, thickness and density that follow from storeys or from the mass
   subroutine prepare(self, input, problems)
      class(one_block_model_type), intent(inout) :: self
      !> Properties as given
      class(settings_type), intent(inout) :: input
      !> Takes what does not agree
      type(problems_type), intent(inout) :: problems

      type(axis_type) :: axis

      self%two_sided = input%word('mechanism') == 'free_standing'
      axis = axis_of(input)
      if (any(input%word('mechanism') == leaning) .and. .not. axis%is_inclined()) self%contact = leans
      call take_sections(problems, input)
   end subroutine prepare

   !> Read storeys, masonry and what acts on it
   subroutine read(self, input, gravity, problems)
      class(one_block_model_type), intent(inout) :: self
      !> Properties, defaults filled in
      class(settings_type), intent(inout) :: input
      !> Gravity [m/s2]
      real(wp), intent(in) :: gravity
      !> In: values beyond their ranges; takes what is wrong
      type(problems_type), intent(inout) :: problems

      if (problems%count > 0) return
      if (input%word('mechanism') == corner_name) then
         call read_corner_body(input, gravity, problems, self%body)
         self%is_whole = .true.
         self%is_bare = .false.
      else
         call read_wall_body(input, gravity, self%two_sided, problems, self%body)
         if (problems%count == 0) call check_free(input, self%body%sections, problems)
         if (problems%count == 0) self%is_bare = self%is_bare .and. .not. self%has_wedges()
      end if
      self%hinge_depth = self%body%actions%hinge
   end subroutine read

   !> Make the mechanism
   subroutine make_mechanism(self, input, gravity, mechanism, impacts, error)
      class(one_block_model_type), intent(inout) :: self
      !> Properties
      class(settings_type), intent(in) :: input
      !> Gravity [m/s2]
      real(wp), intent(in) :: gravity
      !> The mechanism
      class(mechanism_type), allocatable, intent(out) :: mechanism
      !> Speed ratios of its impacts. Against transverse walls the velocity reverses, so that they are minus the coefficients; of
      !> a bare block both models give the same
      type(impact_models_type), intent(out) :: impacts
      !> It does not stand at rest
      type(error_type), allocatable, intent(out) :: error

      type(loaded_block_type), allocatable :: loaded
      type(single_block_type), allocatable :: single
      type(block_type) :: block
      real(wp) :: depth, height

      if (self%is_bare) then
         block = new_block(input%number('height'), input%number('thickness'), input%number('density'))
         self%radius = block%radius
         self%alpha = block%alpha
         allocate (single)
         call new_single_block(single, block, gravity, self%two_sided)
         call move_alloc(single, mechanism)
         if (self%two_sided) then
            impacts%impulse = housner_restitution(block%alpha)
         else
            impacts%sorrentino = -one_sided_restitution(block%alpha)
            impacts%impulse = impacts%sorrentino
         end if
      else
         depth = self%body%body%depth - self%body%actions%hinge
         height = self%body%body%height - self%body%actions%edge
         self%radius = hypot(depth, height)
         self%alpha = atan2(depth, height)
         allocate (loaded)
         call new_loaded_block(loaded, self%body%body, self%body%actions, gravity, self%two_sided, error)
         call move_alloc(loaded, mechanism)
         if (allocated(error)) return
         mechanism%is_static = input%number('half_gable') > 0.0_wp
         if (self%two_sided) then
            impacts%impulse = two_sided_impulse(self%body)
         else
            ! Equation (2) of Nale et al. is that of a block, not of one with wedges, of an elevation nor of a corner
            if (.not. (self%has_wedges() .or. allocated(self%body%facade) .or. allocated(self%body%corner))) then
               impacts%sorrentino = -one_sided_restitution(atan2(self%body%body%depth, self%body%body%height))
            end if
            impacts%impulse = -one_sided_impulse(self%body)
            ! That a corner with wide wings, or a facade with long wedges, would not bounce off at all is outside what the
            ! convention is for
            impacts%may_be_plastic = .not. (allocated(self%body%corner) .or. self%has_wedges())
         end if
      end if
   end subroutine make_mechanism

   !> Does it take wedges of transverse walls along?
   pure logical function has_wedges(self)
      class(one_block_model_type), intent(in) :: self

      has_wedges = any(self%body%wedges%body%mass > 0.0_wp)
   end function has_wedges

   !> Describe the masonry and what acts on it
   subroutine describe(self, input, gravity, lines)
      class(one_block_model_type), intent(in) :: self
      !> Properties
      class(settings_type), intent(in) :: input
      !> Gravity [m/s2]
      real(wp), intent(in) :: gravity
      !> `subject: numbers with their units`
      type(lines_type), intent(inout) :: lines

      type(rigid_body_type) :: wing
      integer :: i

      associate (body => self%body%body, actions => self%body%actions)
         if (allocated(self%body%corner)) then
            call lines%add('masonry: '//rounded(body%mass)//' kg, centroid '//rounded(body%depth)//' m behind the outer edge '// &
               & 'on the bisector, '//rounded(body%height)//' m high, inertia about it '//rounded(body%inertia)//' kg m2')
            wing = body_of_wing(self%body%corner)
            if (wing%mass > 0.0_wp) call lines%add('wings: '//rounded(wing%mass)//' kg of the masonry each, centroid '// &
               & rounded(wing%depth)//' m deep on the bisector, '//rounded(wing%height)//' m high')
         else
            call lines%add('masonry: '//rounded(body%mass)//' kg/m, centroid '//rounded(body%depth)//' m behind the outer '// &
               & 'face, '//rounded(body%height)//' m high, inertia about it '//rounded(body%inertia)//' kg m2/m')
            if (input%has('axis_x')) call lines%add('axis: heights are above the line through ('//trim(point(1))// &
               & ') and ('//trim(point(2))//') m; share of gravity '//rounded(actions%gravity_share))
         end if
         do i = 1, size(self%body%wedges)
            associate (wedge => self%body%wedges(i))
               call lines%add('wedge: '//rounded(wedge%body%mass)//' kg/m of the masonry, from '//rounded(wedge%bottom)//' to '// &
                  & rounded(wedge%top)//' m, centroid '//rounded(wedge%body%depth)//' m deep, '// &
                  & rounded(wedge%body%height)//' m high')
            end associate
         end do
         call describe_actions(actions, lines)
         call lines%add('moments: weights hold with '//rounded(actions%gravity_share*(gravity*body%mass*(body%depth &
            & - actions%hinge) + sum(actions%carried%weight*(actions%carried%depth - actions%hinge))))//' N m'// &
            & trim(actions%per_metre())//', thrusts push out with '// &
            & rounded(sum(actions%thrusts%force*actions%thrusts%height))//' N m'//trim(actions%per_metre()))
      end associate

   contains

      !> A point of the axis
      function point(number) result(text)
         integer, intent(in) :: number
         !> Its coordinates, filled up with blanks
         character(len=64) :: text

         real(wp), allocatable :: x(:), z(:)

         x = input%list('axis_x')
         z = input%list('axis_z')
         text = rounded(x(number))//', '//rounded(z(number))
      end function point

   end subroutine describe

end module dondolo_wall_one_block_model
