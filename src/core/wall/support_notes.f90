!> Notes of a run on the motion of the bases and supports of its walls.
module dondolo_wall_support_notes
   use dondolo_base_kinds, only : wp
   use dondolo_base_text, only : counted
   use dondolo_base_warning, only : warning_type, warnings_type
   use dondolo_wall, only : wall_type
   use dondolo_wall_corner, only : corner_name
   implicit none
   private

   public :: supports_type

   !> Codes
   character(len=*), parameter :: records_at_base = 'records_at_base', buildings_move_walls = 'buildings_move_walls', &
      & building_moves_both = 'building_moves_both', building_moves_base = 'building_moves_base', &
      & one_floor_moves_both = 'one_floor_moves_both', ties_to_building = 'ties_to_building', ties_to_base = 'ties_to_base', &
      & corner_one_direction = 'corner_one_direction'

   !> Walls by what moves them
   type :: supports_type
      !> Walls, and those on a building
      integer :: walls = 0, on_buildings = 0
      !> Of the latter: those of two supports, and of these those whose supports move with one floor only because no other was given
      integer :: leaning = 0, of_one_floor = 0
      !> With ties: of two supports, and of one
      integer :: tied_to_building = 0, tied_to_base = 0
      !> Corners on buildings of several modes, all of which move them along their bisector
      integer :: corners = 0
   contains
      !> Look at a wall
      procedure :: look
      !> Make the notes
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
      if (wall%mechanism_name() == corner_name .and. size(wall%building%period) > 1) self%corners = self%corners + 1
      has_ties = wall%mechanism%ties > 0
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

   !> Make the notes
   subroutine make_notes(self, notes)
      class(supports_type), intent(in) :: self
      type(warnings_type), intent(out) :: notes

      if (self%on_buildings == 0) then
         call notes%add(warning_type(records_at_base), 'records are applied at the base of the wall; ground records '// &
            & 'underestimate the demand on parapets, gables, pinnacles, upper storeys and facades that lean on a building')
      else if (self%walls > 1) then
         call notes%add(warning_type(buildings_move_walls), 'records are ground motions; linear buildings move the walls on '// &
            & 'them, at their bases and at what they lean on')
      else if (self%leaning > 0) then
         call notes%add(warning_type(building_moves_both), 'records are ground motions; a linear building moves both supports '// &
            & 'of the wall')
      else
         call notes%add(warning_type(building_moves_base), 'records are ground motions; a linear building moves the base of '// &
            & 'the wall')
      end if
      if (self%of_one_floor > 0) call notes%add(counted_walls(one_floor_moves_both, self%of_one_floor), 'both ends of '// &
         & trim(walls(self%of_one_floor))//' move with one floor; give participation_top if the top moves differently')
      if (self%tied_to_building > 0) call notes%add(counted_walls(ties_to_building, self%tied_to_building), 'the ties of '// &
         & trim(walls(self%tied_to_building))//' are anchored to the building, and move with it')
      if (self%tied_to_base > 0) call notes%add(counted_walls(ties_to_base, self%tied_to_base), 'the ties of '// &
         & trim(walls(self%tied_to_base))//' are anchored to what the base of the wall stands on')
      if (self%corners > 0) call notes%add(counted_walls(corner_one_direction, self%corners), 'all modes of the building move '// &
         & trim(walls(self%corners))//' along the bisector of the corner; modes of its two directions would move one '// &
         & 'component each')

   contains

      !> A note that is about some of the walls
      type(warning_type) function counted_walls(code, number) result(note)
         !> Its code
         character(len=*), intent(in) :: code
         !> How many
         integer, intent(in) :: number

         note = warning_type(code)
         call note%with('walls', number)
         call note%with('of_walls', self%walls)
      end function counted_walls

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
