!> The result files of a case: CSV tables with a head of comment lines, whole or not at all.
module dondolo_reports
   use, intrinsic :: iso_fortran_env, only : compiler_version
   use dondolo_case, only : case_type
   use dondolo_ensemble, only : engine_text
   use dondolo_error, only : add_place, error_type
   use dondolo_kinds, only : wp
   use dondolo_lines, only : lines_type
   use dondolo_result_files, only : check_output, result_files_type
   use dondolo_run_case, only : results_type
   use dondolo_text, only : to_table, to_text
   use dondolo_version, only : dondolo_version_text
   use dondolo_work, only : work_names, work_type
   implicit none
   private

   public :: check_reports, write_reports

contains

   !> Try, before anything is computed, whether the reports of a case can be written
   subroutine check_reports(case, error)
      !> The case
      type(case_type), intent(in) :: case
      !> They cannot
      type(error_type), allocatable, intent(out) :: error

      type(lines_type) :: inputs

      call case%inputs(inputs)
      call check_output(case%job%output, suffixes(case%job%task), inputs, error)
      call add_place(error, case%file//': &job: output = '''//case%job%output//'''')
   end subroutine check_reports

   !> What the names of the result files of a task end with
   pure function suffixes(task) result(names)
      !> Task
      character(len=*), intent(in) :: task
      !> Ends of the names
      character(len=15), allocatable :: names(:)

      select case (task)
      case ('history')
         names = [character(len=15) :: '_walls.csv', '_history.csv']
      case ('stripes')
         names = [character(len=15) :: '_walls.csv', '_histories.csv', '_stripes.csv', '_fragility.csv']
      case default
         names = [character(len=15) :: '_walls.csv', '_stripes.csv', '_fragility.csv', '_typology.csv']
      end select
   end function suffixes

   !> Write the reports of a case
   subroutine write_reports(case, results, paths, error)
      !> The case
      type(case_type), intent(in) :: case
      !> Its results
      type(results_type), intent(in) :: results
      !> The files that were written
      type(lines_type), intent(out) :: paths
      !> They could not be written
      type(error_type), allocatable, intent(out) :: error

      type(result_files_type) :: files
      character(len=15), allocatable :: names(:)
      integer :: i

      files%prefix = case%job%output
      names = suffixes(case%job%task)
      do i = 1, size(names)
         call files%begin(trim(names(i)), error)
         if (allocated(error)) return
         call write_head(case, results, files)
         select case (names(i))
         case ('_walls.csv')
            call write_walls(case, files)
         case ('_histories.csv')
            call write_histories(case, results, files)
         case ('_stripes.csv')
            call write_stripes(case, results, files)
         case ('_fragility.csv')
            call write_fragility(case, results, files)
         case ('_typology.csv')
            call write_typology(case, results, files)
         case ('_history.csv')
            call write_history(case, results, files)
         end select
         call files%finish(error)
         if (allocated(error)) return
      end do
      call files%commit(error)
      paths = files%paths
   end subroutine write_reports

   !> Comment lines: which program, which case, what was computed, and what to beware of
   subroutine write_head(case, results, files)
      !> The case
      type(case_type), intent(in) :: case
      !> Its results
      type(results_type), intent(in) :: results
      !> Files
      type(result_files_type), intent(inout) :: files

      type(lines_type) :: echo
      integer :: i

      call files%line('# dondolo '//dondolo_version_text)
      call files%line('# compiler: '//compiler_version()//', real'//to_text(storage_size(1.0_wp)))
      call files%line('# engine and build variant: '//engine_text(results%work))
      call case%echo(echo)
      do i = 1, echo%count
         call files%line('# '//echo%line(i)%text)
      end do
      if (case%job%task /= 'history') then
         call files%line('# unit of im_level and theta: '//unit_of_levels(case))
         call files%line('# work: '//counts_of(results%work))
      end if
      do i = 1, results%warnings%count
         call files%line('# warning: '//results%warnings%line(i)%text)
      end do
   end subroutine write_head

   !> Counts of what was computed, for the head of a file
   pure function counts_of(work) result(text)
      !> What was computed
      type(work_type), intent(in) :: work
      !> Names and counts
      character(len=:), allocatable :: text

      integer :: i

      associate (counts => work%counts())
         text = trim(work_names(1))//' = '//to_text(counts(1))
         do i = 2, size(counts)
            text = text//', '//trim(work_names(i))//' = '//to_text(counts(i))
         end do
      end associate
   end function counts_of

   !> Unit of the levels, for the head of a file
   pure function unit_of_levels(case) result(unit)
      !> The case
      type(case_type), intent(in) :: case
      !> Unit, 1 for a number
      character(len=:), allocatable :: unit

      unit = case%stripes%scaling%unit()
      if (len(unit) == 0) unit = '1'
   end function unit_of_levels

   !> The walls and their static quantities
   subroutine write_walls(case, files)
      !> The case
      type(case_type), intent(in) :: case
      !> Files
      type(result_files_type), intent(inout) :: files

      integer :: i

      call files%line('wall,mechanism,height_m,thickness_m,density_kg_m3,hinge,restitution_model,restitution_value,'// &
         & 'restitution_factor,overburden_n_m,eccentricity_m,alpha_rad,p_rad_s,trigger_acceleration_m_s2,'// &
         & 'capacity_rad,restitution,weight,group,p_occ')
      do i = 1, size(case%population%walls)
         associate (wall => case%population%walls(i))
            call files%line(wall_cells(case, i)//','//to_table(wall%input%height)//','// &
               & to_table(wall%input%thickness)//','//to_table(wall%input%density)//','// &
               & given(wall%input%hinge)//','//wall%input%restitution//','// &
               & given(wall%input%restitution_value)//','//to_table(wall%input%restitution_factor)//','// &
               & given(wall%input%overburden)//','//given(wall%input%eccentricity)//','//to_table(wall%alpha)//','// &
               & to_table(wall%mechanism%frequency_parameter())//','// &
               & to_table(wall%mechanism%trigger_acceleration())//','//to_table(wall%mechanism%capacity)//','// &
               & to_table(wall%mechanism%restitution)//','//to_table(case%population%weight(i))//','// &
               & quoted(case%population%group(i)%text)//','//to_table(case%population%p_occ(i)))
         end associate
      end do
   end subroutine write_walls

   !> All histories
   subroutine write_histories(case, results, files)
      !> The case
      type(case_type), intent(in) :: case
      !> Its results
      type(results_type), intent(in) :: results
      !> Files
      type(result_files_type), intent(inout) :: files

      character(len=:), allocatable :: last
      character(len=11) :: polarity
      integer :: i, j

      last = ''
      if (case%solver%solver%estimate_error) last = ',edp_error'
      call files%line('wall,mechanism,record,polarity,im,im_level,scale,edp,collapsed,impacts,time_of_peak_s'//last)
      associate (stripes => results%stripes)
         do j = 1, size(stripes%levels)
            do i = 1, size(stripes%record)
               polarity = merge('reversed   ', 'as_recorded', stripes%polarity(i) < 0)
               associate (response => stripes%response(i, j))
                  if (case%solver%solver%estimate_error) last = ','//to_table(response%edp_error)
                  call files%line(wall_cells(case, 1)//','//quoted(case%records(stripes%record(i))%name)//','// &
                     & trim(polarity)//','//stripes%im//','//to_table(stripes%levels(j))//','// &
                     & to_table(stripes%scale(i, j))//','//to_table(response%edp)//','// &
                     & to_text(merge(1, 0, response%collapsed))//','//to_text(response%impacts)//','// &
                     & to_table(response%time_of_peak)//last)
               end associate
            end do
         end do
      end associate
   end subroutine write_histories

   !> Collapses at every level
   subroutine write_stripes(case, results, files)
      !> The case
      type(case_type), intent(in) :: case
      !> Its results
      type(results_type), intent(in) :: results
      !> Files
      type(result_files_type), intent(inout) :: files

      integer :: i, j

      call files%line('wall,mechanism,im,im_level,histories,collapses,fraction')
      do i = 1, size(case%population%walls)
         do j = 1, size(case%stripes%levels)
            call files%line(wall_cells(case, i)//','//case%stripes%scaling%name//','// &
               & to_table(case%stripes%levels(j))//','// &
               & to_text(results%histories(i))//','//to_text(results%collapses(j, i))//','// &
               & to_table(real(results%collapses(j, i), wp)/real(results%histories(i), wp)))
         end do
      end do
   end subroutine write_stripes

   !> Curves of the walls; cells are empty where there is no fit or the bracket is open
   subroutine write_fragility(case, results, files)
      !> The case
      type(case_type), intent(in) :: case
      !> Its results
      type(results_type), intent(in) :: results
      !> Files
      type(result_files_type), intent(inout) :: files

      character(len=:), allocatable :: fit
      integer :: i

      call files%line('wall,mechanism,im,theta,beta,se_ln_theta,se_beta,log_likelihood,status,bracket_low,bracket_high')
      do i = 1, size(case%population%walls)
         associate (curve => results%fragility(i))
            fit = ',,,,'
            if (curve%has_fit()) fit = to_table(curve%theta)//','//to_table(curve%beta)//','// &
               & to_table(curve%se_ln_theta())//','//to_table(curve%se_beta())//','//to_table(curve%log_likelihood)
            call files%line(wall_cells(case, i)//','//case%stripes%scaling%name//','//fit//','// &
               & trim(curve%status)//','// &
               & bound(curve%bracket(1))//','//bound(curve%bracket(2)))
         end associate
      end do
   end subroutine write_fragility

   !> Curve of the population
   subroutine write_typology(case, results, files)
      !> The case
      type(case_type), intent(in) :: case
      !> Its results
      type(results_type), intent(in) :: results
      !> Files
      type(result_files_type), intent(inout) :: files

      character(len=:), allocatable :: fit, dispersion
      integer :: i, j

      call files%line('mechanism,im,im_level,weight,mean_fraction,mean_curve,theta,beta,status,group,fractile_16,'// &
         & 'fractile_50,fractile_84,beta_walls,beta_records')
      do i = 1, size(results%typologies)
         associate (typology => results%typologies(i))
            fit = ','
            if (typology%fit%has_fit()) fit = to_table(typology%fit%theta)//','//to_table(typology%fit%beta)
            dispersion = ','
            if (typology%fitted > 0.0_wp) dispersion = to_table(typology%beta_walls)//','// &
               & to_table(typology%beta_records)
            do j = 1, size(typology%levels)
               call files%line(typology%mechanism//','//case%stripes%scaling%name//','// &
                  & to_table(typology%levels(j))//','// &
                  & to_table(typology%weight)//','//to_table(typology%mean_fraction(j))//','// &
                  & to_table(typology%mean_curve(j))//','//fit//','//trim(typology%fit%status)//','// &
                  & quoted(typology%group)//','//to_table(typology%fractile(1, j))//','// &
                  & to_table(typology%fractile(2, j))//','//to_table(typology%fractile(3, j))//','//dispersion)
            end do
         end associate
      end do
   end subroutine write_typology

   !> The time history
   subroutine write_history(case, results, files)
      !> The case
      type(case_type), intent(in) :: case
      !> Its results
      type(results_type), intent(in) :: results
      !> Files
      type(result_files_type), intent(inout) :: files

      real(wp) :: capacity
      integer :: i

      associate (response => results%response, trace => results%trace)
         call files%line('# record: '//case%records(case%history%record)%name)
         call files%line('# scale: '//to_table(case%history_scale()))
         call files%line('# edp: '//to_table(response%edp))
         call files%line('# collapsed: '//to_text(merge(1, 0, response%collapsed)))
         call files%line('# impacts: '//to_text(response%impacts))
         call files%line('# time_of_peak_s: '//to_table(response%time_of_peak))
         if (case%solver%solver%estimate_error) call files%line('# edp_error: '//to_table(response%edp_error))
         call files%line('time_s,ground_acceleration_m_s2,rotation_rad,velocity_rad_s,edp')
         capacity = case%population%walls(1)%mechanism%capacity
         do i = 1, trace%rows
            call files%line(to_table(trace%time(i))//','//to_table(trace%acceleration(i))//','// &
               & to_table(trace%rotation(i))//','//to_table(trace%velocity(i))//','// &
               & to_table(abs(trace%rotation(i))/capacity))
         end do
      end associate
   end subroutine write_history

   !> Name and mechanism of a wall
   pure function wall_cells(case, i) result(cells)
      !> The case
      type(case_type), intent(in) :: case
      !> Number of the wall
      integer, intent(in) :: i
      !> Two cells
      character(len=:), allocatable :: cells

      cells = quoted(case%population%walls(i)%input%name)//','//case%population%walls(i)%input%mechanism
   end function wall_cells

   !> A text as a cell: in quotes where RFC 4180 asks for them
   pure function quoted(text) result(cell)
      !> Text
      character(len=*), intent(in) :: text
      !> Cell
      character(len=:), allocatable :: cell

      integer :: i

      cell = text
      ! A # would begin a comment; quotes keep it a cell
      if (scan(text, ',"#'//new_line('a')//achar(13)) == 0) return
      cell = '"'
      do i = 1, len(text)
         cell = cell//text(i:i)
         if (text(i:i) == '"') cell = cell//'"'
      end do
      cell = cell//'"'
   end function quoted

   !> A number that not every wall has
   pure function given(value) result(cell)
      !> The number
      real(wp), allocatable, intent(in) :: value
      !> Cell, empty if there is no number
      character(len=:), allocatable :: cell

      cell = ''
      if (allocated(value)) cell = to_table(value)
   end function given

   !> A bound of the median
   pure function bound(value) result(cell)
      !> The bound, 0 or huge where the side is open
      real(wp), intent(in) :: value
      !> Cell, empty where the side is open
      character(len=:), allocatable :: cell

      cell = ''
      if (value > 0.0_wp .and. value < huge(value)) cell = to_table(value)
   end function bound

end module dondolo_reports
