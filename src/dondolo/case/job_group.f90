!> The group &job: what is to be done and where the results go.
module dondolo_job_group
   use dondolo_error, only : error_type
   use dondolo_namelist_group, only : group_type
   use dondolo_settings, only : settings_type
   use dondolo_text, only : join, lower, to_text
   use dondolo_threads, only : largest_threads
   implicit none
   private

   public :: job_type, read_job, echo_job
   public :: task_names, job_variables

   !> Names of the tasks
   character(len=8), parameter :: task_names(3) = [character(len=8) :: 'history', 'stripes', 'typology']

   !> Variables of the group
   character(len=9), parameter :: job_variables(5) = &
      & [character(len=9) :: 'task', 'title', 'output', 'threads', 'histories']

   !> What is to be done
   type :: job_type
      !> Task, one of task_names
      character(len=:), allocatable :: task
      !> Title, for the reader of the results
      character(len=:), allocatable :: title
      !> Path prefix of the result files, relative to the current folder
      character(len=:), allocatable :: output
      !> Number of threads; 0: as many as the computer, or OMP_NUM_THREADS, offers
      integer :: threads = 0
      !> Task 'typology': write the table of all histories too?
      logical :: histories = .false.
      !> In which line the output was given, for messages
      character(len=:), allocatable :: output_line
   end type job_type

contains

   !> Read the group
   subroutine read_job(group, job, error)
      !> The group as it stands in the file
      type(group_type), intent(in) :: group
      !> What is to be done, defaults filled in
      type(job_type), intent(out) :: job
      !> What is wrong with it
      type(error_type), allocatable, intent(out) :: error

      job%task = 'stripes'
      job%title = ''
      job%output = 'dondolo'
      call group%check_names(job_variables, error)
      if (.not. allocated(error)) call group%get_text('task', job%task, error)
      if (.not. allocated(error)) call group%get_text('title', job%title, error)
      if (.not. allocated(error)) call group%get_text('output', job%output, error)
      if (.not. allocated(error)) call group%get_integer('threads', job%threads, error)
      if (.not. allocated(error)) call group%get_logical('histories', job%histories, error)
      if (allocated(error)) return
      job%task = lower(trim(job%task))
      if (.not. any(job%task == task_names)) then
         call group%refuse('task', 'must be one of '//join(task_names), error)
      else if (len_trim(job%output) == 0) then
         call group%refuse('output', 'must not be empty: the names of all result files begin with it', error)
      else if (job%output(len(job%output):) == '/') then
         call group%refuse('output', 'must end in the beginning of a file''s name, such as '''//job%output//'wall''', &
            & error)
      else if (index(job%output, '\') > 0) then
         call group%refuse('output', 'must have / between folders, not \', error)
      else if (job%threads < 0 .or. job%threads > largest_threads) then
         call group%refuse('threads', 'must lie between 0 (all) and '//to_text(largest_threads), error)
      end if
      job%output_line = group%in_line('output')
   end subroutine read_job

   !> Write the group as namelist text with every value in force
   subroutine echo_job(job, settings)
      !> What is to be done
      type(job_type), intent(in) :: job
      !> Settings to add to
      type(settings_type), intent(inout) :: settings

      call settings%add('job', 'task', job%task)
      call settings%add('job', 'title', job%title)
      call settings%add('job', 'output', job%output)
      if (job%task == 'typology') call settings%add('job', 'histories', job%histories)
      call settings%add('job', 'threads', job%threads)
   end subroutine echo_job

end module dondolo_job_group
