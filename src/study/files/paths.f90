!> Paths that are relative to the file they stand in.
module dondolo_files_paths
   use dondolo_files_system, only : is_absolute, last_separator
   implicit none
   private

   public :: beside

contains

   !> A path as seen from the current folder
   pure function beside(path, file) result(resolved)
      !> Path, relative to the folder of a file, or absolute
      character(len=*), intent(in) :: path
      !> The file
      character(len=*), intent(in) :: file
      !> The path relative to the current folder, or absolute
      character(len=len(path) + merge(0, last_separator(file), is_absolute(path))) :: resolved

      resolved = path
      if (.not. is_absolute(path)) resolved = file(:last_separator(file))//path
   end function beside

end module dondolo_files_paths
