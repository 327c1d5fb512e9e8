!> Numbers, tables, units, and the readers of accelerogram files.
program test_record
   use, intrinsic :: iso_fortran_env, only : int64
   use checks, only : check, check_close, check_error, check_ok, check_text, finish, skip, suite
   use dondolo_base_encoding, only : from_utf16, is_ascii, is_utf8
   use dondolo_base_error, only : error_type, status_missing
   use dondolo_base_kinds, only : wp
   use dondolo_base_limits, only : longest_case
   use dondolo_base_lines, only : lines_type
   use dondolo_base_numbers, only : parse_integer, parse_real, take_column, take_real
   use dondolo_base_text, only : to_text
   use dondolo_files_csv_reader, only : csv_row_type, csv_table_type
   use dondolo_files_csv_row, only : cell_type, split_row, text_cell
   use dondolo_files_reader, only : file_size, reader_type
   use dondolo_files_text_file, only : read_text_file, text_file_type
   use dondolo_record, only : record_type
   use dondolo_record_rows, only : record_rows_type
   use dondolo_records_catalogue, only : read_catalogue
   use dondolo_records_clusters, only : cluster_records
   use dondolo_records_record_reader, only : read_record
   use dondolo_records_units, only : unit_factor
   implicit none

   character(len=*), parameter :: scratch = 'build/test_record'
   character(len=*), parameter :: cr = achar(13), lf = achar(10), tab = achar(9)
   !> Accelerations of the small files [file's units]
   real(wp), parameter :: small(5) = [0.0_wp, 0.1_wp, -0.25_wp, 1.0e-3_wp, 0.05_wp]

   call execute_command_line('mkdir -p '//scratch//'/folder/sub')
   call test_numbers()
   call test_reader()
   call test_text_file()
   call test_csv()
   call test_csv_errors()
   call test_spreadsheets()
   call test_encodings()
   call test_units()
   call test_one_column()
   call test_two_columns()
   call test_steps()
   call test_peer()
   call test_dyna()
   call test_given()
   call test_unknown()
   call test_catalogue()
   call test_samples()
   call test_clusters()
   call finish()

contains

   !> Strict numbers
   subroutine test_numbers()
      character(len=*), parameter :: bad(*) = [character(len=13) :: '', ' ', '+', '-', '.', 'e5', '1,5', '1.5x', &
         & 'nan', &
         & 'NaN', 'inf', '-Infinity', '1e400', '3*1.0', '1/', '1 2', '1e', '1e+', '1.0.0', '--1', '1+5', '0x10', &
         & '1q5', &
         & 'T', '1_8', '1e5.0', '1e 5', '.e5', '****', '1e99999999999', '"1"', ';', '1;']
      real(wp) :: value, want
      integer :: i, number, mismatches, state
      logical :: ok
      character(len=40) :: text

      call suite('numbers')
      do i = 1, size(bad)
         call parse_real(trim(bad(i)), value, ok)
         ! 1e400 is a number in higher precision
         if (bad(i) == '1e400' .and. range(value) >= 400) cycle
         call check(.not. ok, 'number '''//trim(bad(i))//''' is refused')
      end do
      call check_number('1', 1.0_wp)
      call check_number('+1.', 1.0_wp)
      call check_number('-.5', -0.5_wp)
      call check_number('  2.5'//tab, 2.5_wp)
      call check_number('1.0D-3', 1.0e-3_wp)
      call check_number('1d+2', 100.0_wp)
      call check_number('-.8075668E-03', -0.8075668e-3_wp)
      call check_number('5.3720000e+001', 53.72_wp)
      call check_number('0.100000000000000005551115123126', 0.100000000000000005551115123126_wp)
      call check_number('9007199254740993', 9007199254740993.0_wp)
      call check_number('123456789012345678901234567890', 123456789012345678901234567890.0_wp)
      call check_number('00000000000000000000000000000000001.5', 1.5_wp)
      call check_number('1e22', 1.0e22_wp)
      call check_number('1e-300', 1.0e-300_wp)
      call check_number('-0', 0.0_wp)
      ! The fast path must be the compiler's READ to the last bit
      mismatches = 0
      state = 1
      do i = 1, 200000
         state = modulo(state*16807, 2147483647)
         if (modulo(i, 2) == 0) then
            write (text, '(f0.'//to_text(modulo(i, 11))//')') real(state - 1000000000, wp)/10.0_wp**modulo(i, 13)
         else
            write (text, '(es30.'//to_text(modulo(i, 17) + 1)//'e3)') real(state - 1000000000, &
         & wp)/3.0_wp**modulo(i, 61)
         end if
         read (text, *) want
         call parse_real(text, value, ok)
         if (.not. ok .or. value < want .or. value > want) mismatches = mismatches + 1
      end do
      call check(mismatches == 0, to_text(mismatches)//' of 200000 numbers differ from READ')
      call test_eight_decimals()
      call test_column()
      call parse_integer(' -42 ', number, ok)
      call check(ok .and. number == -42, 'integer -42')
      call parse_integer('2147483647', number, ok)
      call check(ok .and. number == huge(number), 'largest integer')
      call check_no_integer('2147483648')
      call check_no_integer('99999999999999999999')
      call check_no_integer('1.0')
      call check_no_integer('')
      call check_no_integer('1e3')
      call check_no_integer('1 2')
   end subroutine test_numbers

   !> Eight decimals are read at once where all are digits: any other character ends the number where it stands
   subroutine test_eight_decimals()
      character(len=10) :: text
      real(wp) :: value, want
      integer :: code, place, at, wrong
      logical :: ok

      wrong = 0
      do code = 0, 255
         if (index('eEdD', achar(code)) > 0) cycle
         do place = 3, 10
            text = '7.12345678'
            text(place:place) = achar(code)
            at = 1
            call take_real(text, at, len(text), value, ok)
            if (code >= iachar('0') .and. code <= iachar('9')) then
               read (text, *) want
               ok = ok .and. at == len(text) + 1
            else
               read (text(:place - 1), *) want
               ok = ok .and. at == place
            end if
            if (.not. ok .or. value < want .or. value > want) wrong = wrong + 1
         end do
      end do
      call check(wrong == 0, to_text(wrong)//' characters among eight decimals are taken wrongly')
   end subroutine test_eight_decimals

   !> A column of numbers is taken as each number alone, and ends before anything else
   subroutine test_column()
      character(len=*), parameter :: usual = '0.12345678'
      real(wp) :: values(8), want
      integer :: count, i, wrong
      logical :: ok

      associate (text => usual//cr//lf//'-'//usual//lf//' '//tab//usual//' '//cr//lf//'-1e-3'//lf//'12.123456789'//lf// &
         & '+.5'//lf//'-0.00000000'//lf//'7')
         call take_column(text, values, count, ok)
         call check(ok .and. count == 8, 'a column is taken')
         call parse_real(usual, want, ok)
         call check_close(values(1), want, 0.0_wp, 'first number of a column')
         call check_close(values(2), -want, 0.0_wp, 'second, negative')
         call check_close(values(3), want, 0.0_wp, 'third, between blanks')
         call check_close(values(4), -1.0e-3_wp, 0.0_wp, 'fourth, with an exponent')
         call check_close(values(5), 12.123456789_wp, 0.0_wp, 'fifth, with more digits')
         call check_close(values(6), 0.5_wp, 0.0_wp, 'sixth, without a digit before the point')
         call check(sign(1.0_wp, values(7)) < 0.0_wp, 'the minus of zero stays')
         call check_close(values(8), 7.0_wp, 0.0_wp, 'last, an integer without a line end')
         wrong = 0
         do i = 0, len(usual) + 2
            call take_column(text(:i), values, count, ok)
            if (ok .neqv. (i >= 1 .and. i <= len(usual))) wrong = wrong + 1
         end do
         call check(wrong == 0, 'a column is refused where a line end comes last')
      end associate
      call check_no_column('')
      call check_no_column(' ')
      call check_no_column('1'//lf)
      call check_no_column('1'//lf//lf//'2')
      call check_no_column('1'//cr//'2')
      call check_no_column('1'//cr//cr//lf//'2')
      call check_no_column(usual//'1.0'//lf//usual)
      call check_no_column(usual//'e+'//lf//usual)
      call check_no_column(usual//' '//usual//lf//usual)
      call check_no_column(usual//lf//'x')
      call check_no_column(usual//','//lf//usual)
   end subroutine test_column

   !> A text that is no column of numbers
   subroutine check_no_column(text)
      character(len=*), intent(in) :: text
      real(wp) :: values(8)
      integer :: count
      logical :: ok

      call take_column(text, values, count, ok)
      call check(.not. ok, 'column '''//text//''' is refused')
   end subroutine check_no_column

   !> A text that is a number
   subroutine check_number(text, want)
      character(len=*), intent(in) :: text
      real(wp), intent(in) :: want
      real(wp) :: value
      logical :: ok

      call parse_real(text, value, ok)
      call check(ok, 'number '''//text//''' is read')
      call check_close(value, want, 0.0_wp, 'number '''//text//'''')
   end subroutine check_number

   !> A text that is no integer
   subroutine check_no_integer(text)
      character(len=*), intent(in) :: text
      integer :: value
      logical :: ok

      call parse_integer(text, value, ok)
      call check(.not. ok, 'integer '''//text//''' is refused')
   end subroutine check_no_integer

   !> Lines of a file
   subroutine test_text_file()
      type(text_file_type) :: text
      type(error_type), allocatable :: error

      call suite('text file')
      call write_file('lines.txt', achar(239)//achar(187)//achar(191)//'one'//cr//lf//lf//' three'//lf//'four'// &
         & cr//lf// &
         & achar(26)//cr//lf)
      call read_text_file(scratch//'/lines.txt', text, error, longest_case)
      call check_ok(error, 'read')
      call check(text%lines() == 4, 'four lines')
      call check_text(text%line(1), 'one', 'line 1')
      call check_text(text%line(2), '', 'line 2')
      call check_text(text%line(3), ' three', 'line 3')
      call check_text(text%line(4), 'four', 'line 4')
      call check_text(text%line(5), '', 'line 5')
      call check_text(text%place(3), scratch//'/lines.txt: line 3', 'place')
      call write_file('lines.txt', 'a'//lf//'b')
      call read_text_file(scratch//'/lines.txt', text, error, longest_case)
      call check(text%lines() == 2, 'two lines')
      call check_text(text%line(2), 'b', 'last line without line end')
      call write_file('lines.txt', '')
      call read_text_file(scratch//'/lines.txt', text, error, longest_case)
      call check_error(error, scratch//'/lines.txt: the file is empty', 'no bytes')
      call write_file('lines.txt', cr//lf//lf//' ')
      call read_text_file(scratch//'/lines.txt', text, error, longest_case)
      call check_error(error, 'the file is empty', 'blanks')
      call read_text_file(scratch//'/none.txt', text, error, longest_case)
      call check_error(error, scratch//'/none.txt: no such file', 'missing file')
      call check(error%stat == status_missing, 'a missing file is one')
      call read_text_file(scratch//'/folder', text, error, longest_case)
      call check_error(error, scratch//'/folder: ', 'folder')
      call read_text_file('', text, error, longest_case)
      call check(allocated(error), 'no name')
      call test_line_ends()
      call test_ascii()
   end subroutine test_text_file

   !> Bytes of files, of one that is open twice too
   subroutine test_reader()
      character(len=*), parameter :: name = scratch//'/città è.txt'
      type(reader_type) :: reader, other
      character(len=4) :: bytes
      logical :: ok

      call suite('bytes of files')
      call write_file('città è.txt', '0123456789')
      call check(file_size(name) == 10_int64, 'size of a file')
      call check(file_size(scratch//'/none.txt') < 0, 'size of no file')
      call reader%open(scratch//'/none.txt', ok)
      call check(.not. (ok .or. reader%is_open()), 'no file')
      call reader%open(scratch//'/folder', ok)
      call check(.not. (ok .or. reader%is_open()), 'a folder')
      call reader%open(name, ok)
      call check(ok .and. reader%is_open(), 'opened')
      call other%open(name, ok)
      call check(ok, 'opened twice')
      call check(reader%size() == 10_int64, 'size of an open file')
      call reader%read(7_int64, bytes, ok)
      call check(ok, 'read')
      call check_text(bytes, '6789', 'its last bytes')
      call other%read(1_int64, bytes, ok)
      call check_text(bytes, '0123', 'its first bytes')
      call reader%read(8_int64, bytes, ok)
      call check(.not. ok, 'beyond its end')
      call reader%close()
      call other%close()
      call check(.not. reader%is_open(), 'closed')
      call reader%read(1_int64, bytes, ok)
      call check(.not. ok, 'read after it was closed')
   end subroutine test_reader

   !> Line ends are looked for in eight characters at once: they are found wherever they stand among them
   subroutine test_line_ends()
      type(text_file_type) :: text
      type(error_type), allocatable :: error
      character(len=:), allocatable :: content
      integer, parameter :: longest = 19
      integer :: i, length, wrong

      content = ''
      ! Every length after every other one, so that all offsets occur; characters one beside the line feed do too
      do i = 0, longest**2 - 1
         length = merge(i/longest, modulo(i, longest), modulo(i, 2) == 0)
         content = content//repeat(achar(11), length)//merge(cr, ' ', modulo(i, 3) == 0)//lf
      end do
      call write_file('lines.txt', content//'end')
      call read_text_file(scratch//'/lines.txt', text, error, longest_case)
      call check_ok(error, 'read')
      if (allocated(error)) return
      call check(text%lines() == longest**2 + 1, 'number of lines')
      wrong = 0
      do i = 0, min(text%lines(), longest**2) - 1
         length = merge(i/longest, modulo(i, longest), modulo(i, 2) == 0)
         if (text%line(i + 1) /= repeat(achar(11), length)) wrong = wrong + 1
         if (len(text%line(i + 1)) /= length + merge(0, 1, modulo(i, 3) == 0)) wrong = wrong + 1
      end do
      call check(wrong == 0, to_text(wrong)//' lines are found wrongly')
   end subroutine test_line_ends

   !> Bytes that are not ASCII are looked for among eight at once: they are found wherever they are
   subroutine test_ascii()
      character(len=19) :: text
      integer :: code, place, length, wrong

      wrong = 0
      do code = 0, 255
         do length = 1, len(text)
            do place = 1, length
               text = repeat(achar(127 - 126*modulo(place, 2)), len(text))
               text(place:place) = achar(code)
               if (is_ascii(text(:length)) .neqv. (code > 0 .and. code < 128)) wrong = wrong + 1
            end do
         end do
      end do
      call check(wrong == 0, to_text(wrong)//' texts are wrongly taken for ASCII, or not')
      call check(is_ascii(''), 'no bytes are ASCII')
   end subroutine test_ascii

   !> Tables that are right
   subroutine test_csv()
      type(csv_table_type) :: table
      type(csv_row_type) :: row
      type(error_type), allocatable :: error
      real(wp) :: value
      logical :: found

      call suite('csv')
      call write_file('good.csv', achar(239)//achar(187)//achar(191)//'# remark, with "one quote'//lf//lf// &
         & 'name, height_m ,"a ""b"", c"'// &
         & cr//lf//'x , 2.5,plain'//cr//lf//'  '//lf//'# again'//lf//'"two'//lf//'lines, one cell" , 1.0D-3 ,""'// &
         & lf//',,"say ""hi"""')
      call table%read(scratch//'/good.csv', error)
      call check_ok(error, 'read')
      if (allocated(error)) return
      call check(size(table%columns) == 3, 'three columns')
      call check(table%column('name') == 1 .and. table%column('HEIGHT_m') == 2 .and. table%column('a "b", c') == 3, &
         & 'columns')
      call check(table%column('a') == 0 .and. table%column('') == 0, 'no such column')
      call next_row(table, row, 4, 'x', 'plain')
      call table%get_real(row, 2, value, error)
      call check_close(value, 2.5_wp, 0.0_wp, 'number')
      call table%get_real(row, 3, value, error)
      call check_error(error, 'a "b", c = ''plain'': must be a number', 'word')
      call next_row(table, row, 7, 'two'//lf//'lines, one cell', '')
      call table%get_real(row, 2, value, error)
      call check_close(value, 1.0e-3_wp, 0.0_wp, 'number with D exponent')
      call next_row(table, row, 9, '', 'say "hi"')
      call check_text(row%get_text(0), '', 'cell of a column that is absent')
      call table%get_real(row, 2, value, error)
      call check_error(error, 'height_m = '''': must be a number', 'empty cell')
      call table%next(row, found, error)
      call check_ok(error, 'end')
      call check(.not. found, 'three rows')
      call write_file('good.csv', 'a,b'//cr//lf)
      call table%read(scratch//'/good.csv', error)
      call check_ok(error, 'header only')
      row = csv_row_type()
      call table%next(row, found, error)
      call check(.not. found, 'no rows')
   end subroutine test_csv

   !> The next row of a table
   subroutine next_row(table, row, line, first, last)
      type(csv_table_type), intent(in) :: table
      type(csv_row_type), intent(inout) :: row
      integer, intent(in) :: line
      character(len=*), intent(in) :: first, last
      type(error_type), allocatable :: error
      logical :: found

      call table%next(row, found, error)
      call check_ok(error, 'row')
      call check(found .and. row%line == line, 'line number')
      call check_text(table%place(row), scratch//'/good.csv: line '//to_text(line), 'place')
      call check_text(row%get_text(1), first, 'first cell')
      call check_text(row%get_text(3), last, 'last cell')
   end subroutine next_row

   !> Tables that are wrong
   subroutine test_csv_errors()
      call suite('csv errors')
      call check_csv('a,b'//lf//'1,2'//lf//'1,2,3'//lf, ': line 3: 3 cells: must be 2 as in the header')
      call check_csv('a,b'//lf//'1'//lf, ': line 2: 1 cells: must be 2')
      call check_csv('a,b'//lf//'1,2,'//lf, ': line 2: 3 cells: must be 2')
      call check_csv('a,b'//lf//'1,"2'//lf//'3,4'//lf, ': line 2: a double quote is not closed')
      call check_csv('a,b'//lf//'1,2"3"'//lf, ': line 2: cell 2: a double quote inside')
      call check_csv('a,b'//lf//'1,"2"3'//lf, ': line 2: cell 2: text after the closing double quote')
      call check_csv('a,,b'//lf//'1,2,3'//lf, ': line 1: column 2 has no name')
      call check_csv('a,b'//lf//'1,5,2,25'//lf, ': line 2: 4 cells: must be 2 as in the header (columns separated by '// &
         & 'commas need decimal points)')
      call check_csv('a,,b,'//lf, ': line 1: column 2 has no name')
      call check_csv('a,b,'//lf//'1,2,3'//lf, ': line 2: cell 3 = ''3'': its column has no name')
      call check_csv('# x'//lf//'a,b,A'//lf, ': line 2: column ''A'' is a duplicate')
      call check_csv('', ': the file is empty')
      call check_csv('# only a remark'//lf, ': no header')
   end subroutine test_csv_errors

   !> Tables as spreadsheets write them
   subroutine test_spreadsheets()
      character(len=*), parameter :: title = ': read with line 1 is a title', semicolons = 'columns separated by semicolons'

      call suite('spreadsheets')
      call check_numbers('a,b'//lf//'1.5,2'//lf, [1.5_wp, 2.0_wp], '')
      call check_numbers('a;b'//lf//'1,5;2'//lf, [1.5_wp, 2.0_wp], ': read with '//semicolons//', decimal commas')
      call check_numbers('a;b'//lf//'1.5;2'//lf, [1.5_wp, 2.0_wp], ': read with '//semicolons)
      call check_numbers('a'//tab//'b'//lf//'1,5'//tab//'2'//lf, [1.5_wp, 2.0_wp], &
         & ': read with columns separated by tabs, decimal commas')
      call check_numbers(achar(239)//achar(187)//achar(191)//'"a";b;;'//cr//lf//'1,5;"2";;'//cr//lf//';;;'//cr//lf// &
         & ' ; ;;'//cr//lf, [1.5_wp, 2.0_wp], ': read with '//semicolons//', decimal commas')
      call check_numbers('a,b'//lf//',,'//lf//'1.5,2'//lf//','//lf, [1.5_wp, 2.0_wp], '')
      call check_numbers('Walls of 2024'//lf//'a,b'//lf//'1.5,2'//lf, [1.5_wp, 2.0_wp], title)
      call check_numbers('Walls, 2024;'//lf//'a;b'//lf//'1,5;2'//lf, [1.5_wp, 2.0_wp], &
         & ': read with '//semicolons//', decimal commas, line 1 is a title')
      call check_numbers('# remark'//lf//'Walls, 2024'//lf//lf//'a;b'//lf//'1,5;2'//lf, [1.5_wp, 2.0_wp], &
         & ': read with '//semicolons//', decimal commas, line 2 is a title')
      ! Thousands or decimals? Other numbers of the table tell, or the number is refused
      call check_numbers('a;b'//lf//'1,800;0,25'//lf, [1.8_wp, 0.25_wp], ': read with '//semicolons//', decimal commas')
      call check_numbers('a;b'//lf//'1.800;0.25'//lf, [1.8_wp, 0.25_wp], ': read with '//semicolons)
      call check_no_numbers('a;b'//lf//'1.800;2'//lf, 'a = ''1.800'': may be thousands or decimals')
      call check_no_numbers('a;b'//lf//'1,800;2'//lf, 'a = ''1,800'': may be thousands or decimals')
      call check_no_numbers('a;b'//lf//'1.800;0,25'//lf, 'a = ''1.800'': must be a number, with a decimal comma as')
      call check_no_numbers('a;b'//lf//'1.800,5;1'//lf, 'a = ''1.800,5'': must be a number, with a decimal comma as')
      call check_no_numbers('a;b'//lf//'1.5;1'//lf//'1,5;2'//lf, 'a = ''1.5'': must be a number, with a decimal comma as')
      call check_no_numbers('a,b'//lf//'"1,5",2'//lf, 'a = ''1,5'': must be a number, with a decimal point')
      ! An error of a spreadsheet is no comment
      call check_numbers('a;b'//lf//'# 1; 2; 3'//lf//'1,5;2'//lf, [1.5_wp, 2.0_wp], &
         & ': read with '//semicolons//', decimal commas')
      call check_csv('a;b'//lf//'#N/D;2'//lf//'1,5;2'//lf, ': line 2: begins with # as a comment does')
      call check_csv('a;b'//lf//'1,5;2'//lf//'#12;2'//lf, ': line 3: begins with # as a comment does')
      call check_cell('plain', 'plain', 'plain')
      call check_cell(' a, "b" ', '" a, ""b"" "', '" a, ""b"" "')
      call check_cell('=1+1', '=1+1', '''=1+1')
      call check_cell('@a,b', '"@a,b"', '"''@a,b"')
      call check_cell('-5', '-5', '''-5')
      call check_cell('''=1', '''''=1', '''''=1')
      call check_cell('''''', '''''''', '''''''')
      call check_cell('''s Hertogenbosch', '''s Hertogenbosch', '''s Hertogenbosch')
      call check_cell('''', '''', '''')
      call check_cell('', '', '')
   end subroutine test_spreadsheets

   !> A text as a cell, without and with a guard against spreadsheets, and read back
   subroutine check_cell(text, cell, safe)
      character(len=*), intent(in) :: text, cell, safe
      type(cell_type), allocatable :: cells(:)
      character(len=:), allocatable :: problem

      call check_text(text_cell(text, .false.), cell, 'cell of '//text)
      call check_text(text_cell(text, .true.), safe, 'safe cell of '//text)
      call split_row('x,'//cell//','//safe, ',', cells, problem)
      call check_text(cells(2)%text, text, 'cell read back')
      call check_text(cells(3)%text, text, 'safe cell read back')
   end subroutine check_cell

   !> A table of two numbers, and how it was read
   subroutine check_numbers(content, want, note)
      character(len=*), intent(in) :: content, note
      real(wp), intent(in) :: want(2)
      type(csv_table_type) :: table
      type(csv_row_type) :: row
      type(error_type), allocatable :: error
      real(wp) :: value
      integer :: i
      logical :: found

      call write_file('numbers.csv', content)
      call table%read(scratch//'/numbers.csv', error)
      if (.not. allocated(error)) call table%find_decimal_mark([1, 2])
      if (.not. allocated(error)) call table%next(row, found, error)
      call check_ok(error, 'table '//content)
      if (allocated(error)) return
      do i = 1, 2
         call table%get_real(row, i, value, error)
         call check_ok(error, 'number in '//content)
         call check_close(value, want(i), 0.0_wp, 'number in '//content)
      end do
      if (len(note) == 0) then
         call check_text(table%note(), '', 'no note on '//content)
      else
         call check_text(table%note(), scratch//'/numbers.csv'//note, 'note on '//content)
      end if
      call table%next(row, found, error)
      call check_ok(error, 'end')
      call check(.not. found, 'one row in '//content)
   end subroutine check_numbers

   !> A table whose first number is refused
   subroutine check_no_numbers(content, part)
      character(len=*), intent(in) :: content, part
      type(csv_table_type) :: table
      type(csv_row_type) :: row
      type(error_type), allocatable :: error
      real(wp) :: value
      logical :: found

      call write_file('numbers.csv', content)
      call table%read(scratch//'/numbers.csv', error)
      if (.not. allocated(error)) call table%find_decimal_mark([1, 2])
      if (.not. allocated(error)) call table%next(row, found, error)
      call check_ok(error, 'table '//content)
      if (allocated(error)) return
      call table%get_real(row, 1, value, error)
      call check_error(error, part, 'number in '//content)
   end subroutine check_no_numbers

   !> What is UTF-8, and what is not
   subroutine test_encodings()
      character(len=*), parameter :: remedy = ': save it as UTF-8 (Excel: Save As, CSV UTF-8; Notepad: Save As, Encoding UTF-8)'
      integer, parameter :: right(4, 5) = reshape([97, 98, 99, 100, 195, 160, 97, 98, 226, 130, 172, 97, &
         & 240, 159, 143, 155, 238, 128, 128, 97], [4, 5])
      ! Windows-1252, an overlong form, a surrogate, beyond U+10FFFF, a form that is cut off
      integer, parameter :: wrong(4, 5) = reshape([97, 224, 98, 99, 192, 175, 97, 98, 237, 160, 128, 97, &
         & 244, 144, 128, 128, 97, 98, 226, 130], [4, 5])
      character(len=:), allocatable :: text
      integer :: i

      call suite('encodings')
      do i = 1, size(right, 2)
         call check(is_utf8(bytes(right(:, i))), 'UTF-8')
         call check(.not. is_utf8(bytes(wrong(:, i))), 'not UTF-8')
      end do
      call check_csv('a,b'//lf//'1,2'//lf//'x'//achar(224)//',y'//achar(224)//lf//achar(224)//',1'//lf, &
         & ': line 3: byte 2 (E0) is not UTF-8 (Windows-1252?)'//remedy)
      call check_csv('a'//achar(0)//','//achar(0)//'b'//achar(0)//lf//achar(0), ': line 1: byte 2 is NUL: this is not '// &
         & 'a text file, or it is UTF-16 without a byte order mark'//remedy)
      call check_numbers(achar(255)//achar(254)//wide('a,b'//cr//lf//'1.5,2'), [1.5_wp, 2.0_wp], '')
      call check_numbers(achar(254)//achar(255)//achar(0)//wide('a,b'//cr//lf//'1.5,2'//lf)//' ', [1.5_wp, 2.0_wp], '')
      call check_numbers('a,b'//cr//'1.5,2'//cr, [1.5_wp, 2.0_wp], '')
      call check_numbers('a,b'//cr//cr//lf//'1.5,2'//cr//cr//lf, [1.5_wp, 2.0_wp], '')
      ! Code points beyond 16 bits are pairs of surrogates
      call from_utf16(bytes([60, 216, 219, 223, 233, 0]), 1, text)
      call check_text(text, bytes([240, 159, 143, 155, 195, 169]), 'UTF-16')
      call from_utf16(bytes([60, 216, 219, 223, 233, 0, 60, 216]), 1, text)
      call check_text(text, bytes([240, 159, 143, 155, 195, 169, 239, 191, 189]), 'half a pair at the end')
      call from_utf16(bytes([216, 60, 0, 97, 223, 219, 0]), 2, text)
      call check_text(text, bytes([239, 191, 189, 97, 239, 191, 189, 239, 191, 189]), 'surrogates alone')
   end subroutine test_encodings

   !> ASCII as UTF-16, the low byte first
   pure function wide(text)
      character(len=*), intent(in) :: text
      character(len=2*len(text)) :: wide
      integer :: i

      do i = 1, len(text)
         wide(2*i - 1:2*i) = text(i:i)//achar(0)
      end do
   end function wide

   !> A text of bytes
   pure function bytes(codes) result(text)
      integer, intent(in) :: codes(:)
      character(len=size(codes)) :: text
      integer :: i

      do i = 1, size(codes)
         text(i:i) = achar(codes(i))
      end do
   end function bytes

   !> A table with an error
   subroutine check_csv(content, part)
      character(len=*), intent(in) :: content, part
      type(csv_table_type) :: table
      type(csv_row_type) :: row
      type(error_type), allocatable :: error
      logical :: found

      call write_file('bad.csv', content)
      call table%read(scratch//'/bad.csv', error)
      found = .true.
      do while (found .and. .not. allocated(error))
         call table%next(row, found, error)
      end do
      call check_error(error, scratch//'/bad.csv'//part, 'table '//content)
   end subroutine check_csv

   !> Units and their spellings
   subroutine test_units()
      character(len=*), parameter :: metres(*) = [character(len=10) :: 'm/s2', 'm/s^2', 'M/S/S', 'm/s**2', 'm/sec2', &
         & 'm/sec^2', 'm/sec/sec', ' m / s2', 'm s-2', 'm s^-2', 'm/s'//achar(194)//achar(178)]
      character(len=*), parameter :: centimetres(*) = [character(len=10) :: 'cm/s2', 'cm/s^2', 'CM/SEC/SEC', &
         & 'cm/sec2', &
         & 'cm/s/s', 'gal', 'Gal', 'GAL']
      character(len=*), parameter :: wrong(*) = [character(len=10) :: '%g', 'cm/s', 'm', 'mg', 'm/s3', 'ft/s2', &
         & '', 'gals', 'm/s22']
      type(error_type), allocatable :: error
      real(wp) :: factor
      integer :: i

      call suite('units')
      do i = 1, size(metres)
         call unit_factor(trim(metres(i)), factor, error)
         call check_ok(error, metres(i))
         call check_close(factor, 1.0_wp, 0.0_wp, metres(i))
      end do
      do i = 1, size(centimetres)
         call unit_factor(trim(centimetres(i)), factor, error)
         call check_ok(error, centimetres(i))
         call check_close(factor, 0.01_wp, 0.0_wp, centimetres(i))
      end do
      call unit_factor('mm/s^2', factor, error)
      call check_close(factor, 0.001_wp, 0.0_wp, 'mm/s^2')
      call unit_factor('G', factor, error)
      call check_close(factor, 9.80665_wp, 0.0_wp, 'g')
      do i = 1, size(wrong)
         call unit_factor(trim(wrong(i)), factor, error)
         call check_error(error, 'units = '''//trim(wrong(i))// &
         & ''': must be one of ''m/s2'', ''cm/s2'', ''gal'', ''mm/s2'', ''g''', &
            & 'wrong unit '//wrong(i))
      end do
   end subroutine test_units

   !> One column
   subroutine test_one_column()
      character(len=*), parameter :: values = '0'//lf//'1.0E-01'//lf//' -.25'//lf//'1d-3 '//lf//'+0.05'//lf

      call suite('one column')
      call check_file('plain.txt', values)
      call check_file('dots.in.name.acc', values)
      call check_file('crlf.txt', '0'//cr//lf//'.1'//cr//lf//'-.25'//cr//lf//'.001'//cr//lf//'5e-2'//achar(26))
      call check_file('titled', '# remark'//lf//lf//'acceleration (m/s2)'//lf//'#'//lf//values)
      call check_file('quoted.csv', '"acc"'//lf//values)
      call check_bad_file('# remark 1,2,3'//lf//values, ': line 1: ''remark 1,2,3'' is no statement that is read: a row of a '// &
         & 'catalogue must say what the file holds, as ''file,dt_s,units,columns'' and ''bad.txt,STEP,m/s2,acceleration''')
      call check_bad_file('0.1'//lf//'1,5'//lf//'0.3'//lf, ': line 1: ''0.1'' above lines of 2 values')
      call check_bad_file('0.1'//lf//'0.2'//lf//'nan'//lf//'0.3', ': line 3: value ''nan'': must be a number')
      call check_bad_file('NaN'//lf//'0.2'//lf//'0.3'//lf, ': line 1: value ''NaN'': must be a number')
      call check_bad_file('*****'//lf//'0.2'//lf//'0.3'//lf, ': line 1: value ''*****'': must be a number')
      call check_bad_file('0.1'//lf//'0.2x'//lf//'0.3'//lf, ': line 2: value ''0.2x'': must be a number')
      call check_bad_file('0.1'//lf//'0.2'//lf//lf//'0.3'//lf, ': line 3: 0 values: must be 1')
      call check_bad_file('0.1'//lf//'0.2'//lf//'# remark'//lf//'0.3'//lf, ': line 3: 2 values: must be 1')
      call check_bad_file('0.1'//lf//'0.2'//lf//'1e400'//lf, ': ')
      call check_bad_file('acc'//lf//'0.1'//lf, ': number of samples = 1: must be at least 2')
      call check_bad_file('0.1'//lf//'2e4'//lf, ': sample 2 = 2')
   end subroutine test_one_column

   !> Two columns
   subroutine test_two_columns()
      character(len=*), parameter :: no_times = ': line 1: 2 columns without titles of which the first is no column of times '// &
         & 'at equal steps of at most 0.25 s ('

      call suite('two columns')
      call check_file('comma.csv', 'time,acc'//lf//'0,0'//lf//'0.01,0.1'//lf//'0.02,-0.25'//lf//'0.03,1e-3'//lf// &
         & '0.04,0.05', .true.)
      call check_file('blank.txt', ' 0.00 0'//lf//' 0.01   0.1'//lf//'.02 -.25 '//lf//'.03 1e-3'//lf//'4e-2 0.05'// &
         & lf, .true.)
      call check_file('tab.txt', '1.00'//tab//'0'//lf//'1.01'//tab//'0.1'//lf//'1.02'//tab//'-.25'//lf//'1.03'// &
         & tab// &
         & '1e-3'//lf//'1.04'//tab//' 0.05', .true.)
      call check_file('semicolon.txt', '# t; a'//cr//lf//'0; 0'//cr//lf//'.01;.1'//cr//lf//'.02;-.25'//cr//lf// &
         & '.03;.001'//cr//lf//'.04;5e-2', &
         & .true.)
      call check_bad_file('0,0'//lf//'0.01,1'//lf//'0.03,1'//lf//'0.04,1'//lf, no_times//'line 3: time 0.03 after 0.01: ')
      call check_bad_file('0,0'//lf//'0.01,1'//lf//'0.02,1'//lf//'0.04,1'//lf, no_times//'line 4: time 0.04 after 0.02: ')
      call check_bad_file('0,0'//lf//'0.01,1'//lf//'0.02,1'//lf//'0.02,1'//lf//'.03,1', &
         & no_times//'line 4: time 0.02 after 0.02: times must be equally spaced')
      call check_bad_file('0,0'//lf//'0.01,1'//lf//'0.005,1'//lf, &
         & no_times//'line 3: time 0.005 after 0.01: times must increase')
      call check_bad_file('0 1 2 3'//lf//'0 1 2 3'//lf, ': line 1: 4 columns without titles of accelerations')
      call check_bad_file('1. 0'//lf//'1. 1'//lf//'1. 2'//lf, no_times//'line 2: all times are 1')
      call check_bad_file('0,0'//lf//'0.01,1'//lf//'0.02'//lf, ': line 3: 1 values: must be 2 as in line 1')
      call check_bad_file('0,0'//lf//'0.01,1'//lf//'0.02,1,1'//lf, ': line 3: 3 values: must be 2')
      call check_bad_file('0,0'//lf//'0.01,1'//lf//'0.02,1.x'//lf, ': line 3: value ''1.x'': must be a number')
      call check_bad_file('0,0'//lf//'0.01,1'//lf//'nan,1'//lf, ': line 3: value ''nan'': must be a number')
      call check_bad_file('t,a'//lf//'0,1'//lf, ': line 2: 1 sample: a record needs at least two')
      ! Decimal commas, where they can be nothing else, and rows of empty cells
      call check_file('commas.txt', 't; a'//cr//lf//'0;0'//cr//lf//'0,01;0,1'//cr//lf//'0,02;-0,25'//cr//lf// &
         & '0,03;0,001'//cr//lf//'0,04;0,05'//cr//lf//';'//cr//lf, .true.)
      call check_file('commas_tab.txt', '0,00'//tab//'0,0'//lf//'0,01'//tab//'0,1'//lf//'0,02'//tab//'-0,25'//lf// &
         & '0,03'//tab//'0,001'//lf//'0,04'//tab//'0,05'//lf, .true.)
      call check_bad_file('0;0'//lf//'0,01;1.5'//lf//'0,02;2'//lf, ': line 2: value ''0,01'': must be a number')
      call check_bad_file('0,5'//lf//'0,25'//lf//'-0,5'//lf, ': line 1: columns separated by commas need decimal points')
   end subroutine test_two_columns

   !> Times as programs print them: rounded steps of 1/256 s, 5 digits beyond 100 s, single precision
   subroutine test_steps()
      call suite('steps')
      call check_times('(f0.3)', 1.0_wp/256.0_wp, 4000, 0)
      call check_times('(f0.6)', 1.0_wp/256.0_wp, 4000, 0)
      call check_times('(es12.5)', 0.02_wp, 3000, 0)
      call check_times('5 digits', 0.005_wp, 30000, 0)
      call check_times('single', 0.02_wp, 9000, 0)
      call check_times('(f0.2)', 0.01_wp, 5000, 0)
      call check_times('(f0.3)', 1.0_wp/256.0_wp, 4000, 2000)
      call check_times('(f0.2)', 0.01_wp, 5000, 4900)
      call check_times('(f0.2)', 0.01_wp, 5000, 1)
      call check_times('5 digits', 0.005_wp, 30000, 5000)
      call check_times('single', 0.02_wp, 9000, 8998)
      ! Decimals that resolve no step: the one that is given, if it fits all times
      call check_times('(f0.2)', 0.005_wp, 8000, 0)
      call check_times('(f0.2)', 0.005_wp, 8000, 0, given=0.005_wp)
      call check_times('(f0.2)', 0.005_wp, 8000, 0, given=0.00501_wp)
      call check_times('(f0.2)', 0.005_wp, 8000, 0, given=0.01_wp)
      call check_times('(f0.2)', 1.0_wp/256.0_wp, 5000, 0, given=1.0_wp/256.0_wp)
      call check_times('(f0.2)', 0.005_wp, 8000, 3000, given=0.005_wp, omitted=2)
      call check_times('(f0.1)', 0.005_wp, 8000, 0, given=0.005_wp)
      call check_times('(f0.3)', 1.0_wp/256.0_wp, 4000, 0, given=1.0_wp/256.0_wp)
   end subroutine test_steps

   !> A file of times; samples may be missing, one or as many as are omitted, and a step may be given
   subroutine check_times(layout, dt, count, missing, given, omitted)
      character(len=*), intent(in) :: layout
      real(wp), intent(in) :: dt
      integer, intent(in) :: count, missing
      real(wp), intent(in), optional :: given
      integer, intent(in), optional :: omitted
      type(record_type) :: record
      type(error_type), allocatable :: error
      character(len=:), allocatable :: note
      character(len=40) :: line
      real(wp) :: time
      integer :: unit, i, last
      logical :: is_resolved, is_right

      last = missing
      if (present(omitted)) last = missing + omitted - 1

      open (newunit=unit, file=scratch//'/times.txt', action='write', status='replace')
      do i = 0, count - 1
         if (missing > 0 .and. i >= missing .and. i <= last) cycle
         time = i*dt
         select case (layout)
         case ('5 digits')
            write (line, '(f0.'//to_text(merge(2, merge(3, 4, time >= 10.0_wp), time >= 100.0_wp))//')') time
         case ('single')
            write (line, '(f0.5)') real(time)
         case default
            write (line, layout) time
         end select
         write (unit, '(a)') trim(adjustl(line))//',0.5'
      end do
      close (unit)
      is_resolved = .not. (layout == '(f0.1)' .or. layout == '(f0.2)' .and. dt < 0.01_wp)
      is_right = missing == 0 .and. is_resolved
      if (present(given)) then
         call read_record(scratch//'/times.txt', record, error, dt=given, units='g')
         if (missing == 0 .and. layout == '(f0.2)') is_right = abs(given - dt) <= 0.0_wp
         note = record%metadata%get('reading')
         call check((index(note, 'coarser than the step') > 0) .eqv. (is_right .and. .not. is_resolved), &
            & 'note of coarse times, '//layout)
      else
         call read_record(scratch//'/times.txt', record, error, units='g')
      end if
      if (.not. is_right) then
         call check_error(error, 'must be equally spaced', layout//', '//to_text(count)//' lines, one missing')
      else
         call check_ok(error, layout//', '//to_text(count)//' lines')
         call check_close(record%dt, dt, 1.0e-3_wp, 'dt, '//layout)
      end if
   end subroutine check_times

   !> PEER files
   subroutine test_peer()
      character(len=*), parameter :: top = 'PEER NGA STRONG MOTION DATABASE RECORD'//lf// &
         & 'Somewhere, 1/2/1990, Town, Hall, 67'//lf
      character(len=*), parameter :: quantity = 'ACCELERATION TIME SERIES IN UNITS OF G'//lf
      character(len=*), parameter :: values = '   .0000000E+00   .1000000E+00  -.2500000E+00'//lf// &
         & '   .1000000E-02   .5000000E-01  '//lf

      call suite('PEER')
      call check_stated('new.AT2', top//quantity//'NPTS=      5, DT=   .0100 SEC,      '//lf//values, 9.80665_wp)
      call check_stated('text.AT2', top//quantity//'NPTS=  5, DT=  .0100 SEC  rotated 30 deg'//lf//values//lf, &
         & 9.80665_wp)
      call check_stated('short.AT2', top//quantity//'NPTS=5,DT=0.01SEC'//cr//lf//values, 9.80665_wp)
      call check_stated('old.AT2', 'PEER STRONG MOTION DATABASE RECORD. PROCESSED'//lf//'SOMEWHERE'//lf// &
         & 'ACCELERATION TIME HISTORY IN UNITS OF G. FILTER POINTS: HP=0.2 Hz  LP=25.0 Hz'//lf// &
         & '     5    .0100    NPTS, DT'//lf//values, &
         & 9.80665_wp)
      call check_bad_stated(top//'VELOCITY TIME SERIES IN UNITS OF CM/S'//lf//'NPTS=  5, DT=  .01 SEC'//lf//values, &
         & ': line 3: ''VELOCITY TIME SERIES IN UNITS OF CM/S'': must be ACCELERATION')
      call check_bad_stated(top//'DISPLACEMENT TIME SERIES IN UNITS OF CM'//lf//'NPTS=  5, DT=  .01 SEC'//lf// &
         & values, ': line 3: ')
      call check_bad_stated(top//'ACCELERATION TIME SERIES IN UNITS OF FURLONGS'//lf//'NPTS=  5, DT=  .01 SEC'// &
         & lf//values, &
         & ': units = ''furlongs'': must be one of')
      call check_bad_stated(top//quantity//'NPTS=  6, DT=  .01 SEC'//lf//values, &
         & ': line 6: the file ends after 5 values: the header states 6')
      call check_bad_stated(top//quantity//'NPTS=  2, DT=  .01 SEC'//lf//values, ': line 6: more values than the 2')
      call check_bad_stated(top//quantity//'NPTS=  5, DT=  0.0 SEC'//lf//values, ': line 4: ')
      call check_bad_stated(top//quantity//'NPTS=  5, DT=  -.01 SEC'//lf//values, ': line 4: ')
      call check_bad_stated(top//quantity//'NPTS=  5, DT= ****** SEC'//lf//values, ': line 4: ')
      call check_bad_stated(top//quantity//'NPTS=  -5, DT= .01 SEC'//lf//values, ': line 4: ')
      call check_bad_stated(top//quantity//'NPTS=  , DT= .01 SEC'//lf//values, ': line 4: ')
      call check_bad_stated(top//quantity//'NPTS=  2000000000, DT= .01 SEC'//lf//values, &
         & ': line 6: the file ends after 5')
      call check_bad_stated(top//quantity//'NPTS=  5, DT=  .01 SEC'//lf//'.1 .2 NaN .3 .4', &
         & ': line 5: value 3 = ''NaN'': must be a number')
      call check_bad_stated(top//quantity//'NPTS=  3, DT=  .01 SEC'//lf//'.1 .2'//lf//'.3-.4', &
         & ': line 6: value 3 = ''.3-.4''')
      call check_bad_stated(top//quantity//'NPTS=  1, DT=  .01 SEC'//lf//'.1', &
         & ': number of samples = 1: must be at least 2')
      call check_bad_stated(top//quantity//'NPTS=  1, DT=  .01 SEC', ': line 4: the file ends after 0 values')
   end subroutine test_peer

   !> DYNA files
   subroutine test_dyna()
      character(len=*), parameter :: values = '0.000000'//lf//'0.100000'//lf//'-0.250000'//lf//'0.001000'//lf// &
         & '0.050000'//lf
      character(len=*), parameter :: step = 'SAMPLING_INTERVAL_S: 0.010000', count = 'NDATA: 5', &
         & units = 'UNITS: cm/s^2', &
         & kind = 'DATA_TYPE: ACCELERATION', peak = 'PGA_CM/S^2: -0.250000'

      call suite('DYNA')
      call check_stated('IT.ARL..HGE.D.C.ACC.ASC', dyna(step, count, units, peak, kind)//values, 0.01_wp)
      call check_stated('unprocessed.dat', dyna(step, count, units, peak, 'DATA_TYPE: UNPROCESSED ACCELERATION')// &
         & values, 0.01_wp)
      call check_stated('no_peak.asc', dyna(step, count, units, 'PGA_CM/S^2: ', 'DATA_TYPE: Acceleration')// &
         & values, 0.01_wp)
      call check_stated('metres.asc', dyna(step, count, 'UNITS: m/s^2', 'PGA_CM/S^2: 25.1', kind)//values, 1.0_wp)
      call check_bad_stated(dyna(step, count, 'UNITS: cm/s', 'PGV_CM/S: 0.25', 'DATA_TYPE: VELOCITY')//values, &
         & ': line 7: DATA_TYPE = ''VELOCITY'': must be ACCELERATION')
      call check_bad_stated(dyna(step, count, units, peak, 'DATA_TYPE: ACCELERATION RESPONSE SPECTRUM')//values, &
         & ': line 7: DATA_TYPE')
      call check_bad_stated(dyna(step, count, units, peak, 'NOTHING: 1')//values, ': line 1: DATA_TYPE = '''': must be')
      call check_bad_stated(dyna('SAMPLING_INTERVAL_S: ', count, units, peak, kind)//values, &
         & ': line 3: SAMPLING_INTERVAL_S = '''': must be a positive number')
      call check_bad_stated(dyna('SAMPLING_INTERVAL_S: 0.0', count, units, peak, kind)//values, &
         & ': line 3: SAMPLING_INTERVAL_S = ''0.0'': must be a positive number')
      call check_bad_stated(dyna(step, 'NDATA: 5.5', units, peak, kind)//values, &
         & ': line 4: NDATA = ''5.5'': must be a positive integer')
      call check_bad_stated(dyna(step, 'NDATA: many', units, peak, kind)//values, ': line 4: NDATA = ''many''')
      call check_bad_stated(dyna(step, 'NDATA: 6', units, peak, kind)//values, &
         & ': line 13: the file ends after 5 values: the header states 6')
      call check_bad_stated(dyna(step, 'NDATA: 2', units, peak, kind)//values, ': line 13: more values than the 2')
      call check_bad_stated(dyna(step, count, units, 'PGA_CM/S^2: 0.26', kind)//values, &
         & ': line 6: peak value 0.26: the largest value is 0.25')
      call check_bad_stated(dyna(step, count, 'UNITS: cm/s', peak, kind)//values, &
         & ': units = ''cm/s'': must be one of')
      call check_bad_stated(dyna(step, count, 'UNITS: ', peak, kind)//values, ': the file does not state its units')
      call check_bad_stated(dyna(step, count, units, peak, kind)//'0.1'//lf//'nan'//lf, &
         & ': line 10: value 2 = ''nan''')
   end subroutine test_dyna

   !> A header of eight lines
   function dyna(step, count, units, peak, kind) result(header)
      character(len=*), intent(in) :: step, count, units, peak, kind
      character(len=:), allocatable :: header

      header = 'EVENT_NAME: TEST'//lf//'STATION_NAME: '//lf//step//lf//count//lf//units//lf//peak//lf//kind//lf// &
         & 'ORIGINAL_DATA_MEDIATOR_CITATION: : x'//lf
   end function dyna

   !> What is given beside the file
   subroutine test_given()
      type(record_type) :: record
      type(error_type), allocatable :: error
      character(len=*), parameter :: two = scratch//'/two.txt', one = scratch//'/one.txt'
      real(wp) :: nan

      call suite('given')
      call write_file('one.txt', '1'//lf//'2'//lf//'3'//lf)
      call write_file('two.txt', '0 1'//lf//'.01 2'//lf//'.02 3'//lf)
      call write_file('peer.txt', 'PEER'//lf//lf//'ACCELERATION TIME SERIES IN UNITS OF G'//lf// &
         & 'NPTS= 2, DT= .01 SEC'//lf//'.1 .2')
      call read_record(one, record, error, units='g')
      call check_error(error, one//': the file does not state its time step: dt must be given', 'no dt')
      call read_record(one, record, error, dt=0.01_wp)
      call check_error(error, one//': the file does not state its units: units must be given', 'no units')
      call read_record(one, record, error, dt=0.01_wp, units=' ')
      call check_error(error, 'units must be given', 'empty units')
      call read_record(one, record, error, dt=0.01_wp, units='furlong')
      call check_error(error, one//': units = ''furlong'': must be one of', 'unknown units')
      call read_record(one, record, error, dt=0.0_wp, units='g')
      call check_error(error, one//': dt = 0: must be positive', 'dt = 0')
      call read_record(one, record, error, dt=-0.01_wp, units='g')
      call check_error(error, 'must be positive', 'dt < 0')
      nan = 0.0_wp
      nan = sqrt(nan - 1.0_wp)
      call read_record(one, record, error, dt=nan, units='g')
      call check_error(error, 'dt = NaN: must be positive', 'dt = NaN')
      call read_record(one, record, error, dt=0.01_wp, units='gal')
      call check_ok(error, 'all given')
      call check_close(record%acceleration(3), 0.03_wp, 1.0e-15_wp, 'gal')
      call read_record(two, record, error, dt=0.01005_wp, units='mm/s2')
      call check_ok(error, 'dt that agrees')
      call check_close(record%dt, 0.01005_wp, 0.0_wp, 'the given dt is used within the rounding of the times')
      call read_record(two, record, error, dt=0.02_wp, units='mm/s2')
      call check_error(error, two//': dt = 0.02: the times in the file are 0.01 s apart', 'dt that disagrees')
      call write_file('fine.txt', '0.000000 1'//lf//'0.010000 2'//lf//'0.020000 3'//lf)
      call read_record(scratch//'/fine.txt', record, error, dt=0.01005_wp, units='mm/s2')
      call check_ok(error, 'dt that nearly agrees with times of many digits')
      call check_close(record%dt, 0.01_wp, 0.0_wp, 'the file''s dt is used')
      call read_record(scratch//'/peer.txt', record, error, units='G')
      call check_ok(error, 'units that agree')
      call read_record(scratch//'/peer.txt', record, error, units='m/s2')
      call check_error(error, 'peer.txt: units = ''m/s2'': the file states ''g''', 'units that disagree')
   end subroutine test_given

   !> Contents of no known format
   subroutine test_unknown()
      call suite('unknown')
      call check_bad_file('0 1 2 3'//lf//'1'//lf//'1 2'//lf, ': line 1: ''0 1 2 3'' above lines of one value, '// &
         & 'but not their number and step: a row')
      call check_bad_file('words'//lf//'and more'//lf//'words'//lf, ': the format is not known')
      call check_bad_file('# remark'//lf, ': the format is not known')
      call check_bad_file('', ': the file is empty')
      call check_bad_file(achar(1)//achar(2)//lf//achar(255), ': the format is not known')
      call check_bad_file(achar(0)//achar(1)//achar(2)//lf//achar(255), ': line 1: byte 1 is NUL: this is not a text file')
   end subroutine test_unknown

   !> Catalogues
   subroutine test_catalogue()
      type(record_type), allocatable :: records(:)
      type(record_rows_type) :: rows
      type(error_type), allocatable :: error

      call suite('catalogue')
      call write_file('folder/sub/a.txt', '1'//lf//'2'//lf)
      call write_file('folder/b.txt', '0 1'//lf//'.01 3'//lf)
      call write_file('folder/bad.txt', '1'//lf//'2'//lf//'x'//lf)
      call write_file('folder/c.AT2', 'PEER'//lf//lf//'ACCELERATION TIME SERIES IN UNITS OF G'//lf// &
         & 'NPTS= 2, DT= .01 SEC'//lf//'.1 .2')
      call write_file('folder/good.csv', '# remark'//lf//'station,file,units,dt_s'//lf//'"A, B",sub/a.txt,g,0.02'// &
         & lf// &
         & 'C,"b.txt",gal,'//lf//',c.AT2,,'//lf)
      call read_catalogue(scratch//'/folder/good.csv', records, error)
      call check_ok(error, 'read')
      if (allocated(error)) return
      call check(size(records) == 3, 'three records')
      call check_text(records(1)%name, 'a', 'name 1')
      call check_text(records(3)%name, 'c', 'name 3')
      call check_close(records(1)%dt, 0.02_wp, 0.0_wp, 'dt 1')
      call check_close(records(2)%dt, 0.01_wp, 1.0e-15_wp, 'dt 2')
      call check_close(records(1)%pga(), 2*9.80665_wp, 1.0e-15_wp, 'PGA 1')
      call check_close(records(2)%pga(), 0.03_wp, 1.0e-15_wp, 'PGA 2')
      call check_close(records(3)%pga(), 0.2_wp*9.80665_wp, 1.0e-15_wp, 'PGA 3')
      call check_catalogue('file'//lf//'c.AT2'//lf, '')
      call check_catalogue('file,dt_s,units'//lf//'sub/a.txt,.01,g'//lf//'bad.txt,.01,g'//lf, &
         & 'bad.csv: line 3: '//scratch//'/folder/bad.txt: line 3: value ''x'': must be a number')
      ! The first that is wrong, for any number of threads, be it a file or a row
      call check_first_wrong()
      call check_catalogue('file,dt_s,units'//lf//'sub/a.txt,"0,01",g'//lf, &
         & 'bad.csv: line 2: dt_s = ''0,01'': must be a number')
      call check_catalogue('file;dt_s;units'//lf//'sub/a.txt;0,010;g'//lf//';;'//lf, '')
      call check_catalogue('file,dt_s,units'//lf//'sub\a.txt,.01,g'//lf, 'bad.csv: line 2: '//scratch// &
         & '/folder/sub\a.txt: no such file: folders must be separated by /, not \')
      call check_catalogue('file,dt_s,units'//lf//'sub/a.txt,0,g'//lf, 'a.txt: dt = 0: must be positive')
      call check_catalogue('file,dt_s,units'//lf//'sub/a.txt,,g'//lf, 'a.txt: the file does not state its time step')
      call check_catalogue('file,dt_s,units'//lf//'sub/a.txt,.01,'//lf, 'a.txt: the file does not state its units')
      call check_catalogue('file,dt_s,units'//lf//'sub/a.txt,.01,g'//lf//'sub/a.txt,.01,g'//lf, &
         & 'bad.csv: line 3: record ''sub/a.txt'' is a duplicate')
      call check_catalogue('file,dt_s,units,name'//lf//'sub/a.txt,.01,g,x'//lf//'b.txt,,g,x'//lf, &
         & 'bad.csv: line 3: record ''x'' is a duplicate')
      call write_file('folder/a.txt', '1'//lf//'2'//lf)
      call write_file('folder/a.NS', '1'//lf//'2'//lf)
      call write_file('folder/names.csv', 'file,dt_s,units,name'//lf//'sub/a.txt,.01,g,'//lf//'a.txt,.01,g,'//lf// &
         & 'a.NS,.01,g,'//lf//'a.txt,.02,g,other'//lf//'b.txt,,g,'//lf)
      call read_catalogue(scratch//'/folder/names.csv', records, error)
      call check_ok(error, 'names')
      if (allocated(error)) return
      call check_text(records(1)%name, 'sub/a.txt', 'folder')
      call check_text(records(2)%name, 'a.txt', 'no folder')
      call check_text(records(3)%name, 'a.NS', 'extension')
      call check_text(records(4)%name, 'other', 'given')
      call check_text(records(5)%name, 'b', 'stem')
      call write_file('folder/levels.csv', 'file,dt_s,units,level,factor,event'//lf//'b.txt,,g,0.2,,Friuli'//lf// &
         & 'a.txt,.01,g,0.2,1.5,'//lf//'b.txt,,g,0.4,3,Friuli'//lf//'a.NS,.01,g,,,'//lf)
      call read_catalogue(scratch//'/folder/levels.csv', records, error, rows=rows)
      call check_ok(error, 'levels')
      if (allocated(error)) return
      call check(size(records) == 3, 'a record with two rows is read once')
      call check(rows%have_levels .and. all(rows%record == [1, 2, 1, 3]), 'record of each row')
      call check_close(maxval(abs(rows%level - [0.2_wp, 0.2_wp, 0.4_wp, 0.0_wp])), 0.0_wp, 0.0_wp, 'levels of rows')
      call check_close(maxval(abs(rows%factor - [0.0_wp, 1.5_wp, 3.0_wp, 0.0_wp])), 0.0_wp, 0.0_wp, 'factors of rows')
      call check_text(records(1)%metadata%get('event'), 'Friuli', 'other columns are metadata')
      call check_catalogue('file,dt_s,units,level'//lf//'a.txt,.01,g,0'//lf, 'line 2: level = 0: must be positive')
      call check_catalogue('file,dt_s,units,level,factor'//lf//'a.txt,.01,g,1,-2'//lf, &
         & 'line 2: factor = -2: must be positive')
      call check_catalogue('file,dt_s,units,factor'//lf//'a.txt,.01,g,2'//lf, &
         & 'line 2: factor = 2: needs the level at which it applies')
      call check_catalogue('file,dt_s,units'//lf//'none.txt,.01,g'//lf, 'line 2: '//scratch// &
         & '/folder/none.txt: no such file')
      call check_catalogue('file,dt_s,units'//lf//'sub,.01,g'//lf, 'line 2: '//scratch//'/folder/sub: ')
      call check_catalogue('file,dt_s,units'//lf//',.01,g'//lf, 'line 2: file is empty')
      call check_catalogue('file,dt_s,units'//lf, 'bad.csv: no records')
      call check_catalogue('dt_s,units'//lf//'1,g'//lf, 'bad.csv: no column ''file''')
      call read_catalogue(scratch//'/none.csv', records, error)
      call check_error(error, 'none.csv: no such file', 'missing catalogue')
   end subroutine test_catalogue

   !> Of several wrong files and rows the first is reported, whichever thread finds one first
   subroutine check_first_wrong()
      character(len=*), parameter :: good = 'sub/a.txt,.01,g'//lf, bad = 'bad.txt,.01,g'//lf
      type(record_type), allocatable :: records(:)
      type(error_type), allocatable :: error
      integer :: threads, i

      do threads = 1, 4
         do i = 1, 20
            call write_file('folder/bad.csv', 'file,dt_s,units'//lf//good//repeat(bad, 40)//'sub/a.txt,x,g'//lf)
            call read_catalogue(scratch//'/folder/bad.csv', records, error, threads=threads)
            call check_error(error, 'bad.csv: line 3: '//scratch//'/folder/bad.txt: line 3: value ''x''', 'wrong files')
            call write_file('folder/bad.csv', 'file,dt_s,units'//lf//good//'sub/a.txt,x,g'//lf//repeat(bad, 40))
            call read_catalogue(scratch//'/folder/bad.csv', records, error, threads=threads)
            call check_error(error, 'bad.csv: line 3: dt_s = ''x'': must be a number', 'a wrong row')
         end do
      end do
   end subroutine check_first_wrong

   !> A catalogue with an error, or none
   subroutine check_catalogue(content, part)
      character(len=*), intent(in) :: content, part
      type(record_type), allocatable :: records(:)
      type(error_type), allocatable :: error

      call write_file('folder/bad.csv', content)
      call read_catalogue(scratch//'/folder/bad.csv', records, error)
      if (part == '') then
         call check_ok(error, 'catalogue '//content)
      else
         call check_error(error, part, 'catalogue '//content)
      end if
   end subroutine check_catalogue

   !> Recorded accelerograms, where there are any: peaks and steps as in their manifest, and the catalogue italy44
   subroutine test_samples()
      type(csv_table_type) :: table
      type(csv_row_type) :: row
      type(record_type), allocatable :: records(:), again(:)
      type(record_type) :: record
      type(error_type), allocatable :: error
      character(len=:), allocatable :: folder, file
      real(wp) :: pga, dt
      integer :: i, length, tested
      logical :: found
      logical :: exists

      call suite('samples')
      call get_environment_variable('DONDOLO_RECORDS', length=length)
      allocate (character(len=length) :: folder)
      if (length > 0) call get_environment_variable('DONDOLO_RECORDS', folder)
      inquire (file=folder//'/manifest.csv', exist=exists)
      if (.not. exists) then
         call skip('no recorded accelerograms: DONDOLO_RECORDS names their folder')
         return
      end if
      call table%read(folder//'/manifest.csv', error)
      call check_ok(error, 'manifest')
      if (allocated(error)) return
      tested = 0
      do
         call table%next(row, found, error)
         call check_ok(error, 'row')
         if (.not. found) exit
         file = row%get_text(table%column('file'))
         if (.not. is_read(file)) cycle
         tested = tested + 1
         call table%get_real(row, table%column('dt_s'), dt, error)
         call check_ok(error, 'dt of '//file)
         if (index(file, '.VEL.') > 0) then
            call read_record(folder//'/'//file, record, error)
            call check_error(error, 'DATA_TYPE = ''VELOCITY'': must be ACCELERATION', file)
            cycle
         end if
         if (index(file, 'dyna') > 0 .or. index(file, 'itaca_v1') > 0 .or. index(file, 'peer') > 0) then
            call read_record(folder//'/'//file, record, error)
         else if (index(file, 'full') > 0 .or. index(file, '1.txt') > 0 .or. index(file, '/2.txt') > 0) then
            call read_record(folder//'/'//file, record, error, dt=dt, units='g')
         else
            call read_record(folder//'/'//file, record, error, dt=dt, units='m/s2')
         end if
         call check_ok(error, file)
         if (allocated(error)) cycle
         call check_close(record%dt, dt, 1.0e-6_wp, 'dt of '//file)
         if (len(row%get_text(table%column('pga_m_s2'))) == 0) cycle
         call table%get_real(row, table%column('pga_m_s2'), pga, error)
         call check_close(record%pga(), pga, 1.0e-3_wp, 'PGA of '//file)
      end do
      call check(tested >= 97, to_text(tested)//' files tested')
      call read_catalogue(folder//'/italy44.csv', records, error)
      call check_ok(error, 'italy44')
      call read_catalogue(folder//'/italy44.csv', again, error, threads=3)
      call check_ok(error, 'italy44 on three threads')
      if (allocated(error)) return
      call check(all([(all(abs(again(i)%acceleration - records(i)%acceleration) <= 0.0_wp) .and. &
         & again(i)%name == records(i)%name, i=1, size(records))]), 'the same records on three threads')
      if (allocated(error)) return
      call check(size(records) == 44, '44 records')
      call table%read(folder//'/italy44.csv', error)
      row = csv_row_type()
      do i = 1, size(records)
         call table%next(row, found, error)
         call check(found, 'as many rows')
         call table%get_real(row, table%column('pga_m_s2'), pga, error)
         call check_close(records(i)%pga(), pga, 1.0e-3_wp, 'PGA of '//records(i)%name)
      end do
   end subroutine test_samples

   !> Is a sample in a format that is read?
   function is_read(file)
      character(len=*), intent(in) :: file
      logical :: is_read
      character(len=*), parameter :: folders(*) = [character(len=24) :: 'italy/', 'elcentro/', 'formats/peer_at2/', &
         & 'formats/esm_dyna12/', 'formats/itaca_dyna10/', 'formats/itaca_v1/', 'formats/one_column/', &
         & 'formats/two_column_csv/']
      integer :: i

      is_read = any([(index(file, trim(folders(i))) == 1, i=1, size(folders))])
   end function is_read

   !> A file with the small values in columns
   subroutine check_file(file, content, timed)
      character(len=*), intent(in) :: file, content
      logical, intent(in), optional :: timed
      type(record_type) :: record
      type(error_type), allocatable :: error

      call write_file(file, content)
      if (present(timed)) then
         call read_record(scratch//'/'//file, record, error, units='m/s2')
      else
         call read_record(scratch//'/'//file, record, error, dt=0.01_wp, units='m/s2')
      end if
      call check_small(record, error, file, 1.0_wp)
   end subroutine check_file

   !> A file with the small values that states its step and units
   subroutine check_stated(file, content, factor)
      character(len=*), intent(in) :: file, content
      real(wp), intent(in) :: factor
      type(record_type) :: record
      type(error_type), allocatable :: error

      call write_file(file, content)
      call read_record(scratch//'/'//file, record, error)
      call check_small(record, error, file, factor)
   end subroutine check_stated

   !> The small values were read
   subroutine check_small(record, error, file, factor)
      type(record_type), intent(in) :: record
      type(error_type), allocatable, intent(in) :: error
      character(len=*), intent(in) :: file
      real(wp), intent(in) :: factor
      integer :: i, point

      call check_ok(error, file)
      if (allocated(error)) return
      call check(size(record%acceleration) == size(small), file//': five values')
      if (size(record%acceleration) /= size(small)) return
      do i = 1, size(small)
         call check_close(record%acceleration(i), factor*small(i), 1.0e-14_wp, file//': value '//to_text(i))
      end do
      call check_close(record%dt, 0.01_wp, 1.0e-12_wp, file//': dt')
      point = index(file, '.', back=.true.)
      if (point == 0) point = len(file) + 1
      call check_text(record%name, file(:point - 1), 'name of '//file)
   end subroutine check_small

   !> A file in columns with an error
   subroutine check_bad_file(content, part)
      character(len=*), intent(in) :: content, part
      type(record_type) :: record
      type(error_type), allocatable :: error

      call write_file('bad.txt', content)
      if (index(content, ',') + index(content, ' ') + index(content, ';') > 0) then
         call read_record(scratch//'/bad.txt', record, error, units='m/s2')
      else
         call read_record(scratch//'/bad.txt', record, error, dt=0.01_wp, units='m/s2')
      end if
      call check_error(error, scratch//'/bad.txt'//part, 'file '//content)
   end subroutine check_bad_file

   !> A file with a header and an error
   subroutine check_bad_stated(content, part)
      character(len=*), intent(in) :: content, part
      type(record_type) :: record
      type(error_type), allocatable :: error

      call write_file('bad.txt', content)
      call read_record(scratch//'/bad.txt', record, error)
      call check_error(error, scratch//'/bad.txt'//part, 'file '//content)
   end subroutine check_bad_stated

   !> Records that belong together
   subroutine test_clusters()
      type(record_type) :: records(8)
      type(lines_type) :: labels
      integer :: clusters(8), i

      call suite('clusters')
      do i = 1, 8
         records(i)%dt = 0.01_wp
         records(i)%acceleration = small
      end do
      call records(2)%metadata%set('event', 'A')
      records(3)%acceleration(5) = 0.06_wp
      records(4)%dt = 0.02_wp
      records(5)%vertical = small
      records(6)%acceleration = small(:4)
      call records(7)%metadata%set('event', 'A')
      ! The last is the same motion as the first, and neither has an event.
      call cluster_records(records, clusters, labels)
      call check(all(clusters == [1, 2, 3, 4, 5, 6, 2, 1]), 'one event, and one motion, are one cluster')
      records(8)%vertical = small
      call cluster_records(records, clusters, labels)
      call check(clusters(8) == 5, 'the same motion with the same vertical component')
      records(8)%vertical(1) = 0.01_wp
      call cluster_records(records, clusters, labels)
      call check(clusters(8) == 7, 'another vertical component')
   end subroutine test_clusters

   !> Write a small file, byte by byte
   subroutine write_file(file, content)
      character(len=*), intent(in) :: file, content
      integer :: unit

      open (newunit=unit, file=scratch//'/'//file, access='stream', form='unformatted', action='write', &
         & status='replace')
      write (unit) content
      close (unit)
   end subroutine write_file

end program test_record
