!> Between the flat arguments of dondolo_f2py and the types of the library.
!>
!> f2py cannot pass results whose size only the library knows. They travel as a parcel: a procedure that opens one
!> returns its address and its sizes, and `take` copies its contents into arrays of these sizes and frees it.
module dondolo_boundary
   use, intrinsic :: iso_c_binding, only : c_double, c_f_pointer, c_int, c_intptr_t, c_loc, c_ptr
   use dondolo_error, only : add_place, error_type, raise_failure, raise_input
   use dondolo_fragility, only : fragility_type, status_names
   use dondolo_interrupt, only : look_for_interrupt
   use dondolo_lines, only : lines_type
   use dondolo_mechanism, only : mechanism_type
   use dondolo_memory, only : check_memory => check_room, raise_shortage
   use dondolo_population, only : member_type
   use dondolo_property, only : is_list, is_text, is_words
   use dondolo_record, only : record_type
   use dondolo_response, only : response_type, trace_type
   use dondolo_response_spectrum, only : largest_period, smallest_period
   use dondolo_solver, only : solver_type
   use dondolo_text, only : to_text
   use dondolo_wall, only : new_wall, wall_type
   use dondolo_wall_properties, only : wall_input_type, wall_numbers, wall_properties
   use dondolo_warning, only : warnings_type
   use dondolo_warning_sentence, only : warning_objects
   implicit none
   private

   public :: parcel_type, send, take
   public :: report, split_lines, pack_lines, pack_warnings, as_solver, check_rotations, &
      & check_spectrum, check_room, check_parcel, check_trace, check_interrupt
   public :: set_walls, set_records, pack_note, pack_records, pack_walls, pack_members, pack_response, pack_curve, status_code

   !> What each thing that is worked on takes at most, all that is copied and sent included [bytes]
   real(c_double), parameter :: bytes_of_wall = 4000.0_c_double, bytes_of_record = 2000.0_c_double, &
      & bytes_of_sample = 64.0_c_double, bytes_of_history = 160.0_c_double

   !> Contents of unknown size on their way to Python
   type :: parcel_type
      !> Integers
      integer(c_int), allocatable :: integers(:)
      !> Reals
      real(c_double), allocatable :: reals(:)
      !> Text
      character(len=:), allocatable :: text
   end type parcel_type

