!> Effect of each shortcut of plain_motion on the histories of a case: `dondolo-shortcuts CASE.nml` prints a table.
program shortcuts
   use, intrinsic :: iso_fortran_env, only : error_unit, output_unit
   use dondolo_base_error, only : error_type
   use dondolo_base_kinds, only : wp
   use dondolo_base_text, only : to_text
   use dondolo_case, only : case_type
   use dondolo_case_read_case, only : read_case
   use dondolo_fragility_study, only : study_type
   use dondolo_motion_response, only : response_type
   use plain_motion, only : shortcut_type, simulate_plain
   implicit none

   !> Interval of the coarser sampling [s]
   real(wp), parameter :: coarse = 0.01_wp

   type(shortcut_type), parameter :: studied(*) = [ &
      & shortcut_type('none'), &
      & shortcut_type('rest below 1e-3 of the capacity', rest_height=1.0e-3_wp), &
      & shortcut_type('rest below 1e-4 of the capacity', rest_height=1.0e-4_wp), &
      & shortcut_type('rest below 1e-6 of the capacity', rest_height=1.0e-6_wp), &
      & shortcut_type('rocking starts at the next sample', late_start=.true.), &
      & shortcut_type('impact at the end of its step', unlocated=.true.), &
      & shortcut_type('peak of the samples', every=1), &
      & shortcut_type('peak of every 0.01 s', every=2), &
      & shortcut_type('steps across samples', straddling=.true.), &
      & shortcut_type('nothing after the record', no_tail=.true.), &
      & shortcut_type('all of these', 1.0e-4_wp, .true., .true., 2, .true., .true.)]

   type(case_type), target :: case
   type(study_type) :: study
   type(error_type), allocatable :: error
   type(response_type) :: response
   character(len=:), allocatable :: file
   real(wp), allocatable :: scales(:, :)
   integer :: i, j, k, length

   call get_command_argument(1, length=length)
   allocate (character(len=length) :: file)
   if (length > 0) call get_command_argument(1, file)
   call read_case(file, case, error)
   if (allocated(error)) then
      write (error_unit, '(a)') 'dondolo-shortcuts: '//error%message
      stop 1, quiet=.true.
   end if
   if (any(abs(case%suite%records%dt - 0.5_wp*coarse) > 1.0e-9_wp)) then
      write (error_unit, '(a)') 'dondolo-shortcuts: records must be sampled at 0.005 s'
      stop 1, quiet=.true.
   end if
   call case%make_study(study)
   scales = study%scales(case%wall)
   write (output_unit, '(a)') 'shortcut,record,im_level,edp,collapsed'
   do k = 1, size(studied)
      do j = 1, size(case%stripes%levels)
         do i = 1, size(case%suite%records)
            call simulate_plain(case%wall%mechanism, case%suite%records(i), scales(i, j), case%solver%solver, studied(k), &
               & response)
            write (output_unit, '(*(a))') trim(studied(k)%name), ',', case%suite%records(i)%name, ',', &
               & to_text(case%stripes%levels(j)), ',', to_text(response%edp), ',', &
               & to_text(merge(1, 0, response%collapsed))
         end do
      end do
   end do

end program shortcuts
