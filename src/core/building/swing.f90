!> How a building swings under a record, before any wall feels it.
module dondolo_building_swing
   use dondolo_base_kinds, only : wp
   implicit none
   private

   public :: swing_type

   !> How a building swings under a record, whatever wall it moves
   type :: swing_type
      !> Step of the refined samples [s]
      real(wp) :: dt = 0.0_wp
      !> Acceleration of the ground at them, and vertically, where the record has such a component [m/s2]
      real(wp), allocatable :: ground(:), vertical(:)
      !> Of a unit of each mode, and of the diaphragm after the modes: acceleration relative to what moves it, and displacement
      !> over dt**2 [m/s2] (samples, modes)
      real(wp), allocatable :: acceleration(:, :), displacement(:, :)
      !> Greatest absolute displacement of each in the same unit
      real(wp), allocatable :: largest(:)
   end type swing_type

end module dondolo_building_swing
