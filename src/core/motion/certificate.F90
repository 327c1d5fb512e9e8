!> Certificates: histories that double precision may not decide are rerun in 33 digits until two tolerances agree, and with
!> the record one unit in the last place stronger and weaker (docs/reading_a_curve.md).
module dondolo_motion_certificate
   use, intrinsic :: iso_c_binding, only : c_int
   use dondolo_base_error, only : error_type, raise_failure, raise_input
   use dondolo_base_interrupt, only : get_watched, look_for_interrupt, watch, watched_type
   use dondolo_base_kinds, only : wp
   use dondolo_base_property, only : is_list, is_text, is_words
   use dondolo_motion_certified, only : certified_type, in_quadruple, not_computable
   use dondolo_motion_ensemble, only : ensemble_type
   use dondolo_motion_error_estimate, only : certain
   use dondolo_motion_queue, only : progress_interface, queue_type
#ifdef DONDOLO_QUADRUPLE
   use dondolo_motion_quadruple_wall, only : quadruple_record_type, quadruple_response_type, quadruple_wall_type
#endif
   use dondolo_base_threads, only : team_of
   use dondolo_motion_response, only : largest_sure_error, response_type
   use dondolo_record, only : record_type
   use dondolo_wall, only : wall_type
   use dondolo_wall_properties, only : wall_properties
   implicit none
   private

   public :: certificate_type, certify_histories, check_certificates

   !> Relative tolerances of the runs in 33 digits; each is compared with the one before
   real(wp), parameter :: rtols(*) = [1.0e-12_wp, 1.0e-14_wp, 1.0e-16_wp, 1.0e-18_wp]

   !> EDPs of two runs that agree differ by less
   real(wp), parameter :: agreement = 1.0e-7_wp

   !> Largest difference of the capacities of a wall in both precisions, relative: they are the same wall
   real(wp), parameter :: same_wall = 1.0e-10_wp

   !> Certificate of one history that was run in 33 digits
   type, extends(certified_type) :: certificate_type
      !> What happens. Its error is the difference of the two runs, or that of the bounds
      type(response_type) :: response
   end type certificate_type

contains

   !> Check that certificates can be given
   subroutine check_certificates(wall, error)
      type(wall_type), intent(in) :: wall
      !> This build has no quadruple precision, or the wall is not the same in it
      type(error_type), allocatable, intent(out) :: error

#ifdef DONDOLO_QUADRUPLE
      type(quadruple_wall_type) :: exact

      call new_quadruple_wall(exact, wall, error)
#else
      call raise_input(error, 'certify: this build has no quadruple precision; meson makes one that has')
      associate (unused => wall)
      end associate
#endif
   end subroutine check_certificates

   !> Certify histories of one wall
   subroutine certify_histories(certificates, wall, records, ensemble, edp_limit, threads, error, progress)
      !> Certificates, one for each history
      type(certificate_type), allocatable, intent(out) :: certificates(:)
      type(wall_type), intent(in) :: wall
      !> Accelerograms
      type(record_type), intent(in) :: records(:)
      !> The histories, with their EDPs in double precision
      type(ensemble_type), intent(in) :: ensemble
      !> Rotation / capacity at which the wall has collapsed
      real(wp), intent(in) :: edp_limit
      !> Number of threads; 0: all that OpenMP gives
      integer, intent(in) :: threads
      !> As of check_certificates
      type(error_type), allocatable, intent(out) :: error
      !> Progress callback
      procedure(progress_interface), optional :: progress

#ifdef DONDOLO_QUADRUPLE
      type(quadruple_wall_type) :: exact
      type(queue_type) :: queue
      real(wp) :: rate
      integer(c_int) :: interrupted
      type(watched_type) :: watched
      integer :: i

      rate = wall%mechanism%frequency_parameter()
      call get_watched(watched)
      allocate (certificates(size(ensemble%record)))
      call new_quadruple_wall(exact, wall, error)
      if (allocated(error)) return
      call queue%announce(size(certificates), progress)
      !$omp parallel do schedule(dynamic) num_threads(team_of(threads, size(certificates))) default(none) &
      !$omp & private(interrupted) shared(certificates, exact, records, ensemble, edp_limit, rate, queue, watched)
      do i = 1, size(certificates)
         call watch(watched)
         call look_for_interrupt(interrupted)
         if (interrupted == 1) cycle
         call certify(exact, records(ensemble%record(i)), ensemble%scale(i), ensemble%response(i)%edp, edp_limit, rate, &
            & certificates(i))
         call queue%report()
      end do
      !$omp end parallel do
#else
      allocate (certificates(0))
      call check_certificates(wall, error)
#endif
   end subroutine certify_histories

