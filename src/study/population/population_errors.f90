!> Standard errors of the curves of a population, clustered by record and by wall.
!>
!> All walls are subjected to the same records, and a population is a sample of the walls that there could be. The records
!> of a cluster and the mechanisms of a wall depend on each other in any way; both kinds of clusters add their covariance.
!> What belongs to a record and a wall alone is counted in both, which errs on the side of wide intervals by about one part
!> in the number of walls or of records. Fractions of a wall with several mechanisms are taken as linear in those
!> of its mechanisms; those of a wall in whose histories any of several mechanisms is counted are its own. Every stripe of a
!> wall counts for one.
module dondolo_population_errors
   use dondolo_base_error, only : error_type
   use dondolo_base_kinds, only : wp
   use dondolo_base_memory, only : check_room
   use dondolo_fragility, only : fragility_type
   use dondolo_fragility_clustered, only : cluster_errors, fewest_clusters, leave_out_type
   use dondolo_population, only : part_type, population_type
   use dondolo_population_occurrence, only : wall_probability, wall_slopes
   use dondolo_population_typology, only : typology_type
   use dondolo_population_unions, only : curves_with_mean, unions_type
   implicit none
   private

   public :: population_errors_type, curve_sums_type

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
      !> Change of ln theta and beta if each cluster of records, or each wall, is left out (parameter, cluster), if they are
      !> kept
      real(wp), allocatable :: record_change(:, :), wall_change(:, :)
   end type curve_sums_type

   !> The curves of a population, wall after wall
   type :: population_errors_type
      !> Levels of intensity
      real(wp), allocatable :: levels(:)
      !> Records of each cluster that run at each level, over all records (levels, clusters)
      real(wp), allocatable :: share(:, :)
      !> The sum over the clusters
      real(wp), allocatable :: run(:)
      !> The curves (curve, state), and the means of unions (mean, state)
      type(curve_sums_type), allocatable :: curve(:, :), mean(:, :)
   contains
      !> Take the curves
      procedure :: begin
      !> Take a wall
      procedure :: add
      !> Set the standard errors of the curves
      procedure :: finish
      !> Set the standard errors of the means of unions
      procedure :: finish_means
   end type population_errors_type

