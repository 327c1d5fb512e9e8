!> Accelerogram files of every known format, recognised by their content.
module dondolo_record_reader
   use dondolo_channel, only : as_record, find_channel, name_channels
   use dondolo_error, only : add_place, error_type, raise_input
   use dondolo_format_asa, only : asa_format_type
   use dondolo_format_columns, only : columns_format_type
   use dondolo_format_cosmos, only : cosmos_format_type
   use dondolo_format_csmip, only : csmip_format_type
   use dondolo_format_cwa, only : cwa_format_type
   use dondolo_format_dyna, only : dyna_format_type
   use dondolo_format_eqsig, only : eqsig_format_type
   use dondolo_format_geonet, only : geonet_format_type
   use dondolo_format_knet, only : knet_format_type
   use dondolo_format_peer, only : peer_format_type
   use dondolo_format_smc, only : smc_format_type
   use dondolo_format_smtk, only : smtk_format_type
   use dondolo_kinds, only : wp
   use dondolo_record, only : record_type
   use dondolo_record_format, only : format_type, samples_type
   use dondolo_text, only : lower
   use dondolo_text_file, only : read_text_file, text_file_type
   implicit none
   private

   public :: read_record, read_records

   !> A format that is known
   type :: known_type
      !> The format
      class(format_type), allocatable :: format
   end type known_type

contains

   !> The formats that are known; plain columns come last, for what no other recognises
   subroutine list_formats(known)
      !> The formats
      type(known_type), allocatable, intent(out) :: known(:)

      allocate (known(0))
      call append(known, peer_format_type())
      call append(known, dyna_format_type())
      call append(known, cosmos_format_type())
      call append(known, csmip_format_type())
      call append(known, geonet_format_type())
      call append(known, smc_format_type())
      call append(known, smtk_format_type())
      call append(known, knet_format_type())
      call append(known, cwa_format_type())
      call append(known, asa_format_type())
      call append(known, eqsig_format_type())
      call append(known, columns_format_type())
   end subroutine list_formats

   !> Append a format to a list
   subroutine append(known, format)
      !> The list
      type(known_type), allocatable, intent(inout) :: known(:)
      !> The format
      class(format_type), intent(in) :: format

      type(known_type), allocatable :: longer(:)
      integer :: i

      allocate (longer(size(known) + 1))
      do i = 1, size(known)
         call move_alloc(known(i)%format, longer(i)%format)
      end do
      allocate (longer(size(longer))%format, source=format)
      call move_alloc(longer, known)
   end subroutine append

   !> Read an accelerogram
   !>
   !> What the file states is used; a time step or units that are given as well must agree with it.
   subroutine read_record(file, record, error, dt, units, channel, format)
      !> Path of the file
      character(len=*), intent(in) :: file
      !> The record; its name is the stem of the file, with the channel's if there are several
      type(record_type), intent(out) :: record
      !> The file is missing, unknown, wrong, says less than is needed, or holds several channels and none is chosen
      type(error_type), allocatable, intent(out) :: error
      !> Time step [s], needed where the file does not state it
      real(wp), intent(in), optional :: dt
      !> Units of the values, needed where the file does not state them; empty is not given
      character(len=*), intent(in), optional :: units
      !> Name of a channel, or its number; empty is not given
      character(len=*), intent(in), optional :: channel
      !> Name of the format that the file is in, not to be recognised; empty is not given
      character(len=*), intent(in), optional :: format

      type(text_file_type) :: text
      type(samples_type) :: samples
      integer :: i

      call read_samples(file, text, samples, error, format)
      if (allocated(error)) return
      call find_channel(samples, i, error, channel)
      call add_place(error, file)
      if (.not. allocated(error)) call as_record(text, samples, i, record, error, dt, units)
   end subroutine read_record

   !> Read all channels of a file
   subroutine read_records(file, records, error, dt, units, format)
      !> Path of the file
      character(len=*), intent(in) :: file
      !> One record for each channel that holds accelerations
      type(record_type), allocatable, intent(out) :: records(:)
      !> As of `read_record`
      type(error_type), allocatable, intent(out) :: error
      !> Time step [s], needed where the file does not state it
      real(wp), intent(in), optional :: dt
      !> Units of the values, needed where the file does not state them; empty is not given
      character(len=*), intent(in), optional :: units
      !> Name of the format that the file is in, not to be recognised; empty is not given
      character(len=*), intent(in), optional :: format

      type(text_file_type) :: text
      type(samples_type) :: samples
      integer, allocatable :: ground(:)
      integer :: i

      call read_samples(file, text, samples, error, format)
      if (allocated(error)) return
      ground = pack([(i, i=1, size(samples%channels))], &
         & [(.not. allocated(samples%channels(i)%refusal), i=1, size(samples%channels))])
      ! If none is, the first says why
      if (size(ground) == 0) ground = [1]
      allocate (records(size(ground)))
      do i = 1, size(records)
         call as_record(text, samples, ground(i), records(i), error, dt, units)
         if (.not. allocated(error)) cycle
         deallocate (records)
         return
      end do
   end subroutine read_records

   !> Read what a file says
   subroutine read_samples(file, text, samples, error, format)
      !> Path of the file
      character(len=*), intent(in) :: file
      !> Its text
      type(text_file_type), intent(out) :: text
      !> What it says
      type(samples_type), intent(out) :: samples
      !> The file is missing, unknown or wrong
      type(error_type), allocatable, intent(out) :: error
      !> Name of the format that the file is in; empty is not given
      character(len=*), intent(in), optional :: format

      type(known_type), allocatable :: known(:)
      integer :: i

      call list_formats(known)
      i = 0
      if (present(format)) then
         if (len_trim(format) > 0) then
            do i = 1, size(known)
               if (known(i)%format%name() == lower(trim(adjustl(format)))) exit
            end do
            if (i > size(known)) then
               call raise_input(error, file//': format = '''//trim(format)//''': must be one of '//names_of(known))
               return
            end if
         end if
      end if
      call read_text_file(file, text, error)
      if (allocated(error)) return
      if (i == 0) call recognise(text, known, i, error)
      if (allocated(error)) return
      call known(i)%format%read(text, samples, error)
      if (allocated(error)) return
      call samples%metadata%set('format', known(i)%format%name())
      call name_channels(samples%channels)
   end subroutine read_samples

   !> Find the format of a text
   subroutine recognise(text, known, found, error)
      !> The file
      type(text_file_type), intent(in) :: text
      !> The formats that are known
      type(known_type), intent(in) :: known(:)
      !> Number of its format
      integer, intent(out) :: found
      !> No format recognises it, or two do
      type(error_type), allocatable, intent(out) :: error

      integer :: i

      found = 0
      do i = 1, size(known)
         if (i == size(known) .and. found > 0) exit
         if (.not. known(i)%format%recognises(text)) cycle
         if (found > 0) then
            call raise_input(error, text%file//': may be in the format '''//known(found)%format%name()//''', '''// &
               & known(i)%format%name()//''': format must name one of them')
            return
         end if
         found = i
      end do
      if (found == 0) call raise_input(error, text%file//': the format is not known: must be one of '//names_of(known))
   end subroutine recognise

   !> Names of formats, for messages
   function names_of(known) result(names)
      !> Formats
      type(known_type), intent(in) :: known(:)
      !> Their names in quotes, separated by commas
      character(len=:), allocatable :: names

      integer :: i

      names = ''
      do i = 1, size(known)
         if (i > 1) names = names//', '
         names = names//''''//known(i)%format%name()//''''
      end do
   end function names_of

end module dondolo_record_reader