#ifdef DONDOLO_QUADRUPLE
   !> The same wall in 33 digits
   subroutine new_quadruple_wall(exact, wall, error)
      type(quadruple_wall_type), intent(out) :: exact
      type(wall_type), intent(in) :: wall
      !> It is not the same
      type(error_type), allocatable, intent(out) :: error

      character(len=:), allocatable :: message
      integer :: k

      do k = 1, size(wall_properties)
         associate (property => wall_properties(k), input => wall%input)
            if (.not. input%has(property%name)) cycle
            if (property%kind == is_text .or. property%kind == is_words) then
               call exact%say(property%name, input%word(property%name))
            else if (property%kind == is_list) then
               call exact%say(property%name, input%list(property%name))
            else
               call exact%say(property%name, input%number(property%name))
            end if
         end associate
      end do
      call exact%build(wall%gravity, message)
      if (allocated(message)) then
         call raise_failure(error, 'certify: in quadruple precision, '//message)
      else if (.not. abs(exact%capacity() - wall%mechanism%capacity) <= same_wall*wall%mechanism%capacity) then
         call raise_failure(error, 'certify: wall '''//wall%name()//''' is another one in quadruple precision')
      end if
   end subroutine new_quadruple_wall

   !> Certify a history
   subroutine certify(wall, record, scale, edp, edp_limit, rate, certificate)
      type(quadruple_wall_type), intent(in) :: wall
      type(record_type), intent(in) :: record
      !> Factor on it
      real(wp), intent(in) :: scale
      !> Its EDP in double precision
      real(wp), intent(in) :: edp
      !> Rotation / capacity at which the wall has collapsed
      real(wp), intent(in) :: edp_limit
      !> Frequency parameter p of the wall [rad/s]
      real(wp), intent(in) :: rate
      type(certificate_type), intent(out) :: certificate

      type(quadruple_record_type) :: exact
      type(response_type) :: wider, other
      logical :: another_way, is_whole
      integer :: i, k

      is_whole = .true.
      if (allocated(record%vertical)) then
         call exact%take(record%name, record%dt, record%acceleration, record%vertical)
      else
         call exact%take(record%name, record%dt, record%acceleration)
      end if
      associate (response => certificate%response, lowest => certificate%lowest, highest => certificate%highest)
         another_way = .false.
         call run(scale, rtols(1), response)
         do i = 2, size(rtols)
            ! Before the last tolerance, which costs most: does the last digit of the input decide?
            if (i == size(rtols)) call try_neighbours(rtols(i - 1))
            if (highest - lowest > largest_sure_error .or. another_way) exit
            wider = response
            call run(scale, rtols(i), response)
            if (are_alike(response, wider)) exit
         end do
         response%edp_error = abs(response%edp - wider%edp)
         ! Where all the rounding of double precision changes nothing, that of the input does not either; but every collapse
         ! has the same EDP.
         if (i < size(rtols) .and. (abs(response%edp - edp) > agreement .or. response%collapsed)) call try_neighbours(rtols(i))
         if (i > size(rtols)) then
            lowest = min(lowest, response%edp, wider%edp)
            highest = max(highest, response%edp, wider%edp)
         end if
         if (.not. is_whole) then
            ! The outcome of a run that was given up is unknown.
            lowest = 0.0_wp
            highest = edp_limit
         end if
         if (highest - lowest > largest_sure_error .or. another_way .or. (i > size(rtols) .and. response%collapsed)) then
            certificate%status = not_computable
            response%edp_error = highest - lowest
         else
            certificate%status = in_quadruple
            lowest = response%edp
            highest = response%edp
         end if
      end associate

   contains

      !> Widen the bounds by the history and those with factors one unit in the last place smaller and greater
      subroutine try_neighbours(rtol)
         !> Relative tolerance
         real(wp), intent(in) :: rtol

         certificate%lowest = certificate%response%edp
         certificate%highest = certificate%response%edp
         do k = -1, 1, 2
            call run(nearest(scale, real(k, wp)), rtol, other)
            if (certificate%response%collapsed .and. other%collapsed .and. .not. are_alike(certificate%response, other)) then
               ! It collapses in another way: the tolerance may decide whether it does at all.
               another_way = .true.
               call run(nearest(scale, real(k, wp)), rtols(size(rtols)), other)
            end if
            certificate%lowest = min(certificate%lowest, other%edp)
            certificate%highest = max(certificate%highest, other%edp)
         end do
      end subroutine try_neighbours

      !> One run
      subroutine run(factor, rtol, response)
         !> Factor on the record
         real(wp), intent(in) :: factor
         !> Relative tolerance
         real(wp), intent(in) :: rtol
         !> What happens
         type(response_type), intent(out) :: response

         type(quadruple_response_type) :: result

         call wall%simulate(exact, factor, rtol, edp_limit, result)
         response = response_type(result%edp, result%collapsed, result%impacts, result%time_of_peak)
         is_whole = is_whole .and. result%is_whole
      end subroutine run

      !> Do two runs agree? Two that collapse have the same EDP, and must do so in the same way
      pure logical function are_alike(one, other)
         type(response_type), intent(in) :: one, other

         are_alike = (one%collapsed .eqv. other%collapsed) .and. abs(one%edp - other%edp) <= agreement
         if (one%collapsed) are_alike = are_alike .and. rate*abs(one%time_of_peak - other%time_of_peak) <= certain
      end function are_alike

   end subroutine certify
#endif

end module dondolo_motion_certificate
