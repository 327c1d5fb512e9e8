!> Header lines of the kind `key: value`.
module dondolo_records_labels
   use dondolo_base_error, only : error_type
   use dondolo_base_kinds, only : wp
   use dondolo_base_numbers, only : parse_integer, parse_real
   use dondolo_base_plain, only : shown
   use dondolo_base_text, only : stripped
   use dondolo_files_text_file, only : text_file_type
   use dondolo_record_metadata, only : metadata_type
   use dondolo_records_format, only : raise_at
   implicit none
   private

   public :: label_type, labels_type, read_labels

   !> One line
   type :: label_type
      !> Key, without blanks around
      character(len=:), allocatable :: key
      !> Value, without blanks around
      character(len=:), allocatable :: value
      !> Number of the line
      integer :: line = 1
   end type label_type

   !> The labelled lines of a header
   type :: labels_type
      !> The lines, in order
      type(label_type), allocatable :: labels(:)
   contains
      !> Value of a key
      procedure :: value_of
      !> Number of its line, 0 if there is none
      procedure :: line_of
      !> Positive integer of a key
      procedure :: get_count
      !> Positive number of a key
      procedure :: get_positive
      !> All lines as metadata
      procedure :: add_to
   end type labels_type

contains

   !> Read labelled lines
   subroutine read_labels(text, first_line, last_line, labels, width)
      type(text_file_type), intent(in) :: text
      !> First line to look at
      integer, intent(in) :: first_line
      !> Last line to look at
      integer, intent(in) :: last_line
      !> The lines that hold a colon after the key, or all if `width` is given
      type(labels_type), intent(out) :: labels
      !> Characters of the key, where no colon ends it
      integer, intent(in), optional :: width

      type(label_type), allocatable :: found(:)
      character(len=:), allocatable :: line
      integer :: i, mark, count, after

      allocate (found(max(0, last_line - first_line + 1)))
      count = 0
      do i = max(first_line, 1), last_line
         line = text%line(i)
         if (present(width)) then
            mark = min(width, len(line)) + 1
            after = mark
         else
            mark = index(line, ':')
            after = mark + 1
         end if
         if (mark < 2) cycle
         count = count + 1
         found(count)%key = stripped(line(:mark - 1))
         found(count)%value = stripped(line(after:))
         found(count)%line = i
      end do
      labels%labels = found(:count)
   end subroutine read_labels

   !> Number of the first label of a key, 0 if there is none
   pure integer function find(self, key) result(i)
      class(labels_type), intent(in) :: self
      !> Key
      character(len=*), intent(in) :: key

      do i = 1, size(self%labels)
         if (self%labels(i)%key == key) return
      end do
      i = 0
   end function find

   !> Length of the value of a key
   pure integer function value_length(self, key)
      class(labels_type), intent(in) :: self
      !> Key
      character(len=*), intent(in) :: key

      integer :: i

      value_length = 0
      i = find(self, key)
      if (i > 0) value_length = len(self%labels(i)%value)
   end function value_length

   !> Value of a key
   pure function value_of(self, key) result(value)
      class(labels_type), intent(in) :: self
      !> Key
      character(len=*), intent(in) :: key
      !> Its value, empty if there is none
      character(len=value_length(self, key)) :: value

      if (len(value) > 0) value = self%labels(find(self, key))%value
   end function value_of

   !> Line of a key
   pure integer function line_of(self, key) result(line)
      class(labels_type), intent(in) :: self
      !> Key
      character(len=*), intent(in) :: key

      line = find(self, key)
      if (line > 0) line = self%labels(line)%line
   end function line_of

   !> Positive integer of a key
   subroutine get_count(self, text, key, count, error)
      class(labels_type), intent(in) :: self
      type(text_file_type), intent(in) :: text
      !> Key
      character(len=*), intent(in) :: key
      !> Its value
      integer, intent(out) :: count
      !> The key is missing or its value is no positive integer
      type(error_type), allocatable, intent(out) :: error

      logical :: ok

      call parse_integer(self%value_of(key), count, ok)
      if (ok .and. count > 0) return
      call raise_at(error, text, max(self%line_of(key), 1), key//' = '''//shown(self%value_of(key))// &
         & ''': must be a positive integer')
   end subroutine get_count

   !> Positive number of a key
   subroutine get_positive(self, text, key, value, error, unit)
      class(labels_type), intent(in) :: self
      type(text_file_type), intent(in) :: text
      !> Key
      character(len=*), intent(in) :: key
      !> Its value
      real(wp), intent(out) :: value
      !> The key is missing or its value is no positive number
      type(error_type), allocatable, intent(out) :: error
      !> What may follow the number
      character(len=*), intent(in), optional :: unit

      character(len=:), allocatable :: number
      logical :: ok

      number = self%value_of(key)
      if (present(unit)) then
         if (index(number, unit, back=.true.) > 0) number = number(:index(number, unit, back=.true.) - 1)
      end if
      call parse_real(number, value, ok)
      if (ok .and. value > 0.0_wp) return
      call raise_at(error, text, max(self%line_of(key), 1), key//' = '''//shown(self%value_of(key))// &
         & ''': must be a positive number')
   end subroutine get_positive

   !> Add all lines to metadata, where their keys do not stand yet
   subroutine add_to(self, metadata)
      class(labels_type), intent(in) :: self
      type(metadata_type), intent(inout) :: metadata

      integer :: i

      do i = 1, size(self%labels)
         if (len(metadata%get(self%labels(i)%key)) > 0) cycle
         call metadata%set(self%labels(i)%key, self%labels(i)%value)
      end do
   end subroutine add_to

end module dondolo_records_labels
