!> Which mechanisms of a wall occur: independent ones and exclusive alternatives against all that can occur, one by one, in tables
!> of walls, and in unions of the same histories
program test_occurrence
   use, intrinsic :: iso_c_binding, only : c_bool
   use checks, only : check, check_close, check_error, check_ok, check_text, finish, suite
   use dondolo_base_error, only : error_type
   use dondolo_base_kinds, only : wp
   use dondolo_base_lines, only : lines_type
   use dondolo_base_text, only : to_text
   use dondolo_base_warning, only : warnings_type
   use dondolo_case_occurrence_warnings, only : occurrence_warnings_type
   use dondolo_population_occurrence, only : occurrence_of, wall_probability, wall_slopes
   use dondolo_population_reader, only : read_population
   use dondolo_population_row_result, only : row_result_type
   use dondolo_population_unions, only : union_builder_type
   use dondolo_population_wall_row, only : wall_row_type
   implicit none

   !> Folder, and a table that is written anew for each check
   character(len=*), parameter :: folder = 'build/test_occurrence', table = folder//'/walls.csv'
   !> Header of most of them
   character(len=*), parameter :: header = 'name,mechanism,height,thickness,hinge,p_occ,occurrence,alternative,facade'
   !> Wall of five mechanisms: p_occ of independent ones; and in alternatives of two, one and two
   real(wp), parameter :: p_occ(5) = [0.2_wp, 0.7_wp, 1.0_wp, 0.05_wp, 0.5_wp], &
      & shares(5) = [0.2_wp, 0.2_wp, 0.35_wp, 0.4_wp, 0.4_wp]
   integer, parameter :: alone(5) = 0, alternative(5) = [1, 1, 2, 3, 3]
   !> Probabilities of collapse at two levels
   real(wp), parameter :: p(2, 5) = reshape([0.1_wp, 0.6_wp, 0.02_wp, 0.9_wp, 0.3_wp, 1.0_wp, 0.0_wp, 0.4_wp, 0.05_wp, &
      & 0.5_wp], [2, 5])

   call execute_command_line('mkdir -p '//folder)
   call test_enumeration()
   call test_slopes()
   call test_unions()
   call test_rows()
   call test_refused()
   call test_warning()
   call finish()

contains

   !> Every set of mechanisms that can occur, with its probability, and every set of those that collapse
   subroutine test_enumeration()
      real(wp) :: whole(2), found(2)
      integer :: a

      call suite('all that can occur')
      found = wall_probability(p_occ, alone, p)
      call check(all(abs(found - enumerated(p_occ)) < 1.0e-15_wp), 'independent mechanisms')
      whole = 0.0_wp
      do a = 1, 3
         ! All mechanisms of one alternative occur, no others.
         associate (occurs => merge(1.0_wp, 0.0_wp, alternative == a), share => maxval(shares, mask=alternative == a))
            whole = whole + share*enumerated(occurs)
         end associate
      end do
      found = wall_probability(shares, alternative, p)
      call check(all(abs(found - whole) < 1.0e-15_wp), 'exclusive alternatives')
      call check_close(occurrence_of(shares, alternative), 0.95_wp, 1.0e-15_wp, 'one of the alternatives occurs')
      call check_close(occurrence_of([0.3_wp, 0.7_wp], [1, 2]), 1.0_wp, 0.0_wp, 'one of them always')
      call check_close(occurrence_of([0.3_wp, 0.7_wp], [0, 0]), 0.79_wp, 1.0e-15_wp, 'any of two independent ones')
      found = wall_probability([0.3_wp, 0.7_wp], [1, 2], p(:, 4:))
      call check(all(abs(found - (0.3_wp*p(:, 4) + 0.7_wp*p(:, 5))) <= 0.0_wp), 'the weighted mean, to the bit')
      found = wall_probability([1.0_wp], [1], p(:, 1:1))
      call check(all(abs(found - p(:, 1)) <= 0.0_wp), 'one alternative that always occurs')
   end subroutine test_enumeration

   !> Probability of a wall whose mechanisms can occur and collapse independently of each other, over all sets of those that do
   function enumerated(occurs) result(whole)
      !> Probability that each can occur
      real(wp), intent(in) :: occurs(:)
      real(wp) :: whole(2)

      real(wp) :: share(2)
      integer :: set, m

      whole = 0.0_wp
      do set = 1, 2**size(occurs) - 1
         share = 1.0_wp
         do m = 1, size(occurs)
            share = share*merge(occurs(m)*p(:, m), 1.0_wp - occurs(m)*p(:, m), btest(set, m - 1))
         end do
         whole = whole + share
      end do
   end function enumerated

   !> Derivatives: the probability of a wall is linear in that of each mechanism
   subroutine test_slopes()
      real(wp), dimension(2, 5) :: slopes, low, high
      real(wp) :: difference(2)
      integer :: m

      call suite('slopes')
      do m = 1, 5
         low = p
         high = p
         low(:, m) = 0.0_wp
         high(:, m) = 1.0_wp
         slopes = wall_slopes(p_occ, alone, p)
         difference = wall_probability(p_occ, alone, high) - wall_probability(p_occ, alone, low)
         call check(all(abs(slopes(:, m) - difference) < 1.0e-14_wp), 'independent '//to_text(m))
         slopes = wall_slopes(shares, alternative, p)
         difference = wall_probability(shares, alternative, high) - wall_probability(shares, alternative, low)
         call check(all(abs(slopes(:, m) - difference) < 1.0e-14_wp), 'exclusive '//to_text(m))
      end do
   end subroutine test_slopes

   !> Unions: each history counts with the probability that an alternative occurs in which a mechanism reaches the state; those
   !> of a wall that is the same from both sides stand for both polarities
   subroutine test_unions()
      integer, parameter :: histories(5) = [6, 3, 3, 6, 6]
      type(union_builder_type) :: builder
      type(row_result_type) :: row(5)
      real(wp) :: random(6, 2, 2), expected
      logical :: reaches(5)
      integer :: i, j, k, m, a

      call suite('unions')
      do m = 1, 5
         call random_number(random)
         row(m)%histories = histories(m)
         row(m)%flags = logical(random(:histories(m), :, :) < 0.4_wp, c_bool)
         call builder%add(row(m), shares(m), alternative(m))
      end do
      do k = 1, 2
         do j = 1, 2
            do i = 1, 6
               reaches = [(logical(row(m)%flags(modulo(i - 1, histories(m)) + 1, j, k)), m=1, 5)]
               expected = 0.0_wp
               do a = 1, 3
                  if (any(reaches .and. alternative == a)) expected = expected + maxval(shares, mask=alternative == a)
               end do
               call check_close(1.0_wp - builder%survival(i, j, k), expected, 1.0e-14_wp, 'a history', atol=1.0e-15_wp)
            end do
         end do
      end do
      ! The polarities of the second row come after an alternative that was the same from both sides.
      builder = union_builder_type()
      call builder%add(row(2), 0.5_wp, 1)
      call builder%add(row(1), 0.5_wp, 1)
      do i = 1, 6
         expected = merge(0.5_wp, 0.0_wp, any([row(1)%flags(i, 1, 1), row(2)%flags(modulo(i - 1, 3) + 1, 1, 1)]))
         call check_close(1.0_wp - builder%survival(i, 1, 1), expected, 0.0_wp, 'both polarities of '//to_text(i))
      end do
   end subroutine test_unions

   !> Alternatives of a table are numbered wall by wall
   subroutine test_rows()
      type(wall_row_type), allocatable :: rows(:)
      type(error_type), allocatable :: error

      call suite('rows')
      call write_table([character(len=80) :: header, &
         & 'a,one_sided,3,0.25,,0.3,exclusive,,', &
         & 'a,two_block,3,0.25,0.5,0.3,exclusive,,', &
         & 'a,two_block,3,0.25,0.6,0.4,exclusive,,', &
         & 'b,one_sided,3,0.25,,0.1,,,', &
         & 'b,two_block,3,0.25,,0.8,independent,,', &
         & 'c,one_sided,3,0.25,,0.7,exclusive,poor,', &
         & 'c,two_block,3,0.25,,0.7,exclusive,poor,', &
         & 'c,two_block,3,0.25,,0.3,exclusive,good,', &
         & 'd,two_block,3,0.25,0.5,0.5,exclusive,,strip', &
         & 'e,two_block,3,0.25,0.7,0.5,exclusive,,strip'])
      call read_population(table, rows, error)
      call check_ok(error, 'the table is right')
      if (allocated(error)) return
      call check(all(rows%number_of_alternative == [1, 2, 3, 0, 0, 1, 1, 2, 1, 2]), 'numbers of alternatives')
      call check(all(rows%continues .eqv. [.false., .true., .true., .false., .true., .false., .true., .true., .false., .true.]), &
         & 'rows of one wall or facade')
      call write_table([character(len=60) :: 'name,mechanism,height,thickness,p_occ', &
         & 'a,one_sided,3,0.25,0.3', 'a,two_block,3,0.25,0.7'])
      call read_population(table, rows, error, occurrence='exclusive')
      call check_ok(error, 'a table that does not say it')
      if (.not. allocated(error)) call check(all(rows%number_of_alternative == [1, 2]), 'is as its case says')
      call write_table([character(len=80) :: 'name,mechanism,height,thickness,hinge1_level,hinge2_level,p_occ,occurrence', &
         & 'a,one_sided,6,0.4,0,2.5,0.5,exclusive'])
      call read_population(table, rows, error)
      call check_ok(error, 'hinge levels')
      if (.not. allocated(error)) call check(all(rows%number_of_alternative == [1, 2]), 'are alternatives')
   end subroutine test_rows

   !> What makes no sense is refused, with its line
   subroutine test_refused()

      call suite('refused')
      call refuse([character(len=60) :: 'a,one_sided,3,0.25,,0.5,exclusive,,', 'a,two_block,3,0.25,,0.6,exclusive,,'], &
         & 'line 3: p_occ = 0.6: the probabilities of the exclusive alternatives of wall ''a'' add up to 1.1, must be at most 1')
      call refuse([character(len=60) :: 'a,one_sided,3,0.25,,0.5,exclusive,,f', 'b,two_block,3,0.25,,0.6,exclusive,,f'], &
         & 'alternatives of facade ''f'' add up to 1.1')
      call refuse([character(len=60) :: 'a,one_sided,3,0.25,,0.5,exclusive,,', 'a,two_block,3,0.25,,0.5,independent,,'], &
         & 'line 3: occurrence = ''independent'': must be ''exclusive'' as in the row before')
      call refuse([character(len=60) :: 'a,one_sided,3,0.25,,0.5,independent,x,'], &
         & 'line 2: alternative = ''x'': only for occurrence = ''exclusive''')
      call refuse([character(len=60) :: 'a,one_sided,3,0.25,,0.5,either,,'], &
         & 'line 2: occurrence = ''either'': must be one of ''independent'', ''exclusive''')
      call refuse([character(len=60) :: 'a,one_sided,3,0.25,,0.5,exclusive,x,', 'a,two_block,3,0.25,,0.4,exclusive,x,'], &
         & 'line 3: p_occ = 0.4: must be 0.5 as in the row before, which is of the same alternative')
      call refuse([character(len=60) :: 'a,one_sided,3,0.25,,0.3,exclusive,x,', 'a,two_block,3,0.25,,0.3,exclusive,y,', &
         & 'a,free_standing,3,0.25,,0.3,exclusive,x,'], 'line 4: alternative = ''x'': its rows must be consecutive')
      call refuse([character(len=60) :: 'a,one_sided,3,0.25,,0.3,exclusive,x,', 'a,one_sided,3,0.25,,0.3,exclusive,x,'], &
         & 'line 3: name = ''a'': the row before gives this wall the same mechanism')
      call refuse([character(len=60) :: 'a,two_block,3,0.25,0.5,0.3,,,', 'a,two_block,3,0.25,0.6,0.3,,,'], &
         & 'line 3: name = ''a'': the row before gives this wall the same mechanism')
   end subroutine test_refused

   !> A table that is refused
   subroutine refuse(lines, sentence)
      character(len=*), intent(in) :: lines(:), sentence

      type(wall_row_type), allocatable :: rows(:)
      type(error_type), allocatable :: error

      call write_table([character(len=80) :: header, lines])
      call read_population(table, rows, error)
      call check_error(error, sentence, sentence)
   end subroutine refuse

   !> Probabilities that add up to 1 without excluding each other are asked about, once
   subroutine test_warning()

      call suite('warning')
      call check_text(warned([0.3_wp, 0.7_wp, 0.3_wp, 0.699999_wp], [0, 0, 0, 0], [.false., .true., .false., .true.]), &
         & 'wall ''1'': the probabilities of its mechanisms add up to 1, but they are independent and may occur together: '// &
         & 'do they exclude each other (occurrence = ''exclusive'')? (2 of 2 in all)', 'two walls')
      call check_text(warned([0.3_wp, 0.7_wp], [1, 2], [.false., .true.]), '', 'alternatives')
      call check_text(warned([0.3_wp, 0.6999_wp], [0, 0], [.false., .true.]), '', 'another sum')
      call check_text(warned([1.0_wp, 0.0_wp], [0, 0], [.false., .true.]), '', 'one that always occurs')
      call check_text(warned([0.3_wp, 0.7_wp], [0, 0], [.false., .false.]), '', 'two walls of one mechanism')
      call check_text(warned([0.5_wp, 0.5_wp, 0.4_wp], [0, 0, 0], [.false., .true., .true.]), '', 'a third')
   end subroutine test_warning

   !> What is warned of
   function warned(probabilities, alternatives, continues) result(text)
      real(wp), intent(in) :: probabilities(:)
      integer, intent(in) :: alternatives(:)
      logical, intent(in) :: continues(:)
      character(len=:), allocatable :: text

      type(occurrence_warnings_type) :: looked
      type(warnings_type) :: warnings
      type(lines_type) :: lines
      integer :: i

      do i = 1, size(probabilities)
         call looked%look_at(to_text(i), probabilities(i), alternatives(i), continues(i))
      end do
      call looked%warn(warnings)
      call warnings%put_sentences(lines)
      text = ''
      if (lines%count > 0) text = lines%line(1)%text
   end function warned

   !> Write the table
   subroutine write_table(lines)
      character(len=*), intent(in) :: lines(:)

      integer :: unit, i

      open (newunit=unit, file=table, action='write', status='replace')
      do i = 1, size(lines)
         write (unit, '(a)') trim(lines(i))
      end do
      close (unit)
   end subroutine write_table

end program test_occurrence
