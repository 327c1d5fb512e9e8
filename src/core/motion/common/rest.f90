!> When a wall at rest begins to rock, and when a chain of ever smaller bounces ends at rest.
!>
!> Both follow from the moments at q = 0 and from the accelerogram alone (docs/theory.md, section 4), so every
!> engine takes these decisions here.
module dondolo_motion_rest
   use dondolo_base_kinds, only : wp
   use dondolo_record, only : record_type
   use dondolo_record_set, only : record_set_type
   use dondolo_wall_mechanism, only : mechanism_type
   implicit none
   private

   public :: bounce_type, rest_type, new_rest

   !> A wall just after an impact
   type :: bounce_type
      !> Sample interval, which may lie beyond the record, and time since its first sample [s]
      integer :: interval
      real(wp) :: time
      !> Side of the wall, and its speed [rad/s]
      real(wp) :: side, speed
      !> Largest rotation so far, which a chain of bounces must not exceed [rad]
      real(wp) :: peak
   end type bounce_type

   !> A wall near q = 0
   type :: rest_type
      !> Can it rock to both sides?
      logical :: two_sided
      !> Does it bend before it rocks? Then it is never at rest
      logical :: bends = .false.
      !> Largest speed after an impact / speed before it
      real(wp) :: restitution
      !> Restoring moment G(0) - Q(0) [N m]
      real(wp) :: moment
      !> Excitation lever L(0) [kg m]
      real(wp) :: lever
      !> Lever of vertical ground acceleration, G(0)/g [kg m]
      real(wp) :: vertical_lever = 0.0_wp
      !> Inertia J(0) [kg m2]
      real(wp) :: inertia
      !> Rate at which the moment changes with the rotation up to `height` [N m/rad]
      real(wp) :: stiffness
      !> Rotation up to which the bounds of a chain hold [rad]
      real(wp) :: height
      !> Relative change of the terms up to that rotation
      real(wp) :: slack
      !> Relative change of the vertical lever up to it
      real(wp) :: vertical_slack = 0.0_wp
      !> Energies below which bounces are low, and lowest [J], and how many of each in a row end at rest: the Zeno guard
      real(wp) :: low_energy(2)
      integer :: most_low_bounces(2)
      !> Impacts after which a chain of bounces is looked at again: 1, more where e is next to 1
      integer :: bounces_per_look
   contains
      !> Ground acceleration at which rocking begins
      procedure :: trigger
      !> When rocking begins
      procedure :: next_start
      !> Does it never begin under a record?
      procedure :: stays
      !> Moment that pushes the wall back to rest
      procedure :: inward_moment
      !> Does a chain of bounces end at rest, whatever happens in between?
      procedure :: chain_ends
   end type rest_type

   !> Largest relative change of the terms within the height of a chain
   real(wp), parameter :: largest_slack = 4.0e-3_wp

   !> Margin of the bounds of a chain for the change of the terms within its height; it covers moments that rise up to
   !> tenfold
   real(wp), parameter :: margin = 1.03_wp, largest_growth = 10.0_wp

   !> Parts of q_c that bounces rise in still ground which are low, and lowest: the latter are negligible beside any tolerance
   real(wp), parameter :: low_heights(2) = [1.0e-12_wp, 1.0e-24_wp]

   !> The guard waits for so many of the lowest, and until low bounces have become so, but for no more than most: those of walls
   !> with e above 0.9993 are cut short
   real(wp), parameter :: fewest_low = 1.0e3_wp, most_low = 2.0e4_wp

   !> Part by which the speed of a chain may fall from one look to the next, and most bounces between them
   real(wp), parameter :: speed_per_look = 0.1_wp, most_bounces = 1.0e3_wp

