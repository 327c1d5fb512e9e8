!> Warnings as facts: a code, what it is about, and numbers. Sentences are made of them at the end, in
!> dondolo_case_warning_sentence.
module dondolo_case_warning
   use, intrinsic :: iso_fortran_env, only : int64
   use dondolo_base_kinds, only : wp
   implicit none
   private

   public :: warning_type, warnings_type
   public :: word_type, number_type

   !> A name that a warning is about
   type :: word_type
      !> What it is the name of, such as `wall`
      character(len=16) :: name = ''
      character(len=:), allocatable :: text
   end type word_type

   !> A number of a warning; counts are numbers too
   type :: number_type
      character(len=24) :: name = ''
      real(wp) :: value = 0.0_wp
   end type number_type

   !> A warning
   type :: warning_type
      !> What it is, such as `scale_factors_large`
      character(len=32) :: code = ''
      !> What it is about
      integer :: words = 0
      type(word_type) :: word(4) = word_type()
      !> Its numbers
      integer :: numbers = 0
      type(number_type) :: number(6) = number_type()
   contains
      !> Say what it is about
      procedure :: about
      !> Add a number
      generic :: with => with_real, with_integer, with_count
      procedure, private :: with_real, with_integer, with_count
      !> Value of a number
      procedure :: value
      !> Get a name, empty if there is none of this kind
      procedure :: get_word
   end type warning_type

   !> Warnings in the order in which they were added
   type :: warnings_type
      integer :: count = 0
      !> The warnings; those beyond `count` are room
      type(warning_type), allocatable :: item(:)
   contains
      !> Add a warning
      procedure :: add
   end type warnings_type

contains

   subroutine about(self, name, text)
      class(warning_type), intent(inout) :: self
      character(len=*), intent(in) :: name
      character(len=*), intent(in) :: text

      self%words = self%words + 1
      self%word(self%words)%name = name
      self%word(self%words)%text = text
   end subroutine about

   subroutine with_real(self, name, value)
      class(warning_type), intent(inout) :: self
      character(len=*), intent(in) :: name
      real(wp), intent(in) :: value

      self%numbers = self%numbers + 1
      self%number(self%numbers) = number_type(name, value)
   end subroutine with_real

   subroutine with_integer(self, name, value)
      class(warning_type), intent(inout) :: self
      character(len=*), intent(in) :: name
      integer, intent(in) :: value

      call self%with(name, real(value, wp))
   end subroutine with_integer

   subroutine with_count(self, name, value)
      class(warning_type), intent(inout) :: self
      character(len=*), intent(in) :: name
      integer(int64), intent(in) :: value

      call self%with(name, real(value, wp))
   end subroutine with_count

   !> Value of a number; 0 if there is none of this name
   pure real(wp) function value(self, name)
      class(warning_type), intent(in) :: self
      character(len=*), intent(in) :: name

      integer :: i

      value = 0.0_wp
      do i = 1, self%numbers
         if (self%number(i)%name == name) value = self%number(i)%value
      end do
   end function value

   subroutine get_word(self, name, text)
      class(warning_type), intent(in) :: self
      character(len=*), intent(in) :: name
      character(len=:), allocatable, intent(out) :: text

      integer :: i

      text = ''
      do i = 1, self%words
         if (self%word(i)%name == name) text = self%word(i)%text
      end do
   end subroutine get_word

   subroutine add(self, warning)
      class(warnings_type), intent(inout) :: self
      type(warning_type), intent(in) :: warning

      type(warning_type), allocatable :: more(:)

      if (.not. allocated(self%item)) allocate (self%item(1))
      if (self%count == size(self%item)) then
         allocate (more(2*self%count))
         more(:self%count) = self%item
         call move_alloc(more, self%item)
      end if
      self%count = self%count + 1
      self%item(self%count) = warning
   end subroutine add

end module dondolo_case_warning
