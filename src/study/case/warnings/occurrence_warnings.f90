!> Warnings of the probabilities that the mechanisms of a wall can occur: those that look like shares of one whole, of which only
!> one occurs, but are taken as independent.
module dondolo_case_occurrence_warnings
   use dondolo_base_kinds, only : wp
   use dondolo_base_text, only : to_text
   use dondolo_base_warning, only : warning_type, warnings_type
   use dondolo_population_occurrence, only : exclusive, occurrence_names, sum_tolerance
   use dondolo_population_wall_row, only : wall_row_type
   implicit none
   private

   public :: occurrence_warnings_type

   !> Codes
   character(len=*), parameter :: probabilities_sum_to_one = 'probabilities_sum_to_one'

   !> Walls looked at, and what to warn of
   type :: occurrence_warnings_type
      private
      !> Walls looked at, those whose probabilities add up to 1, and the name of the first of them
      integer :: walls = 0, number = 0
      character(len=:), allocatable :: first
      !> The wall of the row looked at last: its name, its mechanisms that may occur, and the sum of their probabilities
      character(len=:), allocatable :: name
      integer :: mechanisms = 0
      real(wp) :: total = 0.0_wp
   contains
      !> Look at a row of a population
      procedure :: look
      !> Look at a mechanism of a wall
      procedure :: look_at
      !> Warn, if there is reason to
      procedure :: warn
   end type occurrence_warnings_type

contains

   !> Look at a row of a population, one after the other
   subroutine look(self, row)
      class(occurrence_warnings_type), intent(inout) :: self
      type(wall_row_type), intent(in) :: row

      if (len(row%facade) > 0) then
         call self%look_at(row%facade, row%p_occ, row%number_of_alternative, row%continues)
      else
         call self%look_at(row%wall%name(), row%p_occ, row%number_of_alternative, row%continues)
      end if
   end subroutine look

   !> Look at a mechanism of a wall, one after the other
   subroutine look_at(self, name, p_occ, alternative, continues)
      class(occurrence_warnings_type), intent(inout) :: self
      !> Name of the wall, or of the facade
      character(len=*), intent(in) :: name
      !> Probability that the mechanism can occur
      real(wp), intent(in) :: p_occ
      !> Number of its alternative; 0: the mechanisms of the wall are independent
      integer, intent(in) :: alternative
      !> Is it a further mechanism of the wall before?
      logical, intent(in) :: continues

      if (.not. continues) then
         call close_wall(self)
         self%walls = self%walls + 1
         self%name = name
      end if
      if (alternative > 0 .or. .not. p_occ > 0.0_wp) return
      self%mechanisms = self%mechanisms + 1
      self%total = self%total + p_occ
   end subroutine look_at

   !> All rows of a wall have been
   pure subroutine close_wall(self)
      type(occurrence_warnings_type), intent(inout) :: self

      if (self%mechanisms > 1 .and. abs(self%total - 1.0_wp) <= sum_tolerance) then
         self%number = self%number + 1
         if (self%number == 1) self%first = self%name
      end if
      self%mechanisms = 0
      self%total = 0.0_wp
   end subroutine close_wall

   !> Warn, if there is reason to
   subroutine warn(self, warnings)
      class(occurrence_warnings_type), intent(in) :: self
      !> Warnings to add to
      type(warnings_type), intent(inout) :: warnings

      type(occurrence_warnings_type) :: all
      type(warning_type) :: warning
      character(len=:), allocatable :: sentence

      all = self
      call close_wall(all)
      if (all%number == 0) return
      warning = warning_type(probabilities_sum_to_one)
      call warning%about('wall', all%first)
      call warning%with('walls_beyond', all%number)
      call warning%with('walls', all%walls)
      sentence = 'wall '''//all%first//''': the probabilities of its mechanisms add up to 1, but they are independent and may '// &
         & 'occur together: do they exclude each other (occurrence = '''//trim(occurrence_names(exclusive))//''')?'
      if (all%walls > 1) sentence = sentence//' ('//to_text(all%number)//' of '//to_text(all%walls)//' in all)'
      call warnings%add(warning, sentence)
   end subroutine warn

end module dondolo_case_occurrence_warnings
