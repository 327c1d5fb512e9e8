!> What --check prints of the building that a wall stands on.
module dondolo_plan_building
   use, intrinsic :: iso_fortran_env, only : output_unit
   use dondolo_base_kinds, only : wp
   use dondolo_base_text, only : rounded, to_text
   use dondolo_building, only : building_type
   use dondolo_record, only : record_type
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
      real(wp), allocatable :: felt(:)
      integer :: parts(size(records)), i

      felt = building%felt()
      do i = 1, size(building%period)
         line = '   building: mode '//to_text(i)//', period '//rounded(building%period(i))//' s ('// &
            & rounded(1.0_wp/building%period(i))//' Hz), damping '//rounded(building%damping(i))//', participation '// &
            & rounded(building%participation(i))
         if (building%share > 0.0_wp) line = line//' at the base, '//rounded(building%participation_top(i))// &
            & ' at the top, of which the wall feels '//rounded(felt(i))
         write (output_unit, '(a)') line
      end do
      if (building%share > 0.0_wp) call print_supports(building)
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

   !> Print what the wall feels of its supports
   subroutine print_supports(building)
      type(building_type), intent(in) :: building

      associate (diaphragm => building%diaphragm)
         if (diaphragm%period > 0.0_wp) write (output_unit, '(a)') '   diaphragm: period '//rounded(diaphragm%period)// &
            & ' s, damping '//rounded(diaphragm%damping)//', participation '//rounded(diaphragm%participation)// &
            & ', at the top of the wall'
      end associate
      write (output_unit, '(a)') '   supports: '//rounded(building%height)//' m apart; the wall feels '// &
         & rounded(building%share)//' of the acceleration of its top relative to its base, less '//rounded(building%tilt)// &
         & ' 1/s2 times the relative displacement'
   end subroutine print_supports

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
