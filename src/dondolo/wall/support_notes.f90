!> Notes of a run on the motion of the bases and supports of its walls.
module dondolo_wall_support_notes
   use dondolo_base_kinds, only : wp
   use dondolo_base_lines, only : lines_type
   use dondolo_base_text, only : counted
   use dondolo_wall, only : wall_type
   implicit none
   private

   public :: supports_type

   !> Walls by what moves them
   type :: supports_type
      !> Walls, and those on a building
      integer :: walls = 0, on_buildings = 0
      !> Of the latter: those of two supports, and of these those whose supports move with one floor only because no other was given
      integer :: leaning = 0, of_one_floor = 0
      !> With ties: of two supports, and of one
      integer :: tied_to_building = 0, tied_to_base = 0
   contains
      !> Look at a wall
      procedure :: look
      !> Make the sentences
      procedure :: make_notes
   end type supports_type

contains

   !> Look at a wall
   subroutine look(self, wall)
      class(supports_type), intent(inout) :: self
      type(wall_type), intent(in) :: wall

      logical :: has_ties

      self%walls = self%walls + 1
      if (.not. allocated(wall%building)) return
      self%on_buildings = self%on_buildings + 1
      has_ties = size(wall%input%list('tie_height')) > 0
      if (wall%building%share > 0.0_wp) then
         self%leaning = self%leaning + 1
         if (wall%input%has('participation') .and. .not. wall%input%has('participation_top')) then
            self%of_one_floor = self%of_one_floor + 1
         end if
         if (has_ties) self%tied_to_building = self%tied_to_building + 1
      else
         if (has_ties) self%tied_to_base = self%tied_to_base + 1
      end if
   end subroutine look

   !> Make the sentences
   subroutine make_notes(self, notes)
      class(supports_type), intent(in) :: self
      type(lines_type), intent(out) :: notes

      if (self%on_buildings == 0) then
         call notes%add('records are applied at the base of the wall; ground records underestimate the demand on parapets, '// &
            & 'gables, pinnacles, upper storeys and facades that lean on a building')
      else if (self%walls > 1) then
         call notes%add('records are ground motions; linear buildings move the walls on them, at their bases and at what '// &
            & 'they lean on')
      else if (self%leaning > 0) then
         call notes%add('records are ground motions; a linear building moves both supports of the wall')
      else
         call notes%add('records are ground motions; a linear building moves the base of the wall')
      end if
      if (self%of_one_floor > 0) call notes%add('both ends of '//trim(walls(self%of_one_floor))//' move with one floor; give '// &
         & 'participation_top if the top moves differently')
      if (self%tied_to_building > 0) call notes%add('the ties of '//trim(walls(self%tied_to_building))//' are anchored to the '// &
         & 'building, and move with it')
      if (self%tied_to_base > 0) call notes%add('the ties of '//trim(walls(self%tied_to_base))//' are anchored to what the '// &
         & 'base of the wall stands on')

   contains

      !> How many of the walls
      pure function walls(number) result(text)
         integer, intent(in) :: number
         !> In words, filled up with blanks
         character(len=24) :: text

         text = 'the wall'
         if (self%walls > 1) text = counted(number, 'wall')
      end function walls

   end subroutine make_notes

end module dondolo_wall_support_notes
