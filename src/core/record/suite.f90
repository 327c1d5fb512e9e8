!> A suite of accelerograms, with all that histories need of them whatever the wall: their samples joined, their PGAs, and
!> the values of the measures that were asked for.
!>
!> It is made once and then only read, by as many threads as there are. `measure` alone adds to it, and may do so while
!> others read.
module dondolo_record_suite
   use dondolo_base_kinds, only : wp
   use dondolo_base_lines, only : lines_type
   use dondolo_base_order, only : make_order
   use dondolo_base_threads, only : team_of
   use dondolo_record, only : compute_extremes, record_type
   use dondolo_record_dead_channel, only : is_motion
   use dondolo_record_ground_motion, only : peak_velocity
   use dondolo_record_intensity, only : measure_type
   use dondolo_record_set, only : new_record_set, record_set_type
   implicit none
   private

   public :: suite_type, new_suite, new_motions

   !> Measures whose values a suite keeps; those of others are computed whenever they are asked for
   integer, parameter :: most_measures = 32

   !> Values of a measure
   type :: measured_type
      !> Name of the measure; not allocated: the place is free
      character(len=:), allocatable :: name
      !> Its values for the unscaled records
      real(wp), allocatable :: values(:)
      !> 1: name and values are complete
      integer :: is_complete = 0
   end type measured_type

   !> Accelerograms that histories of many walls share
   type :: suite_type
      !> The accelerograms
      type(record_type), allocatable :: records(:)
      !> Has any of them a vertical component?
      logical :: has_vertical = .false.
      !> The same, joined
      type(record_set_type) :: set
      !> Their PGA [m/s2]
      real(wp), allocatable :: peaks(:)
      !> Whether the ground moves (dondolo_record_dead_channel)
      logical, allocatable :: moves(:)
      !> Their PGV [m/s]
      real(wp), allocatable :: velocities(:)
      !> Largest downward acceleration of the ground under each [m/s2]
      real(wp), allocatable :: falls(:)
      !> The accelerograms by the length of their strong motion, the longest last: walls rock longest under it
      integer, allocatable :: by_duration(:)
      !> Number of the cluster of each: histories of one cluster are no independent evidence. Each is one by itself until
      !> dondolo_records_clusters has read of which earthquakes they are
      integer, allocatable :: clusters(:)
      !> Its label, empty for a record without one
      type(lines_type) :: labels
      !> Whether the earthquake of each is known
      logical, allocatable :: has_event(:)
      !> Whether each is a vertical component, and whether its date cannot be compared with those of others of its event; false
      !> until dondolo_records_clusters has read what is said of it
      logical, allocatable :: is_vertical(:), has_vague_date(:)
      !> Measures that were asked for, and how many places are taken; on the heap, for suites go through many hands and stacks
      !> may be small
      type(measured_type), allocatable, private :: measured(:)
      integer, private :: taken = 0
   contains
      !> Compute the values of a measure and keep them
      procedure :: measure
      !> Values of a measure
      procedure :: values
   end type suite_type

