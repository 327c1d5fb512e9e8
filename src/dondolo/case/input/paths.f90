!> Paths that are relative to the file they stand in.
module dondolo_case_paths
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
      character(len=len(path) + merge(0, index(file, '/', back=.true.), path(1:1) == '/')) :: resolved

      resolved = path
      if (path(1:1) /= '/') resolved = file(:index(file, '/', back=.true.))//path
   end function beside

end module dondolo_case_paths
