!> Numbers and texts of the objects of the C interface, by name.
module dondolo_interface_c_results
   use, intrinsic :: ieee_arithmetic, only : ieee_quiet_nan, ieee_value
   use, intrinsic :: iso_c_binding, only : c_char, c_double, c_int, c_loc, c_null_char, c_ptr
   use dondolo_base_error, only : error_type, raise_input
   use dondolo_base_kinds, only : wp
   use dondolo_base_lines, only : lines_type
   use dondolo_base_plain, only : shown
   use dondolo_base_spelling, only : say_allowed
   use dondolo_base_text, only : to_text
   use dondolo_files_version, only : dondolo_version_text
   use dondolo_fragility, only : fit_status_names
   use dondolo_interface_c_error, only : failure_type, is_ready, status_without_handle
   use dondolo_interface_c_history, only : c_history_type
   use dondolo_interface_c_settings, only : c_settings_type
   use dondolo_interface_c_stripes, only : c_curve_type, c_stripes_type
   use dondolo_interface_c_text, only : as_handle, give_text, take_numbers, take_text
   use dondolo_interface_handles, only : content_of, records_type, refuse_handle, walls_type
   use dondolo_interface_wall_statics, only : static_names, statics_of
   use dondolo_records_reading_notes, only : list_reading_notes
   implicit none
   private

   !> Length of a name
   integer, parameter :: longest = len(static_names)

   !> Numbers of records: samples and time steps [s], PGA [m/s2]; number of the cluster of each
   character(len=longest), parameter :: record_numbers(4) = [character(len=longest) :: 'samples', 'dt', 'pga', 'cluster']

   !> Numbers of a wall
   character(len=longest), parameter :: wall_numbers(17) = [character(len=longest) :: static_names, 'two_sided']

   !> Numbers of stripes: one each; of each level; of each history of a level; of each history, level by level
   character(len=longest), parameter :: stripes_numbers(14) = [character(len=longest) :: 'edp_limit', 'levels', 'histories', &
      & 'collapses', 'record', 'polarity', 'scale', 'ran', 'edp', 'collapsed', 'impacts', 'time_of_peak', 'edp_error', 'cluster']

   !> Numbers of a curve
   character(len=longest), parameter :: curve_numbers(13) = [character(len=longest) :: 'has_curve', 'theta', 'beta', &
      & 'has_errors', 'se_ln_theta', 'se_beta', 'covariance', 'clusters', 'degrees_of_freedom', 'log_likelihood', 'bracket', &
      & 'deviance', 'deviance_dof']

   !> Numbers of a motion: one each, then columns of its time history
   character(len=longest), parameter :: history_numbers(11) = [character(len=longest) :: 'edp', 'collapsed', 'impacts', &
      & 'time_of_peak', 'edp_error', 'time', 'acceleration', 'rotation', 'velocity', 'side', 'after_impact']

   !> Version of the library as C has it
   integer :: k
   character(kind=c_char), target :: version_text(len(dondolo_version_text) + 1) = &
      & [(dondolo_version_text(k:k), k=1, len(dondolo_version_text)), c_null_char]

