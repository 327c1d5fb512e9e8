!> The main job on recorded accelerograms against the same sources in real128, tolerance 1e-20 (one-sided wall) and
!> 1e-18 (two-block wall). Needs the records: DONDOLO_RECORDS names their folder, ../shared/records if it is not set.
program test_recorded
   use checks, only : check, check_close, check_ok, check_text, finish, skip, suite
   use dondolo_catalogue, only : read_catalogue
   use dondolo_error, only : error_type
   use dondolo_fragility, only : fit_fragility, fragility_type
   use dondolo_kinds, only : wp
   use dondolo_record, only : record_type
   use dondolo_solver, only : solver_type
   use dondolo_stripes, only : multiple_stripe, stripes_type
   use dondolo_text, only : to_text
   use dondolo_wall, only : new_wall, wall_input_type, wall_type
   implicit none

   !> Reference of one history: record, level, EDP, time of the peak [s]
   type :: reference_type
      integer :: record, level
      real(wp) :: edp, time
   end type reference_type

   !> Collapses in each stripe, 0.05 to 1.00 g
   integer, parameter :: one_sided_collapses(20) = &
      & [0, 0, 0, 0, 3, 7, 11, 14, 20, 25, 24, 26, 40, 40, 41, 43, 43, 43, 43, 44]
   integer, parameter :: two_block_collapses(20) = &
      & [0, 0, 0, 0, 0, 0, 1, 2, 6, 9, 16, 16, 17, 19, 20, 25, 27, 32, 32, 31]

   type(reference_type), parameter :: one_sided(8) = [ &
      & reference_type(10, 4, 0.123024665593536_wp, 44.905019966758_wp), &
      & reference_type(13, 5, 0.060598587259406_wp, 3.082959287719_wp), &
      & reference_type(3, 6, 0.429793804905598_wp, 2.652591267943_wp), &
      & reference_type(44, 6, 0.691675118219608_wp, 39.815542931409_wp), &
      & reference_type(1, 8, 0.237541082858425_wp, 4.233866071669_wp), &
      & reference_type(13, 9, 0.374550880408822_wp, 3.303042520809_wp), &
      & reference_type(33, 10, 0.934533039371353_wp, 11.150964847777_wp), &
      & reference_type(26, 12, 0.393388438996315_wp, 12.362140046941_wp)]

   type(reference_type), parameter :: two_block(8) = [ &
      & reference_type(6, 8, 0.042762143065851_wp, 4.461618596561_wp), &
      & reference_type(23, 9, 0.140313107647663_wp, 23.300097144800_wp), &
      & reference_type(30, 10, 0.275612123839488_wp, 26.417668304741_wp), &
      & reference_type(43, 11, 0.453533483855371_wp, 39.843243731460_wp), &
      & reference_type(21, 13, 0.545458250356736_wp, 33.890372851509_wp), &
      & reference_type(39, 14, 0.387461761207433_wp, 26.682976828488_wp), &
      & reference_type(29, 16, 0.777467012138042_wp, 31.665790711007_wp), &
      & reference_type(21, 19, 0.501493619871560_wp, 33.605709895482_wp)]

   type(record_type), allocatable :: records(:)
   type(wall_input_type) :: input
   type(error_type), allocatable :: error
   character(len=4096) :: folder
   integer :: i
   logical :: there

   call suite('recorded accelerograms')
   call get_environment_variable('DONDOLO_RECORDS', folder)
   if (folder == '') folder = '../shared/records'
   inquire (file=trim(folder)//'/italy44.csv', exist=there)
   if (.not. there) then
      call skip('no recorded accelerograms in '//trim(folder))
      call finish()
      stop
   end if
   call read_catalogue(trim(folder)//'/italy44.csv', records, error)
   call check_ok(error, 'catalogue')
   if (allocated(error)) call finish()

   input%height = 3.0_wp
   input%thickness = 0.25_wp
   input%mechanism = 'one_sided'
   call test_wall(one_sided_collapses, one_sided)
   input%mechanism = 'two_block'
   input%hinge = 0.6_wp
   input%restitution_factor = 0.87_wp
   call test_wall(two_block_collapses, two_block)
   call finish()

contains

   !> All stripes of a wall at the default tolerances, and some of them tighter and on one thread
   subroutine test_wall(collapses, references)
      integer, intent(in) :: collapses(:)
      type(reference_type), intent(in) :: references(:)
      type(wall_type) :: wall
      type(stripes_type) :: stripes, tight, alone
      type(solver_type) :: solver
      type(fragility_type) :: curve
      real(wp), parameter :: levels(20) = [(0.05_wp*i, i=1, 20)]
      integer :: j

      call new_wall(wall, input, error)
      call check_ok(error, 'wall')
      call multiple_stripe(stripes, wall, records, levels, 'pga', 'as_recorded', solver, 2, error)
      call check_ok(error, 'stripes')
      call check(all(stripes%collapses() == collapses), input%mechanism//': collapses of every stripe')
      do j = 1, size(references)
         associate (reference => references(j), response => stripes%response(references(j)%record, references(j)%level))
            call check_close(response%edp, reference%edp, 0.0_wp, 'EDP', 1.0e-7_wp)
            call check_close(response%time_of_peak, reference%time, 0.0_wp, 'time of the peak', 1.0e-6_wp)
         end associate
      end do
      call fit_fragility(curve, levels, real(collapses, wp), spread(44.0_wp, 1, 20), error)
      call check_text(curve%status, 'ok', 'status of the fit')

      solver%rtol = 1.0e-10_wp
      solver%atol = 1.0e-12_wp
      call multiple_stripe(tight, wall, records, levels(5:20:5), 'pga', 'as_recorded', solver, 2, error)
      associate (wide => stripes%response(:, 5:20:5), narrow => tight%response)
         call check(all(wide%collapsed .eqv. narrow%collapsed), 'flags at rtol = 1e-10')
         j = count(abs(wide%edp - narrow%edp) > 1.0e-6_wp)
         call check(j <= size(narrow)/100, to_text(j)//' EDPs move by more than 1e-6, at most one in a hundred may')
      end associate
      call multiple_stripe(alone, wall, records, levels(5:20:5), 'pga', 'as_recorded', solver, 1, error)
      call check(all(alone%response%edp == tight%response%edp) .and. &
         & all(alone%response%time_of_peak == tight%response%time_of_peak) .and. &
         & all(alone%response%impacts == tight%response%impacts), 'one thread gives the same to the bit')
   end subroutine test_wall

end program test_recorded
