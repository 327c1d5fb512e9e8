!> What a user should know of results that are correct but may mislead.
module dondolo_warnings
   use, intrinsic :: iso_fortran_env, only : int64
   use dondolo_fragility, only : fragility_type, status_names
   use dondolo_kinds, only : wp
   use dondolo_lines, only : line_type, lines_type
   use dondolo_record, only : record_type
   use dondolo_record_table, only : pga_problem
   use dondolo_response, only : largest_sure_error, response_type
   use dondolo_stripes, only : stripes_type
   use dondolo_text, only : rounded, to_text
   use dondolo_typology, only : typology_type
   use dondolo_wall, only : wall_type
   implicit none
   private

   public :: scale_warning_type, fit_warning_type, warn_of_records, warn_of_fit, warn_of_error, warn_of_errors

   !> A record scaled by more than this hardly is the earthquake it was
   real(wp), parameter :: large_scale = 10.0_wp

   !> What there is to say of scale factors
   type :: scale_warning_type
      !> Histories looked at
      integer(int64) :: histories = 0
      !> Histories with a large factor
      integer(int64) :: large = 0
      !> The largest factor
      real(wp) :: largest = 0.0_wp
      !> Its level
      real(wp) :: level = 0.0_wp
      !> Its record
      character(len=:), allocatable :: record
   contains
      !> Look at the factors of a wall
      procedure :: look
      !> Warn, if there is reason to
      procedure :: warn
   end type scale_warning_type

   !> Statuses of a fit that there is something to say of
   character(len=len(status_names)), parameter :: telling(7) = [character(len=len(status_names)) :: 'no_collapse', &
      & 'all_collapse', 'separated', 'single_level', 'decreasing', 'not_converged', 'extrapolated']

   !> What there is to say of the curves of a population
   type :: fit_warning_type
      !> Curves looked at
      integer :: curves = 0
      !> How many have each status
      integer :: number(size(telling)) = 0
      !> Wall of the first with each
      type(line_type) :: first(size(telling))
      !> Wall of the curve looked at last
      character(len=:), allocatable :: last
      !> Has a wall several mechanisms?
      logical :: several = .false.
   contains
      !> Look at the curve of a wall
      procedure :: look => look_at_curve
      !> Warn, if there is reason to
      procedure :: warn => warn_of_fits
   end type fit_warning_type

