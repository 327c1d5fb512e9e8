!> What --status prints: how far the work on an output is, from its lock, its checkpoint and its results. Nothing is written.
module dondolo_status
   use, intrinsic :: iso_fortran_env, only : output_unit
   use dondolo_base_error, only : error_type, raise_missing
   use dondolo_base_lines, only : lines_type
   use dondolo_base_text, only : to_text
   use dondolo_case_replaced, only : list_outdated
   use dondolo_case_result_files, only : published_run
   use dondolo_files_lock, only : holder_type, look_at_lock
   use dondolo_files_system, only : file_exists
   use dondolo_population_store, only : look_into_store, store_type
   use dondolo_progress_bar, only : duration
   implicit none
   private

   public :: print_status

contains

   !> Print how far the work on an output is
   subroutine print_status(output, error)
      !> `output` of a case, or the path of a file of counts
      character(len=*), intent(in) :: output
      !> Nothing is known of it, or its checkpoint is something else
      type(error_type), allocatable, intent(out) :: error

      type(holder_type) :: holder, writer
      type(store_type) :: store
      type(lines_type) :: outdated
      character(len=:), allocatable :: path
      integer :: i
      logical :: is_locked, is_written, has_store

      path = output//'.checkpoint'
      if (file_exists(output)) path = output
      ! Who writes a checkpoint may be Python, which does not write results meanwhile.
      call look_at_lock(path, writer, is_written)
      call look_at_lock(output, holder, is_locked)
      if (.not. holder%is_alive .and. is_written) holder = writer
      call look_into_store(store, path, has_store, error)
      if (allocated(error)) return
      if (.not. (is_locked .or. is_written .or. has_store .or. len_trim(published_run(output)) > 0)) then
         call raise_missing(error, output//': no lock, no checkpoint and no results have this prefix')
         return
      end if
      if (holder%is_alive) then
         call say('running: process '//to_text(holder%pid)//' on '//trim(holder%host)//' since '//trim(holder%since))
      else if (is_locked .or. is_written) then
         call say('interrupted: process '//to_text(holder%pid)//' on '//trim(holder%host)//', begun '// &
            & trim(holder%since)//', has ended without its results; the same command resumes it')
      else if (has_store) then
         if (store%is_complete()) then
            call say('complete; nothing is running')
         else
            call say('interrupted; nothing is running, and the same command resumes it')
         end if
      else
         call say('finished; nothing is running')
      end if
      if (has_store) call print_rows(store, writer)
      if (len_trim(published_run(output)) > 0) call say('results are those of run '//published_run(output))
      call list_outdated(output, outdated)
      do i = 1, outdated%count
         write (output_unit, '(a)') outdated%line(i)%text
      end do

   contains

      !> Print a line
      subroutine say(text)
         character(len=*), intent(in) :: text

         write (output_unit, '(a)') output//': '//text
      end subroutine say

      !> Print how many rows are done, and the time that is left if the others take as long
      subroutine print_rows(store, writer)
         type(store_type), intent(in) :: store
         !> Who writes it
         type(holder_type), intent(in) :: writer

         character(len=:), allocatable :: left
         integer :: total

         total = store%identity%last - store%identity%first + 1
         left = ''
         if (writer%is_alive .and. writer%rows >= 0 .and. store%done > writer%rows) left = ', about '// &
            & trim(duration(real(writer%seconds)*real(total - store%done)/real(store%done - writer%rows)))//' left'
         call say(to_text(store%done)//' of '//to_text(total)//' rows in '//path//', '// &
            & to_text(int(100.0*real(store%done)/real(total)))//' %'//left)
      end subroutine print_rows

   end subroutine print_status

end module dondolo_status
