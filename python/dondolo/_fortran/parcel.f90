!> Results whose size only the library knows, and errors, on their way to Python: f2py cannot pass them.
!>
!> A procedure sends a parcel and returns where it lies and how much it holds; `take` copies its contents into arrays of
!> these sizes and frees it. What is put in under a name is found by it, in its shape. Long series, as samples of records, are
!> put in one by one without a copy; `take_series` takes them in the same order, after all else, and the parcel is freed with
!> the last.
module dondolo_parcel
   use, intrinsic :: iso_c_binding, only : c_double, c_f_pointer, c_int, c_int64_t, c_intptr_t, c_loc, c_ptr
   use dondolo_base_error, only : error_type
   use dondolo_base_lines, only : lines_type
   use dondolo_base_text, only : to_text
   implicit none
   private

   public :: parcel_type, send, report, take, take_series

   !> Numbers that belong together
   type :: series_type
      real(c_double), allocatable :: values(:)
   end type series_type

   !> Contents of unknown size
   type :: parcel_type
      !> Integers
      integer(c_int), allocatable :: integers(:)
      !> Reals
      real(c_double), allocatable :: reals(:)
      !> Lines of text
      type(lines_type) :: lines
      !> What has a name, a line each: the name, its kind (integers, reals or lines), how many stand before it, and its shape,
      !> the dimension that changes most slowly first; no shape: a single value
      type(lines_type), private :: names
      !> Long series of reals
      type(series_type), allocatable, private :: series(:)
      !> How many of them have been put in, and taken
      integer, private :: given = 0, taken = 0
      !> How many lines there are, those inside of blocks too
      integer(c_int64_t), private :: line_count = 0
   contains
      procedure, private :: add_integers
      procedure, private :: add_reals
      !> Add numbers after those that are there
      generic :: add => add_integers, add_reals
      procedure, private :: put_integer, put_integers, put_real, put_reals, put_text, put_lines, name
      !> Put something in under a name
      generic :: put => put_integer, put_integers, put_real, put_reals, put_text, put_lines
      !> Put lines in that stand in one text
      procedure :: put_block
      !> Make room for series
      procedure :: expect_series
      !> Put a series in
      procedure :: move_series
      !> Put in a note, if there is one
      procedure :: put_note
   end type parcel_type

