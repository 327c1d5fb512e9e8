!> The run as data: what ran with which settings on which inputs, what was computed and what to beware of, in one JSON
!> file beside the tables. docs/files.md describes its keys.
module dondolo_case_run_file
   use, intrinsic :: iso_fortran_env, only : compiler_version, int64
   use dondolo_base_json, only : json_type
   use dondolo_base_kinds, only : wp
   use dondolo_base_lines, only : lines_type
   use dondolo_base_warning, only : warnings_type
   use dondolo_building, only : building_type
   use dondolo_case, only : case_type, list_wall_tables
   use dondolo_case_cited, only : list_used
   use dondolo_case_echo, only : echo_type
   use dondolo_case_job_group, only : history_task, typology_task
   use dondolo_case_result_files, only : written_type
   use dondolo_case_results, only : results_type
   use dondolo_case_tie_rows, only : put_tie
   use dondolo_check_input, only : check_input_type
   use dondolo_check_notes, only : make_check_notes
   use dondolo_check_sheet, only : sheet_type
   use dondolo_files_checksum, only : crc32_length, crc32_of_file, crc32_of_reals
   use dondolo_files_paths, only : beside
   use dondolo_files_references, only : list_keys
   use dondolo_files_version, only : build_commit, dondolo_version_text
   use dondolo_fragility_clustered, only : confidence, correction, fewest_clusters
   use dondolo_motion_certified, only : status_names
   use dondolo_motion_work, only : work_names
   use dondolo_record_metadata, only : metadata_type
   implicit none
   private

   public :: make_run, shape_of, shape_names

   !> What a shape counts
   character(len=*), parameter :: shape_names(*) = [character(len=7) :: 'walls', 'levels', 'states', 'records']

   !> Metadata of a record besides its event: which earthquake a report is of, and where it was felt
   character(len=*), parameter :: shown_metadata(*) = [character(len=9) :: 'date', 'magnitude', 'station', 'component', &
      & 'format']

   !> Name and version of the format, the first member of the file
   character(len=*), parameter :: format = 'dondolo run 2'

