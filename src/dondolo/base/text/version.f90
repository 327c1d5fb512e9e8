!> The version of dondolo, the same as in fpm.toml.
module dondolo_base_version
   implicit none
   private

   public :: dondolo_version_text

   !> Version
   character(len=*), parameter :: dondolo_version_text = '0.1.0'

end module dondolo_base_version