contains

   !> Add integers
   subroutine add_integers(self, integers)
      class(parcel_type), intent(inout) :: self
      !> Integers
      integer(c_int), intent(in) :: integers(:)

      if (allocated(self%integers)) then
         self%integers = [self%integers, integers]
      else
         self%integers = integers
      end if
   end subroutine add_integers

   !> Add reals
   subroutine add_reals(self, reals)
      class(parcel_type), intent(inout) :: self
      !> Reals
      real(c_double), intent(in) :: reals(:)

      if (allocated(self%reals)) then
         self%reals = [self%reals, reals]
      else
         self%reals = reals
      end if
   end subroutine add_reals

   !> Put an integer in under a name
   subroutine put_integer(self, name, value)
      class(parcel_type), intent(inout) :: self
      !> Its name
      character(len=*), intent(in) :: name
      integer(c_int), intent(in) :: value

      call self%name(name, 'integers', size_of(self%integers), [integer ::])
      call self%add([value])
   end subroutine put_integer

   !> Put integers in under a name
   subroutine put_integers(self, name, values, shape)
      class(parcel_type), intent(inout) :: self
      !> Their name
      character(len=*), intent(in) :: name
      integer(c_int), intent(in) :: values(:)
      !> Their shape, if they are more than a list
      integer, intent(in), optional :: shape(:)

      if (present(shape)) then
         call self%name(name, 'integers', size_of(self%integers), shape)
      else
         call self%name(name, 'integers', size_of(self%integers), [size(values)])
      end if
      call self%add(values)
   end subroutine put_integers

   !> Put a real in under a name
   subroutine put_real(self, name, value)
      class(parcel_type), intent(inout) :: self
      !> Its name
      character(len=*), intent(in) :: name
      real(c_double), intent(in) :: value

      call self%name(name, 'reals', number_of(self%reals), [integer ::])
      call self%add([value])
   end subroutine put_real

   !> Put reals in under a name
   subroutine put_reals(self, name, values, shape)
      class(parcel_type), intent(inout) :: self
      !> Their name
      character(len=*), intent(in) :: name
      real(c_double), intent(in) :: values(:)
      !> Their shape, if they are more than a list
      integer, intent(in), optional :: shape(:)

      if (present(shape)) then
         call self%name(name, 'reals', number_of(self%reals), shape)
      else
         call self%name(name, 'reals', number_of(self%reals), [size(values)])
      end if
      call self%add(values)
   end subroutine put_reals

   !> Put a text in under a name
   subroutine put_text(self, name, text)
      class(parcel_type), intent(inout) :: self
      !> Its name
      character(len=*), intent(in) :: name
      !> One line
      character(len=*), intent(in) :: text

      call self%name(name, 'lines', self%line_count, [integer ::])
      call self%lines%add(text)
      self%line_count = self%line_count + 1
   end subroutine put_text

   !> Put lines in that stand in one text, under a name
   subroutine put_block(self, name, text, number)
      class(parcel_type), intent(inout) :: self
      !> Their name
      character(len=*), intent(in) :: name
      !> The lines, with new_line between them
      character(len=*), intent(in) :: text
      !> How many there are
      integer, intent(in) :: number

      call self%name(name, 'lines', self%line_count, [number])
      call self%lines%add(text)
      self%line_count = self%line_count + number
   end subroutine put_block

   !> Put lines in under a name
   subroutine put_lines(self, name, lines)
      class(parcel_type), intent(inout) :: self
      !> Their name
      character(len=*), intent(in) :: name
      type(lines_type), intent(in) :: lines

      integer :: i

      call self%name(name, 'lines', self%line_count, [lines%count])
      do i = 1, lines%count
         call self%lines%add(lines%line(i)%text)
      end do
      self%line_count = self%line_count + lines%count
   end subroutine put_lines

   !> Name what is put in
   subroutine name(self, what, kind, before, shape)
      class(parcel_type), intent(inout) :: self
      !> Its name and kind
      character(len=*), intent(in) :: what, kind
      !> How many of its kind stand before it
      integer(c_int64_t), intent(in) :: before
      !> Its shape in Fortran's order
      integer, intent(in) :: shape(:)

      character(len=:), allocatable :: line
      integer :: i

      line = what//' '//kind//' '//to_text(before)
      do i = size(shape), 1, -1
         line = line//' '//to_text(shape(i))
      end do
      call self%names%add(line)
   end subroutine name

   !> How many integers there are
   pure integer(c_int64_t) function size_of(integers)
      integer(c_int), allocatable, intent(in) :: integers(:)

      size_of = 0
      if (allocated(integers)) size_of = size(integers, kind=c_int64_t)
   end function size_of

   !> How many reals there are
   pure integer(c_int64_t) function number_of(reals)
      real(c_double), allocatable, intent(in) :: reals(:)

      number_of = 0
      if (allocated(reals)) number_of = size(reals, kind=c_int64_t)
   end function number_of

   !> Make room for series, all of a parcel at once
   subroutine expect_series(self, number)
      class(parcel_type), intent(inout) :: self
      !> How many there will be at most
      integer, intent(in) :: number

      allocate (self%series(number))
   end subroutine expect_series

   !> Put a series in that is not needed any more
   subroutine move_series(self, values)
      class(parcel_type), intent(inout) :: self
      !> Its numbers
      real(c_double), allocatable, intent(inout) :: values(:)

      self%given = self%given + 1
      call move_alloc(values, self%series(self%given)%values)
   end subroutine move_series

   !> Put in how something was read, where there is something to say of it, as notes
   subroutine put_note(self, note)
      class(parcel_type), intent(inout) :: self
      !> The note; empty or not allocated: none
      character(len=:), allocatable, intent(in) :: note

      type(lines_type) :: notes

      if (allocated(note)) then
         if (len(note) > 0) call notes%add(note)
      end if
      call self%put('notes', notes)
   end subroutine put_note

   !> Send a parcel, or an error as one: its lines are its sentences and, for each of its problems, code, variable and place
   !> with a tab between two; its integer is the number of these
   subroutine send(parcel, error, sent)
      !> The parcel; its numbers are moved away
      type(parcel_type), intent(inout) :: parcel
      !> The error that came instead
      type(error_type), allocatable, intent(in) :: error
      !> Its address and numbers of integers, reals and characters, zeros where there is nothing in it; kind of the error, or
      !> without one the number of lines at its end that are names, negative
      integer(c_int64_t), intent(out) :: sent(5)

      type(parcel_type), pointer :: content
      integer :: i

      sent = 0
      if (.not. (allocated(error) .or. allocated(parcel%integers) .or. allocated(parcel%reals) .or. &
         & parcel%lines%count > 0 .or. parcel%names%count > 0)) return
      allocate (content)
      allocate (content%integers(0), content%reals(0))
      if (allocated(error)) then
         call content%lines%add(error%message)
         content%integers = [size(error%problem)]
         do i = 1, size(error%problem)
            associate (problem => error%problem(i))
               call content%lines%add(trim(problem%code)//achar(9)//problem%variable//achar(9)//problem%place)
            end associate
         end do
         sent(5) = error%stat
      else
         if (allocated(parcel%integers)) call move_alloc(parcel%integers, content%integers)
         if (allocated(parcel%reals)) call move_alloc(parcel%reals, content%reals)
         content%lines%count = parcel%lines%count
         if (allocated(parcel%lines%line)) call move_alloc(parcel%lines%line, content%lines%line)
         do i = 1, parcel%names%count
            call content%lines%add(parcel%names%line(i)%text)
         end do
         sent(5) = -parcel%names%count
         content%given = parcel%given
         if (allocated(parcel%series)) call move_alloc(parcel%series, content%series)
      end if
      sent(:4) = [transfer(c_loc(content), 0_c_intptr_t), size(content%integers, kind=c_int64_t), &
         & size(content%reals, kind=c_int64_t), length_of(content%lines)]
   end subroutine send

   !> Send an error, if there is one, and nothing else
   subroutine report(error, failure)
      !> The error; not allocated: success
      type(error_type), allocatable, intent(in) :: error
      !> As from send
      integer(c_int64_t), intent(out) :: failure(5)

      type(parcel_type) :: nothing

      call send(nothing, error, failure)
   end subroutine report

   !> Take what a parcel holds but its series, and free it if it has none
   subroutine take(handle, integers, reals, text)
      !> Its address, which is valid once, and for each series once more; 0: nothing was sent
      integer(c_int64_t), intent(in) :: handle
      !> Its integers
      integer(c_int), intent(out) :: integers(:)
      !> Its reals
      real(c_double), intent(out) :: reals(:)
      !> The bytes of its lines, each line ended by new_line; the last number is filled up
      integer(c_int), intent(out) :: text(:)

      type(parcel_type), pointer :: content
      type(c_ptr) :: address
      character(len=:), allocatable :: characters
      integer(c_int64_t) :: at, length
      integer :: i

      if (handle == 0) return
      address = transfer(handle, address)
      call c_f_pointer(address, content)
      integers = content%integers
      reals = content%reals
      allocate (character(len=size(text, kind=c_int64_t)*(storage_size(text)/storage_size('a'))) :: characters)
      at = 0
      do i = 1, content%lines%count
         associate (line => content%lines%line(i))
            length = len(line%text, c_int64_t)
            characters(at + 1:at + length) = line%text
            at = at + length + 1
            characters(at:at) = new_line('a')
         end associate
      end do
      text = transfer(characters, text)
      if (content%given == 0) deallocate (content)
   end subroutine take

   !> Take the next series of a parcel, and free the parcel after the last
   subroutine take_series(handle, values)
      !> Its address
      integer(c_int64_t), intent(in) :: handle
      !> The numbers
      real(c_double), intent(out) :: values(:)

      type(parcel_type), pointer :: content
      type(c_ptr) :: address

      address = transfer(handle, address)
      call c_f_pointer(address, content)
      content%taken = content%taken + 1
      associate (series => content%series(content%taken))
         values = series%values
         ! Room for the next array of Python
         deallocate (series%values)
      end associate
      if (content%taken == content%given) deallocate (content)
   end subroutine take_series

   !> Number of characters of lines, each ended by new_line
   pure integer(c_int64_t) function length_of(lines) result(length)
      type(lines_type), intent(in) :: lines

      integer :: i

      length = lines%count
      do i = 1, lines%count
         length = length + len(lines%line(i)%text, c_int64_t)
      end do
   end function length_of

end module dondolo_parcel
