!> Accelerogram files of every known format, recognised by their content.
module dondolo_record_reader
   use dondolo_error, only : add_place, error_type, raise_input
   use dondolo_format_columns, only : columns_format_type
   use dondolo_format_dyna, only : dyna_format_type
   use dondolo_format_peer, only : peer_format_type
   use dondolo_kinds, only : wp
   use dondolo_record, only : new_record, record_type
   use dondolo_record_format, only : format_type, samples_type
   use dondolo_text, only : to_text
   use dondolo_text_file, only : read_text_file, text_file_type
   use dondolo_units, only : unit_factor
   implicit none
   private

   public :: read_record

   !> Relative difference allowed between a time step that is given and the file's own
   real(wp), parameter :: step_tolerance = 0.01_wp

   !> A format that is known
   type :: known_type
      !> The format
      class(format_type), allocatable :: format
   end type known_type

contains

   !> The formats that are known, the strictest first
   subroutine list_formats(known)
      !> The formats
      type(known_type), allocatable, intent(out) :: known(:)

      allocate (known(3))
      allocate (peer_format_type :: known(1)%format)
      allocate (dyna_format_type :: known(2)%format)
      allocate (columns_format_type :: known(3)%format)
   end subroutine list_formats

   !> Read an accelerogram
   !>
   !> What the file states is used; a time step or units that are given as well must agree with it.
   subroutine read_record(file, record, error, dt, units)
      !> Path of the file
      character(len=*), intent(in) :: file
      !> The record; its name is the stem of the file
      type(record_type), intent(out) :: record
      !> The file is missing, unknown, wrong, or says less than is needed
      type(error_type), allocatable, intent(out) :: error
      !> Time step [s], needed where the file does not state it
      real(wp), intent(in), optional :: dt
      !> Units of the values, needed where the file does not state them; empty is not given
      character(len=*), intent(in), optional :: units

      type(text_file_type) :: text
      type(samples_type) :: samples
      type(known_type), allocatable :: known(:)
      real(wp) :: step, factor
      integer :: i

      call read_text_file(file, text, error)
      if (allocated(error)) return
      call list_formats(known)
      do i = 1, size(known)
         if (known(i)%format%recognises(text)) exit
      end do
      if (i > size(known)) then
         call raise_input(error, file//': the format is not known: must be one of '//names_of(known))
         return
      end if
      call known(i)%format%read(text, samples, error)
      if (allocated(error)) return
      call choose_step(samples%dt, step, error, dt)
      if (.not. allocated(error)) call choose_units(samples%units, factor, error, units)
      if (.not. allocated(error)) call new_record(record, factor*samples%values, step, stem(file), error)
      call add_place(error, file)
   end subroutine read_record

   !> Take the time step from the file or from the caller
   subroutine choose_step(stated, step, error, given)
      !> Time step that the file states [s], 0 if none
      real(wp), intent(in) :: stated
      !> Time step [s]
      real(wp), intent(out) :: step
      !> There is none, or two that differ
      type(error_type), allocatable, intent(out) :: error
      !> Time step that the caller gives [s]
      real(wp), intent(in), optional :: given

      step = stated
      if (.not. present(given)) then
         if (.not. stated > 0.0_wp) call raise_input(error, 'the file does not state its time step: dt must be given')
         return
      end if
      if (.not. (given > 0.0_wp .and. given <= huge(given))) then
         call raise_input(error, 'dt = '//to_text(given)//': must be positive')
         return
      end if
      if (stated > 0.0_wp) then
         if (abs(given - stated) > step_tolerance*stated) then
            call raise_input(error, 'dt = '//to_text(given)//': the file states '//to_text(stated))
         end if
      else
         step = given
      end if
   end subroutine choose_step

   !> Take the units from the file or from the caller
   subroutine choose_units(stated, factor, error, given)
      !> Units that the file states, empty if none
      character(len=*), intent(in) :: stated
      !> Size of the unit [m/s2]
      real(wp), intent(out) :: factor
      !> There are none, two that differ, or one that is not known
      type(error_type), allocatable, intent(out) :: error
      !> Units that the caller gives
      character(len=*), intent(in), optional :: given

      real(wp) :: factor_given
      logical :: is_given

      factor = 1.0_wp
      is_given = .false.
      if (present(given)) is_given = len_trim(given) > 0
      if (is_given) then
         call unit_factor(given, factor_given, error)
         if (allocated(error)) return
      else
         if (len_trim(stated) == 0) then
            call raise_input(error, 'the file does not state its units: units must be given')
            return
         end if
      end if
      if (len_trim(stated) == 0) then
         factor = factor_given
         return
      end if
      call unit_factor(stated, factor, error)
      if (allocated(error) .or. .not. is_given) return
      if (factor_given < factor .or. factor_given > factor) then
         call raise_input(error, 'units = '''//trim(given)//''': the file states '''//trim(stated)//'''')
      end if
   end subroutine choose_units

   !> Names of formats, for messages
   function names_of(known) result(names)
      !> Formats
      type(known_type), intent(in) :: known(:)
      !> Their names, separated by commas
      character(len=:), allocatable :: names

      integer :: i

      names = known(1)%format%name()
      do i = 2, size(known)
         names = names//', '//known(i)%format%name()
      end do
   end function names_of

   !> Name of a file without folder and last extension
   pure function stem(file)
      !> Path
      character(len=*), intent(in) :: file
      !> Its stem
      character(len=:), allocatable :: stem

      integer :: point

      stem = trim(file(scan(file, '/\', back=.true.) + 1:))
      point = index(stem, '.', back=.true.)
      if (point > 1) stem = stem(:point - 1)
   end function stem

end module dondolo_record_reader
