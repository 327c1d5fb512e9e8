!> What is printed of facades and walls with several mechanisms, and of the checks of their rows.
module dondolo_union_lines
   use, intrinsic :: iso_fortran_env, only : output_unit
   use dondolo_base_kinds, only : wp
   use dondolo_base_text, only : counted, left, right, rounded, to_text
   use dondolo_case, only : case_type
   use dondolo_case_check_rows, only : check_methods, check_states, shown_verdicts, verdict_type
   use dondolo_case_results, only : results_type, shown_rows
   use dondolo_files_probability, only : probability_text
   use dondolo_fit_lines, only : bar, fractiles, make_head, name_width, occurring, print_fit
   use dondolo_fragility, only : fit_status_names, fragility_type
   use dondolo_population, only : population_type
   use dondolo_population_occurrence, only : wall_probability
   use dondolo_population_unions, only : union_type
   implicit none
   private

   public :: print_facade, print_unions, print_verdict_rows

contains

   !> Print what the same histories say of walls with several mechanisms, beside their product
   subroutine print_unions(case, results)
      type(case_type), intent(in) :: case
      !> Results with unions
      type(results_type), intent(in) :: results

      type(union_type) :: union
      logical :: can_coincide
      integer :: i, state, walls

      state = size(case%stripes%thresholds)
      walls = size(results%unions%wall)
      can_coincide = any([(results%population%can_coincide(i), i=1, results%population%walls)])
      if (can_coincide) then
         write (output_unit, '(a)') '', 'walls with several mechanisms, counted in the same histories; independent: by the '// &
            & 'product of their probabilities, as the curves ''all'' above, which are the ones to quote for population and groups:'
      else
         write (output_unit, '(a)') '', 'walls with several mechanisms, of which one occurs (exclusive); the curves of '// &
            & 'population and groups are those above:'
      end if
      do i = 1, results%unions%count()
         if (i <= min(shown_rows, walls)) then
            call results%unions%get(i, results%population, union)
            call print_line(case, union, state, results%population%can_coincide(results%population%row(union%rows(1))%wall))
         else if (i > walls .and. can_coincide) then
            ! Where mechanisms never occur together, the means in the same histories are the curves printed before
            call results%unions%get(i, results%population, union)
            call print_line(case, union, state, .true.)
         end if
         if (i == shown_rows .and. walls > shown_rows) write (output_unit, '(a)') '... and '// &
            & to_text(walls - shown_rows)//' more'
      end do
   end subroutine print_unions

   !> Print the curve of the one facade or wall of a case: how often any of its mechanisms collapses in the same histories
   subroutine print_facade(case, results)
      type(case_type), intent(in) :: case
      !> Results of one wall
      type(results_type), intent(in) :: results

      type(union_type) :: union
      integer :: k, state

      state = size(case%stripes%thresholds)
      if (results%unions%count() > 0) then
         call results%unions%get(1, results%population, union)
      else
         call take_row(case, results, union)
      end if
      call print_stripes_of(case, results%population, union, state)
      do k = 1, state
         if (k < state) write (output_unit, '(a)', advance='no') 'EDP '//rounded(case%stripes%thresholds(k))//': '
         if (k == state .and. state > 1) write (output_unit, '(a)', advance='no') 'collapse: '
         call print_fit(case, union%curve(k), union%upper_asymptote)
      end do
      if (results%population%can_coincide(1)) write (output_unit, '(a)') 'independent mechanisms would give '// &
         & trim(parameters(case, union%product(state), union%upper_asymptote))
   end subroutine print_facade

   !> The one mechanism of a facade as the union of itself
   subroutine take_row(case, results, union)
      type(case_type), intent(in) :: case
      !> Results of one wall with one mechanism
      type(results_type), intent(in) :: results
      type(union_type), intent(out) :: union

      integer :: k

      associate (population => results%population)
         union%name = results%shown(1)%name
         union%rows = 1
         union%upper_asymptote = population%row(1)%p_occ
         union%curve = population%curve(:, 1)
         union%histories = real(population%histories(:, 1), wp)
         allocate (union%fraction(size(case%stripes%levels), size(union%curve)))
         do k = 1, size(union%curve)
            union%fraction(:, k) = union%upper_asymptote*real(population%reached(:, k, 1), wp)/union%histories
         end do
      end associate
   end subroutine take_row

   !> Print how often a facade or a wall collapses at each level
   subroutine print_stripes_of(case, population, union, state)
      type(case_type), intent(in) :: case
      type(population_type), intent(in) :: population
      type(union_type), intent(in) :: union
      !> Number of the damage state
      integer, intent(in) :: state

      character(len=:), allocatable :: head, how
      character(len=120) :: line
      integer :: j

      if (union%rows(2) > union%rows(1)) then
         how = ' in series: a history counts if one of them collapses in it'
         if (population%row(union%rows(1))%alternative > 0) how = ' in exclusive alternatives: a history counts with '// &
            & 'the probability of those that collapse in it'
         write (output_unit, '(a)') ''''//union%name//''', '//counted(union%rows(2) - union%rows(1) + 1, 'mechanism')//how
      end if
      call make_head(case, head)
      write (output_unit, '(a, a12, a10)') head, 'collapses', 'fraction'
      do j = 1, size(case%stripes%levels)
         associate (fraction => union%fraction(j, state))
            write (line, '(a, a12, f10.3, 2x, a)') right(rounded(case%stripes%levels(j)), len(head)), &
               & rounded(fraction*union%histories(j))//'/'//to_text(nint(union%histories(j))), fraction, bar(fraction)
            write (output_unit, '(a)') trim(line)
         end associate
      end do
      write (output_unit, '(a)') ''
   end subroutine print_stripes_of

   !> Print a wall or a mean in one line
   subroutine print_line(case, union, state, with_product)
      type(case_type), intent(in) :: case
      type(union_type), intent(in) :: union
      !> Number of the damage state
      integer, intent(in) :: state
      !> Print the product too? It is another curve where mechanisms can occur together
      logical, intent(in) :: with_product

      character(len=:), allocatable :: who, product

      product = ''
      if (with_product) product = '; independent: '//trim(parameters(case, union%product(state), union%upper_asymptote))
      if (len(union%name) > 0) then
         who = union%name
      else if (len(union%group) > 0) then
         who = 'group '''//union%group//''', same histories'
      else
         who = 'population, same histories'
      end if
      write (output_unit, '(a)') who//trim(occurring(union%upper_asymptote))//': '// &
         & trim(parameters(case, union%curve(state), union%upper_asymptote))//product
   end subroutine print_line

   !> Parameters of a curve
   function parameters(case, curve, upper_asymptote) result(text)
      type(case_type), intent(in) :: case
      type(fragility_type), intent(in) :: curve
      !> Share that can collapse
      real(wp), intent(in) :: upper_asymptote
      !> In words, filled up with blanks
      character(len=300) :: text

      text = 'no fragility curve, status '//fit_status_names(curve%status)
      if (curve%has_fit()) text = 'theta = '//rounded(curve%theta)//case%stripes%scaling%unit_after_blank()//', beta = '// &
         & rounded(curve%beta)//', at 16, 50, 84 % '//trim(fractiles(case, curve, upper_asymptote))
   end function parameters

   !> Print the checks of the first rows, and the probabilities of collapse at the peak acceleration of the site
   subroutine print_verdict_rows(case, results)
      !> The case, with a check
      type(case_type), intent(in) :: case
      !> Its results, with verdicts
      type(results_type), intent(in) :: results

      type(union_type) :: union
      integer :: i, k, longest

      associate (verdicts => results%verdicts)
         if (verdicts%checked == 0) return
         longest = 0
         do i = 1, min(verdicts%checked, shown_verdicts)
            longest = max(longest, len(verdicts%first(i)%name//trim(suffix_of(verdicts%first, i))))
         end do
         write (output_unit, '(a, a10, 4a15, a13)') left('capacity / demand', name_width(longest)), 'alpha_0', &
            & (right(trim(check_methods(k))//' '//check_states(k), 15), k=1, size(check_states)), 'P at a_g S'
         do i = 1, min(verdicts%checked, shown_verdicts)
            associate (verdict => verdicts%first(i))
               write (output_unit, '(a, a10, 4a15, a13)') &
                  & left(verdict%name//trim(suffix_of(verdicts%first, i)), name_width(longest)), &
                  & right(rounded(verdict%multiplier), 10), &
                  & (ratio_of(verdict%ratio(k), verdict%is_applicable(k)), k=1, size(check_states)), in_column(verdict%probability)
            end associate
         end do
         if (verdicts%checked > shown_verdicts) write (output_unit, '(a)') '... and '// &
            & to_text(verdicts%checked - shown_verdicts)//' more'
      end associate
      if (results%unions%count() == 0 .or. case%stripes%scaling%name /= 'pga') return
      associate (spectrum => case%check%spectrum(2))
         do i = 1, min(size(results%unions%wall), shown_rows)
            call results%unions%get(i, results%population, union)
            call print_chance(union, spectrum%pga)
         end do
      end associate

   contains

      !> What is printed after the name of a wall: its mechanism where another of the first rows has the same name
      function suffix_of(first, i) result(suffix)
         type(verdict_type), intent(in) :: first(:)
         integer, intent(in) :: i
         character(len=24) :: suffix

         integer :: k

         suffix = ''
         do k = 1, min(results%verdicts%checked, size(first))
            if (k == i .or. first(k)%name /= first(i)%name) cycle
            suffix = ', '//first(i)%mechanism
            return
         end do
      end function suffix_of

      !> Capacity / demand in its column, of a check that is one for the wall
      function ratio_of(ratio, is_applicable) result(cell)
         real(wp), intent(in) :: ratio
         logical, intent(in) :: is_applicable
         character(len=15) :: cell

         cell = right('not applicable', len(cell))
         if (is_applicable) cell = right(rounded(ratio), len(cell))
      end function ratio_of

      !> A probability in its column, a dash where there is none
      function in_column(probability) result(cell)
         real(wp), intent(in) :: probability
         character(len=13) :: cell

         cell = right('-', len(cell))
         if (probability >= 0.0_wp) cell = right(trim(probability_text(probability)), len(cell))
      end function in_column

      !> Print the probability that a facade collapses at the peak acceleration of the site. Its curve is fitted on its own,
      !> so that far below its levels it may be less than that of a mechanism, which bounds it
      subroutine print_chance(union, pga)
         type(union_type), intent(in) :: union
         !> a_g S of SLV [g]
         real(wp), intent(in) :: pga

         real(wp) :: chances(1, union%rows(1):union%rows(2)), whole(1)
         real(wp), allocatable :: p_occ(:)
         integer, allocatable :: alternative(:)
         !> What independent mechanisms would give; empty where never two occur, for which it is the same
         character(len=:), allocatable :: independent
         integer :: k, last

         last = size(union%curve)
         if (.not. union%curve(last)%has_fit()) return
         chances = 0.0_wp
         do k = union%rows(1), union%rows(2)
            associate (curve => results%population%curve(last, k))
               if (curve%has_fit()) chances(1, k) = curve%probability(pga)
            end associate
         end do
         associate (population => results%population)
            call population%get_occurrence(population%rows + population%row(union%rows(1))%wall, p_occ, alternative)
         end associate
         independent = ''
         if (results%population%can_coincide(results%population%row(union%rows(1))%wall)) then
            whole = wall_probability(p_occ, alternative, chances)
            independent = '; taken as independent '//trim(probability_text(whole(1)))
         end if
         write (output_unit, '(a)') ''''//union%name//''': probability of collapse at a_g S = '//rounded(pga)//' g: '// &
            & trim(probability_text(max(union%upper_asymptote*union%curve(last)%probability(pga), maxval(p_occ*chances(1, :)))))// &
            & independent
      end subroutine print_chance

   end subroutine print_verdict_rows

end module dondolo_union_lines
