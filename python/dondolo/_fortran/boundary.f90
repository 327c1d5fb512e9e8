!> What the procedures that f2py reads share: checks of what crosses, lines of text, solver and responses.
module dondolo_boundary
   use, intrinsic :: iso_c_binding, only : c_double, c_int
   use, intrinsic :: iso_fortran_env, only : int64
   use dondolo_base_error, only : error_type, raise_input
   use dondolo_base_lines, only : lines_type
   use dondolo_base_memory, only : check_memory => check_room
   use dondolo_base_property, only : is_list, is_text, property_type
   use dondolo_base_settings, only : group_settings_type, new_settings
   use dondolo_base_text, only : to_text
   use dondolo_motion_response, only : response_type
   use dondolo_motion_solver, only : solver_type
   implicit none
   private

   public :: check_room, next_line, split_lines, as_settings, as_solver, unpack_response

   !> What each thing that is worked on takes at most, all that is copied and sent included [bytes]
   real(c_double), parameter :: bytes_of_wall = 4000.0_c_double, bytes_of_record = 2000.0_c_double, &
      & bytes_of_sample = 64.0_c_double, bytes_of_history = 160.0_c_double

contains

   !> Check that there is room for what is worked on
   subroutine check_room(error, walls, records, samples, histories, reals)
      !> There is not
      type(error_type), allocatable, intent(out) :: error
      !> Numbers of walls, of records, of their samples, of histories, and of other reals
      integer(c_int), intent(in), optional :: walls, records
      real(c_double), intent(in), optional :: samples, histories, reals

      real(c_double) :: bytes

      bytes = 0.0_c_double
      if (present(walls)) bytes = bytes + bytes_of_wall*real(walls, c_double)
      if (present(records)) bytes = bytes + bytes_of_record*real(records, c_double)
      if (present(samples)) bytes = bytes + bytes_of_sample*samples
      if (present(histories)) bytes = bytes + bytes_of_history*histories
      if (present(reals)) bytes = bytes + real(storage_size(reals)/8, c_double)*reals
      call check_memory(bytes, error)
   end subroutine check_room

   !> The next line of a text
   pure subroutine next_line(text, at, line)
      !> Lines, separated by new_line
      character(len=*), intent(in) :: text
      !> Position: where the line begins, then where the next one does; 1 for the first
      integer(int64), intent(inout) :: at
      !> The line; blanks at its end are lost, and after the last line it is empty
      character(len=:), allocatable, intent(out) :: line

      integer(int64) :: length

      length = index(text(at:), new_line('a'), kind=int64) - 1
      if (length < 0) length = len(text, int64) - at + 1
      line = trim(text(at:at + length - 1))
      at = min(at + length + 1, len(text, int64) + 1)
   end subroutine next_line

   !> All lines of a text
   subroutine split_lines(text, lines)
      !> Lines, each ended by new_line
      character(len=*), intent(in) :: text
      !> The lines
      type(lines_type), intent(out) :: lines

      character(len=:), allocatable :: line
      integer(int64) :: at

      at = 1
      do while (at <= len(text, int64))
         call next_line(text, at, line)
         call lines%add(line)
      end do
   end subroutine split_lines

   !> Values of a group, which Python puts in the order of the group's table
   subroutine as_settings(settings, table, texts, numbers, given, error)
      !> Its settings: what is given
      type(group_settings_type), intent(inout) :: settings
      !> Its table
      type(property_type), target, intent(in) :: table(:)
      !> A line for each text; empty: not given
      character(len=*), intent(in) :: texts
      !> All numbers that are given
      real(c_double), intent(in) :: numbers(:)
      !> How many values each number has: of a list any number, else 1 or 0
      integer(c_int), intent(in) :: given(:)
      !> Numbers of another table
      type(error_type), allocatable, intent(out) :: error

      character(len=:), allocatable :: text
      integer(int64) :: at
      integer :: k, number, next

      if (size(given) /= count(table%kind /= is_text) .or. any(given < 0) .or. sum(given) > size(numbers)) then
         call raise_input(error, 'values: must be '//to_text(count(table%kind /= is_text))//' numbers')
         return
      end if
      call new_settings(settings, table)
      at = 1
      number = 0
      next = 1
      do k = 1, size(table)
         associate (property => table(k))
            if (property%kind == is_text) then
               call next_line(texts, at, text)
               if (len(text) > 0) call settings%set(trim(property%name), text)
               cycle
            end if
            number = number + 1
            if (given(number) < 1) cycle
            if (property%kind == is_list) then
               call settings%set(trim(property%name), numbers(next:next + given(number) - 1))
            else
               call settings%set(trim(property%name), numbers(next))
            end if
            next = next + given(number)
         end associate
      end do
   end subroutine as_settings

   !> Settings of the computation
   pure function as_solver(engine, rtol, atol, edp_limit, estimate_error, collapses_only) result(solver)
      !> Engine
      character(len=*), intent(in) :: engine
      !> Tolerances of a step, and the EDP that counts as collapse
      real(c_double), intent(in) :: rtol, atol, edp_limit
      !> 1 for what is wanted, else 0
      integer(c_int), intent(in) :: estimate_error, collapses_only
      !> The settings
      type(solver_type) :: solver

      solver%engine = engine
      solver%rtol = rtol
      solver%atol = atol
      solver%edp_limit = edp_limit
      solver%estimate_error = estimate_error == 1
      solver%collapses_only = collapses_only == 1
   end function as_solver

   !> A response as flat numbers
   elemental subroutine unpack_response(response, edp, collapsed, impacts, time_of_peak, edp_error)
      !> The response
      type(response_type), intent(in) :: response
      !> Largest rotation / capacity
      real(c_double), intent(out) :: edp
      !> 1: collapsed
      integer(c_int), intent(out) :: collapsed
      !> Impacts
      integer(c_int), intent(out) :: impacts
      !> Time of the peak [s]
      real(c_double), intent(out) :: time_of_peak
      !> Estimated error of the EDP, 0 where it was not asked for
      real(c_double), intent(out) :: edp_error

      edp = response%edp
      collapsed = merge(1, 0, response%collapsed)
      impacts = response%impacts
      time_of_peak = response%time_of_peak
      edp_error = response%edp_error
   end subroutine unpack_response

end module dondolo_boundary
