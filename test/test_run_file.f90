!> What the file of a run is made of: JSON whatever is put in, checksums, warnings as facts and their sentences.
program test_run_file
   use, intrinsic :: ieee_arithmetic, only : ieee_positive_inf, ieee_quiet_nan, ieee_value
   use, intrinsic :: iso_fortran_env, only : int64
   use checks, only : check, check_text, finish, suite
   use dondolo_base_json, only : json_type
   use dondolo_base_kinds, only : wp
   use dondolo_base_lines, only : lines_type
   use dondolo_base_warning, only : warning_type, warnings_type
   use dondolo_case_echo, only : echo_type
   use dondolo_files_checksum, only : crc32_length, crc32_of_file
   implicit none

   character(len=*), parameter :: lf = new_line('a'), scratch = 'build/test_run_file'

   call test_json()
   call test_strings()
   call test_checksums()
   call test_settings()
   call test_warnings()
   call finish()

contains

   subroutine test_json()
      type(json_type) :: json
      character(len=:), allocatable :: text

      call suite('json')
      call json%open_object()
      call json%put('real', 0.1_wp)
      call json%put('whole', 396)
      call json%put('many', 3000000000_int64)
      call json%put('yes', .true.)
      call json%put('nan', ieee_value(0.0_wp, ieee_quiet_nan))
      call json%put('infinite', ieee_value(0.0_wp, ieee_positive_inf))
      call json%put('list', [1.0_wp, 1.0e-30_wp])
      call json%open_array('empty')
      call json%close_array()
      call json%open_array('words')
      call json%put('', 'a')
      call json%put('', 'b')
      call json%close_array()
      call json%close_object()
      call json%get(text)
      call check_text(text, '{'//lf//'  "real": 0.1,'//lf//'  "whole": 396,'//lf//'  "many": 3000000000,'//lf// &
         & '  "yes": true,'//lf//'  "nan": null,'//lf//'  "infinite": null,'//lf//'  "list": [1, 1e-30],'//lf// &
         & '  "empty": [],'//lf//'  "words": ['//lf//'    "a",'//lf//'    "b"'//lf//'  ]'//lf//'}', 'a document')
   end subroutine test_json

   subroutine test_strings()
      call suite('strings of json')
      call check_text(quoted('plain'), '["plain"]', 'plain')
      call check_text(quoted('a "b" \ c'), '["a \"b\" \\ c"]', 'quotes and backslashes')
      call check_text(quoted(achar(10)//achar(0)//achar(31)//achar(127)), '["\u000a\u0000\u001f\u007f"]', &
         & 'control characters')
      call check_text(quoted('\u00e8 caff'//char(195)//char(168)), '["\\u00e8 caff'//char(195)//char(168)//'"]', 'UTF-8')
      call check_text(quoted('caff'//char(232)), '["caff\ufffd"]', 'bytes that are not UTF-8')
      call check_text(quoted(repeat('x', 5000)), '["'//repeat('x', 5000)//'"]', 'long')
   end subroutine test_strings

   !> An array of one string, on one line
   function quoted(text)
      character(len=*), intent(in) :: text
      character(len=:), allocatable :: quoted
      type(json_type) :: json

      json = json_type(is_compact=.true.)
      call json%open_array()
      call json%put('', text)
      call json%close_array()
      call json%get(quoted)
   end function quoted

   !> Against zlib, lengths around the ends of words and of what is read at once
   subroutine test_checksums()
      call suite('checksums')
      call check_sum('123456789', 'cbf43926')
      call check_sum('', '00000000')
      call check_sum(repeat('a', 1), 'e8b7be43')
      call check_sum(repeat('a', 7), '5b8b2074')
      call check_sum(repeat('a', 8), 'bf848046')
      call check_sum(repeat('a', 9), '77b7de66')
      call check_sum(repeat('a', 65536), 'c32091ff')
      call check_sum(repeat('a', 65543), 'babec14e')
      call check_sum(repeat('a', 1000000), 'dc25bfbc')
   end subroutine test_checksums

   subroutine check_sum(text, expected)
      character(len=*), intent(in) :: text, expected
      character(len=crc32_length) :: found
      integer(int64) :: bytes
      integer :: unit
      logical :: ok

      open (newunit=unit, file=scratch//'.bin', access='stream', form='unformatted', action='write', status='replace')
      write (unit) text
      close (unit)
      call crc32_of_file(scratch//'.bin', found, bytes, ok)
      call check(ok .and. bytes == len(text), 'read')
      call check_text(found, expected, 'checksum')
      open (newunit=unit, file=scratch//'.bin')
      close (unit, status='delete')
      call crc32_of_file(scratch//'.bin', found, bytes, ok)
      call check(.not. ok, 'no such file')
   end subroutine check_sum

   subroutine test_settings()
      type(echo_type) :: echo
      type(lines_type) :: lines
      type(json_type) :: json
      character(len=:), allocatable :: text

      call suite('settings')
      call echo%add('job', 'title', 'It''s "one"')
      call echo%add('job', 'threads', 2)
      call echo%add('solver', 'rtol', 1.0e-8_wp)
      call echo%add('solver', 'atol', 1.0e-10_wp, joins=.true.)
      call echo%add('solver', 'estimate_error', .false.)
      call echo%add('stripes', 'levels', [0.5_wp, 1.0_wp])
      call echo%to_namelist(lines)
      call check(lines%count == 5, 'lines')
      call check_text(lines%line(1)%text, '&job title = ''It''''s "one"''', 'a title')
      call check_text(lines%line(2)%text, '     threads = 2 /', 'the end of a group')
      call check_text(lines%line(3)%text, '&solver rtol = 1e-8, atol = 1e-10', 'two on a line')
      call check_text(lines%line(4)%text, '        estimate_error = .false. /', 'a logical')
      call check_text(lines%line(5)%text, '&stripes levels = 0.5, 1 /', 'a list')
      json = json_type(is_compact=.true.)
      call json%open_object()
      call echo%to_json(json)
      call json%close_object()
      call json%get(text)
      call check_text(text, '{"settings": {"job": {"title": "It''s \"one\"", "threads": 2}, "solver": {"rtol": 1e-8, '// &
         & '"atol": 1e-10, "estimate_error": false}, "stripes": {"levels": [0.5, 1]}}}', 'JSON')
   end subroutine test_settings

   !> The sentence and the object of a warning; more warnings than there is room at first
   subroutine test_warnings()
      type(warning_type) :: warning
      type(warnings_type) :: warnings
      type(lines_type) :: sentences, objects
      integer :: i

      call suite('warnings')
      warning = warning_type('scale_factors_large')
      call warning%about('record', 'r "1"')
      call warning%with('limit', 10.0_wp)
      call warning%with('histories_beyond', 3)
      call warning%with('histories', 3000000000_int64)
      call warning%with('largest', 12.34567_wp)
      call warning%with('level', 0.5_wp)
      do i = 1, 20
         call warnings%add(warning, 'scale factors above 10 (record ''r "1"'' at level 0.5)')
      end do
      call warnings%put_sentences(sentences)
      call warnings%put_objects(objects)
      call check(sentences%count == 20 .and. objects%count == 20, 'all')
      call check_text(sentences%line(20)%text, 'scale factors above 10 (record ''r "1"'' at level 0.5)', 'sentence')
      call check_text(objects%line(20)%text, '{"code": "scale_factors_large", "subject": {"record": "r \"1\""}, '// &
         & '"numbers": {"limit": 10, "histories_beyond": 3, "histories": 3000000000, "largest": 12.34567, "level": 0.5}, '// &
         & '"sentence": "scale factors above 10 (record ''r \"1\"'' at level 0.5)"}', 'object')
   end subroutine test_warnings

end program test_run_file
