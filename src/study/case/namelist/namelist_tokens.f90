!> The text of a namelist file, cut into tokens: words, texts in quotes, =, commas, &name and /.
module dondolo_case_namelist_tokens
   use dondolo_base_error, only : error_type, raise_input
   use dondolo_base_limits, only : most_tokens
   use dondolo_base_odd_character, only : odd_character, odd_length
   use dondolo_base_plain, only : shown
   use dondolo_base_text, only : lower, to_text
   use dondolo_files_text_file, only : text_file_type
   implicit none
   private

   public :: token_type, cut
   public :: word, quoted, equals, comma, group_begin, group_end, end_of_file

   !> Kinds of tokens: a word, a text in quotes, =, a comma, & with a name, the / that ends a group, nothing more
   integer, parameter :: word = 1, quoted = 2, equals = 3, comma = 4, group_begin = 5, group_end = 6, end_of_file = 7

   !> Blanks between tokens
   character(len=*), parameter :: blanks = ' '//achar(9)

   !> What ends a word
   character(len=*), parameter :: word_ends = blanks//',=!/&''"'

   !> Quotes that word processors put for straight ones, in UTF-8: single and double ones up, down, and in angles
   character(len=*), parameter :: print_quotes(8) = [character(len=3) :: &
      & achar(226)//achar(128)//achar(152), achar(226)//achar(128)//achar(153), achar(226)//achar(128)//achar(154), &
      & achar(226)//achar(128)//achar(156), achar(226)//achar(128)//achar(157), achar(226)//achar(128)//achar(158), &
      & achar(194)//achar(171), achar(194)//achar(187)]

   !> One token
   type :: token_type
      !> Its kind
      integer :: kind = end_of_file
      !> As it was typed
      character(len=:), allocatable :: typed
      !> Without quotes or ampersand
      character(len=:), allocatable :: text
      !> Its line
      integer :: line = 0
      !> Does it follow the token before without a blank?
      logical :: touches = .false.
   end type token_type

contains

   !> Cut a text into tokens; the last one is the end of the file
   subroutine cut(text, tokens, error)
      type(text_file_type), intent(in) :: text
      !> Its tokens
      type(token_type), allocatable, intent(out) :: tokens(:)
      !> A quote that is not closed, a group without a name
      type(error_type), allocatable, intent(out) :: error

      character(len=:), allocatable :: line
      integer :: count, number, at

      allocate (tokens(64))
      count = 0
      do number = 1, text%lines()
         line = text%line(number)
         at = 1
         do while (at <= len(line))
            if (index(blanks, line(at:at)) > 0) then
               at = at + 1
               cycle
            end if
            if (line(at:at) == '!') exit
            if (count + 1 >= size(tokens)) call widen(tokens)
            if (count == most_tokens) then
               call raise_input(error, text%place(number)//': a case may have at most '//to_text(most_tokens)// &
                  & ' words, values and signs')
               return
            end if
            count = count + 1
            tokens(count)%line = number
            if (at > 1) tokens(count)%touches = index(blanks, line(at - 1:at - 1)) == 0
            call take_token(line, at, tokens(count), error)
            if (allocated(error)) then
               error%message = text%place(number)//': '//error%message
               return
            end if
         end do
      end do
      ! The token after the last one was never filled: it is the end of the file
      tokens = tokens(:count + 1)
      tokens(count + 1)%line = text%lines()
   end subroutine cut

   !> Double the room for tokens
   subroutine widen(tokens)
      !> Tokens
      type(token_type), allocatable, intent(inout) :: tokens(:)

      type(token_type), allocatable :: more(:)

      allocate (more(2*size(tokens)))
      more(:size(tokens)) = tokens
      call move_alloc(more, tokens)
   end subroutine widen

   !> Take one token
   subroutine take_token(line, at, token, error)
      !> Line
      character(len=*), intent(in) :: line
      !> Position of the token, then of what follows it
      integer, intent(inout) :: at
      !> The token, its line already known
      type(token_type), intent(inout) :: token
      !> What is wrong with it
      type(error_type), allocatable, intent(out) :: error

      integer :: first, i

      do i = 1, size(print_quotes)
         if (line(at:min(at + len_trim(print_quotes(i)) - 1, len(line))) /= print_quotes(i)) cycle
         call raise_input(error, 'the quote '//trim(print_quotes(i))//' of a word processor: must be a straight one, ''')
         return
      end do
      first = at
      select case (line(at:at))
      case ('''', '"')
         call take_quoted(line, at, token, error)
         if (allocated(error)) return
      case ('=')
         token%kind = equals
         at = at + 1
      case (',')
         token%kind = comma
         at = at + 1
      case ('/')
         token%kind = group_end
         at = at + 1
         if (at <= len(line)) then
            if (index(blanks//'!&', line(at:at)) == 0) then
               if (line(at:at) == '/') then
                  call raise_input(error, '// is no comment: comments begin with !')
               else
                  call raise_input(error, 'text right after a /: quote paths and other strings, and write numbers as decimals')
               end if
               return
            end if
         end if
      case ('&')
         at = word_end(line, at + 1)
         token%kind = group_begin
         token%text = lower(line(first + 1:at - 1))
         if (token%text == 'end') token%kind = group_end
         if (len(token%text) == 0) then
            call raise_input(error, 'an & without the name of a group')
            return
         end if
      case default
         at = word_end(line, at)
         token%kind = word
         token%text = line(first:at - 1)
         if (line(first:first) == '#' .or. line(first:first) == '%') then
            call raise_input(error, line(first:first)//' is no comment: comments begin with !')
            return
         end if
         if (len_trim(odd_character(token%text)) > 0) then
            call raise_input(error, trim(odd_character(token%text))//' in '//shown(token%text)//': must be an ordinary '// &
               & 'character of the keyboard')
            return
         end if
      end select
      token%typed = line(first:at - 1)
   end subroutine take_token

   !> Position after a word
   pure integer function word_end(line, first)
      !> Line
      character(len=*), intent(in) :: line
      !> Position of the first character of the word
      integer, intent(in) :: first

      word_end = scan(line(first:), word_ends)
      if (word_end == 0) word_end = len(line) - first + 2
      word_end = first + word_end - 1
   end function word_end

   !> Take a text in quotes; a quote inside is doubled
   subroutine take_quoted(line, at, token, error)
      !> Line
      character(len=*), intent(in) :: line
      !> Position of the opening quote, then of what follows the closing one
      integer, intent(inout) :: at
      type(token_type), intent(inout) :: token
      !> The quote is not closed, or text follows it
      type(error_type), allocatable, intent(out) :: error

      character(len=odd_length) :: strange
      character(len=1) :: quote
      integer :: length, first, doubled, from, i

      first = at
      quote = line(at:at)
      token%kind = quoted
      doubled = 0
      do
         length = index(line(at + 1:), quote)
         if (length == 0) then
            call raise_input(error, 'the quote before '''//trim(line(first + 1:))//''' is not closed on its line')
            return
         end if
         at = at + length + 1
         if (at > len(line)) exit
         if (line(at:at) /= quote) exit
         doubled = doubled + 1
      end do
      token%text = repeat(' ', at - first - 2 - doubled)
      from = first
      do i = 1, len(token%text)
         from = from + 1
         token%text(i:i) = line(from:from)
         if (line(from:from) == quote) from = from + 1
      end do
      if (at > len(line)) return
      if (index(word_ends, line(at:at)) > 0) return
      ! UTF-8 has up to four bytes a character
      strange = odd_character(line(at:min(at + 3, len(line))))
      if (len_trim(strange) > 0) then
         call raise_input(error, trim(strange)//' right after '//shown(line(first:at - 1))// &
            & ': must be an ordinary character of the keyboard')
         return
      end if
      call raise_input(error, 'text right after the quote that closes '//shown(line(first:at - 1))// &
         & ': a quote inside is doubled, ''L''''Aquila''')
   end subroutine take_quoted

end module dondolo_case_namelist_tokens
