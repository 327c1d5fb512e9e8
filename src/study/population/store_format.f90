!> Format of the rows of a population in a file: a header that says in plain text which study they belong to, and then rows, each
!> with its number, its length and a fingerprint of all of it.
!>
!> The file is for machines like the one that wrote it (little endian or big endian, real64 or real128). Rows may be in
!> any order. The incomplete last row of a killed run is found by its length or its fingerprint.
module dondolo_population_store_format
   use, intrinsic :: iso_fortran_env, only : int32, int64
   use dondolo_base_error, only : error_type, raise_input
   use dondolo_base_fingerprint, only : fingerprint_type
   use dondolo_base_kinds, only : wp
   use dondolo_base_text, only : to_text
   use dondolo_files_reader, only : reader_type
   use dondolo_population_row_result, only : bytes_of_row, pack_row, row_result_type, shape_type, unpack_row
   use dondolo_population_study_key, only : study_key_type
   implicit none
   private

   public :: identity_type, make_head, read_head, bytes_of_entry, pack_entry, read_entry, unpack_entry, unpack_entries, is_cut_head

   !> What the file begins with, and the number of the format
   character(len=*), parameter :: mark = 'dondolo counts ', format_number = '5'

   !> Bytes of the first line - mark, format, length of the head behind this line, fingerprint of it, end of line - and the
   !> longest head; bytes of a row before its contents, the last 16 a fingerprint
   integer, parameter :: line_bytes = 43, longest_head = 10000000, entry_head = 40, guarded = 24

   !> Most levels and states that a head may state; as many flags of a row are counted without overflow
   integer, parameter :: most_levels = 2**20, most_states = 2**10

   !> Which rows of which study a file is for
   type :: identity_type
      !> The study
      type(study_key_type) :: key
      !> How many numbers there are of a row
      type(shape_type) :: shape
      !> First and last row of the population
      integer :: first = 1, last = 0
   end type identity_type

