!> Writer of JSON (RFC 8259): values are added one after the other, names and nesting are kept in order here.
!>
!> The text is valid whatever is put in: strings are escaped, bytes that are not UTF-8 become U+FFFD, and a number that
!> JSON cannot express (NaN, infinity) becomes null.
module dondolo_base_json
   use, intrinsic :: iso_fortran_env, only : int64
   use dondolo_base_encoding, only : is_utf8
   use dondolo_base_kinds, only : wp
   use dondolo_base_text, only : make_real, to_text
   implicit none
   private

   public :: json_type

   !> Blanks of indentation for each level of nesting
   integer, parameter :: indentation = 2

   !> A JSON text in the making
   type :: json_type
      !> Write everything on one line
      logical :: is_compact = .false.
      !> The text, and its length so far: the rest is room
      character(len=:), allocatable, private :: buffer
      integer, private :: length = 0
      !> Objects and arrays that are open
      integer, private :: depth = 0
      !> Nothing has been put yet into the object or array opened last
      logical, private :: is_empty = .true.
   contains
      !> Open an object or an array; `name` is left out in an array and at the top
      procedure :: open_object
      procedure :: open_array
      !> Close what was opened last
      procedure :: close_object
      procedure :: close_array
      !> Add a member of an object; an empty name makes it an element of an array
      generic :: put => put_text, put_real, put_reals, put_integer, put_count, put_logical
      procedure, private :: put_text, put_real, put_reals, put_integer, put_count, put_logical
      !> Add a member whose value is JSON already
      procedure :: put_raw
      !> Get the text
      procedure :: get
   end type json_type

