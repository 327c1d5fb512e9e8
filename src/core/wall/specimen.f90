!> What an analysis needs of a wall: where it stands, and its equation of motion. How both follow from properties that a user
!> gives is the matter of dondolo_wall, which studies need not know.
module dondolo_wall_specimen
   use dondolo_base_kinds, only : wp
   use dondolo_building, only : building_type
   use dondolo_wall_gravity, only : standard_gravity
   use dondolo_wall_mechanism, only : mechanism_type
   implicit none
   private

   public :: specimen_type

   !> A wall as it is analysed
   type :: specimen_type
      !> Gravity [m/s2]
      real(wp) :: gravity = standard_gravity
      !> What it stands on; not allocated: the ground
      type(building_type), allocatable :: building
      !> What the motion integrates
      class(mechanism_type), allocatable :: mechanism
   end type specimen_type

end module dondolo_wall_specimen