contains

   !> What a mechanism is like near rest
   pure function new_rest(mechanism) result(rest)
      class(mechanism_type), intent(in) :: mechanism
      !> Its rest
      type(rest_type) :: rest

      real(wp) :: j0, c0, g0, l0, load0, j, c, g, l, load, change, fall

      call mechanism%terms(0.0_wp, j0, c0, g0, l0, load0)
      rest%two_sided = mechanism%two_sided
      rest%bends = mechanism%joint%exists
      rest%restitution = mechanism%largest_restitution()
      rest%moment = g0 - load0
      rest%lever = l0
      rest%inertia = j0
      rest%low_energy = low_heights*mechanism%capacity*rest%moment
      ! Each bounce leaves e**2 of the height.
      fall = 0.5_wp*log(low_heights(2)/low_heights(1))/log(max(rest%restitution, low_heights(1)))
      rest%most_low_bounces = int([min(most_low, fewest_low + fall), fewest_low])
      rest%bounces_per_look = max(1, int(min(most_bounces, speed_per_look/(1.0_wp - rest%restitution))))
      rest%height = 1.0e-3_wp*mechanism%capacity
      do
         call mechanism%terms(rest%height, j, c, g, l, load)
         change = (g - load)/rest%moment - 1.0_wp
         rest%stiffness = (g - load - rest%moment)/rest%height
         ! What a tie adds to the moment shortens a bounce; the bounds of a chain ask for no more than the rest.
         if (allocated(mechanism%restraints)) change = min(change, 0.0_wp)
         ! The term C q'^2 takes at most 2 |C| height/J of the moment from a bounce of that height.
         rest%slack = abs(change) + abs(l/l0 - 1.0_wp) + abs(j/j0 - 1.0_wp) &
            & + 2.0_wp*max(abs(c0), abs(c))*rest%height/j0
         if (rest%slack <= largest_slack) exit
         rest%height = 0.5_wp*rest%height
      end do
      if (.not. mechanism%gravity > 0.0_wp) return
      rest%vertical_lever = g0/mechanism%gravity
      rest%vertical_slack = rest%slack + abs(g/g0 - 1.0_wp)
   end function new_rest

   !> Ground acceleration beyond which a wall at rest does not stay so, towards the side it can rock to [m/s2]
   elemental real(wp) function trigger(self)
      class(rest_type), intent(in) :: self

      trigger = self%moment/self%lever
   end function trigger

   !> Moment at q = 0 that pushes the wall back to rest: G(0) (1 + v_g''/g) - Q(0) + s L(0) u_g''
   elemental function inward_moment(self, side, acceleration, vertical) result(moment)
      class(rest_type), intent(in) :: self
      !> Side, +1 or -1
      real(wp), intent(in) :: side
      !> Ground acceleration [m/s2]
      real(wp), intent(in) :: acceleration
      !> Vertical ground acceleration, positive upwards; 0 if absent [m/s2]
      real(wp), intent(in), optional :: vertical
      !> Inward moment; negative: the wall is pushed out [N m]
      real(wp) :: moment

      moment = self%moment + side*self%lever*acceleration
      if (present(vertical)) moment = moment + self%vertical_lever*vertical
   end function inward_moment

   !> The instant at which a wall at rest begins to rock: where the inward moment of one of its sides first falls
   !> below zero, in closed form inside a sample interval
   pure subroutine next_start(self, record, scale, interval, time, side, found)
      !> The wall at rest
      class(rest_type), intent(in) :: self
      type(record_type), intent(in) :: record
      !> Factor on it
      real(wp), intent(in) :: scale
      !> Sample interval, from 1; in: where to look from, out: where rocking begins
      integer, intent(inout) :: interval
      !> Time since the first sample of the interval [s]
      real(wp), intent(inout) :: time
      !> Side that opens
      real(wp), intent(out) :: side
      !> Does rocking begin before the end of the record?
      logical, intent(out) :: found

      real(wp) :: here, next, threshold

      if (allocated(record%vertical)) then
         call next_start_of_both(self, record, scale, interval, time, side, found)
         return
      end if
      threshold = self%trigger()
      associate (a => record%acceleration)
         here = scale*(a(interval) + (a(interval + 1) - a(interval))*(time/record%dt))
         do
            next = scale*a(interval + 1)
            side = -sign(1.0_wp, merge(here, next, opens(here)))
            found = opens(here) .or. opens(next)
            if (found) exit
            if (interval == size(a) - 1) return
            interval = interval + 1
            time = 0.0_wp
            here = next
         end do
         if (.not. opens(here)) time = time + (record%dt - time)*((-side*threshold - here)/(next - here))
      end associate

   contains

      !> Does an acceleration overcome the restoring moment?
      pure logical function opens(acceleration)
         !> Ground acceleration [m/s2]
         real(wp), intent(in) :: acceleration

         opens = -acceleration > threshold .or. (self%two_sided .and. acceleration > threshold)
      end function opens

   end subroutine next_start

   !> The same under a horizontal and a vertical component: the inward moment of each side is linear between samples
   pure subroutine next_start_of_both(rest, record, scale, interval, time, side, found)
      type(rest_type), intent(in) :: rest
      !> The accelerogram, with its vertical component
      type(record_type), intent(in) :: record
      !> Factor on it
      real(wp), intent(in) :: scale
      !> Sample interval and time in it [s], as in next_start
      integer, intent(inout) :: interval
      real(wp), intent(inout) :: time
      !> Side that opens
      real(wp), intent(out) :: side
      !> Does rocking begin before the end of the record?
      logical, intent(out) :: found

      real(wp) :: here(2), next(2), part(2)

      associate (a => record%acceleration, v => record%vertical, dt => record%dt)
         here = moments(a(interval) + (a(interval + 1) - a(interval))*(time/dt), record%vertical_at(interval, time))
         do
            next = moments(a(interval + 1), v(interval + 1))
            found = any(here < 0.0_wp .or. next < 0.0_wp)
            if (found .or. interval == size(a) - 1) exit
            interval = interval + 1
            time = 0.0_wp
            here = next
         end do
         side = 1.0_wp
         if (any(here < 0.0_wp)) then
            if (here(2) < here(1)) side = -1.0_wp
         else if (found) then
            part = 2.0_wp
            where (next < 0.0_wp) part = here/(here - next)
            if (part(2) < part(1)) side = -1.0_wp
            time = time + (dt - time)*minval(part)
         end if
      end associate

   contains

      !> Inward moments of the sides +1 and -1 under a sample [N m]
      pure function moments(horizontal, vertical)
         !> Components of the accelerogram [m/s2]
         real(wp), intent(in) :: horizontal, vertical
         real(wp) :: moments(2)

         moments(1) = rest%inward_moment(1.0_wp, scale*horizontal, abs(scale)*vertical)
         moments(2) = huge(moments)
         if (rest%two_sided) moments(2) = rest%inward_moment(-1.0_wp, scale*horizontal, abs(scale)*vertical)
      end function moments

   end subroutine next_start_of_both

   !> Does a wall at rest stay so under a whole record? Blocks of samples that cannot move it are passed over
   pure logical function stays(self, record, set, number, scale)
      class(rest_type), intent(in) :: self
      type(record_type), intent(in) :: record
      !> Records joined, and the number of this one among them
      type(record_set_type), intent(in) :: set
      integer, intent(in) :: number
      !> Factor on it
      real(wp), intent(in) :: scale

      real(wp) :: threshold, time, side
      integer :: sample
      logical :: found

      stays = .false.
      if (self%bends) return
      threshold = self%trigger()
      if (allocated(record%vertical)) then
         sample = set%next_outside_of_both(number, 1, scale, threshold, self%vertical_lever/self%lever, self%two_sided)
         stays = sample > set%length(number)
         if (stays) return
         sample = max(1, sample - 1)
         time = 0.0_wp
         call self%next_start(record, scale, sample, time, side, found)
         stays = .not. found
      else
         stays = set%next_outside(number, 1, scale, -threshold, merge(threshold, huge(threshold), self%two_sided)) &
            & > set%length(number)
      end if
   end function stays

   !> Does the chain of bounces after an impact end at rest, whatever happens in between?
   !>
   !> While every inward moment stays positive the energy E = 1/2 J q'^2 + U of a flight grows only as that
   !> moment does, dE/dt <= E d(ln m)/dt, and is multiplied by e^2 at most at each impact. So, with V the product of all
   !> rises of the moments, no bounce is faster than w e^n sqrt(V), and the chain is over after at most
   !>
   !>     2 w sqrt(V) (1/a_1 + e/a_2)/(1 - e^2)
   !>
   !> with a_1, a_2 the least inward decelerations of the side now active and of the other (the same one for a
   !> one-sided wall). If the moments stay positive for that long the wall ends at rest, and cannot start before.
   !>
   !> A sample at which a moment is not positive stops any chain, whatever its side and speed. It is kept, since most
   !> looks at a chain fail at the same sample: the next one need not go there again. It remains valid when ties
   !> change, since they only lose force at rest; a look that fails needlessly costs only time.
   pure subroutine chain_ends(self, record, scale, bounce, stopper, ends)
      class(rest_type), intent(in) :: self
      !> The accelerogram; zero after its last sample
      type(record_type), intent(in) :: record
      !> Factor on it
      real(wp), intent(in) :: scale
      !> The impact that begins the chain
      type(bounce_type), intent(in) :: bounce
      !> The sample that stopped the last look at a chain of this history; no later one is known if it has passed
      integer, intent(inout) :: stopper
      !> True only if it is certain
      logical, intent(out) :: ends

      ! Growth is kept as a quotient, which is cheaper than a quotient for each sample, within this range.
      real(wp), parameter :: largest_divisor = 1.0e100_wp
      real(wp) :: push_of_ground, weight_of_ground, e, loss, dt, highest, energy, longest
      real(wp) :: push, weight, here, other, here_next, other_next, least_here, least_other, least, growth, divisor, elapsed
      logical :: is_shaken
      integer :: i

      ends = .false.
      is_shaken = allocated(record%vertical)
      e = self%restitution
      dt = record%dt
      associate (a => record%acceleration, n => size(record%acceleration), interval => bounce%interval, &
         & time => bounce%time, side => bounce%side)
         push_of_ground = side*scale*self%lever
         weight_of_ground = self%vertical_lever*abs(scale)
         loss = 1.0_wp - e**2
         highest = min(self%height, bounce%peak)
         energy = 0.5_wp*margin*self%inertia*bounce%speed**2
         longest = 8.0_wp*energy*self%inertia
         growth = 1.0_wp
         divisor = 1.0_wp
         elapsed = -time
         push = 0.0_wp
         if (interval < n) push = push_of_ground*(a(interval) + (a(interval + 1) - a(interval))*(time/dt))
         weight = 0.0_wp
         if (is_shaken) weight = weight_of_ground*record%vertical_at(interval, time)
         call least_moments(self, push, weight, here, other)
         ! Would it be over before the sample that stops it, if its moments were no less than now?
         if (stopper > interval) then
            if (longest*(other + e*here)**2 > (((real(stopper - 1 - interval, wp)*dt - time)*loss)*here*other)**2) return
         end if
         least_here = here
         least_other = other
         do i = min(interval, n), n
            push = 0.0_wp
            weight = 0.0_wp
            if (i < n) then
               push = push_of_ground*a(i + 1)
               if (is_shaken) weight = weight_of_ground*record%vertical(i + 1)
            end if
            call least_moments(self, push, weight, here_next, other_next)
            if (.not. min(here_next, other_next) > 0.0_wp) stopper = i + 1
            least_here = min(least_here, here_next)
            least_other = min(least_other, other_next)
            least = min(least_here, least_other)
            if (.not. least > 0.0_wp) return
            ! The larger rise of the two, without a branch, which no processor could foresee
            growth = growth*max(here*other, here_next*other, here*other_next)
            divisor = divisor*(here*other)
            if (energy*growth > highest*least*divisor .or. growth > largest_growth*divisor) return
            elapsed = elapsed + dt
            ! The square of duration <= elapsed, without a quotient
            if (longest*growth*(least_other + e*least_here)**2 <= (elapsed*loss*least_here*least_other)**2*divisor) exit
            if (divisor > largest_divisor .or. divisor*largest_divisor < 1.0_wp) then
               growth = growth/divisor
               divisor = 1.0_wp
            end if
            here = here_next
            other = other_next
         end do
         ends = .true.
      end associate
   end subroutine chain_ends

   !> Lower bounds of the inward moments of the side now active and of the other, within the height of a chain
   pure subroutine least_moments(self, push, weight, here, other)
      type(rest_type), intent(in) :: self
      !> Inward moment of the ground on the side now active [N m]
      real(wp), intent(in) :: push
      !> Inward moment of vertical ground acceleration on either side [N m]
      real(wp), intent(in) :: weight
      !> Moment of this side, moment of the other; the same for a one-sided wall [N m]
      real(wp), intent(out) :: here, other

      real(wp) :: least

      least = (1.0_wp - self%slack)*self%moment - self%slack*abs(push) + (weight - self%vertical_slack*abs(weight))
      here = least + push
      other = merge(least - push, here, self%two_sided)
   end subroutine least_moments

end module dondolo_motion_rest
