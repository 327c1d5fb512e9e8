!> The group &stripes: the intensity measure and its levels.
module dondolo_stripes_group
   use dondolo_error, only : error_type, raise_input
   use dondolo_kinds, only : wp
   use dondolo_namelist_group, only : group_type
   use dondolo_scaling, only : new_scaling, scaling_type
   use dondolo_settings, only : settings_type
   use dondolo_study, only : check_levels, check_thresholds
   use dondolo_text, only : to_text
   implicit none
   private

   public :: stripes_input_type, read_stripes_group, echo_stripes, check_states
   public :: stripes_variables

   !> Variables of the group
   character(len=14), parameter :: stripes_variables(6) = &
      & [character(len=14) :: 'im', 'levels', 'first', 'last', 'count', 'edp_thresholds']

   !> Those that give equally spaced levels
   character(len=5), parameter :: grid_variables(3) = [character(len=5) :: 'first', 'last', 'count']

   !> More levels or thresholds than these are surely a slip
   integer, parameter :: most_levels = 1000, most_thresholds = 100

   !> What is said of the stripes
   type :: stripes_input_type
      !> Intensity measure that the records are scaled by
      type(scaling_type) :: scaling
      !> Levels, in the unit of the intensity measure; not allocated: not given
      real(wp), allocatable :: levels(:)
      !> EDP thresholds, each a damage state; the last is the limit of the solver, collapse
      real(wp), allocatable :: thresholds(:)
   end type stripes_input_type

contains

   !> Read the group
   subroutine read_stripes_group(group, stripes, error)
      !> The group as it stands in the file
      type(group_type), intent(in) :: group
      !> What is said of the stripes
      type(stripes_input_type), intent(out) :: stripes
      !> What is wrong with it
      type(error_type), allocatable, intent(out) :: error

      character(len=:), allocatable :: im

      im = 'pga'
      call group%check_names(stripes_variables, error)
      if (.not. allocated(error)) call group%get_text('im', im, error)
      if (allocated(error)) return
      call new_scaling(stripes%scaling, trim(im), error)
      call group%locate(error)
      if (allocated(error)) return
      call read_grid(group, stripes, error)
      if (allocated(error)) return
      if (group%has('levels')) then
         if (allocated(stripes%levels)) then
            call raise_input(error, group%place()//': levels: give either levels or first, last and count'// &
               & group%in_line('levels'))
            return
         end if
         call group%get_reals('levels', stripes%levels, error)
         if (allocated(error)) return
         if (size(stripes%levels) > most_levels) then
            call group%refuse('levels', 'must be at most '//to_text(most_levels)//' values', error)
            return
         end if
      end if
      allocate (stripes%thresholds(0))
      if (group%has('edp_thresholds')) then
         call group%get_reals('edp_thresholds', stripes%thresholds, error)
         if (.not. allocated(error) .and. size(stripes%thresholds) > most_thresholds) &
            & call group%refuse('edp_thresholds', 'must be at most '//to_text(most_thresholds)//' values', error)
         if (allocated(error)) return
      end if
      if (.not. allocated(stripes%levels)) return
      call check_levels(stripes%levels, error)
      call group%locate(error)
   end subroutine read_stripes_group

   !> Check the EDP thresholds, and make collapse the last of them
   subroutine check_states(stripes, edp_limit, error)
      !> What is said of the stripes
      type(stripes_input_type), intent(inout) :: stripes
      !> Rotation / capacity at which the wall has collapsed
      real(wp), intent(in) :: edp_limit
      !> A threshold that cannot be
      type(error_type), allocatable, intent(out) :: error

      call check_thresholds(stripes%thresholds, edp_limit, error)
      if (allocated(error)) return
      stripes%thresholds = [pack(stripes%thresholds, stripes%thresholds < edp_limit), edp_limit]
   end subroutine check_states

   !> Read first, last and count, if they were given
   subroutine read_grid(group, stripes, error)
      !> The group as it stands in the file
      type(group_type), intent(in) :: group
      !> What is said of the stripes: equally spaced levels, both ends included
      type(stripes_input_type), intent(inout) :: stripes
      !> What is wrong with it
      type(error_type), allocatable, intent(out) :: error

      real(wp) :: first, last
      integer :: count, i

      if (.not. any([group%has('first'), group%has('last'), group%has('count')])) return
      do i = 1, size(grid_variables)
         if (group%has(trim(grid_variables(i)))) cycle
         call raise_input(error, group%place()//': '//trim(grid_variables(i))// &
            & ': must be given: first, last and count belong together'//group%in_line(''))
         return
      end do
      first = 0.0_wp
      last = 0.0_wp
      count = 0
      call group%get_real('first', first, error)
      if (.not. allocated(error)) call group%get_real('last', last, error)
      if (.not. allocated(error)) call group%get_integer('count', count, error)
      if (allocated(error)) return
      if (.not. first > 0.0_wp) then
         call group%refuse('first', 'must be positive', error)
      else if (.not. last > first) then
         call group%refuse('last', 'must be greater than first = '//to_text(first), error)
      else if (count < 2 .or. count > most_levels) then
         call group%refuse('count', 'must lie between 2 and '//to_text(most_levels), error)
      end if
      if (allocated(error)) return
      allocate (stripes%levels(count))
      do i = 1, count
         stripes%levels(i) = decimal((real(count - i, wp)*first + real(i - 1, wp)*last)/real(count - 1, wp))
      end do
      stripes%levels(1) = first
      stripes%levels(count) = last
   end subroutine read_grid

   !> The nearest number of 14 decimal digits: 0.4 and 0.2 are 0.6, not 0.6000000000000001
   pure function decimal(value) result(rounded)
      !> Number
      real(wp), intent(in) :: value
      !> The nearest short one
      real(wp) :: rounded

      character(len=32) :: buffer

      write (buffer, '(es32.13e4)') value
      read (buffer, *) rounded
   end function decimal

   !> Write the group as namelist text with every value in force
   subroutine echo_stripes(stripes, settings)
      !> What is said of the stripes
      type(stripes_input_type), intent(in) :: stripes
      !> Settings to add to
      type(settings_type), intent(inout) :: settings

      call settings%add('stripes', 'im', stripes%scaling%name)
      if (.not. allocated(stripes%levels)) return
      call settings%add('stripes', 'levels', stripes%levels)
      call settings%add('stripes', 'edp_thresholds', stripes%thresholds)
   end subroutine echo_stripes

end module dondolo_stripes_group