contains

   !> Make a suite of accelerograms of which nothing is known but their motion
   subroutine new_suite(suite, records, threads)
      type(suite_type), intent(out) :: suite
      !> Accelerograms, one at least; they are moved into the suite
      type(record_type), allocatable, intent(inout) :: records(:)
      !> Number of threads that join them, 0: all that OpenMP gives; one if absent
      integer, intent(in), optional :: threads

      real(wp) :: lowest, highest
      integer :: team, i

      team = 1
      if (present(threads)) team = threads
      call new_motions(suite, records, threads)
      associate (records => size(suite%records))
         allocate (suite%peaks(records), suite%moves(records), suite%clusters(records), suite%has_event(records), &
            & suite%velocities(records), suite%falls(records))
      end associate
      suite%has_event = .false.
      allocate (suite%is_vertical(size(suite%records)), suite%has_vague_date(size(suite%records)), source=.false.)
      do i = 1, size(suite%records)
         call compute_extremes(suite%records(i)%acceleration, lowest, highest)
         suite%peaks(i) = max(-lowest, highest)
         suite%moves(i) = is_motion(lowest, highest)
         suite%clusters(i) = i
         call suite%labels%add('')
      end do
      suite%falls(:) = suite%records%largest_fall()
      !$omp parallel do schedule(dynamic) num_threads(team_of(team, size(suite%records))) default(none) shared(suite)
      do i = 1, size(suite%records)
         suite%velocities(i) = peak_velocity(suite%records(i))
      end do
      !$omp end parallel do
   end subroutine new_suite

   !> Make no more of a suite than histories need
   subroutine new_motions(suite, records, threads)
      type(suite_type), intent(out) :: suite
      !> Accelerograms, one at least; they are moved into the suite
      type(record_type), allocatable, intent(inout) :: records(:)
      !> Number of threads that join them, 0: all that OpenMP gives; one if absent
      integer, intent(in), optional :: threads

      integer :: i

      call move_alloc(records, suite%records)
      allocate (suite%measured(most_measures))
      do i = 1, size(suite%records)
         suite%has_vertical = suite%has_vertical .or. allocated(suite%records(i)%vertical)
      end do
      call new_record_set(suite%set, suite%records, threads)
      call make_order([(real(suite%set%strong_blocks(i), wp), i=1, size(suite%records))], suite%by_duration)
   end subroutine new_motions

   !> Compute the values of a measure and keep them
   subroutine measure(self, im, threads)
      class(suite_type), intent(inout) :: self
      type(measure_type), intent(in) :: im
      !> Number of threads; 0: all that OpenMP gives
      integer, intent(in) :: threads

      real(wp), allocatable :: found(:)
      integer :: place

      if (place_of(self, im) > 0) return
      found = computed(self%records, im, threads)
      ! A place belongs to the thread that took it, and readers see it once it is complete.
      !$omp atomic capture
      self%taken = self%taken + 1
      place = self%taken
      !$omp end atomic
      if (place > most_measures) return
      self%measured(place)%name = im%name
      call move_alloc(found, self%measured(place)%values)
      !$omp atomic write seq_cst
      self%measured(place)%is_complete = 1
      !$omp end atomic
   end subroutine measure

   !> Values of a measure for the unscaled records: those that are kept, or computed now
   function values(self, im, threads)
      class(suite_type), intent(in) :: self
      type(measure_type), intent(in) :: im
      !> Number of threads; 0: all that OpenMP gives
      integer, intent(in) :: threads
      !> A value for each record
      real(wp) :: values(size(self%records))

      integer :: place

      place = place_of(self, im)
      if (place > 0) then
         values = self%measured(place)%values
      else
         values = computed(self%records, im, threads)
      end if
   end function values

   !> Place of a measure among those that are kept; 0: it is not there
   integer function place_of(suite, im) result(place)
      class(suite_type), intent(in) :: suite
      type(measure_type), intent(in) :: im

      integer :: is_complete

      do place = most_measures, 1, -1
         !$omp atomic read seq_cst
         is_complete = suite%measured(place)%is_complete
         !$omp end atomic
         if (is_complete == 0) cycle
         if (suite%measured(place)%name == im%name) return
      end do
   end function place_of

   !> Compute the values of a measure
   function computed(records, im, threads) result(values)
      type(record_type), intent(in) :: records(:)
      type(measure_type), intent(in) :: im
      !> Number of threads; 0: all that OpenMP gives
      integer, intent(in) :: threads
      !> A value for each record
      real(wp) :: values(size(records))

      integer :: i

      !$omp parallel do schedule(dynamic) num_threads(team_of(threads, size(records))) default(none) &
      !$omp & shared(im, records, values)
      do i = 1, size(records)
         values(i) = im%of(records(i))
      end do
      !$omp end parallel do
   end function computed

end module dondolo_record_suite
