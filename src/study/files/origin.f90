!> Owner of a file: dondolo replaces and removes the regular files that it has written itself, and no others.
!>
!> Each kind of file that dondolo writes has a mark in its first or last bytes, by which it is recognised wherever it lies and
!> whatever its name. A table begins with `# dondolo VERSION`, the file of a run with its format, a lock, a file of counts and a
!> saved result with theirs; catalogues of records are tables whose first two lines say so. What is made of results - reports,
!> workbooks, figures, animations, models of other programs - has the mark of `derived_mark` in its metadata, which names the run
!> whose results it shows. A symbolic link, a pipe, a device or an empty file has no known owner.
module dondolo_files_origin
   use, intrinsic :: iso_c_binding, only : c_char, c_int, c_null_char, c_size_t
   use dondolo_base_error, only : error_type, raise_input
   use dondolo_files_version, only : dondolo_version_text
   implicit none
   private

   public :: origin_type, look_at_origin, check_replaced, check_regular, derived_mark, derived_kinds, run_length

   !> Bytes of the name of a run, of the word for a kind of file, and of a mark
   integer, parameter :: run_length = 33, word_length = 9, mark_length = 80

   !> What can be at a path (files.c)
   integer, parameter :: nothing = 0, regular = 1, folder = 3
   character(len=15), parameter :: things(2:6) = [character(len=15) :: 'a symbolic link', 'a folder', &
      & 'a pipe', 'a socket', 'a device']

   !> Bytes at the beginning and at the end of a file among which its mark is
   integer, parameter :: room = 4096

   !> Kinds of files that are made of results
   character(len=word_length), parameter :: derived_kinds(*) = [character(len=word_length) :: 'report', 'workbook', 'figure', &
      & 'film', 'model']

   !> What is in their marks before the name of the run
   character(len=*), parameter :: of_run = ' of run '

   !> Kinds of files, and what they are called
   character(len=word_length), parameter :: kinds(*) = [character(len=word_length) :: derived_kinds, 'table', 'records', &
      & 'catalogue', 'run', 'counts', 'lock', 'result']
   character(len=26), parameter :: nouns(size(kinds)) = [character(len=26) :: 'a report', 'a workbook', 'a figure', &
      & 'an animation', 'a fragility model', 'a table of results', 'a catalogue of records', 'a catalogue of files', &
      & 'a run file', 'a file of counts', 'a lock', 'a saved result']

   !> A file, or what else is at a path
   type :: origin_type
      !> What is there: nothing, regular, folder or another
      integer :: thing = nothing
      !> What kind of dondolo's files it is, one of kinds; blank: it is none
      character(len=word_length) :: kind = ''
      !> Run that it is of; blank: it names none
      character(len=run_length) :: run = ''
   end type origin_type

   interface

      integer(c_int) function c_thing(path, follows) bind(c, name='dondolo_thing')
         import :: c_char, c_int
         character(kind=c_char), intent(in) :: path(*)
         integer(c_int), value :: follows
      end function c_thing

      subroutine c_read_ends(path, first, last, room) bind(c, name='dondolo_read_ends')
         import :: c_char, c_size_t
         character(kind=c_char), intent(in) :: path(*)
         character(kind=c_char), intent(inout) :: first(*), last(*)
         integer(c_size_t), value :: room
      end subroutine c_read_ends

   end interface

