!> Warnings of chains of rigid bodies: a motion inwards that is not known, bodies that move into each other, and a restitution that
!> no impact leaves.
module dondolo_case_chain_warnings
   use dondolo_base_kinds, only : wp
   use dondolo_base_text, only : rounded, to_text
   use dondolo_base_warning, only : warning_type, warnings_type
   use dondolo_wall, only : wall_type
   use dondolo_wall_chain_model, only : chain_model_type
   implicit none
   private

   public :: chain_warnings_type

   !> Codes
   character(len=*), parameter :: mirror_image = 'mirror_image', bodies_meet = 'bodies_meet', &
      & restitution_above_bound = 'restitution_above_bound'

   !> Depth to which bodies may move into each other beside a crushed hinge [m]
   real(wp), parameter :: shallow = 5.0e-3_wp

   !> Chains looked at, and what to warn of: of each the first that has it, and how many have
   type :: chain_warnings_type
      private
      integer :: mirrored = 0, meeting = 0, bouncing = 0
      character(len=:), allocatable :: mirrored_name, meeting_name, bouncing_name
      !> Of those that meet: bodies, depth [m] and rotation [rad]
      integer :: bodies(2) = 0
      real(wp) :: depth = 0.0_wp, rotation = 0.0_wp
      !> Of those that bounce: restitution and its bound
      real(wp) :: restitution = 0.0_wp, bound = 0.0_wp
   contains
      !> Look at a wall
      procedure :: look
      !> Warn, if there is reason to
      procedure :: warn
   end type chain_warnings_type

contains

   !> Look at a wall
   subroutine look(self, wall)
      class(chain_warnings_type), intent(inout) :: self
      type(wall_type), intent(in) :: wall

      select type (model => wall%model)
      type is (chain_model_type)
         if (model%is_mirrored .and. .not. model%is_image) then
            self%mirrored = self%mirrored + 1
            if (self%mirrored == 1) self%mirrored_name = wall%name()
         end if
         if (model%overlap%depth > shallow) then
            self%meeting = self%meeting + 1
            if (self%meeting == 1) then
               self%meeting_name = wall%name()
               self%bodies = [model%overlap%body, model%overlap%other]
               self%depth = model%overlap%depth
               self%rotation = model%overlap%rotation
            end if
         end if
         if (wall%mechanism%restitution > model%bound) then
            self%bouncing = self%bouncing + 1
            if (self%bouncing == 1) then
               self%bouncing_name = wall%name()
               self%restitution = wall%mechanism%restitution
               self%bound = model%bound
            end if
         end if
      end select
   end subroutine look

   !> Warn, if there is reason to
   subroutine warn(self, walls, warnings)
      class(chain_warnings_type), intent(in) :: self
      !> Walls looked at
      integer, intent(in) :: walls
      !> Warnings to add to
      type(warnings_type), intent(inout) :: warnings

      type(warning_type) :: warning

      if (self%mirrored > 0) then
         warning = warning_type(mirror_image)
         call add(warning, self%mirrored_name, self%mirrored, 'inwards it is taken to move as its mirror image, but its '// &
            & 'tables do not show that the masonry and its loads are one: add what stands still as body 0, or give '// &
            & 'two walls of one facade')
      end if
      if (self%meeting > 0) then
         warning = warning_type(bodies_meet)
         call warning%with('body', self%bodies(1))
         call warning%with('other', self%bodies(2))
         call warning%with('depth_mm', 1.0e3_wp*self%depth)
         call warning%with('rotation_rad', self%rotation)
         call add(warning, self%meeting_name, self%meeting, 'bodies '//to_text(self%bodies(1))//' and '// &
            & to_text(self%bodies(2))//' move into each other by '//rounded(1.0e3_wp*self%depth)//' mm at '// &
            & rounded(self%rotation)//' rad: their joint may open elsewhere')
      end if
      if (self%bouncing > 0) then
         warning = warning_type(restitution_above_bound)
         call warning%with('restitution', self%restitution)
         call warning%with('limit', self%bound)
         call add(warning, self%bouncing_name, self%bouncing, 'a restitution of '//rounded(self%restitution)//' is more than '// &
            & rounded(self%bound)//', which an impact on all joints leaves with unlimited friction')
      end if

   contains

      !> Add a warning of the first of some walls, and how many there are
      subroutine add(warning, name, number, text)
         type(warning_type), intent(inout) :: warning
         character(len=*), intent(in) :: name, text
         integer, intent(in) :: number

         character(len=:), allocatable :: sentence

         call warning%about('wall', name)
         call warning%with('walls_beyond', number)
         call warning%with('walls', walls)
         sentence = 'wall '''//name//''': '//text
         if (walls > 1) sentence = sentence//' ('//to_text(number)//' of '//to_text(walls)//' in all)'
         call warnings%add(warning, sentence)
      end subroutine add

   end subroutine warn

end module dondolo_case_chain_warnings
