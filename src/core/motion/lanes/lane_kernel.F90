!> One step of every lane at once: the loop that an ensemble spends its time in.
!>
!> A Taylor step (docs/theory.md, section 5): a and b are expanded about the present y, and y'' = a + b u, with u linear
!> in time, gives the series of the motion up to t^9. The step ends at the lane's next sample. Where an impact, a new
!> peak, the limit or too large an error cannot be ruled out the lane stays where it is, and is flagged. (fpm does not
!> follow the include: after a change of lane_step.inc alone, remove its folder build.)
module dondolo_motion_lane_kernel
   use, intrinsic :: iso_fortran_env, only : int64
   use dondolo_base_kinds, only : wp
   use dondolo_motion_lane_state, only : event_possible, lane_width, lanes_type, part_if_restrained, record_over, step_taken, &
      & step_too_long, whole_vectors
   use dondolo_motion_normal_form, only : degrees, harmonic_degrees, restrained_degrees, normal_form_type, y_limit
   implicit none
   private

   public :: step_lanes

contains

   !> One step of the first lanes
   pure subroutine step_lanes(lanes, active, form, samples, rtol, atol, verticals)
      type(lanes_type), intent(inout) :: lanes
      !> Lanes to step
      integer, intent(in) :: active
      type(normal_form_type), intent(in) :: form
      !> Samples of all records [m/s2]
      real(wp), intent(in) :: samples(*)
      !> Tolerances of the velocity: relative, and absolute [1/s]
      real(wp), intent(in) :: rtol, atol
      !> Vertical components of the samples, for a form with vertical motion [m/s2]
      real(wp), intent(in), optional :: verticals(*)

      integer :: rounded

      rounded = whole_vectors(active)
      if (form%is_restrained .and. form%is_harmonic .and. form%is_shaken) then
         if (form%degree == harmonic_degrees(1)) then
            call shaken_step_restrained_harmonic_10(lanes, rounded, form, samples, verticals, rtol, atol)
         else
            call shaken_step_restrained_harmonic_16(lanes, rounded, form, samples, verticals, rtol, atol)
         end if
      else if (form%is_restrained .and. form%is_harmonic) then
         if (form%degree == harmonic_degrees(1)) then
            call step_restrained_harmonic_10(lanes, rounded, form, samples, rtol, atol)
         else
            call step_restrained_harmonic_16(lanes, rounded, form, samples, rtol, atol)
         end if
      else if (form%is_restrained .and. form%is_shaken) then
         if (form%degree == restrained_degrees(1)) then
            call shaken_step_restrained_14(lanes, rounded, form, samples, verticals, rtol, atol)
         else
            call shaken_step_restrained_22(lanes, rounded, form, samples, verticals, rtol, atol)
         end if
      else if (form%is_restrained) then
         if (form%degree == restrained_degrees(1)) then
            call step_restrained_14(lanes, rounded, form, samples, rtol, atol)
         else
            call step_restrained_22(lanes, rounded, form, samples, rtol, atol)
         end if
      else if (form%is_harmonic .and. form%is_shaken) then
         if (form%degree == harmonic_degrees(1)) then
            call shaken_step_harmonic_10(lanes, rounded, form, samples, verticals, rtol, atol)
         else
            call shaken_step_harmonic_16(lanes, rounded, form, samples, verticals, rtol, atol)
         end if
      else if (form%is_harmonic) then
         if (form%degree == harmonic_degrees(1)) then
            call step_harmonic_10(lanes, rounded, form, samples, rtol, atol)
         else
            call step_harmonic_16(lanes, rounded, form, samples, rtol, atol)
         end if
      else if (form%is_shaken) then
         select case (form%degree)
         case (degrees(1))
            call shaken_step_8(lanes, rounded, form, samples, verticals, rtol, atol)
         case (degrees(2))
            call shaken_step_13(lanes, rounded, form, samples, verticals, rtol, atol)
         case (degrees(3))
            call shaken_step_15(lanes, rounded, form, samples, verticals, rtol, atol)
         case (degrees(4))
            call shaken_step_18(lanes, rounded, form, samples, verticals, rtol, atol)
         case (degrees(5))
            call shaken_step_22(lanes, rounded, form, samples, verticals, rtol, atol)
         case default
            call shaken_step_32(lanes, rounded, form, samples, verticals, rtol, atol)
         end select
      else
         select case (form%degree)
         case (degrees(1))
            call step_8(lanes, rounded, form, samples, rtol, atol)
         case (degrees(2))
            call step_13(lanes, rounded, form, samples, rtol, atol)
         case (degrees(3))
            call step_15(lanes, rounded, form, samples, rtol, atol)
         case (degrees(4))
            call step_18(lanes, rounded, form, samples, rtol, atol)
         case (degrees(5))
            call step_22(lanes, rounded, form, samples, rtol, atol)
         case default
            call step_32(lanes, rounded, form, samples, rtol, atol)
         end select
      end if
   end subroutine step_lanes

! Lanes that take a turn: a vector of eight, or as many as fit the registers of processors whose vectors are shorter
#ifndef LANES_IN_TURN
#define LANES_IN_TURN 4
#endif
! Each inclusion defines two subroutines, LANE_KIND and its degree, for shaken forms and for the others.
#define LANE_KIND step_
#define LANE_DEGREE 8
#include "lane_step.inc"
#define LANE_DEGREE 13
#include "lane_step.inc"
#define LANE_DEGREE 15
#include "lane_step.inc"
#define LANE_DEGREE 18
#include "lane_step.inc"
#define LANE_DEGREE 22
#include "lane_step.inc"
#define LANE_DEGREE 32
#include "lane_step.inc"
#undef LANE_KIND
#define LANE_KIND step_harmonic_
#define LANE_HARMONIC
#define LANE_DEGREE 10
#include "lane_step.inc"
#define LANE_DEGREE 16
#include "lane_step.inc"
#undef LANE_HARMONIC
#undef LANE_KIND
#define LANE_KIND step_restrained_
#define LANE_RESTRAINED
#define LANE_DEGREE 14
#include "lane_step.inc"
#define LANE_DEGREE 22
#include "lane_step.inc"
#undef LANE_KIND
#define LANE_KIND step_restrained_harmonic_
#define LANE_HARMONIC
#define LANE_DEGREE 10
#include "lane_step.inc"
#define LANE_DEGREE 16
#include "lane_step.inc"

end module dondolo_motion_lane_kernel
