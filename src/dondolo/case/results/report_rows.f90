!> The rows of the result tables, as lines of text.
module dondolo_report_rows
   use dondolo_certificate, only : certified_type, status_names
   use dondolo_clustered, only : parameter_intervals
   use dondolo_csv_row, only : text_cell
   use dondolo_fragility, only : fragility_type
   use dondolo_kinds, only : wp
   use dondolo_member, only : member_type
   use dondolo_property, only : column_name, is_list, is_many, is_words, word_of
   use dondolo_response, only : response_type
   use dondolo_text, only : to_table, to_text
   use dondolo_typology, only : typology_type
   use dondolo_unions, only : union_type
   use dondolo_wall, only : wall_type
   use dondolo_wall_properties, only : is_extra, is_of_building, wall_properties
   implicit none
   private

   public :: make_wall_head, make_wall_row, stripes_head, make_stripes_row, fragility_head, make_fragility_row
   public :: union_head, make_union_row
   public :: certified_head, make_certified_cells, uplift_head
   public :: typology_head, make_typology_row, history_head, make_history_row, make_wall_cells

   !> Names of the columns of each table
   character(len=*), parameter :: error_columns = 'se_ln_theta,se_beta,cov_ln_theta_beta,errors,clusters,degrees_of_freedom', &
      & no_errors = ',,,,,'
   character(len=*), parameter :: &
      & wall_tail = ',alpha_rad,p_rad_s,trigger_acceleration_m_s2,capacity_rad,restitution,weight,group,p_occ', &
      & support_head = ',support_share,support_tilt_1_s2', &
      & stripes_head = 'wall,mechanism,im,im_level,histories,collapses,fraction,edp_threshold', &
      & fragility_head = 'wall,mechanism,im,theta,beta,se_ln_theta,se_beta,log_likelihood,status,bracket_low,'// &
      & 'bracket_high,edp_threshold,theta_low,theta_high,beta_low,beta_high,errors,clusters,degrees_of_freedom,'// &
      & 'naive_se_ln_theta,naive_se_beta,cov_ln_theta_beta', &
      & typology_head = 'mechanism,im,im_level,weight,mean_fraction,mean_curve,theta,beta,status,group,fractile_16,'// &
      & 'fractile_50,fractile_84,beta_walls,beta_records,saturation,edp_threshold,'//error_columns, &
      & union_head = 'wall,group,mechanisms,im,im_level,histories,collapses,fraction,independent_fraction,'// &
      & 'edp_threshold,theta,beta,status,'//error_columns//',independent_theta,independent_beta', &
      & certified_head = ',status,edp_lowest,edp_highest', &
      & uplift_head = ',uplift', &
      & history_head = 'wall,mechanism,record,polarity,im,im_level,scale,edp,collapsed,impacts,time_of_peak_s'

