!> Intensity measures of an accelerogram: their names, their values, and the units their levels are given in.
!>
!> Levels of accelerations are in g, all others in SI units. Where a measure needs the acceleration of gravity, that
!> stands in the size of a level and not in the value: the value of 'arias' is pi/2 times the integral of a**2, and a
!> level of 1 m/s is g of it.
module dondolo_record_intensity
   use dondolo_base_error, only : error_type, not_a_word, raise_input
   use dondolo_base_kinds, only : pi, wp
   use dondolo_base_numbers, only : parse_real
   use dondolo_base_odd_character, only : odd_character
   use dondolo_base_text, only : join, lower, replaced, to_text
   use dondolo_record, only : record_type
   use dondolo_record_energy_measures, only : acceleration_energy, cumulative_absolute_velocity, significant_duration, trapezoid
   use dondolo_record_ground_motion, only : peak_displacement, peak_velocity
   use dondolo_record_response_spectrum, only : largest_period, pseudo_acceleration, smallest_period, standard_damping
   implicit none
   private

   public :: measure_type, new_measure
   public :: im_help, im_names, refuse_measure

   !> Names of the intensity measures; T, T1 and T2 stand for periods [s]
   character(len=12), parameter :: im_names(12) = [character(len=12) :: 'pga', 'pgv', 'pgd', 'arias', 'cav', 'arias-trapz', &
      & 'cav-trapz', 'd5-75', 'd5-95', 'hi', 'sa(T)', 'saavg(T1:T2)']

   !> The names without periods, the units of levels, and words
   character(len=11), parameter :: kinds(12) = [character(len=11) :: 'pga', 'pgv', 'pgd', 'arias', 'cav', 'arias-trapz', &
      & 'cav-trapz', 'd5-75', 'd5-95', 'hi', 'sa', 'saavg']
   character(len=3), parameter :: units(12) = [character(len=3) :: 'g', 'm/s', 'm', 'm/s', 'm/s', 'm/s', 'm/s', 's', 's', &
      & 'm', 'g', 'g']
   character(len=41), parameter :: titles(12) = [character(len=41) :: 'peak ground acceleration', 'peak ground velocity', &
      & 'peak ground displacement', 'Arias intensity', 'cumulative absolute velocity', &
      & 'Arias intensity, trapezoidal', 'cumulative absolute velocity, trapezoidal', &
      & 'significant duration 5-75 %', &
      & 'significant duration 5-95 %', 'Housner intensity', 'spectral acceleration', 'average spectral acceleration']

   !> What a message adds to the names
   character(len=*), parameter :: im_help = '; T in s, 0.01 to 20, such as ''sa(0.5)'' or ''saavg(0.2:2)'''

   !> Periods between which Housner integrates the spectrum [s]
   real(wp), parameter :: housner_periods(2) = [0.1_wp, 2.5_wp]

   !> Steps of his integral, by the trapezoidal rule
   integer, parameter :: housner_steps = 96

   !> Periods that an average takes
   integer, parameter :: averaged = 20

   !> An intensity measure
   type :: measure_type
      !> Its name, with periods as short as they can be written
      character(len=:), allocatable :: name
      !> Its name without periods
      character(len=11) :: kind = 'pga'
      !> Periods of the oscillators it needs [s]
      real(wp), allocatable :: periods(:)
   contains
      !> Its value for an unscaled record
      procedure :: of
      !> What a level of 1 is
      procedure :: level_size
      !> Unit of its levels
      procedure :: unit
      !> What it is, in words
      procedure :: title
      !> Power of a record's scale that its value grows by
      procedure :: power
   end type measure_type

