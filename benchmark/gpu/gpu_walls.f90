!> The walls, accelerograms and levels that dondolo-gpu computes, on the processor and on a graphics processor.
module dondolo_gpu_walls
   use dondolo_base_error, only : error_type
   use dondolo_base_kinds, only : wp
   use dondolo_gpu_ground, only : block_size
   use dondolo_gpu_state, only : gpu_history_type, gpu_wall_type, new_gpu_wall
   use dondolo_gpu_step_13, only : run_13 => run_on_gpu
   use dondolo_gpu_step_15, only : run_15 => run_on_gpu
   use dondolo_gpu_step_harmonic_10, only : run_harmonic_10 => run_on_gpu
   use dondolo_gpu_step_harmonic_16, only : run_harmonic_16 => run_on_gpu
   use dondolo_motion_ensemble, only : ensemble_type, run_ensemble
   use dondolo_motion_history, only : history_type
   use dondolo_motion_lane_constants, only : lane_constants_type, new_lane_constants
   use dondolo_motion_response, only : response_type
   use dondolo_motion_solver, only : solver_type
   use dondolo_record, only : record_type
   use dondolo_record_suite, only : new_suite, suite_type
   use dondolo_record_synthetic_suite, only : suite_record, synthetic44
   use dondolo_wall, only : new_wall, wall_input_type, wall_type
   implicit none
   private

   public :: gpu_study_type

   !> Levels of the PGA, and the lowest, which is their distance too [g]
   integer, parameter :: levels = 20
   real(wp), parameter :: lowest_level = 0.05_wp, gravity = 9.81_wp

   !> Walls of one mechanism under the synthetic accelerograms
   type :: gpu_study_type
      !> The walls: those with a normal form of the same kind as the first that a kernel serves
      type(wall_type), allocatable :: wall(:)
      type(lane_constants_type), allocatable :: constants(:)
      type(suite_type) :: suite
      type(solver_type) :: solver
      !> Record and factor of each history of a wall
      integer, allocatable :: record(:)
      real(wp), allocatable :: scale(:)
      !> All histories as the graphics processor gets them: wall and record of each, and the factor
      type(gpu_wall_type), allocatable, private :: gpu_wall(:)
      integer, allocatable, private :: wall_of(:), record_of(:)
      real(wp), allocatable, private :: scale_of(:), dt(:)
      !> Smallest and largest of each block of samples [m/s2]
      real(wp), allocatable, private :: smallest(:), largest(:)
      !> What it leaves to be finished
      type(gpu_history_type), allocatable, private :: left(:)
   contains
      !> Make it
      procedure :: make
      !> The histories on the processor
      procedure :: run_on_processor
      !> The histories on the graphics processor, and what comes after their records
      procedure :: launch
      procedure :: finish
   end type gpu_study_type

