!> The walls and facades of a population by their names: which rows belong together, and which names are duplicates.
module dondolo_population_wall_names
   use dondolo_base_error, only : error_type, not_a_word, not_together, out_of_range, raise_input
   use dondolo_base_kinds, only : wp
   use dondolo_base_lines, only : lines_type
   use dondolo_base_memory, only : raise_shortage
   use dondolo_base_text, only : rounded, to_text
   use dondolo_files_name_index, only : name_index_type
   use dondolo_population_occurrence, only : exclusive, occurrence_names, sum_tolerance
   use dondolo_population_wall_row, only : wall_row_type
   implicit none
   private

   public :: wall_names_type

   !> Memory that the index of names takes for a row while it grows [bytes]
   real(wp), parameter :: bytes_of_name = 72.0_wp

   !> The walls and facades so far, as rows are read one after the other
   type :: wall_names_type
      !> Are names looked up, to find duplicates? A table that was gone through before needs it no more
      logical :: is_checked = .true.
      !> Names of the walls so far
      type(name_index_type), private :: names
      !> The wall of the row before, its first row
      type(wall_row_type), private :: wall
      !> Name of the row before, and the mechanisms that it has had in its alternative, with a blank after each
      character(len=:), allocatable, private :: name, mechanisms
      !> Alternatives of the wall or the facade so far: their names and the sum of their probabilities; of the last, its number
      !> and its probability
      type(lines_type), private :: alternatives
      real(wp), private :: total = 0.0_wp, p_occ = 0.0_wp
      integer, private :: alternative = 0
   contains
      !> Place a row among those before it
      procedure :: place_row
      !> Note that a row was wrong
      procedure :: pass_over
   end type wall_names_type

