!> Free elements in the sheet of a check: Young's modulus, period, elastic branch, and the demand at that period.
!>
!>     a = 4 pi^2 d/T_0^2 up to the curve of capacity, which it meets at d_y, a_y                    C8.7.1.6
!>
!> What starts the mechanism is a_0*, of which a_y is a little less. Of a range the branch is that of the longest period.
module dondolo_check_free_rows
   use dondolo_base_error, only : error_type, out_of_range, raise_input
   use dondolo_base_kinds, only : pi, wp
   use dondolo_base_text, only : rounded
   use dondolo_check_code_spectrum, only : elastic_spectrum_type
   use dondolo_check_floor_spectrum, only : floor_spectrum_type
   use dondolo_check_kinematic, only : kinematic_type
   use dondolo_check_sheet, only : sheet_type, shown, working_type
   implicit none
   private

   public :: check_branch, put_free_demand, put_free_element

contains

   !> Put Young's modulus, period and elastic branch
   subroutine put_free_element(sheet, kinematic, knowledge_factor)
      type(sheet_type), intent(inout) :: sheet
      type(kinematic_type), intent(in) :: kinematic
      !> Confidence factor FC
      real(wp), intent(in) :: knowledge_factor

      real(wp) :: d

      associate (element => kinematic%element)
         if (element%is_free .or. element%may_be_free) call sheet%add('mechanism', '', 'free_element', &
            & merge(1.0_wp, 0.0_wp, element%is_free), 'C8.7.1.2.1.3')
         if (.not. element%has_period()) return
         call sheet%add('mechanism', '', 'young_modulus', element%modulus(2))
         if (element%modulus(1) < element%modulus(2)) call sheet%add('mechanism', '', 'least_modulus', element%modulus(1))
         call sheet%add('mechanism', '', 't0', element%period, 'C8.7.1.7', working=working_type('kappa lambda L sqrt[W/(E g)]', &
            & '6.2 * '//trim(shown(element%height/element%thickness))//' * '//trim(shown(element%height))//' * sqrt('// &
            & trim(shown(element%density*kinematic%gravity))//'/('//trim(shown(element%modulus(2)))//' * '// &
            & trim(shown(kinematic%gravity))//'))'))
         if (element%longest > element%shortest) then
            call sheet%add('mechanism', '', 'shortest_t0', element%shortest)
            call sheet%add('mechanism', '', 'longest_t0', element%longest)
         end if
         call meet_curve(kinematic, knowledge_factor, d)
         call sheet%add('mechanism', '', 'yield_displacement', d, 'C8.7.1.6')
         call sheet%add('mechanism', '', 'yield_acceleration', d*(2.0_wp*pi/element%longest)**2, 'C8.7.1.6')
      end associate
   end subroutine put_free_element

   !> Put the spectral acceleration of a free element at its period
   subroutine put_free_demand(sheet, method, state, kinematic, spectrum)
      type(sheet_type), intent(inout) :: sheet
      !> Part of the check and limit state
      character(len=*), intent(in) :: method, state
      type(kinematic_type), intent(in) :: kinematic
      type(floor_spectrum_type), intent(in) :: spectrum

      real(wp) :: demand, period
      type(working_type) :: working

      if (.not. kinematic%element%has_period()) return
      call kinematic%element%find_demand(spectrum, demand, period)
      if (kinematic%element%longest > kinematic%element%shortest) call sheet%add(method, state, 'governing_t0', &
         & period)
      if (size(spectrum%period) == 0) working = ordinate(spectrum%ground, period, trim(merge('T_0,gov', 'T_0    ', &
         & kinematic%element%longest > kinematic%element%shortest)))
      call sheet%add(method, state, 'floor_t0', demand, 'C8.7.1.9', working=working)
   end subroutine put_free_demand

   !> The formula of an ordinate of the spectrum of the ground at 5 %
   pure function ordinate(ground, period, symbol) result(working)
      type(elastic_spectrum_type), intent(in) :: ground
      !> Period [s], and its symbol
      real(wp), intent(in) :: period
      character(len=*), intent(in) :: symbol
      type(working_type) :: working

      character(len=24) :: t, peak, largest, tb, tc, td

      t = shown(period)
      peak = shown(ground%pga)
      largest = shown(ground%amplification)
      tb = shown(ground%corners(1))
      tc = shown(ground%corners(2))
      td = shown(ground%corners(3))
      if (period < ground%corners(1)) then
         working = working_type('a_g S [1 + '//symbol//'/T_B (F_0 - 1)]', trim(peak)//' * (1 + '//trim(t)//'/'//trim(tb)//' * ('// &
            & trim(largest)//' - 1))')
      else if (period < ground%corners(2)) then
         working = working_type('a_g S F_0', trim(peak)//' * '//trim(largest))
      else if (period < ground%corners(3)) then
         working = working_type('a_g S F_0 T_C/'//symbol, trim(peak)//' * '//trim(largest)//' * '//trim(tc)//'/'//trim(t))
      else
         working = working_type('a_g S F_0 T_C T_D/'//symbol//'^2', trim(peak)//' * '//trim(largest)//' * '//trim(tc)//' * '// &
            & trim(td)//'/'//trim(t)//'^2')
      end if
   end function ordinate

   !> Refuse a wall whose elastic branch meets the curve beyond the displacement that SLV allows
   subroutine check_branch(kinematic, knowledge_factor, allowed, error)
      type(kinematic_type), intent(in) :: kinematic
      !> Confidence factor FC
      real(wp), intent(in) :: knowledge_factor
      !> d_SLV [m]
      real(wp), intent(in) :: allowed
      !> Such a wall
      type(error_type), allocatable, intent(out) :: error

      real(wp) :: d

      if (.not. kinematic%element%has_period()) return
      call meet_curve(kinematic, knowledge_factor, d)
      if (d <= allowed) return
      call raise_input(error, 'young_modulus = '//rounded(kinematic%element%modulus(1))//': too small for this wall: its '// &
         & 'elastic branch (C8.7.1.6), with T_0 = '//rounded(kinematic%element%longest)//' s, meets the curve of capacity at '// &
         & 'd_y = '//rounded(d)//' m, which must not be more than d_SLV = '//rounded(allowed)//' m', out_of_range, 'young_modulus')
   end subroutine check_branch

   !> Where the elastic branch meets the curve of capacity: there the curve falls below it, by bisection
   subroutine meet_curve(kinematic, knowledge_factor, d)
      type(kinematic_type), intent(in) :: kinematic
      !> Confidence factor FC
      real(wp), intent(in) :: knowledge_factor
      !> [m]
      real(wp), intent(out) :: d

      integer, parameter :: cuts = 100
      real(wp) :: low, high, stiffness
      integer :: i

      stiffness = (2.0_wp*pi/kinematic%element%longest)**2
      low = 0.0_wp
      high = kinematic%end_displacement
      do i = 1, cuts
         d = 0.5_wp*(low + high)
         if (stiffness*d < kinematic%capacity(d, knowledge_factor)) then
            low = d
         else
            high = d
         end if
      end do
   end subroutine meet_curve

end module dondolo_check_free_rows
