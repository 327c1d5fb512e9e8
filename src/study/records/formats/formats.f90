!> The formats of accelerogram files that are known. A new format is one new file with two procedures, and a line here.
module dondolo_records_formats
   use dondolo_base_error, only : error_type, raise_input
   use dondolo_base_plain, only : shown
   use dondolo_base_text, only : join, lower
   use dondolo_files_file_kinds, only : describe_markup
   use dondolo_files_text_file, only : text_file_type
   use dondolo_records_format_afad, only : read_afad, recognises_afad
   use dondolo_records_format_asa, only : read_asa, recognises_asa
   use dondolo_records_format_columns, only : read_columns, recognises_columns
   use dondolo_records_format_cosmos, only : read_cosmos, recognises_cosmos
   use dondolo_records_format_csmip, only : read_csmip, recognises_csmip
   use dondolo_records_format_cwa, only : read_cwa, recognises_cwa
   use dondolo_records_format_dyna, only : read_dyna, recognises_dyna
   use dondolo_records_format_eqsig, only : read_eqsig, recognises_eqsig
   use dondolo_records_format_geonet, only : read_geonet, recognises_geonet
   use dondolo_records_format_knet, only : read_knet, recognises_knet
   use dondolo_records_format_nied, only : read_nied, recognises_nied
   use dondolo_records_format_peer, only : read_peer, recognises_peer
   use dondolo_records_format_smc, only : read_smc, recognises_smc
   use dondolo_records_format_smtk, only : read_smtk, recognises_smtk
   use dondolo_records_format, only : given_type, samples_type
   implicit none
   private

   public :: format_type, find_format, read_as, recognise_format

   !> A format
   type :: format_type
      !> Name: one word in lower case
      character(len=9) :: name = ''
      !> Is a text in this format, judged by its content?
      procedure(recognises_text), pointer, nopass :: recognises => null()
      !> Read a text in this format
      procedure(read_text), pointer, nopass :: read => null()
      !> Are its files plain columns, of which the caller may say what they are?
      logical :: is_plain = .false.
   end type format_type

   abstract interface
      !> Is a text in this format, judged by its content? True: its reader may still find it wrong
      logical function recognises_text(text) result(recognised)
         import :: text_file_type
         implicit none
         type(text_file_type), intent(in) :: text
      end function recognises_text

      !> Read a text in this format
      subroutine read_text(text, samples, error)
         import :: text_file_type, samples_type, error_type
         implicit none
         type(text_file_type), intent(in) :: text
         !> What it says
         type(samples_type), intent(out) :: samples
         !> What is wrong, with file and line
         type(error_type), allocatable, intent(out) :: error
      end subroutine read_text
   end interface

contains

   !> The formats; plain columns come last, for what no other recognises
   function known_formats() result(known)
      !> The formats
      type(format_type) :: known(15)

      known = [ &
         & format_type('peer', recognises_peer, read_peer), &
         & format_type('dyna', recognises_dyna, read_dyna), &
         & format_type('cosmos', recognises_cosmos, read_cosmos), &
         & format_type('csmip', recognises_csmip, read_csmip), &
         & format_type('geonet', recognises_geonet, read_geonet), &
         & format_type('smc', recognises_smc, read_smc), &
         & format_type('smtk', recognises_smtk, read_smtk), &
         & format_type('knet', recognises_knet, read_knet), &
         & format_type('nied', recognises_nied, read_nied), &
         & format_type('afad', recognises_afad, read_afad), &
         & format_type('cwa', recognises_cwa, read_cwa), &
         & format_type('asa', recognises_asa, read_asa), &
         & format_type('eqsig', recognises_eqsig, read_eqsig), &
         & format_type('synthetic', recognises_none, read_columns_alone, is_plain=.true.), &
         & format_type('columns', recognises_columns, read_columns_alone, is_plain=.true.)]
   end function known_formats

   !> Plain columns do not say that they were computed and not recorded: the row of a catalogue does
   logical function recognises_none(text) result(recognised)
      type(text_file_type), intent(in) :: text

      recognised = .false.
      associate (unused => text)
      end associate
   end function recognises_none

   !> Read plain columns of which the caller says nothing
   subroutine read_columns_alone(text, samples, error)
      type(text_file_type), intent(in) :: text
      !> What it says
      type(samples_type), intent(out) :: samples
      !> What is wrong, with file and line
      type(error_type), allocatable, intent(out) :: error

      type(given_type) :: given

      given%units = ''
      given%columns = ''
      call read_columns(text, given, samples, error)
   end subroutine read_columns_alone

   !> Read a text in a format
   subroutine read_as(format, text, given, samples, error)
      type(format_type), intent(in) :: format
      type(text_file_type), intent(in) :: text
      !> What the caller gives: plain columns are checked against it
      type(given_type), intent(in) :: given
      !> What it says
      type(samples_type), intent(out) :: samples
      !> What is wrong, with file and line
      type(error_type), allocatable, intent(out) :: error

      if (format%is_plain) then
         call read_columns(text, given, samples, error)
      else if (len_trim(given%columns) > 0) then
         call raise_input(error, text%file//': columns = '''//shown(given%columns)//''': only for plain columns, '// &
            & 'and the file is in the format '''//trim(format%name)//'''; format = ''columns'' reads it as plain columns')
      else
         call format%read(text, samples, error)
      end if
   end subroutine read_as

   !> Find a format by its name
   subroutine find_format(name, format, error)
      !> Name, in upper or lower case
      character(len=*), intent(in) :: name
      type(format_type), intent(out) :: format
      !> There is none of this name
      type(error_type), allocatable, intent(out) :: error

      type(format_type), allocatable :: known(:)
      integer :: i

      known = known_formats()
      do i = 1, size(known)
         if (known(i)%name /= lower(trim(adjustl(name)))) cycle
         format = known(i)
         return
      end do
      call raise_input(error, 'format = '''//trim(name)//''': must be one of '// &
         & join([(known(i)%name, i=1, size(known))]))
   end subroutine find_format

   !> Find the format of a text
   subroutine recognise_format(text, format, error)
      type(text_file_type), intent(in) :: text
      type(format_type), intent(out) :: format
      !> No format recognises it, or two do
      type(error_type), allocatable, intent(out) :: error

      type(format_type), allocatable :: known(:)
      character(len=:), allocatable :: problem
      integer :: i

      call describe_markup(text%line(1), problem)
      if (len(problem) > 0) then
         call raise_input(error, problem)
         return
      end if
      known = known_formats()
      do i = 1, size(known)
         if (i == size(known) .and. format%name /= '') exit
         if (.not. known(i)%recognises(text)) cycle
         if (format%name /= '') then
            call raise_input(error, 'may be in the format '''//trim(format%name)//''', '''//trim(known(i)%name)// &
               & ''': format must name one of them')
            return
         end if
         format = known(i)
      end do
      if (format%name == '') call raise_input(error, 'the format is not known: must be one of '// &
         & join([(known(i)%name, i=1, size(known))]))
   end subroutine recognise_format

end module dondolo_records_formats
