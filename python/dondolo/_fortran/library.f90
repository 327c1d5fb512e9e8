!> What Python asks of the library itself: version, defaults, tables of properties; Ctrl-C, forks, parcels, handles.
!>
!> f2py reads this and its neighbours listed in meson.build, each a module of the extension. Their arguments are flat: c_double,
!> c_int, c_int64_t and bytes only, since f2py turns any other kind into a C float without a word. Records and walls are
!> uploaded once and stay; other procedures take their handles (dondolo_interface_handles). Results whose size only the library
!> knows are sent as parcels (dondolo_parcel), which come last; where nothing is sent but an error, it is `failure`. Procedures that
!> compute release Python's lock (threadsafe); those that fill or empty a handle hold it.
module library
   use, intrinsic :: iso_c_binding, only : c_double, c_int, c_int64_t, c_ptr
   use, intrinsic :: omp_lib, only : omp_set_max_active_levels
   use dondolo_base_error, only : error_type, not_a_string, raise_input
   use dondolo_base_interrupt, only : begin => listen, finish => end_listening, look_at => stop_at
   use dondolo_base_limits, only : longest_name
   use dondolo_base_lines, only : lines_type
   use dondolo_base_plain, only : name_problem, shown
   use dondolo_base_property, only : describe_property, property_type
   use dondolo_base_text, only : join
   use dondolo_base_threads, only : threads_here => available_threads
   use dondolo_case_property_tables, only : property_table, table_names
   use dondolo_files_probability, only : probability_text
   use dondolo_files_references, only : list_bibtex, list_keys
   use dondolo_files_version, only : build_commit, dondolo_version_text
   use dondolo_fragility, only : error_names, least_ratio, fit_status_names, statuses_with_curve
   use dondolo_fragility_clustered, only : fewest_clusters
   use dondolo_fragility_study, only : same_level
   use dondolo_interface_handles, only : release
   use dondolo_motion_lane_variants, only : build_variant, check_variant
   use dondolo_motion_solver, only : solver_type
   use dondolo_motion_work, only : work_names
   use dondolo_parcel, only : parcel_type, report, send, take, take_next => take_series
   use dondolo_population_distribution, only : least_share
   use dondolo_population_occurrence, only : sum_tolerance
   use dondolo_population_wall_row, only : note_prefixes
   use dondolo_wall_gravity, only : standard_gravity
   implicit none
   private

   public :: cite, cite_keys, constants, properties, check_text, shown_probability, variant, available_threads, listen, &
      & end_listening, stop_at, work_alone, take_parcel, take_series, free

