!> Standard errors of the curves of a population, clustered by record and by wall.
!>
!> All walls are subjected to the same records, and a population is a sample of the walls that there could be. The records
!> of a cluster and the mechanisms of a wall depend on each other in any way; both kinds of clusters add their covariance.
!> What belongs to a record and a wall alone is counted in both, which errs on the side of wide intervals by about one part
!> in the number of walls or of records. Fractions of a wall whose mechanisms are in series are taken as linear in those
!> of its mechanisms. Every stripe of a wall counts for one.
module dondolo_population_errors
   use dondolo_base_error, only : error_type
   use dondolo_base_kinds, only : wp
   use dondolo_base_memory, only : check_room
   use dondolo_fragility, only : fragility_type
   use dondolo_fragility_clustered, only : cluster_errors, fewest_clusters, leave_out_type
   use dondolo_population, only : part_type, population_type
   use dondolo_population_series, only : in_series, series_slopes
   use dondolo_population_typology, only : typology_type
   implicit none
   private

   public :: population_errors_type

   !> What is known of a curve from the walls so far
   type :: curve_sums_type
      !> The part of the population that it is of
      type(part_type) :: part
      !> Sum of the weights of what can collapse in all its walls
      real(wp) :: total = 0.0_wp
      !> Sum of weights and deviations of the clusters of records (levels, clusters)
      real(wp), allocatable :: deviation(:, :)
      !> The curve, with histories of one a level
      type(leave_out_type) :: fit
      !> Walls so far, and whether the curve is determined without each of them
      integer :: walls = 0
      logical :: is_determined = .true.
      !> Sum of the covariances by walls
      real(wp) :: covariance(2, 2) = 0.0_wp
   end type curve_sums_type

   !> The curves of a population, wall after wall
   type :: population_errors_type
      private
      !> Levels of intensity
      real(wp), allocatable :: levels(:)
      !> Records of each cluster that run at each level, over all records (levels, clusters)
      real(wp), allocatable :: share(:, :)
      !> The sum over the clusters
      real(wp), allocatable :: run(:)
      !> The curves (curve, state)
      type(curve_sums_type), allocatable :: curve(:, :)
   contains
      !> Take the curves
      procedure :: begin
      !> Take a wall
      procedure :: add
      !> Set the standard errors of the curves
      procedure :: finish
   end type population_errors_type