contains

   !> Look at the factors of a wall
   subroutine look(self, stripes, records)
      !> What there is to say
      class(scale_warning_type), intent(inout) :: self
      !> Stripes of the wall
      type(stripes_type), intent(in) :: stripes
      !> Records
      type(record_type), intent(in) :: records(:)

      integer :: at(2)

      self%histories = self%histories + size(stripes%scale, kind=int64)
      self%large = self%large + count(stripes%scale > large_scale, kind=int64)
      at = maxloc(stripes%scale)
      if (.not. stripes%scale(at(1), at(2)) > self%largest) return
      self%largest = stripes%scale(at(1), at(2))
      self%level = stripes%levels(at(2))
      self%record = records(stripes%record(at(1)))%name
   end subroutine look

   !> Warn, if there is reason to
   subroutine warn(self, warnings)
      !> What there is to say
      class(scale_warning_type), intent(in) :: self
      !> Warnings to add to
      type(lines_type), intent(inout) :: warnings

      if (self%large > 0) call warnings%add('scale factors above '//to_text(large_scale)//' in '// &
         & to_text(self%large)//' of '//to_text(self%histories)//' histories, the largest '//rounded(self%largest)// &
         & ' (record '''//self%record//''' at level '//rounded(self%level)//')')
   end subroutine warn

   !> Warn of records without motion, and of those whose PGA no accelerograph has measured
   subroutine warn_of_records(records, peaks, gravity, warnings)
      !> Records
      type(record_type), intent(in) :: records(:)
      !> Their PGA [m/s2]
      real(wp), intent(in) :: peaks(:)
      !> What g is [m/s2]
      real(wp), intent(in) :: gravity
      !> Warnings to add to
      type(lines_type), intent(inout) :: warnings

      character(len=:), allocatable :: problem, first, which
      integer :: i, number

      number = 0
      do i = 1, size(records)
         if (.not. peaks(i) > 0.0_wp) then
            call warnings%add('record '''//records(i)%name//''' has a PGA of 0: it cannot be scaled and moves no wall')
            cycle
         end if
         problem = pga_problem(peaks(i), gravity)
         if (len(problem) == 0) cycle
         number = number + 1
         if (number == 1) first = 'record '''//records(i)%name//''': '//problem
      end do
      if (number == 0) return
      which = ''
      if (size(records) > 1) which = ' ('//to_text(number)//' of '//to_text(size(records))//' records)'
      call warnings%add(first//which)
   end subroutine warn_of_records

   !> Warn of the curve of one wall
   subroutine warn_of_fit(wall, stripes, fragility, warnings)
      !> The wall
      type(wall_type), intent(in) :: wall
      !> Its stripes
      type(stripes_type), intent(in) :: stripes
      !> Its curve
      type(fragility_type), intent(in) :: fragility
      !> Warnings to add to
      type(lines_type), intent(inout) :: warnings

      character(len=:), allocatable :: levels, none
      real(wp) :: largest

      levels = to_text(stripes%levels(1))//' to '//to_text(stripes%levels(size(stripes%levels)))
      if (size(stripes%levels) == 1) levels = to_text(stripes%levels(1))
      none = ', no curve is fitted: '
      largest = maxval(stripes%response%edp)
      select case (fragility%status)
      case ('no_collapse')
         if (largest > 0.0_wp) then
            call warnings%add('no collapse at levels '//levels//none//'the largest EDP is '//rounded(largest)// &
               & ', higher levels are needed')
         else
            call warnings%add('no motion at levels '//levels//none//'the wall begins to rock at '// &
               & rounded(wall%mechanism%trigger_acceleration()/wall%gravity)//' g, higher levels are needed')
         end if
      case ('all_collapse')
         call warnings%add('every history collapses at levels '//levels//none//'lower levels are needed')
      case ('single_level')
         call warnings%add('only one level, '//levels//none//'two at least are needed')
      case ('decreasing')
         call warnings%add('collapses do not become more frequent with the level'//none// &
            & 'their trend is flat or falling')
      case ('not_converged')
         call warnings%add('the fit does not converge at levels '//levels//', no curve is fitted')
      case ('separated')
         call warnings%add('all collapses lie at levels above the survivals, or share one level with them'//none// &
            & 'the median lies '//between(fragility%bracket)// &
            & ', more levels there are needed')
      case ('extrapolated')
         call warnings%add('theta = '//rounded(fragility%theta)//' lies outside the levels '//levels// &
            & ': the fit extrapolates')
      end select
   end subroutine warn_of_fit

   !> Look at the curve of a wall, or of its mechanisms one after the other
   subroutine look_at_curve(self, curve, name)
      !> What there is to say
      class(fit_warning_type), intent(inout) :: self
      !> Curve of the wall, or of one of its mechanisms
      type(fragility_type), intent(in) :: curve
      !> Name of the wall
      character(len=*), intent(in) :: name

      integer :: i

      self%curves = self%curves + 1
      if (allocated(self%last)) self%several = self%several .or. self%last == name
      self%last = name
      i = findloc(telling, curve%status, dim=1)
      if (i == 0) return
      self%number(i) = self%number(i) + 1
      if (self%number(i) == 1) self%first(i)%text = name
   end subroutine look_at_curve

   !> Warn of the curves of the walls, and of those fitted to the population
   subroutine warn_of_fits(self, typologies, warnings)
      !> What there is to say of the walls
      class(fit_warning_type), intent(in) :: self
      !> The curves of the population
      type(typology_type), intent(in) :: typologies(:)
      !> Warnings to add to
      type(lines_type), intent(inout) :: warnings

      character(len=:), allocatable :: consequence, whose, which, walls
      integer :: i

      walls = ' walls '
      if (self%several) walls = ' mechanisms of walls '
      do i = 1, size(telling)
         if (self%number(i) == 0) cycle
         if (telling(i) == 'extrapolated') then
            consequence = 'have a median outside the levels'
            if (self%number(i) == 1) consequence = 'has a median outside the levels'
         else
            consequence = 'have no fit and take part with their fractions of collapse'
            if (self%number(i) == 1) consequence = 'has no fit and takes part with its fractions of collapse'
         end if
         call warnings%add(to_text(self%number(i))//' of '//to_text(self%curves)//walls//consequence//' ('// &
            & trim(telling(i))//'; the first is '''//self%first(i)%text//''')')
      end do
      do i = 1, size(typologies)
         associate (group => typologies(i)%group, fit => typologies(i)%fit)
            whose = 'the population'
            if (len(group) > 0) whose = 'group '''//group//''''
            which = 'mechanism '//typologies(i)%mechanism
            if (.not. fit%has_fit()) then
               call warnings%add(whose//' has no fit ('//which//', status '//trim(fit%status)//')')
            else if (fit%status == 'extrapolated') then
               call warnings%add('the median of '//whose//', '//rounded(fit%theta)//' ('//which// &
                  & '), lies outside the levels: the fit extrapolates')
            end if
         end associate
      end do
   end subroutine warn_of_fits

   !> Warn of histories whose estimated error is large, and of collapses in doubt
   subroutine warn_of_errors(stripes, records, edp_limit, warnings)
      !> Stripes with estimated errors
      type(stripes_type), intent(in) :: stripes
      !> Records
      type(record_type), intent(in) :: records(:)
      !> Rotation / capacity at which the wall has collapsed
      real(wp), intent(in) :: edp_limit
      !> Warnings to add to
      type(lines_type), intent(inout) :: warnings

      character(len=:), allocatable :: of_all
      integer :: at(2), number

      of_all = ' of '//to_text(size(stripes%response))//' histories'
      number = count(stripes%response%is_ill_conditioned())
      if (number > 0) then
         at = maxloc(stripes%response%edp_error)
         call warnings%add('ill-conditioned: '//to_text(number)//of_all// &
            & ' with an estimated error of the EDP above '//to_text(largest_sure_error)//'; the largest is '// &
            & rounded(stripes%response(at(1), at(2))%edp_error)//' (record '''// &
            & records(stripes%record(at(1)))%name//''' at level '//rounded(stripes%levels(at(2)))//')')
      end if
      number = count(stripes%response%is_unsure(edp_limit))
      if (number > 0) call warnings%add('collapse or not is in doubt, by the estimated error, in '// &
         & to_text(number)//of_all)
   end subroutine warn_of_errors

   !> Warn of one history in the same words
   subroutine warn_of_error(response, edp_limit, warnings)
      !> The history with its estimated error
      type(response_type), intent(in) :: response
      !> Rotation / capacity at which the wall has collapsed
      real(wp), intent(in) :: edp_limit
      !> Warnings to add to
      type(lines_type), intent(inout) :: warnings

      if (response%is_ill_conditioned()) call warnings%add('ill-conditioned: the estimated error of the EDP is '// &
         & rounded(response%edp_error)//', above '//to_text(largest_sure_error))
      if (response%is_unsure(edp_limit)) call warnings%add('collapse or not is in doubt, by the estimated error')
   end subroutine warn_of_error

   !> Where a bracket lies: between two levels, or above or below one
   pure function between(bracket) result(text)
      !> Levels; 0 or huge where the side is open
      real(wp), intent(in) :: bracket(2)
      !> Its text
      character(len=:), allocatable :: text

      if (bracket(2) >= huge(bracket)) then
         text = 'above '//to_text(bracket(1))
      else if (.not. bracket(1) > 0.0_wp) then
         text = 'below '//to_text(bracket(2))
      else
         text = 'between '//to_text(bracket(1))//' and '//to_text(bracket(2))
      end if
   end function between

end module dondolo_warnings