contains

   subroutine open_object(self, name)
      class(json_type), intent(inout) :: self
      character(len=*), intent(in), optional :: name

      call open_with(self, '{', name)
   end subroutine open_object

   subroutine open_array(self, name)
      class(json_type), intent(inout) :: self
      character(len=*), intent(in), optional :: name

      call open_with(self, '[', name)
   end subroutine open_array

   subroutine close_object(self)
      class(json_type), intent(inout) :: self

      call close_with(self, '}')
   end subroutine close_object

   subroutine close_array(self)
      class(json_type), intent(inout) :: self

      call close_with(self, ']')
   end subroutine close_array

   subroutine put_text(self, name, value)
      class(json_type), intent(inout) :: self
      character(len=*), intent(in) :: name
      character(len=*), intent(in) :: value

      call begin(self, name)
      call append_quoted(self, value)
   end subroutine put_text

   subroutine put_real(self, name, value)
      class(json_type), intent(inout) :: self
      character(len=*), intent(in) :: name
      real(wp), intent(in) :: value

      call begin(self, name)
      call append_real(self, value)
   end subroutine put_real

   subroutine put_reals(self, name, values)
      class(json_type), intent(inout) :: self
      character(len=*), intent(in) :: name
      real(wp), intent(in) :: values(:)

      integer :: i

      call begin(self, name)
      call append(self, '[')
      do i = 1, size(values)
         if (i > 1) call append(self, ', ')
         call append_real(self, values(i))
      end do
      call append(self, ']')
   end subroutine put_reals

   subroutine put_integer(self, name, value)
      class(json_type), intent(inout) :: self
      character(len=*), intent(in) :: name
      integer, intent(in) :: value

      call self%put_raw(name, to_text(value))
   end subroutine put_integer

   subroutine put_count(self, name, value)
      class(json_type), intent(inout) :: self
      character(len=*), intent(in) :: name
      integer(int64), intent(in) :: value

      call self%put_raw(name, to_text(value))
   end subroutine put_count

   subroutine put_logical(self, name, value)
      class(json_type), intent(inout) :: self
      character(len=*), intent(in) :: name
      logical, intent(in) :: value

      call self%put_raw(name, trim(merge('true ', 'false', value)))
   end subroutine put_logical

   subroutine put_raw(self, name, value)
      class(json_type), intent(inout) :: self
      character(len=*), intent(in) :: name
      character(len=*), intent(in) :: value

      call begin(self, name)
      call append(self, value)
   end subroutine put_raw

   !> Get the text so far, whole when everything is closed; lines end in LF, the last has no end
   subroutine get(self, text)
      class(json_type), intent(in) :: self
      character(len=:), allocatable, intent(out) :: text

      text = ''
      if (self%length > 0) text = self%buffer(:self%length)
   end subroutine get

   !> Open an object or an array
   subroutine open_with(self, bracket, name)
      class(json_type), intent(inout) :: self
      character(len=1), intent(in) :: bracket
      character(len=*), intent(in), optional :: name

      if (present(name)) then
         call begin(self, name)
      else
         call begin(self, '')
      end if
      call append(self, bracket)
      self%depth = self%depth + 1
      self%is_empty = .true.
   end subroutine open_with

   !> Close an object or an array
   subroutine close_with(self, bracket)
      class(json_type), intent(inout) :: self
      character(len=1), intent(in) :: bracket

      self%depth = self%depth - 1
      if (.not. self%is_empty) call new_line_of(self)
      call append(self, bracket)
      self%is_empty = .false.
   end subroutine close_with

   !> Begin a member: comma, line, name
   subroutine begin(self, name)
      class(json_type), intent(inout) :: self
      character(len=*), intent(in) :: name

      if (self%depth > 0) then
         if (.not. self%is_empty) call append(self, ',')
         if (self%is_compact .and. .not. self%is_empty) call append(self, ' ')
         call new_line_of(self)
      end if
      self%is_empty = .false.
      if (len(name) == 0) return
      call append_quoted(self, name)
      call append(self, ': ')
   end subroutine begin

   !> Begin a line with its indentation, unless all is on one line
   subroutine new_line_of(self)
      class(json_type), intent(inout) :: self

      if (.not. self%is_compact) call append(self, new_line('a')//repeat(' ', indentation*self%depth))
   end subroutine new_line_of

   !> Append a number, or null where JSON has none
   subroutine append_real(self, value)
      class(json_type), intent(inout) :: self
      real(wp), intent(in) :: value

      character(len=:), allocatable :: text

      if (abs(value) <= huge(value)) then
         call make_real(value, text)
         call append(self, text)
      else
         call append(self, 'null')
      end if
   end subroutine append_real

   !> Append a string in quotes
   subroutine append_quoted(self, text)
      class(json_type), intent(inout) :: self
      character(len=*), intent(in) :: text

      character(len=*), parameter :: figures = '0123456789abcdef', replacement = '\ufffd'
      integer :: i, code
      logical :: is_sound

      is_sound = is_utf8(text)
      call append(self, '"')
      do i = 1, len(text)
         code = ichar(text(i:i))
         if (text(i:i) == '"' .or. text(i:i) == '\') then
            call append(self, '\'//text(i:i))
         else if (code < 32 .or. code == 127) then
            call append(self, '\'//'u00'//figures(code/16 + 1:code/16 + 1)// &
               & figures(modulo(code, 16) + 1:modulo(code, 16) + 1))
         else if (code >= 128 .and. .not. is_sound) then
            call append(self, replacement)
         else
            call append(self, text(i:i))
         end if
      end do
      call append(self, '"')
   end subroutine append_quoted

   !> Append bytes; the room doubles when it is used up
   subroutine append(self, text)
      class(json_type), intent(inout) :: self
      character(len=*), intent(in) :: text

      character(len=:), allocatable :: more

      if (.not. allocated(self%buffer)) allocate (character(len=1024) :: self%buffer)
      if (self%length + len(text) > len(self%buffer)) then
         allocate (character(len=2*(self%length + len(text))) :: more)
         more(:self%length) = self%buffer(:self%length)
         call move_alloc(more, self%buffer)
      end if
      self%buffer(self%length + 1:self%length + len(text)) = text
      self%length = self%length + len(text)
   end subroutine append

end module dondolo_base_json
