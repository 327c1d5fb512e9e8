!> The group &job: what is to be done and where the results go.
module dondolo_case_job_group
   use dondolo_base_error, only : error_type, not_given, out_of_range
   use dondolo_base_kinds, only : wp
   use dondolo_base_property, only : blank, choices_length, is_integer, is_logical, is_text, most_choices, property_type
   use dondolo_base_settings, only : group_settings_type, new_settings
   use dondolo_base_threads, only : largest_threads
   use dondolo_case_namelist_group, only : group_type
   use dondolo_case_settings_group, only : read_settings
   implicit none
   private

   public :: job_type, read_job
   public :: history_task, stripes_task, typology_task, task_names, job_properties

   !> Tasks, and their names in cases
   integer, parameter :: history_task = 1, stripes_task = 2, typology_task = 3
   character(len=choices_length), parameter :: task_names(3) = &
      & [character(len=choices_length) :: 'history', 'stripes', 'typology']

   !> Tasks of populations
   character(len=choices_length), parameter :: typology(most_choices) = &
      & reshape(task_names(typology_task:typology_task), [most_choices], pad=blank)

   !> Variables of the group
   type(property_type), target, protected :: job_properties(6) = [ &
      & property_type('task', is_text, word=task_names(stripes_task), choices=reshape(task_names, [most_choices], pad=blank), &
      &   meaning='analysis to run'), &
      & property_type('title', is_text, changes_results=.false., meaning='any text'), &
      & property_type('output', is_text, word='dondolo', changes_results=.false., meaning='prefix of the '// &
      &   'result files, relative to the current folder'), &
      & property_type('histories', is_logical, owners=typology, meaning='also write the table of all histories'), &
      & property_type('spreadsheet_safe', is_logical, changes_results=.false., meaning='put an apostrophe before names '// &
      &   'that a spreadsheet would read as formulas'), &
      & property_type('threads', is_integer, smallest=0.0_wp, largest=real(largest_threads, wp), zero='all', &
      &   changes_results=.false., meaning='number of threads; 0: all, or OMP_NUM_THREADS')]

   !> What is to be done
   type :: job_type
      !> One of the tasks
      integer :: task = stripes_task
      !> Title, for the reader of the results
      character(len=:), allocatable :: title
      !> Path prefix of the result files, relative to the current folder
      character(len=:), allocatable :: output
      !> Number of threads; 0: as many as the computer, or OMP_NUM_THREADS, offers
      integer :: threads = 0
      !> Task 'typology': write the table of all histories too?
      logical :: histories = .false.
      !> Is an apostrophe put before texts in tables that a spreadsheet would take for formulas?
      logical :: spreadsheet_safe = .false.
      !> In which line the output was given, for messages
      character(len=:), allocatable :: output_line
   contains
      !> The same as settings
      procedure :: put
   end type job_type

contains

   !> Read the group
   subroutine read_job(group, job, error)
      !> The group as read from the file
      type(group_type), intent(in) :: group
      !> What is to be done, defaults filled in
      type(job_type), intent(out) :: job
      !> What is wrong with it
      type(error_type), allocatable, intent(out) :: error

      type(group_settings_type) :: settings

      call new_settings(settings, job_properties)
      call read_settings(group, settings, error)
      if (allocated(error)) return
      job%task = findloc(task_names == settings%word('task'), .true., dim=1)
      job%title = settings%word('title')
      job%output = settings%word('output')
      job%histories = settings%holds('histories')
      job%spreadsheet_safe = settings%holds('spreadsheet_safe')
      job%threads = nint(settings%number('threads'))
      if (len_trim(job%output) == 0) then
         call group%refuse('output', 'must not be empty: the names of all result files begin with it', not_given, error)
      else if (job%output(len(job%output):) == '/') then
         call group%refuse('output', 'must end in the beginning of a file''s name, such as '''//job%output//'wall''', &
            & out_of_range, error)
      else if (any(job%output(index(job%output, '/', back=.true.) + 1:) == ['. ', '..'])) then
         call group%refuse('output', 'must end in the beginning of a file''s name, such as '''//job%output//'/wall''', &
            & out_of_range, error)
      else if (index(job%output, '\') > 0) then
         call group%refuse('output', 'must have / between folders, not \', out_of_range, error)
      else if (scan(job%output(1:1), '~$') > 0) then
         ! It would make a folder named ~, and removing that in a shell removes the home folder
         call group%refuse('output', 'must be a path from the current folder or from /: '// &
            & job%output(1:1)//' is not replaced as a shell does', out_of_range, error)
      end if
      job%output_line = group%in_line('output')
   end subroutine read_job

   !> What is to be done, as settings
   subroutine put(self, settings)
      !> What is to be done
      class(job_type), intent(in) :: self
      !> Values of job_properties
      type(group_settings_type), intent(out) :: settings

      call new_settings(settings, job_properties)
      call settings%set('task', trim(task_names(self%task)))
      call settings%set('title', self%title)
      call settings%set('output', self%output)
      call settings%set('histories', self%histories)
      call settings%set('spreadsheet_safe', self%spreadsheet_safe)
      call settings%set('threads', self%threads)
   end subroutine put

end module dondolo_case_job_group
