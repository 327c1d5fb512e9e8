!> A case: everything a user asks for in one namelist file.
module dondolo_case
   use dondolo_base_kinds, only : wp
   use dondolo_base_lines, only : lines_type
   use dondolo_base_settings, only : group_settings_type, new_settings
   use dondolo_building_input, only : building_properties
   use dondolo_case_echo, only : echo_type
   use dondolo_case_history_group, only : history_input_type
   use dondolo_case_job_group, only : history_task, job_type, stripes_task, task_names, typology_task
   use dondolo_case_population_group, only : put_population
   use dondolo_case_records_group, only : records_input_type
   use dondolo_case_settings_group, only : echo_settings
   use dondolo_case_solver_group, only : solver_input_type
   use dondolo_case_stripes_group, only : stripes_input_type
   use dondolo_case_survey, only : survey_type
   use dondolo_check_input, only : check_input_type, check_properties, put_check
   use dondolo_files_paths, only : beside
   use dondolo_fragility_study, only : new_study, study_type
   use dondolo_population_table, only : population_table_type
   use dondolo_record_suite, only : suite_type
   use dondolo_wall, only : wall_type
   use dondolo_wall_properties, only : is_of_building, own_properties, wall_properties
   implicit none
   private

   public :: case_type, list_wall_tables

   !> A case
   type :: case_type
      !> Path of its file
      character(len=:), allocatable :: file
      !> What is to be done
      type(job_type) :: job
      !> Path of the population as it was given; not allocated: the case has one wall, or one facade
      character(len=:), allocatable :: population_file
      !> Are its walls designs of one wall, to be compared with the first?
      logical :: designs = .false.
      !> What the rows of the population are taken from: its table, or a facade or wall with variants
      type(population_table_type) :: table
      !> Settings of its variants; not allocated: it has none
      type(group_settings_type), allocatable :: uncertainty
      !> The wall, unless the task is 'typology'
      type(wall_type) :: wall
      !> What there is in the population, if the task is 'typology'
      type(survey_type) :: survey
      !> Input of the accelerograms
      type(records_input_type) :: records_input
      !> The accelerograms, measured where they are scaled to levels
      type(suite_type) :: suite
      !> Factor on each at each level, as in study_type; not allocated: every record runs at every level
      real(wp), allocatable :: factor(:, :)
      !> Intensity measure and levels
      type(stripes_input_type) :: stripes
      !> How the motions are computed
      type(solver_input_type) :: solver
      !> Which time history
      type(history_input_type) :: history
      !> Check by a building code; not allocated: none
      type(check_input_type), allocatable :: check
      !> How its tables were read: notes
      type(lines_type) :: notes
   contains
      !> Are records scaled to levels?
      procedure :: is_scaled
      !> What walls are tried with
      procedure :: make_study
      !> Factor on the record of the time history, with the sign of its polarity
      procedure :: history_scale
      !> Path of the population
      procedure :: population_path
      !> The case as namelist text
      procedure :: echo
      !> Paths of the files it is made of
      procedure :: inputs
   end type case_type