contains

   !> How many numbers of a name an object has; -1: there is an error
   integer(c_int) function count_numbers(error, object, name) result(count) bind(c, name='dondolo_count')
      type(c_ptr), intent(in), value :: error, object, name

      type(failure_type), pointer :: failure
      type(error_type), allocatable :: problem
      real(wp), allocatable :: values(:)

      count = -1
      if (.not. is_ready(error, failure)) return
      call find_numbers(object, name, values, problem)
      if (.not. allocated(problem)) count = size(values)
      call failure%take(problem)
   end function count_numbers

   !> The number of a name; NaN: there is an error
   real(c_double) function get_number(error, object, name) result(value) bind(c, name='dondolo_get_number')
      type(c_ptr), intent(in), value :: error, object, name

      type(failure_type), pointer :: failure
      type(error_type), allocatable :: problem
      real(wp), allocatable :: values(:)
      character(len=:), allocatable :: text

      value = ieee_value(value, ieee_quiet_nan)
      if (.not. is_ready(error, failure)) return
      call find_numbers(object, name, values, problem)
      if (.not. allocated(problem)) then
         if (size(values) == 1) then
            value = values(1)
         else
            call take_text(name, 'name', text, problem)
            call raise_input(problem, shown(text)//': has '//to_text(size(values))//' values, dondolo_get_numbers gets them')
         end if
      end if
      call failure%take(problem)
   end function get_number

   !> All numbers of a name
   integer(c_int) function get_numbers(error, object, name, values, count) result(status) &
      & bind(c, name='dondolo_get_numbers')
      type(c_ptr), intent(in), value :: error, object, name
      !> Room for them
      type(c_ptr), intent(in), value :: values
      !> How many there are, as from count_numbers
      integer(c_int), intent(in), value :: count

      type(failure_type), pointer :: failure
      type(error_type), allocatable :: problem
      real(wp), allocatable :: found(:)
      real(c_double), pointer :: room(:)
      character(len=:), allocatable :: text

      status = status_without_handle
      if (is_ready(error, failure)) then
         call find_numbers(object, name, found, problem)
         if (.not. allocated(problem)) call take_text(name, 'name', text, problem)
         if (.not. allocated(problem) .and. size(found) /= count) call raise_input(problem, text//': has '// &
            & to_text(size(found))//' values, there is room for '//to_text(int(count)))
         if (.not. allocated(problem)) call take_numbers(values, count, 'values', room, problem)
         if (.not. allocated(problem)) room = found
         call failure%take(problem)
      end if
      if (associated(failure)) status = failure%status()
   end function get_numbers

   !> The text of a name, ended by NUL and cut where there is no more room; returns its whole length, -1: there is an error
   integer(c_int) function get_text(error, object, name, text, size) result(length) bind(c, name='dondolo_get_text')
      type(c_ptr), intent(in), value :: error, object, name
      !> Room for it, NULL: none, and its bytes
      type(c_ptr), intent(in), value :: text
      integer(c_int), intent(in), value :: size

      type(failure_type), pointer :: failure
      type(error_type), allocatable :: problem
      character(len=:), allocatable :: found

      length = -1
      call give_text('', text, size)
      if (.not. is_ready(error, failure)) return
      call find_text(object, name, found, problem)
      if (.not. allocated(problem)) then
         length = len(found)
         call give_text(found, text, size)
      end if
      call failure%take(problem)
   end function get_text

   !> Version of the library
   type(c_ptr) function get_version() result(version) bind(c, name='dondolo_get_version')

      version = c_loc(version_text)
   end function get_version

   !> Find numbers
   subroutine find_numbers(object, name, values, error)
      !> Handle of anything but settings and errors
      type(c_ptr), intent(in) :: object
      !> Their name
      type(c_ptr), intent(in) :: name
      !> The numbers
      real(wp), allocatable, intent(out) :: values(:)
      !> The handle is not valid, or has no numbers of this name: with the names that there are
      type(error_type), allocatable, intent(out) :: error

      class(*), pointer :: content
      character(len=:), allocatable :: text

      call take_text(name, 'name', text, error)
      if (allocated(error)) return
      content => content_of(as_handle(object))
      select type (content)
      type is (records_type)
         call numbers_of_records(content, text, values)
         call check_name(record_numbers, allocated(values), 'records')
      type is (walls_type)
         call numbers_of_wall(content, text, values)
         call check_name(wall_numbers, allocated(values), 'wall')
      type is (c_stripes_type)
         call numbers_of_stripes(content, text, values)
         call check_name(stripes_numbers, allocated(values), 'stripes')
      type is (c_curve_type)
         call numbers_of_curve(content, text, values)
         call check_name(curve_numbers, allocated(values), 'curve')
      type is (c_history_type)
         call numbers_of_history(content, text, values)
         call check_name(history_numbers, allocated(values), 'history')
      class default
         call refuse_handle('records, wall, stripes, curve or history', as_handle(object), error)
      end select

   contains

      !> Refuse a name that there is not
      subroutine check_name(names, is_known, of)
         !> The names that there are
         character(len=*), intent(in) :: names(:)
         logical, intent(in) :: is_known
         !> What has them
         character(len=*), intent(in) :: of

         character(len=:), allocatable :: allowed

         if (is_known) return
         call say_allowed(text(:min(len(text), 2*longest)), names, '', allowed)
         call raise_input(error, of//': '//shown(text)//': no such number'//allowed)
      end subroutine check_name

   end subroutine find_numbers

   !> Numbers of records
   pure subroutine numbers_of_records(held, name, values)
      type(records_type), intent(in) :: held
      character(len=*), intent(in) :: name
      !> Not allocated: there are none of this name
      real(wp), allocatable, intent(out) :: values(:)

      integer :: i

      associate (suite => held%suite)
         select case (name)
         case ('samples')
            values = [(real(size(suite%records(i)%acceleration), wp), i=1, size(suite%records))]
         case ('dt')
            values = suite%records%dt
         case ('pga')
            values = suite%peaks
         case ('cluster')
            values = real(suite%clusters, wp)
         end select
      end associate
   end subroutine numbers_of_records

   !> Numbers of a wall
   subroutine numbers_of_wall(held, name, values)
      type(walls_type), intent(in) :: held
      character(len=*), intent(in) :: name
      !> Not allocated: there are none of this name
      real(wp), allocatable, intent(out) :: values(:)

      real(wp) :: all(size(wall_numbers))
      integer :: at

      all = [statics_of(held%wall(1)), merge(1.0_wp, 0.0_wp, held%wall(1)%mechanism%two_sided)]
      at = findloc(wall_numbers, name, dim=1)
      if (at > 0) values = [all(at)]
   end subroutine numbers_of_wall

   !> Numbers of stripes
   pure subroutine numbers_of_stripes(held, name, values)
      type(c_stripes_type), intent(in) :: held
      character(len=*), intent(in) :: name
      !> Not allocated: there are none of this name
      real(wp), allocatable, intent(out) :: values(:)

      associate (stripes => held%stripes, n => size(held%stripes%scale))
         select case (name)
         case ('edp_limit')
            values = [held%edp_limit]
         case ('levels')
            values = stripes%levels
         case ('histories')
            values = real(stripes%histories(), wp)
         case ('collapses')
            values = real(stripes%collapses(), wp)
         case ('record')
            ! From 0, as C counts
            values = real(stripes%record - 1, wp)
         case ('polarity')
            values = real(stripes%polarity, wp)
         case ('cluster')
            values = real(held%clusters(stripes%record), wp)
         case ('scale')
            values = reshape(stripes%scale, [n])
         case ('ran')
            values = reshape(merge(1.0_wp, 0.0_wp, stripes%ran), [n])
         case ('edp')
            values = reshape(stripes%response%edp, [n])
         case ('collapsed')
            values = reshape(merge(1.0_wp, 0.0_wp, stripes%response%collapsed), [n])
         case ('impacts')
            values = reshape(real(stripes%response%impacts, wp), [n])
         case ('time_of_peak')
            values = reshape(stripes%response%time_of_peak, [n])
         case ('edp_error')
            values = reshape(stripes%response%edp_error, [n])
         end select
      end associate
   end subroutine numbers_of_stripes

   !> Numbers of a curve
   subroutine numbers_of_curve(held, name, values)
      type(c_curve_type), intent(in) :: held
      character(len=*), intent(in) :: name
      !> Not allocated: there are none of this name
      real(wp), allocatable, intent(out) :: values(:)

      associate (curve => held%fragility)
         select case (name)
         case ('has_curve')
            values = [merge(1.0_wp, 0.0_wp, curve%has_fit())]
         case ('theta')
            values = [known(curve%theta, curve%has_fit())]
         case ('beta')
            values = [known(curve%beta, curve%has_fit())]
         case ('has_errors')
            values = [merge(1.0_wp, 0.0_wp, curve%has_errors())]
         case ('se_ln_theta')
            values = [known(curve%se_ln_theta(), curve%has_errors())]
         case ('se_beta')
            values = [known(curve%se_beta(), curve%has_errors())]
         case ('covariance')
            values = [known(curve%covariance(1, 1), curve%has_errors()), known(curve%covariance(1, 2), curve%has_errors()), &
               & known(curve%covariance(2, 2), curve%has_errors())]
         case ('clusters')
            values = [real(curve%clusters, wp)]
         case ('degrees_of_freedom')
            values = [curve%degrees_of_freedom]
         case ('log_likelihood')
            values = [known(curve%log_likelihood, curve%has_fit())]
         case ('bracket')
            values = curve%bracket
         case ('deviance')
            values = [known(curve%deviance, curve%has_fit())]
         case ('deviance_dof')
            values = [known(real(curve%deviance_dof, wp), curve%has_fit())]
         end select
      end associate
   end subroutine numbers_of_curve

   !> A number, or NaN
   real(wp) function known(value, is_known)
      real(wp), intent(in) :: value
      !> Is there one?
      logical, intent(in) :: is_known

      known = ieee_value(known, ieee_quiet_nan)
      if (is_known) known = value
   end function known

   !> Numbers of a motion
   pure subroutine numbers_of_history(held, name, values)
      type(c_history_type), intent(in) :: held
      character(len=*), intent(in) :: name
      !> Not allocated: there are none of this name
      real(wp), allocatable, intent(out) :: values(:)

      associate (response => held%response, trace => held%trace)
         select case (name)
         case ('edp')
            values = [response%edp]
         case ('collapsed')
            values = [merge(1.0_wp, 0.0_wp, response%collapsed)]
         case ('impacts')
            values = [real(response%impacts, wp)]
         case ('time_of_peak')
            values = [response%time_of_peak]
         case ('edp_error')
            values = [response%edp_error]
         case ('time')
            values = trace%time
         case ('acceleration')
            values = trace%acceleration
         case ('rotation')
            values = trace%rotation
         case ('velocity')
            values = trace%velocity
         case ('side')
            values = trace%side
         case ('after_impact')
            values = merge(1.0_wp, 0.0_wp, trace%after_impact)
         end select
      end associate
   end subroutine numbers_of_history

   !> Find a text
   subroutine find_text(object, name, text, error)
      !> Handle of anything but errors
      type(c_ptr), intent(in) :: object
      !> Its name
      type(c_ptr), intent(in) :: name
      !> The text; several have a line each
      character(len=:), allocatable, intent(out) :: text
      !> The handle is not valid, or has no text of this name: with the names that there are
      type(error_type), allocatable, intent(out) :: error

      class(*), pointer :: content
      character(len=:), allocatable :: what
      type(lines_type) :: lines
      integer :: i

      call take_text(name, 'name', what, error)
      if (allocated(error)) return
      content => content_of(as_handle(object))
      select type (content)
      type is (c_settings_type)
         if (.not. is_one_of([character(len=longest) :: 'variables'], 'settings')) return
         do i = 1, size(content%table)
            call lines%add(trim(content%table(i)%name))
         end do
      type is (records_type)
         if (.not. is_one_of([character(len=longest) :: 'names', 'warnings'], 'records')) return
         if (what == 'names') then
            do i = 1, size(content%suite%records)
               call lines%add(content%suite%records(i)%name)
            end do
         else
            if (allocated(content%note)) then
               if (len(content%note) > 0) call lines%add(content%note)
            end if
            call list_reading_notes(content%suite%records, lines)
         end if
      type is (walls_type)
         if (.not. is_one_of([character(len=longest) :: 'name', 'mechanism'], 'wall')) return
         if (what == 'name') call lines%add(content%wall(1)%name())
         if (what == 'mechanism') call lines%add(content%wall(1)%mechanism_name())
      type is (c_stripes_type)
         if (.not. is_one_of([character(len=longest) :: 'im', 'warnings'], 'stripes')) return
         if (what == 'im') then
            call lines%add(content%stripes%im)
         else
            lines = content%warnings
         end if
      type is (c_curve_type)
         if (.not. is_one_of([character(len=longest) :: 'status', 'errors', 'warnings'], 'curve')) return
         select case (what)
         case ('status')
            call lines%add(trim(fit_status_names(content%fragility%status)))
         case ('errors')
            call lines%add(trim(content%fragility%errors))
         case default
            lines = content%warnings
         end select
      type is (c_history_type)
         if (.not. is_one_of([character(len=longest) :: 'warnings'], 'history')) return
         lines = content%warnings
      class default
         call refuse_handle('settings, records, wall, stripes, curve or history', as_handle(object), error)
         return
      end select
      text = ''
      do i = 1, lines%count
         if (i > 1) text = text//new_line('a')
         text = text//lines%line(i)%text
      end do

   contains

      !> Is there a text of this name?
      logical function is_one_of(names, of)
         !> The names that there are
         character(len=*), intent(in) :: names(:)
         !> What has them
         character(len=*), intent(in) :: of

         character(len=:), allocatable :: allowed

         is_one_of = any(names == what)
         if (is_one_of) return
         call say_allowed(what(:min(len(what), 2*longest)), names, '', allowed)
         call raise_input(error, of//': '//shown(what)//': no such text'//allowed)
      end function is_one_of

   end subroutine find_text

end module dondolo_interface_c_results
