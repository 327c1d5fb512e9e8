!> What the benchmark computes: a fixed population under the synthetic suite, the same on every machine.
module dondolo_benchmark_walls
   use dondolo_base_error, only : error_type
   use dondolo_base_kinds, only : wp
   use dondolo_case, only : case_type
   use dondolo_case_job_group, only : typology_task
   use dondolo_fragility_scaling, only : new_scaling
   use dondolo_motion_normal_form, only : new_normal_form, normal_form_type
   use dondolo_population_wall_row, only : wall_row_type
   use dondolo_record, only : record_type
   use dondolo_record_synthetic_suite, only : suite_record, synthetic44
   use dondolo_records_clusters, only : gather_suite
   use dondolo_wall, only : masonry_names, new_wall, wall_input_type, wall_type
   implicit none
   private

   public :: make_work, repeat_walls, operations_per_step, walls_of_each

   !> Heights and thicknesses of the walls of each mechanism [m]
   real(wp), parameter :: heights(3) = [1.5_wp, 3.0_wp, 5.0_wp], thicknesses(3) = [0.25_wp, 0.30_wp, 0.60_wp]

   !> Walls of each mechanism; they come one mechanism after the other
   integer, parameter :: walls_of_each = size(heights)

   !> Levels of the PGA [g]
   real(wp), parameter :: levels(10) = [0.1_wp, 0.2_wp, 0.3_wp, 0.4_wp, 0.5_wp, 0.6_wp, 0.7_wp, 0.8_wp, 0.9_wp, 1.0_wp]

contains

   !> What the benchmark runs: three walls of each mechanism
   subroutine make_work(case, rows, error)
      !> The case, without walls
      type(case_type), intent(out) :: case
      !> The walls
      type(wall_row_type), allocatable, intent(out) :: rows(:)
      !> It could not be made
      type(error_type), allocatable, intent(out) :: error

      type(wall_input_type) :: input
      type(record_type), allocatable :: records(:)
      integer :: i, j, number

      allocate (records(2*size(synthetic44)), rows(size(masonry_names)*walls_of_each))
      do i = 1, size(records)
         call suite_record((i + 1)/2, 2 - modulo(i, 2), records(i), error)
         if (allocated(error)) return
      end do
      number = 0
      do i = 1, size(masonry_names)
         do j = 1, walls_of_each
            number = number + 1
            input = wall_input_type()
            call input%set('mechanism', trim(masonry_names(i)))
            call input%set('height', heights(j))
            call input%set('thickness', thicknesses(j))
            ! At their weakest hinge, near the top, the engine lanes has no form of these walls
            if (masonry_names(i) == 'two_block') call input%set('hinge', 0.5_wp)
            call new_wall(rows(number)%wall, input, error)
            if (allocated(error)) return
            rows(number)%group = ''
         end do
      end do
      case%job%task = typology_task
      case%records_input%polarity = 'as_recorded'
      case%stripes%levels = levels
      case%stripes%thresholds = [case%solver%solver%edp_limit]
      call new_scaling(case%stripes%scaling, 'pga', error)
      call gather_suite(case%suite, records)
      call case%suite%measure(case%stripes%scaling%measure, 1)
   end subroutine make_work

   !> The same walls several times over
   function repeat_walls(rows, times) result(longer)
      type(wall_row_type), intent(in) :: rows(:)
      !> How many times they come
      integer, intent(in) :: times
      !> As many walls
      type(wall_row_type), allocatable :: longer(:)

      integer :: i

      longer = [(rows(modulo(i, size(rows)) + 1), i=0, times*size(rows) - 1)]
   end function repeat_walls

   !> Multiplications and additions of a step of the engine lanes, counted in its source (lane_step.inc); comparisons,
   !> events, and the search for the start of rocking are not counted
   integer function operations_per_step(case, wall)
      type(case_type), intent(in) :: case
      type(wall_type), intent(in) :: wall

      !> Of each degree of the polynomials a and b with four derivatives, and of all the rest; the same of a harmonic form
      integer, parameter :: each_degree = 20, others = 177, each_of_harmonic = 2, others_of_harmonic = 209
      type(normal_form_type) :: form

      associate (mechanism => wall%mechanism)
         form = new_normal_form(mechanism, case%solver%solver%edp_limit*mechanism%capacity)
      end associate
      operations_per_step = each_degree*form%degree + others
      if (form%is_harmonic) operations_per_step = each_of_harmonic*form%degree + others_of_harmonic
   end function operations_per_step

end module dondolo_benchmark_walls
