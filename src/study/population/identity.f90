!> Identity of what a population is run for: everything that its histories depend on. Names of walls, weights, groups,
!> probabilities of occurrence and alternatives are not among it, nor are threads and blocks.
module dondolo_population_identity
   use dondolo_base_fingerprint, only : fingerprint_type
   use dondolo_base_kinds, only : wp
   use dondolo_base_settings, only : group_settings_type, new_settings
   use dondolo_base_text, only : to_text
   use dondolo_files_settings_key, only : add_settings
   use dondolo_files_version, only : dondolo_version_text
   use dondolo_fragility_study, only : study_type
   use dondolo_motion_lane_variants, only : build_variant
   use dondolo_motion_solver, only : put_solver, solver_properties, solver_type
   use dondolo_population_row_result, only : shape_type
   use dondolo_population_store_format, only : identity_type
   use dondolo_population_study_key, only : study_key_type
   use dondolo_record_suite, only : suite_type
   use dondolo_wall, only : wall_type
   implicit none
   private

   public :: add_wall, study_identity

contains

   !> Add a wall to the fingerprint of a population
   subroutine add_wall(fingerprint, wall)
      !> Fingerprint of the walls before
      type(fingerprint_type), intent(inout) :: fingerprint
      !> The wall, with one mechanism
      type(wall_type), intent(in) :: wall

      call add_settings(fingerprint, wall%input)
      call fingerprint%add_reals([wall%gravity])
   end subroutine add_wall

   !> Identity of some rows of a population under a study
   subroutine study_identity(study, walls, rows, first, last, identity)
      !> What the walls are tried with
      type(study_type), intent(in) :: study
      !> Fingerprint of the walls of all rows
      type(fingerprint_type), intent(in) :: walls
      !> Number of all rows
      integer, intent(in) :: rows
      !> First row that is to be run
      integer, intent(in) :: first
      !> Last row that is to be run
      integer, intent(in) :: last
      type(identity_type), intent(out) :: identity

      associate (key => identity%key)
         call key%add('dondolo', dondolo_version_text)
         call key%add('build variant', trim(build_variant()))
         call key%add('number of rows', to_text(rows))
         call key%add('walls', walls%text())
         call key%add('records', records_fingerprint(study%suite))
         if (allocated(study%factor)) call key%add('records of each level', factors_fingerprint(study%factor))
         call key%add('im', study%scaling%name)
         call key%add('levels', list_of(study%levels))
         call key%add('polarity', study%polarity)
         call add_solver(key, study%solver)
         call key%add('edp_thresholds', list_of(study%thresholds))
         call key%add('histories', trim(merge('kept    ', 'not kept', study%keeps_histories)))
      end associate
      identity%shape = shape_type(size(study%levels), size(study%thresholds), study%keeps_histories)
      identity%first = first
      identity%last = last
   end subroutine study_identity

   !> Add the settings of the computation that change results
   subroutine add_solver(key, solver)
      type(study_key_type), intent(inout) :: key
      type(solver_type), intent(in) :: solver

      type(group_settings_type) :: settings
      integer :: i

      call new_settings(settings, solver_properties)
      call put_solver(solver, settings)
      do i = 1, size(solver_properties)
         associate (name => solver_properties(i)%name)
            if (.not. (solver_properties(i)%changes_results .and. settings%has(name))) cycle
            if (settings%has_word(name)) then
               call key%add(trim(name), trim(settings%word(name)))
            else
               call key%add(trim(name), to_text(settings%number(name)))
            end if
         end associate
      end do
   end subroutine add_solver

   !> Fingerprint of accelerograms
   pure function records_fingerprint(suite) result(text)
      type(suite_type), intent(in) :: suite
      !> Fingerprint
      character(len=16) :: text

      type(fingerprint_type) :: fingerprint
      integer :: i

      do i = 1, size(suite%records)
         call fingerprint%add_text(suite%records(i)%name)
         call fingerprint%add_reals([suite%records(i)%dt])
         call fingerprint%add_reals(suite%records(i)%acceleration)
         if (allocated(suite%records(i)%vertical)) call fingerprint%add_reals(suite%records(i)%vertical)
      end do
      text = fingerprint%text()
   end function records_fingerprint

   !> Fingerprint of the records of each level, and of the factors on them
   pure function factors_fingerprint(factor) result(text)
      !> Factors (records, levels), see study_type
      real(wp), intent(in) :: factor(:, :)
      !> Fingerprint
      character(len=16) :: text

      type(fingerprint_type) :: fingerprint

      call fingerprint%add_reals(reshape(factor, [size(factor)]))
      text = fingerprint%text()
   end function factors_fingerprint

   !> Length of numbers as text
   pure integer function list_length(numbers)
      !> Numbers, one at least
      real(wp), intent(in) :: numbers(:)

      integer :: i

      list_length = 2*(size(numbers) - 1)
      do i = 1, size(numbers)
         list_length = list_length + len(to_text(numbers(i)))
      end do
   end function list_length

   !> Numbers as text, with as many digits as distinguish each from all others
   function list_of(numbers) result(text)
      !> Numbers, one at least
      real(wp), intent(in) :: numbers(:)
      !> The same
      character(len=list_length(numbers)) :: text

      integer :: i, at

      text = to_text(numbers(1))
      at = len_trim(text)
      do i = 2, size(numbers)
         text(at + 1:) = ', '//to_text(numbers(i))
         at = at + 2 + len(to_text(numbers(i)))
      end do
   end function list_of

end module dondolo_population_identity
