!> dondolo: fragility of masonry walls that rock and overturn in earthquakes. The names a program needs.
module dondolo
   use dondolo_error, only : error_type
   use dondolo_kinds, only : wp
   use dondolo_record, only : record_type, new_record
   implicit none
   private

   public :: wp, error_type
   public :: record_type, new_record

end module dondolo
