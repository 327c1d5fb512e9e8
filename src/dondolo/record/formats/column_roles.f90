!> Which columns are times, numbers of samples or channels.
!>
!> A column is a time only if it is titled so, or if it is the first without a title, or the second after numbers of samples, and
!> increases by equal steps that a recorder can have. Numbers of samples, such as the index of a table, are reported and not read.
!> All else is a channel. A column that increases throughout and is none of these is an error.
module dondolo_record_column_roles
   use dondolo_base_error, only : error_type
   use dondolo_base_kinds, only : wp
   use dondolo_base_plain, only : shown
   use dondolo_base_text, only : brief, to_text
   use dondolo_base_text_file, only : text_file_type
   use dondolo_record_column_cells, only : find_cells, most_cells
   use dondolo_record_column_titles, only : is_index, is_seconds, is_time, says_nothing
   use dondolo_record_column_top, only : top_type
   use dondolo_record_equal_steps, only : check_equal_steps
   use dondolo_record_format, only : raise_at
   implicit none
   private

   public :: roles_type, table_type, find_roles

   !> Longest time step of a recorder [s]
   real(wp), parameter :: longest_step = 0.25_wp

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
      !> Numbers of the columns that are channels
      integer, allocatable :: channels(:)
      !> Step of the times, and by how much it may be off; 0 without times [s]
      real(wp) :: dt = 0.0_wp, doubt = 0.0_wp
      !> What to report, empty if there is nothing
      character(len=:), allocatable :: note
   end type roles_type