contains

   !> Send a parcel: its address and its sizes
   subroutine send(parcel, handle, sizes)
      !> The parcel; it is moved away
      type(parcel_type), intent(inout) :: parcel
      !> Address to take it from
      integer(c_intptr_t), intent(out) :: handle
      !> Number of integers, reals and characters
      integer(c_int), intent(out) :: sizes(3)

      type(parcel_type), pointer :: sent

      if (.not. allocated(parcel%integers)) allocate (parcel%integers(0))
      if (.not. allocated(parcel%reals)) allocate (parcel%reals(0))
      if (.not. allocated(parcel%text)) parcel%text = ''
      allocate (sent)
      call move_alloc(parcel%integers, sent%integers)
      call move_alloc(parcel%reals, sent%reals)
      call move_alloc(parcel%text, sent%text)
      sizes = [size(sent%integers), size(sent%reals), len(sent%text)]
      handle = transfer(c_loc(sent), handle)
   end subroutine send

   !> Take a parcel and free it
   subroutine take(handle, integers, reals, characters)
      !> Its address, which is valid once
      integer(c_intptr_t), intent(in) :: handle
      !> Its integers
      integer(c_int), intent(out) :: integers(:)
      !> Its reals
      real(c_double), intent(out) :: reals(:)
      !> Codes of its characters (bytes)
      integer(c_int), intent(out) :: characters(:)

      type(parcel_type), pointer :: sent
      type(c_ptr) :: address
      integer :: i

      address = transfer(handle, address)
      call c_f_pointer(address, sent)
      integers = sent%integers
      reals = sent%reals
      do i = 1, size(characters)
         characters(i) = ichar(sent%text(i:i))
      end do
      deallocate (sent)
   end subroutine take

   !> An error as status and message
   subroutine report(error, stat, message)
      !> The error; not allocated: success
      type(error_type), allocatable, intent(in) :: error
      !> 0, or the kind of the error
      integer(c_int), intent(out) :: stat
      !> Its sentence
      character(len=*), intent(out) :: message

      stat = 0
      message = ''
      if (.not. allocated(error)) return
      stat = error%stat
      message = error%message
   end subroutine report

   !> The next line of a text
   pure subroutine next_line(text, at, line)
      !> Lines, separated by new_line
      character(len=*), intent(in) :: text
      !> Position: where the line begins, then where the next one does; 1 for the first
      integer, intent(inout) :: at
      !> The line; blanks at its end are lost, and after the last line it is empty
      character(len=:), allocatable, intent(out) :: line

      integer :: length

      length = index(text(at:), new_line('a')) - 1
      if (length < 0) length = len(text) - at + 1
      line = trim(text(at:at + length - 1))
      at = min(at + length + 1, len(text) + 1)
   end subroutine next_line

   !> All lines of a text
   subroutine split_lines(text, lines)
      !> Lines, each ended by new_line
      character(len=*), intent(in) :: text
      !> The lines
      type(lines_type), intent(out) :: lines

      character(len=:), allocatable :: line
      integer :: at

      at = 1
      do while (at <= len(text))
         call next_line(text, at, line)
         call lines%add(line)
      end do
   end subroutine split_lines

   !> Length of lines as one text
   pure integer function packed_length(lines) result(length)
      !> Lines
      type(lines_type), intent(in) :: lines

      integer :: i

      length = 0
      do i = 1, lines%count
         length = length + len(lines%line(i)%text) + 1
      end do
   end function packed_length

   !> Lines as one text
   pure function pack_lines(lines) result(text)
      !> Lines
      type(lines_type), intent(in) :: lines
      !> The same, each ended by new_line
      character(len=packed_length(lines)) :: text

      integer :: i, length, at

      at = 0
      do i = 1, lines%count
         length = len(lines%line(i)%text) + 1
         text(at + 1:at + length) = lines%line(i)%text//new_line('a')
         at = at + length
      end do
   end function pack_lines

   !> Append warnings to the text of a parcel: JSON objects, each on its line
   subroutine pack_warnings(warnings, parcel)
      !> Warnings
      type(warnings_type), intent(in) :: warnings
      !> The parcel
      type(parcel_type), intent(inout) :: parcel

      type(lines_type) :: lines

      call warning_objects(warnings, lines)
      if (.not. allocated(parcel%text)) parcel%text = ''
      parcel%text = parcel%text//pack_lines(lines)
   end subroutine pack_warnings

   !> Append a note to the text of a parcel
   subroutine pack_note(note, parcel)
      !> The note; empty or not allocated: none
      character(len=:), allocatable, intent(in) :: note
      !> The parcel
      type(parcel_type), intent(inout) :: parcel

      if (.not. allocated(note)) return
      if (len(note) > 0) parcel%text = parcel%text//note//new_line('a')
   end subroutine pack_note

   !> Settings of the computation
   pure function as_solver(engine, settings) result(solver)
      !> Engine
      character(len=*), intent(in) :: engine
      !> rtol, atol, edp_limit; 1 where errors are to be estimated, 1 where collapses alone are wanted, else 0
      real(c_double), intent(in) :: settings(5)
      !> The settings
      type(solver_type) :: solver

      solver%engine = engine
      solver%rtol = settings(1)
      solver%atol = settings(2)
      solver%edp_limit = settings(3)
      solver%estimate_error = settings(4) > 0.0_c_double
      solver%collapses_only = settings(5) > 0.0_c_double
   end function as_solver

   !> Check that there is room for what is worked on
   subroutine check_room(error, walls, records, samples, histories, reals)
      !> There is not
      type(error_type), allocatable, intent(out) :: error
      !> Numbers of walls, of records, of their samples, of histories, and of other reals
      integer(c_int), intent(in), optional :: walls, records, samples
      real(c_double), intent(in), optional :: histories, reals

      real(c_double) :: bytes

      bytes = 0.0_c_double
      if (present(walls)) bytes = bytes + bytes_of_wall*real(walls, c_double)
      if (present(records)) bytes = bytes + bytes_of_record*real(records, c_double)
      if (present(samples)) bytes = bytes + bytes_of_sample*real(samples, c_double)
      if (present(histories)) bytes = bytes + bytes_of_history*histories
      if (present(reals)) bytes = bytes + real(storage_size(reals)/8, c_double)*reals
      call check_memory(bytes, error)
   end subroutine check_room

   !> Check that there is room to send what was read
   subroutine check_parcel(error, walls, records)
      !> There is not
      type(error_type), allocatable, intent(out) :: error
      !> Number of walls
      integer, intent(in) :: walls
      !> Records
      type(record_type), intent(in) :: records(:)

      real(c_double) :: samples
      integer :: i

      samples = sum([(real(size(records(i)%acceleration), c_double), i=1, size(records))])
      call check_memory(bytes_of_wall*real(walls, c_double) + bytes_of_record*real(size(records), c_double) &
         & + bytes_of_sample*samples, error)
   end subroutine check_parcel

   !> Check that there was room for a time history, and that there is some to send it
   subroutine check_trace(trace, error)
      !> The time history
      type(trace_type), intent(in) :: trace
      !> There was not, or is not
      type(error_type), allocatable, intent(out) :: error

      ! Six columns, twice
      real(c_double), parameter :: bytes_of_row = 96.0_c_double

      if (trace%lacks_memory) then
         call raise_shortage(2.0_c_double*bytes_of_row*real(trace%rows, c_double), error)
      else
         call check_memory(bytes_of_row*real(trace%rows, c_double), error)
      end if
   end subroutine check_trace

   !> Check that Ctrl-C did not break off what was computed
   subroutine check_interrupt(error)
      !> It did
      type(error_type), allocatable, intent(out) :: error

      integer(c_int) :: interrupted

      call look_for_interrupt(interrupted)
      if (interrupted == 1) call raise_failure(error, 'interrupted')
   end subroutine check_interrupt

   !> Check the oscillators of a response spectrum
   subroutine check_spectrum(periods, damping, error)
      !> Periods [s]
      real(c_double), intent(in) :: periods(:)
      !> Damping ratio
      real(c_double), intent(in) :: damping
      !> The first that cannot be
      type(error_type), allocatable, intent(out) :: error

      integer :: i

      if (.not. (damping >= 0.0_c_double .and. damping < 1.0_c_double)) then
         call raise_input(error, 'damping = '//to_text(damping)//': must be at least 0 and below 1')
         return
      end if
      do i = 1, size(periods)
         if (periods(i) >= smallest_period .and. periods(i) <= largest_period) cycle
         call raise_input(error, 'periods = '//to_text(periods(i))//': must lie between '//to_text(smallest_period)// &
            & ' and '//to_text(largest_period)//' s')
         return
      end do
   end subroutine check_spectrum

   !> Check that a mechanism can have rotations
   subroutine check_rotations(mechanism, rotation, error)
      !> The mechanism
      class(mechanism_type), intent(in) :: mechanism
      !> Rotations [rad]
      real(c_double), intent(in) :: rotation(:)
      !> The first that is negative or beyond the geometric end
      type(error_type), allocatable, intent(out) :: error

      real(c_double) :: last
      integer :: i

      last = mechanism%geometric_end()
      do i = 1, size(rotation)
         if (rotation(i) >= 0.0_c_double .and. rotation(i) < last) cycle
         call raise_input(error, 'rotation = '//to_text(rotation(i))//': must be at least 0 and less than '// &
            & to_text(last)//', where the geometry of this wall ends')
         return
      end do
   end subroutine check_rotations

   !> Make walls
   subroutine set_walls(walls, texts, numbers, given, gravity, error)
      !> The walls
      type(wall_type), intent(out) :: walls(:)
      !> A line for each text of a wall, in the order of the table of properties; empty: not given
      character(len=*), intent(in) :: texts
      !> All numbers that were given, wall after wall, in the order of the table; what stands behind them is not looked at
      real(c_double), intent(in) :: numbers(:)
      !> How many values each number has: of a list any number, else 1 or 0 (numbers, walls)
      integer(c_int), intent(in) :: given(:, :)
      !> Gravity [m/s2]
      real(c_double), intent(in) :: gravity(:)
      !> The first thing that is wrong
      type(error_type), allocatable, intent(out) :: error

      type(wall_input_type) :: input
      character(len=:), allocatable :: text
      integer :: i, k, at, number, next

      if (size(given, 1) /= wall_numbers) then
         call raise_input(error, 'walls: '//to_text(size(given, 1))//' numbers each: must be '//to_text(wall_numbers))
         return
      end if
      if (any(given < 0) .or. sum(given) > size(numbers)) then
         call raise_input(error, 'walls: '//to_text(size(numbers))//' numbers: must be '//to_text(int(sum(given))))
         return
      end if
      at = 1
      next = 1
      do i = 1, size(walls)
         input = wall_input_type()
         number = 0
         do k = 1, size(wall_properties)
            associate (property => wall_properties(k))
               if (property%kind == is_text .or. property%kind == is_words) then
                  call next_line(texts, at, text)
                  if (len(text) > 0) call input%set(property%name, text)
                  cycle
               end if
               number = number + 1
               if (given(number, i) < 1) cycle
               if (property%kind == is_list) then
                  call input%set(property%name, numbers(next:next + given(number, i) - 1))
               else
                  call input%set(property%name, numbers(next))
               end if
               next = next + given(number, i)
            end associate
         end do
         call new_wall(walls(i), input, error, gravity(i))
         if (.not. allocated(error)) cycle
         if (size(walls) > 1) call add_place(error, 'wall '''//walls(i)%name()//'''')
         return
      end do
   end subroutine set_walls

   !> Walls as they were understood: names, numbers and static quantities
   subroutine pack_walls(walls, parcel)
      !> The walls
      type(wall_type), intent(in) :: walls(:)
      !> Integers: how many values each of a wall's numbers has, two_sided; reals: gravity, R, alpha, p, trigger, q_c, e of
      !> each wall, then all values of all walls; text: their texts, one a line
      type(parcel_type), intent(inout) :: parcel

      integer, parameter :: wall_integers = wall_numbers + 1, wall_reals = 7
      type(lines_type) :: lines
      integer(c_int), allocatable :: integers(:, :)
      real(c_double), allocatable :: reals(:, :), values(:)
      integer, allocatable :: lengths(:)
      integer :: i, k, number, next

      if (.not. allocated(parcel%integers)) allocate (parcel%integers(0))
      if (.not. allocated(parcel%reals)) allocate (parcel%reals(0))
      if (.not. allocated(parcel%text)) parcel%text = ''
      allocate (integers(wall_integers, size(walls)), reals(wall_reals, size(walls)))
      allocate (values(64*size(walls)))
      next = 1
      do i = 1, size(walls)
         associate (input => walls(i)%input, mechanism => walls(i)%mechanism)
            number = 0
            lengths = input%lengths()
            if (next + sum(lengths) > size(values)) values = [values, spread(0.0_c_double, 1, sum(lengths) + size(values))]
            do k = 1, size(wall_properties)
               associate (property => wall_properties(k))
                  if (property%kind == is_text .or. property%kind == is_words) then
                     call lines%add(input%word(property%name))
                     cycle
                  end if
                  number = number + 1
                  integers(number, i) = lengths(k)
                  if (lengths(k) == 0) cycle
                  if (property%kind == is_list) values(next:next + lengths(k) - 1) = input%list(property%name)
                  if (property%kind /= is_list) values(next) = input%number(property%name)
                  next = next + lengths(k)
               end associate
            end do
            integers(wall_integers, i) = merge(1, 0, mechanism%two_sided)
            reals(:, i) = [walls(i)%gravity, walls(i)%radius, walls(i)%alpha, &
               & mechanism%frequency_parameter(), mechanism%trigger_acceleration(), mechanism%capacity, &
               & mechanism%restitution]
         end associate
      end do
      parcel%integers = [parcel%integers, integers]
      parcel%reals = [parcel%reals, reals, values(:next - 1)]
      parcel%text = parcel%text//pack_lines(lines)
   end subroutine pack_walls

   !> Rows of a population: walls as they were understood, then reals: their weights and the probabilities of their
   !> mechanisms; text: their groups
   subroutine pack_members(members, parcel)
      !> The rows
      type(member_type), intent(in) :: members(:)
      !> What was in it stays before them
      type(parcel_type), intent(inout) :: parcel

      type(wall_type), allocatable :: walls(:)
      type(lines_type) :: groups
      integer :: i

      allocate (walls(size(members)))
      do i = 1, size(members)
         walls(i) = members(i)%wall
         call groups%add(members(i)%group)
      end do
      call pack_walls(walls, parcel)
      parcel%reals = [parcel%reals, members%weight, members%p_occ]
      parcel%text = parcel%text//pack_lines(groups)
   end subroutine pack_members

   !> Make records of what Python has checked when it made its own
   subroutine set_records(records, names, lengths, dt, acceleration)
      !> The records
      type(record_type), allocatable, intent(out) :: records(:)
      !> Their names, one a line
      character(len=*), intent(in) :: names
      !> Numbers of samples
      integer(c_int), intent(in) :: lengths(:)
      !> Time steps [s]
      real(c_double), intent(in) :: dt(:)
      !> All samples, one record after the other [m/s2]
      real(c_double), intent(in) :: acceleration(:)

      integer :: i, from, at

      allocate (records(size(lengths)))
      from = 0
      at = 1
      do i = 1, size(records)
         call next_line(names, at, records(i)%name)
         records(i)%dt = dt(i)
         records(i)%acceleration = acceleration(from + 1:from + lengths(i))
         from = from + lengths(i)
      end do
   end subroutine set_records

   !> Records in a parcel, after what is in it
   subroutine pack_records(records, parcel)
      !> The records
      type(record_type), intent(in) :: records(:)
      !> Integers: lengths, numbers of metadata; reals: time steps, all samples; text: names, then keys and values
      type(parcel_type), intent(inout) :: parcel

      type(lines_type) :: lines
      real(c_double), allocatable :: reals(:)
      integer :: i, k, from, samples

      if (.not. allocated(parcel%integers)) allocate (parcel%integers(0))
      if (.not. allocated(parcel%reals)) allocate (parcel%reals(0))
      if (.not. allocated(parcel%text)) parcel%text = ''
      samples = 0
      do i = 1, size(records)
         samples = samples + size(records(i)%acceleration)
         call lines%add(records(i)%name)
      end do
      parcel%integers = [parcel%integers, (size(records(i)%acceleration), i=1, size(records)), &
         & (records(i)%metadata%count(), i=1, size(records))]
      do i = 1, size(records)
         do k = 1, records(i)%metadata%count()
            associate (entry => records(i)%metadata%entries(k))
               call lines%add(entry%key)
               call lines%add(entry%value)
            end associate
         end do
      end do
      parcel%text = parcel%text//pack_lines(lines)
      from = size(parcel%reals)
      allocate (reals(from + size(records) + samples))
      reals(:from) = parcel%reals
      do i = 1, size(records)
         reals(from + i) = records(i)%dt
      end do
      from = from + size(records)
      do i = 1, size(records)
         reals(from + 1:from + size(records(i)%acceleration)) = records(i)%acceleration
         from = from + size(records(i)%acceleration)
      end do
      call move_alloc(reals, parcel%reals)
   end subroutine pack_records

   !> A response as flat numbers
   elemental subroutine pack_response(response, edp, collapsed, impacts, time_of_peak, edp_error)
      !> The response
      type(response_type), intent(in) :: response
      !> Largest rotation / capacity
      real(c_double), intent(out) :: edp
      !> 1: collapsed
      integer(c_int), intent(out) :: collapsed
      !> Impacts
      integer(c_int), intent(out) :: impacts
      !> Time of the peak [s]
      real(c_double), intent(out) :: time_of_peak
      !> Estimated error of the EDP, 0 where it was not asked for
      real(c_double), intent(out) :: edp_error

      edp = response%edp
      collapsed = merge(1, 0, response%collapsed)
      impacts = response%impacts
      time_of_peak = response%time_of_peak
      edp_error = response%edp_error
   end subroutine pack_response

   !> A curve as flat numbers: theta, beta, var ln theta, covariance, var beta, log likelihood, bracket
   pure function pack_curve(curve) result(numbers)
      !> The curve
      type(fragility_type), intent(in) :: curve
      !> Its numbers
      real(c_double) :: numbers(8)

      numbers = [curve%theta, curve%beta, curve%covariance(1, 1), curve%covariance(1, 2), curve%covariance(2, 2), &
         & curve%log_likelihood, curve%bracket]
   end function pack_curve

   !> Place of a status among the names
   pure function status_code(curve) result(code)
      !> The curve
      type(fragility_type), intent(in) :: curve
      !> From 1
      integer(c_int) :: code

      code = findloc(status_names, curve%status, dim=1)
   end function status_code

end module dondolo_boundary