contains

   !> Make the text of the file of a run
   subroutine make_run(case, results, run, written, text)
      type(case_type), intent(in) :: case
      type(results_type), intent(in) :: results
      !> Name of the run; empty for results in memory
      character(len=*), intent(in) :: run
      !> The tables of its set
      type(written_type), intent(in) :: written(:)
      !> Text
      character(len=:), allocatable, intent(out) :: text

      type(json_type) :: json
      type(echo_type) :: echo
      character(len=:), allocatable :: engines

      call json%open_object()
      call json%put('format', format)
      call json%put('run', run)
      call json%put('version', dondolo_version_text)
      call json%put('commit', trim(build_commit()))
      call json%put('compiler', compiler_version())
      call json%put('real_bits', storage_size(1.0_wp))
      call results%name_engines(engines)
      call json%put('engine', engines)
      call case%echo(echo)
      call echo%to_json(json)
      call put_references(case, json)
      call put_inputs(case, json)
      call put_shape(case, json)
      if (allocated(case%wall%building)) call put_floor(case%wall%building, case%suite%records%dt, json)
      if (allocated(case%check)) then
         if (allocated(case%check%place)) call put_hazard(case%check, json)
      end if
      call put_files(written, json)
      if (case%job%task == history_task) then
         call put_history(case, results, json)
      else
         call put_records(case, json)
         call put_counts(case, results, json)
      end if
      call put_notes(case, json)
      if (allocated(results%check%rows)) call put_check_notes(results%check, json)
      call results%warnings%put_array(json)
      call json%close_object()
      call json%get(text)
   end subroutine make_run

   !> Put the notes on a check
   subroutine put_check_notes(sheet, json)
      type(sheet_type), intent(in) :: sheet
      type(json_type), intent(inout) :: json

      type(warnings_type) :: notes

      call make_check_notes(sheet, notes)
      call notes%put_array(json, 'check_notes')
   end subroutine put_check_notes

   !> Put the keys of the sources of what the case uses; `--cite` prints their entries
   subroutine put_references(case, json)
      type(case_type), intent(in) :: case
      type(json_type), intent(inout) :: json

      type(lines_type) :: used, keys
      integer :: i

      call list_used(case, used)
      call list_keys(used, keys)
      call json%open_array('references')
      do i = 1, keys%count
         call json%put('', keys%line(i)%text)
      end do
      call json%close_array()
   end subroutine put_references

   !> Put the files that the case is made of, with their lengths and checksums
   subroutine put_inputs(case, json)
      type(case_type), intent(in) :: case
      type(json_type), intent(inout) :: json

      type(lines_type) :: tables
      integer :: i

      call json%open_array('inputs')
      call put_file('case', case%file)
      call put_file('catalogue', beside(case%records_input%catalogue, case%file))
      do i = 1, size(case%suite%records)
         if (allocated(case%suite%records(i)%file)) call put_file('record', case%suite%records(i)%file)
         if (allocated(case%suite%records(i)%vertical_file)) call put_file('vertical', &
            & case%suite%records(i)%vertical_file)
      end do
      ! Bytes and checksum when it was read, even if it has changed since
      if (allocated(case%population_file)) call put_input('population', case%population_path(), .true., case%table%csv%bytes, &
         & case%table%csv%checksum)
      call list_wall_tables(case, tables)
      do i = 1, tables%count
         call put_file('table', tables%line(i)%text)
      end do
      call json%close_array()

   contains

      !> Put a file as it is now
      subroutine put_file(role, path)
         character(len=*), intent(in) :: role, path

         character(len=crc32_length) :: checksum
         integer(int64) :: bytes
         logical :: ok

         call crc32_of_file(path, checksum, bytes, ok)
         call put_input(role, path, ok, bytes, checksum)
      end subroutine put_file

      !> Put one file
      subroutine put_input(role, path, ok, bytes, checksum)
         character(len=*), intent(in) :: role, path
         !> Are its length and its checksum known?
         logical, intent(in) :: ok
         !> Its length
         integer(int64), intent(in) :: bytes
         !> Its checksum
         character(len=*), intent(in) :: checksum

         call json%open_object()
         call json%put('role', role)
         call json%put('path', path)
         if (ok) then
            call json%put('bytes', bytes)
            call json%put('crc32', checksum)
         else
            ! Removed during the run: that must not cost the results
            call json%put_raw('bytes', 'null')
            call json%put_raw('crc32', 'null')
         end if
         call json%close_object()
      end subroutine put_input

   end subroutine put_inputs

   !> Put the records with the clusters that they belong to, and how standard errors follow from them
   subroutine put_records(case, json)
      type(case_type), intent(in) :: case
      type(json_type), intent(inout) :: json

      integer :: i, k

      call json%open_array('records')
      do i = 1, size(case%suite%records)
         associate (record => case%suite%records(i))
            call json%open_object()
            call json%put('name', record%name)
            call json%put('event', case%suite%labels%line(i)%text)
            do k = 1, size(shown_metadata)
               call put_metadata(record%metadata, trim(shown_metadata(k)), json)
            end do
            if (allocated(record%vertical)) then
               call json%put('checksum', crc32_of_reals([record%acceleration, record%dt, record%vertical]))
            else
               call json%put('checksum', crc32_of_reals([record%acceleration, record%dt]))
            end if
            call json%close_object()
         end associate
      end do
      call json%close_array()
      call json%open_object('standard_errors')
      call json%put('correction', correction)
      call json%put('confidence', confidence)
      call json%put('clusters', maxval(case%suite%clusters))
      call json%put('degrees_of_freedom', max(maxval(case%suite%clusters) - 1, 0))
      call json%put('fewest_clusters', fewest_clusters)
      call json%close_object()
   end subroutine put_records

   !> Put what the header of a record says under a key, if it says anything
   subroutine put_metadata(metadata, key, json)
      type(metadata_type), intent(in) :: metadata
      !> Key of the metadata, and name in the file
      character(len=*), intent(in) :: key
      type(json_type), intent(inout) :: json

      character(len=:), allocatable :: value

      value = metadata%get(key)
      if (len(value) > 0) call json%put(key, value)
   end subroutine put_metadata

   !> Numbers of walls (rows of the population), levels, damage states and records of a run
   pure function shape_of(case) result(shape)
      type(case_type), intent(in) :: case
      integer :: shape(size(shape_names))

      if (case%job%task == history_task) then
         shape = [1, 0, 0, 1]
      else
         shape = [1, size(case%stripes%levels), size(case%stripes%thresholds), size(case%suite%records)]
         if (case%job%task == typology_task) shape(1) = case%survey%rows
      end if
   end function shape_of

   !> Put the shape of the results
   subroutine put_shape(case, json)
      type(case_type), intent(in) :: case
      type(json_type), intent(inout) :: json

      integer :: shape(size(shape_names)), i

      shape = shape_of(case)
      call json%open_object('shape')
      do i = 1, size(shape)
         call json%put(trim(shape_names(i)), shape(i))
      end do
      call json%close_object()
   end subroutine put_shape

   !> Put what filters the records on their way to the wall
   subroutine put_floor(building, dt, json)
      type(building_type), intent(in) :: building
      !> Steps of the records [s]
      real(wp), intent(in) :: dt(:)
      type(json_type), intent(inout) :: json

      integer :: i

      call json%open_object('floor')
      call json%put('participation', building%participation)
      call json%put('participation_top', building%participation_top)
      call json%put('support_share', building%share)
      call json%put('support_tilt_1_s2', building%tilt)
      call json%put('free_vibration_s', building%free_vibration())
      call json%open_array('parts')
      do i = 1, size(dt)
         call json%put('', building%parts(dt(i)))
      end do
      call json%close_array()
      call json%close_object()
   end subroutine put_floor

   !> Put what the coordinates of the site of a check give
   subroutine put_hazard(check, json)
      !> With coordinates
      type(check_input_type), intent(in) :: check
      type(json_type), intent(inout) :: json

      integer :: i

      associate (place => check%place)
         call json%open_object('hazard')
         call json%put('latitude_ed50', place%latitude_ed50)
         call json%put('longitude_ed50', place%longitude_ed50)
         call json%open_array('nodes')
         do i = 1, size(place%mesh%ids)
            call json%put('', place%mesh%ids(i))
         end do
         call json%close_array()
         call json%put('distances_km', place%mesh%distances(place%longitude_ed50, place%latitude_ed50))
         call json%put('reference_life_year', check%reference_life)
         call json%put('return_periods_year', [(check%return_period(i), i=1, size(check%exceedance))])
         call json%put('ag_g', check%ag)
         call json%put('f0', check%f0)
         call json%put('tc_star_s', check%tc_star)
         call json%close_object()
      end associate
   end subroutine put_hazard

   !> Put the tables of the set
   subroutine put_files(written, json)
      !> The tables, finished
      type(written_type), intent(in) :: written(:)
      type(json_type), intent(inout) :: json

      integer :: i

      call json%open_array('files')
      do i = 1, size(written)
         call json%open_object()
         call json%put('name', trim(written(i)%suffix))
         call json%put('bytes', written(i)%bytes)
         call json%put('crc32', written(i)%checksum)
         call json%close_object()
      end do
      call json%close_array()
   end subroutine put_files

   !> Put the result of a time history
   subroutine put_history(case, results, json)
      type(case_type), intent(in) :: case
      type(results_type), intent(in) :: results
      type(json_type), intent(inout) :: json

      integer :: i

      associate (response => results%response)
         call json%open_object('history')
         call json%put('record', case%suite%records(case%history%record)%name)
         call json%put('scale', case%history_scale())
         call json%put('initial_rotation_rad', case%history%initial%rotation)
         call json%put('initial_velocity_rad_s', case%history%initial%velocity)
         call json%put('edp', response%edp)
         call json%put('collapsed', response%collapsed)
         call json%put('impacts', response%impacts)
         call json%put('time_of_peak_s', response%time_of_peak)
         if (case%solver%solver%estimate_error) call json%put('edp_error', response%edp_error)
         if (size(results%trace%ties) > 0) then
            call json%open_array('ties')
            do i = 1, size(results%trace%ties)
               call put_tie(results%trace%ties(i), json)
            end do
            call json%close_array()
         end if
         call json%close_object()
      end associate
   end subroutine put_history

   !> Put the unit of the levels and the counts of what was computed
   subroutine put_counts(case, results, json)
      type(case_type), intent(in) :: case
      type(results_type), intent(in) :: results
      type(json_type), intent(inout) :: json

      integer(int64) :: counts(size(work_names))
      integer :: i

      call json%put('unit_of_levels', case%stripes%scaling%unit())
      counts = results%work%counts()
      call json%open_object('work')
      do i = 1, size(counts)
         call json%put(trim(work_names(i)), counts(i))
      end do
      call json%close_object()
      if (.not. allocated(results%row%certified)) return
      call json%open_object('certified')
      do i = 1, size(status_names)
         call json%put(trim(status_names(i)), count(results%row%certified%status == i))
      end do
      associate (bounds => results%row%bounds)
         call json%put('rounded', bounds(size(bounds))%rounded)
         call json%put('changed', bounds(size(bounds))%changed)
         call json%put('theta_lowest', bounds(size(bounds))%theta_lowest)
         call json%put('theta_highest', bounds(size(bounds))%theta_highest)
         call json%open_array('states')
         do i = 1, size(bounds)
            call json%open_object()
            call json%put('edp_threshold', case%stripes%thresholds(i))
            call json%put('theta_lowest', bounds(i)%theta_lowest)
            call json%put('theta_highest', bounds(i)%theta_highest)
            call json%put('fewest', real(bounds(i)%fewest, wp))
            call json%put('most', real(bounds(i)%most, wp))
            call json%put('changed', bounds(i)%changed)
            call json%close_object()
         end do
         call json%close_array()
      end associate
      call json%close_object()
   end subroutine put_counts

   !> Put the notes on how tables were read
   subroutine put_notes(case, json)
      type(case_type), intent(in) :: case
      type(json_type), intent(inout) :: json

      integer :: i

      call json%open_array('notes')
      do i = 1, case%notes%count
         call json%put('', case%notes%line(i)%text)
      end do
      call json%close_array()
   end subroutine put_notes

end module dondolo_case_run_file
