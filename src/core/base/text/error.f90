!> What went wrong, as a value: the library never prints and never stops.
!>
!> An `error_type` that is not allocated means success. The message is one sentence without a final
!> full stop; callers put the place before it (file, namelist group), so that a user reads
!> `walls.nml: &wall: thickness = -0.25: must be positive`. Where several things can be wrong at once, such as the
!> variables of a wall or the rows of a table, their sentences stand on lines of their own (problems_type). For programs,
!> which should not read sentences, each has a code, its variable and its place beside it (problem_type).
module dondolo_base_error
   use dondolo_base_plain, only : visible
   implicit none
   private

   public :: error_type, problem_type, problems_type, raise_input, raise_missing, raise_failure, add_place
   public :: status_failure, status_input, status_missing, status_memory
   public :: error_codes, unknown_name, not_given, not_together, wrong_length, out_of_range, not_increasing, not_a_number, &
      & not_an_integer, not_a_flag, not_a_string, not_a_word, no_such_file, not_at_rest

   !> The work failed while running (exit code of the executable)
   integer, parameter :: status_failure = 1

   !> What the user gave is wrong (exit code of the executable)
   integer, parameter :: status_input = 2

   !> What the user gave is wrong: a file that does not exist (to the executable, wrong input)
   integer, parameter :: status_missing = 3

   !> The work failed for lack of memory (to the executable, a failure)
   integer, parameter :: status_memory = 4

   !> What is wrong, for programs: no variable of this name; not given, though it must be; not with, or only with, another
   !> value or variable; another number of values than is allowed; a number that is not allowed, by itself or beside others;
   !> values that must increase and do not; no number, integer, flag or text; none of the words that are allowed; a file that
   !> does not exist; a wall that falls, or is held for ever, without an earthquake
   character(len=*), parameter :: unknown_name = 'unknown_name', not_given = 'not_given', not_together = 'not_together', &
      & wrong_length = 'wrong_length', out_of_range = 'out_of_range', not_increasing = 'not_increasing', &
      & not_a_number = 'not_a_number', not_an_integer = 'not_an_integer', not_a_flag = 'not_a_flag', &
      & not_a_string = 'not_a_string', not_a_word = 'not_a_word', no_such_file = 'no_such_file', not_at_rest = 'not_at_rest'

   !> All of them
   character(len=14), parameter :: error_codes(*) = [character(len=14) :: unknown_name, not_given, not_together, &
      & wrong_length, out_of_range, not_increasing, not_a_number, not_an_integer, not_a_flag, not_a_string, not_a_word, &
      & no_such_file, not_at_rest]

   !> What one sentence of an error is about
   type :: problem_type
      !> One of error_codes; blank: none of them says it
      character(len=len(error_codes)) :: code = ''
      !> Name of the variable as the user writes it; empty: it is not about one
      character(len=:), allocatable :: variable
      !> Where it is, such as `walls.csv: line 12`; empty: not known
      character(len=:), allocatable :: place
   end type problem_type

   !> An error: its kind and its sentence
   type :: error_type
      !> `status_failure`, `status_input`, `status_missing` or `status_memory`
      integer :: stat = status_failure
      !> One sentence: where, what, and what is allowed; or several, one a line
      character(len=:), allocatable :: message
      !> What each sentence is about
      type(problem_type), allocatable :: problem(:)
   end type error_type

   !> Things that are wrong, gathered to be reported at once
   type :: problems_type
      !> How many there are
      integer :: count = 0
      !> The first of them, as an error that is allocated from the first on
      type(error_type), allocatable, private :: error
   contains
      !> Note something that is wrong in what the user gave
      procedure :: note
      !> Take an error, if there is one
      procedure :: take
      !> Report them, if there are any
      procedure :: raise
   end type problems_type

