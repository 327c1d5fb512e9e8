!> What histories do to the ties of a wall: for people, programs and tables.
module dondolo_case_tie_rows
   use dondolo_base_json, only : json_type
   use dondolo_base_kinds, only : wp
   use dondolo_base_text, only : rounded, to_table, to_text
   use dondolo_case_table, only : table_type
   use dondolo_fragility_tie_tallies, only : tie_tally_type
   use dondolo_motion_response, only : tie_response_type
   implicit none
   private

   public :: put_tally, make_tie_comment, make_tie_sentence, put_tie

contains

   !> A tie at a level: how many histories make it yield and break
   subroutine put_tally(table, im, level, tie, tally, histories)
      class(table_type), intent(inout) :: table
      !> Intensity measure
      character(len=*), intent(in) :: im
      !> Level
      real(wp), intent(in) :: level
      !> Number of the tie
      integer, intent(in) :: tie
      !> What the histories do to it
      type(tie_tally_type), intent(in) :: tally
      !> Histories that were run at the level
      integer, intent(in) :: histories

      real(wp) :: share

      share = 1.0_wp/real(histories, wp)
      call table%put('im', im)
      call table%put('im_level', level)
      call table%put('tie', tie)
      call table%put('histories', histories)
      call table%put('yielded', tally%yielded)
      call table%put('broken', tally%broken)
      call table%put('share_yielded', share*real(tally%yielded, wp))
      call table%put('share_broken', share*real(tally%broken, wp))
      call table%put('mean_plastic_elongation_m', tally%mean)
      call table%put('largest_plastic_elongation_m', tally%largest)
   end subroutine put_tally

   !> A tie in the head of the table of a history
   subroutine make_tie_comment(number, tie, line)
      !> Its number
      integer, intent(in) :: number
      type(tie_response_type), intent(in) :: tie
      !> Line
      character(len=:), allocatable, intent(out) :: line

      line = 'tie '//to_text(number)//': plastic_elongation_m = '//to_table(tie%plastic_elongation)//', energy_j_m = '// &
         & to_table(tie%energy)//', broken = '//to_text(merge(1, 0, tie%broken))
      if (tie%time_of_yield >= 0.0_wp) line = line//', time_of_yield_s = '//to_table(tie%time_of_yield)
      if (tie%time_of_fracture >= 0.0_wp) line = line//', time_of_fracture_s = '//to_table(tie%time_of_fracture)
   end subroutine make_tie_comment

   !> A tie at the end of a history, for people
   subroutine make_tie_sentence(number, tie, line)
      !> Its number
      integer, intent(in) :: number
      type(tie_response_type), intent(in) :: tie
      !> Line
      character(len=:), allocatable, intent(out) :: line

      line = 'tie '//to_text(number)//': '
      if (tie%time_of_yield >= 0.0_wp) line = line//'yields at '//rounded(tie%time_of_yield)//' s, stretches by '// &
         & rounded(tie%plastic_elongation)//' m for good and dissipates '//rounded(tie%energy)//' J/m'
      if (tie%time_of_yield >= 0.0_wp .and. tie%broken) line = line//', '
      if (tie%broken) line = line//'breaks at '//rounded(tie%time_of_fracture)//' s'
      if (tie%time_of_yield < 0.0_wp .and. .not. tie%broken) line = line//'does not yield'
   end subroutine make_tie_sentence

   !> A tie at the end of a history, for programs
   subroutine put_tie(tie, json)
      type(tie_response_type), intent(in) :: tie
      !> In an array
      type(json_type), intent(inout) :: json

      call json%open_object()
      call json%put('plastic_elongation_m', tie%plastic_elongation)
      call json%put('energy_j_m', tie%energy)
      call json%put('broken', tie%broken)
      if (tie%time_of_yield >= 0.0_wp) call json%put('time_of_yield_s', tie%time_of_yield)
      if (tie%time_of_fracture >= 0.0_wp) call json%put('time_of_fracture_s', tie%time_of_fracture)
      call json%close_object()
   end subroutine put_tie

end module dondolo_case_tie_rows
