!> A wall as the kinematic analysis of Circolare 7/2019, C8.7.1.2.1, sees it: multiplier of the horizontal forces, mass that
!> takes part, and curve of capacity.
!>
!> P_k are weights carried by the wall, its own among them, Q_k those of masses that it only pushes. All of both stand in the
!> denominator, whatever inertia the time histories give a load. X and Y are the horizontal and vertical levers of
!> dondolo_wall_loaded_block, H thrusts; springs, and thrusts that decay, enter through the restoring moment:
!>
!>     alpha(q) = [sum P Y - sum H X + sum T X ...]/sum (P + Q) X      alpha_0 = alpha(0)                 C8.7.1.1
!>     M* = [sum (P + Q) z]^2/[g sum (P + Q) z^2]                 e* = g M*/sum (P + Q)                   C8.7.1.5
!>     a = alpha g/(e* FC)                                                                                C8.7.1.3
!>     d = d_C sum (P + Q) z^2/[z_C sum (P + Q) z]                d_C = z_C sin q                         C8.7.1.4
!>
!> About an axis that rises at beta only the share cos beta of P acts against the mechanism, and levers are normal to the axis
!> (dondolo_wall_axis).
!>
!> Ties hold with their largest force up to the rotation at which they break, and friction of transverse walls with what is left
!> of it; alpha vanishes at the capacity of the wall without them, since they do not act up to collapse.
!>
!> The masonry of a wall that turns about its base is one block: a point at its centroid C, as the Circolare has it.
!>
!> A strip between two floors bends: two blocks, with N on top, turn about three hinges (docs/theory.md, section 2). Its lower
!> block turns by q, and of the whole strip C moves by R_1 [sin alpha_1 - sin(alpha_1 - q)] at most:
!>
!>     alpha(q) = (G - Q)/(g L)     M* = M_1 + M_2     e* = 1     d = R_1 [sin alpha_1 - sin(alpha_1 - q)]
!>
!> The floor holds N sideways, so that its horizontal force is none of the strip's: it is in G - Q alone. Of loads and masses
!> between base and top those that move with the strip, D, are in all sums by their levers X:
!>
!>     alpha(q) = (G - Q)/sum (P + D) X                    M* = [sum (P + D) X]^2/[g sum (P + D) X^2]
!>     d = d_C sum (P + D) X^2/[X_C sum (P + D) X]
!>
!> with X at rest but in alpha(q), and P the weights of the blocks.
module dondolo_check_kinematic
   use dondolo_base_error, only : error_type, not_at_rest, out_of_range, raise_input
   use dondolo_base_kinds, only : wp
   use dondolo_building_input, only : spans
   use dondolo_check_calculation, only : is_given, item_type, list_items, wedge_word, wing_word
   use dondolo_check_free_element, only : free_element_type, new_free_element
   use dondolo_check_table_check, only : new_table_check, table_check_type
   use dondolo_wall, only : wall_type
   use dondolo_wall_anchor, only : anchor_type
   use dondolo_wall_body, only : wall_body_type
   use dondolo_wall_chain_model, only : chain_model_type
   use dondolo_wall_elastic_joint, only : elastic_joint_type
   use dondolo_wall_mechanism, only : mechanism_type
   use dondolo_wall_one_block_model, only : one_block_model_type
   use dondolo_wall_strip_statics, only : floor_forces_type
   use dondolo_wall_tabulated, only : tabulated_type
   use dondolo_wall_tabulated_model, only : tabulated_model_type
   use dondolo_wall_tie_statics, only : set_plastic_restraints
   use dondolo_wall_two_block, only : two_block_type
   use dondolo_wall_two_block_model, only : two_block_model_type
   implicit none
   private

   public :: kinematic_type, new_kinematic

   !> The kinematic chain of a wall
   type :: kinematic_type
      !> Multiplier that starts the mechanism alpha_0
      real(wp) :: multiplier = 0.0_wp
      !> Are masses and forces those of a whole body, and not per metre of wall?
      logical :: is_whole = .false.
      !> Mass that takes part M* [kg/m], of a whole body [kg]
      real(wp) :: mass = 0.0_wp
      !> The same / the whole mass, e*
      real(wp) :: mass_ratio = 0.0_wp
      !> Displacement at which the multiplier vanishes d_0 [m]
      real(wp) :: end_displacement = 0.0_wp
      !> How far both halves of a gable would overlap there [m]; 0: it is no half
      real(wp) :: overlap = 0.0_wp
      !> Displacement at which a load loses its seat [m]; huge: none does
      real(wp) :: unseating = huge(1.0_wp)
      !> Displacement at which ties break that carry more than half of the greatest multiplier [m]; huge: none do
      real(wp) :: tie_fracture = huge(1.0_wp)
      !> Gravity [m/s2]
      real(wp) :: gravity = 0.0_wp
      !> Height of the hinge / height of a strip; that at which the multiplier is least, and that multiplier; -1: no strip
      real(wp) :: hinge = -1.0_wp, weakest_hinge = -1.0_wp, weakest_multiplier = -1.0_wp
      !> Hinges among which the weakest was looked for, and forces at the hinges when the mechanism starts
      real(wp) :: hinge_range(2) = -1.0_wp
      type(floor_forces_type) :: floors
      !> Level above the ground whose spectrum is the demand [m]; 0: the ground, or a level that is not known
      real(wp) :: level = 0.0_wp
      !> Is it that of a building which is not given, so that there is no spectrum?
      logical :: is_without_spectrum = .false.
      !> Height of the top of the wall above the ground, where it is [m]
      real(wp) :: top = 0.0_wp
      !> Period of a flexible diaphragm that holds the top, which the spectrum of the code does not know [s]; 0: none
      real(wp) :: diaphragm_period = 0.0_wp
      !> Of each mode of the building that the wall stands on: period [s], damping ratio, and participation times shape at the
      !> level of the wall, for a strip the mean of its floors; of size 0 on the ground
      real(wp), allocatable :: period(:), damping(:), participation(:)
      !> Longest period of the building, which may be of a mode that does not move the level [s]
      real(wp) :: first_period = 0.0_wp
      !> Sums over the items of the calculation: moments against the mechanism and with it, weight times lever, and lever squared
      real(wp) :: stabilising = 0.0_wp, overturning = 0.0_wp, first = 0.0_wp, second = 0.0_wp
      !> Of them those of wedges of transverse walls, or of the wings of a corner: the moment that they resist with, and weight
      !> times lever
      real(wp) :: wedge_moment = 0.0_wp, wedge_first = 0.0_wp
      !> Forces on the base of a wall that turns about it: weights that it carries, thrusts, and ties and friction [N/m]
      real(wp) :: carried = 0.0_wp, thrust = 0.0_wp, restraint = 0.0_wp
      !> Anchors of the ties
      type(anchor_type), allocatable :: anchors(:)
      !> The wall as a free element
      type(free_element_type) :: element
      !> Joints that bend before they open
      type(elastic_joint_type) :: joint
      !> What gives the moments
      class(mechanism_type), allocatable, private :: mechanism
      !> Does the wall turn about an inclined axis?
      logical, private :: is_inclined = .false.
      !> Radius of the edge a [m]
      real(wp), private :: edge = 0.0_wp
      !> Sums of P + Q, and of their products with heights and depths from the hinge
      real(wp) :: weight = 0.0_wp
      real(wp), private :: weight_f = 0.0_wp, weight_e = 0.0_wp
      !> Height of the centroid above the hinge, and its depth behind it if that enters d_C [m]; d/d_C
      real(wp), private :: centroid = 0.0_wp, centroid_depth = 0.0_wp, travel = 0.0_wp
      !> Of what moves with a strip between its base and its top: the weight, as of the points of the mechanism
      real(wp), allocatable, private :: moving(:)
      !> What a tabulated wall has over the rotation; not allocated: no such wall
      type(table_check_type), allocatable, private :: table
   contains
      !> Displacement d at a rotation
      procedure :: displacement
      !> Rotation at a displacement
      procedure :: rotation
      !> Spectral acceleration of capacity a(d)
      procedure :: capacity
      !> Rotation at which the multiplier vanishes
      procedure :: end_rotation
      procedure, private :: multiplier_at
   end type kinematic_type

