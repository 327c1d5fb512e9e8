!> dondolo: fragility of masonry walls that rock and overturn in earthquakes. The names a program needs.
!>
!>     use dondolo
!>     type(wall_input_type) :: input
!>     type(wall_type) :: wall
!>     type(record_type), allocatable :: records(:)
!>     type(suite_type), target :: suite
!>     type(scaling_type) :: scaling
!>     type(study_type) :: study
!>     type(stripes_type) :: stripes
!>     type(error_type), allocatable :: error
!>
!>     call input%set('mechanism', 'one_sided'); call input%set('height', 3.0_wp); call input%set('thickness', 0.25_wp)
!>     call new_wall(wall, input, error)
!>     if (.not. allocated(error)) call read_catalogue('records.csv', records, error)
!>     if (.not. allocated(error)) call new_scaling(scaling, 'pga', error)
!>     if (.not. allocated(error)) then
!>        call new_suite(suite, records)
!>        call new_study(study, suite, scaling, [0.2_wp, 0.4_wp], 'as_recorded', solver_type(), threads=0)
!>        call multiple_stripe(stripes, wall, study, error)
!>     end if
!>     if (allocated(error)) print *, error%message
module dondolo
   use dondolo_base_error, only : error_type
   use dondolo_base_kinds, only : wp
   use dondolo_base_version, only : dondolo_version_text
   use dondolo_record, only : new_record, record_type
   use dondolo_record_catalogue, only : read_catalogue
   use dondolo_record_ground_motion, only : ground_displacement, ground_velocity
   use dondolo_record_intensity, only : im_names, measure_type, new_measure
   use dondolo_record_metadata, only : entry_type, metadata_type
   use dondolo_record_reader, only : read_record, read_records
   use dondolo_record_response_spectrum, only : pseudo_acceleration, spectral_displacement
   use dondolo_record_suite, only : new_suite, suite_type
   use dondolo_record_synthetic, only : synthetic_record
   use dondolo_wall, only : mechanism_names, new_wall, wall_input_type, wall_type
   use dondolo_wall_mechanism, only : mechanism_type
   use dondolo_wall_restraint, only : restraint_type
   use dondolo_motion_initial_state, only : initial_state_type
   use dondolo_motion_queue, only : progress_interface
   use dondolo_motion_response, only : response_type, tie_response_type, trace_type
   use dondolo_motion_simulate, only : simulate
   use dondolo_motion_solver, only : check_limit, check_solver, engine_names, solver_type
   use dondolo_fragility, only : fit_fragility, fragility_type
   use dondolo_fragility_scaling, only : new_scaling, scaling_names, scaling_type
   use dondolo_fragility_stripes, only : multiple_stripe, stripes_type
   use dondolo_fragility_study, only : new_study, polarity_names, study_type
   use dondolo_population, only : population_type
   use dondolo_population_reader, only : population_reader_type, read_population
   use dondolo_population_table, only : population_table_type
   use dondolo_population_typology, only : combine_population, typology_type
   use dondolo_population_wall_row, only : wall_row_type
   use dondolo_case, only : case_type
   use dondolo_case_population_case, only : merge_population
   use dondolo_case_read_case, only : read_case
   use dondolo_case_reports, only : check_reports, write_reports
   use dondolo_case_results, only : results_type
   use dondolo_case_run_case, only : run_case
   implicit none
   private

   public :: wp, dondolo_version_text, error_type
   ! Accelerograms
   public :: record_type, new_record, read_record, read_records, read_catalogue, synthetic_record
   public :: metadata_type, entry_type
   public :: im_names, measure_type, new_measure, ground_velocity, ground_displacement
   public :: spectral_displacement, pseudo_acceleration
   ! Walls
   public :: wall_input_type, wall_type, new_wall, mechanism_names, mechanism_type, restraint_type
   ! Motion
   public :: solver_type, check_solver, check_limit, engine_names
   public :: simulate, initial_state_type, response_type, trace_type, tie_response_type
   ! Fragility
   public :: suite_type, new_suite, study_type, new_study
   public :: stripes_type, multiple_stripe, polarity_names, progress_interface
   public :: scaling_type, new_scaling, scaling_names
   public :: fragility_type, fit_fragility, typology_type, combine_population, population_type
   ! Cases
   public :: case_type, read_case, results_type, run_case, merge_population, check_reports, write_reports
   public :: wall_row_type, population_table_type, population_reader_type, read_population

end module dondolo
