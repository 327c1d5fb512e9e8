!> An accelerogram: ground acceleration at equal steps of time, linear in between.
!>
!> The piecewise linear function IS the input of every analysis, exactly (docs/theory.md, section 1).
module dondolo_record
   use dondolo_base_error, only : error_type, not_a_number, not_a_string, out_of_range, raise_failure, raise_input
   use dondolo_base_kinds, only : wp
   use dondolo_base_limits, only : most_samples
   use dondolo_base_plain, only : name_problem, shown
   use dondolo_base_text, only : to_text
   use dondolo_record_common_steps, only : compute_parts, most_parts, refine, same_step
   use dondolo_record_metadata, only : metadata_type
   implicit none
   private

   public :: record_type, new_record, move_to_record, compute_extremes
   public :: largest_acceleration

   !> Largest ground acceleration that is taken for a measurement [m/s2]: a thousand times gravity
   real(wp), parameter :: largest_acceleration = 1.0e4_wp

   !> Shortest and longest time step that are taken for those of a record [s]
   real(wp), parameter :: shortest_step = 1.0e-9_wp, longest_step = 1.0e2_wp

   !> An accelerogram
   type :: record_type
      !> Name: the stem of its file, unless given
      character(len=:), allocatable :: name
      !> Path of its file; not allocated: it is of none
      character(len=:), allocatable :: file
      !> Path of the file of its vertical component; not allocated: it is of none, or of the same file
      character(len=:), allocatable :: vertical_file
      !> Time between two samples [s]
      real(wp) :: dt = 0.0_wp
      !> Ground acceleration at times 0, dt, 2 dt, ... [m/s2]
      real(wp), allocatable :: acceleration(:)
      !> Vertical ground acceleration at the same times, positive upwards [m/s2]; not allocated: the record has none
      real(wp), allocatable :: vertical(:)
      !> What the header of its file says
      type(metadata_type) :: metadata
   contains
      !> Peak ground acceleration [m/s2]
      procedure :: pga
      !> Time of the last sample [s]
      procedure :: duration
      !> Give it a vertical component
      procedure :: set_vertical
      !> Vertical ground acceleration at an instant
      procedure :: vertical_at
      !> Largest downward acceleration of the ground
      procedure :: largest_fall
   end type record_type