contains

   !> Make a measure of its name
   subroutine new_measure(measure, typed, error)
      type(measure_type), intent(out) :: measure
      !> One of im_names, with numbers for the periods; upper and lower case are the same
      character(len=*), intent(in) :: typed
      !> There is no such measure
      type(error_type), allocatable, intent(out) :: error

      character(len=len(typed)) :: name
      integer :: open, i
      logical :: ok

      name = lower(typed)
      open = index(name, '(')
      ! Fortran would take trailing blanks for nothing
      ok = any(im_names == name) .and. len_trim(name) == len(name)
      if (ok .and. open == 0) then
         measure%kind = name
         measure%name = name
         allocate (measure%periods(0))
         if (name == 'hi') measure%periods = evenly(housner_periods(1), housner_periods(2), housner_steps + 1)
         return
      end if
      ok = .false.
      if (open > 1 .and. index(name, ')') == len(name)) then
         associate (inside => name(open + 1:len(name) - 1))
            select case (name(:open - 1))
            case ('sa')
               allocate (measure%periods(1))
               call parse_period(inside, measure%periods(1), ok)
               if (ok) measure%name = 'sa('//to_text(measure%periods(1))//')'
            case ('saavg')
               i = index(inside, ':')
               allocate (measure%periods(2))
               call parse_period(inside(:i - 1), measure%periods(1), ok)
               if (ok) call parse_period(inside(i + 1:), measure%periods(2), ok)
               if (ok) ok = measure%periods(1) < measure%periods(2)
               if (ok) then
                  measure%name = 'saavg('//to_text(measure%periods(1))//':'//to_text(measure%periods(2))//')'
                  measure%periods = evenly(measure%periods(1), measure%periods(2), averaged)
               end if
            end select
         end associate
      end if
      if (ok) then
         measure%kind = name(:open - 1)
      else
         call refuse_measure(typed, im_names, error)
      end if
   end subroutine new_measure

   !> Refuse the name of a measure
   subroutine refuse_measure(typed, names, error)
      !> The name
      character(len=*), intent(in) :: typed
      !> Names that there are
      character(len=*), intent(in) :: names(:)
      !> What is wrong with it
      type(error_type), allocatable, intent(out) :: error

      call raise_input(error, 'im = '''//typed//''': must be one of '//join(names)//im_help, not_a_word, 'im')
      if (len_trim(odd_character(typed)) > 0) error%message = error%message//'; it has '//trim(odd_character(typed))
      if (index(typed, '(') > 0 .and. index(typed, ',') > 0) error%message = error%message//'; it must have a decimal point: '''// &
         & replaced(lower(typed), ',', '.')//''''
   end subroutine refuse_measure

   !> Read a period
   pure subroutine parse_period(text, period, ok)
      !> Text
      character(len=*), intent(in) :: text
      !> Period [s]
      real(wp), intent(out) :: period
      !> It is a number without blanks, within the bounds
      logical, intent(out) :: ok

      call parse_real(text, period, ok)
      ok = ok .and. scan(text, ' '//achar(9)) == 0 .and. period >= smallest_period .and. period <= largest_period
   end subroutine parse_period

   !> Numbers evenly from one to another, both included
   pure function evenly(first, last, number) result(values)
      !> The first
      real(wp), intent(in) :: first
      !> The last
      real(wp), intent(in) :: last
      !> How many
      integer, intent(in) :: number
      !> The numbers
      real(wp) :: values(number)

      integer :: i

      values = [((real(number - i, wp)*first + real(i - 1, wp)*last)/real(number - 1, wp), i=1, number)]
   end function evenly

   !> Value for an unscaled record
   pure function of(self, record) result(value)
      class(measure_type), intent(in) :: self
      type(record_type), intent(in) :: record
      !> Its value: m/s2 for accelerations, m2/s3 for 'arias', else the unit of the levels
      real(wp) :: value

      real(wp) :: sa(size(self%periods)), velocity(size(self%periods))

      sa = pseudo_acceleration(record, self%periods, standard_damping)
      value = 0.0_wp
      select case (self%kind)
      case ('pga')
         value = record%pga()
      case ('pgv')
         value = peak_velocity(record)
      case ('pgd')
         value = peak_displacement(record)
      case ('arias')
         value = 0.5_wp*pi*acceleration_energy(record)
      case ('cav')
         value = cumulative_absolute_velocity(record)
      case ('arias-trapz')
         value = 0.5_wp*pi*trapezoid(record%acceleration**2, record%dt)
      case ('cav-trapz')
         value = trapezoid(abs(record%acceleration), record%dt)
      case ('d5-75')
         value = significant_duration(record, 0.05_wp, 0.75_wp)
      case ('d5-95')
         value = significant_duration(record, 0.05_wp, 0.95_wp)
      case ('hi')
         velocity = sa*self%periods/(2.0_wp*pi)
         value = (sum(velocity) - 0.5_wp*(velocity(1) + velocity(size(velocity)))) &
            & *(housner_periods(2) - housner_periods(1))/real(housner_steps, wp)
      case ('sa')
         value = sa(1)
      case ('saavg')
         if (all(sa > 0.0_wp)) value = exp(sum(log(sa))/real(size(sa), wp))
      end select
   end function of

   !> What a level of 1 is, in the unit of the value
   pure function level_size(self, gravity)
      class(measure_type), intent(in) :: self
      !> Gravity [m/s2]
      real(wp), intent(in) :: gravity
      !> Value / level
      real(wp) :: level_size

      level_size = 1.0_wp
      select case (self%kind)
      case ('pga', 'sa', 'saavg', 'arias', 'arias-trapz')
         level_size = gravity
      end select
   end function level_size

   !> Number of the kind of a measure
   pure integer function kind_of(self)
      class(measure_type), intent(in) :: self

      kind_of = findloc(kinds == self%kind, .true., dim=1)
   end function kind_of

   !> Length of the unit
   pure integer function unit_length(self)
      class(measure_type), intent(in) :: self

      unit_length = len_trim(units(kind_of(self)))
   end function unit_length

   !> Unit of the levels
   pure function unit(self)
      class(measure_type), intent(in) :: self
      !> Unit
      character(len=unit_length(self)) :: unit

      unit = units(kind_of(self))
   end function unit

   !> What a measure is, in words filled up with blanks
   pure function words_of(self) result(words)
      class(measure_type), intent(in) :: self
      !> Words
      character(len=100) :: words

      words = titles(kind_of(self))
      if (self%kind == 'sa') words = trim(words)//' at '//to_text(self%periods(1))//' s'
      if (self%kind == 'saavg') words = trim(words)//', '//to_text(self%periods(1))//' to '// &
         & to_text(self%periods(size(self%periods)))//' s'
   end function words_of

   !> What it is, in words
   pure function title(self)
      class(measure_type), intent(in) :: self
      !> Words
      character(len=len_trim(words_of(self))) :: title

      title = words_of(self)
   end function title

   !> Power of a record's scale that the value grows by: 2 for an energy, 0 for a duration
   pure integer function power(self)
      class(measure_type), intent(in) :: self

      power = 1
      if (self%kind(1:5) == 'arias') power = 2
      if (self%kind(1:2) == 'd5') power = 0
   end function power

end module dondolo_record_intensity