contains

   !> Make the study
   subroutine make(self, mechanism, walls, error)
      class(gpu_study_type), intent(inout) :: self
      !> Name of the mechanism
      character(len=*), intent(in) :: mechanism
      !> Number of walls to choose from
      integer, intent(in) :: walls
      !> It could not be made
      type(error_type), allocatable, intent(out) :: error

      type(record_type), allocatable :: records(:)
      type(wall_input_type) :: input
      type(wall_type) :: wall
      type(lane_constants_type) :: constants
      real(wp) :: part
      integer :: i, j

      allocate (records(2*size(synthetic44)))
      do i = 1, size(records)
         call suite_record((i + 1)/2, 2 - modulo(i, 2), records(i), error)
         if (allocated(error)) return
      end do
      call new_suite(self%suite, records)
      self%solver%collapses_only = .false.
      self%record = [((i, j=1, levels), i=1, size(self%suite%records))]
      self%scale = [((lowest_level*gravity*real(j, wp)/self%suite%peaks(i), j=1, levels), i=1, size(self%suite%records))]
      allocate (self%wall(0), self%constants(0))
      do i = 1, walls
         part = (real(i, wp) - 0.5_wp)/real(walls, wp)
         input = wall_input_type()
         call input%set('mechanism', trim(mechanism))
         call input%set('height', 1.5_wp + 3.5_wp*part)
         call input%set('thickness', 0.25_wp + 0.35_wp*modulo(7.0_wp*part, 1.0_wp))
         call new_wall(wall, input, error)
         if (allocated(error)) return
         constants = new_lane_constants(wall%mechanism, self%solver)
         associate (form => constants%form)
            if (.not. form%exists .or. .not. (form%is_harmonic .or. any(form%degree == [13, 15]))) cycle
            if (size(self%constants) > 0) then
               associate (first => self%constants(1)%form)
                  if (form%degree /= first%degree .or. (form%is_harmonic .neqv. first%is_harmonic)) cycle
               end associate
            end if
         end associate
         self%wall = [self%wall, wall]
         self%constants = [self%constants, constants]
      end do
      call prepare(self)
   end subroutine make

   !> What the graphics processor gets. Threads of a warp take histories that stand side by side: those of as many walls under the
   !> same record at the same level, which read the same samples and take as long
   subroutine prepare(self)
      class(gpu_study_type), intent(inout) :: self

      integer :: i, j

      associate (walls => size(self%wall), n => size(self%record), samples => self%suite%set%samples)
         self%gpu_wall = [(new_gpu_wall(self%constants(i)), i=1, walls)]
         self%wall_of = [((i, i=1, walls), j=1, n)]
         self%record_of = [((self%record(j), i=1, walls), j=1, n)]
         self%scale_of = [((self%scale(j), i=1, walls), j=1, n)]
         self%dt = self%suite%records%dt
         allocate (self%left(n*walls), self%smallest((size(samples) - 1)/block_size + 1), &
            & self%largest((size(samples) - 1)/block_size + 1))
         do i = 1, size(self%smallest)
            j = (i - 1)*block_size
            self%smallest(i) = minval(samples(j + 1:min(j + block_size, size(samples))))
            self%largest(i) = maxval(samples(j + 1:min(j + block_size, size(samples))))
         end do
      end associate
   end subroutine prepare

   !> The histories on the processor, walls shared by all threads
   subroutine run_on_processor(self, response)
      class(gpu_study_type), intent(in) :: self
      !> Results, of each history and wall
      type(response_type), intent(inout) :: response(:, :)

      type(ensemble_type), allocatable :: ensemble
      ! A history that is given up counts as a collapse, as the comparison of both finds
      type(error_type), allocatable :: error
      integer :: i

      !$omp parallel do schedule(dynamic) default(none) shared(self, response) private(ensemble, error)
      do i = 1, size(self%wall)
         ! Allocated anew: what OpenMP makes private has no default values.
         if (allocated(ensemble)) deallocate (ensemble)
         allocate (ensemble)
         ensemble%record = self%record
         ensemble%scale = self%scale
         call run_ensemble(ensemble, self%wall(i)%mechanism, self%suite, self%solver, 1, error)
         response(:, i) = ensemble%response
      end do
      !$omp end parallel do
   end subroutine run_on_processor

   !> The histories on the graphics processor, up to the ends of their records
   subroutine launch(self)
      class(gpu_study_type), intent(inout) :: self

      procedure(run_13), pointer :: run

      associate (set => self%suite%set, form => self%constants(1)%form)
         if (form%is_harmonic) then
            run => run_harmonic_16
            if (form%degree == 10) run => run_harmonic_10
         else
            run => run_15
            if (form%degree == 13) run => run_13
         end if
         call run(self%gpu_wall, self%wall_of, self%record_of, self%scale_of, set%samples, self%smallest, self%largest, &
            & set%offset, set%length, self%dt, self%left)
      end associate
   end subroutine launch

   !> What comes after the records, and the results
   subroutine finish(self, response)
      class(gpu_study_type), intent(in) :: self
      !> Results, of each history and wall
      type(response_type), intent(inout) :: response(:, :)

      type(history_type) :: history
      real(wp) :: q, v, j, c, g, l, load
      integer :: i, k

      !$omp parallel do schedule(dynamic) default(none) shared(self, response) private(history, q, v, j, c, g, l, load, k)
      do i = 1, size(self%wall)
         do k = 1, size(self%record)
            associate (one => self%left((k - 1)*size(self%wall) + i), constants => self%constants(i), &
               & mechanism => self%wall(i)%mechanism, record => self%suite%records(self%record(k)))
               history = history_type(scale=self%scale(k), side=one%side, impacts=one%impacts, collapsed=one%collapsed, &
                  & time_of_peak=one%time_of_peak)
               if (one%peak > 0.0_wp) history%peak = constants%form%rotation(one%peak)
               if (.not. one%collapsed .and. (one%y > 0.0_wp .or. one%v > 0.0_wp)) then
                  q = constants%form%rotation(one%y)
                  call mechanism%terms(q, j, c, g, l, load)
                  v = one%v*constants%form%unit*sqrt(constants%rest%inertia/j)
                  call history%add_free_motion(mechanism, record, constants%limit, q, v)
               end if
               call history%finish(constants, record, response(k, i))
            end associate
         end do
      end do
      !$omp end parallel do
   end subroutine finish

end module dondolo_gpu_walls
