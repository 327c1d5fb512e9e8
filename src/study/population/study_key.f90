!> Identity of the results of a study: all that they depend on, by name. Results of studies that are identical may stand
!> in one store.
module dondolo_population_study_key
   use dondolo_base_error, only : error_type, raise_input
   use dondolo_base_lines, only : lines_type
   implicit none
   private

   public :: study_key_type

   !> What separates the name of a setting from its value
   character(len=*), parameter :: equals = ' = '
   !> Values that are longer are not shown where they differ
   integer, parameter :: longest_shown = 48

   !> Settings by name, each a line `name = value`
   type :: study_key_type
      !> The lines, in the order in which they were added
      type(lines_type) :: settings
   contains
      !> Add a setting
      procedure :: add
      !> Value of a setting
      procedure :: get
      !> Give a setting another value
      procedure :: replace
      !> Check that another study is identical
      procedure :: compare
   end type study_key_type

contains

   !> Add a setting
   subroutine add(self, name, value)
      class(study_key_type), intent(inout) :: self
      !> Name of the setting
      character(len=*), intent(in) :: name
      !> Its value, on one line
      character(len=*), intent(in) :: value

      call self%settings%add(name//equals//value)
   end subroutine add

   !> Value of a setting
   pure subroutine get(self, name, value)
      class(study_key_type), intent(in) :: self
      !> Name of the setting
      character(len=*), intent(in) :: name
      !> Its value; not allocated: there is none
      character(len=:), allocatable, intent(out) :: value

      integer :: i

      do i = 1, self%settings%count
         associate (line => self%settings%line(i)%text)
            if (index(line, name//equals) /= 1) cycle
            value = line(len(name//equals) + 1:)
            return
         end associate
      end do
   end subroutine get

   !> Give a setting another value
   subroutine replace(self, name, value)
      class(study_key_type), intent(inout) :: self
      !> Name of the setting, which is there
      character(len=*), intent(in) :: name
      !> Its new value
      character(len=*), intent(in) :: value

      integer :: i

      do i = 1, self%settings%count
         if (index(self%settings%line(i)%text, name//equals) == 1) self%settings%line(i)%text = name//equals//value
      end do
   end subroutine replace

   !> Check that another study is identical
   subroutine compare(self, other, path, error)
      !> The identity of what is asked for
      class(study_key_type), intent(in) :: self
      !> That of a store
      class(study_key_type), intent(in) :: other
      !> Path of the store
      character(len=*), intent(in) :: path
      !> Everything that differs
      type(error_type), allocatable, intent(out) :: error

      character(len=:), allocatable :: name, here, there, differences
      integer :: i

      differences = ''
      do i = 1, self%settings%count
         associate (line => self%settings%line(i)%text)
            name = line(:index(line, equals) - 1)
         end associate
         call self%get(name, here)
         call other%get(name, there)
         if (.not. allocated(there)) there = ''
         if (there == here .and. len(there) == len(here)) cycle
         if (len(differences) > 0) differences = differences//'; '
         if (is_fingerprint(here) .or. max(len(here), len(there)) > longest_shown .or. len(there) == 0) then
            differences = differences//'other '//name
         else
            differences = differences//name//' '//there//' there, '//here//' here'
         end if
      end do
      if (len(differences) == 0 .and. self%settings%count /= other%settings%count) differences = 'other settings'
      if (len(differences) > 0) call raise_input(error, path//': belongs to another study: '//differences)
   end subroutine compare

   !> Is a value a fingerprint, which says nothing to a reader?
   pure logical function is_fingerprint(value)
      !> The value
      character(len=*), intent(in) :: value

      is_fingerprint = len(value) == 16 .and. verify(value, '0123456789ABCDEF') == 0
   end function is_fingerprint

end module dondolo_population_study_key
