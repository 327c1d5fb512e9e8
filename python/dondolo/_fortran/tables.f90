!> Tables of results that Python has as objects: their columns are those of the result files.
!>
!> Curves come by name, as take_curves has them, those of one row after those of the row before.
module tables
   use, intrinsic :: ieee_arithmetic, only : ieee_is_finite
   use, intrinsic :: iso_c_binding, only : c_double, c_int, c_int64_t
   use dondolo_base_error, only : error_type
   use dondolo_base_lines, only : lines_type
   use dondolo_boundary, only : check_room, split_lines
   use dondolo_case_columns, only : columns_type
   use dondolo_case_design_rows, only : put_design
   use dondolo_case_report_rows, only : put_certified, put_fragility, put_history, put_names, put_stripe, put_trace, put_typology, &
      & put_union, put_wall
   use dondolo_case_source_rows, only : put_source
   use dondolo_case_tie_rows, only : put_tally
   use dondolo_check_safety, only : safety_type
   use dondolo_curve_parcel, only : take_curves
   use dondolo_fragility, only : fragility_type
   use dondolo_fragility_tie_tallies, only : tie_tally_type
   use dondolo_interface_handles, only : find_walls
   use dondolo_motion_certified, only : certified_type
   use dondolo_motion_response, only : response_type, trace_type
   use dondolo_population_designs, only : design_type
   use dondolo_population_occurrence, only : exclusive, occurrence_names
   use dondolo_population_sensitivity, only : sensitivity_type
   use dondolo_population_typology, only : typology_type
   use dondolo_population_unions, only : union_type
   use dondolo_population_wall_row, only : wall_row_type
   use dondolo_results_parcel, only : send_table
   use dondolo_wall, only : wall_type
   implicit none
   private

   public :: wall_table, history_table, stripe_table, fragility_table, typology_table, union_table, tie_table, design_table, &
      & source_table, trace_table

