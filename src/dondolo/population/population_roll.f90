!> The walls and facades of a population by their names: which rows belong together, and which names stand twice.
module dondolo_population_roll
   use dondolo_error, only : error_type, raise_input
   use dondolo_kinds, only : wp
   use dondolo_member, only : member_type
   use dondolo_memory, only : raise_shortage
   use dondolo_name_index, only : name_index_type
   use dondolo_population_table, only : population_table_type
   use dondolo_text, only : to_text
   implicit none
   private

   public :: population_roll_type

   !> Memory that the index of names takes for a row while it grows [bytes]
   real(wp), parameter :: bytes_of_name = 72.0_wp

   !> A table whose rows are read one after the other, and the walls so far
   type, extends(population_table_type) :: population_roll_type
      !> Number of the row that was read last
      integer :: row = 0
      !> Are names looked up, to find those that stand twice, and is a weight asked for? A table that was read before
      !> needs it no more
      logical :: is_checked = .true.
      !> Names of the walls so far
      type(name_index_type) :: names
      !> The wall of the row before, its first row
      type(member_type) :: wall
      !> Name of the row before, and the mechanisms that it has had, with a blank after each
      character(len=:), allocatable :: name, mechanisms
   contains
      !> Place a row among those before it
      procedure :: place_row
   end type population_roll_type

contains

   !> Place a row among those before it: a further mechanism of the wall or the facade before, or a new one
   subroutine place_row(self, member, error)
      !> It remembers the wall
      class(population_roll_type), intent(inout) :: self
      !> The row: whether it continues the wall before is set
      type(member_type), intent(inout) :: member
      !> The name stands elsewhere too, or what is said of the wall differs
      type(error_type), allocatable, intent(out) :: error

      character(len=:), allocatable :: name, mechanism, what
      logical :: repeats

      name = member%wall%name()
      mechanism = member%wall%mechanism_name()
      what = 'wall'
      if (len(member%facade) > 0) what = 'facade'
      repeats = self%wall%has_name .and. member%has_name .and. self%name == name
      if (len(member%facade) > 0) then
         member%continues = self%wall%has_name .and. self%wall%facade == member%facade
      else if (repeats) then
         member%continues = len(self%wall%facade) == 0
      end if
      if (.not. member%continues) then
         if (len(member%facade) > 0) call note_name(self, 'facade', member%facade, error)
         if (.not. allocated(error)) call note_name(self, 'name', name, error)
         if (allocated(error)) return
         self%wall = member
         self%wall%has_name = member%has_name .or. len(member%facade) > 0
         self%name = name
         self%mechanisms = mechanism//' '
      else if (repeats .and. index(self%mechanisms, mechanism//' ') > 0) then
         call raise_input(error, 'name = '''//name//''': the row before gives this wall the same mechanism')
      else if (abs(self%wall%weight - member%weight) > 0.0_wp) then
         call raise_input(error, 'weight = '//to_text(member%weight)//': must be '//to_text(self%wall%weight)// &
            & ' as in the row before, which is of the same '//what)
      else if (self%wall%group /= member%group) then
         call raise_input(error, 'group = '''//member%group//''': must be '''//self%wall%group// &
            & ''' as in the row before, which is of the same '//what)
      else if (repeats) then
         self%mechanisms = self%mechanisms//mechanism//' '
      else
         call note_name(self, 'name', name, error)
         self%name = name
         self%mechanisms = mechanism//' '
      end if
   end subroutine place_row

   !> Note the name of a wall or a facade, which no other has; a wall may have that of its facade
   subroutine note_name(self, property, name, error)
      class(population_roll_type), intent(inout) :: self
      !> What it is the name of: 'name' or 'facade'
      character(len=*), intent(in) :: property
      !> The name
      character(len=*), intent(in) :: name
      !> Another has it
      type(error_type), allocatable, intent(out) :: error

      integer :: line

      if (.not. self%is_checked) return
      line = 0
      call self%names%note(property//' '//name, max(self%table%line, 1), line)
      if (self%names%lacks_memory) then
         call raise_shortage(bytes_of_name*real(self%row, wp), error)
      else if (line > 0 .and. property == 'name') then
         call raise_input(error, 'name = '''//name//''': another wall has this name (line '//to_text(line)// &
            & '); mechanisms of one wall must be on consecutive rows')
      else if (line > 0) then
         call raise_input(error, 'facade = '''//name//''': another facade has this name (line '//to_text(line)// &
            & '); walls of one facade must be on consecutive rows')
      end if
   end subroutine note_name

end module dondolo_population_roll