contains

   !> Find the roles of columns
   subroutine find_roles(text, table, top, is_given, roles, error)
      type(text_file_type), intent(in) :: text
      type(table_type), intent(in) :: table
      !> What is above the values
      type(top_type), intent(in) :: top
      !> Does the caller give a time step?
      logical, intent(in) :: is_given
      type(roles_type), intent(out) :: roles
      !> Times that are not equally spaced or not in s, or a column that may be a time or not
      type(error_type), allocatable, intent(out) :: error

      logical :: is_channel(table%cells), is_titled_time(table%cells)
      integer :: k, time

      roles%note = ''
      is_channel = .true.
      roles%channels = [1]
      if (table%cells == 1) return
      is_titled_time = [(is_time(top%titles(k)%text, top%units(k)%text), k=1, table%cells)]
      time = findloc(is_titled_time, .true., dim=1)
      if (time > 0) then
         do k = 1, table%cells
            if (k == time) cycle
            if (is_titled_time(k)) then
               ! A time for each channel
               is_channel(k) = .false.
               if (all(abs(table%values(k::table%cells) - table%values(time::table%cells)) <= 0.0_wp)) cycle
               call raise_at(error, text, top%title_line, 'columns '//to_text(time)//' and '//to_text(k)// &
                  & ' are titled as times: they must be the same')
               return
            end if
            if (k < time .and. may_be_index(k)) call drop(k)
         end do
      else
         call find_untitled(time)
         if (allocated(error)) return
      end if
      if (time > 0) then
         is_channel(time) = .false.
         call take_times(time)
         if (allocated(error)) return
      end if
      roles%channels = pack([(k, k=1, table%cells)], is_channel)
      if (size(roles%channels) == 0) call raise_at(error, text, table%begin, &
         & 'no column of accelerations beside times and numbers of samples')

   contains

      !> Does a column without a title, or with that of an index, number the samples?
      logical function may_be_index(k)
         integer, intent(in) :: k

         may_be_index = is_untitled(k) .or. is_index(top%titles(k)%text)
         if (may_be_index) may_be_index = are_numbers(table%values(k::table%cells))
      end function may_be_index

      !> Has a column no title, or one that says nothing?
      logical function is_untitled(k)
         integer, intent(in) :: k

         is_untitled = len(top%units(k)%text) == 0
         if (is_untitled) is_untitled = says_nothing(top%titles(k)%text)
      end function is_untitled

      !> Report that a column numbers the samples
      subroutine drop(k)
         integer, intent(in) :: k

         is_channel(k) = .false.
         if (len(roles%note) > 0) roles%note = roles%note//'; '
         roles%note = roles%note//'column '//to_text(k)//' numbers the samples and is not read'
      end subroutine drop

      !> Find the column of times where none is titled so
      subroutine find_untitled(time)
         !> Its number, 0 if there is none
         integer, intent(out) :: time

         integer :: k

         time = 0
         k = 1
         if (may_be_index(1)) then
            call drop(1)
            ! Beside a single column that is left there is no time
            if (table%cells == 2) return
            k = 2
            if (.not. increases(table%values(k::table%cells)) .or. .not. is_untitled(k)) return
         end if
         if (increases(table%values(k::table%cells))) then
            if (is_untitled(k)) then
               time = k
            else if (is_seconds(top%titles(k)%text, '')) then
               call raise_at(error, text, top%title_line, 'column '//to_text(k)//', titled '''// &
                  & shown(top%titles(k)%text)//''', increases throughout: the title of a time must be ''time (s)''')
            else
               call raise_at(error, text, top%title_line, 'title '''//shown(top%titles(k)%text)// &
                  & ''' of the times: they must be in s')
            end if
         else if (.not. (is_given .or. top%statements%dt > 0.0_wp) .and. is_untitled(k)) then
            ! Without another step it must be one; the check of the times says what is wrong
            time = k
         else if (table%separator == ',' .and. index(text%text(text%first(table%begin):), '.') == 0) then
            ! 0,5 may be a decimal
            call raise_at(error, text, table%begin, 'columns separated by commas need decimal points')
         end if
      end subroutine find_untitled

      !> Take the step of the times
      subroutine take_times(k)
         !> Number of their column
         integer, intent(in) :: k

         integer :: first(most_cells), last(most_cells), i, rows, found
         integer, allocatable :: from(:), to(:)

         if (is_titled_time(k) .and. .not. is_seconds(top%titles(k)%text, top%units(k)%text)) then
            call raise_at(error, text, top%title_line, 'title '''//shown(top%titles(k)%text)// &
               & ''' of the times: they must be in s')
            return
         end if
         rows = size(table%values)/table%cells
         allocate (from(rows), to(rows))
         do i = 1, rows
            call find_cells(text, table%begin + i - 1, table%separator, first, last, found)
            from(i) = first(k)
            to(i) = last(k)
         end do
         call check_equal_steps(text, table%begin, table%values(k::table%cells), from, to, roles%dt, roles%doubt, error)
         if (allocated(error)) then
            if (table%separator == ',' .and. index(text%text(text%first(table%begin):), '.') == 0) then
               error%message = error%message//' (columns separated by commas need decimal points)'
            end if
         else if (is_titled_time(k) .and. are_numbers(table%values(k::table%cells))) then
            call raise_at(error, text, table%begin, 'column '//to_text(k)//', titled '''//shown(top%titles(k)%text)// &
               & ''', numbers the samples: must be times in s')
         else if (.not. is_titled_time(k) .and. roles%dt > longest_step) then
            call raise_at(error, text, table%begin, 'column '//to_text(k)//' increases by '//brief(roles%dt)// &
               & ': must be times in s with steps of at most '//to_text(longest_step)//' s, or have the title ''time (s)''')
         end if
      end subroutine take_times

   end subroutine find_roles

   !> Are values whole numbers that increase by 1?
   pure logical function are_numbers(values)
      real(wp), intent(in) :: values(:)

      integer :: i

      are_numbers = size(values) > 1
      if (.not. are_numbers) return
      are_numbers = .not. abs(values(1) - anint(values(1))) > 0.0_wp
      do i = 2, size(values)
         if (.not. are_numbers) return
         are_numbers = .not. abs(values(i) - values(1) - real(i - 1, wp)) > 0.0_wp
      end do
   end function are_numbers

   !> Do values never decrease, and increase in all?
   pure logical function increases(values)
      real(wp), intent(in) :: values(:)

      increases = size(values) > 1
      if (.not. increases) return
      increases = all(values(2:) >= values(:size(values) - 1)) .and. values(size(values)) > values(1)
   end function increases

end module dondolo_record_column_roles
