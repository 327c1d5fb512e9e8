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
   use dondolo_core, only : check_limit, check_solver, engine_names, entry_type, error_type, fit_fragility, fragility_type, &
      & ground_displacement, ground_velocity, im_names, initial_state_type, measure_type, mechanism_names, mechanism_type, &
      & metadata_type, multiple_stripe, new_measure, new_record, new_scaling, new_study, new_wall, polarity_names, &
      & progress_interface, pseudo_acceleration, record_type, response_type, restraint_type, scaling_names, scaling_type, &
      & simulate, solver_type, spectral_displacement, stripes_type, study_type, suite_type, synthetic_record, &
      & tie_response_type, trace_type, wall_input_type, wall_type, wp
   use dondolo_case, only : case_type
   use dondolo_case_population_case, only : merge_population
   use dondolo_case_read_case, only : read_case
   use dondolo_case_reports, only : check_reports, write_reports
   use dondolo_case_results, only : results_type
   use dondolo_case_run_case, only : run_case
   use dondolo_files_version, only : dondolo_version_text
   use dondolo_population, only : population_type
   use dondolo_population_reader, only : population_reader_type, read_population
   use dondolo_population_table, only : population_table_type
   use dondolo_population_typology, only : combine_population, typology_type
   use dondolo_population_wall_row, only : wall_row_type
   use dondolo_records_catalogue, only : read_catalogue
   use dondolo_records_clusters, only : new_suite => gather_suite
   use dondolo_records_record_reader, only : read_record, read_records
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
