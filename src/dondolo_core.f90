!> The half of dondolo that computes, for programs that bring their own numbers: walls, motions, curves and nothing that reads a
!> file. A program that uses this module alone is compiled from `src/core` alone.
module dondolo_core
   use dondolo_base_error, only : error_type
   use dondolo_base_kinds, only : wp
   use dondolo_fragility, only : fit_fragility, fragility_type
   use dondolo_fragility_scaling, only : new_scaling, scaling_names, scaling_type
   use dondolo_fragility_stripes, only : multiple_stripe, stripes_type
   use dondolo_fragility_study, only : new_study, polarity_names, study_type
   use dondolo_motion_initial_state, only : initial_state_type
   use dondolo_motion_queue, only : progress_interface
   use dondolo_motion_response, only : response_type, tie_response_type, trace_type
   use dondolo_motion_simulate, only : simulate
   use dondolo_motion_solver, only : check_limit, check_solver, engine_names, solver_type
   use dondolo_record, only : new_record, record_type
   use dondolo_record_ground_motion, only : ground_displacement, ground_velocity
   use dondolo_record_intensity, only : im_names, measure_type, new_measure
   use dondolo_record_metadata, only : entry_type, metadata_type
   use dondolo_record_response_spectrum, only : pseudo_acceleration, spectral_displacement
   use dondolo_record_suite, only : new_suite, suite_type
   use dondolo_record_synthetic, only : synthetic_record
   use dondolo_wall, only : mechanism_names, new_wall, wall_input_type, wall_type
   use dondolo_wall_mechanism, only : mechanism_type
   use dondolo_wall_restraint, only : restraint_type
   implicit none
   private

   public :: wp, error_type
   ! Accelerograms
   public :: record_type, new_record, synthetic_record, metadata_type, entry_type
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
   public :: scaling_type, new_scaling, scaling_names, fragility_type, fit_fragility

end module dondolo_core
