!> A row of a population: one mechanism of a wall, with its weight, its group and its facade.
module dondolo_population_wall_row
   use dondolo_base_kinds, only : wp
   use dondolo_base_lines, only : lines_type
   use dondolo_base_property, only : blank, choices_length, is_text, most_choices, property_type
   use dondolo_base_text, only : lower
   use dondolo_population_occurrence, only : independent, occurrence_names
   use dondolo_wall, only : wall_type
   implicit none
   private

   public :: wall_row_type, row_properties, note_prefixes, is_note

   !> What the names of columns begin with that are kept with the walls as they stand, and decide nothing
   character(len=*), parameter :: note_prefixes(2) = [character(len=4) :: 'x_', 'note']

   !> Columns besides the properties of a wall
   type(property_type), target, protected :: row_properties(6) = [ &
      & property_type('weight', default=1.0_wp, smallest=0.0_wp, largest=1.0e12_wp, &
      &   meaning='weight of the wall in its population, such as the number of walls like it'), &
      & property_type('group', is_text, meaning='group of the wall, which gets curves of its own'), &
      & property_type('p_occ', default=1.0_wp, smallest=0.0_wp, largest=1.0_wp, &
      &   meaning='probability that the mechanism can occur'), &
      & property_type('occurrence', is_text, word=occurrence_names(independent), &
      &   choices=reshape(occurrence_names, [most_choices], pad=blank), &
      &   meaning='whether the mechanisms of the wall can occur together, or exclude each other'), &
      & property_type('alternative', is_text, meaning='name of one of several exclusive alternatives: its mechanisms, on '// &
      &   'consecutive rows, occur together'), &
      & property_type('facade', is_text, meaning='facade that the wall is part of: its walls, on consecutive rows, collapse '// &
      &   'in series')]

   !> A row: one mechanism of a wall
   type :: wall_row_type
      !> The wall with this mechanism
      type(wall_type) :: wall
      !> Weight of the wall, >= 0
      real(wp) :: weight = 1.0_wp
      !> Probability that the mechanism can occur
      real(wp) :: p_occ = 1.0_wp
      !> One of occurrence_names, for all rows of the wall or the facade
      character(len=choices_length) :: occurrence = occurrence_names(independent)
      !> Name of its alternative, empty if none was given; and the number of the alternative among those of the wall or the
      !> facade, 0 if its mechanisms are independent
      character(len=:), allocatable :: alternative
      integer :: number_of_alternative = 0
      !> Group of the wall, empty if none was given
      character(len=:), allocatable :: group
      !> Facade that the wall is part of, empty if none
      character(len=:), allocatable :: facade
      !> What stands in the columns that decide nothing
      type(lines_type) :: notes
      !> Is it a further mechanism of the wall, or of the facade, in the row before?
      logical :: continues = .false.
      !> Was its name given? A wall without one has one row
      logical :: has_name = .false.
   end type wall_row_type

contains

   !> Is a column one that is kept as it stands?
   pure logical function is_note(column)
      !> Its name
      character(len=*), intent(in) :: column

      is_note = any([index(lower(column), trim(note_prefixes(1))), index(lower(column), trim(note_prefixes(2)))] == 1)
   end function is_note

end module dondolo_population_wall_row