contains

   !> How a history is certified
   pure subroutine make_certified_cells(certified, cells)
      type(certified_type), intent(in) :: certified
      !> Cells that follow those of its error
      character(len=:), allocatable, intent(out) :: cells

      cells = ','//trim(status_names(certified%status))//','//to_table(certified%lowest)//','//to_table(certified%highest)
   end subroutine make_certified_cells

   !> Name and mechanism of a wall
   pure subroutine make_wall_cells(wall, is_safe, cells)
      type(wall_type), intent(in) :: wall
      !> Are texts to be no formulas in a spreadsheet?
      logical, intent(in) :: is_safe
      !> Two cells
      character(len=:), allocatable, intent(out) :: cells

      cells = text_cell(wall%name(), is_safe)//','//wall%mechanism_name()
   end subroutine make_wall_cells

   !> Names of the columns of a wall: its properties, and what follows from them
   subroutine make_wall_head(lengths, has_facades, head)
      !> How many values each property has at most; as many columns has a list
      integer, intent(in) :: lengths(:)
      !> Are there walls that are part of a facade?
      logical, intent(in) :: has_facades
      !> Names
      character(len=:), allocatable, intent(out) :: head

      integer :: i, k

      head = ''
      do i = 1, size(wall_properties)
         if (wall_properties(i)%replaced .or. (is_extra(i) .and. lengths(i) == 0)) cycle
         if (is_many(wall_properties(i)%kind)) then
            do k = 1, lengths(i)
               head = head//','//trim(column_name(wall_properties(i), k))
            end do
            cycle
         end if
         if (len(head) > 0) head = head//','
         head = head//trim(column_name(wall_properties(i)))
      end do
      head = head//wall_tail
      if (any(lengths > 0 .and. is_of_building)) head = head//support_head
      if (has_facades) head = head//',facade'
   end subroutine make_wall_head

   !> A wall: its properties, empty cells for those that it does not have, and its static quantities
   subroutine make_wall_row(member, lengths, has_facades, is_safe, row)
      !> The wall, one mechanism of it
      type(member_type), intent(in) :: member
      !> How many values each property has at most
      integer, intent(in) :: lengths(:)
      !> Are there walls that are part of a facade?
      logical, intent(in) :: has_facades
      !> Are texts to be no formulas in a spreadsheet?
      logical, intent(in) :: is_safe
      !> Row
      character(len=:), allocatable, intent(out) :: row

      real(wp), allocatable :: values(:)
      integer :: i, k

      row = ''
      associate (wall => member%wall)
         do i = 1, size(wall_properties)
            associate (name => wall_properties(i)%name)
               if (wall_properties(i)%replaced .or. (is_extra(i) .and. lengths(i) == 0)) cycle
               if (wall_properties(i)%kind == is_list) values = wall%input%list(name)
               if (is_many(wall_properties(i)%kind)) then
                  do k = 1, lengths(i)
                     row = row//','
                     if (wall_properties(i)%kind == is_words) then
                        row = row//trim(word_of(wall%input%word(name), k))
                     else if (k <= size(values)) then
                        row = row//to_table(values(k))
                     end if
                  end do
                  cycle
               end if
               if (i > 1) row = row//','
               if (wall%input%has_word(name)) then
                  row = row//text_cell(wall%input%word(name), is_safe)
               else if (wall%input%has(name)) then
                  row = row//to_table(wall%input%number(name))
               end if
            end associate
         end do
         row = row//','//to_table(wall%alpha)//','//to_table(wall%mechanism%frequency_parameter())//','// &
            & to_table(wall%mechanism%trigger_acceleration())//','//to_table(wall%mechanism%capacity)//','// &
            & to_table(wall%mechanism%restitution)//','//to_table(member%weight)//','// &
            & text_cell(member%group, is_safe)//','//to_table(member%p_occ)
         if (any(lengths > 0 .and. is_of_building)) then
            if (allocated(wall%building)) then
               row = row//','//to_table(wall%building%share)//','//to_table(wall%building%tilt)
            else
               row = row//',,'
            end if
         end if
         if (has_facades) row = row//','//text_cell(member%facade, is_safe)
      end associate
   end subroutine make_wall_row

   !> Histories that reach an EDP threshold at a level
   pure subroutine make_stripes_row(cells, im, level, histories, reached, threshold, row)
      !> Name and mechanism of the wall
      character(len=*), intent(in) :: cells
      !> Intensity measure
      character(len=*), intent(in) :: im
      !> Level
      real(wp), intent(in) :: level
      !> Histories
      integer, intent(in) :: histories
      !> Those that reach the threshold
      integer, intent(in) :: reached
      !> The threshold
      real(wp), intent(in) :: threshold
      !> Row
      character(len=:), allocatable, intent(out) :: row

      row = cells//','//im//','//to_table(level)//','//to_text(histories)//','//to_text(reached)//','// &
         & to_table(real(reached, wp)/real(histories, wp))//','//to_table(threshold)
   end subroutine make_stripes_row

   !> The curve of a wall with its standard errors and 95 % intervals; cells are empty without a fit, without standard
   !> errors, and where a side is open
   pure subroutine make_fragility_row(cells, im, curve, threshold, row)
      !> Name and mechanism of the wall
      character(len=*), intent(in) :: cells
      !> Intensity measure
      character(len=*), intent(in) :: im
      type(fragility_type), intent(in) :: curve
      !> Its EDP threshold
      real(wp), intent(in) :: threshold
      !> Row
      character(len=:), allocatable, intent(out) :: row

      character(len=:), allocatable :: fit, intervals
      real(wp) :: bounds(2, 2)

      fit = ',,,,'
      intervals = ',,,,,,,,,'
      if (curve%has_fit()) then
         fit = ','
         intervals = ',,,'
         if (curve%has_errors()) then
            fit = to_table(curve%se_ln_theta())//','//to_table(curve%se_beta())
            bounds = parameter_intervals(curve)
            intervals = trim(bound(bounds(1, 1)))//','//trim(bound(bounds(2, 1)))//','//trim(bound(bounds(1, 2)))//','// &
               & trim(bound(bounds(2, 2)))
         end if
         fit = to_table(curve%theta)//','//to_table(curve%beta)//','//fit//','//to_table(curve%log_likelihood)
         intervals = intervals//','//trim(curve%errors)//','//to_text(curve%clusters)//','//trim(freedom(curve))//','// &
            & to_table(sqrt(curve%naive(1, 1)))//','//to_table(sqrt(curve%naive(2, 2)))//','
         if (curve%has_errors()) intervals = intervals//to_table(curve%covariance(1, 2))
      end if
      row = cells//','//im//','//fit//','//trim(curve%status)//','//trim(bound(curve%bracket(1)))//','// &
         & trim(bound(curve%bracket(2)))//','//to_table(threshold)//','//intervals
   end subroutine make_fragility_row

   !> A curve of the population at a level
   pure subroutine make_typology_row(typology, im, level, threshold, is_safe, row)
      type(typology_type), intent(in) :: typology
      !> Intensity measure
      character(len=*), intent(in) :: im
      !> Number of the level
      integer, intent(in) :: level
      !> EDP threshold
      real(wp), intent(in) :: threshold
      !> Are texts to be no formulas in a spreadsheet?
      logical, intent(in) :: is_safe
      !> Row
      character(len=:), allocatable, intent(out) :: row

      character(len=:), allocatable :: fit, dispersion, errors

      fit = ','
      if (typology%fit%has_fit()) fit = to_table(typology%fit%theta)//','//to_table(typology%fit%beta)
      call make_error_cells(typology%fit, errors)
      dispersion = ','
      if (typology%fitted > 0.0_wp) dispersion = to_table(typology%beta_walls)//','//to_table(typology%beta_records)
      row = typology%mechanism//','//im//','//to_table(typology%levels(level))//','//to_table(typology%weight)//','// &
         & to_table(typology%mean_fraction(level))//','//to_table(typology%mean_curve(level))//','//fit//','// &
         & trim(typology%fit%status)//','//text_cell(typology%group, is_safe)//','// &
         & to_table(typology%fractile(1, level))//','//to_table(typology%fractile(2, level))//','// &
         & to_table(typology%fractile(3, level))//','//dispersion//','//to_table(typology%saturation)//','//to_table(threshold)// &
         & ','//errors
   end subroutine make_typology_row

   !> A wall with several mechanisms, or a mean, at a level; cells are empty where a mean has no counts, and without a fit
   pure subroutine make_union_row(union, im, level, number, state, threshold, is_safe, row)
      type(union_type), intent(in) :: union
      !> Intensity measure
      character(len=*), intent(in) :: im
      !> Level, and its number
      real(wp), intent(in) :: level
      integer, intent(in) :: number
      !> Number of the damage state
      integer, intent(in) :: state
      !> Its EDP threshold
      real(wp), intent(in) :: threshold
      !> Are texts to be no formulas in a spreadsheet?
      logical, intent(in) :: is_safe
      !> Row
      character(len=:), allocatable, intent(out) :: row

      character(len=:), allocatable :: counts, fit, errors, product

      counts = ',,'
      errors = no_errors
      associate (curve => union%curve(state), other => union%product(state))
         if (union%rows(1) > 0) then
            counts = to_text(nint(union%histories(number)))//','// &
               & to_table(union%histories(number)*union%fraction(number, state))//','
            call make_error_cells(curve, errors)
         end if
         fit = ','
         if (curve%has_fit()) fit = to_table(curve%theta)//','//to_table(curve%beta)
         fit = fit//','//trim(curve%status)
         product = ','
         if (other%has_fit()) product = to_table(other%theta)//','//to_table(other%beta)
      end associate
      row = text_cell(union%name, is_safe)//','//text_cell(union%group, is_safe)//','
      if (union%rows(1) > 0) row = row//to_text(union%rows(2) - union%rows(1) + 1)
      row = row//','//im//','//to_table(level)//','//counts//to_table(union%fraction(number, state))//','// &
         & to_table(union%independent(number, state))//','//to_table(threshold)//','//fit//','//errors//','//product
   end subroutine make_union_row

   !> Standard errors of a curve; cells are empty without a fit, and without standard errors
   pure subroutine make_error_cells(curve, cells)
      type(fragility_type), intent(in) :: curve
      !> Cells of `error_columns`
      character(len=:), allocatable, intent(out) :: cells

      cells = no_errors
      if (.not. curve%has_fit()) return
      cells = ',,'
      if (curve%has_errors()) cells = to_table(curve%se_ln_theta())//','//to_table(curve%se_beta())//','// &
         & to_table(curve%covariance(1, 2))
      cells = cells//','//trim(curve%errors)//','//to_text(curve%clusters)//','//trim(freedom(curve))
   end subroutine make_error_cells

   !> A history
   pure subroutine make_history_row(cells, record, polarity, im, level, scale, response, row)
      !> Name and mechanism of the wall
      character(len=*), intent(in) :: cells
      !> Name of the record, as a cell
      character(len=*), intent(in) :: record
      !> +1 as recorded, -1 reversed
      integer, intent(in) :: polarity
      !> Intensity measure
      character(len=*), intent(in) :: im
      !> Level
      real(wp), intent(in) :: level
      !> Factor on the record
      real(wp), intent(in) :: scale
      type(response_type), intent(in) :: response
      !> Row
      character(len=:), allocatable, intent(out) :: row

      row = cells//','//record//','//trim(merge('reversed   ', 'as_recorded', polarity < 0))//','//im//','// &
         & to_table(level)//','//to_table(scale)//','//to_table(response%edp)//','// &
         & to_text(merge(1, 0, response%collapsed))//','//to_text(response%impacts)//','// &
         & to_table(response%time_of_peak)
   end subroutine make_history_row

   !> Degrees of freedom of a curve, where those of records alone are whole numbers; filled up with blanks
   pure function freedom(curve) result(cell)
      type(fragility_type), intent(in) :: curve
      !> Cell
      character(len=48) :: cell

      real(wp) :: degrees

      degrees = curve%degrees_of_freedom
      if (curve%errors /= 'clustered') degrees = real(max(curve%clusters - 1, 0), wp)
      if (degrees == anint(degrees)) then
         cell = to_text(nint(degrees))
      else
         cell = to_table(degrees)
      end if
   end function freedom

   !> A bound of the median, filled up with blanks
   pure function bound(value) result(cell)
      !> The bound, 0 or huge where the side is open
      real(wp), intent(in) :: value
      !> Cell, empty where the side is open
      character(len=48) :: cell

      cell = ''
      if (value > 0.0_wp .and. value < huge(value)) cell = to_table(value)
   end function bound

end module dondolo_report_rows