contains

   !> Are records scaled to levels?
   pure logical function is_scaled(self)
      class(case_type), intent(in) :: self

      is_scaled = self%job%task /= history_task .or. allocated(self%history%im_level)
   end function is_scaled

   !> What walls are tried with
   subroutine make_study(self, study, threads)
      !> The case, which must outlive the study
      class(case_type), intent(in), target :: self
      type(study_type), intent(out) :: study
      !> Number of threads instead of the case's
      integer, intent(in), optional :: threads

      integer :: team

      team = self%job%threads
      if (present(threads)) team = threads
      call new_study(study, self%suite, self%stripes%scaling, self%stripes%levels, self%records_input%polarity, &
         & self%solver%solver, team)
      if (allocated(self%factor)) study%factor = self%factor
      study%thresholds = self%stripes%thresholds
      study%keeps_histories = self%job%task == stripes_task .or. self%job%histories
      study%solver%collapses_only = size(study%thresholds) == 1 .and. .not. study%keeps_histories
   end subroutine make_study

   !> Factor on the record of the time history, with the sign of its polarity
   function history_scale(self) result(scale)
      class(case_type), intent(in) :: self
      !> The factor
      real(wp) :: scale

      real(wp) :: values(size(self%suite%records))

      if (allocated(self%history%im_level)) then
         values = self%suite%values(self%stripes%scaling%measure, self%job%threads)
         values = self%stripes%scaling%factors(self%history%im_level, values, self%wall)
         scale = values(self%history%record)
      else
         scale = self%history%scale
      end if
      if (self%records_input%polarity == 'reversed') scale = -scale
   end function history_scale

   !> Length of the path of the population
   pure integer function path_length(self)
      !> The case, its task 'typology'
      class(case_type), intent(in) :: self

      path_length = len(self%file)
      if (allocated(self%population_file)) path_length = len(beside(self%population_file, self%file))
   end function path_length

   !> Path of the population
   pure function population_path(self) result(path)
      !> The case, its task 'typology'
      class(case_type), intent(in) :: self
      !> Path, relative to the current folder; that of the case, which describes a facade
      character(len=path_length(self)) :: path

      path = self%file
      if (allocated(self%population_file)) path = beside(self%population_file, self%file)
   end function population_path

   !> The case as namelist text: every value in force, and no group that the task does not use
   subroutine echo(self, echoed)
      class(case_type), intent(in) :: self
      type(echo_type), intent(out) :: echoed

      type(group_settings_type) :: settings

      call self%job%put(settings)
      call echo_settings('job', settings, echoed, owner=trim(task_names(self%job%task)))
      if (allocated(self%population_file)) then
         call put_population(self%population_file, self%table%occurrence, self%designs, settings)
         call echo_settings('population', settings, echoed)
      else if (allocated(self%table%base_wall)) then
         call echo_settings('wall', self%table%base_wall, echoed, last='restitution_factor', &
            & rows=wall_properties(:own_properties))
         if (self%table%base_wall%gives(is_of_building)) call echo_settings('building', self%table%base_wall, echoed, &
            & rows=building_properties)
         if (allocated(self%uncertainty)) call echo_settings('uncertainty', self%uncertainty, echoed)
      else
         call echo_settings('wall', self%wall%input, echoed, last='restitution_factor', &
            & rows=wall_properties(:own_properties))
         if (allocated(self%wall%building)) call echo_settings('building', self%wall%input, echoed, &
            & rows=building_properties)
      end if
      call self%records_input%put(settings)
      call echo_settings('records', settings, echoed)
      if (self%is_scaled()) then
         call self%stripes%put(settings)
         call echo_settings('stripes', settings, echoed)
      end if
      call self%solver%put(settings)
      call echo_settings('solver', settings, echoed, beside='atol')
      if (allocated(self%check)) then
         call new_settings(settings, check_properties)
         call put_check(self%check, settings)
         call echo_settings('check', settings, echoed)
      end if
      if (self%job%task /= history_task) return
      call self%history%put(settings)
      call echo_settings('history', settings, echoed)
   end subroutine echo

   !> Paths of the files it is made of
   subroutine inputs(self, paths)
      class(case_type), intent(in) :: self
      !> The namelist file, the catalogue, the population, the tables of walls
      type(lines_type), intent(out) :: paths

      type(lines_type) :: tables
      integer :: i

      call paths%add(self%file)
      call paths%add(beside(self%records_input%catalogue, self%file))
      if (allocated(self%population_file)) call paths%add(self%population_path())
      call list_wall_tables(self, tables)
      do i = 1, tables%count
         call paths%add(tables%line(i)%text)
      end do
   end subroutine inputs

   !> Paths of the files that tabulated walls and chains have their terms from
   subroutine list_wall_tables(case, paths)
      class(case_type), intent(in) :: case
      !> Each once
      type(lines_type), intent(out) :: paths

      if (case%job%task == typology_task) then
         paths = case%survey%tables
      else if (allocated(case%wall%input%table_file)) then
         call paths%add(case%wall%input%table_file)
      else
         paths = case%wall%input%chain_files
      end if
   end subroutine list_wall_tables

end module dondolo_case
