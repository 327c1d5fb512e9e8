!> What records are scaled by in stripes: an intensity measure of the record, or one made dimensionless by the wall.
!>
!> Of a rigid block, the PGA over the acceleration at which rocking starts, and p PGV over it, govern rocking and
!> overturning (Giouvanidis and Dimitrakopoulos 2018; Dimitrakopoulos and Paraskeva 2015).
module dondolo_fragility_scaling
   use dondolo_base_error, only : error_type, not_a_word, raise_input
   use dondolo_base_kinds, only : wp
   use dondolo_base_text, only : join, lower
   use dondolo_record_intensity, only : im_help, measure_type, new_measure, refuse_measure
   use dondolo_wall_specimen, only : specimen_type
   implicit none
   private

   public :: scaling_type, new_scaling, unscaled
   public :: scaling_names

   !> Measures that need a wall: a0 is its trigger acceleration, p its frequency parameter
   character(len=8), parameter :: wall_names(2) = [character(len=8) :: 'pga/a0', 'p*pgv/a0']

   !> What a record can be scaled by: all measures but durations, and those that need a wall
   character(len=12), parameter :: scaling_names(12) = [character(len=12) :: 'pga', 'pgv', 'pgd', 'arias', 'cav', &
      & 'arias-trapz', 'cav-trapz', 'hi', 'sa(T)', 'saavg(T1:T2)', wall_names]

   !> What records are scaled by
   type :: scaling_type
      !> Its name
      character(len=:), allocatable :: name
      !> The measure of the record
      type(measure_type) :: measure
   contains
      !> Factors that scale records to a level
      procedure :: factors
      !> Does the factor depend on the wall?
      procedure :: needs_wall
      !> Unit of the levels, empty for a number
      procedure :: unit
      !> The unit as it follows a number or a name
      procedure :: unit_after_blank
      !> What it is, in words
      procedure :: title
   end type scaling_type

contains

   !> Make a scaling of its name
   subroutine new_scaling(scaling, typed, error)
      type(scaling_type), intent(out) :: scaling
      !> One of scaling_names, with numbers for the periods; upper and lower case are the same
      character(len=*), intent(in) :: typed
      !> There is no such measure, or it does not grow with the record
      type(error_type), allocatable, intent(out) :: error

      character(len=len(typed)) :: name
      character(len=:), allocatable :: measure

      name = lower(typed)
      measure = name
      if (any(wall_names == name)) measure = name(index(name, 'pg'):index(name, '/') - 1)
      ! Fortran would take trailing blanks for nothing
      if (len_trim(name) < len(name)) measure = ''
      call new_measure(scaling%measure, measure, error)
      if (allocated(error)) then
         call refuse_measure(typed, scaling_names, error)
      else if (scaling%measure%power() == 0) then
         call raise_input(error, 'im = '''//typed//''': a duration does not change when a record is scaled; '// &
            & 'must be one of '//join(scaling_names)//im_help, not_a_word, 'im')
      else
         scaling%name = scaling%measure%name
         if (any(wall_names == name)) scaling%name = name
      end if
   end subroutine new_scaling

   !> Unscaled records times factors: a level is the factor itself, and the measure has no name
   function unscaled() result(scaling)
      !> The scaling
      type(scaling_type) :: scaling

      type(error_type), allocatable :: error

      call new_measure(scaling%measure, 'pga', error)
      scaling%name = ''
   end function unscaled

   !> Factors that scale records to a level
   pure function factors(self, level, values, wall)
      class(scaling_type), intent(in) :: self
      !> Level, in its unit
      real(wp), intent(in) :: level
      !> Values of the measure for the unscaled records
      real(wp), intent(in) :: values(:)
      class(specimen_type), intent(in) :: wall
      !> The factors; 0 for a record without motion
      real(wp) :: factors(size(values))

      real(wp) :: level_size

      if (len(self%name) == 0) then
         factors = level
         return
      end if
      level_size = self%measure%level_size(wall%gravity)
      if (self%name == 'pga/a0') level_size = wall%mechanism%trigger_acceleration()
      if (self%name == 'p*pgv/a0') then
         level_size = wall%mechanism%trigger_acceleration()/wall%mechanism%frequency_parameter()
      end if
      factors = 0.0_wp
      where (values > 0.0_wp) factors = level*level_size/values
      if (self%measure%power() == 2) factors = sqrt(factors)
   end function factors

   !> Does the factor depend on the wall, beyond its gravity?
   pure logical function needs_wall(self)
      class(scaling_type), intent(in) :: self

      needs_wall = any(wall_names == self%name)
   end function needs_wall

   !> Length of the unit
   pure integer function unit_length(self)
      class(scaling_type), intent(in) :: self

      unit_length = 0
      if (.not. self%needs_wall()) unit_length = len(self%measure%unit())
   end function unit_length

   !> Unit of the levels
   pure function unit(self)
      class(scaling_type), intent(in) :: self
      !> Unit; empty for a number
      character(len=unit_length(self)) :: unit

      if (len(unit) > 0) unit = self%measure%unit()
   end function unit

   !> The unit as it follows a number or a name
   pure function unit_after_blank(self) result(text)
      class(scaling_type), intent(in) :: self
      !> A blank and the unit; empty where there is none
      character(len=unit_length(self) + min(unit_length(self), 1)) :: text

      text = ' '//self%unit()
   end function unit_after_blank

   !> What it is, in words filled up with blanks
   pure function words_of(self) result(words)
      class(scaling_type), intent(in) :: self
      !> Words
      character(len=100) :: words

      select case (self%name)
      case ('pga/a0')
         words = 'PGA / trigger acceleration'
      case ('p*pgv/a0')
         words = 'p PGV / trigger acceleration'
      case default
         words = self%measure%title()
      end select
   end function words_of

   !> What it is, in words
   pure function title(self)
      class(scaling_type), intent(in) :: self
      !> Words
      character(len=len_trim(words_of(self))) :: title

      title = words_of(self)
   end function title

end module dondolo_fragility_scaling
