!> What --check prints: what would run.
module dondolo_plan
   use, intrinsic :: iso_fortran_env, only : output_unit
   use dondolo_case, only : case_type
   use dondolo_error, only : error_type
   use dondolo_kinds, only : wp
   use dondolo_lines, only : lines_type
   use dondolo_record_table, only : record_table
   use dondolo_run_case, only : plan_case
   use dondolo_text, only : to_text
   use dondolo_warnings, only : rounded
   use dondolo_work, only : work_type
   implicit none
   private

   public :: print_plan, print_walls

   !> Rows of a table that are shown before it is cut
   integer, parameter, public :: shown_rows = 20

contains

   !> Print what would run
   subroutine print_plan(case, error)
      !> The case
      type(case_type), intent(in) :: case
      !> What cannot be run
      type(error_type), allocatable, intent(out) :: error

      type(work_type) :: work

      if (case%job%task /= 'history') call plan_case(case, work, error)
      if (allocated(error)) return
      write (output_unit, '(a)') case%file//': correct, nothing was run', ''
      write (output_unit, '(a)') 'task: '//case%job%task
      if (len(case%job%title) > 0) write (output_unit, '(a)') 'title: '//case%job%title
      write (output_unit, '(a)') 'results: '//case%job%output//'_*.csv', ''
      call print_walls(case)
      call print_records(case)
      if (case%job%task == 'history') then
         write (output_unit, '(a)') 'one history: record '''//case%records(case%history%record)%name// &
            & ''', scale '//rounded(case%history_scale())
         return
      end if
      write (output_unit, '(a)') to_text(size(case%stripes%levels))//' levels of '//case%stripes%scaling%name//':'// &
         & list(case%stripes%levels)//case%stripes%scaling%unit_after_blank()
      write (output_unit, '(a)') to_text(work%histories)//' histories, polarity '//case%records_input%polarity
      write (output_unit, '(a)') 'of them '//to_text(work%still)//' stay below the trigger and never move; '// &
         & to_text(work%histories - work%still)//' will be integrated'
      call print_largest_scale(case)
   end subroutine print_plan

   !> Print the walls and their static quantities
   subroutine print_walls(case)
      !> The case
      type(case_type), intent(in) :: case

      integer :: i, walls, width

      walls = size(case%population%walls)
      width = 4
      do i = 1, walls
         width = max(width, len(case%population%walls(i)%input%name))
      end do
      width = min(width, 30)
      write (output_unit, '(a, a15, 6a11)') left('wall', width), 'mechanism', 'height', 'thickness', 'trigger', &
         & 'p', 'capacity', 'speed'
      write (output_unit, '(a, a15, 6a11)') left('', width), '', 'm', 'm', 'g', 'rad/s', 'rad', 'ratio'
      do i = 1, min(walls, shown_rows)
         associate (wall => case%population%walls(i))
            write (output_unit, '(a, a15, 2f11.3, f11.4, f11.4, f11.5, f11.4)') left(wall%input%name, width), &
               & wall%input%mechanism, wall%input%height, wall%input%thickness, &
               & wall%mechanism%trigger_acceleration()/wall%gravity, wall%mechanism%frequency_parameter(), &
               & wall%mechanism%capacity, wall%mechanism%restitution
         end associate
      end do
      if (walls > shown_rows) write (output_unit, '(a)') '... and '//to_text(walls - shown_rows)//' more'
      write (output_unit, '(a)') ''
   end subroutine print_walls

   !> Print the records
   subroutine print_records(case)
      !> The case
      type(case_type), intent(in) :: case

      type(lines_type) :: table
      integer :: i

      associate (scaling => case%stripes%scaling)
         ! The PGA stands there anyway
         if (allocated(case%values) .and. scaling%measure%kind /= 'pga') then
            table = record_table(case%records, case%solver%gravity, scaling%measure%name, scaling%measure%unit(), &
               & case%values/scaling%measure%level_size(case%solver%gravity))
         else
            table = record_table(case%records, case%solver%gravity)
         end if
      end associate
      do i = 1, table%count
         write (output_unit, '(a)') table%line(i)%text
      end do
      write (output_unit, '(a)') ''
   end subroutine print_records

   !> Print the largest scale factor
   subroutine print_largest_scale(case)
      !> The case
      type(case_type), intent(in) :: case

      real(wp) :: scale, largest
      integer :: i, j, at

      largest = 0.0_wp
      at = 1
      do i = 1, size(case%records)
         do j = 1, size(case%population%walls)
            scale = case%scale_to(j, i, case%stripes%levels(size(case%stripes%levels)))
            if (scale <= largest) cycle
            largest = scale
            at = i
         end do
      end do
      write (output_unit, '(a)') 'largest scale factor: '//rounded(largest)//' (record '''//case%records(at)%name// &
         & ''' at the highest level)'
   end subroutine print_largest_scale

   !> Numbers with blanks between them
   pure function list(values) result(text)
      !> Numbers
      real(wp), intent(in) :: values(:)
      !> Their texts
      character(len=:), allocatable :: text

      integer :: i

      text = ''
      do i = 1, size(values)
         text = text//' '//to_text(values(i))
      end do
   end function list

   !> A text padded or cut to a width
   pure function left(text, width)
      !> Text
      character(len=*), intent(in) :: text
      !> Width
      integer, intent(in) :: width
      !> The text and blanks, or its beginning
      character(len=width) :: left

      left = text
   end function left

end module dondolo_plan