contains

   !> Version, defaults and limits that Python must not repeat
   subroutine constants(sent)
      integer(c_int64_t), intent(out) :: sent(5)
      type(solver_type) :: solver
      type(parcel_type) :: parcel
      type(error_type), allocatable :: error

      call parcel%put('longest_name', longest_name)
      call parcel%put('fewest_clusters', fewest_clusters)
      call parcel%put('rtol', solver%rtol)
      call parcel%put('atol', solver%atol)
      call parcel%put('edp_limit', solver%edp_limit)
      call parcel%put('gravity', standard_gravity)
      call parcel%put('least_share', least_share)
      call parcel%put('same_level', same_level)
      call parcel%put('least_ratio', least_ratio)
      call parcel%put('sum_tolerance', sum_tolerance)
      call parcel%put('version', dondolo_version_text)
      call parcel%put('commit', trim(build_commit()))
      call put_words(parcel, 'statuses', fit_status_names)
      call put_words(parcel, 'fitted', fit_status_names(:statuses_with_curve))
      call put_words(parcel, 'errors', error_names)
      call put_words(parcel, 'notes', note_prefixes)
      call put_words(parcel, 'work', work_names)
      call send(parcel, error, sent)
   end subroutine constants

   !> Put words in under a name
   subroutine put_words(parcel, name, words)
      type(parcel_type), intent(inout) :: parcel
      character(len=*), intent(in) :: name, words(:)
      type(lines_type) :: lines
      integer :: i

      do i = 1, size(words)
         call lines%add(trim(words(i)))
      end do
      call parcel%put(name, lines)
   end subroutine put_words

   !> The table of properties of a group, one of table_names; a line for each, its entries separated by tabs
   !> (describe_property)
   subroutine properties(group, sent)
      character(len=*), intent(in) :: group
      integer(c_int64_t), intent(out) :: sent(5)
      type(property_type), allocatable :: table(:)
      type(parcel_type) :: parcel
      type(error_type), allocatable :: error
      character(len=:), allocatable :: line
      integer :: i

      table = property_table(group)
      do i = 1, size(table)
         call describe_property(table(i), line)
         call parcel%lines%add(line)
      end do
      if (size(table) == 0) call raise_input(error, 'group = '''//group//''': must be one of '//join(table_names))
      call send(parcel, error, sent)
   end subroutine properties

   !> A probability as people read it, filled up with blanks
   subroutine shown_probability(value, text)
      real(c_double), intent(in) :: value
      character(len=24), intent(out) :: text

      text = probability_text(value)
   end subroutine shown_probability

   !> BibTeX of dondolo and of the sources of what was used, said in words that commas separate (dondolo_files_references)
   subroutine cite(words, sent)
      character(len=*), intent(in) :: words
      integer(c_int64_t), intent(out) :: sent(5)
      type(lines_type) :: used
      type(parcel_type) :: parcel
      type(error_type), allocatable :: error

      call split_words(words, used)
      call list_bibtex(used, parcel%lines)
      call send(parcel, error, sent)
   end subroutine cite

   !> Keys of these sources
   subroutine cite_keys(words, sent)
      character(len=*), intent(in) :: words
      integer(c_int64_t), intent(out) :: sent(5)
      type(lines_type) :: used
      type(parcel_type) :: parcel
      type(error_type), allocatable :: error

      call split_words(words, used)
      call list_keys(used, parcel%lines)
      call send(parcel, error, sent)
   end subroutine cite_keys

   !> Words that commas separate
   subroutine split_words(words, used)
      character(len=*), intent(in) :: words
      type(lines_type), intent(out) :: used
      integer :: first, last

      first = 1
      do while (first <= len_trim(words))
         last = index(words(first:)//',', ',') + first - 2
         call used%add(words(first:last))
         first = last + 2
      end do
   end subroutine split_words

   !> Check a name, a title or another word of the user's
   subroutine check_text(what, text, failure)
      ! What it is, and its text, in which C0 80 stands for NUL, at which a text of f2py would end (modified UTF-8)
      character(len=*), intent(in) :: what, text
      integer(c_int64_t), intent(out) :: failure(5)
      type(error_type), allocatable :: error
      character(len=:), allocatable :: meant
      integer :: at

      meant = text
      do
         at = index(meant, achar(192)//achar(128))
         if (at == 0) exit
         meant = meant(:at - 1)//achar(0)//meant(at + 2:)
      end do
      if (len_trim(name_problem(meant)) > 0) call raise_input(error, what//' = '''//shown(meant)//''': '// &
         & trim(name_problem(meant)), not_a_string, what)
      call report(error, failure)
   end subroutine check_text

   !> Build variant that the engine lanes runs; the environment may change it from call to call
   subroutine variant(name, failure)
      character(len=32), intent(out) :: name
      integer(c_int64_t), intent(out) :: failure(5)
      type(error_type), allocatable :: error

      call check_variant(error)
      name = build_variant()
      call report(error, failure)
   end subroutine variant

   !> Threads that OpenMP gives, which honours OMP_NUM_THREADS and the processors of the process
   subroutine available_threads(threads)
      integer(c_int), intent(out) :: threads

      threads = threads_here()
   end subroutine available_threads

   !> Listen to Ctrl-C while something is computed: the main thread alone may
   subroutine listen()
      call begin()
   end subroutine listen

   !> Listen no more
   subroutine end_listening()
      call finish()
   end subroutine end_listening

   !> Let what this thread computes end once an integer(c_int) is not 0, which another thread writes: its address; 0: no more
   subroutine stop_at(address)
      integer(c_int64_t), intent(in) :: address
      type(c_ptr) :: flag

      flag = transfer(address, flag)
      call look_at(flag)
   end subroutine stop_at

   !> Let the thread that calls it work alone from now on: OpenMP's other threads do not survive a fork
   subroutine work_alone()
      call omp_set_max_active_levels(0)
   end subroutine work_alone

   !> Contents of a parcel that another procedure has sent
   subroutine take_parcel(handle, m, n, k, integers, reals, text)
      !f2py threadsafe
      integer(c_int64_t), intent(in) :: handle
      integer(c_int64_t), intent(in) :: m, n, k
      ! Bytes, four in a number
      integer(c_int), intent(out) :: integers(m), text((k + 3)/4)
      real(c_double), intent(out) :: reals(n)

      call take(handle, integers, reals, text)
   end subroutine take_parcel

   !> The next series of a parcel whose other contents have been taken
   subroutine take_series(handle, n, values)
      !f2py threadsafe
      integer(c_int64_t), intent(in) :: handle
      integer(c_int), intent(in) :: n
      real(c_double), intent(out) :: values(n)

      call take_next(handle, values)
   end subroutine take_series

   !> Free what a handle stands for; nothing, if that was done before
   subroutine free(handle)
      integer(c_int64_t), intent(in) :: handle

      call release(handle)
   end subroutine free

end module library
