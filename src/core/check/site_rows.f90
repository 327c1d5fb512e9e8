!> The place of a site in the sheet of a check, and how a_g, F_0 and T_C* follow from it.
module dondolo_check_site_rows
   use dondolo_base_kinds, only : wp
   use dondolo_base_text, only : to_text
   use dondolo_check_hazard_grid, only : grid_years
   use dondolo_check_input, only : check_input_type
   use dondolo_check_sheet, only : sheet_type, shown, working_type
   use dondolo_check_site_hazard, only : return_period, site_hazard_type
   implicit none
   private

   public :: put_place, put_hazard, put_years

   !> Where the rules of the grid are, and its values
   character(len=*), parameter :: rules = 'D.M. 14-1-2008, annex A', grid = 'D.M. 14-1-2008, annex B'

contains

   !> Put the coordinates, the nodes of the grid round them, and what gives the reference period
   pure subroutine put_place(sheet, place)
      type(sheet_type), intent(inout) :: sheet
      type(site_hazard_type), intent(in) :: place

      real(wp) :: distances(4)
      integer :: i

      call sheet%add('site', '', 'latitude', place%latitude)
      call sheet%add('site', '', 'longitude', place%longitude)
      call sheet%add('site', '', 'latitude_ed50', place%latitude_ed50)
      call sheet%add('site', '', 'longitude_ed50', place%longitude_ed50)
      distances = place%mesh%distances(place%longitude_ed50, place%latitude_ed50)
      do i = 1, size(distances)
         call sheet%add('site', '', 'latitude_ed50', place%mesh%latitude(i), grid, node(i))
         call sheet%add('site', '', 'longitude_ed50', place%mesh%longitude(i), grid, node(i))
         call sheet%add('site', '', 'distance', distances(i), item=node(i))
      end do
      call sheet%add('site', '', 'nominal_life', place%nominal_life)
      call sheet%add('site', '', 'use_coefficient', place%use_coefficient, 'NTC 2.4.II')

   contains

      !> A node as an item
      pure function node(i) result(item)
         integer, intent(in) :: i
         character(len=16) :: item

         item = 'node '//to_text(place%mesh%ids(i))
      end function node

   end subroutine put_place

   !> Put a_g, F_0 and T_C* of a limit state
   pure subroutine put_hazard(sheet, input, state, name, values)
      type(sheet_type), intent(inout) :: sheet
      type(check_input_type), intent(in) :: input
      !> Number of the limit state, and its name; empty: all
      integer, intent(in) :: state
      character(len=*), intent(in) :: name
      !> a_g [g], F_0 and T_C* [s]
      real(wp), intent(in) :: values(3)

      character(len=*), parameter :: quantities(3) = [character(len=7) :: 'ag', 'f0', 'tc_star']
      type(working_type) :: working
      integer :: i, k

      do k = 1, size(quantities)
         if (.not. allocated(input%place)) then
            call sheet%add('site', name, trim(quantities(k)), values(k))
            cycle
         end if
         i = input%place%bracket(state)
         associate (one => input%place%tabulated(k, i), two => input%place%tabulated(k, i + 1))
            working = working_type('p_1 (p_2/p_1)^[ln(T_R/T_1)/ln(T_2/T_1)]', trim(shown(one))//' * ('//trim(shown(two))// &
               & '/'//trim(shown(one))//')^[ln('//trim(shown(input%return_period(state)))//'/'//trim(shown(grid_years(i)))// &
               & ')/ln('//trim(shown(grid_years(i + 1)))//'/'//trim(shown(grid_years(i)))//')]')
         end associate
         call sheet%add('site', name, trim(quantities(k)), values(k), rules, working=working)
      end do
   end subroutine put_hazard

   !> Put the reference period, and the return period of a limit state
   pure subroutine put_years(sheet, input, state, name)
      type(sheet_type), intent(inout) :: sheet
      type(check_input_type), intent(in) :: input
      !> Number of the limit state, and its name
      integer, intent(in) :: state
      character(len=*), intent(in) :: name

      type(working_type) :: working
      real(wp) :: asked

      asked = return_period(input%reference_life, input%exceedance(state))
      if (allocated(input%place)) working = working_type('C_U V_N', trim(shown(input%place%use_coefficient))//' * '// &
         & trim(shown(input%place%nominal_life)))
      call sheet%add('site', name, 'reference_life', input%reference_life, working=working)
      working = working_type('-V_R/ln(1 - P_VR)', '-'//trim(shown(input%reference_life))//'/ln(1 - '// &
         & trim(shown(input%exceedance(state)))//')')
      if (input%return_period(state) < asked .or. input%return_period(state) > asked) then
         ! The grid has no hazard of this return period
         call sheet%add('site', name, 'return_period_asked', asked, 'NTC 3.2.1', working=working)
         working = working_type()
      end if
      call sheet%add('site', name, 'return_period_demand', input%return_period(state), 'NTC 3.2.1', working=working)
   end subroutine put_years

end module dondolo_check_site_rows
