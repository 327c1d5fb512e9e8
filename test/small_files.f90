!> Small accelerogram files of every format for the tests: the layout of the real ones, other numbers.
module small_files
   use dondolo_base_kinds, only : wp
   use dondolo_base_text, only : to_text
   implicit none
   private

   public :: sample_type, list_contents, write_file, small
   public :: columns_content, dyna_content, peer_content, smtk_content, knet_content, cwa_content, asa_content, &
      & eqsig_content, afad_content, nied_content

   character(len=*), parameter :: cr = achar(13), lf = achar(10)

   !> Accelerations of the small files [file's units]
   real(wp), parameter :: small(7) = [0.0_wp, 0.125_wp, -0.25_wp, 0.5_wp, -1.5_wp, 0.75_wp, -0.125_wp]

   !> A text of its own length
   type :: sample_type
      !> Content of a file
      character(len=:), allocatable :: content
      !> Format that it is in
      character(len=:), allocatable :: format
   end type sample_type

contains

   !> Small files of all formats
   subroutine list_contents(all)
      type(sample_type), allocatable, intent(out) :: all(:)

      allocate (all(11))
      all(1) = sample_of(peer_content('Valley, 1/2/1990, Hall, 67', ''), 'peer')
      all(2) = sample_of(dyna_content('STREAM: HNE'), 'dyna')
      all(3) = sample_of(smtk_content(), 'smtk')
      all(4) = sample_of(knet_content('N-S'), 'knet')
      all(5) = sample_of(cwa_content(), 'cwa')
      all(6) = sample_of(asa_content('7'), 'asa')
      all(7) = sample_of(eqsig_content('7'), 'eqsig')
      all(8) = sample_of(columns_content('# remark: x'//lf//'t,acc x,acc y,acc z'//lf), 'columns')
      all(10) = sample_of(afad_content(), 'afad')
      all(11) = sample_of(nied_content(), 'nied')
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

      content = 'EVENT_NAME: SMALL VALLEY'//lf//'NETWORK: XX'//lf//'STATION_CODE: ABC'//lf//'STATION_NAME: '//lf// &
         & 'SAMPLING_INTERVAL_S: 0.010'//lf//'NDATA: 7'//lf//'UNITS: cm/s^2'//lf//lines//lf// &
         & 'PGA_CM/S^2: -1.500000'//lf//'DATA_TYPE: ACCELERATION'//lf//'STATION_LATITUDE_DEGREE: 43.5'//lf// &
         & 'STATION_LONGITUDE_DEGREE: 12.75'//lf// &
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

      content = 'Event Date & Time             : 2009-04-06 01:32:39'//lf// &
         & 'Station Code / Name           : 36 / Hall'//lf//'Network                       : ABC'//lf// &
         & 'Orientation                   : NS'//lf// &
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
         & 'Duration Time(s)  0.07'//lf//'Dir.              '//direction//lf// &
         & 'Scale Factor      3920(gal)/125440'//lf// &
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
         & '                                       : LIMO'//cr//lf// &
         & '                                       : '//cr//lf// &
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

   !> A file of AFAD: the small values, and they with the other sign, in columns that touch
   function afad_content() result(content)
      character(len=:), allocatable :: content
      character(len=20) :: line
      integer :: i

      content = 'STRONG GROUND MOTION RECORDS OF TURKIYE'//lf//'PLACE                   : HALL'//lf// &
         & 'EARTHQUAKE DATE         : 14/11/2010 23:08:25 (GMT)'//lf//'STATION ID              : 3104'//lf// &
         & 'STATION COORDINATES     : 36.50000N-36.25000E'//lf//'NUMBER OF DATA          : 7'//lf// &
         & 'SAMPLING INTERVAL (sec) : 0.01'//lf//'RAW PGA VALUES (gal)    : (N-S) 1.5 (E-W) 1.5'//lf// &
         & '     N-S      E-W'//lf
      do i = 1, size(small)
         write (line, '(2f9.6)') small(i), -small(i)
         content = content//trim(line)//lf
      end do
   end function afad_content

   !> A table of NIED: the small values, and they with the other sign
   function nied_content() result(content)
      character(len=:), allocatable :: content
      character(len=80) :: line
      integer :: i

      content = '# Origin Time, 2031/12/31 23:59:00'//lf//'# Station Code, ABC001'//lf//'# Sampling Freq(Hz), 100'//lf// &
         & '# Time, N-S(gal), E-W(gal)'//lf
      do i = 1, size(small)
         write (line, '(a, f4.2, 2(a, f0.4))') '2031/12/31 23:59:0', 0.01_wp*(i - 1), ',', small(i), ',', -small(i)
         content = content//trim(line)//lf
      end do
   end function nied_content

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

   !> Write a small file, byte by byte
   subroutine write_file(file, content)
      character(len=*), intent(in) :: file, content
      integer :: unit

      open (newunit=unit, file=file, access='stream', form='unformatted', action='write', &
         & status='replace')
      write (unit) content
      close (unit)
   end subroutine write_file

end module small_files
