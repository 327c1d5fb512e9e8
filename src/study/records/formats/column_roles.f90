!> Which of plain columns are times, which are accelerations, and which are not read.
!>
!> The caller, or the row of a catalogue, says so; or titles do; or there is one column, or two of which the first increases by
!> equal steps that a recorder can have. All else is refused: a rectangle of numbers may be times, velocities, or values that go
!> along the rows.
module dondolo_records_column_roles
   use dondolo_base_error, only : error_type, raise_input
   use dondolo_base_kinds, only : wp
   use dondolo_base_plain, only : shown
   use dondolo_base_text, only : brief, to_text
   use dondolo_files_text_file, only : text_file_type
   use dondolo_records_column_cells, only : find_cells, most_cells
   use dondolo_records_column_layout, only : a_time, an_acceleration, another, layout_type, raise_unclear
   use dondolo_records_column_titles, only : is_acceleration, is_other_quantity, is_seconds, is_time, says_nothing
   use dondolo_records_column_top, only : top_type
   use dondolo_records_equal_steps, only : check_equal_steps, step_type
   use dondolo_records_format, only : given_type, raise_at
   implicit none
   private

   public :: roles_type, table_type, find_roles, take_times

   !> Longest time step of a recorder, and of times that are titled [s]
   real(wp), parameter :: longest_step = 0.25_wp, longest_titled_step = 1.0_wp

   !> Columns of numbers
   type :: table_type
      !> Line of the first row
      integer :: begin = 1
      !> What separates the columns
      character(len=1) :: separator = ' '
      !> Number of columns
      integer :: cells = 1
      !> Values, line by line
      real(wp), allocatable :: values(:)
   end type table_type

   !> Roles of columns
   type :: roles_type
      !> What each column is
      integer, allocatable :: kinds(:)
      !> Is a column a channel? One whose title is of something else is refused
      logical, allocatable :: is_channel(:)
      !> Column of the times, 0 if there is none
      integer :: time = 0
      !> Does a title, or the caller, say that it is one?
      logical :: is_told = .false.
      !> Step of the times, and by how much it may be off; 0 without times [s]
      real(wp) :: dt = 0.0_wp, doubt = 0.0_wp
      !> What to report, empty if there is nothing
      character(len=:), allocatable :: note
   end type roles_type

