!> Peaks of a wall between two moving supports: two_supports FOLDER.
!>
!> FOLDER contains case.nml, ground.bin (of each record the accelerations at all samples, m/s2) and scales.bin (record,
!> counted from 1, and factor of each history), all of doubles. Writes results.bin into it: the wall's limit, the largest drift
!> of each record's supports as a part of it, then for each history peak, start, turn and whether it was given up. Kind
!> 'motion' writes the four channels at the samples of each record instead. The records of given supports are the
!> accelerations of base and top themselves.
program two_supports
   use facade, only : facade_type, new_facade, tie_type
   use rocking_wall, only : wall_type
   use stepper, only : follow, outcome_type
   use strip, only : new_strip, strip_type
   use support_motion, only : delta, given_motion, house_type, motion_type, new_motion, rk
   implicit none

   character(len=:), allocatable :: folder
   !> None to write the motions alone
   class(wall_type), allocatable :: wall
   type(motion_type), allocatable :: motions(:)
   real(rk) :: tolerance
   integer :: length

   call get_command_argument(1, length=length)
   allocate (character(len=length) :: folder)
   call get_command_argument(1, folder)
   call read_case()
   if (allocated(wall)) then
      call run()
   else
      call write_motions()
   end if

contains

   !> Wall and motions
   subroutine read_case()
      character(len=16) :: kind
      real(rk) :: height, thickness, span, hinge, ratio, factor, load, lifted, eccentricity, depth, density
      real(rk) :: tie_height, tie_stiffness, tie_preload, tie_strength, tie_longest
      real(rk) :: period, base, top, damping, diaphragm, diaphragm_damping, share, h, after
      integer :: records, samples, unit, k
      logical :: given
      real(rk), allocatable :: ground(:, :)
      namelist /case/ kind, height, thickness, span, hinge, ratio, factor, load, lifted, eccentricity, depth, density, &
         & tie_height, tie_stiffness, tie_preload, tie_strength, tie_longest, period, base, top, damping, diaphragm, &
         & diaphragm_damping, share, h, after, records, samples, given, tolerance

      kind = ''
      hinge = 0.0_rk
      ratio = 0.0_rk
      factor = 1.0_rk
      load = 0.0_rk
      lifted = 0.0_rk
      eccentricity = 0.0_rk
      depth = 0.0_rk
      tie_height = 0.0_rk
      tie_stiffness = 0.0_rk
      tie_preload = 0.0_rk
      tie_strength = 0.0_rk
      tie_longest = 0.0_rk
      given = .false.
      open (newunit=unit, file=folder//'/case.nml', action='read', status='old')
      read (unit, nml=case)
      close (unit)
      select case (kind)
      case ('strip')
         allocate (wall, source=new_strip(height, thickness, hinge, ratio, factor, load, lifted, eccentricity, depth, density))
      case ('facade')
         allocate (wall, source=new_facade(height, thickness, span, density, &
            & tie_type(tie_height, tie_stiffness, tie_preload, tie_strength, tie_longest)))
      case ('motion')
      case default
         error stop 'kind: strip, facade or motion'
      end select
      allocate (ground(samples, records))
      open (newunit=unit, file=folder//'/ground.bin', access='stream', form='unformatted', action='read', status='old')
      read (unit) ground
      close (unit)
      if (given) then
         motions = [given_motion(ground(:, 1), ground(:, 2), h)]
         return
      end if
      allocate (motions(records))
      do k = 1, records
         motions(k) = new_motion(house_type(period, base, top, damping, diaphragm, diaphragm_damping, share), &
            & ground(:max(2, findloc(ground(:, k) /= 0.0_rk, .true., 1, back=.true.)), k), h, after)
      end do
   end subroutine read_case

   !> All histories
   subroutine run()
      real(rk) :: history(2), x(4), drift
      type(outcome_type) :: outcome
      integer :: scales, results, status, i, k

      open (newunit=scales, file=folder//'/scales.bin', access='stream', form='unformatted', action='read', status='old')
      open (newunit=results, file=folder//'/results.bin', access='stream', form='unformatted', action='write', status='replace')
      write (results) wall%limit
      do k = 1, size(motions)
         drift = 0.0_rk
         do i = 1, motions(k)%intervals
            x = motions(k)%at(i, 0.0_rk)
            drift = max(drift, abs(x(delta)))
         end do
         write (results) drift/(wall%span*wall%limit)
      end do
      do
         read (scales, iostat=status) history
         if (status /= 0) exit
         call follow(wall, motions(nint(history(1))), history(2), tolerance, outcome)
         write (results) outcome%peak, outcome%start, outcome%turn, merge(1.0_rk, 0.0_rk, outcome%given_up)
      end do
      close (results)
      close (scales)
   end subroutine run

   !> Channels of the supports
   subroutine write_motions()
      integer :: results, i, k

      open (newunit=results, file=folder//'/results.bin', access='stream', form='unformatted', action='write', status='replace')
      do k = 1, size(motions)
         do i = 1, motions(k)%intervals
            write (results) motions(k)%at(i, 0.0_rk)
         end do
      end do
      close (results)
   end subroutine write_motions

end program two_supports
