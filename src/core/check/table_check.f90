!> Tabulated walls in a check: weights of bodies and loads, how far each moves outwards for a unit of rotation, and over the
!> rotation the displacement d of the equivalent oscillator and sum W x'. M and L are those of the equation of motion.
!>
!>     alpha(q) = M(q)/sum W x'(q)     M* = (sum W delta)^2/(g sum W delta^2)     delta = x'(0)
!>
!> Two of these numbers follow from the others at rest, which finds slips: sum W x'(0) = sum W delta, and d'(0) =
!> sum W delta^2/sum W delta, whatever point of control d_C of C8.7.1.4 is.
module dondolo_check_table_check
   use dondolo_base_bracket, only : bracket_type
   use dondolo_base_chebyshev, only : chebyshev_slope, chebyshev_value
   use dondolo_base_error, only : error_type, not_given, out_of_range, raise_input
   use dondolo_base_kinds, only : wp
   use dondolo_base_text, only : rounded
   use dondolo_wall_table_fit, only : fit_table
   use dondolo_wall_tabulated, only : largest_misfit, tabulated_type
   use dondolo_wall_tabulated_model, only : tabulated_model_type
   implicit none
   private

   public :: new_table_check, table_check_type

   !> How much two ways to the same number may differ: of the lever of the table and the weights, of columns that are typed, and of
   !> the slope of a polynomial
   real(wp), parameter :: exact = 1.0e-6_wp, typed = 1.0e-3_wp, sloped = 1.0e-2_wp

   !> Parts of the range in which the displacement is seen to grow
   integer, parameter :: places = 200

   !> What a check knows of the table
   type :: table_check_type
      !> Last rotation [rad], and that at which the moment vanishes
      real(wp), private :: last = 0.0_wp, capacity = 0.0_wp
      !> Chebyshev series of d [m] and of sum W x' [N m/m]
      real(wp), allocatable, private :: travel(:), lever(:)
   contains
      procedure :: displacement
      procedure, private :: fitted
      procedure :: rotation
      procedure :: weighted_lever
   end type table_check_type