contains

   !> Walls: of each its group, its facade, its occurrence, its alternative and its notes as lines, and its weight and the
   !> probability of its mechanism; notes: their names, a line each
   subroutine wall_table(walls, texts, notes, shares, w, sent)
      integer(c_int64_t), intent(in) :: walls
      character(len=*), intent(in) :: texts, notes
      integer(c_int), intent(in) :: w
      real(c_double), intent(in) :: shares(2, w)
      integer(c_int64_t), intent(out) :: sent(5)
      type(wall_type), pointer :: wall(:)
      type(wall_row_type) :: row
      type(lines_type) :: words, names
      type(columns_type) :: table
      type(error_type), allocatable :: error
      integer, allocatable :: lengths(:)
      logical :: has_facades, has_alternatives
      integer :: i, k, of_wall

      call check_room(error, walls=w)
      if (.not. allocated(error)) call find_walls(walls, wall, error)
      if (.not. allocated(error)) then
         call split_lines(texts, words)
         call split_lines(notes, names)
         of_wall = 4 + names%count
         lengths = wall(1)%input%lengths()
         has_facades = .false.
         has_alternatives = .false.
         do i = 1, w
            lengths = max(lengths, wall(i)%input%lengths())
            associate (line => words%line(of_wall*(i - 1) + 1:))
               has_facades = has_facades .or. len(line(2)%text) > 0
               has_alternatives = has_alternatives .or. line(3)%text == occurrence_names(exclusive)
            end associate
         end do
         do i = 1, w
            row%wall = wall(i)
            associate (line => words%line(of_wall*(i - 1) + 1:))
               row%group = line(1)%text
               row%facade = line(2)%text
               row%occurrence = line(3)%text
               row%alternative = line(4)%text
               row%notes = lines_type()
               do k = 5, of_wall
                  call row%notes%add(line(k)%text)
               end do
            end associate
            row%weight = shares(1, i)
            row%p_occ = shares(2, i)
            call put_wall(table, row, lengths, has_facades, has_alternatives, names)
            call table%end_row()
         end do
      end if
      call send_table(table, error, sent)
   end subroutine wall_table

   !> n histories of a wall: its name, its mechanism and r names of records as lines; of each history its record (from 1), flags
   !> of collapse and uplift, and how it is certified; has_*: 1 where there are errors, certificates and uplifts
   subroutine history_table(texts, im, record, polarity, level, scale, edp, time_of_peak, collapsed, impacts, edp_error, status, &
         & edp_lowest, edp_highest, edp_rounded, uplift, has_errors, has_certificates, has_uplifts, n, sent)
      character(len=*), intent(in) :: texts, im
      integer(c_int), intent(in) :: n, has_errors, has_certificates, has_uplifts
      integer(c_int), intent(in) :: record(n), polarity(n), collapsed(n), impacts(n), status(n), uplift(n)
      real(c_double), intent(in) :: level(n), scale(n), edp(n), time_of_peak(n), edp_error(n), edp_lowest(n), edp_highest(n), &
         & edp_rounded(n)
      integer(c_int64_t), intent(out) :: sent(5)
      type(response_type) :: response
      type(lines_type) :: words
      type(columns_type) :: table
      type(error_type), allocatable :: error
      integer :: i

      call check_room(error, histories=real(n, c_double))
      if (.not. allocated(error)) then
         call split_lines(texts, words)
         do i = 1, n
            response%edp = edp(i)
            response%time_of_peak = time_of_peak(i)
            response%collapsed = collapsed(i) == 1
            response%impacts = impacts(i)
            call put_names(table, words%line(1)%text, words%line(2)%text)
            call put_history(table, words%line(2 + record(i))%text, polarity(i), im, level(i), scale(i), response)
            if (has_errors == 1) call table%put('edp_error', edp_error(i))
            if (has_certificates == 1) call put_certified(table, certified_type(status(i), edp_lowest(i), edp_highest(i), &
               & edp_rounded(i)))
            if (has_uplifts == 1) call table%put('uplift', uplift(i) == 1)
            call table%end_row()
         end do
      end if
      call send_table(table, error, sent)
   end subroutine history_table

   !> Stripes of w walls at m levels in k damage states: name and mechanism of each wall as lines, histories and those that
   !> reach each state; of one wall those with uplift too, if has_uplift = 1
   subroutine stripe_table(texts, im, levels, thresholds, histories, reached, uplift, has_uplift, m, k, w, sent)
      character(len=*), intent(in) :: texts, im
      integer(c_int), intent(in) :: m, k, w, histories(m, w), reached(m, k, w), uplift(m), has_uplift
      real(c_double), intent(in) :: levels(m), thresholds(k)
      integer(c_int64_t), intent(out) :: sent(5)
      type(lines_type) :: words
      type(columns_type) :: table
      type(error_type), allocatable :: error
      integer :: i, j, l

      call check_room(error, reals=20.0_c_double*m*k*w)
      if (.not. allocated(error)) then
         call split_lines(texts, words)
         do i = 1, w
            do l = 1, k
               do j = 1, m
                  call put_names(table, words%line(2*i - 1)%text, words%line(2*i)%text)
                  call put_stripe(table, im, levels(j), histories(j, i), reached(j, l, i), thresholds(l))
                  if (has_uplift == 1) call table%put('uplift', uplift(j))
                  call table%end_row()
               end do
            end do
         end do
      end if
      call send_table(table, error, sent)
   end subroutine stripe_table

   !> k curves: of each as lines the name and the mechanism of its wall, and its measure
   subroutine fragility_table(texts, curve_names, curve_texts, curve_numbers, p, k, sent)
      character(len=*), intent(in) :: texts, curve_names, curve_texts
      integer(c_int), intent(in) :: p, k
      real(c_double), intent(in) :: curve_numbers(p, k)
      integer(c_int64_t), intent(out) :: sent(5)
      type(fragility_type), allocatable :: curves(:)
      real(c_double), allocatable :: thresholds(:)
      type(lines_type) :: words
      type(columns_type) :: table
      type(error_type), allocatable :: error
      integer :: i

      call check_room(error, reals=40.0_c_double*k)
      if (.not. allocated(error)) call take_curves(curves, curve_names, curve_texts, curve_numbers, error, thresholds)
      if (.not. allocated(error)) then
         call split_lines(texts, words)
         do i = 1, k
            associate (line => words%line(3*i - 2:3*i))
               call put_names(table, line(1)%text, line(2)%text)
               call put_fragility(table, line(3)%text, curves(i), thresholds(i))
               call table%end_row()
            end associate
         end do
      end if
      call send_table(table, error, sent)
   end subroutine fragility_table

   !> k curves of a population at m levels: of each as lines its mechanism and its group; sums, weight, both dispersions,
   !> upper asymptote and share that is fitted; at each level the mean fraction, the mean curve and three fractiles
   subroutine typology_table(texts, im, levels, sums, means, curve_names, curve_texts, curve_numbers, m, p, k, sent)
      character(len=*), intent(in) :: texts, im, curve_names, curve_texts
      integer(c_int), intent(in) :: m, p, k
      real(c_double), intent(in) :: levels(m), sums(5, k), means(m, 5, k), curve_numbers(p, k)
      integer(c_int64_t), intent(out) :: sent(5)
      type(fragility_type), allocatable :: curves(:)
      real(c_double), allocatable :: thresholds(:)
      type(typology_type) :: typology
      type(lines_type) :: words
      type(columns_type) :: table
      type(error_type), allocatable :: error
      integer :: i, j

      call check_room(error, reals=40.0_c_double*m*k)
      if (.not. allocated(error)) call take_curves(curves, curve_names, curve_texts, curve_numbers, error, thresholds)
      if (.not. allocated(error)) then
         call split_lines(texts, words)
         typology%levels = levels
         do i = 1, k
            typology%mechanism = words%line(2*i - 1)%text
            typology%group = words%line(2*i)%text
            typology%fit = curves(i)
            typology%weight = sums(1, i)
            typology%beta_walls = sums(2, i)
            typology%beta_records = sums(3, i)
            typology%upper_asymptote = sums(4, i)
            typology%fitted = sums(5, i)
            typology%mean_fraction = means(:, 1, i)
            typology%mean_curve = means(:, 2, i)
            typology%fractile = transpose(means(:, 3:5, i))
            do j = 1, m
               call put_typology(table, typology, im, j, thresholds(i))
               call table%end_row()
            end do
         end do
      end if
      call send_table(table, error, sent)
   end subroutine typology_table

   !> k walls with several mechanisms, or means, at m levels: of each as lines its name and its group; how many mechanisms, 0 for
   !> a mean; at each level histories, collapses, and the fraction, by the same histories and by the product; two curves, its
   !> own and that of the product
   subroutine union_table(texts, im, levels, mechanisms, counts, curve_names, curve_texts, curve_numbers, m, k, p, c, sent)
      character(len=*), intent(in) :: texts, im, curve_names, curve_texts
      integer(c_int), intent(in) :: m, k, p, c, mechanisms(k)
      real(c_double), intent(in) :: levels(m), counts(m, 4, k), curve_numbers(p, c)
      integer(c_int64_t), intent(out) :: sent(5)
      type(fragility_type), allocatable :: curves(:)
      real(c_double), allocatable :: thresholds(:)
      type(union_type) :: union
      type(lines_type) :: words
      type(columns_type) :: table
      type(error_type), allocatable :: error
      integer :: i, j

      call check_room(error, reals=60.0_c_double*m*k)
      if (.not. allocated(error)) call take_curves(curves, curve_names, curve_texts, curve_numbers, error, thresholds)
      if (.not. allocated(error)) then
         call split_lines(texts, words)
         do i = 1, k
            associate (line => words%line(2*i - 1:2*i))
               union%name = line(1)%text
               union%group = line(2)%text
               union%rows = [min(mechanisms(i), 1), mechanisms(i)]
               union%histories = counts(:, 1, i)
               union%collapses = counts(:, 2:2, i)
               union%fraction = counts(:, 3:3, i)
               union%independent = counts(:, 4:4, i)
               union%curve = curves(2*i - 1:2*i - 1)
               union%product = curves(2*i:2*i)
            end associate
            do j = 1, m
               call put_union(table, union, im, levels(j), j, 1, thresholds(2*i - 1))
               call table%end_row()
            end do
         end do
      end if
      call send_table(table, error, sent)
   end subroutine union_table

   !> Ties of w walls at m levels: name and mechanism of each wall as lines, its ties, its histories, and of each wall and level
   !> t tallies in all: how many histories stretch and break each tie, and the mean and the largest plastic elongation
   subroutine tie_table(texts, im, levels, ties, histories, counts, elongations, m, w, t, sent)
      character(len=*), intent(in) :: texts, im
      integer(c_int), intent(in) :: m, w, t, ties(w), histories(m, w), counts(2, t)
      real(c_double), intent(in) :: levels(m), elongations(2, t)
      integer(c_int64_t), intent(out) :: sent(5)
      type(lines_type) :: words
      type(columns_type) :: table
      type(error_type), allocatable :: error
      integer :: i, j, l, at

      call check_room(error, reals=40.0_c_double*t)
      if (.not. allocated(error)) then
         call split_lines(texts, words)
         at = 0
         do i = 1, w
            do j = 1, m
               do l = 1, ties(i)
                  at = at + 1
                  call put_names(table, words%line(2*i - 1)%text, words%line(2*i)%text)
                  call put_tally(table, im, levels(j), l, tie_tally_type(counts(1, at), counts(2, at), elongations(1, at), &
                     & elongations(2, at)), histories(j, i))
                  call table%end_row()
               end do
            end do
         end do
      end if
      call send_table(table, error, sent)
   end subroutine tie_table

   !> k designs beside the first, names are lines: ratio of the medians, its bounds and its probability, a ratio of 0 for none; of
   !> its check a_0, multiplier, safety indices of SLV by both checks and return period by the nonlinear one, 0 for none, and
   !> whether this is a bound, -1: '<', 1: '>'
   subroutine design_table(texts, im, curve_names, curve_texts, curve_numbers, steel, alpha_0, ratio, ratio_low, ratio_high, &
         & p_value, activation, multiplier, linear, nonlinear, years, bound, p, k, sent)
      character(len=*), intent(in) :: texts, im, curve_names, curve_texts
      integer(c_int), intent(in) :: p, k
      real(c_double), intent(in) :: curve_numbers(p, k), steel(k), alpha_0(k), ratio(k), ratio_low(k), ratio_high(k), p_value(k)
      real(c_double), intent(in) :: activation(k), multiplier(k), linear(k), nonlinear(k), years(k), bound(k)
      integer(c_int64_t), intent(out) :: sent(5)
      type(design_type) :: designs(k)
      type(fragility_type), allocatable :: curves(:)
      type(lines_type) :: words
      type(columns_type) :: table
      type(error_type), allocatable :: error
      integer :: i

      call take_curves(curves, curve_names, curve_texts, curve_numbers, error)
      if (.not. allocated(error)) then
         call split_lines(texts, words)
         do i = 1, k
            associate (design => designs(i))
               design%name = words%line(i)%text
               design%curve = curves(i)
               design%steel = steel(i)
               design%alpha_0 = alpha_0(i)
               design%is_compared = ratio(i) > 0.0_c_double
               design%ratio = ratio(i)
               design%low = ratio_low(i)
               design%high = ratio_high(i)
               design%p_value = p_value(i)
               design%safety = safety_type(is_known=activation(i) > 0.0_c_double, multiplier=multiplier(i), &
                  & activation=activation(i), linear=merge(linear(i), -1.0_c_double, linear(i) > 0.0_c_double), &
                  & nonlinear=nonlinear(i), years=merge(years(i), -1.0_c_double, years(i) > 0.0_c_double), &
                  & bound=merge('<', merge('>', ' ', bound(i) > 0.0_c_double), bound(i) < 0.0_c_double))
            end associate
            call put_design(table, designs(i), designs(1), im)
            call table%end_row()
         end do
      end if
      call send_table(table, error, sent)
   end subroutine design_table

   !> k sources: name and distribution of each as lines, its fractiles, its two curves, and its Sobol indices with their intervals
   !> (NaN: none)
   subroutine source_table(texts, values, curve_names, curve_texts, curve_numbers, first, first_interval, total, &
         & total_interval, k, p, c, sent)
      character(len=*), intent(in) :: texts, curve_names, curve_texts
      integer(c_int), intent(in) :: k, p, c
      real(c_double), intent(in) :: values(3, k), first(k), first_interval(2, k), total(k), total_interval(2, k)
      real(c_double), intent(in) :: curve_numbers(p, c)
      integer(c_int64_t), intent(out) :: sent(5)
      type(fragility_type), allocatable :: curves(:)
      type(lines_type) :: words
      type(columns_type) :: table
      type(sensitivity_type), allocatable :: sensitivity
      type(error_type), allocatable :: error
      integer :: i

      if (all(ieee_is_finite(first))) sensitivity = sensitivity_type(first, total, first_interval, total_interval)
      call take_curves(curves, curve_names, curve_texts, curve_numbers, error)
      if (.not. allocated(error)) then
         call split_lines(texts, words)
         do i = 1, k
            associate (line => words%line(2*i - 1:2*i))
               call put_source(table, line(1)%text, line(2)%text, values(:, i), curves(2*i - 1:2*i), i, sensitivity)
            end associate
            call table%end_row()
         end do
      end if
      call send_table(table, error, sent)
   end subroutine source_table

   !> A time history of n rows; after_impact: 1 just after one
   subroutine trace_table(time, acceleration, rotation, velocity, side, after_impact, capacity, n, sent)
      integer(c_int), intent(in) :: n, side(n), after_impact(n)
      real(c_double), intent(in) :: time(n), acceleration(n), rotation(n), velocity(n), capacity
      integer(c_int64_t), intent(out) :: sent(5)
      type(trace_type) :: trace
      type(columns_type) :: table
      type(error_type), allocatable :: error

      call check_room(error, reals=20.0_c_double*n)
      if (.not. allocated(error)) then
         trace%rows = n
         trace%time = time
         trace%acceleration = acceleration
         trace%rotation = rotation
         trace%velocity = velocity
         trace%side = real(side, c_double)
         trace%after_impact = after_impact == 1
         call put_trace(table, trace, capacity)
      end if
      call send_table(table, error, sent)
   end subroutine trace_table

end module tables