contains

   !> The kinematic chain of a wall
   subroutine new_kinematic(kinematic, wall, error)
      type(kinematic_type), intent(out) :: kinematic
      type(wall_type), intent(in) :: wall
      !> A wall that the formulas are not for
      type(error_type), allocatable, intent(out) :: error

      real(wp), parameter :: right_angle = acos(0.0_wp)

      if (.not. wall%mechanism%capacity < right_angle) then
         call raise_input(error, 'spring: holds the wall up to a rotation of 90 degrees; the kinematic check ends before', &
            & not_at_rest, 'spring')
         return
      end if
      kinematic%mechanism = wall%mechanism
      kinematic%joint = wall%mechanism%joint
      kinematic%gravity = wall%gravity
      kinematic%is_whole = wall%model%is_whole
      call take_building(kinematic, wall, error)
      if (allocated(error)) return
      select type (model => wall%model)
      type is (one_block_model_type)
         call take_block(kinematic, model%body)
         ! Each half goes beyond the plane of the axis by (t - u) sin beta for a unit of rotation, at its inner face.
         associate (actions => model%body%actions, t => model%body%sections(1)%thickness)
            if (wall%mechanism%is_static) kinematic%overlap = 2.0_wp*(t - actions%hinge)*sqrt(1.0_wp - actions%gravity_share**2) &
               & *wall%mechanism%capacity
         end associate
      type is (two_block_model_type)
         select type (mechanism => wall%mechanism)
         type is (two_block_type)
            call take_two_blocks(kinematic, mechanism, model, wall%input%number('hinge'))
         end select
      class is (tabulated_model_type)
         call take_table(kinematic, model, error)
      end select
      if (allocated(error)) return
      kinematic%multiplier = kinematic%multiplier_at(0.0_wp)
      kinematic%end_displacement = kinematic%displacement(wall%mechanism%capacity)
      if (wall%mechanism%unseating < right_angle) kinematic%unseating = kinematic%displacement(wall%mechanism%unseating)
      call compute_tie_fracture(kinematic)
      call take_sums(kinematic, wall)
      call new_free_element(kinematic%element, wall)
   end subroutine new_kinematic

   !> Take the sums of the items
   subroutine take_sums(kinematic, wall)
      type(kinematic_type), intent(inout) :: kinematic
      type(wall_type), intent(in) :: wall

      type(item_type), allocatable :: items(:)

      call list_items(wall, items)
      kinematic%stabilising = sum(items%stabilising, mask=is_given(items%stabilising))
      kinematic%overturning = sum(items%overturning, mask=is_given(items%overturning))
      kinematic%first = sum(items%first, mask=is_given(items%first))
      kinematic%second = sum(items%second, mask=is_given(items%second))
      associate (of_wedges => index(items%name, wedge_word//' ') == 1 .or. index(items%name, wing_word//' ') == 1)
         kinematic%wedge_moment = sum(items%stabilising, mask=of_wedges)
         kinematic%wedge_first = sum(items%first, mask=of_wedges)
      end associate
      associate (lifts => is_given(items%arm), holds => is_given(items%stabilising))
         ! The forces at the hinges of a chain do not follow from the sums, nor do those along an inclined axis.
         if (.not. (allocated(kinematic%table) .or. kinematic%is_inclined)) kinematic%carried = sum(items%force, &
            & mask=lifts .and. holds)
         kinematic%thrust = sum(items%force, mask=is_given(items%overturning))
         kinematic%restraint = sum(items%force, mask=holds .and. .not. lifts)
      end associate
   end subroutine take_sums

   !> Take the modes of the building that a wall stands on; at the base of a building the demand is that of the ground
   subroutine take_building(kinematic, wall, error)
      type(kinematic_type), intent(inout) :: kinematic
      type(wall_type), intent(in) :: wall
      !> A mode that the spectrum of a floor is not for
      type(error_type), allocatable, intent(out) :: error

      real(wp), allocatable :: participation(:)

      allocate (kinematic%period(0), kinematic%damping(0), kinematic%participation(0), kinematic%anchors(0))
      kinematic%level = wall%input%number('base_level')
      kinematic%is_without_spectrum = kinematic%level > 0.0_wp
      kinematic%top = kinematic%level + wall%input%number('height')
      if (.not. allocated(wall%building)) return
      associate (building => wall%building)
         participation = building%participation
         kinematic%first_period = maxval(building%period)
         kinematic%level = building%level_top - building%height
         ! Both floors move a strip: the code has the spectrum of one level, that between them
         select type (mechanism => wall%mechanism)
         type is (two_block_type)
            call take_between()
         type is (tabulated_type)
            if (wall%model%contact == spans) call take_between()
         end select
         kinematic%level = max(0.0_wp, kinematic%level)
         ! Modes that do not move the level are left out.
         kinematic%period = pack(building%period, abs(participation) > 0.0_wp)
         kinematic%damping = pack(building%damping, abs(participation) > 0.0_wp)
         kinematic%participation = pack(participation, abs(participation) > 0.0_wp)
      end associate
      if (.not. all(kinematic%damping > 0.0_wp)) call raise_input(error, &
         & 'damping = 0: must be positive for the spectrum of a floor of the code', out_of_range, 'damping')

   contains

      !> Take the level between two floors
      subroutine take_between()
         associate (building => wall%building)
            if (building%height > 0.0_wp) participation = 0.5_wp*(participation + building%participation_top)
            kinematic%level = building%level_top - 0.5_wp*building%height
            if (building%has_diaphragm()) kinematic%diaphragm_period = building%diaphragm%period
         end associate
      end subroutine take_between

   end subroutine take_building

   !> Take weights and levers of a wall that turns about its base
   pure subroutine take_block(kinematic, body)
      type(kinematic_type), intent(inout) :: kinematic
      type(wall_body_type), intent(in) :: body

      real(wp), allocatable :: weight(:), height(:), depth(:)
      real(wp) :: first, second

      kinematic%edge = body%actions%edge
      kinematic%is_inclined = body%actions%gravity_share < 1.0_wp
      if (allocated(body%anchors)) kinematic%anchors = body%anchors
      associate (carried => body%actions%carried, masonry => body%body)
         weight = [kinematic%gravity*masonry%mass, carried%weight + &
            & merge(0.0_wp, kinematic%gravity*carried%pushed, carried%weight > 0.0_wp)]
         height = [masonry%height, carried%height]
         depth = [masonry%depth, carried%depth] - body%actions%hinge
         kinematic%centroid = masonry%height - kinematic%edge
      end associate
      kinematic%weight = sum(weight)
      kinematic%weight_f = sum(weight*(height - kinematic%edge))
      kinematic%weight_e = sum(weight*depth)
      first = sum(weight*height)
      second = sum(weight*height**2)
      kinematic%mass = first**2/second/kinematic%gravity
      kinematic%mass_ratio = first**2/(kinematic%weight*second)
      kinematic%travel = second/(height(1)*first)
   end subroutine take_block

   !> Take weights and levers of a tabulated wall
   subroutine take_table(kinematic, model, error)
      type(kinematic_type), intent(inout) :: kinematic
      class(tabulated_model_type), intent(in) :: model
      !> The table does not have them
      type(error_type), allocatable, intent(out) :: error

      real(wp) :: first, second

      allocate (kinematic%table)
      select type (mechanism => kinematic%mechanism)
      type is (tabulated_type)
         call new_table_check(kinematic%table, model, mechanism, error)
      end select
      if (allocated(error)) return
      first = sum(model%weight*model%displacement)
      second = sum(model%weight*model%displacement**2)
      kinematic%weight = sum(model%weight)
      kinematic%mass = first**2/second/kinematic%gravity
      kinematic%mass_ratio = first**2/(kinematic%weight*second)
      select type (model)
      type is (chain_model_type)
         kinematic%anchors = model%anchors
      end select
   end subroutine take_table

   !> Take weights and levers of a strip that bends
   subroutine take_two_blocks(kinematic, mechanism, model, hinge)
      type(kinematic_type), intent(inout) :: kinematic
      type(two_block_type), intent(in) :: mechanism
      type(two_block_model_type), intent(in) :: model
      !> Height of its hinge / height of the strip
      real(wp), intent(in) :: hinge

      real(wp), allocatable :: lever(:)
      real(wp) :: first, second

      if (allocated(model%body%anchors)) kinematic%anchors = model%body%anchors
      associate (lower => mechanism%lower, upper => mechanism%upper, w => mechanism%lower%b)
         kinematic%mass = lower%mass + upper%mass
         kinematic%mass_ratio = 1.0_wp
         kinematic%travel = 1.0_wp
         kinematic%centroid = lower%radius*cos(lower%alpha)
         kinematic%centroid_depth = w
         kinematic%weight = kinematic%gravity*kinematic%mass
         kinematic%weight_f = kinematic%weight*kinematic%centroid
         kinematic%weight_e = kinematic%weight*w
      end associate
      kinematic%hinge = hinge
      kinematic%hinge_range = model%hinge_range
      kinematic%floors = model%strip%floor_forces(hinge)
      call model%strip%find_weakest(model%hinge_range, kinematic%weakest_hinge, kinematic%weakest_multiplier)
      if (.not. allocated(mechanism%points)) return
      kinematic%moving = model%strip%points(:size(mechanism%points))%moving
      if (.not. any(kinematic%moving > 0.0_wp)) return
      associate (point => mechanism%points, c => kinematic%centroid)
         lever = mechanism%lever_of(0.0_wp, point%e, point%f, point%is_upper)
         first = kinematic%weight*c + sum(kinematic%moving*lever)
         second = kinematic%weight*c**2 + sum(kinematic%moving*lever**2)
         kinematic%weight = kinematic%weight + sum(kinematic%moving)
         kinematic%mass = first**2/second/kinematic%gravity
         kinematic%mass_ratio = first**2/(kinematic%weight*second)
         kinematic%travel = second/(c*first)
      end associate
   end subroutine take_two_blocks

   !> The displacement at which ties break that carry more than half of the greatest multiplier
   subroutine compute_tie_fracture(kinematic)
      type(kinematic_type), intent(inout) :: kinematic

      !> Parts of the rotation up to the end at which the greatest multiplier is looked for
      integer, parameter :: parts = 64
      !> Loss that matters / greatest multiplier; and how little beyond its fracture a tie is seen to be broken
      real(wp), parameter :: half = 0.5_wp, beyond = 1.0e-8_wp
      real(wp) :: greatest, loss
      integer :: i

      associate (mechanism => kinematic%mechanism, last => kinematic%end_rotation())
         if (mechanism%ties == 0) return
         greatest = maxval([(kinematic%multiplier_at(last*real(i, wp)/real(parts, wp)), i=0, parts)])
         do i = 1, mechanism%ties
            associate (q => mechanism%restraints(i)%fracture)
               if (.not. q < last) cycle
               greatest = max(greatest, kinematic%multiplier_at(q))
            end associate
         end do
         do i = 1, mechanism%ties
            associate (q => mechanism%restraints(i)%fracture)
               if (.not. q < last) cycle
               loss = kinematic%multiplier_at(q) - kinematic%multiplier_at(q*(1.0_wp + beyond))
               if (loss > half*greatest) kinematic%tie_fracture = min(kinematic%tie_fracture, kinematic%displacement(q))
            end associate
         end do
      end associate
   end subroutine compute_tie_fracture

   !> Multiplier alpha at a rotation
   real(wp) function multiplier_at(self, q) result(multiplier)
      class(kinematic_type), intent(in) :: self
      !> Rotation [rad]
      real(wp), intent(in) :: q

      class(mechanism_type), allocatable :: restrained
      real(wp) :: moment, weight

      if (allocated(self%mechanism%restraints)) then
         allocate (restrained, source=self%mechanism)
         call set_plastic_restraints(restrained, q)
         moment = restrained%moment(q)
      else
         moment = self%mechanism%moment(q)
      end if
      weight = self%edge*self%weight + cos(q)*self%weight_f + sin(q)*self%weight_e
      if (allocated(self%table)) weight = self%table%weighted_lever(q)
      if (allocated(self%moving)) then
         select type (mechanism => self%mechanism)
         type is (two_block_type)
            associate (point => mechanism%points)
               weight = weight + sum(self%moving*mechanism%lever_of(q, point%e, point%f, point%is_upper))
            end associate
         end select
      end if
      multiplier = moment/weight
   end function multiplier_at

   !> Rotation at which the multiplier vanishes [rad]
   pure real(wp) function end_rotation(self)
      class(kinematic_type), intent(in) :: self

      end_rotation = self%mechanism%capacity
   end function end_rotation

   !> Displacement d of the equivalent oscillator at a rotation [m]
   elemental real(wp) function displacement(self, q)
      class(kinematic_type), intent(in) :: self
      !> Rotation, less than a right angle [rad]
      real(wp), intent(in) :: q

      if (allocated(self%table)) then
         displacement = self%table%displacement(q)
         return
      end if
      displacement = self%travel*(self%edge*q + self%centroid*sin(q) + 2.0_wp*self%centroid_depth*sin(0.5_wp*q)**2)
   end function displacement

   !> Rotation at a displacement, by Newton's method: the displacement grows with the rotation, and its slope falls throughout or
   !> rises throughout, so that steps stay on one side
   pure real(wp) function rotation(self, d) result(q)
      class(kinematic_type), intent(in) :: self
      !> Displacement, 0 to d_0 [m]
      real(wp), intent(in) :: d

      integer, parameter :: enough = 50
      real(wp) :: step
      integer :: i

      if (allocated(self%table)) then
         q = self%table%rotation(d)
         return
      end if
      q = 0.0_wp
      do i = 1, enough
         step = (d - self%displacement(q))/(self%travel*(self%edge + self%centroid*cos(q) + self%centroid_depth*sin(q)))
         q = q + step
         if (abs(step) <= epsilon(q)*abs(q)) exit
      end do
   end function rotation

   !> Spectral acceleration of capacity a = alpha g/(e* FC) at a displacement [m/s2]
   real(wp) function capacity(self, d, knowledge_factor) result(a)
      class(kinematic_type), intent(in) :: self
      !> Displacement [m]
      real(wp), intent(in) :: d
      !> Confidence factor FC
      real(wp), intent(in) :: knowledge_factor

      a = self%multiplier_at(self%rotation(d))*self%gravity/(self%mass_ratio*knowledge_factor)
   end function capacity

end module dondolo_check_kinematic
