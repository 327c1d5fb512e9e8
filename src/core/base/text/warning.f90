!> Warnings: results that are correct but may mislead. A warning is a code and numbers for programs, and a sentence for people.
!> The procedure that raises it has all three.
module dondolo_base_warning
   use, intrinsic :: iso_fortran_env, only : int64
   use dondolo_base_json, only : json_type
   use dondolo_base_kinds, only : wp
   use dondolo_base_lines, only : lines_type
   implicit none
   private

   public :: warning_type, warnings_type

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

   !> A warning, made by `warning_type(code)`
   type :: warning_type
      character(len=32) :: code
      !> What it is about
      integer, private :: words = 0
      type(word_type), private :: word(4) = word_type()
      !> Its numbers
      integer, private :: numbers = 0
      type(number_type), private :: number(6) = number_type()
      !> Sentence without a full stop
      character(len=:), allocatable, private :: sentence
   contains
      !> Name what it is about
      procedure :: about
      !> Add a number
      generic :: with => with_real, with_integer, with_count
      procedure, private :: with_real, with_integer, with_count
   end type warning_type

   !> Warnings in the order in which they were added
   type :: warnings_type
      integer :: count = 0
      !> The warnings; those beyond `count` are room
      type(warning_type), allocatable, private :: item(:)
   contains
      !> Add a warning with its sentence
      procedure :: add
      !> Put the sentences into lines
      procedure :: put_sentences
      !> Put JSON objects into lines, one each
      procedure :: put_objects
      !> Put an array `warnings` into a JSON object
      procedure :: put_array
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

   subroutine add(self, warning, sentence)
      class(warnings_type), intent(inout) :: self
      type(warning_type), intent(in) :: warning
      !> Sentence without a full stop
      character(len=*), intent(in) :: sentence

      type(warning_type), allocatable :: more(:)

      if (.not. allocated(self%item)) allocate (self%item(1))
      if (self%count == size(self%item)) then
         allocate (more(2*self%count))
         more(:self%count) = self%item
         call move_alloc(more, self%item)
      end if
      self%count = self%count + 1
      self%item(self%count) = warning
      self%item(self%count)%sentence = sentence
   end subroutine add

   subroutine put_sentences(self, lines)
      class(warnings_type), intent(in) :: self
      !> Lines to add to
      type(lines_type), intent(inout) :: lines

      integer :: i

      do i = 1, self%count
         call lines%add(self%item(i)%sentence)
      end do
   end subroutine put_sentences

   subroutine put_objects(self, lines)
      class(warnings_type), intent(in) :: self
      !> Lines to add to
      type(lines_type), intent(inout) :: lines

      type(json_type) :: json
      character(len=:), allocatable :: text
      integer :: i

      do i = 1, self%count
         json = json_type(is_compact=.true.)
         call put_warning(self%item(i), json)
         call json%get(text)
         call lines%add(text)
      end do
   end subroutine put_objects

   subroutine put_array(self, json, name)
      class(warnings_type), intent(in) :: self
      !> JSON, in an object
      type(json_type), intent(inout) :: json
      !> Name of the array; 'warnings' if absent
      character(len=*), intent(in), optional :: name

      integer :: i

      if (present(name)) then
         call json%open_array(name)
      else
         call json%open_array('warnings')
      end if
      do i = 1, self%count
         call put_warning(self%item(i), json)
      end do
      call json%close_array()
   end subroutine put_array

   !> Put one warning as an object
   subroutine put_warning(warning, json)
      type(warning_type), intent(in) :: warning
      type(json_type), intent(inout) :: json

      integer :: i

      call json%open_object()
      call json%put('code', trim(warning%code))
      call json%open_object('subject')
      do i = 1, warning%words
         call json%put(trim(warning%word(i)%name), warning%word(i)%text)
      end do
      call json%close_object()
      call json%open_object('numbers')
      do i = 1, warning%numbers
         call json%put(trim(warning%number(i)%name), warning%number(i)%value)
      end do
      call json%close_object()
      call json%put('sentence', warning%sentence)
      call json%close_object()
   end subroutine put_warning

end module dondolo_base_warning
