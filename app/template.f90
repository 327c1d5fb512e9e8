!> What --template prints: a commented case with every variable, its unit and its default, that runs as it is.
module dondolo_template
   use, intrinsic :: iso_fortran_env, only : output_unit
   use dondolo_solver, only : engine_names, solver_type
   use dondolo_text, only : join, to_text
   implicit none
   private

   public :: print_template

   !> The wall
   character(len=*), parameter :: wall_lines(*) = [character(len=118) :: &
      & '&wall', &
      & '   name = ''wall''               ! name in the results', &
      & '   mechanism = ''one_sided''     ! required: ''one_sided'', ''free_standing'' or ''two_block''', &
      & '   height = 3.0                ! required, m', &
      & '   thickness = 0.25            ! required, m', &
      & '   density = 1800.0            ! kg/m3', &
      & '   restitution = ''default''     ! model: ''default'', ''sorrentino'', ''impulse'' or ''constant''', &
      & '   ! restitution_value = 0.9   ! only with ''constant'': speed after / before an impact, 0 to 1', &
      & '   restitution_factor = 1.0    ! factor on the model''s speed ratio', &
      & '   ! hinge = 0.5               ! only two_block: height of the intermediate hinge / height of the wall', &
      & '   ! overburden = 0.0          ! only two_block: vertical load on the top, N per metre of wall', &
      & '   ! bearing = ''centre''        ! only two_block: where that load bears: ''inner'', ''outer'' or ''centre''', &
      & '   ! bearing_distance = 0.06   ! its resultant from the inner or outer face, m: half the length that joists bear', &
      & '   ! eccentricity = 0.0        ! or instead of both: from the centreline towards the active top hinge, m: the', &
      & '                               ! outer face where the wall folds outwards, negative for an inner bearing', &
      & '/']

   !> The population
   character(len=*), parameter :: population_lines(*) = [character(len=118) :: &
      & '&population', &
      & '   file = ''data/walls/population.csv''   ! required: one row a wall, from the folder', &
      & '                                        ! of this file; put yours. Columns: name, mechanism,', &
      & '                                        ! height, thickness, density, hinge, restitution,', &
      & '                                        ! restitution_value, restitution_factor, overburden,', &
      & '                                        ! bearing, bearing_distance or eccentricity (m, kg/m3,', &
      & '                                        ! N/m), weight (default 1), group, p_occ (that the', &
      & '                                        ! mechanism can occur, 0 to 1).', &
      & '                                        ! Rows with one name are mechanisms of one wall', &
      & '/']

   !> The records
   character(len=*), parameter :: records_lines(*) = [character(len=118) :: &
      & '&records', &
      & '   catalogue = ''data/records/synthetic44.csv''   ! required: one row a record, from the folder', &
      & '                                                ! of this file; put yours. Columns: file, dt_s,', &
      & '                                                ! units, channel, format, and any others', &
      & '   polarity = ''as_recorded''                     ! ''as_recorded'', ''reversed'' or ''both'' (not history)', &
      & '/']

   !> The stripes
   character(len=*), parameter :: stripes_lines(*) = [character(len=118) :: &
      & '&stripes', &
      & '   im = ''pga''                                    ! intensity measure; also ''sa(0.5)'', ''saavg(0.2:2)''', &
      & '                                                 ! (periods in s; levels in g), ''pgv'', ''arias'', ''cav''', &
      & '                                                 ! (m/s), ''pgd'', ''hi'' (m), ''pga/a0'', ''p*pgv/a0'' (1)', &
      & '   levels = 0.1, 0.2, 0.3, 0.4, 0.5, 0.6, 0.8    ! required: increasing, in the unit of im', &
      & '   ! first = 0.1, last = 0.8, count = 8          ! or instead: equally spaced, both ends included', &
      & '   ! edp_thresholds = 0.1, 0.4                   ! damage states before collapse, rotation / capacity', &
      & '/']

   !> The time history
   character(len=*), parameter :: history_lines(*) = [character(len=118) :: &
      & '&history', &
      & '   record = 1         ! number in the catalogue from 1, or a record''s name in quotes', &
      & '   scale = 1.0        ! factor on the record', &
      & '   ! im_level = 0.4   ! or instead of scale: level to scale the record to, in the unit of &stripes im', &
      & '/']

contains

   !> Print a template
   subroutine print_template(task)
      !> Task
      character(len=*), intent(in) :: task

      call print_line('! A case of dondolo. What is not marked as required may be left out; its default stands here.')
      call print_line('! Lists of texts are what is allowed. An exclamation mark begins a comment.')
      call print_line('&job')
      call print_line('   task = '''//task//''''//repeat(' ', 21 - len(task))// &
         & '! ''stripes'', ''history'' or ''typology''; default ''stripes''')
      call print_line('   title = ''''                    ! any text')
      call print_line('   output = ''out/'//task//''''//repeat(' ', 15 - len(task))// &
         & '! what the names of the result files begin with, relative to the current')
      call print_line('                                 ! folder; default ''dondolo''')
      if (task == 'typology') &
         & call print_line('   histories = .false.           ! write the table of all histories too?')
      call print_line('   threads = 0                   ! 0: all, or OMP_NUM_THREADS')
      call print_line('/')
      if (task == 'typology') then
         call print_lines(population_lines)
      else
         call print_lines(wall_lines)
      end if
      call print_lines(records_lines)
      call print_lines(stripes_lines)
      call print_solver()
      if (task == 'history') call print_lines(history_lines)
   end subroutine print_template

   !> Print the group &solver, its defaults taken from where they are set
   subroutine print_solver()

      type(solver_type) :: solver

      call print_line('&solver')
      call print_line('   engine = ''auto''      ! '//join(engine_names))
      call print_line('   rtol = '//to_text(solver%rtol)//'          ! relative error of a step')
      call print_line('   atol = '//to_text(solver%atol)//'         ! absolute error of a step, 1 = the capacity')
      call print_line('   edp_limit = 1.0      ! rotation / capacity rotation that counts as collapse')
      call print_line('   estimate_error = .false. ! .true.: how far is each EDP off? Takes two to three times as long')
      call print_line('   gravity = 9.81       ! m/s2')
      call print_line('/')
   end subroutine print_solver

   !> Print lines
   subroutine print_lines(lines)
      !> Lines
      character(len=*), intent(in) :: lines(:)

      integer :: i

      do i = 1, size(lines)
         call print_line(trim(lines(i)))
      end do
   end subroutine print_lines

   !> Print a line
   subroutine print_line(line)
      !> Line
      character(len=*), intent(in) :: line

      write (output_unit, '(a)') line
   end subroutine print_line

end module dondolo_template
