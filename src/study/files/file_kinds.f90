!> Kinds of files that are no text, or no accelerogram, by what they begin with: what users give for a record, a table or a case.
module dondolo_files_file_kinds
   use dondolo_base_text, only : lower
   implicit none
   private

   public :: describe_binary, describe_markup, head_length, is_archive

   !> Bytes that tell the kind of a file: those of the longest signature, a header of SAC, and a line of text
   integer, parameter :: head_length = 1024

   !> A kind of files
   type :: kind_type
      !> What such a file has from a place on, whose last character is no blank
      integer :: place
      character(len=14) :: signature
      !> What it is, with an article
      character(len=60) :: what
      !> What to do, one of the remedies
      integer :: remedy
   end type kind_type

   !> What to do
   integer, parameter :: unpack = 1, as_text = 2, as_table = 3, of_python = 4, other = 5
   character(len=96), parameter :: remedies(5) = [character(len=96) :: &
      & 'unpack it', &
      & 'write its samples as text, or make a dondolo.Record of them in Python', &
      & 'save its table as CSV', &
      & 'write its numbers as text, or give them to dondolo in Python', &
      & 'must be a text file']

   character(len=*), parameter :: nul = achar(0), line_end = achar(13)//achar(10)

   !> The kinds, the longer signatures before those that they begin with
   type(kind_type), parameter :: kinds(*) = [ &
      & kind_type(1, achar(137)//'HDF'//line_end//achar(26)//achar(10), 'an HDF5 file (ASDF, MATLAB 7.3 ...)', of_python), &
      & kind_type(513, achar(137)//'HDF'//line_end//achar(26)//achar(10), 'an HDF5 file (MATLAB 7.3)', of_python), &
      & kind_type(1, 'MATLAB 5.0 MAT', 'a MATLAB file', of_python), &
      & kind_type(1, achar(147)//'NUMPY', 'a NumPy array', of_python), &
      & kind_type(1, 'CDF'//achar(1), 'a NetCDF file', of_python), &
      & kind_type(1, 'CDF'//achar(2), 'a NetCDF file', of_python), &
      & kind_type(1, 'PAR1', 'a Parquet table', as_table), &
      & kind_type(1, 'ARROW1', 'a Feather table', as_table), &
      & kind_type(1, achar(208)//achar(207)//achar(17)//achar(224)//achar(161)//achar(177)//achar(26)//achar(225), &
      &   'an old workbook or document of an office program (xls, doc)', as_table), &
      & kind_type(1, 'SQLite format', 'a database of SQLite', as_table), &
      & kind_type(1, 'MS'//achar(3), 'a miniSEED file', as_text), &
      & kind_type(1, achar(195)//achar(64)//achar(241), 'a SEG-Y file', as_text), &
      & kind_type(1, 'TDSm', 'a TDMS file of LabVIEW', as_text), &
      & kind_type(1, '%PDF-', 'a PDF document', other), &
      & kind_type(1, '{\rtf', 'a document of a word processor (RTF)', other), &
      & kind_type(1, achar(31)//achar(139), 'an archive (gzip)', unpack), &
      & kind_type(1, 'BZh', 'an archive (bzip2)', unpack), &
      & kind_type(1, achar(253)//'7zXZ'//nul, 'an archive (xz)', unpack), &
      & kind_type(1, '7z'//achar(188)//achar(175)//achar(39)//achar(28), 'an archive (7-Zip)', unpack), &
      & kind_type(1, achar(40)//achar(181)//achar(47)//achar(253), 'an archive (Zstandard)', unpack), &
      & kind_type(1, 'Rar!'//achar(26)//achar(7), 'an archive (RAR)', unpack), &
      & kind_type(258, 'ustar', 'an archive (tar)', unpack), &
      & kind_type(1, achar(137)//'PNG'//line_end, 'a picture (PNG)', other), &
      & kind_type(1, achar(255)//achar(216)//achar(255), 'a picture (JPEG)', other), &
      & kind_type(1, 'GIF8', 'a picture (GIF)', other), &
      & kind_type(1, 'II*'//nul, 'a picture (TIFF)', other), &
      & kind_type(1, 'MM'//nul//'*', 'a picture (TIFF)', other), &
      & kind_type(9, 'WAVEfmt', 'a recording of sound (WAV)', of_python), &
      & kind_type(1, achar(128)//achar(2), 'a pickle of Python', of_python), &
      & kind_type(1, achar(128)//achar(3), 'a pickle of Python', of_python), &
      & kind_type(1, achar(128)//achar(4), 'a pickle of Python', of_python), &
      & kind_type(1, achar(128)//achar(5), 'a pickle of Python', of_python), &
      & kind_type(1, 'MZ'//achar(144)//nul, 'a program', other), &
      & kind_type(1, achar(127)//'ELF', 'a program', other)]

   !> Texts that are no accelerograms, by what they begin with in lower case
   type(kind_type), parameter :: markups(*) = [ &
      & kind_type(1, '<!doctype html', 'an HTML page', as_table), &
      & kind_type(1, '<html', 'an HTML page', as_table), &
      & kind_type(1, '<?xml', 'an XML file', of_python), &
      & kind_type(1, '{', 'a JSON file', of_python), &
      & kind_type(1, '[{', 'a JSON file', of_python), &
      & kind_type(1, '[[', 'a JSON file', of_python), &
      & kind_type(1, 'wid2', 'a GSE file', as_text), &
      & kind_type(1, 'wid1', 'a GSE file', as_text), &
      & kind_type(1, 'begin gse', 'a GSE file', as_text), &
      & kind_type(1, 'begin ims', 'a file of IMS messages', as_text)]

   !> Kinds of archives of ZIP, by a text that their list of files has
   type(kind_type), parameter :: archives(*) = [ &
      & kind_type(1, 'xl/', 'a workbook of a spreadsheet (xlsx)', as_table), &
      & kind_type(1, 'opendocument.s', 'a workbook of a spreadsheet (ods)', as_table), &
      & kind_type(1, 'word/', 'a document of a word processor (docx)', other), &
      & kind_type(1, 'opendocument.t', 'a document of a word processor (odt)', other), &
      & kind_type(1, '.npy', 'an archive of NumPy arrays', of_python)]

contains

   !> Is a file an archive of ZIP, whose list of files is at its end?
   pure logical function is_archive(head)
      !> Its first bytes
      character(len=*), intent(in) :: head

      is_archive = index(head, 'PK'//achar(3)//achar(4)) == 1 .or. index(head, 'PK'//achar(5)//achar(6)) == 1
   end function is_archive

   !> Say which kind of file this is, if it is no text
   pure subroutine describe_binary(head, problem)
      !> Its first bytes; of an archive of ZIP also its last ones
      character(len=*), intent(in) :: head
      !> What it seems to be, and what to do; empty: it may be a text
      character(len=:), allocatable, intent(out) :: problem

      type(kind_type) :: found
      integer :: i, last

      found = kind_type(0, '', '', unpack)
      do i = 1, size(kinds)
         last = kinds(i)%place - 1 + len_trim(kinds(i)%signature)
         if (last > len(head)) cycle
         if (head(kinds(i)%place:last) /= trim(kinds(i)%signature)) cycle
         found = kinds(i)
         exit
      end do
      if (found%place == 0 .and. is_miniseed(head)) found = kind_type(1, '', 'a miniSEED or SEED file', as_text)
      if (found%place == 0 .and. is_mat4(head)) found = kind_type(1, '', 'a MATLAB file (version 4)', of_python)
      if (found%place == 0 .and. is_sac(head)) found = kind_type(1, '', 'a SAC file', as_text)
      if (is_archive(head)) then
         found = kind_type(1, '', 'an archive (ZIP)', unpack)
         do i = size(archives), 1, -1
            if (index(head, trim(archives(i)%signature)) > 0) found = archives(i)
         end do
      end if
      problem = ''
      if (found%place > 0) problem = 'seems to be '//trim(found%what)//', not a text: '//trim(remedies(found%remedy))
   end subroutine describe_binary

   !> Say which kind of text this is, if it is one without lines of numbers
   pure subroutine describe_markup(text, problem)
      !> Its first line that is not empty
      character(len=*), intent(in) :: text
      !> What it seems to be, and what to do; empty: it may be an accelerogram
      character(len=:), allocatable, intent(out) :: problem

      integer :: i

      problem = ''
      do i = 1, size(markups)
         if (index(lower(adjustl(text))//' ', trim(markups(i)%signature)) == 1) problem = 'seems to be '// &
            & trim(markups(i)%what)//', not an accelerogram: '//trim(remedies(markups(i)%remedy))
      end do
   end subroutine describe_markup

   !> Is this a file of MATLAB 4? Five integers of four bytes: type, rows, columns, whether it is complex, length of the name,
   !> which follows with a NUL at its end
   pure logical function is_mat4(head)
      character(len=*), intent(in) :: head

      integer :: i

      is_mat4 = .false.
      if (len(head) < 84) return
      is_mat4 = any(iachar(head(1:1)) == [0, 10, 20, 30, 40, 50]) .and. iachar(head(13:13)) <= 1
      do i = 1, 17, 4
         if (i == 5 .or. i == 9) cycle
         is_mat4 = is_mat4 .and. head(i + 1:i + 3) == nul//nul//nul
      end do
      i = iachar(head(17:17))
      if (is_mat4) is_mat4 = i > 1 .and. i < 64
      if (is_mat4) is_mat4 = head(20 + i:20 + i) == nul .and. index(head(21:19 + i), nul) == 0
   end function is_mat4

   !> Is this a record of SEED? Six digits, the quality or the kind of the header, a blank; what follows has bytes of no text
   pure logical function is_miniseed(head)
      character(len=*), intent(in) :: head

      integer :: i

      is_miniseed = .false.
      if (len(head) < 48) return
      if (verify(head(:6), '0123456789 '//nul) > 0 .or. scan(head(7:7), 'DRQMVAST') == 0) return
      if (scan(head(8:8), ' *'//nul) == 0) return
      do i = 21, 48
         is_miniseed = is_miniseed .or. iachar(head(i:i)) < 9
      end do
      ! The control headers of full SEED are text: 000001V 0100...
      is_miniseed = is_miniseed .or. (scan(head(7:7), 'VAST') > 0 .and. verify(head(9:15), '0123456789') == 0)
   end function is_miniseed

   !> Is this a file of SAC? The version of its header, an integer of four bytes in either order, is 6 or 7
   pure logical function is_sac(head)
      character(len=*), intent(in) :: head

      is_sac = .false.
      if (len(head) < 632) return
      associate (version => head(305:308))
         is_sac = any(version == [achar(6)//nul//nul//nul, nul//nul//nul//achar(6), achar(7)//nul//nul//nul, &
            & nul//nul//nul//achar(7)])
      end associate
   end function is_sac

end module dondolo_files_file_kinds