contains

   !> Place a row among those before it: a further mechanism of the wall or the facade before, or a new one
   subroutine place_row(self, line, row, error)
      !> It remembers the wall
      class(wall_names_type), intent(inout) :: self
      !> Line of the row, for messages
      integer, intent(in) :: line
      !> The row: whether it continues the wall before is set
      type(wall_row_type), intent(inout) :: row
      !> The name also occurs elsewhere, or the properties of the wall differ
      type(error_type), allocatable, intent(out) :: error

      character(len=:), allocatable :: name, mechanism, what
      logical :: repeats, is_other

      name = row%wall%name()
      mechanism = row%wall%mechanism_name()
      what = 'wall'
      if (len(row%facade) > 0) what = 'facade'
      repeats = .false.
      if (self%wall%has_name .and. row%has_name) repeats = self%name == name
      if (len(row%facade) > 0) then
         if (self%wall%has_name) row%continues = self%wall%facade == row%facade
      else if (repeats) then
         row%continues = len(self%wall%facade) == 0
      end if
      is_other = row%continues .and. row%occurrence == occurrence_names(exclusive) .and. .not. is_of_last_alternative(self, row)
      if (.not. row%continues) then
         if (len(row%facade) > 0) call note_name(self, 'facade', row%facade, line, error)
         if (.not. allocated(error)) call note_name(self, 'name', name, line, error)
         if (allocated(error)) return
         self%wall = row
         self%wall%has_name = row%has_name .or. len(row%facade) > 0
         self%name = name
         self%mechanisms = mechanism//' '
         self%alternatives = lines_type()
         self%alternative = 0
         self%total = 0.0_wp
      else if (repeats .and. .not. is_other .and. index(self%mechanisms, mechanism//' ') > 0) then
         call raise_input(error, 'name = '''//name//''': the row before gives this wall the same mechanism')
      else if (abs(self%wall%weight - row%weight) > 0.0_wp) then
         call raise_input(error, 'weight = '//to_text(row%weight)//': must be '//to_text(self%wall%weight)// &
            & ' as in the row before, which is of the same '//what, out_of_range, 'weight')
      else if (self%wall%group /= row%group) then
         call raise_input(error, 'group = '''//row%group//''': must be '''//self%wall%group// &
            & ''' as in the row before, which is of the same '//what, not_a_word, 'group')
      else if (self%wall%occurrence /= row%occurrence) then
         call raise_input(error, 'occurrence = '''//trim(row%occurrence)//''': must be '''//trim(self%wall%occurrence)// &
            & ''' as in the row before, which is of the same '//what, not_a_word, 'occurrence')
      else if (repeats .and. is_other) then
         self%mechanisms = mechanism//' '
      else if (repeats) then
         self%mechanisms = self%mechanisms//mechanism//' '
      else
         call note_name(self, 'name', name, line, error)
         self%name = name
         self%mechanisms = mechanism//' '
      end if
      if (.not. allocated(error)) call place_alternative(self, what, row, error)
   end subroutine place_row

   !> Is a further row of a wall of the alternative of the row before? Rows without a name of one are alternatives each
   pure logical function is_of_last_alternative(self, row)
      class(wall_names_type), intent(in) :: self
      type(wall_row_type), intent(in) :: row

      is_of_last_alternative = self%alternative > 0 .and. len(row%alternative) > 0
      if (is_of_last_alternative) is_of_last_alternative = self%alternatives%line(self%alternative)%text == row%alternative
   end function is_of_last_alternative

   !> Number the alternative of a row among those of its wall, of which only one occurs
   subroutine place_alternative(self, what, row, error)
      class(wall_names_type), intent(inout) :: self
      !> 'wall' or 'facade'
      character(len=*), intent(in) :: what
      !> The row, placed among those of the wall: the number of its alternative is set
      type(wall_row_type), intent(inout) :: row
      !> It does not go together with those before
      type(error_type), allocatable, intent(out) :: error

      character(len=:), allocatable :: whole
      integer :: i

      if (row%occurrence /= occurrence_names(exclusive)) then
         if (len(row%alternative) > 0) call raise_input(error, 'alternative = '''//row%alternative// &
            & ''': only for occurrence = '''//trim(occurrence_names(exclusive))//'''', not_together, 'alternative')
         return
      end if
      if (is_of_last_alternative(self, row)) then
         row%number_of_alternative = self%alternative
         if (abs(self%p_occ - row%p_occ) > 0.0_wp) call raise_input(error, 'p_occ = '//to_text(row%p_occ)//': must be '// &
            & to_text(self%p_occ)//' as in the row before, which is of the same alternative', out_of_range, 'p_occ')
         return
      end if
      do i = 1, self%alternative
         if (len(row%alternative) == 0) exit
         if (self%alternatives%line(i)%text /= row%alternative) cycle
         call raise_input(error, 'alternative = '''//row%alternative//''': its rows must be consecutive', &
            & out_of_range, 'alternative')
         return
      end do
      self%alternative = self%alternative + 1
      row%number_of_alternative = self%alternative
      call self%alternatives%add(row%alternative)
      self%p_occ = row%p_occ
      self%total = self%total + row%p_occ
      if (self%total <= 1.0_wp + sum_tolerance) return
      whole = self%wall%wall%name()
      if (what == 'facade') whole = row%facade
      call raise_input(error, 'p_occ = '//to_text(row%p_occ)//': the probabilities of the exclusive alternatives of '//what// &
         & ' '''//whole//''' add up to '//rounded(self%total)//', must be at most 1', out_of_range, 'p_occ')
   end subroutine place_alternative

   !> Note an erroneous row: rows after it do not continue the wall before it, unless the row belonged to that wall
   pure subroutine pass_over(self, row)
      class(wall_names_type), intent(inout) :: self
      !> What is known of the row
      type(wall_row_type), intent(in) :: row

      if (self%wall%has_name) self%wall%has_name = self%name == row%wall%name() .or. &
         & (len(row%facade) > 0 .and. self%wall%facade == row%facade)
   end subroutine pass_over

   !> Note the name of a wall or a facade, which no other has; a wall may have that of its facade
   subroutine note_name(self, property, name, line, error)
      class(wall_names_type), intent(inout) :: self
      !> What it is the name of: 'name' or 'facade'
      character(len=*), intent(in) :: property
      !> The name
      character(len=*), intent(in) :: name
      !> Line of the row
      integer, intent(in) :: line
      !> Another has it
      type(error_type), allocatable, intent(out) :: error

      integer :: earlier

      if (.not. self%is_checked) return
      earlier = 0
      call self%names%note(property//' '//name, max(line, 1), earlier)
      if (self%names%lacks_memory) then
         call raise_shortage(bytes_of_name*real(line, wp), error)
      else if (earlier > 0 .and. property == 'name') then
         call raise_input(error, 'name = '''//name//''': another wall has this name (line '//to_text(earlier)// &
            & '); mechanisms of one wall must be on consecutive rows', out_of_range, 'name')
      else if (earlier > 0) then
         call raise_input(error, 'facade = '''//name//''': another facade has this name (line '//to_text(earlier)// &
            & '); walls of one facade must be on consecutive rows', out_of_range, 'facade')
      end if
   end subroutine note_name

end module dondolo_population_wall_names
