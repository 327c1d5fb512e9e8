!> Formats of accelerogram files: channels, metadata, what is refused, and damaged files.
program test_formats
   use checks, only : check, check_close, check_error, check_ok, check_text, finish, skip, suite
   use dondolo_catalogue, only : read_catalogue
   use dondolo_csv, only : csv_table_type, read_csv
   use dondolo_dates, only : iso_date, iso_time
   use dondolo_error, only : error_type
   use dondolo_kinds, only : wp
   use dondolo_lines, only : lines_type
   use dondolo_metadata, only : metadata_type
   use dondolo_record, only : largest_acceleration, new_record, record_type
   use dondolo_record_format, only : read_fixed
   use dondolo_record_reader, only : read_record, read_records
   use dondolo_record_table, only : record_problems, record_table
   use dondolo_text, only : to_text
   use dondolo_text_file, only : read_text_file, text_file_type
   implicit none

   character(len=*), parameter :: scratch = 'build/test_formats'
   character(len=*), parameter :: cr = achar(13), lf = achar(10)
   !> Accelerations of the small files [file's units]
   real(wp), parameter :: small(7) = [0.0_wp, 0.125_wp, -0.25_wp, 0.5_wp, -1.5_wp, 0.75_wp, -0.125_wp]
   !> Gal [m/s2]
   real(wp), parameter :: gal = 0.01_wp

   !> A text of its own length
   type :: sample_type
      !> Content of a file
      character(len=:), allocatable :: content
      !> Format that it is in
      character(len=:), allocatable :: format
   end type sample_type

   call execute_command_line('mkdir -p '//scratch)
   call test_metadata()
   call test_dates()
   call test_fixed()
   call test_columns()
   call test_dyna()
   call test_peer()
   call test_smtk()
   call test_knet()
   call test_cwa()
   call test_asa()
   call test_eqsig()
   call test_format_given()
   call test_catalogue()
   call test_table()
   call test_damaged()
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
      call check_text(iso_date('19971014', 'dmy'), '1997-10-14', 'digits')
      call check_text(iso_date('2010/11/14', 'dmy'), '2010-11-14', 'year first')
      call check_text(iso_date(' 14/11/2010 ', 'dmy'), '2010-11-14', 'day first')
      call check_text(iso_date('1/2/1990', 'mdy'), '1990-01-02', 'month first')
      call check_text(iso_date('2009-04-06', 'mdy'), '2009-04-06', 'hyphens')
      call check_text(iso_date('14/11/2010', 'mdy'), '14/11/2010', 'no month 14')
      call check_text(iso_date('19971414', 'dmy'), '19971414', 'no month 14 either')
      call check_text(iso_date('autumn 1997', 'dmy'), 'autumn 1997', 'words')
      call check_text(iso_date('1/2/90', 'mdy'), '1/2/90', 'two digits of a year')
      call check_text(iso_date('', 'mdy'), '', 'nothing')
      call check_text(iso_date('2010/11/14/2', 'dmy'), '2010/11/14/2', 'four numbers')
      call check_text(iso_time('152309'), '15:23:09', 'digits')
      call check_text(iso_time('152309.25'), '15:23:09.25', 'decimals')
      call check_text(iso_time('15:23:09.2'), '15:23:09.2', 'colons')
      call check_text(iso_time('0712'), '0712', 'four digits')
      call check_text(iso_time('071240x'), '071240x', 'a letter')
   end subroutine test_dates

   !> Columns of equal width
   subroutine test_fixed()
      real(wp), allocatable :: values(:)
      type(text_file_type) :: text
      type(error_type), allocatable :: error

      call suite('fixed width')
      call write_file('fixed.txt', 'head'//lf//' 1.5-2.25  3.'//cr//lf//'1e-2 -1.0   '//lf//'tail')
      call read_text_file(scratch//'/fixed.txt', text, error)
      call read_fixed(text, 2, 3, 5, 3, values, error)
      call check_error(error, ': line 2: value 1 of 3 = '' 1.5-'': must be a number in column 1 of width 5', 'wrong width')
      call write_file('fixed.txt', 'head'//lf//'  1.5-2.25   3.'//cr//lf//' 1e-2 -1.0   '//lf//'tail')
      call read_text_file(scratch//'/fixed.txt', text, error)
      call read_fixed(text, 2, 5, 5, 3, values, error)
      call check_ok(error, 'touching columns')
      call check(size(values) == 5, 'five')
      call check(all(abs(values - [1.5_wp, -2.25_wp, 3.0_wp, 0.01_wp, -1.0_wp]) < 1.0e-15_wp), 'their values')
      call read_fixed(text, 2, 4, 5, 3, values, error)
      call check_error(error, ': line 3: text after value 4 of 4: '' -1.0   ''', 'one too many')
      call read_fixed(text, 2, 6, 5, 3, values, error)
      call check_error(error, ': line 3: value 6 of 6 = ''   '': must be a number', 'one too few')
      call read_fixed(text, 2, 7, 5, 3, values, error)
      call check_error(error, ': line 3: value 6 of 7', 'a line that is not full')
      call read_fixed(text, 4, 2, 4, 3, values, error)
      call check_error(error, ': line 4: value 1 of 2 = ''tail''', 'a word')
      call read_fixed(text, 2, 2000000000, 5, 3, values, error)
      call check_error(error, 'must be a number', 'a count beyond the file')
      call write_file('fixed.txt', '    1    2')
      call read_text_file(scratch//'/fixed.txt', text, error)
      call read_fixed(text, 1, 4, 5, 2, values, error)
      call check_error(error, ': line 1: the file ends after 2 values: the header states 4', 'end of the file')
   end subroutine test_fixed

   !> Times and several columns
   subroutine test_columns()
      type(record_type), allocatable :: records(:)
      type(record_type) :: record
      type(error_type), allocatable :: error
      character(len=:), allocatable :: file

      call suite('several columns')
      file = scratch//'/three.txt'
      call write_file('three.txt', columns_content('#Station: TLM'//lf//'time (s),N-S (g), "E-W (gal)",V'//lf))
      call read_records(file, records, error, units='g')
      call check_error(error, 'three.txt: units = ''g'': the file states ''gal''', 'units that differ')
      call write_file('three.txt', columns_content('#Station: TLM'//lf//'time (s),N-S (g), "E-W (g)",V'//lf))
      call read_records(file, records, error, units='g')
      call check_ok(error, 'all')
      if (allocated(error)) return
      call check(size(records) == 3, 'three channels')
      call check_text(records(2)%name, 'three.E-W_(g)', 'name')
      call check_text(records(2)%metadata%get('channel'), 'E-W (g)', 'channel')
      call check_text(records(2)%metadata%get('station'), 'TLM', 'station')
      call check_text(records(2)%metadata%get('format'), 'columns', 'format')
      call check_text(records(2)%metadata%get('quantity'), 'acceleration', 'quantity')
      call check_values(records(1), 9.80665_wp, 'column 2')
      call check_values(records(2), -2*9.80665_wp, 'column 3')
      call read_records(file, records, error)
      call check_error(error, 'three.txt: the file does not state its units', 'units of one are missing')
      call read_record(file, record, error, channel='n-s (g)')
      call check_ok(error, 'by name, units of the title')
      call check_values(record, 9.80665_wp, 'by name')
      call write_file('three.txt', columns_content(''))
      call read_record(file, record, error, units='g')
      call check_error(error, 'three.txt: the file holds 3 channels: channel must be one of ''column 2'', ''column 3'', '// &
         & '''column 4''', 'no channel')
      call read_record(file, record, error, units='g', channel='column 3')
      call check_values(record, -2*9.80665_wp, 'column 3')
      call read_record(file, record, error, units='g', channel=' 2 ')
      call check_values(record, -2*9.80665_wp, 'second channel')
      call check_text(record%name, 'three.column_3', 'name')
      call read_record(file, record, error, units='g', channel='4')
      call check_error(error, 'three.txt: channel = ''4'': must be one of ''column 2'', ''column 3'', ''column 4'', '// &
         & 'or a number from 1 to 3', 'fourth channel')
      call read_record(file, record, error, units='g', channel='up')
      call check_error(error, 'channel = ''up'': must be one of', 'no such name')
      call write_file('three.txt', '1'//lf//'2'//lf//'3')
      call read_record(file, record, error, units='g', dt=0.01_wp, channel='1')
      call check_ok(error, 'the only channel')
      call check_text(record%name, 'three', 'its name')
      call read_record(file, record, error, units='g', dt=0.01_wp, channel='2')
      call check_error(error, 'channel = ''2'': must be one of ''1''', 'no other channel')
      call write_file('three.txt', 'a,b (cm/s)'//lf//'0,1'//lf//'0.01,2'//lf)
      call read_record(file, record, error)
      call check_error(error, 'units = ''cm/s'': must be one of', 'velocities by their title')
      call write_file('three.txt', '0'//repeat(' 1', 63)//lf//'1'//repeat(' 1', 63)//lf)
      call read_record(file, record, error)
      call check_error(error, 'the format is not known', 'sixty-four columns')
      call read_record(file, record, error, format='columns')
      call check_error(error, ': line 1: more than 63 columns', 'sixty-four columns')
   end subroutine test_columns

   !> DYNA files
   subroutine test_dyna()
      type(record_type) :: record
      integer :: i

      call suite('DYNA')
      call read_content(dyna_content('EVENT_DATE_YYYYMMDD: 14/11/2010'//lf//'EVENT_TIME_HHMMSS: 230819'//lf// &
         & 'MAGNITUDE_W: '//lf//'MAGNITUDE_L: 5.1'//lf//'STREAM: HNE'), record)
      call check_values(record, gal, 'values')
      call check_metadata(record, 'event', 'EARTHQUAKE')
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
      call check(any([(record%metadata%entries(i)%key == 'units', i=1, record%metadata%count())]), 'units in lower case')
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
      call read_content(replaced(dyna_content('STREAM: HNE'), '-1.500000', ''), record)
      call check_values(record, gal, 'no peak')
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
      call check_refused(replaced(smtk_content(), ': 7', ': 5'), 'line 11: more values than the 5')
      call check_refused(replaced(smtk_content(), ': 7', ': 6'), 'line 11: text after value 6 of 6')
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
      call check_refused(replaced(knet_content('5'), '0.07', '0.08'), 'the file ends after 7 values: the header states 8')
      call check_refused(replaced(knet_content('5'), '0.07', '0.06'), 'more values than the 6')
      call check_refused(replaced(knet_content('5'), '0.07', '1e6'), 'line 12: Duration Time(s) = 1000000: the file is')
      call check_refused(replaced(knet_content('5'), '0.712', '0.731'), 'line 15: peak value 0.731: the largest value is')
   end subroutine test_knet

   !> CWA files
   subroutine test_cwa()
      type(record_type), allocatable :: records(:)
      type(error_type), allocatable :: error
      type(record_type) :: record

      call suite('CWA')
      call write_file('content.dat', cwa_content())
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
      call write_file('content.dat', asa_content('7'))
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
      call check_metadata(records(2), 'samples', '')
      call check_metadata(records(2), 'TIPO DE SUELO', 'ARENA LIMO')
      call write_file('content.dat', asa_content('6'))
      call read_records(scratch//'/content.dat', records, error)
      call check_ok(error, 'one more than stated')
      call check_metadata(records(2), 'samples', '7, of which the header states 6')
      call check_refused(asa_content('5'), '7 rows of values: the header states 5')
      call check_refused(asa_content('8'), '7 rows of values: the header states 8')
      call check_refused(asa_content(''), '7 rows of values: the header states 0')
      call check_refused(replaced(asa_content('7'), '/0.01/0.01', '/0.01/'), 'INTERVALO DE MUESTREO, C1-C6 (s)')
      call check_refused(replaced(asa_content('7'), ': Gal (cm/s/s)', ':'), 'does not state its units')
      call check_refused(replaced(asa_content('7'), 'CANALES                      : 2', 'CANALES: 13'), 'must be at most 12')
      call check_refused(replaced(asa_content('7'), 'DATOS DE ACELERACION', 'DATOS'), 'no line DATOS DE ACELERACION')
   end subroutine test_asa

   !> eqsig files
   subroutine test_eqsig()
      type(record_type) :: record
      type(error_type), allocatable :: error
      character(len=*), parameter :: file = scratch//'/content.dat'

      call suite('eqsig')
      call write_file('content.dat', eqsig_content('7'))
      call read_record(file, record, error, units='m/s2')
      call check_ok(error, 'read')
      call check_values(record, 1.0_wp, 'values')
      call check_metadata(record, 'label', 'a label')
      call check_metadata(record, 'format', 'eqsig')
      call check_refused(eqsig_content('7'), 'the file does not state its units')
      call check_refused(eqsig_content('8'), 'the file ends after 7 values: the header states 8')
      call check_refused(eqsig_content('6'), 'more values than the 6')
   end subroutine test_eqsig

   !> A format that is named
   subroutine test_format_given()
      type(sample_type), allocatable :: all(:)
      type(record_type), allocatable :: records(:)
      type(error_type), allocatable :: error
      integer :: i, k

      call suite('format given')
      call list_contents(all)
      do i = 1, size(all)
         call write_file('content.dat', all(i)%content)
         do k = 1, size(all)
            call read_records(scratch//'/content.dat', records, error, format=all(k)%format)
            if (allocated(error)) then
               if (index(error%message, 'must be given') > 0) call read_records(scratch//'/content.dat', records, error, &
                  & units='g', format=all(k)%format)
            end if
            if (i == k .or. all(i)%format == all(k)%format) then
               call check_ok(error, all(i)%format//' as itself')
            else if (all(i)%format == 'cwa' .and. all(k)%format == 'columns') then
               ! Its header are comments to the other, which knows less of it
               call check(.not. allocated(error), 'cwa as columns')
            else
               call check(allocated(error), all(i)%format//' as '//all(k)%format//' is refused')
            end if
         end do
         call read_records(scratch//'/content.dat', records, error)
         if (allocated(error)) call read_records(scratch//'/content.dat', records, error, units='g')
         call check_ok(error, all(i)%format//' is recognised')
         if (.not. allocated(error)) call check_metadata(records(1), 'format', all(i)%format)
      end do
      call read_records(scratch//'/content.dat', records, error, format='EQSIG', units='g')
      call check_error(error, 'must be the number of values and their step', 'upper case')
      call read_records(scratch//'/content.dat', records, error, format='excel')
      call check_error(error, 'content.dat: format = ''excel'': must be one of ''peer'', ''dyna''', 'no such format')
      call write_file('content.dat', 'SAMPLING_INTERVAL_S: 0.01'//lf//smtk_content())
      call read_records(scratch//'/content.dat', records, error)
      call check_error(error, 'may be in the format ''dyna'', ''smtk'': format must name one of them', 'two formats')
   end subroutine test_format_given

   !> Channels and formats in a catalogue
   subroutine test_catalogue()
      type(record_type), allocatable :: records(:)
      type(error_type), allocatable :: error

      call suite('catalogue')
      call write_file('three.dat', cwa_content())
      call write_file('catalogue.csv', 'file,channel,format'//lf//'three.dat,N,'//lf//'three.dat,3,cwa'//lf)
      call read_catalogue(scratch//'/catalogue.csv', records, error)
      call check_ok(error, 'read')
      if (allocated(error)) return
      call check_text(records(1)%name, 'three.N', 'name 1')
      call check_values(records(2), -gal, 'E')
      call write_file('catalogue.csv', 'file,channel'//lf//'three.dat,N'//lf//'three.dat,'//lf)
      call read_catalogue(scratch//'/catalogue.csv', records, error)
      call check_error(error, 'catalogue.csv: line 3: '//scratch//'/three.dat: the file holds 3 channels', 'no channel')
      call write_file('catalogue.csv', 'file,channel,format'//lf//'three.dat,N,peer'//lf)
      call read_catalogue(scratch//'/catalogue.csv', records, error)
      call check_error(error, 'catalogue.csv: line 2: '//scratch//'/three.dat: line ', 'wrong format')
   end subroutine test_catalogue

   !> The table of records
   subroutine test_table()
      type(record_type) :: records(3)
      type(lines_type) :: table
      type(error_type), allocatable :: error
      real(wp), parameter :: pi = acos(-1.0_wp)
      real(wp) :: wave(401)
      integer :: i

      call suite('table')
      ! Ten waves that grow and decay leave no velocity
      wave = [(cos(0.05_wp*pi*(i - 1))*sin(pi*(i - 1)/400.0_wp)**2, i=1, size(wave))]
      call new_record(records(1), wave, 0.01_wp, 'wave', error)
      call check_text(record_problems(records(1)), '', 'a sound record')
      call new_record(records(2), min(abs(wave), 0.7_wp) + 0.2_wp, 0.01_wp, 'clipped', error)
      call check_text(record_problems(records(2)), 'begins at 22 % of its PGA; ends at 100 % of its PGV; '// &
         & '11 samples in a row at its PGA', 'a record that begins late, drifts and is clipped')
      call new_record(records(3), [0.0_wp, 0.0_wp], 0.01_wp, 'nothing', error)
      call check_text(record_problems(records(3)), 'no motion', 'a record of zeros')
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
      call check_text(table%line(3)%text(65:), '  Friuli, TLM', 'event and station, no escape character')
      call check_text(table%line(4)%text(65:89), '  1976-05-06      begins ', 'date where there is no event')
   end subroutine test_table

   !> Damaged files give a record or an error: DONDOLO_FUZZ says how many, 400 if it is not set
   subroutine test_damaged()
      type(sample_type), allocatable :: all(:)
      type(record_type), allocatable :: records(:)
      type(error_type), allocatable :: error
      character(len=:), allocatable :: content
      character(len=16) :: setting
      integer :: i, k, cases, state, wrong, read_anyway, stat

      call suite('damaged files')
      call get_environment_variable('DONDOLO_FUZZ', setting)
      read (setting, *, iostat=stat) cases
      if (stat /= 0) cases = 400
      call list_contents(all)
      state = 20241105
      wrong = 0
      read_anyway = 0
      do i = 1, cases
         content = damaged(all(modulo(i, size(all)) + 1)%content, all(modulo(3*i, size(all)) + 1)%content, state)
         call write_file('damaged.dat', content)
         do k = 0, size(all)
            if (k == 0) then
               call read_records(scratch//'/damaged.dat', records, error)
               if (allocated(error)) then
                  if (index(error%message, 'must be given') > 0) call read_records(scratch//'/damaged.dat', records, &
                     & error, 0.01_wp, 'm/s2')
               end if
            else
               call read_records(scratch//'/damaged.dat', records, error, units='g', format=all(k)%format)
            end if
            if (is_sound(records, error)) then
               if (.not. allocated(error)) read_anyway = read_anyway + 1
               cycle
            end if
            wrong = wrong + 1
            call write_file('wrong.dat', content)
         end do
      end do
      call check(wrong == 0, to_text(wrong)//' readings of '//to_text(cases)//' damaged files give no record and no error')
      call check(read_anyway > cases/20, 'some damaged files can be read: '//to_text(read_anyway))
   end subroutine test_damaged

   !> Either records that can be, or an error that names the file
   function is_sound(records, error)
      type(record_type), allocatable, intent(in) :: records(:)
      type(error_type), allocatable, intent(in) :: error
      logical :: is_sound
      integer :: i

      if (allocated(error)) then
         is_sound = .not. allocated(records) .and. index(error%message, scratch//'/damaged.dat: ') == 1
         return
      end if
      is_sound = allocated(records)
      if (.not. is_sound) return
      is_sound = size(records) > 0
      do i = 1, size(records)
         is_sound = is_sound .and. records(i)%dt > 0.0_wp .and. size(records(i)%acceleration) > 1
         if (is_sound) is_sound = all(abs(records(i)%acceleration) <= largest_acceleration)
      end do
   end function is_sound

   !> Damage a content: cut, flip bits, drop, double, insert, mix with another
   function damaged(content, other, state) result(changed)
      character(len=*), intent(in) :: content, other
      integer, intent(inout) :: state
      character(len=:), allocatable :: changed
      character(len=*), parameter :: odd = '-+.eE*,;:#/() '//achar(9)//lf//cr//achar(0)//char(255)//'0179nN'
      integer :: steps, i, at, length, to

      changed = content
      steps = 1 + random_below(state, 3)
      do i = 1, steps
         if (len(changed) < 2) return
         at = 1 + random_below(state, len(changed))
         length = min(random_below(state, 40), len(changed) - at)
         select case (random_below(state, 9))
         case (0)
            changed = changed(:at)
         case (1)
            changed(at:at) = achar(ieor(iachar(changed(at:at)), ishft(1, random_below(state, 8))))
         case (2)
            changed = changed(:at - 1)//changed(at + length:)
         case (3)
            changed = changed(:at + length)//changed(at:)
         case (4)
            to = 1 + random_below(state, len(odd))
            changed = changed(:at - 1)//odd(to:to)//changed(at:)
         case (5)
            to = 1 + random_below(state, len(odd))
            changed(at:at) = odd(to:to)
         case (6)
            to = min(at, len(other))
            changed = changed(:at)//other(to:)
         case (7)
            changed = changed(:at - 1)//repeat('9', 1 + random_below(state, 25))//changed(at:)
         case (8)
            do to = at, at + length
               changed(to:to) = achar(random_below(state, 256))
            end do
         end select
      end do
   end function damaged

   !> A random integer from 0 to below a bound (Lehmer's generator of Park and Miller, 1988)
   function random_below(state, bound) result(number)
      integer, intent(inout) :: state
      integer, intent(in) :: bound
      integer :: number
      integer, parameter :: long = selected_int_kind(18)

      state = int(modulo(int(state, long)*48271_long, 2147483647_long))
      number = modulo(state/11, bound)
   end function random_below

   !> Recorded files of all formats, where there are any: peaks and steps as in their manifest
   subroutine test_samples()
      character(len=*), parameter :: folders(*) = [character(len=22) :: 'formats/peer_at2/', 'formats/esm_dyna12/', &
         & 'formats/itaca_', 'formats/gem_smtk/', 'formats/knet/', 'formats/cwa/', 'formats/asa_mexico/', &
         & 'formats/multi_column/']
      type(csv_table_type) :: table
      type(record_type) :: record
      type(error_type), allocatable :: error
      character(len=:), allocatable :: folder, file, channel
      real(wp) :: pga, dt, npts
      integer :: row, length, tested, bracket, i
      logical :: exists

      call suite('samples')
      call get_environment_variable('DONDOLO_RECORDS', length=length)
      allocate (character(len=length) :: folder)
      if (length > 0) call get_environment_variable('DONDOLO_RECORDS', folder)
      if (length == 0) folder = '../shared/records'
      inquire (file=folder//'/manifest.csv', exist=exists)
      if (.not. exists) then
         call skip('no recorded accelerograms in '//folder)
         return
      end if
      call read_csv(folder//'/manifest.csv', table, error)
      call check_ok(error, 'manifest')
      if (allocated(error)) return
      tested = 0
      do row = 1, table%rows()
         file = table%get_text(row, table%column('file'))
         if (.not. any([(index(file, trim(folders(i))) == 1, i=1, size(folders))])) cycle
         if (len(table%get_text(row, table%column('pga_m_s2'))) == 0) cycle
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
            call read_record(folder//'/'//file, record, error, units='g', channel=channel)
         else
            call read_record(folder//'/'//file, record, error, channel=channel)
         end if
         call check_ok(error, file)
         if (allocated(error)) cycle
         call check_close(record%dt, dt, 1.0e-6_wp, 'dt of '//file//' '//channel)
         call check_close(record%pga(), pga, 1.0e-3_wp, 'PGA of '//file//' '//channel)
         call check(size(record%acceleration) == nint(npts), 'number of samples of '//file//' '//channel)
         call check(len(record%metadata%get('format')) > 0, 'format of '//file)
         if (index(file, 'multi_column') == 0 .and. index(file, 'Rot') == 0) then
            call check(len(record%metadata%get('date')) >= 10, 'date of '//file)
            call check(len(record%metadata%get('station')) > 0, 'station of '//file)
            call check(len(record%metadata%get('component')) > 0, 'component of '//file)
         end if
      end do
      call check(tested >= 19, to_text(tested)//' channels tested')
   end subroutine test_samples

   !> Small files of all formats
   subroutine list_contents(all)
      type(sample_type), allocatable, intent(out) :: all(:)

      allocate (all(9))
      all(1) = sample_of(peer_content('Valley, 1/2/1990, Hall, 67', ''), 'peer')
      all(2) = sample_of(dyna_content('STREAM: HNE'), 'dyna')
      all(3) = sample_of(smtk_content(), 'smtk')
      all(4) = sample_of(knet_content('N-S'), 'knet')
      all(5) = sample_of(cwa_content(), 'cwa')
      all(6) = sample_of(asa_content('7'), 'asa')
      all(7) = sample_of(eqsig_content('7'), 'eqsig')
      all(8) = sample_of(columns_content('# remark: x'//lf//'t,a,b,c'//lf), 'columns')
      all(9) = sample_of('0 1'//lf//'.01 2'//lf//'.02 -1.5'//lf, 'columns')
   end subroutine list_contents

   !> A content and its format (the constructor of the type makes gfortran 12 fail)
   function sample_of(content, format) result(sample)
      character(len=*), intent(in) :: content, format
      type(sample_type) :: sample

      sample%content = content
      sample%format = format
   end function sample_of

   !> Times and three columns: the small values, their double with the other sign, zeros
   function columns_content(top) result(content)
      character(len=*), intent(in) :: top
      character(len=:), allocatable :: content
      character(len=60) :: line
      integer :: i

      content = top
      do i = 1, size(small)
         write (line, '(f0.2, 3(a, f0.4))') 0.01_wp*(i + 1), ',', small(i), ',', -2*small(i), ',', 0.0_wp
         content = content//trim(line)//lf
      end do
   end function columns_content

   !> A DYNA file: lines of the caller, then the peak in its line 9 if they are one
   function dyna_content(lines) result(content)
      character(len=*), intent(in) :: lines
      character(len=:), allocatable :: content

      content = 'EVENT_NAME: EARTHQUAKE'//lf//'NETWORK: XX'//lf//'STATION_CODE: ABC'//lf//'STATION_NAME: '//lf// &
         & 'SAMPLING_INTERVAL_S: 0.010'//lf//'NDATA: 7'//lf//'UNITS: cm/s^2'//lf//lines//lf//'PGA_CM/S^2: -1.500000'//lf// &
         & 'DATA_TYPE: ACCELERATION'//lf//'STATION_LATITUDE_DEGREE: 43.5'//lf//'STATION_LONGITUDE_DEGREE: 12.75'//lf// &
         & 'PROCESSING: manual'//lf//'DATA_CITATION: : a colon'//lf//'USER1: '//lf//small_lines('(f0.6)')
   end function dyna_content

   !> A PEER file: its second line, and the rest of the third
   function peer_content(event, rest) result(content)
      character(len=*), intent(in) :: event, rest
      character(len=:), allocatable :: content

      content = 'PEER NGA STRONG MOTION DATABASE RECORD'//lf//event//lf//'ACCELERATION TIME SERIES IN UNITS OF G'// &
         & rest//lf//'NPTS=      7, DT=   .0100 SEC,   '//lf//small_row('es15.7', 5)
   end function peer_content

   !> An SMTK file: columns that touch
   function smtk_content() result(content)
      character(len=:), allocatable :: content

      content = 'Event Date & Time             : 2009-04-06 01:32:39'//lf//'Station Code / Name           : 36 / Hall'// &
         & lf//'Network                       : ABC'//lf//'Orientation                   : NS'//lf// &
         & 'Processing Info               : none: at all'//lf//'Time Increment (s)            : 0.010'//lf// &
         & 'Number of Data                : 7'//lf//'PGA (m/s/s)                   : 1.5000000E+00'//lf// &
         & 'Accelaration time series in m/s/s'//lf//small_row('es14.7', 5)
   end function smtk_content

   !> A K-NET file: counts 1000 + 16 small, 1 gal is 32 of them
   function knet_content(direction) result(content)
      character(len=*), intent(in) :: direction
      character(len=:), allocatable :: content
      character(len=80) :: line

      write (line, '(8i9)') nint(1000 + 16*small)
      content = 'Origin Time       2014/12/31 23:49:00'//lf//'Lat.              35.785'//lf// &
         & 'Long.             139.887'//lf//'Depth. (km)       84'//lf//'Mag.              4.2'//lf// &
         & 'Station Code      CHB999'//lf//'Station Lat.      35.7943'//lf//'Station Long.     140.0564'//lf// &
         & 'Station Height(m) 28'//lf//'Record Time       2014/12/31 23:50:11'//lf//'Sampling Freq(Hz) 100Hz'//lf// &
         & 'Duration Time(s)  0.07'//lf//'Dir.              '//direction//lf//'Scale Factor      3920(gal)/125440'//lf// &
         & 'Max. Acc. (gal)   0.712'//lf//'Last Correction   2014/12/31 23:50:12'//lf//'Memo.             '//lf// &
         & trim(line)//' '//lf
   end function knet_content

   !> A CWA file: zeros, the small values, and they with the other sign
   function cwa_content() result(content)
      character(len=:), allocatable :: content
      character(len=40) :: line
      integer :: i

      content = '#Earthquake Information'//cr//lf//'#Origin Time(GMT+08): 2018/02/06-23:50:42'//cr//lf// &
         & '#Magnitude(Ml): 6.0'//cr//lf//cr//lf//'#Station Information'//cr//lf//'#StationCode: EAS'//cr//lf// &
         & '#StartTime(GMT+08): 2018/02/06-23:50:29.000'//cr//lf//'#RecordLength(sec): 0.07'//cr//lf// &
         & '#SampleRate(Hz): 100'//cr//lf//'#AmplitudeUnit:  gal. DCoffset(corr)'//cr//lf// &
         & '#AmplitudeMAX. U:    0.000~    0.000'//cr//lf//'#AmplitudeMAX. N:   -1.500~    0.750'//cr//lf// &
         & '#AmplitudeMAX. E:   -0.750~    1.500'//cr//lf//'#DataSequence: Time U(+); N(+); E(+)'//cr//lf// &
         & '#Data: 4F10.3 '//cr//lf//'# '//cr//lf
      do i = 1, size(small)
         write (line, '(4f10.3)') 0.01_wp*(i - 1), 0.0_wp, small(i), -small(i)
         content = content//line//cr//lf
      end do
   end function cwa_content

   !> An ASA file with a number of samples: the small values, and they with the other sign
   function asa_content(stated) result(content)
      character(len=*), intent(in) :: stated
      character(len=:), allocatable :: content
      character(len=20) :: line
      integer :: i

      content = '****'//cr//lf//' Tel. 1  e-mail: a@b'//cr//lf//'ARCHIVO ESTANDAR DE ACELERACION:'//cr//lf// &
         & 'CLAVE DE LA ESTACION                   : ACAC'//cr//lf// &
         & 'COORDENADAS DE LA ESTACION             : 16.8 LAT. N'//cr//lf// &
         & '                                       : 99.8 LONG. W'//cr//lf// &
         & 'TIPO DE SUELO                          : ARENA'//cr//lf// &
         & '                                       : LIMO'//cr//lf//'                                       : '//cr//lf// &
         & 'NUMERO DE CANALES                      : 2'//cr//lf// &
         & 'ORIENTACION C1-C6 (rumbo;orientacion)  : /V/N90E'//cr//lf// &
         & 'INTERVALO DE MUESTREO, C1-C6 (s)       : /0.01/0.01'//cr//lf// &
         & 'FECHA DEL SISMO [GMT]                  : 1989/03/10'//cr//lf// &
         & 'HORA EPICENTRO (GMT)                   : 05:19:51.0'//cr//lf// &
         & 'MAGNITUD(ES)                           : /Mb=5.30/Ms=4.80'//cr//lf// &
         & 'NUM. TOTAL DE MUESTRAS, C1-C6          : /'//stated//'/'//stated//' '//cr//lf// &
         & 'ACEL. MAX.(Gal), C1-C6                 : /-1.50/1.50'//cr//lf// &
         & 'UNIDADES DE LOS DATOS                  : Gal (cm/s/s)'//cr//lf//cr//lf// &
         & '=========='//cr//lf//'COMENTARIOS:'//cr//lf//cr//lf//'DATOS DE ACELERACION:'//cr//lf// &
         & '---------+---------+'//cr//lf//'   CANAL-1   CANAL-2'//cr//lf//'         V      N90E'//cr//lf// &
         & '---------+---------+'//cr//lf
      do i = 1, size(small)
         write (line, '(2f10.4)') small(i), -small(i)
         content = content//line//cr//lf
      end do
   end function asa_content

   !> An eqsig file with a number of values
   function eqsig_content(stated) result(content)
      character(len=*), intent(in) :: stated
      character(len=:), allocatable :: content

      content = 'a label'//lf//stated//' 0.0100'//lf//small_lines('(es12.5)')
   end function eqsig_content

   !> The small values, one a line
   function small_lines(layout) result(lines)
      character(len=*), intent(in) :: layout
      character(len=:), allocatable :: lines
      character(len=30) :: line
      integer :: i

      lines = ''
      do i = 1, size(small)
         write (line, layout) small(i)
         lines = lines//trim(line)//lf
      end do
   end function small_lines

   !> The small values, several a line
   function small_row(layout, per_line) result(lines)
      character(len=*), intent(in) :: layout
      integer, intent(in) :: per_line
      character(len=:), allocatable :: lines
      character(len=200) :: line
      integer :: i

      lines = ''
      do i = 1, size(small), per_line
         write (line, '('//to_text(per_line)//layout//')') small(i:min(i + per_line - 1, size(small)))
         lines = lines//trim(line)//lf
      end do
   end function small_row

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

      call write_file('content.dat', content)
      call read_record(scratch//'/content.dat', record, error)
      call check_ok(error, 'file '//content(:min(30, len(content))))
      if (.not. allocated(record%acceleration)) allocate (record%acceleration(0))
   end subroutine read_content

   !> A content that is refused
   subroutine check_refused(content, part)
      character(len=*), intent(in) :: content, part
      type(record_type), allocatable :: records(:)
      type(error_type), allocatable :: error

      call write_file('content.dat', content)
      call read_records(scratch//'/content.dat', records, error)
      call check_error(error, part, 'damaged content')
      if (allocated(error)) call check(index(error%message, scratch//'/content.dat: ') == 1, 'the message names the file')
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

   !> Write a small file, byte by byte
   subroutine write_file(file, content)
      character(len=*), intent(in) :: file, content
      integer :: unit

      open (newunit=unit, file=scratch//'/'//file, access='stream', form='unformatted', action='write', &
         & status='replace')
      write (unit) content
      close (unit)
   end subroutine write_file

end program test_formats
