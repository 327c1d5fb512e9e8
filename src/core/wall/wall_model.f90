!> The model of a wall: all that depends on which mechanism the user names, from the properties to the equation of motion.
!>
!> Each mechanism has one, in a file with its name and its properties. What follows from the model is the same for all of them:
!> engines know mechanism_type alone.
module dondolo_wall_model
   use dondolo_base_error, only : error_type, problems_type
   use dondolo_base_kinds, only : wp
   use dondolo_base_lines, only : lines_type
   use dondolo_base_settings, only : settings_type
   use dondolo_building_input, only : touches_base
   use dondolo_wall_mechanism, only : mechanism_type
   use dondolo_wall_restitution, only : impact_models_type
   implicit none
   private

   public :: wall_model_type

   !> Model of a wall
   type, abstract :: wall_model_type
      !> What the wall touches of a building that it stands on (dondolo_building_input)
      integer :: contact = touches_base
      !> Is nothing given but what every wall of its mechanism has?
      logical :: is_bare = .true.
      !> Are masses and forces those of a whole body, and not per metre of wall?
      logical :: is_whole = .false.
      !> Half diagonal of the wall, or of its lowest block [m]
      real(wp) :: radius = 0.0_wp
      !> Slenderness angle of the same [rad]
      real(wp) :: alpha = 0.0_wp
      !> Depth of the hinge at the base behind the face [m]
      real(wp) :: hinge_depth = 0.0_wp
      !> Largest distance of a table of its terms from what is computed with / largest value; 0: its terms are formulas
      real(wp) :: misfit = 0.0_wp
   contains
      !> Before defaults are filled in: set what follows from other properties
      procedure :: prepare
      !> After that: read the properties, and check what belongs together
      procedure(read_interface), deferred :: read
      !> Make the mechanism
      procedure(make_interface), deferred :: make_mechanism
      !> Describe the masonry and what acts on it
      procedure(describe_interface), deferred :: describe
   end type wall_model_type

   abstract interface

      !> Read the properties, and check what belongs together
      subroutine read_interface(self, input, gravity, problems)
         import :: problems_type, settings_type, wall_model_type, wp
         class(wall_model_type), intent(inout) :: self
         !> Properties, defaults filled in; out: those that others take the place of are replaced
         class(settings_type), intent(inout) :: input
         !> Gravity [m/s2]
         real(wp), intent(in) :: gravity
         !> In: values beyond their ranges, with which nothing can be computed; takes what is wrong
         type(problems_type), intent(inout) :: problems
      end subroutine read_interface

      !> Make the mechanism of a wall that was read without a problem
      subroutine make_interface(self, input, gravity, mechanism, impacts, error)
         import :: error_type, impact_models_type, mechanism_type, settings_type, wall_model_type, wp
         class(wall_model_type), intent(inout) :: self
         !> Properties
         class(settings_type), intent(in) :: input
         !> Gravity [m/s2]
         real(wp), intent(in) :: gravity
         !> The mechanism; its restitution is not known
         class(mechanism_type), allocatable, intent(out) :: mechanism
         !> Speed ratio of its impacts, by each model that it has
         type(impact_models_type), intent(out) :: impacts
         !> It does not stand at rest
         type(error_type), allocatable, intent(out) :: error
      end subroutine make_interface

      !> Describe the masonry and what acts on it
      subroutine describe_interface(self, input, gravity, lines)
         import :: lines_type, settings_type, wall_model_type, wp
         class(wall_model_type), intent(in) :: self
         !> Properties
         class(settings_type), intent(in) :: input
         !> Gravity [m/s2]
         real(wp), intent(in) :: gravity
         !> `subject: numbers with their units`
         type(lines_type), intent(inout) :: lines
      end subroutine describe_interface

   end interface

contains

   !> Set what follows from other properties: nothing
   subroutine prepare(self, input, problems)
      class(wall_model_type), intent(inout) :: self
      !> Properties as given
      class(settings_type), intent(inout) :: input
      !> Takes what does not agree
      type(problems_type), intent(inout) :: problems

      associate (of => self, these => input, those => problems)
      end associate
   end subroutine prepare

end module dondolo_wall_model
