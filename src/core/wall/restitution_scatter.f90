!> Scatter of the restitution: a speed ratio for each impact of a history.
!>
!> Ratios are uniform about their mean, thus within bounds: published tests give a range, and no distribution within it; and a
!> chain of bounces ends for certain only if no ratio can be 1 (docs/theory.md, section 3).
module dondolo_wall_restitution_scatter
   use dondolo_base_error, only : error_type, out_of_range, raise_input
   use dondolo_base_fingerprint, only : fingerprint_type
   use dondolo_base_kinds, only : wp
   use dondolo_base_text, only : brief, to_text
   use dondolo_record_random, only : jumps_type, new_hashed_random, random_type
   implicit none
   private

   public :: restitution_scatter_type, new_restitution_scatter

   !> Half the width of a uniform distribution / its standard deviation
   real(wp), parameter :: half_width_of_sd = sqrt(3.0_wp)

   !> Speed ratios about a mean
   type :: restitution_scatter_type
      private
      !> Mean, and half the width of their distribution; 0: every impact has the mean
      real(wp) :: mean = 0.0_wp, half_width = 0.0_wp
      !> Seed of the random numbers
      integer :: seed = 1
      !> Random numbers of the present history
      type(random_type) :: random
   contains
      !> Whether the ratio varies
      procedure :: exists
      !> Largest ratio
      procedure :: largest
      !> A history begins
      procedure :: begin
      !> Ratio of the next impact
      procedure :: draw
   end type restitution_scatter_type

contains

   !> Make the scatter about a speed ratio, and check that every ratio is one
   subroutine new_restitution_scatter(scatter, mean, sd, seed, error)
      type(restitution_scatter_type), intent(out) :: scatter
      !> Mean speed ratio, 0 <= e < 1
      real(wp), intent(in) :: mean
      !> Standard deviation, at least 0
      real(wp), intent(in) :: sd
      !> Seed, positive
      integer, intent(in) :: seed
      !> Ratios would be negative, or 1 or more
      type(error_type), allocatable, intent(out) :: error

      scatter%mean = mean
      scatter%half_width = half_width_of_sd*sd
      scatter%seed = seed
      if (.not. mean - scatter%half_width < 0.0_wp .and. mean + scatter%half_width < 1.0_wp) return
      call raise_input(error, 'restitution_sd = '//to_text(sd)//': must be at most '// &
         & brief(min(mean, 1.0_wp - mean)/half_width_of_sd)//', so that all values of the uniform distribution of e about '// &
         & brief(mean)//' lie between 0 and 1', out_of_range, 'restitution_sd')
   end subroutine new_restitution_scatter

   !> Whether the ratio varies from impact to impact
   elemental logical function exists(self)
      class(restitution_scatter_type), intent(in) :: self

      exists = self%half_width > 0.0_wp
   end function exists

   !> Largest ratio, less than 1
   elemental real(wp) function largest(self)
      class(restitution_scatter_type), intent(in) :: self

      largest = self%mean + self%half_width
   end function largest

   !> A history begins: its ratios depend on the seed and on the record, thus on no other history, and are the same at every level
   pure subroutine begin(self, record, is_reversed, jumps)
      class(restitution_scatter_type), intent(inout) :: self
      !> Name of the record
      character(len=*), intent(in) :: record
      !> Whether it acts with the other polarity
      logical, intent(in) :: is_reversed
      !> Jumps of the random numbers; absent: they are made
      type(jumps_type), intent(in), optional :: jumps

      type(fingerprint_type) :: fingerprint

      if (.not. self%exists()) return
      call fingerprint%add_text(record)
      call fingerprint%add_integer(merge(1, 0, is_reversed))
      self%random = new_hashed_random(self%seed, int(fingerprint%value(1)), jumps)
   end subroutine begin

   !> Ratio of the next impact
   pure subroutine draw(self, ratio)
      class(restitution_scatter_type), intent(inout) :: self
      !> The ratio; unchanged if it does not vary
      real(wp), intent(inout) :: ratio

      real(wp) :: uniform

      if (.not. self%exists()) return
      call self%random%draw(uniform)
      ratio = self%mean + self%half_width*(2.0_wp*uniform - 1.0_wp)
   end subroutine draw

end module dondolo_wall_restitution_scatter