contains

   !> Report wrong input
   pure subroutine raise_input(error, message, code, variable, place)
      !> Error to allocate
      type(error_type), allocatable, intent(out) :: error
      !> Sentence for the user
      character(len=*), intent(in) :: message
      !> What is wrong, one of error_codes
      character(len=*), intent(in), optional :: code
      !> Name of the variable
      character(len=*), intent(in), optional :: variable
      !> The place with which the sentence begins
      character(len=*), intent(in), optional :: place

      call raise_failure(error, message)
      error%stat = status_input
      if (present(code)) error%problem(1)%code = code
      if (present(variable)) error%problem(1)%variable = visible(variable)
      if (present(place)) error%problem(1)%place = visible(place)
   end subroutine raise_input

   !> Report a file that does not exist
   pure subroutine raise_missing(error, message)
      !> Error to allocate
      type(error_type), allocatable, intent(out) :: error
      !> Sentence for the user
      character(len=*), intent(in) :: message

      call raise_input(error, message, no_such_file)
      error%stat = status_missing
   end subroutine raise_missing

   !> Report work that failed while running
   pure subroutine raise_failure(error, message)
      !> Error to allocate
      type(error_type), allocatable, intent(out) :: error
      !> Sentence for the user
      character(len=*), intent(in) :: message

      allocate (error)
      error%stat = status_failure
      call shorten(message, error%message)
      allocate (error%problem(1))
      error%problem(1)%variable = ''
      error%problem(1)%place = ''
   end subroutine raise_failure

   !> A sentence as users see it: on one line, and without the middle of what a file says at length
   pure subroutine shorten(message, sentence)
      !> Sentence
      character(len=*), intent(in) :: message
      !> The same
      character(len=:), allocatable, intent(out) :: sentence

      integer, parameter :: longest = 2000, beginning = 1500, ending = 400

      if (len(message) <= longest) then
         sentence = visible(message)
      else
         sentence = visible(message(:beginning)//' ... '//message(len(message) - ending:))
      end if
   end subroutine shorten

   !> Put the place (a file, a group) before every sentence of an error, if there is one
   pure subroutine add_place(error, place)
      !> Error to extend; left alone when not allocated
      type(error_type), allocatable, intent(inout) :: error
      !> Where it happened
      character(len=*), intent(in) :: place

      character(len=:), allocatable :: message, shown_place
      integer :: first, length, i

      if (.not. allocated(error)) return
      ! A file's name may have any bytes, and those of a folder are not the user's choice.
      shown_place = visible(place)
      message = ''
      first = 1
      do
         length = index(error%message(first:), new_line('a'))
         if (length == 0) exit
         message = message//shown_place//': '//error%message(first:first + length - 1)
         first = first + length
      end do
      error%message = message//shown_place//': '//error%message(first:)
      do i = 1, size(error%problem)
         if (len(error%problem(i)%place) > 0) then
            error%problem(i)%place = shown_place//': '//error%problem(i)%place
         else
            error%problem(i)%place = shown_place
         end if
      end do
   end subroutine add_place

   !> Note something that is wrong in what the user gave
   subroutine note(self, message, code, variable)
      class(problems_type), intent(inout) :: self
      !> Sentence for the user
      character(len=*), intent(in) :: message
      !> What is wrong, one of error_codes
      character(len=*), intent(in), optional :: code
      !> Name of the variable
      character(len=*), intent(in), optional :: variable

      type(error_type), allocatable :: error

      call raise_input(error, message, code, variable)
      call self%take(error)
   end subroutine note

   !> Take an error, if there is one
   subroutine take(self, error)
      class(problems_type), intent(inout) :: self
      !> The error; not allocated afterwards
      type(error_type), allocatable, intent(inout) :: error

      ! So many characters fit on a screen; the rest is counted
      integer, parameter :: room = 1500
      type(problem_type), allocatable :: joined(:)

      if (.not. allocated(error)) return
      self%count = self%count + lines_of(error%message)
      if (.not. allocated(self%error)) then
         call move_alloc(error, self%error)
         return
      end if
      if (len(self%error%message) + len(error%message) < room) then
         self%error%message = self%error%message//new_line('a')//error%message
         allocate (joined(size(self%error%problem) + size(error%problem)))
         joined(:size(self%error%problem)) = self%error%problem
         joined(size(self%error%problem) + 1:) = error%problem
         call move_alloc(joined, self%error%problem)
      end if
      deallocate (error)
   end subroutine take

   !> Report them, if there are any
   subroutine raise(self, error)
      class(problems_type), intent(in) :: self
      !> Wrong input: all sentences that there is room for, and how many more there are
      type(error_type), allocatable, intent(out) :: error

      character(len=12) :: number
      integer :: hidden

      if (self%count == 0) return
      error = self%error
      error%stat = status_input
      hidden = self%count - lines_of(error%message)
      if (hidden == 0) return
      write (number, '(i0)') hidden
      error%message = error%message//new_line('a')//'and '//trim(number)//' more'
   end subroutine raise

   !> How many lines a text has
   pure integer function lines_of(text)
      !> Text
      character(len=*), intent(in) :: text

      integer :: i

      lines_of = 1
      do i = 1, len(text)
         if (text(i:i) == new_line('a')) lines_of = lines_of + 1
      end do
   end function lines_of

end module dondolo_base_error