contains

   !> Find the roles of columns, as far as they can be told without their values
   subroutine find_roles(text, table, top, given, layout, roles, error)
      type(text_file_type), intent(in) :: text
      !> Its values need not be known
      type(table_type), intent(in) :: table
      !> What is above the values
      type(top_type), intent(in) :: top
      type(given_type), intent(in) :: given
      !> What is said of the columns
      type(layout_type), intent(in) :: layout
      type(roles_type), intent(out) :: roles
      !> They are not told
      type(error_type), allocatable, intent(out) :: error

      integer :: k, line

      roles%note = ''
      line = max(top%title_line, 1)
      if (layout%is_given) then
         roles%kinds = layout%kinds
         if (size(layout%kinds) /= table%cells) call raise_input(error, text%place(table%begin)//': '// &
            & to_text(table%cells)//' values: columns = '''//shown(given%columns)//''' is for '//to_text(size(layout%kinds)))
         roles%is_told = .true.
      else if (all([(is_untitled(k), k=1, table%cells)])) then
         roles%kinds = [(an_acceleration, k=1, table%cells)]
         if (table%cells == 2) roles%kinds(1) = a_time
         if (table%cells > 2) call raise_unclear(error, text, table%begin, to_text(table%cells)//' columns without titles of '// &
            & 'accelerations, or values along the rows', given, table%cells)
      else
         roles%kinds = [(kind_of(k), k=1, table%cells)]
         if (all(roles%kinds /= an_acceleration)) call raise_without_acceleration()
      end if
      ! 0,5 may be a decimal
      if (.not. allocated(error) .and. table%separator == ',' .and. all([(is_untitled(k), k=1, table%cells)])) then
         if (index(text%text(text%first(table%begin):), '.') == 0) call raise_unclear(error, text, table%begin, &
            & 'columns separated by commas need decimal points; commas of one column are decimal if columns = ''acceleration''', &
            & given, table%cells)
      end if
      if (allocated(error)) return
      roles%time = findloc(roles%kinds, a_time, dim=1)
      roles%is_channel = [(roles%kinds(k) == an_acceleration .or. (roles%kinds(k) == another .and. .not. (layout%is_given .or. &
         & is_untitled(k))), k=1, table%cells)]
      if (roles%time > 0 .and. .not. layout%is_given) roles%is_told = .not. is_untitled(roles%time)
      ! Titles of something unknown are reported, those of another quantity are not
      do k = 1, table%cells
         if (layout%is_given .or. roles%kinds(k) /= another .or. is_other_quantity(top%titles(k)%text, top%units(k)%text)) cycle
         if (len(roles%note) > 0) roles%note = roles%note//'; '
         roles%note = roles%note//'column '//to_text(k)//', titled '''//shown(top%titles(k)%text)//''', is not read'
      end do

   contains

      !> Has a column no title, or one that says nothing?
      logical function is_untitled(k)
         integer, intent(in) :: k

         is_untitled = len(top%units(k)%text) == 0
         if (is_untitled) is_untitled = says_nothing(top%titles(k)%text)
      end function is_untitled

      !> What a column is by its title. The first may have none and be one of times
      integer function kind_of(k)
         integer, intent(in) :: k

         integer :: i

         kind_of = another
         associate (title => top%titles(k)%text, units => top%units(k)%text)
            if (is_time(title, units)) then
               kind_of = a_time
            else if (is_acceleration(title, units)) then
               kind_of = an_acceleration
            else if (k == 1 .and. (is_untitled(k) .or. .not. is_seconds(title, ''))) then
               if (.not. any([(is_time(top%titles(i)%text, top%units(i)%text), i=2, table%cells)])) kind_of = a_time
            end if
         end associate
      end function kind_of

      !> Refuse titles none of which is of accelerations
      subroutine raise_without_acceleration()
         do k = 1, table%cells
            if (roles%kinds(k) == a_time) cycle
            associate (title => top%titles(k)%text, units => top%units(k)%text)
               if (is_other_quantity(title, units)) then
                  call raise_at(error, text, line, 'channel '''//shown(title)//''' is not an acceleration')
               else
                  call raise_unclear(error, text, line, 'title '''//shown(title)//''' is not one of accelerations', given, &
                     & table%cells)
               end if
            end associate
            return
         end do
         call raise_at(error, text, table%begin, 'no column of accelerations beside times')
      end subroutine raise_without_acceleration

   end subroutine find_roles

   !> Take the step of the times
   subroutine take_times(text, table, top, given, roles, error)
      type(text_file_type), intent(in) :: text
      type(table_type), intent(in) :: table
      !> What is above the values
      type(top_type), intent(in) :: top
      type(given_type), intent(in) :: given
      !> A first column without a title that numbers the samples is no time
      type(roles_type), intent(inout) :: roles
      !> The times are not equally spaced, not in s, or not told to be times
      type(error_type), allocatable, intent(out) :: error

      integer :: first(most_cells), last(most_cells), i, k, rows, found
      integer, allocatable :: from(:), to(:)
      character(len=:), allocatable :: problem
      type(step_type) :: step
      real(wp) :: known

      k = roles%time
      associate (title => top%titles(k)%text, times => table%values(k::table%cells))
         if (roles%is_told .and. .not. (is_seconds(title, top%units(k)%text) .and. is_seconds(title, ''))) then
            call raise_at(error, text, top%title_line, 'title '''//shown(title)//''' of the times: they must be in s')
            return
         end if
         do i = k + 1, table%cells
            if (roles%kinds(i) /= a_time) cycle
            if (all(abs(table%values(i::table%cells) - times) <= 0.0_wp)) cycle
            call raise_at(error, text, top%title_line, 'columns '//to_text(k)//' and '//to_text(i)//' are titled as times: '// &
               & 'they must be the same')
            return
         end do
         rows = size(table%values)/table%cells
         if (rows > 2 .and. abs(times(1) - real(rows - 1, wp)) <= 0.0_wp) then
            call raise_unclear(error, text, table%begin, 'the number of samples, which may stand only above a single column', &
               & given, table%cells)
            return
         end if
         allocate (from(rows), to(rows))
         do i = 1, rows
            call find_cells(text, table%begin + i - 1, table%separator, first, last, found)
            from(i) = first(k)
            to(i) = last(k)
         end do
         known = top%statements%dt
         if (allocated(given%dt)) known = given%dt
         call check_equal_steps(text, table%begin, times, from, to, step, error, known)
         roles%dt = step%dt
         roles%doubt = step%doubt
         if (len(roles%note) > 0 .and. len(step%note) > 0) roles%note = roles%note//'; '
         roles%note = roles%note//step%note
         if (roles%is_told) then
            if (.not. allocated(error) .and. roles%dt >= longest_titled_step) call raise_at(error, text, table%begin, 'column '// &
               & to_text(k)//' increases by '//brief(roles%dt)//': must be times in s')
            return
         end if
         if (.not. allocated(error) .and. roles%dt <= longest_step) return
         if (top%title_line > 0 .and. .not. allocated(error) .and. abs(roles%dt - 1.0_wp) <= 0.0_wp) then
            ! The index of a table, as programs write it
            roles%kinds(k) = another
            roles%time = 0
            roles%dt = 0.0_wp
            roles%doubt = 0.0_wp
            roles%note = 'column '//to_text(k)//' numbers the samples and is not read'
            return
         end if
         if (allocated(error)) then
            problem = error%message(len(text%file) + 3:)
         else
            problem = 'column '//to_text(k)//' increases by '//brief(roles%dt)
         end if
         call raise_unclear(error, text, table%begin, to_text(table%cells)//' columns without titles of which the first is no '// &
            & 'column of times at equal steps of at most '//to_text(longest_step)//' s ('//problem//'); a number of '// &
            & 'samples and a step may stand only above a single column', given, table%cells)
      end associate
   end subroutine take_times

end module dondolo_records_column_roles
