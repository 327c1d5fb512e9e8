!> What histories do to the ties of a wall: for people, programs and tables.
module dondolo_tie_rows
   use dondolo_json, only : json_type
   use dondolo_kinds, only : wp
   use dondolo_mechanism, only : mechanism_type
   use dondolo_response, only : response_type, tie_response_type
   use dondolo_text, only : rounded, to_table, to_text
   use dondolo_tie_statics, only : ties_after
   implicit none
   private

   public :: tie_head, make_tie_row, make_tie_comment, make_tie_sentence, put_tie

   !> Names of the columns of the table of ties
   character(len=*), parameter :: tie_head = 'wall,mechanism,im,im_level,tie,histories,yielded,broken,share_yielded,'// &
      & 'share_broken,mean_plastic_elongation_m,largest_plastic_elongation_m'

contains

   !> A tie at a level: how many histories make it yield and break
   subroutine make_tie_row(cells, im, level, mechanism, tie, response, row)
      !> Name and mechanism of the wall
      character(len=*), intent(in) :: cells
      !> Intensity measure
      character(len=*), intent(in) :: im
      !> Level
      real(wp), intent(in) :: level
      class(mechanism_type), intent(in) :: mechanism
      !> Number of the tie
      integer, intent(in) :: tie
      !> Histories that were run at the level
      type(response_type), intent(in) :: response(:)
      !> Row
      character(len=:), allocatable, intent(out) :: row

      real(wp) :: elongation(mechanism%ties, size(response)), share
      logical :: broken(mechanism%ties, size(response))
      integer :: yields, breaks, i

      do i = 1, size(response)
         call ties_after(mechanism, response(i)%edp, elongation(:, i), broken(:, i))
      end do
      share = 1.0_wp/real(size(response), wp)
      yields = count(elongation(tie, :) > 0.0_wp)
      breaks = count(broken(tie, :))
      row = cells//','//im//','//to_table(level)//','//to_text(tie)//','//to_text(size(response))//','//to_text(yields)// &
         & ','//to_text(breaks)//','//to_table(share*real(yields, wp))//','//to_table(share*real(breaks, wp))//','// &
         & to_table(share*sum(elongation(tie, :)))//','//to_table(maxval(elongation(tie, :)))
   end subroutine make_tie_row

   !> A tie in the head of the table of a history
   subroutine make_tie_comment(number, tie, line)
      !> Its number
      integer, intent(in) :: number
      type(tie_response_type), intent(in) :: tie
      !> Line
      character(len=:), allocatable, intent(out) :: line

      line = '# tie '//to_text(number)//': plastic_elongation_m = '//to_table(tie%plastic_elongation)//', energy_j_m = '// &
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

end module dondolo_tie_rows
