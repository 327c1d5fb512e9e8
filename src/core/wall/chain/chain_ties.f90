!> Ties of a chain: what a user says of them, and how they are stretched along the mechanism.
!>
!> A tie to the ground is long and keeps its direction d: with the place r of its anchor, D = d.(r - r_0) and X = d.r'. One between
!> two bodies is as long as its anchors are apart: with r that of one from the other, D = |r| - |r_0| and X = r.r'/|r|. X is sampled
!> as the terms of the chain are (dondolo_wall_travel_series).
module dondolo_wall_chain_ties
   use dondolo_base_error, only : error_type, out_of_range, problems_type, raise_input
   use dondolo_base_kinds, only : pi, wp
   use dondolo_base_text, only : rounded, to_text
   use dondolo_wall_anchor, only : anchor_type
   use dondolo_wall_chain, only : chain_tie_type, chain_type, motion_type, point_motion
   use dondolo_wall_chain_terms, only : set_at_rest
   use dondolo_wall_restraint, only : new_tie_along, restraint_type
   use dondolo_wall_table_fit, only : fit_table
   use dondolo_wall_tabulated, only : tabulated_type
   use dondolo_wall_travel_series, only : new_travel_series, travel_series_type
   implicit none
   private

   public :: anchors_of, lever_of_tie, read_chain_ties, tie_chain

   !> Body, other body, depth, height and angle, depth and height of the point of the other, area, length, modulus, yield stress,
   !> stress at rest, strain at which it breaks, force at which its anchor gives way (0: it holds)
   integer, parameter, public :: tie_numbers = 14

   !> What the numbers of a bar may be: area [m2], length [m], modulus and yield stress [Pa], stress at rest [Pa], strain, force
   !> [N]
   character(len=*), parameter :: names(7) = [character(len=12) :: 'area', 'length', 'modulus', 'strength', 'preload', 'strain', &
      & 'anchor_force']
   real(wp), parameter :: least(7) = [1.0e-8_wp, 0.1_wp, 1.0e8_wp, 1.0e6_wp, 0.0_wp, 1.0e-6_wp, 0.0_wp]
   real(wp), parameter :: most(7) = [0.1_wp, 1.0e3_wp, 1.0e12_wp, 1.0e10_wp, 1.0e10_wp, 1.0_wp, 1.0e9_wp]

   !> Largest distance of a lever from its polynomial / largest lever
   real(wp), parameter :: largest_misfit = 1.0e-9_wp

