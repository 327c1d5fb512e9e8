!> Readers of the formats of archives: COSMOS, CSMIP volume 2, GeoNet V2A, SMC.
!>
!> The small texts are written here, in the layout of each format; recorded files are read where there are any.
program test_archives
   use archive_files, only : cosmos, cosmos_type, csmip, geonet, motion, smc, with_crlf
   use checks, only : check, check_close, check_error, check_ok, check_text, finish, skip, suite
   use dondolo_base_error, only : error_type
   use dondolo_base_kinds, only : wp
   use dondolo_base_text, only : to_text
   use dondolo_files_csv_reader, only : csv_row_type, csv_table_type
   use dondolo_record, only : record_type
   use dondolo_records_header_text, only : after, before, leading_number, parse_format, squeezed
   use dondolo_records_record_reader, only : read_record, read_records
   implicit none

   character(len=*), parameter :: scratch = 'build/test_archives', lf = achar(10)

   !> Standard gravity [m/s2]
   real(wp), parameter :: gravity = 9.80665_wp

   call execute_command_line('mkdir -p '//scratch)
   call test_header_text()
   call test_cosmos()
   call test_cosmos_units()
   call test_cosmos_records()
   call test_cosmos_errors()
   call test_csmip()
   call test_csmip_days()
   call test_csmip_errors()
   call test_geonet()
   call test_geonet_errors()
   call test_smc()
   call test_smc_errors()
   call test_damaged()
   call test_samples()
   call finish()

contains

   !> Words and numbers of header lines
   subroutine test_header_text()
      character(len=*), parameter :: bad(*) = [character(len=10) :: '', '8F10.3', '(8F10.3', '()', '(8X10.3)', &
         & '(F)', '(0F10.3)', '(8F0.3)', '(1000F8.1)', '(8F100.3)', '(aF8.1)', '(-8F8.1)']
      integer :: i, width, per_line
      logical :: ok

      call suite('header text')
      call check_text(after('Station No. 7', 'station no.'), '7', 'after')
      call check_text(after('Station', 'no.'), '', 'after a label that is not there')
      call check_text(before(' cm/sec2(04)', '('), 'cm/sec2', 'before')
      call check_text(before('cm ', '('), 'cm', 'before a mark that is not there')
      call check_text(squeezed('  a   b'//achar(9)//'c '), 'a b c', 'squeezed')
      call check_text(leading_number('6.5(BRK)'), '6.5', 'number before a bracket')
      call check_text(leading_number(' 35.908E, '), '35.908', 'number before a direction')
      call check_text(leading_number('-1.5E+02x'), '-1.5E+02', 'number with exponent')
      call check_text(leading_number('9KM'), '9', 'number before a unit')
      call check_text(leading_number('x9'), '', 'no number')
      call check_format('(8F10.5)', 10, 8)
      call check_format('(1E15.6)', 15, 1)
      call check_format(' ( 10I8 ) and more', 8, 10)
      call check_format('(1P8E10.3)', 10, 8)
      call check_format('(1p, 5es14.7e1)', 14, 5)
      call check_format('(F8.1)', 8, 1)
      do i = 1, size(bad)
         call parse_format(trim(bad(i)), width, per_line, ok)
         call check(.not. ok, 'format '//trim(bad(i))//' is refused')
      end do
   end subroutine test_header_text

   !> A Fortran format that is read
   subroutine check_format(format, width, per_line)
      character(len=*), intent(in) :: format
      integer, intent(in) :: width, per_line
      integer :: found_width, found_per_line
      logical :: ok

      call parse_format(format, found_width, found_per_line, ok)
      call check(ok .and. found_width == width .and. found_per_line == per_line, 'format '//format)
   end subroutine check_format

   !> COSMOS: values, step, metadata
   subroutine test_cosmos()
      type(record_type) :: record
      type(error_type), allocatable :: error
      type(cosmos_type) :: file

      call suite('cosmos')
      call check_motion('plain.v2c', cosmos(file), 0.001_wp, 0.005_wp, record)
      call check_text(record%metadata%get('format'), 'cosmos', 'format')
      call check_text(record%metadata%get('quantity'), 'acceleration', 'quantity')
      call check_text(record%metadata%get('event'), 'Small Town', 'event')
      call check_text(record%metadata%get('date'), '2016-02-03T04:05:06', 'date')
      call check_text(record%metadata%get('network'), 'XX', 'network')
      call check_text(record%metadata%get('station'), 'ABCD', 'station')
      call check_text(record%metadata%get('station name'), 'Hill - Old Mill', 'name of the station')
      call check_text(record%metadata%get('component'), '340 deg', 'component')
      call check_text(record%metadata%get('magnitude'), '5.500000', 'moment magnitude before the local one')
      call check_text(record%metadata%get('latitude'), '40.500000', 'latitude')
      call check_text(record%metadata%get('longitude'), '-120.250000', 'longitude')
      call check_text(record%metadata%get('processing'), &
         & 'corrected acceleration; Record filtered below 0.10 Hz', 'processing')
      call check_text(record%metadata%get('elevation'), '', 'elevation that is not known')
      call check_text(record%metadata%get('comments'), 'sample remark sample remark', 'comments')
      call check_motion('crlf.v2c', with_crlf(cosmos(file)), 0.001_wp, 0.005_wp, record)
      file = cosmos_type(format='(1E15.6)', comment='|<SCNL>EFG.HNE.YY.--  <AUTH> 2016')
      call check_motion('column.v2c', cosmos(file), 0.001_wp, 0.005_wp, record)
      call check_text(record%metadata%get('network'), 'YY', 'network of the comment')
      call check_text(record%metadata%get('station'), 'EFG', 'station of the comment')
      call check_text(record%metadata%get('component'), 'HNE', 'component of the comment')
      call check_motion('wide.v2c', cosmos(cosmos_type(format='(3F11.5)')), 0.001_wp, 0.005_wp, record)
      call check_motion('no_comment.v2c', cosmos(cosmos_type(comments=0)), 0.001_wp, 0.005_wp, record)
      call check_motion('no_length.v2c', cosmos(cosmos_type(length=-999.0_wp)), 0.001_wp, 0.005_wp, record)
      call check_motion('no_peak.v2c', cosmos(cosmos_type(peak=-999.0_wp)), 0.001_wp, 0.005_wp, record)
      call check_motion('mark.v2c', cosmos(cosmos_type(marks='is unknown/unspecified:   -777, -777.0', &
         & peak=-777.0_wp)), 0.001_wp, 0.005_wp, record)
      call check_motion('old_ending.v1', cosmos(cosmos_type(ending='/&  ---  End of data')), 0.001_wp, 0.005_wp, record)
      ! A raw record states its step in seconds
      call check_motion('raw_step.v0', cosmos(cosmos_type(stage=0, step=-999.0_wp, raw_step=0.01_wp, length=0.13_wp)), &
         & 0.001_wp, 0.01_wp, record)
      call read_record(scratch//'/plain.v2c', record, error, units='gal', dt=0.005_wp)
      call check_ok(error, 'units and step that agree')
      call read_record(scratch//'/plain.v2c', record, error, format='cosmos')
      call check_ok(error, 'format that is given')
   end subroutine test_cosmos

   !> COSMOS: units by code, by words, and counts
   subroutine test_cosmos_units()
      type(record_type) :: record
      type(error_type), allocatable :: error
      type(cosmos_type) :: file
      real(wp) :: mean, scale
      integer :: i

      call suite('cosmos units')
      file = cosmos_type(unit_code=2, units='g(02)', multiple=0.001_wp, peak=-1.2346_wp)
      call check_motion('g.v2c', cosmos(file), 0.001_wp*gravity, 0.005_wp, record)
      file = cosmos_type(unit_code=10, units='gal (10)')
      call check_motion('gal.v2c', cosmos(file), 0.001_wp, 0.005_wp, record)
      file = cosmos_type(unit_code=11, units='mg(11)')
      call check_motion('mg.v2c', cosmos(file), 0.0001_wp*gravity, 0.005_wp, record)
      file = cosmos_type(unit_code=12, units='micro g(12)')
      call check_motion('micro_g.v2c', cosmos(file), 1.0e-7_wp*gravity, 0.005_wp, record)
      file = cosmos_type(unit_code=7, units='in/sec2(07)')
      call check_motion('inch.v2c', cosmos(file), 0.00254_wp, 0.005_wp, record)
      ! Code in one place only, or nowhere
      file = cosmos_type(units='cm/s^2')
      call check_motion('header_code.v2c', cosmos(file), 0.001_wp, 0.005_wp, record)
      file = cosmos_type(unit_code=-999)
      call check_motion('line_code.v2c', cosmos(file), 0.001_wp, 0.005_wp, record)
      file = cosmos_type(unit_code=-999, units='mm/s^2')
      call check_motion('words.v2c', cosmos(file), 0.0001_wp, 0.005_wp, record)
      ! Counts: least bit 2 microvolt, 4 V/g, gain 0.5; the mean goes
      file = cosmos_type(title='Raw acceleration counts   (Format v01.20', stage=0, unit_code=50, units='counts (50)', &
         & format='(10I8)', multiple=10.0_wp, bit=2.0_wp, sensitivity=4.0_wp, gain=0.5_wp, peak=777.0_wp)
      call write_file('counts.v0c', cosmos(file))
      call read_record(scratch//'/counts.v0c', record, error)
      call check_ok(error, 'counts')
      if (.not. allocated(error)) then
         mean = sum(10.0_wp*motion)/13.0_wp
         scale = 1.0e-6_wp*gravity
         do i = 1, size(motion)
            call check_close(record%acceleration(i), scale*(10.0_wp*motion(i) - mean), 1.0e-12_wp, 'count '//to_text(i))
         end do
         call check_text(record%metadata%get('processing'), 'raw acceleration counts; Record filtered below 0.10 Hz'// &
            & '; mean of '//to_text(anint(mean))//' counts removed', 'processing')
      end if
      file%sensitivity = -999.0_wp
      call check_bad(cosmos(file), ': line 49: units are counts: the table of reals must state the least bit')
      call check_bad(cosmos(cosmos_type(units='cm/sec(05)', unit_code=5)), &
         & ': line 49: units = ''cm/sec'', code 5: must be units of acceleration')
      call check_bad(cosmos(cosmos_type(units='cm/sec2(04)', unit_code=2)), &
         & ': line 49: units of code 4: the table of integers states code 2')
      call check_bad(cosmos(cosmos_type(units='g', unit_code=4)), ': line 49: units = ''g'': their code 4')
      call check_bad(cosmos(cosmos_type(units='furlongs', unit_code=-999)), ': units = ''furlongs'': must be one of')
      call check_bad(cosmos(cosmos_type(units=' ', unit_code=-999)), ': the file does not state its units')
   end subroutine test_cosmos_units

   !> COSMOS: several records in a file
   subroutine test_cosmos_records()
      type(record_type), allocatable :: records(:)
      type(record_type) :: record
      type(error_type), allocatable :: error
      type(cosmos_type) :: velocity, up

      call suite('cosmos records')
      velocity = cosmos_type(title='Velocity data             (Format v01.20', quantity='velocity', quantity_code=2, &
         & units='cm/sec(05)', unit_code=5)
      up = cosmos_type(channel='Sta Cha:  2: Up      (Rcrdr Chan  2)', step=10.0_wp, length=0.13_wp)
      call write_file('three.v2c', cosmos(cosmos_type())//cosmos(velocity)//cosmos(up))
      call read_records(scratch//'/three.v2c', records, error)
      call check_ok(error, 'acceleration, velocity, acceleration')
      if (.not. allocated(error)) then
         call check(size(records) == 2, 'two records')
         call check_text(records(1)%name, 'three.340_deg', 'name 1')
         call check_text(records(2)%name, 'three.Up', 'name 2')
         call check_close(records(1)%dt, 0.005_wp, 1.0e-14_wp, 'dt 1')
         call check_close(records(2)%dt, 0.01_wp, 1.0e-14_wp, 'dt 2')
      end if
      call read_record(scratch//'/three.v2c', record, error)
      call check_error(error, 'three.v2c: the file has 2 channels: channel must be one of ''340 deg'', ''Up''', &
         & 'no channel')
      call read_record(scratch//'/three.v2c', record, error, channel='up')
      call check_ok(error, 'channel Up')
      velocity%ending = ''
      call check_bad(cosmos(cosmos_type())//cosmos(velocity)//cosmos(up), &
         & ': line 103: the record that begins in line 53 is cut off: must end with End-of-data')
      call check_bad(cosmos(velocity), ': line 49: quantity = ''velocity'', code 2: must be acceleration, code 1')
      call check_bad(cosmos(cosmos_type(quantity_code=2)), ', code 2: must be acceleration, code 1')
      call check_bad(cosmos(cosmos_type(quantity='displacement')), 'quantity = ''displacement'', code 1: must be')
      call check_bad(cosmos(cosmos_type())//cosmos(cosmos_type(count='14')), ': line 103: value 14 of 14')
   end subroutine test_cosmos_records

   !> COSMOS: what is wrong
   subroutine test_cosmos_errors()
      character(len=:), allocatable :: content
      integer :: at

      call suite('cosmos errors')
      call check_bad(cosmos(cosmos_type(count='14')), ': line 51: value 14 of 14 = ''''')
      call check_bad(cosmos(cosmos_type(count='10')), ': line 51: text after value 10 of 10')
      call check_bad(cosmos(cosmos_type(count='8')), ': line 51: after the 8 values that the header states')
      call check_bad(cosmos(cosmos_type(count='99', ending='')), 'value 14 of 99')
      call check_bad(cosmos(cosmos_type(ending='')), ': line 52: after the 13 values that the header states')
      call check_bad(cosmos(cosmos_type(count='0')), ': line 49: ''0 acceleration pts')
      call check_bad(cosmos(cosmos_type(count='many')), ': must begin with the number of values')
      call check_bad(cosmos(cosmos_type(format='(free)')), ': line 49: format ''(free)'': must be a Fortran format')
      call check_bad(cosmos(cosmos_type(step=-999.0_wp)), ': line 38: time step (number 62) = '''': must be positive')
      call check_bad(cosmos(cosmos_type(step=0.0_wp)), ': must be positive')
      call check_bad(cosmos(cosmos_type(step=10.0_wp)), &
         & ': line 38: length of the record (number 63) = 0.065 s: 13 values at 0.01 s')
      call check_bad(cosmos(cosmos_type(peak=100.0_wp)), ': line 38: peak value 100: the largest value is 123.46')
      call check_bad(cosmos(cosmos_type(text_lines='with 12 text lines)')), ': line 13: ')
      call check_bad(cosmos(cosmos_type(text_lines='with many text lines)')), ': must state the number of text lines')
      call check_bad(cosmos(cosmos_type(marks='is unknown/unspecified:   -999, -123.45')), &
         & ': line 50: value 2 of 13 is missing: -123.45 is the mark for no value')
      content = cosmos(cosmos_type())
      at = index(content, '| sample remark')
      call check_bad(content(:at - 1)//content(at + 16:), ': line 46: number of comments = 2: 1 lines begin with |')
      at = index(content, ' 100 Real')
      call check_bad(content(:at)//'x'//content(at + 2:), ': must state number and format of the real-header values')
      at = index(content, '  13 acceleration') - 1
      call check_bad(content(:at), ': line 49: '''': must state number, units and format of the values')
      call check_bad(content(:index(content, lf)), ': line 1: ''''')
   end subroutine test_cosmos_errors

   !> CSMIP: channels, values, metadata
   subroutine test_csmip()
      type(record_type), allocatable :: records(:)
      type(record_type) :: record
      character(len=:), allocatable :: content
      type(error_type), allocatable :: error
      character(len=*), parameter :: old = '.020 SEC.  (UNITS: CM/SEC/SEC)'

      call suite('csmip')
      call check_motion('one.V2', csmip('90 DEG', '13', old, '(8F10.3)', 10.0_wp), 0.1_wp, 0.02_wp, record)
      call check_text(record%metadata%get('format'), 'csmip', 'format')
      call check_text(record%metadata%get('event'), 'SMALL TOWN EARTHQUAKE', 'event')
      call check_text(record%metadata%get('date'), '1983-05-02T23:42:38.5', 'date')
      call check_text(record%metadata%get('station'), '99999', 'station')
      call check_text(record%metadata%get('station name'), 'OLD MILL', 'name of the station')
      call check_text(record%metadata%get('component'), '90 DEG', 'component')
      call check_text(record%metadata%get('magnitude'), '6.5', 'magnitude')
      call check_text(record%metadata%get('latitude'), '35.500', 'latitude')
      call check_text(record%metadata%get('longitude'), '-120.250', 'longitude')
      call check_text(record%metadata%get('processing'), 'corrected; filtered WITH RAMPS AT .05- .10', 'processing')
      call check_text(record%metadata%get('network'), '', 'network, which the file does not state')
      content = csmip('Up', '13', '.005 sec, in cm/sec2. (5f11.6)', '(5f11.6)', 0.1_wp)
      call check_bad(content, 'duration 0.26 s: count and time step make 0.065 s')
      call check_motion('fine.v2', replaced(content, '.260', '.065'), 0.001_wp, 0.005_wp, record)
      call write_file('three.V2', with_crlf(csmip('90 DEG', '13', old, '(8F10.3)', 10.0_wp)// &
         & csmip('UP', '12', old, '(8F10.3)', 10.0_wp)//csmip('0 DEG', '13', old, '(8F10.3)', -10.0_wp))// &
         & repeat(achar(26), 50))
      call read_records(scratch//'/three.V2', records, error)
      call check_ok(error, 'three channels')
      if (.not. allocated(error)) then
         call check(size(records) == 3, 'three records')
         call check_text(records(2)%name, 'three.UP', 'name 2')
         call check(size(records(1)%acceleration) == 13 .and. size(records(2)%acceleration) == 12, 'counts')
         call check_close(records(3)%acceleration(13), 0.25_wp, 1.0e-14_wp, 'last value of channel 3')
      end if
      call read_record(scratch//'/three.V2', record, error, channel='3')
      call check_ok(error, 'channel 3')
      call check_text(record%metadata%get('component'), '0 DEG', 'component of channel 3')
   end subroutine test_csmip

   !> CSMIP without an origin: the day of the earthquake is that of the local time, else that on which the record begins
   subroutine test_csmip_days()
      character(len=*), parameter :: step = '.020 SEC.  (UNITS: CM/SEC/SEC)'
      character(len=*), parameter :: time = 'MAY 2, 1983 16:42 PDT                   (ORIGIN(XYZ): 05/02/83, 23:42:38.5 UTC)'
      character(len=*), parameter :: trigger = 'TRIGGER TIME: 05/02/83, 16:42:48.2 PDT'
      character(len=:), allocatable :: known, none

      call suite('csmip days')
      known = csmip('90 DEG', '13', step, '(8F10.3)', 10.0_wp)
      none = replaced(known, time, 'PRELIMINARY PROCESSING       (ORIGIN: TO BE DETERMINED)')
      call check_day(replaced(known, time, 'APR 7, 1974 03:10 PST  (ORIGIN: UNKNOWN)'), 'APR 7, 1974 03:10 PST', '1974-04-07')
      call check_day(replaced(none, 'SMALL TOWN EARTHQUAKE'//achar(10), 'RCRD OF WED JUN 9, 1993 01:02:03.0 PDT'//achar(10)), &
         & 'recording', '1993-06-09')
      call check_day(none, 'trigger', '1983-05-02')
      call check_day(replaced(none, trigger, 'START TIME: 11/30/07, 09:20:33.0 UTC (GPS)'), 'start', '2007-11-30')
      call check_day(replaced(none, trigger, 'START TIME: 7/09/1999, 09:20:33.0 UTC'), 'start, four figures', '1999-07-09')
      call check_day(replaced(none, trigger, 'TRIGGER TIME: UNKNOWN'), 'none', '')
   end subroutine test_csmip_days

   !> The day of a CSMIP file
   subroutine check_day(content, what, day)
      character(len=*), intent(in) :: content, what, day
      type(record_type) :: record
      character(len=:), allocatable :: date

      call check_motion('day.V2', content, 0.1_wp, 0.02_wp, record)
      date = record%metadata%get('date')
      call check_text(date(:min(10, len(date))), day, what)
   end subroutine check_day

   !> CSMIP: what is wrong
   subroutine test_csmip_errors()
      character(len=*), parameter :: old = '.020 SEC.  (UNITS: CM/SEC/SEC)', format = '(8F10.3)'
      character(len=:), allocatable :: content

      call suite('csmip errors')
      call check_bad(csmip('UP', '14', old, format, 10.0_wp), ': line 48: value 14 of 14 = ''''')
      call check_bad(csmip('UP', '10', old, format, 1.0_wp, cut=.false.), ': line 48: text after value 10 of 10')
      call check_bad(csmip('UP', '8', old, format, 1.0_wp, cut=.false.), &
         & ': line 48: after the 8 values that the header states')
      call check_bad(csmip('UP', '17', old, format, 10.0_wp), ': line 48: value 14 of 17')
      call check_bad(csmip('UP', 'few', old, format, 10.0_wp), ': line 46: ''FEW POINTS')
      call check_bad(csmip('UP', '13', '.000 SEC.  (UNITS: CM/SEC/SEC)', format, 10.0_wp), 'both positive')
      call check_bad(csmip('UP', '13', '.02 SEC.  (UNITS: CM/SEC)', format, 10.0_wp), 'units = ''CM/SEC'': must be one')
      call check_bad(csmip('UP', '13', '.02 SEC.', format, 10.0_wp), ': the file does not state its units')
      call check_bad(csmip('UP', '13', '.02 sec, in cm/sec2. (bad)', format, 10.0_wp), &
         & ': line 46: format ''(bad)'': must be a Fortran format')
      call check_bad(csmip('UP', '13', '.02 SEC. (UNITS: G)', format, 10.0_wp), ': line 18: peak value -12346')
      content = csmip('UP', '13', old, format, 10.0_wp)
      call check_bad(content(:index(content, '   13 POINTS OF ACCEL DATA') - 1), &
         & ': line 1: no line POINTS OF ACCEL DATA')
      call check_bad(content(:index(content, '   13 POINTS OF VELOC') - 30), ': line 48: ')
      call check_bad(content(:index(content, '   13 POINTS OF VELOC') - 1), ': line 48: the channel ends with its acc')
      call check_bad(content(:index(content, '   13 POINTS OF DISPL') - 50), &
         & ': line 50: the channel ends within the 13 values that line 49 states')
      call check_bad(content(:index(content, '/&') - 60)//lf//content, &
         & ': line 53: the channel ends within the 13 values that line 52 states')
      call check_bad(replaced(content, '/&', '??'), ': line 55: after the 13 values that the header states')
      call check_bad(content//content(:200), ': line 56: no line POINTS OF ACCEL DATA')
   end subroutine test_csmip_errors

   !> GeoNet: components, values, metadata
   subroutine test_geonet()
      type(record_type), allocatable :: records(:)
      type(record_type) :: record
      type(error_type), allocatable :: error
      character(len=:), allocatable :: content

      call suite('geonet')
      call check_motion('one.V2A', geonet('S16W', 13, 10.0_wp), 0.01_wp, 0.02_wp, record)
      call check_text(record%metadata%get('format'), 'geonet', 'format')
      call check_text(record%metadata%get('event'), '20180212T211554Z 40.06S 176.55E', 'no name of the event: its origin')
      call check_text(record%metadata%get('epicentre'), 'Epicentre 40 03 27S 176 32 45E Dist 13km M 4.17', 'epicentre')
      call check_text(record%metadata%get('date'), '2018-02-12T21:15:54.0', 'date')
      call check_text(record%metadata%get('station'), 'ABCD', 'station')
      call check_text(record%metadata%get('station name'), 'Small Town Hall', 'name of the station')
      call check_text(record%metadata%get('component'), 'S16W', 'component')
      call check_text(record%metadata%get('magnitude'), '4.17', 'magnitude')
      call check_text(record%metadata%get('latitude'), '-39.944', 'latitude')
      call check_text(record%metadata%get('longitude'), '176.584', 'longitude')
      call check_text(record%metadata%get('processing'), 'corrected; Band-pass filter bands are .10-.25 Hz', &
         & 'processing')
      call write_file('three.V2A', with_crlf(geonet('S16W', 13, 10.0_wp)//geonet('S74E', 10, 1.0_wp)// &
         & geonet('Up', 13, -10.0_wp)))
      call read_records(scratch//'/three.V2A', records, error)
      call check_ok(error, 'three components')
      if (.not. allocated(error)) then
         call check(size(records) == 3, 'three records')
         call check_text(records(2)%name, 'three.S74E', 'name 2')
         call check(size(records(2)%acceleration) == 10, 'ten values')
         call check_close(records(2)%acceleration(10), -1.0_wp, 1.0e-14_wp, 'last value of component 2')
         call check_close(records(3)%acceleration(13), 0.025_wp, 1.0e-14_wp, 'last value of component 3')
      end if
      call read_record(scratch//'/three.V2A', record, error, channel='s74e')
      call check_ok(error, 'component S74E')
      content = geonet('Up', 13, 10.0_wp)
      call check_motion('north.V2A', replaced(replaced(content, '38S', '38N'), '04E', '04W'), 0.01_wp, 0.02_wp, record)
      call check_text(record%metadata%get('latitude'), '39.944', 'north')
      call check_text(record%metadata%get('longitude'), '-176.584', 'west')
      call check_motion('acceleration.V2A', geonet('Up', 13, 10.0_wp, others=0), 0.01_wp, 0.02_wp, record)
   end subroutine test_geonet

   !> GeoNet: what is wrong
   subroutine test_geonet_errors()
      character(len=:), allocatable :: content

      call suite('geonet errors')
      content = geonet('Up', 13, 10.0_wp)
      call check_bad('Uncorrected'//content(10:), ': must be a Corrected accelerogram')
      call check_bad(replaced(content, 'points    13', 'points    12'), &
         & ': line 10: ''Number of points 12 Duration 0.24 sec'': the table of integers states 13 accelerations')
      call check_bad(replaced(content, '      13      13      13', '      13      14      13'), ': value 14 of 14')
      call check_bad(replaced(content, '      13      13      13', '       x      13      13'), &
         & ': line 20: number of values = '''': must be a positive integer')
      call check_bad(replaced(content, '      13      13      13', '99999999      13      13'), &
         & 'the values must be there')
      call check_bad(replaced(content, 'at 0.020 sec', 'at 0.010 sec'), &
         & ': line 11: ''Instrument corrected data at 0.010 sec intervals'': the table of reals states a time step')
      call check_bad(replaced(content, '  0.0050  0.0200', '  0.0050  0.0000'), &
         & ': line 23: time step = ''0.0000'': must be positive')
      call check_bad(replaced(content, '-12346.0 mm/s/s', '-12046.0 mm/s/s'), ': line 14: peak value -12046')
      call check_bad(replaced(content, 'mm/s/s at', 'mm/s at'), 'units = ''mm/s'': must be one of')
      call check_bad(content(:len(content) - 60), ': line 31: value 7 of 13')
      call check_bad(content//'one more line'//lf, ': line 33: ''one more line'': must be a Corrected accelerogram')
      call check_bad(content//content(:500), ': line ')
   end subroutine test_geonet_errors

   !> SMC: values, metadata
   subroutine test_smc()
      type(record_type) :: record
      character(len=*), parameter :: title = '2 CORRECTED ACCELEROGRAM'
      character(len=:), allocatable :: content

      call suite('smc')
      call check_motion('one.smc', smc(title, 13, 2), 0.01_wp, 0.005_wp, record)
      call check_text(record%metadata%get('format'), 'smc', 'format')
      call check_text(record%metadata%get('event'), 'Small Town, CA', 'event')
      call check_text(record%metadata%get('date'), '1989-10-18T00:04', 'date')
      call check_text(record%metadata%get('station'), 'A020A', 'station')
      call check_text(record%metadata%get('station name'), 'Old Mill #2', 'name of the station')
      call check_text(record%metadata%get('network'), 'USGS', 'network')
      call check_text(record%metadata%get('component'), '133', 'component')
      call check_text(record%metadata%get('magnitude'), '7.1', 'magnitude')
      call check_text(record%metadata%get('latitude'), '37.52', 'latitude')
      call check_text(record%metadata%get('longitude'), '-122.25', 'longitude')
      call check_text(record%metadata%get('event longitude'), '', 'longitude that is missing')
      call check_text(record%metadata%get('azimuth'), '133', 'azimuth')
      call check_text(record%metadata%get('inclination'), '', 'inclination that is missing')
      call check_text(record%metadata%get('processing'), 'corrected accelerogram', 'processing')
      call check_text(record%metadata%get('comments'), 'remark remark', 'comments')
      call check_motion('crlf.smc', with_crlf(smc(title, 13, 0)), 0.01_wp, 0.005_wp, record)
      call check_motion('raw.smc', smc('1 UNCORRECTED ACCELEROGRAM', 13, 1), 0.01_wp, 0.005_wp, record)
      call check_motion('wide.smc', smc(title, 13, 1, digits=8), 0.01_wp, 0.005_wp, record)
      ! A peak that is missing is not looked at
      content = smc(title, 13, 1)
      call check_motion('no_peak.smc', replaced(content, ' -0.1234600E+04', '  0.1700000E+39'), 0.01_wp, 0.005_wp, &
         & record)
   end subroutine test_smc

   !> SMC: what is wrong
   subroutine test_smc_errors()
      character(len=*), parameter :: title = '2 CORRECTED ACCELEROGRAM'
      character(len=:), allocatable :: content

      call suite('smc errors')
      content = smc(title, 13, 2)
      call check_bad(smc('3 VELOCITY', 13, 1), ': line 1: ''3 VELOCITY'': must be an ACCELEROGRAM')
      call check_bad(smc('5 RESPONSE SPECTRA', 13, 1), ': must be an ACCELEROGRAM')
      call check_bad(smc(title, 14, 2), ': line 31: value 14 of 14 = ''''')
      call check_bad(smc(title, 10, 2), ': line 31: text after value 10 of 10')
      call check_bad(smc(title, 8, 2), ': line 31: text after the 8 values that the header states')
      call check_bad(smc(title, 17, 2), ': line 31: value 14 of 17')
      call check_bad(smc(title, -32768, 2), ': line 14: number of values = '''': must be a positive integer')
      call check_bad(replaced(content, '|remark'//lf, ''), &
         & ': line 13: number of comments = ''2'': 1 lines begin with |')
      call check_bad(replaced(content, '  0.2000000E+03', '  0.1700000E+39'), &
         & ': line 18: values per second = '''': the samples are unevenly spaced')
      call check_bad(replaced(content, ' -0.1234600E+04', ' -0.1334600E+04'), ': line 24: peak value -1334.6')
      call check_bad(replaced(content, ' 9.9900E+1', '1.7000E+38'), &
         & ': line 30: value 4 of 13 is missing: 1.7e38 is the mark for no value')
      call check_bad(replaced(content, '-1.2345E+3', '**********'), ': line 30: value 2 of 13 = ''**********''')
      call check_bad(content(:len(content) - 15), ': line 31: value 13 of 13')
      call check_bad(content(:len(content) - 4), ': line 31: the file is cut off')
      call check_bad(content(:1000), ': line ')
      call check_bad(content//'1.0'//lf, ': line 32: text after the 13 values')
   end subroutine test_smc_errors

   !> Texts that are cut off or damaged give a record or an error that names the file, never anything else
   subroutine test_damaged()
      type(record_type), allocatable :: records(:)
      type(error_type), allocatable :: error
      character(len=:), allocatable :: whole, content
      character(len=*), parameter :: formats(4) = ['cosmos', 'csmip ', 'geonet', 'smc   ']
      integer, parameter :: trials = 2000
      integer :: which, trial, state, at, i, read_well, cut_well
      logical :: right

      call suite('damaged')
      state = 12345
      do which = 1, 4
         select case (which)
         case (1)
            whole = cosmos(cosmos_type())//with_crlf(cosmos(cosmos_type(format='(1E15.6)')))
         case (2)
            whole = csmip('90 DEG', '13', '.02 SEC. (UNITS: CM/SEC/SEC)', '(8F10.3)', 10.0_wp)// &
               & csmip('UP', '13', '.02 sec, in cm/sec2. (5f11.6)', '(5f11.6)', 0.1_wp)
         case (3)
            whole = geonet('S16W', 13, 10.0_wp)//with_crlf(geonet('Up', 12, 10.0_wp))
         case (4)
            whole = smc('2 CORRECTED ACCELEROGRAM', 13, 2)
         end select
         right = .true.
         read_well = 0
         cut_well = 0
         do trial = 1, trials
            if (modulo(trial, 2) == 0) then
               content = whole(:1 + next(state, len(whole) - 1))
            else
               content = whole
               do i = 0, next(state, 3)
                  at = 1 + next(state, len(content))
                  content(at:at) = achar(ieor(iachar(content(at:at)), 2**next(state, 7)))
               end do
            end if
            call write_file('damaged', content)
            call read_records(scratch//'/damaged', records, error, format=trim(formats(which)))
            if (allocated(error)) then
               right = right .and. index(error%message, scratch//'/damaged: ') == 1
               right = right .and. .not. allocated(records)
            else
               read_well = read_well + 1
               if (modulo(trial, 2) == 0) cut_well = cut_well + 1
               do i = 1, size(records)
                  right = right .and. records(i)%dt > 0.0_wp .and. size(records(i)%acceleration) >= 2 .and. &
                     & all(abs(records(i)%acceleration) < 1.0e4_wp)
               end do
            end if
         end do
         call check(right, formats(which)//': a record or an error that names the file')
         call check(read_well > trials/20 .and. read_well < trials - trials/20, &
            & formats(which)//': '//to_text(read_well)//' of '//to_text(trials)//' read')
         ! Velocities and displacements that are cut off, and text after the values, are no loss to CSMIP and COSMOS
         call check(cut_well < trials/5, &
            & formats(which)//': '//to_text(cut_well)//' of '//to_text(trials/2)//' that are cut off read')
      end do
   end subroutine test_damaged

   !> A number from 0 to n - 1 (Lehmer's generator, multiplier 16807)
   function next(state, n)
      integer, intent(inout) :: state
      integer, intent(in) :: n
      integer :: next

      integer, parameter :: long = selected_int_kind(18)

      state = int(modulo(16807_long*int(state, long), 2147483647_long))
      next = modulo(state/7, n)
   end function next

   !> Recorded files, where there are any: peaks and steps as in their manifest, counts, first and last values
   subroutine test_samples()
      type(csv_table_type) :: table
      type(csv_row_type) :: row
      type(record_type) :: record
      type(error_type), allocatable :: error
      character(len=:), allocatable :: folder, file, channel
      real(wp) :: number
      integer :: length, tested
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
         if (index(file, 'formats/cosmos/') + index(file, 'formats/csmip_v2/') + index(file, 'formats/geonet/') + &
            & index(file, 'formats/smc/') == 0) cycle
         tested = tested + 1
         ! Components of one file have rows of their own: file (channel 1), file (S16W)
         channel = before(before(after(file, '('), ')'), 'channel')
         if (index(file, '(channel') > 0) channel = before(after(file, '(channel'), ')')
         call read_record(folder//'/'//before(file, ' ('), record, error, channel=channel)
         call check_ok(error, file)
         if (allocated(error)) cycle
         call table%get_real(row, table%column('pga_m_s2'), number, error)
         call check_close(record%pga(), number, 1.0e-3_wp, 'PGA of '//file)
         call table%get_real(row, table%column('dt_s'), number, error)
         call check_close(record%dt, number, 1.0e-9_wp, 'dt of '//file)
         call table%get_real(row, table%column('npts'), number, error)
         call check(size(record%acceleration) == nint(number), 'number of values of '//file)
         if (index(file, '.V2c') > 0) then
            call check_ends(record, 3.437285e-6_wp, 2.412614e-6_wp)
            call check_text(record%metadata%get('event'), 'Point MacKenzie Earthquake', 'event')
            call check_text(record%metadata%get('date'), '2018-11-30T17:29:29', 'date')
            call check_text(record%metadata%get('station'), 'BMR', 'station')
            call check_text(record%metadata%get('network'), 'AK', 'network')
            call check_text(record%metadata%get('component'), 'BNZ', 'component')
            call check_text(record%metadata%get('magnitude'), '7.000000', 'magnitude')
         else if (index(file, '.v1') > 0) then
            call check_ends(record, -0.00001e-2_wp, -0.00003e-2_wp)
            call check_text(record%metadata%get('station'), 'J2236', 'station')
            call check_text(record%metadata%get('station name'), 'Yucaipa - Bryant & Oak Glen', 'name of the station')
            call check_text(record%metadata%get('component'), '340 deg', 'component')
         else if (index(file, '(channel 1)') > 0) then
            call check_ends(record, -3.038e-2_wp, -1.308e-2_wp)
            call check_text(record%metadata%get('station'), '36456', 'station')
            call check_text(record%metadata%get('magnitude'), '6.5', 'magnitude')
            call check_text(record%metadata%get('component'), '90 DEG', 'component')
            call check_text(record%metadata%get('longitude'), '-120.458', 'longitude')
         else if (index(file, '(channel 3)') > 0) then
            call check_ends(record, 1.527e-2_wp, -4.292e-2_wp)
            call check_text(record%metadata%get('component'), '0 DEG', 'component')
         else if (index(file, '(S74E)') > 0) then
            call check_ends(record, 0.0_wp, 0.0_wp)
            call check_text(record%metadata%get('station'), 'WPWS', 'station')
            call check_text(record%metadata%get('magnitude'), '4.17', 'magnitude')
            call check_text(record%metadata%get('latitude'), '-39.944', 'latitude')
         else if (index(file, '.smc') > 0) then
            call check_ends(record, 12.714e-2_wp, 7.7033e-2_wp)
            call check_text(record%metadata%get('event'), 'Loma Prieta, CA', 'event')
            call check_text(record%metadata%get('station name'), 'APEEL Array #2 - Redwood City', 'name of the station')
            call check_text(record%metadata%get('component'), '133', 'component')
         end if
      end do
      call check(tested == 9, to_text(tested)//' components tested')
   end subroutine test_samples

   !> First and last value
   subroutine check_ends(record, first, last)
      type(record_type), intent(in) :: record
      real(wp), intent(in) :: first, last

      call check_close(record%acceleration(1), first, 1.0e-12_wp, 'first value of '//record%name)
      call check_close(record%acceleration(size(record%acceleration)), last, 1.0e-12_wp, 'last value of '//record%name)
   end subroutine check_ends

   !> A text with one channel that holds the motion
   subroutine check_motion(file, content, factor, dt, record)
      character(len=*), intent(in) :: file, content
      real(wp), intent(in) :: factor, dt
      type(record_type), intent(out) :: record
      type(error_type), allocatable :: error
      integer :: i

      call write_file(file, content)
      call read_record(scratch//'/'//file, record, error)
      call check_ok(error, file)
      if (allocated(error)) return
      call check_close(record%dt, dt, 1.0e-14_wp, file//': dt')
      call check(size(record%acceleration) == size(motion), file//': '//to_text(size(record%acceleration))//' values')
      do i = 1, min(size(record%acceleration), size(motion))
         call check_close(record%acceleration(i), factor*motion(i), 1.0e-13_wp, file//': value '//to_text(i))
      end do
   end subroutine check_motion

   !> A text with an error
   subroutine check_bad(content, part)
      character(len=*), intent(in) :: content, part
      type(record_type), allocatable :: records(:)
      type(error_type), allocatable :: error

      call write_file('bad', content)
      call read_records(scratch//'/bad', records, error)
      call check_error(error, part, 'bad file')
      if (allocated(error)) call check(index(error%message, scratch//'/bad: ') == 1, error%message)
   end subroutine check_bad

   !> A text with another part in the place of one, once
   function replaced(content, part, by)
      character(len=*), intent(in) :: content, part, by
      character(len=:), allocatable :: replaced
      integer :: at

      at = index(content, part)
      call check(at > 0, 'the text to change holds '//part)
      replaced = content(:at - 1)//by//content(at + len(part):)
   end function replaced

   !> Write a small file, byte by byte
   subroutine write_file(file, content)
      character(len=*), intent(in) :: file, content
      integer :: unit

      open (newunit=unit, file=scratch//'/'//file, access='stream', form='unformatted', action='write', &
         & status='replace')
      write (unit) content
      close (unit)
   end subroutine write_file

end program test_archives
