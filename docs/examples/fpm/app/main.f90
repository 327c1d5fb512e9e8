!> The median of a parapet's fragility curve: median-of-a-parapet CATALOGUE
program median_of_a_parapet
   use dondolo, only : error_type, fit_fragility, fragility_type, multiple_stripe, new_scaling, new_study, new_suite, &
      & new_wall, read_catalogue, record_type, scaling_type, solver_type, stripes_type, study_type, suite_type, &
      & wall_input_type, wall_type, wp
   implicit none

   real(wp), parameter :: levels(*) = [0.4_wp, 0.6_wp, 0.8_wp, 1.0_wp, 1.2_wp]
   type(wall_input_type) :: input
   type(wall_type) :: wall
   type(record_type), allocatable :: records(:)
   type(suite_type), target :: suite
   type(scaling_type) :: scaling
   type(study_type) :: study
   type(stripes_type) :: stripes
   type(fragility_type) :: curve
   type(error_type), allocatable :: error
   character(len=1000) :: catalogue

   call get_command_argument(1, catalogue)
   call input%set('mechanism', 'one_sided')
   call input%set('height', 1.5_wp)
   call input%set('thickness', 0.25_wp)
   call new_wall(wall, input, error)
   if (.not. allocated(error)) call read_catalogue(trim(catalogue), records, error)
   if (.not. allocated(error)) call new_scaling(scaling, 'pga', error)
   if (allocated(error)) error stop error%message

   call new_suite(suite, records)
   call new_study(study, suite, scaling, levels, 'as_recorded', solver_type(), threads=0)
   call multiple_stripe(stripes, wall, study, error)
   if (allocated(error)) error stop error%message
   call fit_fragility(curve, levels, real(stripes%collapses(), wp), real(stripes%histories(), wp), error)
   if (allocated(error)) error stop error%message
   print '(a, f6.3, a, f6.3)', 'theta = ', curve%theta, ' g, beta = ', curve%beta
end program median_of_a_parapet
