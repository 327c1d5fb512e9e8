!> The fragility curve of a parapet under accelerograms that are arrays: wave packets of 0.6 to 2.5 Hz
program curve_of_a_parapet
   use dondolo_core, only : error_type, fit_fragility, fragility_type, multiple_stripe, new_record, new_scaling, new_study, &
      & new_suite, new_wall, record_type, scaling_type, solver_type, stripes_type, study_type, suite_type, wall_input_type, &
      & wall_type, wp
   implicit none

   integer :: i
   integer, parameter :: motions = 20
   real(wp), parameter :: levels(*) = [0.2_wp, 0.3_wp, 0.4_wp, 0.6_wp, 0.8_wp], dt = 0.01_wp, pi = acos(-1.0_wp)
   real(wp), parameter :: time(*) = [(i*dt, i=0, 1000)]
   type(wall_input_type) :: input
   type(wall_type) :: wall
   type(record_type), allocatable :: records(:)
   type(suite_type), target :: suite
   type(scaling_type) :: scaling
   type(study_type) :: study
   type(stripes_type) :: stripes
   type(fragility_type) :: curve
   type(error_type), allocatable :: error

   call input%set('mechanism', 'one_sided')
   call input%set('height', 1.5_wp)
   call input%set('thickness', 0.25_wp)
   call new_wall(wall, input, error)
   allocate (records(motions))
   do i = 1, motions
      if (allocated(error)) error stop error%message
      call new_record(records(i), sin(2.0_wp*pi*(0.5_wp + 0.1_wp*i)*time)*exp(-((time - 5.0_wp)/2.0_wp)**2), dt, 'packet', error)
   end do
   if (.not. allocated(error)) call new_scaling(scaling, 'pga', error)
   if (allocated(error)) error stop error%message

   call new_suite(suite, records)
   call new_study(study, suite, scaling, levels, 'as_recorded', solver_type(), threads=0)
   call multiple_stripe(stripes, wall, study, error)
   if (allocated(error)) error stop error%message
   call fit_fragility(curve, levels, real(stripes%collapses(), wp), real(stripes%histories(), wp), error)
   if (allocated(error)) error stop error%message
   print '(a, f6.3, a, f6.3)', 'theta = ', curve%theta, ' g, beta = ', curve%beta
end program curve_of_a_parapet