contains

   !> Take the curves
   subroutine begin(self, typologies, population, share, error)
      class(population_errors_type), intent(out) :: self
      !> Curves (curve, state), those of a group one after the other
      type(typology_type), intent(in) :: typologies(:, :)
      !> The population, fitted
      type(population_type), intent(in) :: population
      !> Records of each cluster that run at each level, over all records (levels, clusters)
      real(wp), intent(in) :: share(:, :)
      !> Lack of memory
      type(error_type), allocatable, intent(out) :: error

      real(wp), parameter :: bytes_of_number = real(storage_size(1.0_wp)/8, wp)
      integer :: i, k

      call check_room(bytes_of_number*real(size(typologies), wp)*real(size(share) + 10*size(share, 1), wp), error)
      if (allocated(error)) return
      self%levels = population%levels
      self%share = share
      self%run = sum(share, dim=2)
      allocate (self%curve(size(typologies, 1), size(typologies, 2)))
      do k = 1, size(typologies, 2)
         do i = 1, size(typologies, 1)
            associate (curve => self%curve(i, k), typology => typologies(i, k))
               curve%part = typology%part
               curve%total = typology%weight*typology%saturation
               allocate (curve%deviation(size(share, 1), size(share, 2)), source=0.0_wp)
               if (typology%fit%has_fit()) call curve%fit%begin(typology%fit, self%levels, self%run)
            end associate
         end do
      end do
   end subroutine begin

   !> Take a wall
   pure subroutine add(self, population, number, counts)
      class(population_errors_type), intent(inout) :: self
      !> The population: of a wall with several mechanisms the standard errors of the curve of all of them are set
      type(population_type), intent(inout) :: population
      !> Number of the wall
      integer, intent(in) :: number
      !> Histories of each cluster that reach each state, over all records (levels, clusters, states, mechanisms)
      real(wp), intent(in) :: counts(:, :, :, :)

      ! Of the rows of the wall and, last, of the wall as a whole
      real(wp) :: fraction(size(counts, 1), size(counts, 4) + 1), deviation(size(counts, 1), size(counts, 2), size(counts, 4) + 1)
      real(wp) :: slope(size(counts, 1), size(counts, 4)), p_occ(size(counts, 4)), weight
      integer :: columns(size(counts, 4) + 1), i, g, k, m, last

      last = size(columns)
      columns = [(population%first(number) + m - 1, m=1, last - 1), population%rows + number]
      p_occ = population%row(columns(:last - 1))%p_occ
      do k = 1, size(counts, 3)
         fraction(:, :last - 1) = sum(counts(:, :, k, :), dim=2)/spread(self%run, 2, last - 1)
         fraction(:, last) = in_series(p_occ, fraction(:, :last - 1))
         slope = series_slopes(p_occ, fraction(:, :last - 1))
         deviation(:, :, last) = 0.0_wp
         do m = 1, last - 1
            do g = 1, size(counts, 2)
               deviation(:, g, m) = counts(:, g, k, m) - self%share(:, g)*fraction(:, m)
               deviation(:, g, last) = deviation(:, g, last) + slope(:, m)*deviation(:, g, m)
            end do
         end do
         if (last > 2) call set_errors_of_wall(population%curve(k, columns(last)), self, population%occurrence(columns(last)), &
            & fraction(:, last), deviation(:, :, last))
         do i = 1, size(self%curve, 1)
            do m = 1, last
               weight = population%weight_in(self%curve(i, k)%part, columns(m))
               if (weight > 0.0_wp) call take(self%curve(i, k), weight, population%occurrence(columns(m)), fraction(:, m), &
                  & deviation(:, :, m), self%run)
            end do
         end do
      end do
   end subroutine add

   !> Set the standard errors of the curve of a wall whose mechanisms are in series
   pure subroutine set_errors_of_wall(curve, sums, occurrence, fraction, deviation)
      type(fragility_type), intent(inout) :: curve
      type(population_errors_type), intent(in) :: sums
      !> Probability that the wall can collapse
      real(wp), intent(in) :: occurrence
      !> Its fractions at each level
      real(wp), intent(in) :: fraction(:)
      !> Deviations of the clusters from them (levels, clusters)
      real(wp), intent(in) :: deviation(:, :)

      real(wp), dimension(size(deviation, 1), size(deviation, 2)) :: counts
      real(wp) :: changes(2, size(deviation, 2))
      integer :: g

      if (.not. occurrence > 0.0_wp) return
      do g = 1, size(counts, 2)
         counts(:, g) = (sums%share(:, g)*fraction + deviation(:, g))/occurrence
      end do
      call cluster_errors(curve, sums%levels, counts, sums%share, changes)
   end subroutine set_errors_of_wall

   !> Take a wall, or one of its mechanisms, into a curve
   pure subroutine take(curve, weight, occurrence, fraction, deviation, run)
      type(curve_sums_type), intent(inout) :: curve
      !> Its weight, positive
      real(wp), intent(in) :: weight
      !> Probability that it can collapse
      real(wp), intent(in) :: occurrence
      !> Its fractions at each level
      real(wp), intent(in) :: fraction(:)
      !> Deviations of the clusters from them (levels, clusters)
      real(wp), intent(in) :: deviation(:, :)
      !> Share of the records that run at each level
      real(wp), intent(in) :: run(:)

      real(wp) :: change(2)
      logical :: ok

      curve%walls = curve%walls + 1
      curve%deviation = curve%deviation + weight*deviation
      if (.not. allocated(curve%fit%x) .or. .not. curve%is_determined) return
      call curve%fit%without(weight/curve%total*fraction*run, weight/curve%total*occurrence*run, change, ok)
      curve%is_determined = ok
      curve%covariance(:, 1) = curve%covariance(:, 1) + change*change(1)
      curve%covariance(:, 2) = curve%covariance(:, 2) + change*change(2)
   end subroutine take

   !> Set the standard errors of the curves: over records and, if there are several walls, over these
   pure subroutine finish(self, typologies)
      class(population_errors_type), intent(in) :: self
      !> Curves (curve, state): covariance, clusters, errors and degrees of freedom of the fits are set
      type(typology_type), intent(inout) :: typologies(:, :)

      real(wp), dimension(size(self%share, 1), size(self%share, 2)) :: counts
      real(wp) :: changes(2, size(self%share, 2))
      integer :: g, i, k

      do k = 1, size(typologies, 2)
         do i = 1, size(typologies, 1)
            associate (curve => self%curve(i, k), typology => typologies(i, k))
               if (.not. typology%fit%has_fit()) cycle
               do g = 1, size(counts, 2)
                  counts(:, g) = self%share(:, g)*typology%mean_fraction/typology%saturation &
                     & + curve%deviation(:, g)/curve%total
               end do
               call cluster_errors(typology%fit, self%levels, counts, self%share, changes)
               if (typology%fit%errors == 'clustered' .and. curve%walls > 1) call add_walls(curve, typology)
            end associate
         end do
      end do
   end subroutine finish

   !> Add the covariance by walls to that by records; degrees of freedom after Satterthwaite, for ln theta
   pure subroutine add_walls(curve, typology)
      type(curve_sums_type), intent(in) :: curve
      !> Curve with the covariance by records
      type(typology_type), intent(inout) :: typology

      real(wp) :: both(2)

      associate (fit => typology%fit)
         if (curve%walls < fewest_clusters .or. .not. curve%is_determined) then
            fit%errors = merge('few_walls', 'one_wall ', curve%walls < fewest_clusters)
            fit%clusters = curve%walls
            fit%covariance = 0.0_wp
            fit%degrees_of_freedom = 0.0_wp
            return
         end if
         both = [fit%covariance(1, 1), curve%covariance(1, 1)]
         if (sum(both) > 0.0_wp) fit%degrees_of_freedom = sum(both)**2/(both(1)**2/fit%degrees_of_freedom &
            & + both(2)**2/real(curve%walls - 1, wp))
         fit%covariance = fit%covariance + curve%covariance
      end associate
   end subroutine add_walls

end module dondolo_population_errors