contains

   !> Make it
   subroutine new_table_check(check, model, mechanism, error)
      type(table_check_type), intent(out) :: check
      class(tabulated_model_type), intent(in) :: model
      type(tabulated_type), intent(in) :: mechanism
      !> A table that does not have what a check needs, or does not agree with itself
      type(error_type), allocatable, intent(out) :: error

      real(wp) :: first, slope
      integer :: i

      if (size(model%weight) == 0) then
         call raise_input(error, 'weight: must be given for the kinematic check of mechanism = ''tabulated'': the lists weight '// &
            & '[N/m] and displacement, of each body and load its weight and how far it moves outwards for a unit of rotation '// &
            & 'at rest [m], and over the rotation travel [m], d of C8.7.1.4; with loads also weighted_lever', not_given, 'weight')
         return
      end if
      check%last = mechanism%last
      check%capacity = mechanism%capacity
      first = sum(model%weight*model%displacement)
      call fit('travel', model%travel, check%travel)
      if (size(model%weighted_lever) > 0) then
         call fit('weighted_lever', model%weighted_lever, check%lever)
         if (.not. allocated(error)) call compare('weighted_lever', check%weighted_lever(0.0_wp), first, typed)
      else
         check%lever = mechanism%gravity*mechanism%lever
         call compare('weighted_lever', check%weighted_lever(0.0_wp), first, exact)
      end if
      if (allocated(error)) return
      slope = 2.0_wp/check%last*chebyshev_value(chebyshev_slope(check%travel), -1.0_wp)
      if (abs(check%fitted(0.0_wp)) > typed*check%fitted(check%capacity)) then
         call raise_input(error, 'travel: begins at '//rounded(check%fitted(0.0_wp))//' m, must begin at 0', out_of_range, &
            & 'travel')
      else if (abs(slope*first - sum(model%weight*model%displacement**2)) > sloped*slope*first) then
         call raise_input(error, 'travel: begins with '//rounded(slope)//' m for a unit of rotation, must begin with '// &
            & rounded(sum(model%weight*model%displacement**2)/first)//' m, sum W delta^2/sum W delta of weight and '// &
            & 'displacement (C8.7.1.4)', out_of_range, 'travel')
      end if
      do i = 1, places
         if (allocated(error)) return
         if (.not. check%fitted(at(i)) > check%fitted(at(i - 1))) call raise_input(error, 'travel: must grow up to '// &
            & 'the rotation at which the moment vanishes, does not at '//rounded(at(i))//' rad', out_of_range, 'travel')
         if (.not. check%weighted_lever(at(i)) > 0.0_wp) call raise_input(error, 'weighted_lever: must be positive up to the '// &
            & 'rotation at which the moment vanishes, is not at '//rounded(at(i))//' rad', out_of_range, 'weighted_lever')
      end do

   contains

      !> A rotation up to the capacity
      pure real(wp) function at(i)
         integer, intent(in) :: i

         at = check%capacity*real(i, wp)/real(places, wp)
      end function at

      !> Fit a column
      subroutine fit(name, values, series)
         character(len=*), intent(in) :: name
         real(wp), intent(in) :: values(:)
         real(wp), allocatable, intent(out) :: series(:)

         real(wp) :: misfit

         if (allocated(error)) return
         call fit_table(model%table%rotation, values, series, misfit)
         if (misfit > largest_misfit) call raise_input(error, name//': the smooth curve through its values misses them by up '// &
            & 'to '//rounded(100.0_wp*misfit)//' % of the largest, must be within '//rounded(100.0_wp*largest_misfit)//' %', &
            & out_of_range, name)
      end subroutine fit

      !> Compare the lever at rest with that of the weights
      subroutine compare(name, lever, weights, tolerance)
         character(len=*), intent(in) :: name
         !> [N m/m]
         real(wp), intent(in) :: lever, weights
         !> Difference that may be / weights
         real(wp), intent(in) :: tolerance

         if (weights > 0.0_wp .and. abs(lever - weights) <= tolerance*weights) return
         if (tolerance > exact) then
            call raise_input(error, name//': is '//rounded(lever)//' N m/m at rest, must be '//rounded(weights)// &
               & ', the sum of weight times displacement', out_of_range, name)
         else
            call raise_input(error, name//': must be given: at rest the sum of weight times displacement is '//rounded(weights)// &
               & ' N m/m, and gravity times lever is '//rounded(lever)//', so that something is carried, or a weight is missing', &
               & not_given, name)
         end if
      end subroutine compare

   end subroutine new_table_check

   !> Displacement d of the equivalent oscillator [m]
   pure real(wp) function displacement(self, q)
      class(table_check_type), intent(in) :: self
      !> Rotation [rad]
      real(wp), intent(in) :: q

      displacement = 0.0_wp
      if (q > 0.0_wp) displacement = max(0.0_wp, self%fitted(q))
   end function displacement

   !> The same by its series, which at rest is 0 but for rounding, of either sign [m]
   pure real(wp) function fitted(self, q)
      class(table_check_type), intent(in) :: self
      !> Rotation [rad]
      real(wp), intent(in) :: q

      fitted = chebyshev_value(self%travel, 2.0_wp*q/self%last - 1.0_wp)
   end function fitted

   !> Rotation at a displacement
   pure real(wp) function rotation(self, d)
      class(table_check_type), intent(in) :: self
      !> From 0 to that at the capacity [m]
      real(wp), intent(in) :: d

      type(bracket_type) :: bracket

      rotation = 0.0_wp
      if (.not. d > self%displacement(0.0_wp)) return
      bracket = bracket_type(0.0_wp, self%capacity)
      do while (bracket%is_divisible())
         call bracket%halve(self%displacement(bracket%middle()) < d)
      end do
      rotation = bracket%middle()
   end function rotation

   !> Sum W x' [N m/m]
   pure real(wp) function weighted_lever(self, q)
      class(table_check_type), intent(in) :: self
      !> Rotation [rad]
      real(wp), intent(in) :: q

      weighted_lever = chebyshev_value(self%lever, 2.0_wp*q/self%last - 1.0_wp)
   end function weighted_lever

end module dondolo_check_table_check
