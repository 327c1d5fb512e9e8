!> Files in the making that Python knows by handles.
module dondolo_held_files
   use, intrinsic :: iso_c_binding, only : c_int64_t
   use dondolo_base_error, only : error_type
   use dondolo_case_result_files, only : result_files_type
   use dondolo_files_lock, only : lock_type
   use dondolo_files_whole_file, only : whole_file_type
   use dondolo_interface_handles, only : content_of, refuse_handle
   implicit none
   private

   public :: find_file, find_set, end_with

contains

   !> The file of a handle
   subroutine find_file(handle, file, error)
      !> The handle
      integer(c_int64_t), intent(in) :: handle
      !> The file
      type(whole_file_type), pointer, intent(out) :: file
      !> The handle is that of no file, or was freed
      type(error_type), allocatable, intent(out) :: error

      class(*), pointer :: content

      file => null()
      content => content_of(handle)
      select type (content)
      type is (whole_file_type)
         file => content
      class default
         call refuse_handle('file', handle, error)
      end select
   end subroutine find_file

   !> The set of result files of a handle
   subroutine find_set(handle, set, error)
      !> The handle
      integer(c_int64_t), intent(in) :: handle
      !> The set
      type(result_files_type), pointer, intent(out) :: set
      !> The handle is that of no set, or was freed
      type(error_type), allocatable, intent(out) :: error

      class(*), pointer :: content

      set => null()
      content => content_of(handle)
      select type (content)
      type is (result_files_type)
         set => content
      class default
         call refuse_handle('files', handle, error)
      end select
   end subroutine find_set

   !> End with what a handle stands for, whatever has happened: a file, a set or a lock
   subroutine end_with(handle)
      !> The handle
      integer(c_int64_t), intent(in) :: handle

      class(*), pointer :: content

      content => content_of(handle)
      select type (content)
      type is (result_files_type)
         call content%close()
      type is (whole_file_type)
         call content%close()
      type is (lock_type)
         call content%release()
      end select
   end subroutine end_with

end module dondolo_held_files