contains

   !> Read the ties
   subroutine read_chain_ties(chain, list, problems)
      !> Its bodies are known
      type(chain_type), intent(inout) :: chain
      !> Their rows, one after the other
      real(wp), intent(in) :: list(:)
      !> Takes what is wrong
      type(problems_type), intent(inout) :: problems

      type(chain_tie_type) :: tie
      character(len=:), allocatable :: name
      integer :: i

      allocate (chain%ties(0))
      do i = 1, size(list)/tie_numbers
         name = 'ties: tie '//to_text(i)
         associate (row => list(tie_numbers*(i - 1) + 1:tie_numbers*i))
            tie = chain_tie_type(nint(row(1)), nint(row(2)), [-row(3), row(4)], [-row(6), row(7)])
            if (tie%body < 1 .or. max(tie%body, tie%other) > size(chain%bodies) .or. tie%other < 0 .or. tie%body == tie%other) then
               call problems%note(name//' is between '//to_text(tie%body)//' and '//to_text(tie%other)//', must be between one '// &
                  & 'of '//to_text(size(chain%bodies))//' bodies and another, or 0, the ground', out_of_range, 'ties')
               cycle
            end if
            if (tie%other > 0) then
               if (abs(row(5)) > 0.0_wp) call problems%note(name//' has an angle, which only ties to the ground have: of one '// &
                  & 'between two bodies it follows from its ends', out_of_range, 'ties')
               if (.not. norm2(tie%at - tie%other_at) > 0.0_wp) call problems%note(name//' has both its ends at one point', &
                  & out_of_range, 'ties')
            else
               tie%direction = [cos(row(5)*pi/180.0_wp), sin(row(5)*pi/180.0_wp)]
            end if
            call check_bar(name, row(8:), problems)
            tie%given%area = row(8)
            tie%given%length = row(9)
            tie%given%modulus = row(10)
            tie%given%strength = row(11)
            tie%given%preload = row(12)
            tie%given%strain = row(13)
            if (row(14) > 0.0_wp) tie%given%anchor_force = row(14)
            chain%ties = [chain%ties, tie]
         end associate
      end do
   end subroutine read_chain_ties

   !> Check the numbers of a bar
   subroutine check_bar(name, bar, problems)
      !> What it is called in messages
      character(len=*), intent(in) :: name
      !> As `names`
      real(wp), intent(in) :: bar(:)
      type(problems_type), intent(inout) :: problems

      integer :: i, before

      before = problems%count
      do i = 1, size(names)
         if (bar(i) >= least(i) .and. bar(i) <= most(i)) cycle
         call problems%note(name//' has '//trim(names(i))//' = '//to_text(bar(i))//', must lie between '//rounded(least(i))// &
            & ' and '//rounded(most(i))//trim(hint(i)), out_of_range, 'ties')
      end do
      if (problems%count > before) return
      associate (area => bar(1), modulus => bar(3), strength => bar(4), preload => bar(5), strain => bar(6), anchor => bar(7))
         if (.not. preload < strength) then
            call problems%note(name//' has preload = '//to_text(preload)//', must be less than its strength = '// &
               & to_text(strength)//' Pa, at which it yields', out_of_range, 'ties')
         else if (anchor > 0.0_wp .and. .not. preload*area < anchor) then
            call problems%note(name//' has preload = '//to_text(preload)//', must be less than '//rounded(anchor/area)// &
               & ' Pa, at which its anchor gives way', out_of_range, 'ties')
         end if
         if (.not. strain > strength/modulus) call problems%note(name//' has strain = '//to_text(strain)// &
            & ', must be more than '//rounded(strength/modulus)//', at which it yields', out_of_range, 'ties')
      end associate

   contains

      !> What unit a number may be in
      pure function hint(i) result(text)
         integer, intent(in) :: i
         character(len=24) :: text

         text = ''
         if (names(i) == 'area' .and. bar(i) > most(i)) text = ': is it in mm2 or cm2?'
         if (any(names(i) == [character(len=12) :: 'modulus', 'strength']) .and. bar(i) > 0.0_wp .and. bar(i) < least(i)) then
            text = ': is it in MPa?'
         end if
      end function hint

   end subroutine check_bar

   !> The anchors of the ties, as checks know them: forces are those of a whole tie, and not per metre
   pure function anchors_of(chain) result(anchors)
      class(chain_type), intent(in) :: chain
      type(anchor_type), allocatable :: anchors(:)

      allocate (anchors(size(chain%ties)))
      anchors%area = chain%ties%given%area
      anchors%length = chain%ties%given%length
      anchors%strength = chain%ties%given%strength
      anchors%force_per_metre = chain%ties%given%anchor_force
   end function anchors_of

   !> Lever X of a tie [m]
   pure real(wp) function lever_of_tie(chain, motion, tie) result(lever)
      class(chain_type), intent(in) :: chain
      type(motion_type), intent(in) :: motion
      type(chain_tie_type), intent(in) :: tie

      real(wp), dimension(2) :: place, rate, second, far, far_rate

      call point_motion(chain, motion, tie%body, tie%at, place, rate, second)
      if (tie%other == 0) then
         lever = sum(tie%direction*rate)
      else
         call point_motion(chain, motion, tie%other, tie%other_at, far, far_rate, second)
         lever = sum((place - far)*(rate - far_rate))/norm2(place - far)
      end if
   end function lever_of_tie

   !> Give a mechanism the ties of its chain
   subroutine tie_chain(chain, rotation, mechanism, error)
      !> Moving outwards, as ties hold it
      class(chain_type), intent(in) :: chain
      !> Rotations at which its terms were sampled [rad]
      real(wp), intent(in) :: rotation(:)
      type(tabulated_type), intent(inout) :: mechanism
      !> A tie that it does not stretch
      type(error_type), allocatable, intent(out) :: error

      type(restraint_type), allocatable :: ties(:)
      type(travel_series_type) :: along
      type(motion_type) :: motion
      real(wp), allocatable :: lever(:, :), series(:)
      real(wp) :: misfit
      logical :: is_there
      integer :: i, k

      allocate (ties(size(chain%ties)), lever(size(rotation), size(chain%ties)))
      call set_at_rest(chain, motion)
      do i = 1, size(rotation)
         call chain%move(rotation(i), motion, is_there)
         if (.not. is_there) then
            call raise_input(error, 'ties: outwards, where ties act, the chain closes on itself before '//rounded(rotation(i))// &
               & ' rad, up to which its terms are needed; give sides = 1', out_of_range, 'ties')
            return
         end if
         lever(i, :) = [(lever_of_tie(chain, motion, chain%ties(k)), k=1, size(ties))]
      end do
      do k = 1, size(ties)
         if (any(.not. lever(:, k) > 0.0_wp .and. rotation <= mechanism%capacity)) then
            call raise_input(error, 'ties: tie '//to_text(k)//' would become shorter before the chain has turned by '// &
               & rounded(mechanism%capacity)//' rad, its capacity; its angle is that of the direction in which the motion '// &
               & 'stretches it, 0 for outwards', out_of_range, 'ties')
            return
         end if
         call fit_table(rotation, lever(:, k), series, misfit)
         call new_travel_series(along, rotation(size(rotation)), series)
         if (misfit > largest_misfit) then
            call raise_input(error, 'ties: the lever of tie '//to_text(k)//' changes too fast for a polynomial', out_of_range, &
               & 'ties')
            return
         end if
         ties(k) = new_tie_along(chain%ties(k)%given, along)
      end do
      call mechanism%add_ties(ties)
   end subroutine tie_chain

end module dondolo_wall_chain_ties
