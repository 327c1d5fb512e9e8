!> The walls and facades of a population by their names: which rows belong together, and which names stand twice.
module dondolo_population_wall_names
   use dondolo_base_error, only : error_type, raise_input
   use dondolo_base_kinds, only : wp
   use dondolo_base_memory, only : raise_shortage
   use dondolo_base_name_index, only : name_index_type
   use dondolo_base_text, only : to_text
   use dondolo_population_wall_row, only : wall_row_type
   implicit none
   private

   public :: wall_names_type

   !> Memory that the index of names takes for a row while it grows [bytes]
   real(wp), parameter :: bytes_of_name = 72.0_wp

   !> The walls and facades so far, as rows are read one after the other
   type :: wall_names_type
      !> Are names looked up, to find those that stand twice? A table that was gone through before needs it no more
      logical :: is_checked = .true.
      !> Names of the walls so far
      type(name_index_type), private :: names
      !> The wall of the row before, its first row
      type(wall_row_type), private :: wall
      !> Name of the row before, and the mechanisms that it has had, with a blank after each
      character(len=:), allocatable, private :: name, mechanisms
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
      !> The name stands elsewhere too, or what is said of the wall differs
      type(error_type), allocatable, intent(out) :: error

      character(len=:), allocatable :: name, mechanism, what
      logical :: repeats

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
      if (.not. row%continues) then
         if (len(row%facade) > 0) call note_name(self, 'facade', row%facade, line, error)
         if (.not. allocated(error)) call note_name(self, 'name', name, line, error)
         if (allocated(error)) return
         self%wall = row
         self%wall%has_name = row%has_name .or. len(row%facade) > 0
         self%name = name
         self%mechanisms = mechanism//' '
      else if (repeats .and. index(self%mechanisms, mechanism//' ') > 0) then
         call raise_input(error, 'name = '''//name//''': the row before gives this wall the same mechanism')
      else if (abs(self%wall%weight - row%weight) > 0.0_wp) then
         call raise_input(error, 'weight = '//to_text(row%weight)//': must be '//to_text(self%wall%weight)// &
            & ' as in the row before, which is of the same '//what)
      else if (self%wall%group /= row%group) then
         call raise_input(error, 'group = '''//row%group//''': must be '''//self%wall%group// &
            & ''' as in the row before, which is of the same '//what)
      else if (repeats) then
         self%mechanisms = self%mechanisms//mechanism//' '
      else
         call note_name(self, 'name', name, line, error)
         self%name = name
         self%mechanisms = mechanism//' '
      end if
   end subroutine place_row

   !> Note that a row was wrong: those behind it do not go on with the wall before it, unless it was of the same
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
            & '); mechanisms of one wall must be on consecutive rows')
      else if (earlier > 0) then
         call raise_input(error, 'facade = '''//name//''': another facade has this name (line '//to_text(earlier)// &
            & '); walls of one facade must be on consecutive rows')
      end if
   end subroutine note_name

end module dondolo_population_wall_names
