!> The build variants of the engine lanes: the same sources compiled for several processors, and the choice among them.
!>
!> Variants differ by rounding only. A build by meson has 'baseline', which runs anywhere, and on x86-64 'avx2' and
!> 'avx512' (DONDOLO_VARIANTS); a build for one processor has 'native' alone (DONDOLO_NATIVE); other builds 'baseline'.
!> The best that the processor can run is taken, or what the environment variable DONDOLO_VARIANT names.
module dondolo_motion_lane_variants
   use, intrinsic :: iso_c_binding, only : c_int
   use dondolo_base_error, only : error_type, raise_input
   use dondolo_base_kinds, only : wp
   use dondolo_motion_elastic_filter, only : elastic_filter_type
   use dondolo_motion_lane_constants, only : lane_constants_type
   use dondolo_motion_lanes, only : first_options => lane_options, simulate_first => simulate_lanes, trace_first => trace_lanes
#ifdef DONDOLO_VARIANTS
   use dondolo_motion_lanes_avx2, only : avx2_options => lane_options, simulate_avx2 => simulate_lanes, trace_avx2 => trace_lanes
   use dondolo_motion_lanes_avx512, only : avx512_options => lane_options, simulate_avx512 => simulate_lanes, &
      & trace_avx512 => trace_lanes
#endif
   use dondolo_base_text, only : join
   use dondolo_motion_queue, only : queue_type
   use dondolo_motion_response, only : trace_type
   use dondolo_motion_work, only : work_type
   use dondolo_record, only : record_type
   use dondolo_record_set, only : record_set_type
   use dondolo_wall_mechanism, only : mechanism_type
   implicit none
   private

   public :: build_variant, check_variant, engine_options, first_variant, simulate_variant, trace_variant

   !> Variant that everything but the engine lanes is compiled for
#ifdef DONDOLO_NATIVE
   character(len=*), parameter :: first_variant = 'native'
#else
   character(len=*), parameter :: first_variant = 'baseline'
#endif

   !> Names of the variants, each for a better processor than the one before
   character(len=8), parameter :: variant_names(3) = [character(len=8) :: first_variant, 'avx2', 'avx512']

   interface
      !> Number of the best variant that the processor and this build have
      function processor_level() bind(c, name='dondolo_processor_level')
         import :: c_int
         !> Number
         integer(c_int) :: processor_level
      end function processor_level
   end interface

contains

   !> Check what the environment variable DONDOLO_VARIANT names
   subroutine check_variant(error)
      !> No variant that this build and this processor have
      type(error_type), allocatable, intent(out) :: error

      character(len=32) :: wish
      integer :: best, status

      call get_environment_variable('DONDOLO_VARIANT', wish, status=status)
      if (len_trim(wish) == 0) return
      best = processor_level()
      if (status /= 0 .or. all(wish /= variant_names(:best))) call raise_input(error, 'DONDOLO_VARIANT = '''// &
         & trim(wish)//''': this build and this processor have '//join(variant_names(:best)))
   end subroutine check_variant

   !> Name of the variant that the engine lanes runs
   function build_variant() result(name)
      !> Name. Of a fixed length, since threads ask at the same time: gfortran 12 keeps the length of a result of deferred
      !> length in one place for all threads
      character(len=len(variant_names)) :: name

      character(len=len(variant_names)) :: wish
      integer :: best, status

      best = processor_level()
      name = variant_names(best)
      call get_environment_variable('DONDOLO_VARIANT', wish, status=status)
      if (status == 0 .and. any(wish == variant_names(:best))) name = wish
   end function build_variant

   !> Options of the compiler of the variant that the engine lanes runs
   subroutine engine_options(options)
      !> The options
      character(len=:), allocatable, intent(out) :: options

      select case (build_variant())
#ifdef DONDOLO_VARIANTS
      case ('avx2')
         options = avx2_options
      case ('avx512')
         options = avx512_options
#endif
      case default
         options = first_options
      end select
   end subroutine engine_options

   !> Histories of one wall, as long as the queue has some, by a variant
   subroutine simulate_variant(variant, mechanism, constants, records, set, filter, queue, work)
      !> Name of the variant, from build_variant
      character(len=*), intent(in) :: variant
      class(mechanism_type), intent(in) :: mechanism
      type(lane_constants_type), intent(in) :: constants
      type(record_type), intent(in) :: records(:)
      !> The same, joined
      type(record_set_type), intent(in) :: set
      !> The motion of a wall that bends under each while its joints are closed; none for other walls
      type(elastic_filter_type), intent(in) :: filter(:)
      !> The histories, and their results; shared with other threads
      type(queue_type), intent(inout) :: queue
      !> Counts, added to
      type(work_type), intent(inout) :: work

      select case (variant)
#ifdef DONDOLO_VARIANTS
      case ('avx2')
         call simulate_avx2(mechanism, constants, records, set, filter, queue, work)
      case ('avx512')
         call simulate_avx512(mechanism, constants, records, set, filter, queue, work)
#endif
      case default
         call simulate_first(mechanism, constants, records, set, filter, queue, work)
      end select
   end subroutine simulate_variant

   !> The motion of one history, by the variant that simulate_variant runs
   subroutine trace_variant(mechanism, constants, record, scale, trace)
      class(mechanism_type), intent(in) :: mechanism
      type(lane_constants_type), intent(in) :: constants
      type(record_type), intent(in) :: record
      !> Factor on it, negative to reverse its polarity
      real(wp), intent(in) :: scale
      !> The motion
      type(trace_type), intent(inout) :: trace

      select case (build_variant())
#ifdef DONDOLO_VARIANTS
      case ('avx2')
         call trace_avx2(mechanism, constants, record, scale, trace)
      case ('avx512')
         call trace_avx512(mechanism, constants, record, scale, trace)
#endif
      case default
         call trace_first(mechanism, constants, record, scale, trace)
      end select
   end subroutine trace_variant

end module dondolo_motion_lane_variants
