!> Words for mechanisms that are none of their names: how such a wall is given.
module dondolo_wall_mechanism_words
   use dondolo_base_error, only : not_a_word, problems_type
   use dondolo_base_odd_character, only : odd_character
   use dondolo_base_text, only : join
   use dondolo_base_plain, only : is_plain, shown
   implicit none
   private

   public :: check_mechanism

   !> A word, and how such a wall is given
   type :: word_type
      character(len=20) :: word
      character(len=120) :: way
   end type word_type

   character(len=*), parameter :: arches = 'mechanism = ''chain'', whose tables dd.arch of Python finds and writes '// &
      & '(docs/chains.md)', bands = 'mechanism = ''horizontal'' (docs/chains.md)', &
      & wedges = 'mechanism = ''one_sided'' with wedge_thickness and the others of wedges (docs/mechanisms.md)', &
      & panels = 'mechanism = ''one_sided'' with elevation_x, elevation_z, axis_x and axis_z (docs/mechanisms.md)', &
      & chains = 'mechanism = ''chain'', from tables of its bodies and joints (docs/chains.md)'

   type(word_type), parameter :: words(*) = [word_type('arch', arches), word_type('portal', arches), &
      & word_type('horizontal_bending', bands), word_type('compound', wedges), &
      & word_type('wedge', wedges), word_type('panel', panels), word_type('gable', panels), word_type('frame', chains), &
      & word_type('cavity', chains), word_type('strip', 'mechanism = ''two_block'', of several storeys ''chain'' '// &
      & '(docs/chains.md)'), word_type('vertical_bending', 'mechanism = ''two_block'', of several storeys ''chain'' '// &
      & '(docs/chains.md)')]

contains

   !> Note a mechanism that is none, and how such a wall is given
   subroutine check_mechanism(mechanism, names, problems)
      !> As given
      character(len=*), intent(in) :: mechanism
      !> Those that there are
      character(len=*), intent(in) :: names(:)
      !> Takes what is wrong
      type(problems_type), intent(inout) :: problems

      character(len=:), allocatable :: allowed
      integer :: i

      ! Of one that is not plain, its property says so.
      if (any(mechanism == names) .or. .not. is_plain(mechanism)) return
      allowed = 'must be one of '//join(names)
      i = findloc(words%word == mechanism, .true., dim=1)
      if (i > 0) allowed = allowed//'; such a wall has '//trim(words(i)%way)
      if (len_trim(odd_character(mechanism)) > 0) allowed = allowed//'; it has '//trim(odd_character(mechanism))
      call problems%note('mechanism = '''//shown(mechanism)//''': '//allowed, not_a_word, 'mechanism')
   end subroutine check_mechanism

end module dondolo_wall_mechanism_words
