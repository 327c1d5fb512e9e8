!> What --check prints of the building that a wall stands on.
module dondolo_plan_building
   use, intrinsic :: iso_fortran_env, only : output_unit
   use dondolo_building, only : building_type
   use dondolo_kinds, only : wp
   use dondolo_record, only : record_type
   use dondolo_text, only : rounded, to_text
   implicit none
   private

   public :: print_building, building_summary

contains

   !> Print the modes of a building, and the motions of its floor
   subroutine print_building(building, records)
      type(building_type), intent(in) :: building
      !> Motions of the ground
      type(record_type), intent(in) :: records(:)

      character(len=:), allocatable :: line
      integer :: parts(size(records)), i

      do i = 1, size(building%period)
         line = '   building: mode '//to_text(i)//', period '//rounded(building%period(i))//' s ('// &
            & rounded(1.0_wp/building%period(i))//' Hz), damping '//rounded(building%damping(i))//', participation '// &
            & rounded(building%participation(i))
         write (output_unit, '(a)') line
      end do
      parts = [(building%parts(records(i)%dt), i=1, size(records))]
      line = '   floor:    each step of a record in '//to_text(minval(parts))
      if (maxval(parts) > minval(parts)) line = line//' to '//to_text(maxval(parts))
      line = line//trim(merge(' part ', ' parts', maxval(parts) == 1))
      if (building%refine == 0) then
         line = line//' (refine = 0: as many as the shortest period needs)'
      else
         line = line//' (refine = '//to_text(building%refine)//')'
      end if
      write (output_unit, '(a)') line//'; after each record '//rounded(building%free_vibration())//' s of free vibration, '// &
         & 'the longest motion lasts '//rounded(maxval([(records(i)%duration(), i=1, size(records))]) &
         & + building%free_vibration())//' s'
   end subroutine print_building

   !> The building of a row of a population in a few words, filled up with blanks
   pure function building_summary(building) result(text)
      type(building_type), intent(in) :: building
      character(len=160) :: text

      integer :: i

      text = '  on a building: period'
      do i = 1, size(building%period)
         text = trim(text)//trim(merge(' ', ',', i == 1))//' '//rounded(building%period(i))
      end do
      text = trim(text)//' s, participation'
      do i = 1, size(building%period)
         text = trim(text)//trim(merge(' ', ',', i == 1))//' '//rounded(building%participation(i))
      end do
   end function building_summary

end module dondolo_plan_building