contains

   !> Take the curves
   subroutine begin(self, typologies, population, share, error, keeps_changes)
      class(population_errors_type), intent(out) :: self
      !> Curves (curve, state), those of a group one after the other
      type(typology_type), intent(in) :: typologies(:, :)
      !> The population, fitted
      type(population_type), intent(in) :: population
      !> Records of each cluster that run at each level, over all records (levels, clusters)
      real(wp), intent(in) :: share(:, :)
      !> Lack of memory
      type(error_type), allocatable, intent(out) :: error
      !> Are the changes of the curves kept, cluster by cluster and wall by wall?
      logical, intent(in) :: keeps_changes

      real(wp), parameter :: bytes_of_number = real(storage_size(1.0_wp)/8, wp)
      real(wp) :: numbers
      integer, allocatable :: means(:)
      integer :: i, k

      allocate (means(0))
      if (size(typologies) > 0) means = curves_with_mean(population, typologies(:, 1))
      numbers = real(size(share) + 10*size(share, 1), wp)
      if (keeps_changes) numbers = numbers + 2.0_wp*real(population%walls + size(share, 2), wp)
      call check_room(bytes_of_number*real(size(typologies) + size(means)*size(typologies, 2), wp)*numbers, error)
      if (allocated(error)) return
      self%levels = population%levels
      self%share = share
      self%run = sum(share, dim=2)
      allocate (self%curve(size(typologies, 1), size(typologies, 2)), self%mean(size(means), size(typologies, 2)))
      do k = 1, size(typologies, 2)
         do i = 1, size(typologies, 1)
            call begin_curve(self%curve(i, k), typologies(i, k), population, share, keeps_changes)
            if (typologies(i, k)%fit%has_fit()) call self%curve(i, k)%fit%begin(typologies(i, k)%fit, self%levels, self%run)
         end do
         do i = 1, size(means)
            call begin_curve(self%mean(i, k), typologies(means(i), k), population, share, keeps_changes)
         end do
      end do
   end subroutine begin

   !> Begin a curve
   subroutine begin_curve(curve, typology, population, share, keeps_changes)
      type(curve_sums_type), intent(out) :: curve
      !> The curve, or one of the same walls
      type(typology_type), intent(in) :: typology
      type(population_type), intent(in) :: population
      !> Records of each cluster that run at each level, over all records (levels, clusters)
      real(wp), intent(in) :: share(:, :)
      !> Are its changes kept?
      logical, intent(in) :: keeps_changes

      curve%part = typology%part
      curve%total = typology%weight*typology%upper_asymptote
      allocate (curve%deviation(size(share, 1), size(share, 2)), source=0.0_wp)
      if (.not. keeps_changes) return
      allocate (curve%record_change(2, size(share, 2)), source=0.0_wp)
      allocate (curve%wall_change(2, population%walls_in(typology%part)), source=0.0_wp)
   end subroutine begin_curve

   !> Take a wall
   pure subroutine add(self, population, number, counts, united)
      class(population_errors_type), intent(inout) :: self
      !> The population: rows have their standard errors, those of the curve of the wall are set
      type(population_type), intent(inout) :: population
      !> Number of the wall
      integer, intent(in) :: number
      !> Histories of each cluster that reach each state, over all records (levels, clusters, states, mechanisms)
      real(wp), intent(in) :: counts(:, :, :, :)
      !> Histories of each cluster in which any of its mechanisms reaches each state, over all records (levels, clusters,
      !> states), of a wall with several
      real(wp), intent(in), optional :: united(:, :, :)

      ! Of the rows of the wall and, last, of the wall as a whole
      real(wp) :: fraction(size(counts, 1), size(counts, 4) + 1), deviation(size(counts, 1), size(counts, 2), size(counts, 4) + 1)
      real(wp) :: slope(size(counts, 1), size(counts, 4)), weight
      real(wp), allocatable :: p_occ(:)
      integer, allocatable :: alternative(:)
      integer :: columns(size(counts, 4) + 1), i, g, k, m, last

      last = size(columns)
      columns = [(population%first(number) + m - 1, m=1, last - 1), population%rows + number]
      call population%get_occurrence(columns(last), p_occ, alternative)
      do k = 1, size(counts, 3)
         fraction(:, :last - 1) = sum(counts(:, :, k, :), dim=2)/spread(self%run, 2, last - 1)
         fraction(:, last) = wall_probability(p_occ, alternative, fraction(:, :last - 1))
         slope = wall_slopes(p_occ, alternative, fraction(:, :last - 1))
         deviation(:, :, last) = 0.0_wp
         do m = 1, last - 1
            do g = 1, size(counts, 2)
               deviation(:, g, m) = counts(:, g, k, m) - self%share(:, g)*fraction(:, m)
               deviation(:, g, last) = deviation(:, g, last) + slope(:, m)*deviation(:, g, m)
            end do
         end do
         associate (curve => population%curve(k, population%place(columns(last))), row => population%curve(k, columns(1)))
            if (last > 2) then
               call set_errors_of_wall(curve, self, population%occurrence(columns(last)), fraction(:, last), deviation(:, :, last))
            else if (population%place(columns(last)) > population%rows .and. curve%has_fit()) then
               ! One mechanism that may not occur has the curve of its row, and an upper asymptote.
               curve%covariance = row%covariance
               curve%errors = row%errors
               curve%clusters = row%clusters
               curve%degrees_of_freedom = row%degrees_of_freedom
            end if
         end associate
         do i = 1, size(self%curve, 1)
            call take_columns(self%curve(i, k), population, columns, fraction, deviation, self%run)
         end do
         if (size(self%mean, 1) == 0) cycle
         if (present(united)) then
            fraction(:, last) = sum(united(:, :, k), dim=2)/self%run
            do g = 1, size(counts, 2)
               deviation(:, g, last) = united(:, g, k) - self%share(:, g)*fraction(:, last)
            end do
         end if
         do i = 1, size(self%mean, 1)
            weight = population%weight_in(self%mean(i, k)%part, columns(last))
            if (weight > 0.0_wp) self%mean(i, k)%deviation = self%mean(i, k)%deviation + weight*deviation(:, :, last)
         end do
      end do
   end subroutine add

   !> Take the part of a wall in a curve: the wall as a whole, or its rows of one mechanism
   pure subroutine take_columns(curve, population, columns, fraction, deviation, run)
      type(curve_sums_type), intent(inout) :: curve
      type(population_type), intent(in) :: population
      !> Columns of the rows and of the wall
      integer, intent(in) :: columns(:)
      !> Fractions of each at each level (levels, columns)
      real(wp), intent(in) :: fraction(:, :)
      !> Deviations of the clusters of records from them (levels, clusters, columns)
      real(wp), intent(in) :: deviation(:, :, :)
      !> Share of the records that run at each level
      real(wp), intent(in) :: run(:)

      real(wp) :: weight(size(columns)), mean(size(fraction, 1))
      integer :: m

      weight = population%weight_in(curve%part, columns)
      do m = 1, size(columns)
         if (weight(m) > 0.0_wp) curve%deviation = curve%deviation + weight(m)*deviation(:, :, m)
      end do
      select case (count(weight > 0.0_wp))
      case (0)
      case (1)
         m = findloc(weight > 0.0_wp, .true., dim=1)
         call leave_out(curve, weight(m), population%occurrence(columns(m)), fraction(:, m), run)
      case default
         ! Rows of one mechanism are left out with their wall.
         mean = matmul(fraction, weight)/sum(weight)
         call leave_out(curve, sum(weight), 1.0_wp, mean, run)
      end select
   end subroutine take_columns

   !> Set the standard errors of the curve of a wall with several mechanisms
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

   !> Leave a wall, or one of its mechanisms, out of a curve
   pure subroutine leave_out(curve, weight, occurrence, fraction, run)
      type(curve_sums_type), intent(inout) :: curve
      !> Its weight, positive
      real(wp), intent(in) :: weight
      !> Probability that it can collapse
      real(wp), intent(in) :: occurrence
      !> Its fractions at each level
      real(wp), intent(in) :: fraction(:)
      !> Share of the records that run at each level
      real(wp), intent(in) :: run(:)

      real(wp) :: change(2)
      logical :: ok

      curve%walls = curve%walls + 1
      if (.not. allocated(curve%fit%x) .or. .not. curve%is_determined) return
      call curve%fit%without(weight/curve%total*fraction*run, weight/curve%total*occurrence*run, change, ok)
      curve%is_determined = ok
      if (allocated(curve%wall_change)) curve%wall_change(:, curve%walls) = change
      curve%covariance(:, 1) = curve%covariance(:, 1) + change*change(1)
      curve%covariance(:, 2) = curve%covariance(:, 2) + change*change(2)
   end subroutine leave_out

   !> Set the standard errors of the curves: over records and, if there are several walls, over these
   pure subroutine finish(self, typologies)
      class(population_errors_type), intent(inout) :: self
      !> Curves (curve, state): covariance, clusters, errors and degrees of freedom of the fits are set
      type(typology_type), intent(inout) :: typologies(:, :)

      integer :: i, k

      do k = 1, size(typologies, 2)
         do i = 1, size(typologies, 1)
            call set_errors(self%curve(i, k), typologies(i, k)%fit, typologies(i, k)%mean_fraction, &
               & typologies(i, k)%upper_asymptote, self%levels, self%share)
         end do
      end do
   end subroutine finish

   !> Set the standard errors of the means of unions: over records and, if there are several walls, over these
   pure subroutine finish_means(self, unions, population)
      class(population_errors_type), intent(inout) :: self
      !> Unions: covariance, clusters, errors and degrees of freedom of the curves of the means are set
      type(unions_type), intent(inout) :: unions
      !> The population, fitted
      type(population_type), intent(in) :: population

      real(wp) :: weight, fraction(size(self%levels))
      integer :: i, k, wall, united

      do k = 1, size(self%mean, 2)
         do i = 1, size(self%mean, 1)
            associate (curve => self%mean(i, k), mean => unions%mean(i))
               if (.not. mean%curve(k)%has_fit()) cycle
               call curve%fit%begin(mean%curve(k), self%levels, self%run)
               united = 0
               do wall = 1, population%walls
                  if (population%is_several(wall)) united = united + 1
                  weight = population%weight_in(curve%part, population%rows + wall)
                  if (.not. weight > 0.0_wp) cycle
                  fraction = population%fraction(population%rows + wall, k)
                  if (population%is_several(wall)) fraction = unions%fraction(united, k)
                  call leave_out(curve, weight, population%occurrence(population%rows + wall), fraction, self%run)
               end do
               call set_errors(curve, mean%curve(k), mean%fraction(:, k), mean%upper_asymptote, self%levels, self%share)
            end associate
         end do
      end do
   end subroutine finish_means

   !> Set the standard errors of a curve: over records and, if there are several walls, over these
   pure subroutine set_errors(curve, fit, fraction, upper_asymptote, levels, share)
      !> What is known of the curve
      type(curve_sums_type), intent(inout) :: curve
      !> Its fit: covariance, clusters, errors and degrees of freedom are set
      type(fragility_type), intent(inout) :: fit
      !> Its fractions at each level, and what they tend to
      real(wp), intent(in) :: fraction(:), upper_asymptote
      !> Levels of intensity
      real(wp), intent(in) :: levels(:)
      !> Records of each cluster that run at each level, over all records (levels, clusters)
      real(wp), intent(in) :: share(:, :)

      real(wp), dimension(size(share, 1), size(share, 2)) :: counts
      real(wp) :: changes(2, size(share, 2))
      integer :: g

      if (.not. fit%has_fit()) return
      do g = 1, size(counts, 2)
         counts(:, g) = share(:, g)*fraction/upper_asymptote + curve%deviation(:, g)/curve%total
      end do
      call cluster_errors(fit, levels, counts, share, changes)
      if (allocated(curve%record_change)) curve%record_change = changes
      if (fit%errors == 'clustered' .and. curve%walls > 1) call add_walls(curve, fit)
   end subroutine set_errors

   !> Add the covariance by walls to that by records; degrees of freedom after Satterthwaite, for ln theta
   pure subroutine add_walls(curve, fit)
      type(curve_sums_type), intent(in) :: curve
      !> Curve with the covariance by records
      type(fragility_type), intent(inout) :: fit

      real(wp) :: both(2)

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
   end subroutine add_walls

end module dondolo_population_errors
