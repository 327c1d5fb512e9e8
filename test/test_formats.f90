!> Formats of accelerogram files: channels, metadata, what is refused.
program test_formats
   use checks, only : check, check_close, check_error, check_ok, check_text, finish, skip, suite
   use dondolo_base_error, only : error_type
   use dondolo_base_kinds, only : pi, wp
   use dondolo_base_limits, only : longest_case
   use dondolo_base_lines, only : lines_type
   use dondolo_base_numbers, only : parse_printed
   use dondolo_base_text, only : to_text
   use dondolo_files_csv_reader, only : csv_row_type, csv_table_type
   use dondolo_files_text_file, only : read_text_file, text_file_type
   use dondolo_record, only : new_record, record_type
   use dondolo_record_metadata, only : metadata_type
   use dondolo_records_catalogue, only : read_catalogue
   use dondolo_records_dates, only : find_moment, make_stamp
   use dondolo_records_reading_notes, only : list_reading_notes
   use dondolo_records_format, only : block_type, read_fixed
   use dondolo_records_record_reader, only : read_record, read_records
   use dondolo_records_record_table, only : find_problems, record_table
   use small_files, only : afad_content, asa_content, columns_content, cwa_content, dyna_content, eqsig_content, knet_content, &
      & nied_content, peer_content, small, smtk_content, write_file
   implicit none

   character(len=*), parameter :: scratch = 'build/test_formats'
   character(len=*), parameter :: cr = achar(13), lf = achar(10)
   !> Gal [m/s2]
   real(wp), parameter :: gal = 0.01_wp

   call execute_command_line('mkdir -p '//scratch)
   call test_metadata()
   call test_dates()
   call test_fixed()
   call test_columns()
   call test_titles()
   call test_duration()
   call test_dyna()
   call test_peer()
   call test_smtk()
   call test_knet()
   call test_cwa()
   call test_asa()
   call test_eqsig()
   call test_afad()
   call test_nied()
   call test_cut()
   call test_touching()
   call test_step()
   call test_notes()
   call test_catalogue()
   call test_table()
   call test_samples()
   call finish()

contains

   !> Keys and values
   subroutine test_metadata()
      type(metadata_type) :: metadata, other

      call suite('metadata')
      call check(metadata%count() == 0, 'empty')
      call check_text(metadata%get('event'), '', 'no such key')
      call metadata%set('Event', ' Friuli ')
      call metadata%set('VS30', '700')
      call metadata%set('empty', ' '//achar(9))
      call check(metadata%count() == 2, 'two entries')
      call check_text(metadata%entries(1)%key, 'event', 'a common key is in lower case')
      call check_text(metadata%entries(2)%key, 'VS30', 'another key is as it was')
      call check_text(metadata%get('EVENT'), 'Friuli', 'case of a key does not matter')
      call other%set('vs30', '800')
      call other%set('station', 'TLM')
      call metadata%include(other)
      call check(metadata%count() == 3, 'three entries')
      call check_text(metadata%get('VS30'), '800', 'the later value stands')
      call check_text(metadata%entries(3)%value, 'TLM', 'a new one comes last')
   end subroutine test_metadata

   !> Dates and times
   subroutine test_dates()
      call suite('dates')
      call check_moment('19971014', 'dmy', '1997-10-14')
      call check_moment('2010/11/14', '', '2010-11-14')
      call check_moment(' 14/11/2010 ', 'dmy', '2010-11-14')
      call check_moment('14/11/2010', '', '2010-11-14')
      call check_moment('1/2/1990', 'mdy', '1990-01-02')
      call check_moment('2009-04-06', 'mdy', '2009-04-06')
      call check_moment('28-AUG-2018', '', '2018-08-28')
      call check_moment('Sept. 4, 2010 at noon', '', '2010-09-04')
      call check_moment('19971014 152309', 'dmy', '1997-10-14T15:23:09')
      call check_moment('1997/10/14 152309.25', 'dmy', '1997-10-14T15:23:09.25')
      call check_moment('1997-10-14T15:23:09.2Z', '', '1997-10-14T15:23:09.2Z')
      call check_moment('2018/02/06-23:50:42+08:00', '', '2018-02-06T23:50:42+08:00')
      call check_moment('1989 10 18 0004', '', '1989-10-18T00:04')
      call check_moment('May 2, 1983 4:42 pm PDT', '', '1983-05-02T16:42-07:00')
      call check_moment('2018 February 12   21:15:54 UT', '', '2018-02-12T21:15:54')
      call check_moment('8/29/2018, 02:33:  .0 UTC', 'mdy', '2018-08-29T02:33')
      ! Times that are none are left out
      call check_moment('1997-10-14 25:10', '', '1997-10-14')
      call check_moment('1997-10-14 071240x', '', '1997-10-14')
      ! What is no date of the calendar is none, nor one of which the order is not known
      call check_moment('14/11/2010', 'mdy', '')
      call check_moment('3/4/2010', '', '')
      call check_moment('19971414', 'dmy', '')
      call check_moment('2019-02-29', '', '')
      call check_moment('1900-02-29', '', '')
      call check_moment('2000-02-29', '', '2000-02-29')
      call check_moment('autumn 1997', 'dmy', '')
      call check_moment('1/2/90', 'mdy', '')
      call check_moment('2010/11/14/2', 'dmy', '')
      call check_moment('To be determined', '', '')
      call check_moment('', 'mdy', '')
      ! In the time of Greenwich, over the ends of months and years
      call check_stamp('2014-12-31T23:49:00+09:00', '20141231T144900Z')
      call check_stamp('2016-03-01T05:00:29.6+09:30', '20160229T193030Z')
      call check_stamp('2018-12-31T20:19-07:00', '20190101T031900Z')
      call check_stamp('2018-12-31T20:19', '20181231T201900Z')
      call check_stamp('2018-12-31', '')
   end subroutine test_dates

   !> Check how a date is read
   subroutine check_moment(text, order, expected)
      !> As of find_moment
      character(len=*), intent(in) :: text, order
      !> What it must be
      character(len=*), intent(in) :: expected

      character(len=:), allocatable :: moment, again

      call find_moment(text, order, moment)
      call check_text(moment, expected, 'date in '//text)
      call find_moment(moment, '', again)
      call check_text(again, moment, 'the same again')
   end subroutine check_moment

   !> Check a stamp
   subroutine check_stamp(moment, expected)
      character(len=*), intent(in) :: moment, expected

      character(len=:), allocatable :: stamp

      call make_stamp(moment, stamp)
      call check_text(stamp, expected, 'stamp of '//moment)
   end subroutine check_stamp

   !> Columns of equal width
   subroutine test_fixed()
      real(wp), allocatable :: values(:)
      type(text_file_type) :: text
      type(error_type), allocatable :: error

      call suite('fixed width')
      call write_file(scratch//'/fixed.txt', 'head'//lf//' 1.5-2.25  3.'//cr//lf//'1e-2 -1.0   '//lf//'tail')
      call read_text_file(scratch//'/fixed.txt', text, error, longest_case)
      call read_fixed(text, block_type(2, 3, 5, 3), values, error)
      call check_error(error, ': line 2: value 1 of 3 = '' 1.5-'': must be a number in column 1 of width 5', &
         & 'wrong width')
      call write_file(scratch//'/fixed.txt', 'head'//lf//'  1.5-2.25   3.'//cr//lf//' 1e-2 -1.0   '//lf//'tail')
      call read_text_file(scratch//'/fixed.txt', text, error, longest_case)
      call read_fixed(text, block_type(2, 5, 5, 3), values, error)
      call check_ok(error, 'touching columns')
      call check(size(values) == 5, 'five')
      call check(all(abs(values - [1.5_wp, -2.25_wp, 3.0_wp, 0.01_wp, -1.0_wp]) < 1.0e-15_wp), 'their values')
      call read_fixed(text, block_type(2, 4, 5, 3), values, error)
      call check_error(error, ': line 3: text after value 4 of 4: '' -1.0   ''', 'one too many')
      call read_fixed(text, block_type(2, 6, 5, 3), values, error)
      call check_error(error, ': line 3: value 6 of 6 = ''   '': must be a number', 'one too few')
      call read_fixed(text, block_type(2, 7, 5, 3), values, error)
      call check_error(error, ': line 3: value 6 of 7', 'a line that is not full')
      call read_fixed(text, block_type(4, 2, 4, 3), values, error)
      call check_error(error, ': line 4: value 1 of 2 = ''tail''', 'a word')
      call read_fixed(text, block_type(2, 2000000000, 5, 3), values, error)
      call check_error(error, 'must be a number', 'a count beyond the file')
      call write_file(scratch//'/fixed.txt', '    1    2')
      call read_text_file(scratch//'/fixed.txt', text, error, longest_case)
      call read_fixed(text, block_type(1, 4, 5, 2), values, error)
      call check_error(error, ': line 1: the file ends after 2 values: the header states 4', 'end of the file')
   end subroutine test_fixed

   !> Times and several columns
   subroutine test_columns()
      type(record_type), allocatable :: records(:)
      type(record_type) :: record
      type(error_type), allocatable :: error
      character(len=:), allocatable :: file
      character(len=*), parameter :: all = 'time,acceleration,acceleration,acceleration'

      call suite('several columns')
      file = scratch//'/three.txt'
      call write_file(file, columns_content('#Station: TLM'//lf//'time (s),N-S (g), "E-W (gal)",V (g)'//lf))
      call read_records(file, records, error, units='g')
      call check_error(error, 'three.txt: units = ''g'': the file states ''gal''', 'units that differ')
      call write_file(scratch//'/three.txt', columns_content('#Station: TLM'//lf//'time (s),N-S (g), "E-W (g)",V'//lf))
      call read_records(file, records, error, units='g')
      call check_ok(error, 'all')
      if (allocated(error)) return
      call check(size(records) == 2, 'two channels, and a title that says nothing of accelerations')
      call check_text(records(2)%name, 'three.E-W_(g)', 'name')
      call check_text(records(2)%metadata%get('channel'), 'E-W (g)', 'channel')
      call check_text(records(2)%metadata%get('station'), 'TLM', 'station')
      call check_text(records(2)%metadata%get('format'), 'columns', 'format')
      call check_text(records(2)%metadata%get('quantity'), 'acceleration', 'quantity')
      call check_text(records(2)%metadata%get('reading'), 'column 4, titled ''V'', is not read', 'what is not read')
      call check_values(records(1), 9.80665_wp, 'column 2')
      call check_values(records(2), -2*9.80665_wp, 'column 3')
      call write_file(scratch//'/three.txt', columns_content('time (s),N-S (g), "E-W (g)",acc V'//lf))
      call read_records(file, records, error)
      call check_error(error, 'three.txt: the file does not state its units', 'units of one are missing')
      call read_record(file, record, error, channel='n-s (g)')
      call check_ok(error, 'by name, units of the title')
      call check_values(record, 9.80665_wp, 'by name')
      call write_file(scratch//'/three.txt', columns_content(''))
      call read_record(file, record, error, units='g')
      call check_error(error, 'three.txt: line 1: 4 columns without titles of accelerations, or values along the rows: '// &
         & 'a row of a catalogue must say what the file holds', 'columns that may be anything')
      call read_record(file, record, error, units='g', columns='time, acceleration,acceleration , Acceleration')
      call check_error(error, 'three.txt: the file has 3 channels: channel must be one of ''column 2'', '// &
         & '''column 3'', ''column 4''', 'no channel')
      call read_records(file, records, error, units='g', columns='time,other,acceleration,other')
      call check_ok(error, 'one of three')
      if (allocated(error)) return
      call check(size(records) == 1, 'the one that is said to be accelerations')
      call check_values(records(1), -2*9.80665_wp, 'one of three')
      call read_record(file, record, error, units='g', columns='time,acceleration')
      call check_error(error, 'three.txt: line 7: no line of values as columns = ''time,acceleration'' says', 'too few words')
      call read_record(file, record, error, columns='time,acceleration')
      call check_error(error, 'three.txt: line 1: 4 values: columns = ''time,acceleration'' is for 2', 'too few words')
      call read_record(file, record, error, units='g', columns='time,acceleration,velocity,other')
      call check_error(error, 'columns = ''time,acceleration,velocity,other'': must be ''rows''', 'a word that is not known')
      call read_record(file, record, error, units='g', columns='time,time,acceleration,other')
      call check_error(error, 'and at most one time', 'two times')
      call read_record(file, record, error, units='g', columns=all, channel='column 3')
      call check_values(record, -2*9.80665_wp, 'column 3')
      call read_record(file, record, error, units='g', columns=all, channel=' 2 ')
      call check_values(record, -2*9.80665_wp, 'second channel')
      call check_text(record%name, 'three.column_3', 'name')
      call read_record(file, record, error, units='g', columns=all, channel='4')
      call check_error(error, 'three.txt: channel = ''4'': must be one of ''column 2'', ''column 3'', '// &
         & '''column 4'', or a number from 1 to 3', 'fourth channel')
      call read_record(file, record, error, units='g', columns=all, channel='up')
      call check_error(error, 'channel = ''up'': must be one of', 'no such name')
      call write_file(scratch//'/three.txt', '1'//lf//'2'//lf//'3')
      call read_record(file, record, error, units='g', dt=0.01_wp, channel='1')
      call check_ok(error, 'the only channel')
      call check_text(record%name, 'three', 'its name')
      call read_record(file, record, error, units='g', dt=0.01_wp, channel='2')
      call check_error(error, 'channel = ''2'': must be one of ''1''', 'no other channel')
      call write_file(scratch//'/three.txt', 't,b (cm/s)'//lf//'0,1'//lf//'0.01,2'//lf)
      call read_record(file, record, error)
      call check_error(error, 'three.txt: line 1: channel ''b (cm/s)'' is not an acceleration', 'velocities by their title')
      call write_file(file, 't,2 (g),2 (g)'//lf//'0,1,4'//lf//'0.01,2,5'//lf)
      call read_record(file, record, error, channel='2 (g)')
      call check_close(record%pga(), 2.0_wp*9.80665_wp, 0.0_wp, 'a name goes before a number')
      call read_record(file, record, error, channel='2 (g) (2)')
      call check_close(record%pga(), 5.0_wp*9.80665_wp, 0.0_wp, 'a name that is a duplicate gets its number')
      call write_file(scratch//'/three.txt', 't,acc (N/S)'//lf//'0,1'//lf//'0.01,2'//lf)
      call read_record(file, record, error)
      call check_error(error, 'units = ''N/S'': must be one of', 'brackets that hold no units')
      call read_record(file, record, error, units='g')
      call check_error(error, 'units = ''N/S'': must be one of', 'brackets that hold no units, units given')
      call write_file(scratch//'/three.txt', 't acc_'//repeat('x', 200)//lf//'0 1'//lf//'0.01 2'//lf)
      call read_record(file, record, error, units='g', format='columns')
      call check_ok(error, 'a long title')
      call write_file(scratch//'/three.txt', '0 '//repeat('1', 200)//'x'//lf//'0.01 2'//lf)
      call read_record(file, record, error, units='g')
      call check_error(error, 'value '''//repeat('1', 60)//'...'': must be a number', 'a long word is cut')
      call write_file(scratch//'/three.txt', '0'//repeat(' 1', 63)//lf//'1'//repeat(' 1', 63)//lf)
      call read_record(file, record, error)
      call check_error(error, ': line 2: more than 63 columns', 'sixty-four columns')
      call read_record(file, record, error, units='g', dt=0.01_wp, columns='rows')
      call check_ok(error, 'sixty-four values in a row')
      call check(size(record%acceleration) == 128, 'values along the rows')
   end subroutine test_columns

   !> A duration that is not that of the values
   subroutine test_duration()
      type(record_type) :: record

      call suite('duration')
      call read_content(replaced(dyna_content('STREAM: HNE'), 'STREAM:', 'DURATION_S: 0.06'//lf//'STREAM:'), record)
      call check_values(record, 0.01_wp, 'duration of six steps')
      call check_refused(replaced(dyna_content('STREAM: HNE'), 'STREAM:', 'DURATION_S: 14.0'//lf//'STREAM:'), &
         & 'duration 14 s: count and time step make 0.07 s')
   end subroutine test_duration

   !> What comments and titles of columns state
   subroutine test_titles()
      type(record_type), allocatable :: records(:)
      type(record_type) :: record
      type(error_type), allocatable :: error
      character(len=:), allocatable :: file
      character(len=*), parameter :: values = '0'//lf//'1'//lf//'2'//lf
      character(len=*), parameter :: timed = '0,1'//lf//'0.01,2'//lf

      call suite('comments and titles')
      file = scratch//'/content.dat'
      call read_content('# units: cm/s2'//lf//'# dt: 0.02'//lf//values, record)
      call check_close(maxval(record%acceleration), 0.02_wp, 1.0e-14_wp, 'units of a comment')
      call check_close(record%dt, 0.02_wp, 0.0_wp, 'step of a comment')
      call read_record(file, record, error, units='g')
      call check_error(error, 'units = ''g'': the file states ''cm/s2''', 'units that differ from the comment')
      call read_record(file, record, error, dt=0.01_wp)
      call check_error(error, 'dt = 0.01: the file states 0.02', 'a step that differs from the comment')
      call check_refused('# units: g'//lf//'# dt: x2'//lf//values, 'line 2: ''dt: x2'' is no statement that is read')
      call check_refused('# units: g'//lf//'# dt: 0.02'//lf//timed, 'the file states dt = 0.02')
      call read_content('t [s],a [cm/s^2]'//lf//timed, record)
      call check_close(maxval(record%acceleration), 0.02_wp, 1.0e-14_wp, 'square brackets')
      call read_content('t,a (m s-2)'//lf//timed, record)
      call check_close(maxval(record%acceleration), 2.0_wp, 1.0e-14_wp, 'powers')
      call check_refused('t,a (mg)'//lf//timed, 'units = ''mg'': must be one of')
      call check_refused('t,a (%g)'//lf//timed, 'units = ''%g'': must be one of')
      call check_refused('time (ms),a (g)'//lf//timed, 'line 1: title ''time (ms)'' of the times: they must be in s')
      call check_refused('time_min,a (g)'//lf//timed, 'line 1: title ''time_min'' of the times')
      call check_refused('Period,a (g)'//lf//timed, 'line 1: title ''Period'' of the times')
      call check_refused('Period (s),a (g)'//lf//timed, 'line 1: title ''Period (s)'' of the times')
      call check_refused('t,Sa (g)'//lf//timed, 'line 1: channel ''Sa (g)'' is not an acceleration')
      call check_refused('t,x (cm)'//lf//timed, 'line 1: channel ''x (cm)'' is not an acceleration')
      call check_refused('t,x (m/sec)'//lf//timed, 'line 1: channel ''x (m/sec)'' is not an acceleration')
      call check_refused('t,a (g)'//lf//'0,1'//lf//'2,1'//lf, 'column 1 increases by 2: must be times in s')
      call write_file(file, columns_content('time (s),acceleration (g),velocity (cm/s),displacement'//lf))
      call read_records(file, records, error)
      call check_ok(error, 'three quantities')
      if (allocated(error)) return
      call check(size(records) == 1, 'accelerations alone')
      call check_values(records(1), 9.80665_wp, 'accelerations')
      call read_record(file, record, error)
      call check_ok(error, 'the only accelerations')
      call read_record(file, record, error, channel='2')
      call check_error(error, 'line 1: channel ''velocity (cm/s)'' is not an acceleration', 'velocities asked for')
   end subroutine test_titles

   !> DYNA files
   subroutine test_dyna()
      type(record_type) :: record
      integer :: i

      call suite('DYNA')
      call read_content(dyna_content('EVENT_DATE_YYYYMMDD: 14/11/2010'//lf//'EVENT_TIME_HHMMSS: 230819'//lf// &
         & 'MAGNITUDE_W: '//lf//'MAGNITUDE_L: 5.1'//lf//'STREAM: HNE'), record)
      call check_values(record, gal, 'values')
      call check_metadata(record, 'event', 'SMALL VALLEY')
      call check_metadata(record, 'date', '2010-11-14T23:08:19')
      call check_metadata(record, 'magnitude', '5.1')
      call check_metadata(record, 'component', 'HNE')
      call check_metadata(record, 'network', 'XX')
      call check_metadata(record, 'station', 'ABC')
      call check_metadata(record, 'latitude', '43.5')
      call check_metadata(record, 'longitude', '12.75')
      call check_metadata(record, 'processing', 'manual')
      call check_metadata(record, 'format', 'dyna')
      call check_metadata(record, 'units', 'cm/s^2')
      call check(any([(record%metadata%entries(i)%key == 'units', i=1, record%metadata%count())]), &
         & 'units in lower case')
      call check_metadata(record, 'MAGNITUDE_W', '')
      call check_metadata(record, 'DATA_CITATION', ': a colon')
      call read_content(dyna_content('EVENT_DATE_YYYYMMDD: 2010/11/14'//lf//'EVENT_TIME_HHMMSS: 23:08:25.75'//lf// &
         & 'MAGNITUDE_W: 5.0'//lf//'MAGNITUDE_L: 5.1'//lf//'COMPONENT: NS'), record)
      call check_metadata(record, 'date', '2010-11-14T23:08:25.75')
      call check_metadata(record, 'magnitude', '5.0')
      call check_metadata(record, 'component', 'NS')
      call check_refused(replaced(dyna_content('STREAM: HNE'), '-1.500000', '-1.520'), 'line 9: peak value -1.52: '// &
         & 'the largest value is 1.5')
      call read_content(replaced(dyna_content('STREAM: HNE'), '-1.500000', '1.51'), record)
      call check_values(record, gal, 'a peak of less than 1 % difference')
      call check_refused(replaced(dyna_content('STREAM: HNE'), '-1.500000', '1.5x'), &
         & 'line 9: peak value ''1.5x'': must be a number')
      call read_content(replaced(dyna_content('STREAM: HNE'), '-1.500000', '-2'), record)
      call check_values(record, gal, 'a peak without decimals')
      call check_refused(replaced(dyna_content('STREAM: HNE'), '-1.500000', '152.0e-2'), &
         & 'line 9: peak value 1.52: the largest value is 1.5')
      call read_content(replaced(dyna_content('STREAM: HNE'), '-1.500000', '.15E+1'), record)
      call read_content(replaced(dyna_content('STREAM: HNE'), '-1.500000', ''), record)
      call check_values(record, gal, 'no peak')
      ! Names are often those of regions, where there are many earthquakes.
      call read_content(replaced(dyna_content('STREAM: HNE'), 'NETWORK', 'EVENT_ID: IT-2014-0003'//lf//'NETWORK'), record)
      call check_metadata(record, 'event', 'SMALL VALLEY IT-2014-0003')
      call read_content(replaced(dyna_content('EVENT_ID: IT-2014-0003'), 'SMALL VALLEY', 'NONAME'), record)
      call check_metadata(record, 'event', 'IT-2014-0003')
      call read_content(replaced(dyna_content('STREAM: HNE'), 'SMALL VALLEY', 'NONAME'), record)
      call check_metadata(record, 'event', '')
      call check_refused(replaced(dyna_content('STREAM: HNE'), ': ACCELERATION', ': DISPLACEMENT'), &
         & 'DATA_TYPE = ''DISPLACEMENT'': must be ACCELERATION')
   end subroutine test_dyna

   !> PEER files
   subroutine test_peer()
      type(record_type) :: record

      call suite('PEER')
      call read_content(peer_content('Some Valley-06, 10/15/1979, Array #6, Hall, North, 230', ''), record)
      call check_values(record, 9.80665_wp, 'values')
      call check_metadata(record, 'event', 'Some Valley-06')
      call check_metadata(record, 'date', '1979-10-15')
      call check_metadata(record, 'station', 'Array #6, Hall, North')
      call check_metadata(record, 'component', '230')
      call read_content(peer_content('SOME VALLEY 10/15/79 2319, ARRAY #10, 50 (STATION 412)', &
         & '. FILTER POINTS: HP=0.1 Hz  LP=40.0 Hz'), record)
      call check_values(record, 9.80665_wp, 'old values')
      call check_metadata(record, 'event', 'SOME VALLEY')
      call check_metadata(record, 'date', '1979-10-15T23:19')
      call check_metadata(record, 'station', 'ARRAY #10')
      call check_metadata(record, 'component', '50')
      call check_metadata(record, 'processing', 'FILTER POINTS: HP=0.1 Hz  LP=40.0 Hz')
      call read_content(replaced(peer_content('SOME VALLEY 10/15/79 12:31, ARRAY #10, 50', '. FILTERED'), 'OF G', &
         & 'OF (G)'), record)
      call check_values(record, 9.80665_wp, 'units in brackets')
      call check_metadata(record, 'date', '1979-10-15T12:31')
      call check_metadata(record, 'units', 'g')
      call check_metadata(record, 'processing', 'FILTERED')
      call read_content(peer_content('rotated', ''), record)
      call check_metadata(record, 'description', 'rotated')
      call check_metadata(record, 'event', '')
      call read_content(peer_content('', ''), record)
      call check_values(record, 9.80665_wp, 'no line')
   end subroutine test_peer

   !> SMTK files
   subroutine test_smtk()
      type(record_type) :: record

      call suite('SMTK')
      call read_content(smtk_content(), record)
      call check_values(record, 1.0_wp, 'values')
      call check_metadata(record, 'date', '2009-04-06T01:32:39')
      call check_metadata(record, 'station', '36')
      call check_metadata(record, 'Station Code / Name', '36 / Hall')
      call check_metadata(record, 'component', 'NS')
      call check_metadata(record, 'network', 'ABC')
      call check_metadata(record, 'processing', 'none: at all')
      call check_refused(replaced(smtk_content(), 'Accelaration', 'Velocity'), &
         & 'line 9: ''Velocity time series in m/s/s'': must be Acceleration')
      call check_refused(replaced(smtk_content(), ': 7', ': 8'), 'line 11: value 8 of 8')
      call check_refused(replaced(smtk_content(), ': 7', ': 4'), 'line 11: more values than the 4')
      call check_refused(replaced(smtk_content(), ': 7', ': 2'), 'line 10: text after value 2 of 2')
      call read_content(replaced(smtk_content(), ': 7', ': 6'), record)
      call check(size(record%acceleration) == 6, 'the six values that are stated')
      call check_metadata(record, 'reading', 'ignored 1 sample beyond the 6 stated in the file')
      call read_content(replaced(smtk_content(), ': 7', ': 5'), record)
      call check_metadata(record, 'reading', 'ignored 2 samples beyond the 5 stated in the file')
      call check_refused(replaced(smtk_content(), '1.5000000E+00'//lf, '1.6'//lf), 'line 8: peak value 1.6: ')
      call check_refused(replaced(smtk_content(), 'in m/s/s', 'in m/s'), 'units = ''m/s'': must be one of')
   end subroutine test_smtk

   !> K-NET files
   subroutine test_knet()
      type(record_type) :: record

      call suite('K-NET')
      call read_content(knet_content('E-W'), record)
      call check(abs(sum(record%acceleration)) < 1.0e-15_wp, 'mean removed')
      ! Counts are 1000 + 16 small, whose mean is removed
      call check_close(record%acceleration(4) - record%acceleration(5), 2.0_wp*gal*0.5_wp, 1.0e-12_wp, 'scale')
      call check_close(record%dt, 0.01_wp, 1.0e-15_wp, 'dt')
      call check_metadata(record, 'date', '2014-12-31T23:49:00+09:00')
      call check_metadata(record, 'station', 'CHB999')
      call check_metadata(record, 'component', 'E-W')
      call check_metadata(record, 'magnitude', '4.2')
      call check_metadata(record, 'latitude', '35.7943')
      call check_metadata(record, 'processing', 'mean of 999 counts removed')
      call check_metadata(record, 'units', 'gal')
      call read_content(knet_content('5'), record)
      call check_metadata(record, 'component', 'EW2')
      call check_refused(replaced(knet_content('5'), '3920(gal)/125440', '3920/125440'), &
         & 'line 14: Scale Factor = ''3920/125440'': must be')
      call check_refused(replaced(knet_content('5'), '3920(gal)/125440', '3920(gal)/0'), 'line 14: Scale Factor')
      call check_refused(replaced(knet_content('5'), '100Hz', '0Hz'), 'line 11: Sampling Freq(Hz) = ''0Hz'': must be')
      call check_refused(replaced(knet_content('5'), '0.07', '0.08'), &
         & 'the file ends after 7 values: the header states 8')
      call check_refused(replaced(knet_content('5'), '0.07', '0.04'), 'more values than the 4')
      call read_content(replaced(replaced(knet_content('5'), '0.07', '0.05'), '0.712', ''), record)
      call check(size(record%acceleration) == 5, 'the five counts that are stated')
      call check_metadata(record, 'reading', 'ignored 2 samples beyond the 5 stated in the file')
      call check_refused(replaced(knet_content('5'), '0.07', '1e6'), 'line 12: Duration Time(s) = 1000000: the file is')
      call check_refused(replaced(knet_content('5'), '0.712', '0.731'), &
         & 'line 15: peak value 0.731: the largest value is')
   end subroutine test_knet

   !> CWA files
   subroutine test_cwa()
      type(record_type), allocatable :: records(:)
      type(error_type), allocatable :: error
      type(record_type) :: record

      call suite('CWA')
      call write_file(scratch//'/content.dat', cwa_content())
      call read_records(scratch//'/content.dat', records, error)
      call check_ok(error, 'read')
      if (allocated(error)) return
      call check(size(records) == 3, 'three channels')
      call check_values(records(2), gal, 'N')
      call check_values(records(3), -gal, 'E')
      call check_metadata(records(2), 'component', 'N')
      call check_metadata(records(2), 'channel', 'N')
      call check_metadata(records(2), 'station', 'EAS')
      call check_metadata(records(2), 'date', '2018-02-06T23:50:42+08:00')
      call check_metadata(records(2), 'processing', 'DCoffset(corr)')
      call check_text(records(2)%name, 'content.N', 'name')
      call read_record(scratch//'/content.dat', record, error, channel='e')
      call check_values(record, -gal, 'E by its name')
      call check_refused(replaced(cwa_content(), '(Hz): 100', '(Hz): 50'), '7 rows of values: the header states 3.5')
      call check_refused(replaced(replaced(cwa_content(), '(Hz): 100', '(Hz): 50'), ': 0.07', ': 0.14'), &
         & 'line 9: SampleRate(Hz) = 50: the step of the times is 0.01')
      call check_refused(replaced(cwa_content(), '     0.030', '     0.035'), 'line 20: time 0.035 after 0.02')
      call check_refused(replaced(cwa_content(), '-1.500~', '-1.700~'), 'peak value -1.7: the largest value is 1.5')
      call check_refused(replaced(cwa_content(), ' gal.', ' mm.'), 'units = ''mm'': must be one of')
      call check_refused(replaced(cwa_content(), 'Time U', 'U'), 'DataSequence = ')
      call check_refused(replaced(cwa_content(), '    -1.500', '   -1.5 00'), 'must be a number in column')
   end subroutine test_cwa

   !> ASA files
   subroutine test_asa()
      type(record_type), allocatable :: records(:)
      type(error_type), allocatable :: error

      call suite('ASA')
      call write_file(scratch//'/content.dat', asa_content('7'))
      call read_records(scratch//'/content.dat', records, error)
      call check_ok(error, 'read')
      if (allocated(error)) return
      call check(size(records) == 2, 'two channels')
      call check_values(records(1), gal, 'V')
      call check_values(records(2), -gal, 'N90E')
      call check_text(records(2)%name, 'content.N90E', 'name')
      call check_metadata(records(2), 'component', 'N90E')
      call check_metadata(records(2), 'date', '1989-03-10T05:19:51.0Z')
      call check_metadata(records(2), 'station', 'ACAC')
      call check_metadata(records(2), 'magnitude', '5.30')
      call check_metadata(records(2), 'latitude', '16.8')
      call check_metadata(records(2), 'longitude', '-99.8')
      call check_metadata(records(2), 'reading', '')
      call check_metadata(records(2), 'TIPO DE SUELO', 'ARENA LIMO')
      call write_file(scratch//'/content.dat', asa_content('6'))
      call read_records(scratch//'/content.dat', records, error)
      call check_ok(error, 'one more than stated')
      call check(size(records(2)%acceleration) == 6, 'the stated number is read')
      call check_metadata(records(2), 'reading', 'ignored 1 sample beyond the 6 stated in the file')
      call write_file(scratch//'/content.dat', asa_content('5'))
      call read_records(scratch//'/content.dat', records, error)
      call check_ok(error, 'two more than stated')
      call check_metadata(records(1), 'reading', 'ignored 2 samples beyond the 5 stated in the file')
      call check_refused(asa_content('4'), '7 rows of values: the header states 4')
      call check_refused(asa_content('8'), '7 rows of values: the header states 8')
      call check_refused(asa_content(''), '7 rows of values: the header states 0')
      call check_refused(replaced(asa_content('7'), '/0.01/0.01', '/0.01/'), 'INTERVALO DE MUESTREO, C1-C6 (s)')
      call check_refused(with_line('VEL. DE MUESTREO, C1-C6 (muestras/s)   : /200/200'), &
         & '= 0.01: the header states a rate of 200 samples per second')
      call check_refused(with_line('DURACION DEL REGISTRO (s), C1-C6       : /0.35/0.35'), &
         & 'duration 0.35 s: count and time step make 0.07 s')
      call write_file(scratch//'/content.dat', replaced(with_line( &
         & 'VEL. DE MUESTREO, C1-C6 (muestras/s)   : /100/100'), '/0.01/0.01', ''))
      call read_records(scratch//'/content.dat', records, error)
      call check_ok(error, 'a rate in place of an interval')
      if (.not. allocated(error)) call check_values(records(1), gal, 'by its rate')
      call check_refused(replaced(asa_content('7'), ': Gal (cm/s/s)', ':'), 'does not state its units')
      call check_refused(replaced(asa_content('7'), 'CANALES                      : 2', 'CANALES: 13'), &
         & 'must be at most 12')
      call check_refused(replaced(asa_content('7'), 'DATOS DE ACELERACION', 'DATOS'), 'no line DATOS DE ACELERACION')
   end subroutine test_asa

   !> An ASA file with one more line in its header
   function with_line(line) result(content)
      character(len=*), intent(in) :: line
      character(len=:), allocatable :: content

      content = replaced(asa_content('7'), 'FECHA DEL', line//cr//lf//'FECHA DEL')
   end function with_line

   !> eqsig files
   subroutine test_eqsig()
      type(record_type) :: record
      type(error_type), allocatable :: error
      character(len=*), parameter :: file = scratch//'/content.dat'

      call suite('eqsig')
      call write_file(scratch//'/content.dat', eqsig_content('7'))
      call read_record(file, record, error, units='m/s2')
      call check_ok(error, 'read')
      call check_values(record, 1.0_wp, 'values')
      call check_metadata(record, 'label', 'a label')
      call check_metadata(record, 'format', 'eqsig')
      call check_refused(eqsig_content('7'), 'the file does not state its units')
      call check_refused(eqsig_content('8'), 'the file ends after 7 values: the header states 8')
      call check_refused(eqsig_content('4'), 'more values than the 4')
      call write_file(file, eqsig_content('6'))
      call read_record(file, record, error, units='m/s2')
      call check_ok(error, 'one value more than stated')
      call check(size(record%acceleration) == 6, 'the stated number is read')
      call check_metadata(record, 'reading', 'ignored 1 sample beyond the 6 stated in the file')
   end subroutine test_eqsig

   !> AFAD files
   subroutine test_afad()
      type(record_type), allocatable :: records(:)
      type(error_type), allocatable :: error

      call suite('AFAD')
      call write_file(scratch//'/content.dat', afad_content())
      call read_records(scratch//'/content.dat', records, error)
      call check_ok(error, 'read')
      if (allocated(error)) return
      call check(size(records) == 2, 'two channels')
      call check_values(records(1), gal, 'N-S')
      call check_values(records(2), -gal, 'E-W')
      call check_metadata(records(2), 'format', 'afad')
      call check_metadata(records(2), 'component', 'E-W')
      call check_metadata(records(2), 'station', '3104')
      call check_metadata(records(2), 'longitude', '36.25000')
      call check_refused(replaced(afad_content(), ': 7', ': 8'), '7 rows of values: the header states 8')
      call check_refused(replaced(afad_content(), '(E-W) 1.5', '(E-W) 2.5'), 'peak value 2.5: the largest value is 1.5')
   end subroutine test_afad

   !> Tables of NIED
   subroutine test_nied()
      type(record_type), allocatable :: records(:)
      type(error_type), allocatable :: error

      call suite('NIED')
      call write_file(scratch//'/content.dat', nied_content())
      call read_records(scratch//'/content.dat', records, error)
      call check_ok(error, 'read')
      if (allocated(error)) return
      call check(size(records) == 2, 'two channels')
      call check_values(records(1), gal, 'N-S')
      call check_values(records(2), -gal, 'E-W')
      call check_metadata(records(2), 'format', 'nied')
      call check_metadata(records(2), 'date', '2031-12-31T23:59:00+09:00')
      call check_refused(replaced(nied_content(), 'Freq(Hz), 100', 'Freq(Hz), 200'), 'the step of the times is 0.01 s')
   end subroutine test_nied

   !> Files that are cut off inside their last number
   subroutine test_cut()
      character(len=*), parameter :: cut = 'is printed shorter than the others'
      character(len=:), allocatable :: content

      call suite('cut files')
      ! -1.2500000E-01 becomes -1.2500000E-0, ten times as large, and so on
      content = without_end(peer_content('Valley, 1/2/1990, Hall, 67', ''))
      call check_refused(content(:len(content) - 1), 'line 6: the file is cut off: its last value, ''-1.2500000E-0'', '//cut)
      content = without_end(smtk_content())
      call check_refused(content(:len(content) - 1), cut)
      content = without_end(dyna_content('STREAM: HNE'))
      call check_refused(content(:len(content) - 3), 'line 22: the file is cut off: its last value, ''-.125'', '//cut)
      content = without_end(eqsig_content('7'))
      call check_refused(content(:len(content) - 1), cut)
      content = without_end(cwa_content())
      call check_refused(content(:len(content) - 2), cut)
      content = without_end(asa_content('7'))
      call check_refused(content(:len(content) - 2), cut)
   end subroutine test_cut

   !> A content without line ends and blanks at its end
   function without_end(content) result(text)
      character(len=*), intent(in) :: content
      character(len=:), allocatable :: text

      text = content(:verify(content, ' '//cr//lf, back=.true.))
   end function without_end

   !> Columns that touch, and exponents without their letter
   subroutine test_touching()
      type(record_type) :: record
      character(len=:), allocatable :: top, content
      real(wp) :: value
      logical :: ok

      call suite('touching columns')
      top = 'PEER NGA STRONG MOTION DATABASE RECORD'//lf//'Ridge, 3/4/1991, Mill, 12'//lf// &
         & 'ACCELERATION TIME SERIES IN UNITS OF G'//lf
      content = top//'NPTS= 7, DT= .0100 SEC'//lf//' .00000E+00 .12500E+00-.25000E+00 .50000E+00'//lf// &
         & '-.15000E+01 .75000E+00-.12500E+00'//lf
      call read_content(content, record)
      call check_values(record, 9.80665_wp, 'seven values in columns of 11')
      call check_refused(replaced(content, '.75000E+00-.1', '.75000E+00x.1'), 'must be a number')
      call read_content(top//'NPTS= 4, DT= .0100 SEC'//lf//'  .5000000E+00  .2500000-113 -.3000000-250  .1250000E+00'//lf, &
         & record)
      call check_close(record%acceleration(1), 0.5_wp*9.80665_wp, 1.0e-12_wp, 'a value beside small ones')
      call check(abs(record%acceleration(2)) < 1.0e-100_wp .and. record%acceleration(2) > 0.0_wp, 'a small value')
      call check(abs(record%acceleration(3)) < 1.0e-200_wp .and. record%acceleration(3) < 0.0_wp, 'a smaller one')
      call parse_printed(' 0.25-103 ', value, ok)
      call check(ok .and. abs(value - 0.25e-103_wp) < 1.0e-117_wp, 'exponent of three digits')
      call parse_printed('-1.5+002', value, ok)
      call check(ok .and. abs(value + 150.0_wp) < 1.0e-12_wp, 'positive exponent')
      call parse_printed('2031-104', value, ok)
      call check(.not. ok, 'no point')
      call parse_printed('1.5-10', value, ok)
      call check(.not. ok, 'two digits')
      call parse_printed('1.5E-01-104', value, ok)
      call check(.not. ok, 'two exponents')
   end subroutine test_touching

   !> Steps that follow from printed times
   subroutine test_step()
      use, intrinsic :: iso_fortran_env, only : real32
      type(record_type) :: record
      type(error_type), allocatable :: error
      character(len=*), parameter :: file = scratch//'/times.txt'
      character(len=:), allocatable :: content
      character(len=60) :: line
      real(real32) :: time
      integer :: i

      call suite('steps of printed times')
      content = ''
      time = 0.0_real32
      do i = 0, 400
         write (line, '(f0.18, a, f0.4)') real(real(0.005_wp*i, real32), wp), ' ', sin(0.1_wp*i)
         content = content//trim(line)//lf
      end do
      call write_file(file, content)
      call read_record(file, record, error, units='m/s2')
      call check_ok(error, 'single precision')
      call check_close(record%dt, 0.005_wp, 0.0_wp, 'the decimal of times in single precision')
      content = ''
      do i = 0, 3000
         write (line, '(f0.18, a, f0.4)') real(time, wp), ' ', sin(0.1_wp*i)
         content = content//trim(line)//lf
         time = time + 0.01_real32
      end do
      call write_file(file, content)
      call read_record(file, record, error, units='m/s2')
      call check_ok(error, 'sums in single precision')
      call check_close(record%dt, 0.01_wp, 0.0_wp, 'the decimal of times that were added up')
      content = ''
      do i = 0, 900
         write (line, '(f0.6, a, f0.4)') i/256.0_wp, ' ', sin(0.1_wp*i)
         content = content//trim(line)//lf
      end do
      call write_file(file, content)
      call read_record(file, record, error, units='m/s2')
      call check_ok(error, 'a step of many digits')
      call check_close(record%dt, 1.0_wp/256.0_wp, 1.0e-9_wp, 'a step of many digits stays')
      call read_record(file, record, error, units='m/s2', dt=1.0_wp/256.0_wp)
      call check_ok(error, 'given as well')
      call check_close(record%dt, 1.0_wp/256.0_wp, 0.0_wp, 'the given step within the rounding')
      call read_record(file, record, error, units='m/s2', dt=0.0041_wp)
      call check_error(error, 'times.txt: dt = 0.0041: the times in the file are 0.00390625 s apart', 'another step')
   end subroutine test_step

   !> What is reported of how records were read
   subroutine test_notes()
      type(record_type) :: records(4)
      type(lines_type) :: notes

      call suite('notes')
      records(1)%name = 'a'
      records(2)%name = 'b'//achar(27)
      records(3)%name = 'c'
      records(4)%name = 'd'
      call list_reading_notes(records, notes)
      call check(notes%count == 0, 'nothing to report')
      call records(2)%metadata%append('reading', 'one')
      call records(3)%metadata%append('reading', 'one')
      call records(4)%metadata%append('reading', 'one')
      call records(4)%metadata%append('reading', 'two')
      call list_reading_notes(records, notes)
      call check(notes%count == 2, 'two kinds')
      call check_text(notes%line(1)%text, 'record ''b\x1b'': one (2 of 4 records)', 'of two records')
      call check_text(notes%line(2)%text, 'record ''d'': one; two', 'of one')
   end subroutine test_notes

   !> Channels and formats in a catalogue
   subroutine test_catalogue()
      type(record_type), allocatable :: records(:)
      type(error_type), allocatable :: error

      call suite('catalogue')
      call write_file(scratch//'/three.dat', cwa_content())
      call write_file(scratch//'/catalogue.csv', 'file,channel,format'//lf//'three.dat,N,'//lf//'three.dat,3,cwa'//lf)
      call read_catalogue(scratch//'/catalogue.csv', records, error)
      call check_ok(error, 'read')
      if (allocated(error)) return
      call check_text(records(1)%name, 'three.N', 'name 1')
      call check_values(records(2), -gal, 'E')
      call write_file(scratch//'/catalogue.csv', 'file,channel'//lf//'three.dat,N'//lf//'three.dat,'//lf)
      call read_catalogue(scratch//'/catalogue.csv', records, error)
      call check_error(error, 'catalogue.csv: line 3: '//scratch//'/three.dat: the file has 3 channels', 'no channel')
      call write_file(scratch//'/catalogue.csv', 'file,channel,format'//lf//'three.dat,N,peer'//lf)
      call read_catalogue(scratch//'/catalogue.csv', records, error)
      call check_error(error, 'catalogue.csv: line 2: '//scratch//'/three.dat: line ', 'wrong format')
   end subroutine test_catalogue

   !> The table of records
   subroutine test_table()
      type(record_type) :: records(3)
      type(lines_type) :: table
      type(error_type), allocatable :: error
      character(len=:), allocatable :: problems
      real(wp) :: wave(401)
      integer :: i

      call suite('table')
      ! Ten waves that grow and decay leave no velocity
      wave = [(cos(0.05_wp*pi*(i - 1))*sin(pi*(i - 1)/400.0_wp)**2, i=1, size(wave))]
      call new_record(records(1), wave, 0.01_wp, 'wave', error)
      call find_problems(records(1), 10.0_wp, problems)
      call check_text(problems, '', 'a sound record')
      call new_record(records(2), min(abs(wave), 0.7_wp) + 0.2_wp, 0.01_wp, 'clipped', error)
      call find_problems(records(2), 10.0_wp, problems)
      call check_text(problems, 'begins at 22 % of its PGA; ends at 100 % of its PGV; '// &
         & 'PGV / PGA = 2.204 s, more than 0.5 s: wrong time step, or a baseline that drifts?; '// &
         & '11 samples in a row at its PGA', 'a record that begins late, drifts and is clipped')
      call new_record(records(3), [0.0_wp, 0.0_wp], 0.01_wp, 'nothing', error)
      call find_problems(records(3), 10.0_wp, problems)
      call check_text(problems, 'no motion', 'a record of zeros')
      call new_record(records(3), 4340.0_wp*wave, 0.01_wp, 'nothing', error)
      call find_problems(records(3), 10.0_wp, problems)
      call check_text(problems, 'a PGA of 434 g, more than 3 g: wrong units?', 'too strong')
      call new_record(records(3), 0.005_wp*wave, 0.01_wp, 'nothing', error)
      call find_problems(records(3), 10.0_wp, problems)
      call check_text(problems, 'a PGA of 0.0005 g, less than 0.005 g: wrong units?', &
         & 'too weak')
      call new_record(records(3), wave, 0.4_wp, 'slow', error)
      call find_problems(records(3), 10.0_wp, problems)
      call check_text(problems, 'PGV / PGA = 2.538 s, more than 0.5 s: wrong time step, or a baseline that drifts?', &
         & 'too slow')
      call new_record(records(3), wave, 0.0001_wp, 'quick', error)
      call find_problems(records(3), 10.0_wp, problems)
      call check_text(problems, 'PGV / PGA = 0.0006346 s, less than 0.015 s: wrong time step?', 'too quick')
      call records(3)%metadata%set('motion', 'Shake table')
      call find_problems(records(3), 10.0_wp, problems)
      call check_text(problems, '', 'as quick, but of a shake table')
      call new_record(records(3), 0.005_wp*wave, 0.01_wp, 'nothing', error)
      call records(1)%metadata%set('event', 'Friuli')
      call records(1)%metadata%set('station', 'TLM'//achar(27))
      call records(2)%metadata%set('date', '1976-05-06')
      table = record_table(records, 10.0_wp)
      call check(table%count == 5, 'five lines')
      call check_text(table%line(1)%text, '  no.  record   samples        dt    length        PGA       PGV  '// &
         & 'event, station  problems', 'titles')
      call check_text(table%line(2)%text, '                                s         s          g      cm/s', 'units')
      call check_text(table%line(3)%text(:64), '    1  wave         401   0.01000      4.00     0.1000      6.35', &
         & 'numbers')
      call check_text(table%line(3)%text(65:), '  Friuli, TLM', 'event and station, without the escape character')
      call check_text(table%line(4)%text(65:89), '  1976-05-06      begins ', 'date where there is no event')
      call new_record(records(3), wave, 0.01_wp, repeat('x', 17)//'è'//repeat('y', 9)//'è'//repeat('z', 18), error)
      table = record_table(records(3:3), 10.0_wp)
      call check_text(table%line(3)%text(8:48), repeat('x', 17)//'...'//repeat('z', 18)//repeat(' ', 3), &
         & 'a long name without its middle, and no half of a character')
   end subroutine test_table

   !> Recorded files of all formats, where there are any: peaks and steps as in their manifest
   subroutine test_samples()
      character(len=*), parameter :: folders(*) = [character(len=22) :: 'formats/peer_at2/', 'formats/esm_dyna12/', &
         & 'formats/itaca_', 'formats/gem_smtk/', 'formats/knet/', 'formats/cwa/', 'formats/asa_mexico/', &
         & 'formats/multi_column/']
      type(csv_table_type) :: table
      type(csv_row_type) :: row
      type(record_type) :: record
      type(error_type), allocatable :: error
      character(len=:), allocatable :: folder, file, channel
      real(wp) :: pga, dt, npts
      integer :: length, tested, bracket, i
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
         if (.not. any([(index(file, trim(folders(i))) == 1, i=1, size(folders))])) cycle
         if (len(row%get_text(table%column('pga_m_s2'))) == 0) cycle
         tested = tested + 1
         bracket = index(file, ' (')
         channel = ''
         if (bracket > 0) then
            channel = file(bracket + 2:len(file) - 1)
            file = file(:bracket - 1)
         end if
         call table%get_real(row, table%column('dt_s'), dt, error)
         call table%get_real(row, table%column('pga_m_s2'), pga, error)
         call table%get_real(row, table%column('npts'), npts, error)
         if (index(file, 'multi_column') > 0) then
            call read_record(folder//'/'//file, record, error, units='g', channel=channel, &
               & columns='time,acceleration,acceleration,acceleration')
         else
            call read_record(folder//'/'//file, record, error, channel=channel)
         end if
         call check_ok(error, file)
         if (allocated(error)) cycle
         call check_close(record%dt, dt, 1.0e-6_wp, 'dt of '//file//' '//channel)
         call check_close(record%pga(), pga, 1.0e-3_wp, 'PGA of '//file//' '//channel)
         ! The manifest counts the rows of the file from Mexico, one more than its header states
         call check(size(record%acceleration) == nint(npts) - merge(1, 0, index(file, 'asa_mexico') > 0), &
            & 'number of samples of '//file//' '//channel)
         call check(len(record%metadata%get('format')) > 0, 'format of '//file)
         if (index(file, 'multi_column') == 0 .and. index(file, 'Rot') == 0) then
            call check(len(record%metadata%get('date')) >= 10, 'date of '//file)
            call check(len(record%metadata%get('station')) > 0, 'station of '//file)
            call check(len(record%metadata%get('component')) > 0, 'component of '//file)
         end if
      end do
      call check(tested >= 19, to_text(tested)//' channels tested')
   end subroutine test_samples

   !> Replace the first occurrence of a part
   function replaced(text, part, by) result(changed)
      character(len=*), intent(in) :: text, part, by
      character(len=:), allocatable :: changed
      integer :: at

      at = index(text, part)
      call check(at > 0, 'the test holds '''//part//'''')
      changed = text(:at - 1)//by//text(at + len(part):)
   end function replaced

   !> Read the only channel of a content that states all
   subroutine read_content(content, record)
      character(len=*), intent(in) :: content
      type(record_type), intent(out) :: record
      type(error_type), allocatable :: error

      call write_file(scratch//'/content.dat', content)
      call read_record(scratch//'/content.dat', record, error)
      call check_ok(error, 'file '//content(:min(30, len(content))))
      if (.not. allocated(record%acceleration)) allocate (record%acceleration(0))
   end subroutine read_content

   !> A content that is refused
   subroutine check_refused(content, part)
      character(len=*), intent(in) :: content, part
      type(record_type), allocatable :: records(:)
      type(error_type), allocatable :: error

      call write_file(scratch//'/content.dat', content)
      call read_records(scratch//'/content.dat', records, error)
      call check_error(error, part, 'damaged content')
      if (allocated(error)) call check(index(error%message, scratch//'/content.dat: ') == 1, &
         & 'the message names the file')
   end subroutine check_refused

   !> A record holds the small values times a factor, at steps of 0.01 s
   subroutine check_values(record, factor, what)
      type(record_type), intent(in) :: record
      real(wp), intent(in) :: factor
      character(len=*), intent(in) :: what
      integer :: i

      call check(allocated(record%acceleration), what//': record')
      if (.not. allocated(record%acceleration)) return
      call check(size(record%acceleration) == size(small), what//': number of values')
      do i = 1, min(size(small), size(record%acceleration))
         call check_close(record%acceleration(i), factor*small(i), 1.0e-12_wp, what//': value '//to_text(i))
      end do
      call check_close(record%dt, 0.01_wp, 1.0e-12_wp, what//': dt')
   end subroutine check_values

   !> The value of a key
   subroutine check_metadata(record, key, value)
      type(record_type), intent(in) :: record
      character(len=*), intent(in) :: key, value

      call check_text(record%metadata%get(key), value, key)
   end subroutine check_metadata

end program test_formats
