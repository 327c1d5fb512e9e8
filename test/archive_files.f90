!> Small accelerogram files of the formats of archives: COSMOS, CSMIP volume 2, GeoNet V2A, SMC.
module archive_files
   use dondolo_base_kinds, only : wp
   use dondolo_base_text, only : to_text
   implicit none
   private

   public :: cosmos_type, cosmos, csmip, geonet, smc, with_crlf, motion

   character(len=*), parameter :: lf = achar(10), cr = achar(13)

   !> Accelerations of the small texts, to be multiplied; their prints touch in the columns of every format
   real(wp), parameter :: motion(13) = [0.5_wp, -1234.5_wp, -1234.6_wp, 99.9_wp, -1111.1_wp, 0.0_wp, 7.0_wp, -0.1_wp, &
      & 1234.4_wp, -1000.0_wp, -1000.1_wp, 3.2_wp, -2.5_wp]

   !> What a COSMOS record is written with
   type :: cosmos_type
      character(len=40) :: title = 'Corrected acceleration    (Format v01.20'
      character(len=21) :: text_lines = 'with 13 text lines)'
      character(len=40) :: channel = 'Sta Cha:  1: 340 deg (Rcrdr Chan  1)'
      character(len=60) :: marks = 'is unknown/unspecified:   -999, -999.0'
      character(len=40) :: comment = '| sample remark'
      integer :: comments = 2
      character(len=12) :: count = '13'
      character(len=20) :: quantity = 'acceleration'
      character(len=30) :: units = 'cm/sec2(04)'
      character(len=12) :: format = '(8F10.5)'
      integer :: stage = 2, quantity_code = 1, unit_code = 4
      real(wp) :: multiple = 0.1_wp, step = 5.0_wp, raw_step = -999.0_wp, length = 0.065_wp, peak = -123.46_wp
      real(wp) :: bit = -999.0_wp, sensitivity = -999.0_wp, gain = -999.0_wp
      character(len=40) :: ending = 'End-of-data for Chan  1 acceleration'
   end type cosmos_type

