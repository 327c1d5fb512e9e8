!> What records say of themselves: which earthquake they are of and which way they point; and files that are no text.
program test_origins
   use checks, only : check, check_error, check_text, finish, suite
   use dondolo_base_error, only : error_type
   use dondolo_base_kinds, only : wp
   use dondolo_base_lines, only : lines_type
   use dondolo_files_csv_reader, only : csv_row_type, csv_table_type
   use dondolo_record, only : record_type
   use dondolo_record_metadata, only : metadata_type
   use dondolo_records_clusters, only : cluster_records
   use dondolo_records_dates, only : day_number
   use dondolo_records_direction, only : is_vertical, names_vertical
   use dondolo_records_earthquake, only : find_difference
   use dondolo_records_record_reader, only : read_record
   implicit none

   character(len=*), parameter :: scratch = 'build/test_origins'
   character(len=*), parameter :: cr = achar(13), lf = achar(10)

   call execute_command_line('mkdir -p '//scratch)
   call test_names_again()
   call test_differences()
   call test_directions()
   call test_kinds()
   call finish()

contains

   !> Earthquakes of one name, at other times
   subroutine test_names_again()
      character(len=20), parameter :: dates(7) = [character(len=20) :: '1931-05-06', '', '1958-02-11T03:00', '1931-05-07T01:10', &
         & '1958-02-10', '02/10/1958', '1931-05-08']
      type(record_type) :: records(7)
      type(lines_type) :: labels
      integer :: clusters(7), i

      call suite('earthquakes of one name')
      do i = 1, 7
         records(i)%dt = 0.01_wp
         records(i)%acceleration = real([0, i, -1], wp)
         call records(i)%metadata%set('event', 'Small Valley')
         call records(i)%metadata%set('date', trim(dates(i)))
      end do
      ! A day more or less is the same night elsewhere; a date that is not known, or whose month is not, tells nothing
      call cluster_records(records, clusters, labels)
      call check(all(clusters == [1, 1, 2, 1, 2, 2, 3]), 'told apart by their dates')
      call check_text(labels%line(4)%text, 'Small Valley', 'the first keeps its name')
      call check_text(labels%line(5)%text, 'Small Valley 1958-02-11', 'the second has its date, that of its first record')
      call check_text(labels%line(7)%text, 'Small Valley 1931-05-08', 'the third')
      ! The first record of the name does not know its date, and takes that of the next one
      call records(1)%metadata%remove('date')
      call cluster_records(records, clusters, labels)
      call check(all(clusters == [1, 1, 1, 2, 1, 1, 2]), 'the first known date is that of the name')
      call records(1)%metadata%set('date', '06/05/1931')
      call cluster_records(records, clusters, labels)
      call check(clusters(6) == 2 .and. clusters(1) == 1 .and. clusters(4) == 1, 'a date whose month is not known has two days')
      call records(1)%metadata%set('date', '04/03/1931')
      call cluster_records(records, clusters, labels)
      call check(clusters(4) > 1, 'neither of which is a third one')
      call check(day_number('2000-03-01') - day_number('2000-02-28') == 2, 'a leap day')
      call check(day_number('1900-03-01T12:00') - day_number('1900-02-28') == 1, 'and none')
      call check(day_number('2001-01-01') - day_number('2000-12-31') == 1, 'the end of a year')
      call check(day_number('03/04/2009') == 0 .and. day_number('2009') == 0, 'no date')
   end subroutine test_names_again

   !> Which way components point, by their metadata and by names
   subroutine test_directions()
      character(len=32), parameter :: up(*) = [character(len=32) :: 'UP', 'U-D', 'ud1', 'Vert', 'D', 'V', 'Z', '+Z', 'HNZ', &
         & 'BHZ10', '20.HGZ', 'Z1', 'senkrecht', '3 (Up)', &
         & 'acc Z [g] filtered', 'EHZ_00', 'SLZ', 'CHZ00', '10HNZ', 'verticale', 'Componente vertical', 'Vertikal', 'düşey', &
         & 'DÜŞEY BİLEŞEN', 'dusey', 'düþey', 'Katakoryfi', 'κατακόρυφη', 'ΚΑΤΑΚΟΡΥΦΗ', '上下動', &
         & 'UD (gal)', 'Z m/s^2', 'V cm/s/s', 'Acc_Z', 'az', 'STA1-UP', 'vertikale Komponente', 'Up-Down', &
         & 'Z axis', 'Chan 3 (Up)', 'HNZ 100', 'Vert00', 'Channel 3: Up']
      character(len=32), parameter :: sideways(*) = [character(len=32) :: 'HNE', 'BHN00', 'HN3', 'BH1', '10.HH2', 'N-S', 'E-W', &
         & '090', '360', 'S00E', 'L', 'Y', 'N m/s^2', 'E cm/s/s', '90 Deg', 'EW2', '90 (up is positive)', 'Chan 1: 0 Deg', &
         & 'HNE 100', 'V_NS 0.5-20Hz']
      character(len=32), parameter :: names(*) = [character(len=32) :: 'A_UD.acc', 'XY.STAT..BHZ.D.asc', &
         & 'XY.ST.HNZ.20160824.123.txt', '000123za.cor', 'rec_verticale.txt', 'STATHNZ.txt', 'B-TOWDWN', 'quake-V.AT2', &
         & 'acc_z.csv', 'DÜŞEY.txt', 'V_town.txt', 'Z_TOWN.txt', 'TOWN_Z_raw', 'TOWN_Z_0.2-30Hz', 'town_lotrecht', &
         & 'town_dikey', 'town_zdir', 'CompV']
      character(len=32), parameter :: others(*) = [character(len=32) :: 'GROUP.txt', 'Lorenz.txt', 'V_NS.txt', &
         & 'Z_EW_filtered', 'town_0.2-30Hz', &
         & 'r0_Nx.AT2', '01_ancona_1972_m4.8_a', 'STATHNE.txt', 'holz.txt', 'Vertemate.txt', 'UPTOWN.acc']
      type(metadata_type) :: metadata
      integer :: i

      call suite('directions')
      do i = 1, size(up)
         call metadata%set('component', up(i))
         call check(is_vertical(metadata, 'town_NS'), 'up: '//trim(up(i)))
      end do
      do i = 1, size(sideways)
         call metadata%set('component', sideways(i))
         call check(.not. is_vertical(metadata, 'town_UD'), 'sideways: '//trim(sideways(i)))
      end do
      call metadata%remove('component')
      do i = 1, size(names)
         call check(is_vertical(metadata, trim(names(i))), 'by its name: '//trim(names(i)))
      end do
      do i = 1, size(others)
         call check(.not. is_vertical(metadata, trim(others(i))), 'not by its name: '//trim(others(i)))
      end do
      call check_key('sensor orientation', 'Z', .true.)
      call check_key('Richtung', 'vertikal', .true.)
      call check_key('component code', 'HNZ', .true.)
      call check_key('id', 'XY.TOWN..HGZ', .true.)
      call check_key('station', 'TOWN.HNZ', .true.)
      call check_key('record', 'TOWN UP', .true.)
      call check_key('station name', 'Gare du Nord', .false.)
      call check_key('record', 'Rue du', .false.)
      call check_key('station', 'UP', .false.)
      call check_key('id', 'XY.TOWN..HGN', .false.)
      call check(names_vertical('Vertical component') .and. names_vertical('COMP. VERTICAL'), 'lines')
      call check(.not. (names_vertical('horizontal component') .or. names_vertical('NS') .or. &
         & names_vertical('the baseline was removed and the vertical one left as it is')), 'and others')
      call metadata%set('orientation', '0')
      call check(is_vertical(metadata, 'town_UD'), 'an angle is no azimuth for sure')
      call metadata%set('dip', '-90.0')
      call check(is_vertical(metadata, 'town'), 'dip')
      call metadata%set('dip', '0')
      call metadata%set('format', 'cosmos')
      call metadata%set('azimuth', '401')
      call check(is_vertical(metadata, 'town'), 'a code of COSMOS')
   end subroutine test_directions

   !> The direction that a key of metadata says
   subroutine check_key(key, value, is_up)
      character(len=*), intent(in) :: key, value
      logical, intent(in) :: is_up
      type(metadata_type) :: metadata

      call metadata%set(key, value)
      call check(is_vertical(metadata, 'town') .eqv. is_up, key//': '//value)
   end subroutine check_key

   !> Files that are no text say what they seem to be
   subroutine test_kinds()
      character(len=*), parameter :: nul = achar(0)
      character(len=:), allocatable :: sac

      call suite('kinds of files')
      call check_record('000007R STAT 10HNEXY'//achar(7)//achar(231)//repeat(nul//achar(200), 40), &
         & ': seems to be a miniSEED or SEED file, not a text: write its samples as text')
      call check_record('MS'//achar(3)//nul//'rest', ': seems to be a miniSEED file')
      sac = repeat(achar(199)//achar(70), 152)//achar(6)//nul//nul//nul//repeat(achar(65), 400)
      call check_record(sac, ': seems to be a SAC file')
      call check_record(achar(137)//'HDF'//cr//lf//achar(26)//lf//nul, ': seems to be an HDF5 file')
      call check_record('MATLAB 5.0 MAT-file, Platform', ': seems to be a MATLAB file')
      call check_record(achar(147)//'NUMPY'//achar(1)//nul, ': seems to be a NumPy array, not a text: write its numbers')
      call check_record('%PDF-1.7'//lf, ': seems to be a PDF document, not a text: must be a text file')
      call check_record(achar(31)//achar(139)//achar(8)//nul, ': seems to be an archive (gzip), not a text: unpack it')
      call check_record('PK'//achar(3)//achar(4)//repeat('x', 3000)//'xl/workbook.xml', &
         & ': seems to be a workbook of a spreadsheet (xlsx), not a text: save its table as CSV')
      call check_record('PK'//achar(3)//achar(4)//'a.npy', ': seems to be an archive of NumPy arrays')
      call check_record('PK'//achar(3)//achar(4)//'records/1.txt', ': seems to be an archive (ZIP), not a text: unpack it')
      call check_record(achar(128)//achar(4)//achar(149)//nul, ': seems to be a pickle of Python')
      call check_record('RIFF'//achar(9)//nul//nul//nul//'WAVEfmt ', ': seems to be a recording of sound (WAV)')
      call check_record('MZ'//achar(144)//nul//achar(3), ': seems to be a program')
      call check_record(repeat(nul, 4)//achar(9)//repeat(nul, 3)//achar(1)//repeat(nul, 7)//achar(2)//repeat(nul, 3)//'a'//nul// &
         & repeat(achar(63), 72), ': seems to be a MATLAB file (version 4)')
      call check_record('<!DOCTYPE HTML><html>'//lf//'0.1'//lf, ': seems to be an HTML page, not an accelerogram')
      call check_record('{"acc": ['//lf//'0.1,'//lf//'0.2'//lf//']}', ': seems to be a JSON file')
      call check_record('<?xml version="1.0"?>'//lf//'0.1'//lf, ': seems to be an XML file')
      call check_record('WID2 2016/08/24 01:36:32.000 TOWN'//lf//'1'//lf, ': seems to be a GSE file')
      call check_record(achar(208)//achar(207)//achar(17)//achar(224)//achar(161)//achar(177)//achar(26)//achar(225), &
         & ': seems to be an old workbook')
      ! Whatever else is wrong before it
      call check_record(achar(228)//achar(5)//lf//'b'//nul//'c'//lf, ': line 2: byte 2 is NUL: this is not a text file')
      call check_table('a'//achar(228)//',b'//lf//'1'//nul//',2'//lf, ': line 2: byte 2 is NUL: this is not a text file')
      call check_table(achar(2)//achar(228)//',b'//lf, ': line 1: byte 2 (E4) is not UTF-8: this is not a text file')
   end subroutine test_kinds

   !> Components of one motion are of one station, one day and one earthquake, as far as both know
   subroutine test_differences()
      type(metadata_type) :: first, second
      character(len=:), allocatable :: key, one, other

      call suite('differences')
      call first%set('station', 'TOWN')
      call find_difference(first, second, key, one, other)
      call check_text(key, '', 'not known')
      call second%set('station', 'TOWN')
      call first%set('event', 'Hill')
      call second%set('event', 'Dale')
      call find_difference(first, second, key, one, other)
      call check_text(key//' '//one//' '//other, 'event Hill Dale', 'earthquakes')
      call first%set('date', '1971-02-03')
      call second%set('date', '1971-02-04')
      call find_difference(first, second, key, one, other)
      call check_text(key//' '//one//' '//other, 'date 1971-02-03 1971-02-04', 'days')
   end subroutine test_differences

   !> A file that is refused as a record
   subroutine check_record(content, part)
      character(len=*), intent(in) :: content, part
      type(record_type) :: record
      type(error_type), allocatable :: error

      call write_file('bad.txt', content)
      call read_record(scratch//'/bad.txt', record, error, dt=0.01_wp, units='m/s2')
      call check_error(error, scratch//'/bad.txt'//part, 'record'//part)
   end subroutine check_record

   !> A file that is refused as a table
   subroutine check_table(content, part)
      character(len=*), intent(in) :: content, part
      type(csv_table_type) :: table
      type(csv_row_type) :: row
      type(error_type), allocatable :: error
      logical :: found

      call write_file('bad.csv', content)
      call table%read(scratch//'/bad.csv', error)
      if (.not. allocated(error)) call table%next(row, found, error)
      call check_error(error, scratch//'/bad.csv'//part, 'table'//part)
   end subroutine check_table

   !> Write a small file, byte by byte
   subroutine write_file(file, content)
      character(len=*), intent(in) :: file, content
      integer :: unit

      open (newunit=unit, file=scratch//'/'//file, access='stream', form='unformatted', action='write', status='replace')
      write (unit) content
      close (unit)
   end subroutine write_file

end program test_origins
