!> The identity of settings: intermediate results belong to one set of the values that change them.
module dondolo_files_settings_key
   use dondolo_base_fingerprint, only : fingerprint_type
   use dondolo_base_property, only : is_list, property_type
   use dondolo_base_settings, only : settings_type
   implicit none
   private

   public :: add_settings

contains

   !> Add all values that change results to a fingerprint, each with its name; how many a list has is part of it
   subroutine add_settings(fingerprint, settings)
      type(fingerprint_type), intent(inout) :: fingerprint
      !> Settings of a group, or of a wall
      class(settings_type), intent(in) :: settings

      type(property_type), pointer :: table(:)
      integer :: i

      call settings%get_table(table)
      do i = 1, size(table)
         associate (property => table(i))
            if (.not. (property%changes_results .and. settings%has(property%name))) cycle
            call fingerprint%add_text(trim(property%name))
            if (settings%has_word(property%name)) then
               call fingerprint%add_text(settings%word(property%name))
            else if (property%kind == is_list) then
               call fingerprint%add_reals(settings%list(property%name))
            else
               call fingerprint%add_reals([settings%number(property%name)])
            end if
         end associate
      end do
   end subroutine add_settings

end module dondolo_files_settings_key