contains

   !> Look whose a file is
   subroutine look_at_origin(path, origin)
      !> Path; a link is not followed
      character(len=*), intent(in) :: path
      type(origin_type), intent(out) :: origin

      character(kind=c_char, len=room) :: first, last

      origin%thing = c_thing(path//c_null_char, 0_c_int)
      if (origin%thing /= regular) return
      first = ''
      last = ''
      call c_read_ends(path//c_null_char, first, last, int(room, c_size_t))
      if (is_table(first)) then
         origin%kind = kind_of_table(first)
         call find_run(first, new_line('a')//'# run: ', origin%run)
      else if (first(1:1) == '{' .and. index(first(:100), '"format": "dondolo run ') > 0) then
         origin%kind = 'run'
         call find_run(first, '"run": "', origin%run)
      else if (index(first, 'dondolo counts ') == 1) then
         origin%kind = 'counts'
      else if (index(first, 'dondolo lock') == 1) then
         origin%kind = 'lock'
      else if (index(first, 'PK') == 1 .and. index(first, '"format": "dondolo result"') > 0) then
         origin%kind = 'result'
      else
         call find_derived(first, origin)
         if (len_trim(origin%kind) == 0) call find_derived(last, origin)
      end if
   end subroutine look_at_origin

   !> Does a file begin as a table, with the program and its version?
   pure logical function is_table(first)
      !> Its first bytes
      character(len=*), intent(in) :: first

      character(len=*), parameter :: mark = '# dondolo ', digits = '0123456789'
      integer :: length

      is_table = .false.
      if (index(first, mark) /= 1) return
      length = verify(first(len(mark) + 1:), digits) - 1
      if (length > 0) is_table = first(len(mark) + length + 1:len(mark) + length + 1) == '.'
   end function is_table

   !> What kind of table it is
   pure function kind_of_table(first) result(kind)
      !> Its first bytes
      character(len=*), intent(in) :: first
      character(len=word_length) :: kind

      integer :: ends

      kind = 'table'
      ends = index(first, new_line('a'))
      if (index(first(ends + 1:), '# records written by dondolo'//new_line('a')) == 1) kind = 'records'
      if (index(first(:ends), ': records found'//new_line('a')) > 0) kind = 'catalogue'
   end function kind_of_table

   !> The mark of a file that is made of results
   pure function derived_mark(kind, run) result(mark)
      !> One of derived_kinds
      character(len=*), intent(in) :: kind
      !> Name of the run whose results it shows; blank: they are of none
      character(len=*), intent(in) :: run
      character(len=mark_length) :: mark

      ! Letters that no format escapes
      mark = 'dondolo '//trim(kind)//' '//dondolo_version_text//of_run//trim(merge('none', '    ', len_trim(run) == 0))// &
         & trim(run)
   end function derived_mark

   !> Find the mark of a file that is made of results
   pure subroutine find_derived(bytes, origin)
      !> Some of its bytes
      character(len=*), intent(in) :: bytes
      !> Its kind and its run are set
      type(origin_type), intent(inout) :: origin

      integer :: i, at, ends

      do i = 1, size(derived_kinds)
         at = index(bytes, 'dondolo '//trim(derived_kinds(i))//' ')
         if (at == 0) cycle
         ends = min(at + mark_length - 1, len(bytes))
         if (index(bytes(at:ends), of_run) == 0) cycle
         origin%kind = derived_kinds(i)
         call find_run(bytes(at:ends), of_run, origin%run)
         return
      end do
   end subroutine find_derived

   !> Find the name of a run
   pure subroutine find_run(bytes, before, run)
      !> Some bytes of a file
      character(len=*), intent(in) :: bytes
      !> What is before the name
      character(len=*), intent(in) :: before
      !> The name; blank: there is none
      character(len=run_length), intent(out) :: run

      integer :: at

      run = ''
      at = index(bytes, before) + len(before)
      if (at == len(before) .or. at + run_length - 1 > len(bytes)) return
      if (verify(bytes(at:at + run_length - 1), '0123456789abcdefTZ-') == 0) run = bytes(at:)
   end subroutine find_run

   !> May a file be replaced? What dondolo has not written stays
   subroutine check_replaced(path, kind, error)
      !> Its path
      character(len=*), intent(in) :: path
      !> What will take its place, one of kinds: only a file of the same kind is replaced
      character(len=*), intent(in) :: kind
      !> Something else is there
      type(error_type), allocatable, intent(out) :: error

      type(origin_type) :: origin

      call look_at_origin(path, origin)
      if (origin%thing == nothing .or. origin%kind == kind) return
      if (origin%thing /= regular) then
         call raise_input(error, path//': cannot be written: is '//trim(things(origin%thing)))
      else
         call raise_input(error, path//': exists, and is not '//trim(noun(kind))//' of dondolo')
      end if
   end subroutine check_replaced

   !> What a kind of file is called
   pure function noun(kind)
      !> One of kinds
      character(len=*), intent(in) :: kind
      character(len=len(nouns)) :: noun

      integer :: i

      noun = ''
      do i = 1, size(kinds)
         if (kinds(i) == kind) noun = nouns(i)
      end do
   end function noun

   !> Refuse what is no regular file: a pipe would be waited for, and a device has no end. A folder cannot be
   !> opened as a file, which the attempt reports
   subroutine check_regular(path, follows, error)
      !> Path
      character(len=*), intent(in) :: path
      !> Are links followed? Those to what is read are, those to what is written are not
      logical, intent(in) :: follows
      !> Something else is there
      type(error_type), allocatable, intent(out) :: error

      integer :: thing

      thing = c_thing(path//c_null_char, merge(1_c_int, 0_c_int, follows))
      if (any(thing == [nothing, regular, folder])) return
      call raise_input(error, path//': is '//trim(things(thing))//', not a regular file')
   end subroutine check_regular

end module dondolo_files_origin