contains

   !> A COSMOS record
   function cosmos(file) result(content)
      type(cosmos_type), intent(in) :: file
      character(len=:), allocatable :: content
      real(wp) :: reals(100)
      integer :: integers(100), i

      integers = -999
      integers(1:4) = [file%stage, file%quantity_code, file%unit_code, 120]
      reals = -999.0_wp
      reals(1:2) = [40.5_wp, -120.25_wp]
      reals(10:13) = [41.0_wp, -121.0_wp, 12.0_wp, 5.5_wp]
      reals(15) = 5.25_wp
      reals(22) = file%bit
      reals(34) = file%raw_step
      reals(42) = file%sensitivity
      reals(47) = file%gain
      reals(62:64) = [file%step, file%length, file%peak]
      content = trim(file%title)//' '//trim(file%text_lines)//' Src: x'//lf// &
         & 'Record of Small Town                    Feb 3, 2016 04:05 UTC'//lf// &
         & 'Hypocenter: 41.00 -121.00 H= 12km Mw=5.5'//lf// &
         & 'Origin: 2016/02/03 04:05:06    UTC'//lf// &
         & 'Statn No: 99-000001 Code:XX-ABCD   XYZ  Hill - Old Mill'//lf// &
         & 'Coords: 40.5000 -120.2500  Site geology: rock'//lf// &
         & 'Recorder: none s/n 1 ( 1 Chns of 3 at Sta) Sensor: none'//lf// &
         & 'Rcrd start time: 2016/02/03 04:05:10.0 UTC (Q=5) RcrdId: x.1'//lf// &
         & trim(file%channel)//' Location:'//lf// &
         & 'Raw record length = 0.065 sec'//lf// &
         & 'Processed: 2016/02/04, Max = -123.46 cm/sec2 at 0.010 sec'//lf// &
         & 'Record filtered below  0.10 Hz'//lf// &
         & 'Values used when parameter or data value '//trim(file%marks)//lf// &
         & ' 100 Integer-header values follow on  10 lines, Format= (10I8)'//lf
      content = content//printed([(real(integers(i), wp), i=1, 100)], '(10I8)')// &
         & ' 100 Real-header values follow on  20 lines, Format= (5F15.6)'//lf//printed(reals, '(5F15.6)')// &
         & '   '//to_text(file%comments)//' Comment line(s) follow, each starting with a "|":'//lf
      do i = 1, file%comments
         content = content//trim(file%comment)//lf
      end do
      content = content//'  '//trim(file%count)//' '//trim(file%quantity)//' pts, approx  0 secs, units='// &
         & trim(file%units)//',Format='//trim(file%format)//lf//printed(file%multiple*motion, trim(file%format))
      if (len_trim(file%ending) > 0) content = content//trim(file%ending)//lf
   end function cosmos

   !> A channel of a CSMIP file
   function csmip(component, count, step_and_units, format, multiple, cut) result(content)
      character(len=*), intent(in) :: component, count, step_and_units, format
      real(wp), intent(in) :: multiple
      logical, intent(in), optional :: cut
      character(len=:), allocatable :: content, number
      real(wp) :: zeros(100)
      character(len=12) :: peak
      integer :: values, stat

      read (count, *, iostat=stat) values
      if (stat /= 0) values = 13
      if (present(cut)) values = 13
      values = min(values, 13)
      zeros = 0.0_wp
      write (peak, '(f12.3)') -maxval(abs(multiple*motion))
      number = count
      if (count == 'few') number = 'FEW'
      content = 'CORRECTED ACCELEROGRAM   99999-S1-83123.01       CHAN  1:  '//component//'     FROM'//lf// &
         & 'UNCORRECTED ACCELEROGRAM DATA              PROCESSED:  6/06/83, XYZ'//lf// &
         & 'SMALL TOWN EARTHQUAKE'//lf// &
         & 'MAY 2, 1983 16:42 PDT                   (ORIGIN(XYZ): 05/02/83, 23:42:38.5 UTC)'//lf// &
         & '99999-S1-83123.01               TRIGGER TIME: 05/02/83, 16:42:48.2 PDT'//lf// &
         & 'STATION NO. 99999   35.500N, 120.250W     SMA-1  S/N 1'//lf// &
         & 'OLD MILL'//lf// &
         & 'CHAN  1:  '//component//lf// &
         & 'SMALL TOWN EARTHQUAKE     MAY 2, 1983 16:42 PDT'//lf// &
         & 'HYPOCENTER(XYZ): 36.25N,120.28W, H=9KM.  ML=6.5(XYZ)'//lf// &
         & 'INSTR PERIOD =  .0407 SEC,  DAMPING =  .630,  SENSITIVITY = 1.87 CM/G.'//lf// &
         & '                        RECORD LENGTH =  .260 SEC.'//lf// &
         & '                                     UNCOR MAX  =  -.275 G, AT  .040 SEC.'//lf// &
         & 'RMS ACCEL OF (UNCOR) RECORD  =  .030 G.'//lf// &
         & 'ACCELEROGRAM BANDPASS FILTERED WITH RAMPS AT  .05- .10'//lf
      content = content//'  '//number//' POINTS OF BASELINE-CORRECTED ACCEL, VELOC AND DISPL DATA'//lf// &
         & 'AT EQUALLY-SPACED INTERVALS OF    .020  SEC.'//lf// &
         & 'PEAK ACCELERATION = '//peak//'    CM/SEC/SEC  AT     .040   SEC.'//lf// &
         & 'PEAK   VELOCITY   =   -28.253      CM/SEC    AT     .040   SEC.'//lf// &
         & 'PEAK DISPLACEMENT =     5.449        CM      AT     .040   SEC.'//lf// &
         & 'INITIAL VELOCITY  =     -.052   CM/SEC;   INITIAL DISPLACEMENT =    -.110   CM'//lf// &
         & 'SMALL TOWN EARTHQUAKE     MAY 2, 1983 16:42 PDT'//lf//lf// &
         & '99999-S1-83123.01      OLD MILL   CHAN  1:  '//component//lf//lf// &
         & printed(zeros, '(16I5)')//printed(zeros, '(8F10.3)')// &
         & '   '//number//' POINTS OF ACCEL DATA EQUALLY SPACED AT  '//step_and_units//lf// &
         & printed(multiple*motion(:values), format)// &
         & '   '//number//' POINTS OF VELOC DATA EQUALLY SPACED AT  '//step_and_units//lf// &
         & printed(zeros(:values), format)// &
         & '   '//number//' POINTS OF DISPL DATA EQUALLY SPACED AT  '//step_and_units//lf// &
         & printed(zeros(:values), format)// &
         & '/&  ----------  END OF DATA FOR CHANNEL  1  ----------'//lf
   end function csmip

   !> A component of a GeoNet file
   function geonet(component, count, multiple, others) result(content)
      character(len=*), intent(in) :: component
      integer, intent(in) :: count
      real(wp), intent(in) :: multiple
      integer, intent(in), optional :: others
      character(len=:), allocatable :: content
      character(len=200) :: line
      real(wp) :: values(count)
      integer :: rest

      values = multiple*motion(:count)
      rest = count
      if (present(others)) rest = others
      content = 'Corrected accelerogram 20180212_211554_ABCD_20 GNS Science'//lf// &
         & 'Site ABCD      39 56 38S  176 35 04E     Basalt file:  20180212_211557_ABCD'//lf// &
         & 'Small Town Hall'//lf// &
         & 'Instrument Basalt_1'//lf// &
         & 'Resolution: 24-bit   Instr Period: 0.0050 s   Damping: 0.700'//lf// &
         & 'Accelerogram 20180212_211554_ABCD_20                 Processed 2018 February 21'//lf// &
         & '6 km south of the town'//lf// &
         & '2018 February 12         21:15:54 UT'//lf// &
         & 'Epicentre  40 03 27S 176 32 45E Dist   13km M  4.17'//lf
      write (line, '(a, i6, a)') 'Number of points', count, '    Duration 0.24 sec'
      content = content//trim(line)//lf// &
         & 'Instrument corrected data at 0.020 sec intervals'//lf// &
         & 'Band-pass filter bands are .10-.25 Hz'//lf// &
         & 'Component '//component//'  Longitudinal Accelerometer Axis'//lf
      write (line, '(a, f9.1, a)') 'Acceleration:  peak', merge(-1, 1, multiple > 0.0_wp)*maxval(abs(values)), &
         & ' mm/s/s at  43.68 sec     rms      2.2 mm/s/s'
      content = content//trim(line)//lf// &
         & 'Velocity:      peak     1.65 mm/s   at  43.56 sec     rms     0.09 mm/s'//lf// &
         & 'Displacement:  peak    0.131 mm     at  43.66 sec     rms    0.007 mm'//lf// &
         & '    2018       2      12      21      15     540       0       0    2018       2'//lf// &
         & '      40       3      27     176      32      45       9       0      12      21'//lf// &
         & '      39      56      38     176      35       4     196     196     195      13'//lf
      write (line, '(10i8)') 21200, 250, 250, count, rest, rest, 0, 0, 15, 17000
      content = content//trim(line)//lf// &
         & '   200.0    0.70    0.00   0.000  0.0000   0.000   0.000   1.000     0.0    0.00'//lf// &
         & '  39.944 176.584   40.06  176.55    4.17    0.00    0.00    0.00      0.      0.'//lf// &
         & '  106.00    5.00    5.00  115.98  0.0050  0.0200      0.      0.      0.  9806.6'//lf// &
         & '   -46.3   43.67     2.3   0.000      0.   -41.6   43.68     2.2   196.4   4.221'//lf// &
         & '    1.65   43.56    0.09    5.10   3.098    0.13   43.66    0.01    0.31   0.549'//lf// &
         & '   0.100   0.150   0.250      0.      0.  24.500   1.000  25.500      0.      0.'//lf// &
         & printed(values, '(10F8.1)')//printed(0.0_wp*values(:rest), '(10F8.2)')// &
         & printed(0.0_wp*values(:rest), '(10F8.3)')
   end function geonet

   !> An SMC file
   function smc(title, count, comments, digits) result(content)
      character(len=*), intent(in) :: title
      integer, intent(in) :: count, comments
      integer, intent(in), optional :: digits
      character(len=:), allocatable :: content
      real(wp) :: reals(50)
      integer :: integers(48), i

      integers = -32768
      integers(2:6) = [1989, 291, 0, 4, 0]
      integers(14) = 133
      integers(16:17) = [comments, count]
      if (present(digits)) integers(47) = digits
      reals = 1.7e38_wp
      reals(2:3) = [200.0_wp, 37.037_wp]
      reals(6:8) = [7.1_wp, 7.1_wp, 7.0_wp]
      reals(11:12) = [37.52_wp, -122.25_wp]
      reals(29:32) = [0.04_wp, 1234.4_wp, 0.01_wp, -1234.6_wp]
      content = title//lf//'*'//lf//'A020A'//lf//'     1989  10  18    0004 Small Town, CA       '//lf// &
         & 'Moment Mag=      7.1 Ms=      7.1 Ml=      7.0'//lf// &
         & 'station = Old Mill #2                    component=    133'//lf// &
         & 'epicentral dist =     63.0       pk     =  -1234.6'//lf// &
         & 'inst type=SMA-1      data source = USGS'//lf//'*'//lf//'*'//lf//'*'//lf// &
         & printed([(real(integers(i), wp), i=1, 48)], '(8I10)')//printed(reals, '(5E15.7)')
      do i = 1, comments
         content = content//'|remark'//lf
      end do
      if (present(digits)) then
         content = content//printed(motion, '(5ES14.7E1)')
      else
         content = content//printed(motion, '(8ES10.4E1)')
      end if
   end function smc

   !> Numbers in a Fortran format
   function printed(values, format) result(content)
      real(wp), intent(in) :: values(:)
      character(len=*), intent(in) :: format
      character(len=:), allocatable :: content
      character(len=200) :: lines(100)
      integer :: i, stat

      content = ''
      if (size(values) == 0) return
      lines = achar(0)
      if (scan(format, 'Ii') > 0) then
         write (lines, format) nint(values)
      else
         write (lines, format, iostat=stat) values
         if (stat /= 0) write (lines, '(8f10.5)') values
      end if
      do i = 1, size(lines)
         if (lines(i)(1:1) == achar(0)) exit
         content = content//trim(lines(i))//lf
      end do
   end function printed

   !> The same text with lines that end in CRLF
   function with_crlf(content) result(converted)
      character(len=*), intent(in) :: content
      character(len=:), allocatable :: converted
      integer :: i

      converted = ''
      do i = 1, len(content)
         if (content(i:i) == lf) converted = converted//cr
         converted = converted//content(i:i)
      end do
   end function with_crlf

end module archive_files