contains

   !> Make a record and check that it can be one
   subroutine new_record(record, acceleration, dt, name, error)
      type(record_type), intent(out) :: record
      !> Ground acceleration at equal steps [m/s2]
      real(wp), intent(in) :: acceleration(:)
      !> Time step [s]
      real(wp), intent(in) :: dt
      !> Name of the record
      character(len=*), intent(in) :: name
      !> Fewer than two samples, or too many, a step that is not positive, a value that is no acceleration, a long name
      type(error_type), allocatable, intent(out) :: error

      real(wp), allocatable :: samples(:)

      samples = acceleration
      call move_to_record(samples, dt, name, record, error)
   end subroutine new_record

   !> Make a record of samples that are needed nowhere else
   subroutine move_to_record(acceleration, dt, name, record, error)
      !> Ground acceleration at equal steps [m/s2]; moved away unless there is an error
      real(wp), allocatable, intent(inout) :: acceleration(:)
      !> As of `new_record`
      real(wp), intent(in) :: dt
      character(len=*), intent(in) :: name
      type(record_type), intent(out) :: record
      type(error_type), allocatable, intent(out) :: error

      integer :: i

      if (.not. (dt >= shortest_step .and. dt <= longest_step)) then
         call raise_input(error, 'time step dt = '//to_text(dt)//': must lie between '//to_text(shortest_step)// &
            & ' and '//to_text(longest_step)//' s')
         return
      end if
      if (size(acceleration) < 2) then
         call raise_input(error, 'number of samples = '//to_text(size(acceleration))//': must be at least 2')
         return
      else if (size(acceleration) > most_samples) then
         call raise_input(error, 'number of samples = '//to_text(size(acceleration))//': must be at most '// &
            & to_text(most_samples))
         return
      else if (len_trim(name_problem(name)) > 0) then
         call raise_input(error, 'name = '''//shown(name)//''': '//trim(name_problem(name)), not_a_string, 'name')
         return
      end if
      i = first_implausible(acceleration, 1.0_wp)
      if (i > 0) then
         call raise_input(error, 'sample '//to_text(i)//' = '//to_text(acceleration(i))//' m/s2: '// &
            & 'must be a number between -'//to_text(largest_acceleration)//' and '//to_text(largest_acceleration))
         return
      end if
      record%name = name
      record%dt = dt
      call move_alloc(acceleration, record%acceleration)
   end subroutine move_to_record

   !> The first sample that is no acceleration of the ground; 0 if there is none
   pure integer function first_implausible(samples, factor) result(first)
      !> Samples
      real(wp), intent(in) :: samples(:)
      !> Factor that makes them accelerations [m/s2]
      real(wp), intent(in) :: factor

      integer :: i, wrong

      ! Without an exit the loop takes several at once; a NaN is not below the limit either
      wrong = 0
      do i = 1, size(samples)
         wrong = wrong + merge(0, 1, abs(factor*samples(i)) <= largest_acceleration)
      end do
      first = 0
      if (wrong == 0) return
      do first = 1, size(samples)
         if (.not. abs(factor*samples(first)) <= largest_acceleration) return
      end do
   end function first_implausible

   !> Peak ground acceleration [m/s2]
   elemental function pga(self)
      class(record_type), intent(in) :: self
      !> max |a| [m/s2]
      real(wp) :: pga

      real(wp) :: lowest, highest

      call compute_extremes(self%acceleration, lowest, highest)
      pga = max(-lowest, highest)
   end function pga

   !> Time of the last sample [s]
   pure function duration(self)
      class(record_type), intent(in) :: self
      !> (n - 1) dt [s]
      real(wp) :: duration

      duration = real(size(self%acceleration) - 1, wp)*self%dt
   end function duration

   !> Give a record a vertical component. Where their steps differ both are put on the grid of the samples of both, on which
   !> they are the same functions of time; the ground is still after a vertical component that ends before the record
   subroutine set_vertical(self, vertical, dt, factor, error)
      class(record_type), intent(inout) :: self
      !> Vertical ground acceleration at equal steps, positive upwards [m/s2]
      real(wp), intent(in) :: vertical(:)
      !> Its time step [s]
      real(wp), intent(in) :: dt
      !> Factor on it
      real(wp), intent(in) :: factor
      !> It is not as long as the record, their steps have no grid in common, too many samples, or a sample is no acceleration
      type(error_type), allocatable, intent(out) :: error

      integer :: i

      if (.not. abs(dt - self%dt) > same_step*self%dt) then
         if (size(vertical) /= size(self%acceleration)) then
            call raise_input(error, 'vertical: has '//to_text(size(vertical))//' samples, must have '// &
               & to_text(size(self%acceleration))//' as the record', out_of_range, 'vertical')
            return
         end if
      else if (.not. abs(real(size(vertical) - 1, wp)*dt - self%duration()) < (1.0_wp - same_step)*max(dt, self%dt)) then
         call raise_input(error, 'vertical: lasts '//to_text(real(size(vertical) - 1, wp)*dt)//' s, must last '// &
            & to_text(self%duration())//' s as the record, or by less than a step longer or shorter', out_of_range, 'vertical')
         return
      end if
      i = first_implausible(vertical, factor)
      if (i > 0) then
         call raise_input(error, 'vertical: sample '//to_text(i)//' = '//to_text(factor*vertical(i))//' m/s2: '// &
            & 'must be a number between -'//to_text(largest_acceleration)//' and '//to_text(largest_acceleration), &
            & not_a_number, 'vertical')
         return
      end if
      if (.not. abs(dt - self%dt) > same_step*self%dt) then
         self%vertical = factor*vertical
      else
         call join_grids(self, factor*vertical, dt, error)
      end if
   end subroutine set_vertical

   !> Put a record and a vertical component of other steps on one grid
   subroutine join_grids(self, vertical, dt, error)
      class(record_type), intent(inout) :: self
      !> Vertical ground acceleration [m/s2]
      real(wp), intent(in) :: vertical(:)
      !> Its time step [s]
      real(wp), intent(in) :: dt
      !> There is no such grid, or too many samples on it
      type(error_type), allocatable, intent(out) :: error

      real(wp), allocatable :: sideways(:), upwards(:)
      integer :: parts, other_parts, samples, had
      logical :: ok(2)

      call compute_parts(self%dt, dt, parts, other_parts)
      if (parts == 0) then
         call raise_input(error, 'vertical: has a time step of '//to_text(dt)//' s, whose ratio to '//to_text(self%dt)// &
            & ' s of the record must be a ratio of integers up to '//to_text(most_parts), out_of_range, 'vertical')
         return
      else if (real(size(self%acceleration), wp)*real(parts, wp) > real(most_samples, wp)) then
         call raise_input(error, 'vertical: has a time step of '//to_text(dt)//' s, which makes more than '// &
            & to_text(most_samples)//' samples of a record with '//to_text(self%dt)//' s')
         return
      end if
      call refine(self%acceleration, parts, sideways, ok(1))
      call refine(vertical, other_parts, upwards, ok(2))
      if (.not. all(ok)) then
         call raise_failure(error, 'vertical: too little memory for the samples of both components')
         return
      end if
      ! Cut where the record ends, or zero up to there
      samples = size(sideways)
      had = min(size(upwards), samples)
      self%vertical = sideways
      self%vertical(:had) = upwards(:had)
      self%vertical(had + 1:) = 0.0_wp
      self%dt = self%dt/real(parts, wp)
      call move_alloc(sideways, self%acceleration)
   end subroutine join_grids

   !> Vertical ground acceleration at an instant, zero after the last sample [m/s2]
   pure real(wp) function vertical_at(self, interval, time)
      class(record_type), intent(in) :: self
      !> Sample interval, from 1, and time since its first sample [s]
      integer, intent(in) :: interval
      real(wp), intent(in) :: time

      vertical_at = 0.0_wp
      if (.not. allocated(self%vertical)) return
      associate (v => self%vertical)
         if (interval < size(v)) vertical_at = v(interval) + (v(interval + 1) - v(interval))*(time/self%dt)
      end associate
   end function vertical_at

   !> Largest downward acceleration of the ground, 0 without a vertical component [m/s2]. Where it reaches g the ground falls
   !> away from a wall, and the model ends
   elemental real(wp) function largest_fall(self)
      class(record_type), intent(in) :: self

      largest_fall = 0.0_wp
      if (allocated(self%vertical)) largest_fall = max(0.0_wp, -minval(self%vertical))
   end function largest_fall

   !> Smallest and largest sample: several chains at once, since one alone waits for itself
   pure subroutine compute_extremes(samples, lowest, highest)
      !> Samples [m/s2]
      real(wp), intent(in) :: samples(:)
      !> The smallest and the largest [m/s2]
      real(wp), intent(out) :: lowest, highest

      integer, parameter :: chains = 8
      real(wp) :: low(chains), high(chains)
      integer :: i, j

      low = samples(1)
      high = samples(1)
      do i = 1, size(samples) - chains + 1, chains
         do j = 1, chains
            low(j) = min(low(j), samples(i + j - 1))
            high(j) = max(high(j), samples(i + j - 1))
         end do
      end do
      lowest = minval(low)
      highest = maxval(high)
      do i = size(samples) - modulo(size(samples), chains) + 1, size(samples)
         lowest = min(lowest, samples(i))
         highest = max(highest, samples(i))
      end do
   end subroutine compute_extremes

end module dondolo_record
