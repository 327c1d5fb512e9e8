!> Histories that broke something once, and hostile ones that might: each with a line that says what.
module kept_histories
   use checks, only : check_ok
   use dondolo_base_error, only : error_type
   use dondolo_base_kinds, only : wp
   use dondolo_record, only : largest_acceleration, new_record
   use dondolo_wall, only : new_wall, wall_input_type
   use random_history, only : history_type, new_history
   implicit none
   private

   public :: kept_count, kept_history

   !> Number of histories kept
   integer, parameter :: kept_count = 16

contains

   !> A kept history and what is special about it
   subroutine kept_history(number, history, what)
      integer, intent(in) :: number
      type(history_type), intent(out) :: history
      character(len=60), intent(out) :: what
      integer :: i
      real(wp), parameter :: wave(400) = [(sin(0.3_wp*real(i, wp)), i=1, 400)]
      real(wp), parameter :: spike(6) = [0.0_wp, -1.0_wp, 0.0_wp, 1.0_wp, 0.0_wp, 0.0_wp]
      real(wp) :: trigger

      select case (number)
      case (1)
         what = 'a trial step went beyond the geometry and overflowed'
         call wall('two_block', hinge=0.88_wp)
         call record([(0.9_wp*largest_acceleration*sin(real(i, wp)**2), i=1, 600)], 0.05_wp)
      case (2)
         what = 'spikes of the largest acceleration'
         call wall('two_block', hinge=0.95_wp)
         call record(largest_acceleration*spike, 0.05_wp)
      case (3)
         what = 'a limit one bit below the geometric end'
         call wall('two_block', hinge=0.7_wp)
         call record(30.0_wp*wave, 0.01_wp)
         history%solver%edp_limit = (1.0_wp - 2.0_wp*epsilon(1.0_wp))*history%wall%mechanism%geometric_end() &
            & /history%wall%mechanism%capacity
      case (4)
         what = 'every bounce went through the whole record, 24 s'
         call wall('one_sided', restitution=0.9999_wp)
         call record([-0.82_wp, -0.9176_wp, (-0.8_wp, i=1, 70000), 3.0_wp], 0.01_wp)
      case (5)
         what = 'bounces without number'
         call wall('free_standing', restitution=1.0_wp - 1.0e-6_wp)
         call record([-0.82_wp, -0.9176_wp, (0.0_wp, i=1, 1000), 3.0_wp], 0.01_wp)
      case (6)
         what = 'the time of a late peak overflowed, the limit at the peak'
         history = new_history(808)
      case (7)
         what = 'a limit that is next to nothing'
         call wall('free_standing')
         call record(3.0_wp*wave, 0.01_wp)
         history%solver%edp_limit = 1.0e-12_wp
      case (8)
         what = 'a limit that has lost digits to underflow'
         call wall('two_block')
         call record(12.0_wp*wave, 0.01_wp)
         history%solver%edp_limit = 1.0e-310_wp
      case (9)
         what = 'no scale at all'
         call wall('two_block')
         call record(12.0_wp*wave, 0.01_wp)
         history%scale = 0.0_wp
      case (10)
         what = 'a scale that underflows'
         call wall('one_sided')
         call record(3.0_wp*wave, 0.01_wp)
         history%scale = -1.0e-310_wp
      case (11)
         what = 'samples that are all at the trigger'
         call wall('one_sided')
         trigger = history%wall%mechanism%trigger_acceleration()
         call record([(-trigger, i=1, 1000)], 0.005_wp)
      case (12)
         what = 'plastic impacts'
         call wall('two_block', restitution=0.0_wp)
         call record(12.0_wp*wave, 0.01_wp)
      case (13)
         what = 'a restitution that underflows'
         call wall('free_standing', restitution=1.0e-300_wp)
         call record(3.0_wp*wave, 0.01_wp)
      case (14)
         what = 'a tiny time step: rows after the record without number'
         call wall('two_block')
         call record(98.1_wp*wave, 1.0e-9_wp)
      case (15)
         what = 'a time step of a minute'
         call wall('free_standing')
         call record(3.0_wp*wave, 60.0_wp)
         history%solver%edp_limit = 5.0_wp
      case default
         what = 'the tightest tolerances'
         call wall('two_block')
         call record(12.0_wp*wave, 0.05_wp)
         history%solver%rtol = 10.0_wp*epsilon(1.0_wp)
         history%solver%atol = tiny(1.0_wp)
      end select

   contains

      !> A wall of 3 m and 0.25 m
      subroutine wall(mechanism, hinge, restitution)
         character(len=*), intent(in) :: mechanism
         real(wp), intent(in), optional :: hinge, restitution
         type(wall_input_type) :: input
         type(error_type), allocatable :: error

         call input%set('mechanism', mechanism)
         call input%set('height', 3.0_wp)
         call input%set('thickness', 0.25_wp)
         if (mechanism == 'two_block') call input%set('hinge', 0.5_wp)
         if (present(hinge)) call input%set('hinge', hinge)
         if (present(restitution)) then
            call input%set('restitution_value', restitution)
         end if
         call new_wall(history%wall, input, error)
         call check_ok(error, trim(what))
      end subroutine wall

      !> Its record
      subroutine record(acceleration, dt)
         real(wp), intent(in) :: acceleration(:), dt
         type(error_type), allocatable :: error

         call new_record(history%record, acceleration, dt, 'kept', error)
         call check_ok(error, trim(what))
      end subroutine record

   end subroutine kept_history

end module kept_histories