contains

   !> Fingerprint of two texts
   pure function fingerprint_of(first, second) result(text)
      !> A text
      character(len=*), intent(in) :: first
      !> Another
      character(len=*), intent(in) :: second
      !> Fingerprint
      character(len=16) :: text

      type(fingerprint_type) :: fingerprint

      call fingerprint%add_text(first)
      call fingerprint%add_text(second)
      text = fingerprint%text()
   end function fingerprint_of

   !> The head of a file
   subroutine make_head(identity, head)
      !> What the file is for
      type(identity_type), intent(in) :: identity
      !> Its head
      character(len=:), allocatable, intent(out) :: head

      character(len=*), parameter :: lf = new_line('a')
      character(len=line_bytes) :: line
      integer :: i

      associate (shape => identity%shape)
         head = 'rows '//to_text(identity%first)//' '//to_text(identity%last)//' levels '//to_text(shape%levels)// &
            & ' states '//to_text(shape%states)//' histories '//to_text(merge(1, 0, shape%keeps_histories))// &
            & ' bits '//to_text(storage_size(1.0_wp))//lf
      end associate
      do i = 1, identity%key%settings%count
         head = head//identity%key%settings%line(i)%text//lf
      end do
      write (line, '(3a, i8.8, 3a)') mark, format_number, ' ', len(head), ' ', fingerprint_of(head, ''), lf
      head = line//head
   end subroutine make_head

   !> Does a file hold the beginning of a head only? A run was killed when it had hardly begun
   logical function is_cut_head(reader, size)
      !> The file
      type(reader_type), intent(in) :: reader
      !> Its size
      integer(int64), intent(in) :: size

      character(len=min(size, int(line_bytes, int64))) :: line
      integer :: stat, length
      logical :: ok

      call reader%read(1_int64, line, ok)
      length = min(len(line), len(mark))
      is_cut_head = ok .and. line(:length) == mark(:length)
      if (.not. is_cut_head .or. len(line) < line_bytes) return
      read (line(len(mark) + 3:len(mark) + 10), '(i8)', iostat=stat) length
      is_cut_head = stat == 0 .and. size < line_bytes + int(length, int64)
   end function is_cut_head

   !> Read the head of a file
   subroutine read_head(reader, path, identity, bytes, error)
      !> The file
      type(reader_type), intent(in) :: reader
      !> Its path
      character(len=*), intent(in) :: path
      !> What it is for
      type(identity_type), intent(out) :: identity
      !> Length of the head
      integer(int64), intent(out) :: bytes
      !> It is something else, of another format, or damaged
      type(error_type), allocatable, intent(out) :: error

      character(len=line_bytes) :: line
      character(len=:), allocatable :: head
      integer :: length, stat, keeps, bits, at, ends, numbers(6)
      logical :: ok

      bytes = 0
      length = -1
      call reader%read(1_int64, line, ok)
      ok = ok .and. line(:len(mark)) == mark
      if (ok .and. line(len(mark) + 1:len(mark) + 2) /= format_number//' ') then
         call raise_input(error, path//': was written by another version of dondolo')
         return
      end if
      stat = 0
      if (ok) read (line(len(mark) + 3:len(mark) + 10), '(i8)', iostat=stat) length
      if (stat == 0 .and. length > 0 .and. length <= longest_head) then
         allocate (character(len=length) :: head)
         call reader%read(line_bytes + 1_int64, head, ok)
         if (ok .and. line(len(mark) + 11:) == ' '//fingerprint_of(head, '')//new_line('a')) then
            at = index(head, new_line('a'))
            call find_numbers(head(:at - 1), numbers)
            identity%first = numbers(1)
            identity%last = numbers(2)
            identity%shape%levels = numbers(3)
            identity%shape%states = numbers(4)
            keeps = numbers(5)
            bits = numbers(6)
            if (can_be() .and. head(length:) == new_line('a')) bytes = line_bytes + length
         end if
      end if
      if (bytes == 0) then
         call raise_input(error, path//': not a dondolo counts file, or its header is corrupt')
         return
      end if
      identity%shape%keeps_histories = keeps == 1
      do while (at < len(head))
         ends = at + index(head(at + 1:), new_line('a'))
         call identity%key%settings%add(head(at + 1:ends - 1))
         at = ends
      end do
      if (bits /= storage_size(1.0_wp)) call raise_input(error, path//': was written in real'//to_text(bits)// &
         & ', not in real'//to_text(storage_size(1.0_wp)))

   contains

      !> Can there be such rows? A file that was made up must not cost an endless loop or a wild address.
      pure logical function can_be()
         can_be = identity%first >= 1 .and. identity%last >= identity%first .and. identity%last < huge(1) .and. &
            & identity%shape%levels >= 1 .and. identity%shape%levels <= most_levels .and. identity%shape%states >= 1 .and. &
            & identity%shape%states <= most_states .and. any(keeps == [0, 1]) .and. bits > 0
      end function can_be

   end subroutine read_head

   !> Find the numbers of a line among its words (a list-directed READ of a made-up line leaks memory)
   pure subroutine find_numbers(line, numbers)
      character(len=*), intent(in) :: line
      !> Its numbers, in their order; -1: there are fewer
      integer, intent(out) :: numbers(:)

      character(len=*), parameter :: digits = '0123456789'
      integer :: found, first, length

      numbers = -1
      first = 1
      do found = 1, size(numbers)
         length = scan(line(first:), digits) - 1
         if (length < 0) return
         first = first + length
         length = verify(line(first:)//' ', digits) - 1
         if (length > range(1)) return
         read (line(first:first + length - 1), '(i9)') numbers(found)
         first = first + length
      end do
   end subroutine find_numbers

   !> Bytes of a row in a file
   pure integer(int64) function bytes_of_entry(shape, histories, ties) result(bytes)
      !> How many numbers there are of a row
      type(shape_type), intent(in) :: shape
      !> Histories of a stripe, and ties
      integer, intent(in) :: histories, ties

      bytes = entry_head + bytes_of_row(shape, histories, ties)
   end function bytes_of_entry

   !> A row as stored in a file
   subroutine pack_entry(row, entry)
      type(row_result_type), intent(in) :: row
      !> Its bytes, as many as bytes_of_entry says
      character(len=*), intent(out) :: entry

      entry(:16) = transfer([int(row%row, int32), int(row%histories, int32), int(row%ties, int32), 0_int32], entry(:16))
      entry(17:guarded) = transfer(len(entry, int64), entry(17:guarded))
      call pack_row(row, entry(entry_head + 1:))
      entry(guarded + 1:entry_head) = fingerprint_of(entry(:guarded), entry(entry_head + 1:))
   end subroutine pack_entry

   !> Read a row
   subroutine read_entry(reader, place, shape, row, bytes)
      !> The file
      type(reader_type), intent(in) :: reader
      !> Byte that the row begins with
      integer(int64), intent(in) :: place
      !> How many numbers there are of a row
      type(shape_type), intent(in) :: shape
      type(row_result_type), intent(out) :: row
      !> Its length in the file; 0: there is none, or not all of it
      integer(int64), intent(out) :: bytes

      character(len=entry_head) :: head
      character(len=:), allocatable :: entry
      integer(int64) :: length
      logical :: ok

      bytes = 0
      call reader%read(place, head, ok)
      if (.not. ok) return
      call read_entry_head(head, shape, row, length)
      if (length == 0 .or. length > reader%size()) return
      allocate (character(len=length) :: entry)
      call reader%read(place, entry, ok)
      if (ok) call unpack_entry(entry, shape, row, bytes)
   end subroutine read_entry

   !> Rows out of bytes, one behind the other
   subroutine unpack_entries(bytes, shape, count, rows, are_whole)
      !> The bytes
      character(len=*), intent(in) :: bytes
      !> How many numbers there are of a row
      type(shape_type), intent(in) :: shape
      !> How many rows there are
      integer, intent(in) :: count
      !> The rows
      type(row_result_type), allocatable, intent(out) :: rows(:)
      !> They are as they were packed
      logical, intent(out) :: are_whole

      integer(int64) :: at, length
      integer :: i

      allocate (rows(count))
      at = 0
      are_whole = .true.
      do i = 1, count
         call unpack_entry(bytes(at + 1:), shape, rows(i), length)
         are_whole = length > 0
         if (.not. are_whole) return
         at = at + length
      end do
   end subroutine unpack_entries

   !> The row that bytes begin with
   subroutine unpack_entry(bytes, shape, row, length)
      !> The bytes; others may follow
      character(len=*), intent(in) :: bytes
      !> How many numbers there are of a row
      type(shape_type), intent(in) :: shape
      type(row_result_type), intent(inout) :: row
      !> Its length; 0: there is none, or it is not as it was packed
      integer(int64), intent(out) :: length

      length = 0
      if (len(bytes, int64) >= entry_head) call read_entry_head(bytes(:entry_head), shape, row, length)
      if (length > len(bytes, int64)) length = 0
      if (length == 0) return
      if (fingerprint_of(bytes(:guarded), bytes(entry_head + 1:length)) == bytes(guarded + 1:entry_head)) then
         call unpack_row(bytes(entry_head + 1:length), shape, row)
      else
         length = 0
      end if
   end subroutine unpack_entry

   !> Read what a row begins with
   subroutine read_entry_head(head, shape, row, length)
      !> Its first bytes
      character(len=*), intent(in) :: head
      !> How many numbers there are of a row
      type(shape_type), intent(in) :: shape
      !> The row: its number, its histories and its ties are set
      type(row_result_type), intent(inout) :: row
      !> Its length; 0: it is none of this shape
      integer(int64), intent(out) :: length

      integer(int32) :: numbers(4)

      numbers = transfer(head(:16), numbers)
      length = transfer(head(17:guarded), length)
      row%row = numbers(1)
      row%histories = numbers(2)
      row%ties = numbers(3)
      if (row%histories < 1 .or. row%ties < 0) then
         length = 0
      else if (length /= bytes_of_entry(shape, row%histories, row%ties)) then
         length = 0
      end if
   end subroutine read_entry_head

end module dondolo_population_store_format
