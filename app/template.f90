!> What --template prints: a commented case with every variable, its meaning, its unit and its default, that runs as it is,
!> with the installed records and walls, or in the root of the repository.
!> It follows from the tables of properties.
module dondolo_template
   use, intrinsic :: iso_fortran_env, only : output_unit
   use dondolo_base_property, only : default_text, has_owner, is_many, is_text, item_name, number_of_choices, property_type
   use dondolo_base_text, only : join
   use dondolo_case_job_group, only : history_task, task_names, typology_task
   use dondolo_case_property_tables, only : property_table
   use dondolo_example, only : find_installed, substitute
   use dondolo_files_system, only : file_exists
   use dondolo_wall_properties, only : mechanism_names
   implicit none
   private

   public :: print_template

   !> How examples of properties begin that are files of the repository
   character(len=*), parameter :: from_root = '''data/'

   !> Longest line
   integer, parameter :: width = 118

contains

   !> Print a template
   subroutine print_template(task)
      !> Task
      integer, intent(in) :: task

      call print_line('! A case of dondolo. Variables that are not marked as required may be left out; their defaults are shown.')
      call print_line('! Quoted words after a colon are the values allowed. An exclamation mark begins a comment.')
      call print_group('job', task)
      if (task == typology_task) then
         call print_group('population', task)
         call print_columns()
      else
         call print_group('wall', task)
         call print_line('! Where the wall stands on a building:')
         call print_group('building', task, is_commented=.true.)
      end if
      call print_group('records', task)
      call print_group('stripes', task)
      call print_group('solver', task)
      if (task == history_task) call print_group('history', task)
      if (task /= history_task) call print_group('check', task)
   end subroutine print_template

   !> Print a group
   subroutine print_group(name, task, is_commented)
      !> Name of the group
      character(len=*), intent(in) :: name
      !> Task
      integer, intent(in) :: task
      !> Given: all of it stands behind exclamation marks, and none of its variables must be given
      logical, intent(in), optional :: is_commented

      type(property_type), allocatable :: table(:)
      character(len=:), allocatable :: assignment, comment, before, files
      integer :: i, pass, margin

      call find_installed(files)
      if (.not. file_exists(files//'cases/parapet.nml')) files = 'data/'
      before = ''
      if (present(is_commented)) before = '! '
      table = property_table(name)
      call print_line(before//'&'//name)
      margin = 0
      do pass = 1, 2
         do i = 1, size(table)
            if (.not. suits(table(i), task)) cycle
            call make_assignment(table(i), task, assignment)
            if (len(before) > 0) assignment = before//'   '//assignment(verify(assignment, ' !'):)
            if (pass == 1) margin = max(margin, len(assignment) + 2)
            if (pass == 1) cycle
            call substitute(assignment, from_root, ''''//files)
            call make_comment(table(i), comment)
            call print_commented(assignment, comment, margin)
         end do
      end do
      call print_line(before//'/')
   end subroutine print_group

   !> Does a property belong to a task, or to walls?
   logical function suits(property, task)
      type(property_type), intent(in) :: property
      !> Task
      integer, intent(in) :: task

      suits = has_owner(property, trim(task_names(task))) .or. .not. any(property%owners(1) == task_names)
   end function suits

   !> A property and its value; behind an exclamation mark where it is not for the wall or the task as it stands
   subroutine make_assignment(property, task, text)
      type(property_type), intent(in) :: property
      !> Task
      integer, intent(in) :: task
      !> `   name = value`
      character(len=:), allocatable, intent(out) :: text

      character(len=:), allocatable :: value

      select case (property%name)
      case ('task')
         value = trim(task_names(task))
      case ('output')
         value = 'out/'//trim(task_names(task))
      case default
         call default_text(property, value)
         if (len_trim(property%example) > 0) value = trim(property%example)
      end select
      if (property%kind == is_text) value = ''''//value//''''
      text = trim(property%name)//' = '//value
      if ((property%optional .and. len_trim(property%instead) == 0) .or. &
         & .not. (has_owner(property, 'one_sided') .or. has_owner(property, trim(task_names(task))))) text = '! '//text
      text = '   '//text
   end subroutine make_assignment

   !> What is said of a property
   subroutine make_comment(property, comment)
      type(property_type), intent(in) :: property
      !> Required or not, owners, meaning, unit, choices, and the default where the template shows another value
      character(len=:), allocatable, intent(out) :: comment

      character(len=:), allocatable :: default
      integer :: count, i

      comment = ''
      if (property%required) comment = 'required: '
      if (len_trim(property%instead) > 0) comment = 'required, or '//trim(property%instead)//': '
      if (.not. any(property%owners(1) == task_names)) then
         count = number_of_choices(property%owners)
         if (count == size(mechanism_names)) count = 0
         do i = 1, count
            comment = comment//trim(merge('only ', 'or   ', i == 1))//' '//trim(property%owners(i))
            comment = comment//merge(': ', '  ', i == count)
            if (i < count) comment = trim(comment)//' '
         end do
      end if
      comment = comment//trim(property%meaning)
      if (len_trim(property%unit) > 0) comment = comment//', '//trim(property%unit)
      if (len_trim(property%zero) > 0 .and. index(property%meaning, '0:') == 0) then
         comment = comment//'; 0: '//trim(property%zero)
      end if
      if (len_trim(property%more) > 0) comment = comment//': '//trim(property%more)
      count = number_of_choices(property%choices)
      if (count > 0) comment = comment//': '//join(property%choices(:count))
      if (property%name /= 'task' .and. property%name /= 'output') return
      call default_text(property, default)
      comment = comment//'; default '''//default//''''
   end subroutine make_comment

   !> Print the columns of a population as comments
   subroutine print_columns()

      character(len=8), parameter :: tables(3) = [character(len=8) :: 'wall', 'building', 'row']
      type(property_type), allocatable :: table(:)
      character(len=:), allocatable :: name, comment
      integer :: i, k

      call print_line('! Columns of the table of walls, one row per mechanism of a wall. Those with a 1 are the first of a list:')
      call print_line('! load1, load2 ..., each value in a column of its own.')
      do k = 1, size(tables)
         table = property_table(trim(tables(k)))
         do i = 1, size(table)
            name = trim(table(i)%name)
            if (is_many(table(i)%kind)) name = trim(item_name(name, 1))
            call make_comment(table(i), comment)
            call print_commented('! '//name, comment, 26)
         end do
      end do
      call print_line('! Rows with one name are mechanisms of one wall. A row with hinge_at, or hinge1_level, hinge2_level ...,')
      call print_line('! is a facade: a wall for each hinge, in series. One facade alone: &wall with either, not &population.')
      call print_line('! One wall with uncertain properties: &wall, not &population, and')
      call print_group('uncertainty', typology_task, is_commented=.true.)
   end subroutine print_columns

   !> Print a line with a comment, which goes on in the lines below where it is long
   subroutine print_commented(text, comment, margin)
      !> Beginning of the line
      character(len=*), intent(in) :: text
      !> Comment
      character(len=*), intent(in) :: comment
      !> Where the comment begins
      integer, intent(in) :: margin

      character(len=margin) :: start
      integer :: first, last

      start = text
      if (len(text) > margin) then
         ! The path of an installed file leaves no room beside it
         call print_line(text)
         start = ''
      end if
      first = 1
      do while (first <= len(comment))
         last = len(comment)
         if (margin + 2 + last - first + 1 > width) last = first + index(comment(first:first + width - margin - 2), ' ', &
            & back=.true.) - 2
         call print_line(start//'! '//comment(first:last))
         start = ''
         first = last + 2
      end do
   end subroutine print_commented

   !> Print a line
   subroutine print_line(line)
      !> Line
      character(len=*), intent(in) :: line

      write (output_unit, '(a)') line
   end subroutine print_line

end module dondolo_template
