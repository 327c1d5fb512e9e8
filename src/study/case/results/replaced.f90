!> Whose results a run replaces, and what was made of them - reports, workbooks, figures - and is out of date from then on.
!> Nothing of it is removed: it may be all that is left of a run.
module dondolo_case_replaced
   use, intrinsic :: iso_c_binding, only : c_char, c_null_char, c_size_t
   use, intrinsic :: iso_fortran_env, only : int64
   use dondolo_base_lines, only : lines_type
   use dondolo_case_result_files, only : published_run, run_suffix
   use dondolo_files_origin, only : derived_kinds, look_at_origin, origin_type, run_length
   use dondolo_files_reader, only : reader_type
   use dondolo_files_system, only : folder_of
   implicit none
   private

   public :: describe_replaced, list_outdated

   !> What the names of files that are made of results begin with behind the prefix; `typology_` is followed by a mechanism
   character(len=15), parameter :: stems(*) = [character(len=15) :: '_report.', '_tables.', '_fragility.', '_stripes.', &
      & '_damage_states.', '_history.', '_wall.', '_motion.', '_typology.', '_typology_', '_uncertainty.', '_designs.', &
      & '_combination.', '_groups.', '_relazione.']

   interface

      subroutine c_list(folder, begin, names, room) bind(c, name='dondolo_list')
         import :: c_char, c_size_t
         character(kind=c_char), intent(in) :: folder(*), begin(*)
         character(kind=c_char), intent(inout) :: names(*)
         integer(c_size_t), value :: room
      end subroutine c_list

   end interface

contains

   !> Say whose results a run would replace
   subroutine describe_replaced(prefix, lines)
      !> What the names of its result files begin with
      character(len=*), intent(in) :: prefix
      !> One sentence; none where there are no results
      type(lines_type), intent(out) :: lines

      character(len=run_length) :: run
      character(len=:), allocatable :: case

      run = published_run(prefix)
      if (len_trim(run) == 0) return
      call find_case(prefix//run_suffix, case)
      call lines%add(prefix//': a run replaces the results of run '//run//', begun '//run(1:4)//'-'//run(5:6)//'-'//run(7:8)// &
         & ' '//run(10:11)//':'//run(12:13)//':'//run(14:15)//' UTC'//case)
   end subroutine describe_replaced

   !> Find the case in the file of a run
   subroutine find_case(path, case)
      !> Path of the file, which is one of a run
      character(len=*), intent(in) :: path
      !> Path of the case in words, as JSON escapes it; empty where the file names none, as of Python
      character(len=:), allocatable, intent(out) :: case

      ! Settings come before the case, and a list of levels may be long.
      integer(int64), parameter :: room = 2_int64**20
      character(len=*), parameter :: role = '"role": "case"', name = '"path": "'
      character(len=:), allocatable :: text
      type(reader_type) :: reader
      integer :: at, ends
      logical :: ok

      case = ''
      call reader%open(path, ok)
      if (.not. ok) return
      allocate (character(len=min(reader%size(), room)) :: text)
      call reader%read(1_int64, text, ok)
      call reader%close()
      at = index(text, role)
      if (.not. ok .or. at == 0) return
      ends = index(text(at:), name)
      if (ends == 0) return
      at = at + ends - 1 + len(name)
      ends = index(text(at:), '"')
      if (ends > 1) case = ', of the case '''//text(at:at + ends - 2)//''''
   end subroutine find_case

   !> List the reports, workbooks and figures of other results than those that are there
   subroutine list_outdated(prefix, lines)
      !> What the names of the result files begin with
      character(len=*), intent(in) :: prefix
      !> One sentence for each file
      type(lines_type), intent(out) :: lines

      integer, parameter :: room = 2**16
      character(kind=c_char, len=:), allocatable :: names
      type(origin_type) :: origin
      character(len=run_length) :: run
      integer :: i, slash, at, ends

      run = published_run(prefix)
      if (len_trim(run) == 0) return
      slash = index(prefix, '/', back=.true.)
      allocate (character(len=room) :: names)
      do i = 1, size(stems)
         names(1:1) = c_null_char
         call c_list(folder_of(prefix)//c_null_char, prefix(slash + 1:)// &
            & trim(stems(i))//c_null_char, names, int(room, c_size_t))
         at = 1
         do while (names(at:at) /= c_null_char)
            ends = at + index(names(at:), new_line('a')) - 2
            call look_at_origin(prefix(:slash)//names(at:ends), origin)
            if (any(derived_kinds == origin%kind) .and. origin%run /= run) call lines%add(prefix(:slash)//names(at:ends)// &
               & ': is out of date: it shows other results than those of '//prefix//run_suffix)
            at = ends + 2
         end do
      end do
   end subroutine list_outdated

end module dondolo_case_replaced
