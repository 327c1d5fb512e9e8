!> Chains of rigid bodies: nine mechanisms of masonry against 16 digits of a program of its own, today's mechanisms as chains, and
!> impacts.
program test_rigid_chains
   use chain_cases, only : arch, arch_contacts, arch_parts, block, cavity, compound, corner, frame, g, gable, horizontal, &
      & mirrored, portal, portal_contacts, portal_parts, rectangle, strip
   use checks, only : check, check_close, check_ok, finish, suite
   use dondolo_base_error, only : error_type
   use dondolo_base_kinds, only : pi, wp
   use dondolo_wall, only : new_wall, wall_input_type, wall_type
   use dondolo_wall_chain, only : chain_action_type, chain_type, guide, motion_type, pin
   use dondolo_wall_chain_check, only : chain_travel, chain_weights
   use dondolo_wall_chain_equations, only : factor_type, nonnegative_least_squares
   use dondolo_wall_chain_impact, only : attached_type, cone_ratio, contact_type, projection, velocity_of
   use dondolo_wall_chain_part, only : chain_mass_type, point_mass, polygon, sector, together
   use dondolo_wall_chain_table, only : chain_table_type, sample_chain
   use dondolo_wall_chain_terms, only : chain_support, chain_terms_type, find_end, set_at_rest, terms_at
   use dondolo_wall_tabulated, only : new_tabulated, tabulated_type
   implicit none

   real(wp), parameter :: digits = 2.0e-13_wp

   call test_parts()
   call test_sheet('W compound', compound(), 0.1305663724762879_wp, 64878.97578721274_wp, 0.9759468224157812_wp, &
      & 1.312424083539567_wp, 0.1298069200437978_wp, 1309716.208509633_wp, [259025.5850273791_wp, 259671.5424657686_wp, &
      & 260213.6347494128_wp, 260651.6450486261_wp], [331774.5042627726_wp, 280880.8204382273_wp, 229874.7880305344_wp, &
      & 178776.8087725856_wp])
   call test_sheet('C corner', corner(), 0.3269288666929932_wp, 7576.204550631349_wp, 0.9778164952251560_wp, &
      & 3.279932582360217_wp, 0.3146202024143832_wp, 46015.67083560998_wp, [16370.97517085276_wp, 16487.78387654486_wp, &
      & 16597.99768852053_wp, 16701.57252272447_wp], [52504.53616439967_wp, 49267.46539339062_wp, 46010.68829311499_wp, &
      & 42735.50753098978_wp])
   call test_sheet('H horizontal', horizontal(), 0.6473037930376486_wp, 3420.0_wp, 1.0_wp, 6.350050209699333_wp, &
      & 0.1930211345591561_wp, 6413.716_wp, [3762.0_wp, 3775.952644699273_wp, 3788.394958686031_wp, 3799.321965200574_wp], &
      & [23888.88888888889_wp, 21418.41068104985_wp, 18946.58210944587_wp, 16473.43079089079_wp], 0.215_wp, &
      & 6161.978199595097_wp, -5573.663137066785_wp)
   call test_sheet('G gable', gable(), 0.1652971534749786_wp, 1578.289769789383_wp, 0.7514536256108421_wp, &
      & 2.157904387341802_wp, 0.2119373752252902_wp, 2587.102213602045_wp, [1854.637839791523_wp, 1862.247591784398_wp, &
      & 1869.112469570196_wp, 1875.229727289333_wp], [3007.415948872763_wp, 2727.292805052663_wp, 2446.078780473962_wp, &
      & 2163.886356997020_wp])
   call test_sheet('V strip', strip(), 0.1987898448399373_wp, 6661.264893153547_wp, 0.9414893906049652_wp, &
      & 2.071322733256407_wp, 0.09013930214699716_wp, 51040.13094653324_wp, [16487.66972477064_wp, 16519.07957458337_wp, &
      & 16543.88201281771_wp, 16562.06711882909_wp], [32153.07261538462_wp, 25010.71168276063_wp, 17874.65281394417_wp, &
      & 10742.94418419214_wp], 0.2238595595909472_wp, 50083.71959599212_wp, -15500.07536703834_wp)
   call test_sheet('A arch', arch(), 0.3700097380218768_wp, 86317.27628237473_wp, 0.8722426155281750_wp, &
      & 4.161451716959090_wp, 0.06906469353926901_wp, 15812526.73133656_wp, [860101.5543134926_wp, 755417.1118294193_wp, &
      & 693411.5667004008_wp, 648970.9142982848_wp], [3121992.777188533_wp, 1641404.435577975_wp, 793999.3555742526_wp, &
      & 212551.7483036636_wp], 0.5607206113261415_wp, 8262161.891236913_wp, -83784768.09540737_wp)
   call test_sheet('P portal', portal(), 0.1616336718994472_wp, 10461.41905953887_wp, 0.9323873351869296_wp, &
      & 1.700609029632178_wp, 0.1300737596987163_wp, 46160.16047093719_wp, [18521.31817740249_wp, 16995.25098761255_wp, &
      & 15791.05632297681_wp, 14791.99591169640_wp], [29367.88960788341_wp, 22115.15265755073_wp, 16419.00726235270_wp, &
      & 11747.04714717191_wp], 0.1826393369902618_wp, 32976.48846442171_wp, -235382.2401027533_wp)
   call test_sheet('D cavity', cavity(), 0.2332173531148685_wp, 1101.6_wp, 1.0_wp, 2.287862234056860_wp, &
      & 0.06053081274337541_wp, 1002.248291376147_wp, [892.296_wp, 893.3908268345879_wp, 894.1283991621464_wp, &
      & 894.5084220765474_wp], [2041.45032_wp, 1366.428185493936_wp, 691.9686332691941_wp, 17.88704135228274_wp], &
      & 0.04910587645922369_wp, 972.2787456182873_wp, -345.8137230728039_wp)
   call test_sheet('F frame', frame(), 0.1875_wp, 11897.22699386503_wp, 0.8947974574206551_wp, 2.055632796836712_wp, &
      & 0.1853479499956948_wp, 89379.2_wp, [30873.6_wp, 30983.19376757562_wp, 31080.39467074796_wp, 31165.16383045173_wp], &
      & [56788.128_wp, 50719.77425159402_wp, 44631.13326974203_wp, 38524.640429656_wp], 0.4865671641791045_wp)
   call test_lean()
   call test_walls()
   call test_impacts()
   call test_projections()
   call test_least_squares()
   call test_ends()
   call finish()

contains

   !> Areas, centroids and inertias in closed form, and a ring as many polygons
   subroutine test_parts()
      type(chain_mass_type) :: body
      integer, parameter :: n = 400
      real(wp) :: corners(2, 2*n)
      integer :: i

      call suite('parts')
      body = polygon(reshape([1.0_wp, 0.0_wp, 0.0_wp, 0.0_wp, 0.0_wp, 2.0_wp, 1.0_wp, 2.0_wp], [2, 4]), 3.0_wp)
      call check_close(body%mass, 6.0_wp, 1.0e-15_wp, 'mass, clockwise')
      call check_close(body%inertia, 6.0_wp*5.0_wp/12.0_wp, 1.0e-15_wp, 'inertia of a rectangle')
      body = together([body, polygon(reshape([0.2_wp, 0.5_wp, 0.8_wp, 0.5_wp, 0.8_wp, 1.5_wp, 0.2_wp, 1.5_wp], [2, 4]), &
         & -3.0_wp)])
      call check_close(body%mass, 4.2_wp, 1.0e-15_wp, 'mass with an opening')
      call check_close(body%inertia, 2.5_wp - 1.8_wp*1.36_wp/12.0_wp, 1.0e-15_wp, 'inertia with an opening')
      associate (angle => [(0.3_wp + 0.5_wp*real(i - 1, wp)/real(n - 1, wp), i=1, n)])
         corners(1, :n) = 2.0_wp*cos(angle)
         corners(2, :n) = 2.0_wp*sin(angle)
         corners(:, n + 1:) = 1.5_wp*corners(:, n:1:-1)
      end associate
      associate (ring => sector([0.0_wp, 0.0_wp], [2.0_wp, 3.0_wp], [0.3_wp, 0.8_wp], 1.0_wp), straight => polygon(corners, 1.0_wp))
         call check_close(ring%mass, 1.25_wp, 1.0e-15_wp, 'mass of a sector')
         call check_close(straight%at(1), ring%at(1), 1.0e-6_wp, 'its centroid, by straight sides')
         call check_close(straight%inertia, ring%inertia, 1.0e-5_wp, 'its inertia')
      end associate
   end subroutine test_parts

   !> Everything of one mechanism
   subroutine test_sheet(name, chain, alpha, mass, part, a0, capacity, inertia, lever, moment, travel, inertia_there, slope_there)
      character(len=*), intent(in) :: name
      type(chain_type), intent(in) :: chain
      !> alpha_0, M* [kg], e*, a_0* [m/s2] and q_c [rad]
      real(wp), intent(in) :: alpha, mass, part, a0, capacity
      !> J(0) [kg m2]; L [kg m] and M [N m] at 0, 0.02, 0.04 and 0.06 rad
      real(wp), intent(in) :: inertia, lever(4), moment(4)
      !> d_0* [m], J and J' at 0.04 rad
      real(wp), intent(in), optional :: travel, inertia_there, slope_there

      type(motion_type) :: motion, near, other
      type(chain_terms_type) :: terms, before, after, mirror
      type(chain_type) :: image
      type(chain_table_type) :: table
      type(tabulated_type) :: wall
      type(error_type), allocatable :: error
      real(wp), allocatable :: weight(:), displacement(:)
      real(wp) :: found, end, d, x, misfit, j, c, big_g, l, load
      logical :: is_there, is_smooth
      integer :: i

      call suite(name)
      call set_at_rest(chain, motion)
      terms = terms_at(chain, motion)
      call chain_weights(chain, motion, weight, displacement)
      call check_close(terms%moment/sum(weight*displacement), alpha, digits, 'alpha_0')
      call check_close(sum(weight*displacement)**2/(g*sum(weight*displacement**2)), mass, digits, 'M*')
      call check_close(sum(weight*displacement)**2/sum(weight*displacement**2)/sum(weight), part, digits, 'e*')
      call check_close(g*terms%moment/sum(weight*displacement)/part, a0, digits, 'a_0*')
      call check_close(terms%inertia, inertia, digits, 'J(0)')
      call find_end(chain, found, end)
      call check_close(found, capacity, digits, 'q_c')
      call check(end > found, 'its joints close up to its capacity')
      call sample_chain(chain, 1.1_wp*found, table, is_smooth)
      call check(is_smooth, 'is smooth')
      call new_tabulated(wall, table%terms, g, .true., misfit, error)
      call check_ok(error, 'as a table')
      call check(misfit < 1.0e-13_wp, 'misfit')
      call check_close(wall%capacity, capacity, 1.0e-12_wp, 'q_c of the table')
      image = mirrored(chain)
      call set_at_rest(image, other)
      do i = 1, 4
         associate (q => 0.02_wp*real(i - 1, wp))
            call chain%move(q, motion, is_there)
            call check(is_there, 'moves')
            terms = terms_at(chain, motion)
            call check_close(terms%lever, lever(i), digits, 'L')
            call check_close(terms%moment, moment(i), 2.0e-12_wp, 'M')
            call image%move(q, other, is_there)
            mirror = terms_at(image, other)
            call check_close(mirror%inertia, terms%inertia, digits, 'J of the mirror image')
            call check_close(mirror%slope, terms%slope, digits, 'slope of the mirror image', 1.0e-12_wp*inertia)
            call check_close(-mirror%lever, terms%lever, digits, 'L of the mirror image')
            call check_close(mirror%moment, terms%moment, digits, 'M of the mirror image', 1.0e-13_wp*moment(1))
            call wall%terms(q, j, c, big_g, l, load)
            call check_close(j, terms%inertia, 1.0e-12_wp, 'J of the table')
            call check_close(2.0_wp*c, terms%slope, 1.0e-10_wp, 'slope of the table', 1.0e-9_wp*inertia)
            call check_close(big_g - load, terms%moment, 1.0e-12_wp, 'M of the table', 1.0e-13_wp*moment(1))
            call check_close(wall%potential(q), terms%potential, 1.0e-12_wp, 'V of the table', 1.0e-15_wp*moment(1))
            if (i /= 3) cycle
            if (present(inertia_there)) call check_close(terms%inertia, inertia_there, digits, 'J')
            if (present(slope_there)) call check_close(terms%slope, slope_there, 2.0e-12_wp, 'slope of J')
            ! Differences of fourth order are exact to 1e-10 at this step.
            near = motion
            call chain%move(q - 1.0e-4_wp, near, is_there)
            before = terms_at(chain, near)
            near = motion
            call chain%move(q + 1.0e-4_wp, near, is_there)
            after = terms_at(chain, near)
            call check_close((after%inertia - before%inertia)/2.0e-4_wp, terms%slope, 1.0e-5_wp, 'slope by differences', &
               & 1.0e-10_wp*inertia)
            call check_close((after%potential - before%potential)/2.0e-4_wp, terms%moment, 1.0e-5_wp, 'M = dV/dq')
         end associate
      end do
      call chain%move(found, motion, is_there)
      call chain_travel(chain, weight, displacement, motion, d, x)
      if (present(travel)) call check_close(d, travel, digits, 'd_0*')
   end subroutine test_sheet

   !> How supports move three of them
   subroutine test_lean()
      real(wp) :: share, tilt

      call suite('supports')
      call chain_support(strip(), share, tilt)
      call check_close(share/6.8_wp, 0.5296445441686_wp, 1.0e-12_wp, 'k of V')
      call check_close(tilt/6.8_wp, 1.424907737938_wp, 1.0e-12_wp, 'tau of V')
      call chain_support(compound(), share, tilt)
      call check_close(share/7.0_wp, 0.7223314078476_wp, 1.0e-12_wp, 'k of W')
      call check_close(tilt/7.0_wp, 1.401701572591_wp, 1.0e-12_wp, 'tau of W')
      call chain_support(corner(), share, tilt)
      call check_close(share/3.2_wp, 0.8783775545473_wp, 1.0e-12_wp, 'k of C')
      call check_close(tilt/3.2_wp, 3.079750609354_wp, 1.0e-12_wp, 'tau of C')
   end subroutine test_lean

   !> Walls of dondolo as chains
   subroutine test_walls()
      type(wall_input_type) :: input
      type(chain_type) :: chain

      call suite('walls as chains')
      call input%set('mechanism', 'one_sided')
      call input%set('height', 3.0_wp)
      call input%set('thickness', 0.25_wp)
      call input%set('density', 1800.0_wp)
      call input%set('hinge_depth', 0.02_wp)
      call input%set('load', [8.0e3_wp, 3.0e3_wp, 2.0e3_wp])
      call input%set('load_depth', [0.1_wp, 0.2_wp, 0.15_wp])
      call input%set('load_height', [1.5_wp, 3.0_wp, 2.0_wp])
      call input%set('load_inertia', 'both,vertical,none')
      call input%set('thrust', [150.0_wp])
      call input%set('thrust_height', [3.0_wp])
      call input%set('thrust_depth', [0.1_wp])
      chain = block(3.0_wp, 0.25_wp, 1800.0_wp, 0.02_wp)
      chain%actions = [chain_action_type(body=1, at=[-0.1_wp, 1.5_wp], weight=8.0e3_wp, pushed=8.0e3_wp/g, lifted=8.0e3_wp/g), &
         & chain_action_type(body=1, at=[-0.2_wp, 3.0_wp], weight=3.0e3_wp, lifted=3.0e3_wp/g), &
         & chain_action_type(body=1, at=[-0.15_wp, 2.0_wp], weight=2.0e3_wp), &
         & chain_action_type(body=1, at=[-0.1_wp, 3.0_wp], thrust=[150.0_wp, 0.0_wp])]
      call compare('one_sided', input, chain)
      call compare_strip()
   end subroutine test_walls

   !> A strip
   subroutine compare_strip()
      type(wall_input_type) :: input
      type(chain_type) :: chain

      call input%set('mechanism', 'two_block')
      call input%set('height', 3.0_wp)
      call input%set('thickness', 0.25_wp)
      call input%set('density', 1800.0_wp)
      call input%set('hinge', 0.6_wp)
      call input%set('hinge_depth', 0.02_wp)
      call input%set('overburden', 8.0e3_wp)
      call input%set('overburden_inertia', 0.5_wp)
      call input%set('eccentricity', 0.03_wp)
      chain = two_block(0.02_wp, 8.0e3_wp, 0.5_wp, 0.03_wp)
      call compare('two_block', input, chain)
   end subroutine compare_strip

   !> A strip of 3 m by 0.25 m with a weight on its top
   pure type(chain_type) function two_block(hinge, weight, lifted, eccentricity)
      real(wp), intent(in) :: hinge, weight, lifted, eccentricity

      two_block = block(3.0_wp, 0.25_wp, 1800.0_wp, hinge)
      two_block%bodies = [rectangle([-0.25_wp, 0.0_wp], [0.0_wp, 1.8_wp], 1800.0_wp), &
         & rectangle([-0.25_wp, 0.0_wp], [1.8_wp, 3.0_wp], 1800.0_wp)]
      two_block%joints = [pin(1, 0, [-hinge, 0.0_wp]), pin(1, 2, [hinge - 0.25_wp, 1.8_wp]), &
         & guide(2, 0, [-hinge, 3.0_wp], 0.0_wp)]
      two_block%actions = [chain_action_type(body=2, at=[-0.125_wp + eccentricity, 3.0_wp], weight=weight, &
         & lifted=lifted*weight/g, is_held=.true.)]
   end function two_block

   !> Compare the terms of a wall with those of its chain
   subroutine compare(name, input, chain)
      character(len=*), intent(in) :: name
      type(wall_input_type), intent(in) :: input
      type(chain_type), intent(in) :: chain

      type(wall_type) :: wall
      type(error_type), allocatable :: error
      type(motion_type) :: motion
      type(chain_terms_type) :: terms
      real(wp) :: j, c, big_g, l, load, capacity, end, share, tilt, k, tau
      logical :: is_there
      integer :: i

      call new_wall(wall, input, error, g)
      call check_ok(error, name)
      if (allocated(error)) return
      call set_at_rest(chain, motion)
      do i = 0, 4
         associate (q => 0.02_wp*real(i, wp))
            call chain%move(q, motion, is_there)
            terms = terms_at(chain, motion)
            call wall%mechanism%terms(q, j, c, big_g, l, load)
            call check_close(terms%inertia, j, digits, name//', J')
            call check_close(0.5_wp*terms%slope, c, digits, name//', C', 1.0e-13_wp*j)
            call check_close(terms%lever, l, digits, name//', L')
            call check_close(terms%moment, big_g - load, digits, name//', M', 1.0e-13_wp*g*l)
            call check_close(terms%vertical_lever, big_g/g, digits, name//', S', 1.0e-12_wp*l)
         end associate
      end do
      call find_end(chain, capacity, end)
      call check_close(capacity, wall%mechanism%capacity, 1.0e-14_wp, name//', q_c')
      call chain_support(chain, share, tilt)
      call wall%mechanism%support(k, tau)
      if (name == 'two_block') call check_close(share, k, digits, name//', k')
      if (name == 'two_block') call check_close(tilt, tau, 1.0e-12_wp, name//', tau')
   end subroutine compare

   !> The cone against Housner, two_block and the arches
   subroutine test_impacts()
      type(chain_mass_type), allocatable :: parts(:)
      type(contact_type), allocatable :: contacts(:)
      type(attached_type) :: none(0)
      type(chain_type) :: band
      real(wp) :: alpha

      call suite('impact on the cone')
      alpha = atan(0.25_wp/3.0_wp)
      parts = [rectangle([-0.25_wp, 0.0_wp], [0.0_wp, 3.0_wp], 1800.0_wp)]
      contacts = [contact_type(1, 0, reshape([-0.25_wp, 0.0_wp, 0.0_wp, 0.0_wp], [2, 2]), [0.0_wp, 1.0_wp])]
      call check_close(cone_ratio(parts, contacts, none, closing(block(3.0_wp, 0.25_wp, 1800.0_wp, 0.0_wp), parts, [1])), &
         & 1.0_wp - 1.5_wp*sin(alpha)**2, 1.0e-14_wp, 'Housner')
      parts = [rectangle([-0.25_wp, 0.0_wp], [0.0_wp, 1.8_wp], 1800.0_wp), &
         & rectangle([-0.25_wp, 0.0_wp], [1.8_wp, 3.0_wp], 1800.0_wp)]
      contacts = strip_contacts([0.0_wp, 1.8_wp, 3.0_wp], -0.25_wp, 0.0_wp)
      call check_close(cone_ratio(parts, contacts, none, closing(two_block(0.0_wp, 0.0_wp, 0.0_wp, 0.0_wp), parts, [1, 2])), &
         & 0.8535676251331203_wp, 1.0e-13_wp, 'two_block')
      call check_close(cone_ratio(parts, contacts, [attached_type(2, [-0.125_wp, 3.0_wp], [0.0_wp, 20.0e3_wp/g])], &
         & closing(two_block(0.0_wp, 20.0e3_wp, 1.0_wp, 0.0_wp), parts, [1, 2])), 0.4872947387611802_wp, 1.0e-13_wp, &
         & 'two_block with a lifted mass')
      band = horizontal()
      parts = band%bodies
      contacts = strip_contacts([0.0_wp, 2.2_wp, 4.0_wp], -0.44_wp, -0.01_wp)
      call check_close(cone_ratio(parts, contacts, none, closing(band, parts, [1, 2])), 0.7425584481757533_wp, 1.0e-13_wp, &
         & 'horizontal')
      parts = arch_parts(7)
      contacts = arch_contacts()
      call check_close(cone_ratio(parts, contacts, none, closing(arch(), parts, [1, 1, 1, 2, 2, 3, 3])), 0.7478202942782_wp, &
         & 1.0e-12_wp, 'arch')
      parts = portal_parts()
      contacts = portal_contacts()
      call check_close(cone_ratio(parts, contacts, none, closing(portal(), parts, [0, 0, 1, 1, 1, 2, 2, 3, 3, 3])), &
         & 0.8266624574104_wp, 1.0e-12_wp, 'portal')
   end subroutine test_impacts

   !> Joints of a strip of two parts: at its base, in between, and held sideways at its top
   pure function strip_contacts(y, left, right) result(contacts)
      real(wp), intent(in) :: y(3), left, right
      type(contact_type) :: contacts(3)

      integer :: i

      do i = 1, 2
         contacts(i) = contact_type(i, i - 1, reshape([left, y(i), right, y(i)], [2, 2]), [0.0_wp, 1.0_wp])
      end do
      contacts(3) = contact_type(2, 0, reshape([left, y(3), right, y(3)], [2, 2]), [1.0_wp, 0.0_wp], is_guide=.true.)
   end function strip_contacts

   !> Velocities of parts while a chain closes
   function closing(chain, parts, body) result(v)
      type(chain_type), intent(in) :: chain
      type(chain_mass_type), intent(in) :: parts(:)
      !> The body of the chain that each part belongs to; 0: none, it does not move
      integer, intent(in) :: body(:)
      real(wp) :: v(3, size(parts))

      type(motion_type) :: motion
      integer :: i

      call set_at_rest(chain, motion)
      v = 0.0_wp
      do i = 1, size(parts)
         if (body(i) > 0) v(:, i) = -velocity_of(parts(i)%at, chain%bodies(body(i))%at, motion%rate(:, body(i)))
      end do
   end function closing

   !> Conditions of Karush, Kuhn and Tucker of least squares with a bound that holds and one that does not
   subroutine test_least_squares()
      real(wp), parameter :: a(4, 3) = reshape([1.0_wp, 2.0_wp, 0.0_wp, 1.0_wp, 0.5_wp, -1.0_wp, 2.0_wp, 0.0_wp, 1.0_wp, 1.0_wp, &
         & 1.0_wp, -3.0_wp], [4, 3]), b(4) = [1.0_wp, -1.0_wp, 3.0_wp, 2.0_wp]
      real(wp) :: x(3), gradient(3)

      call suite('least squares')
      call nonnegative_least_squares(a, b, x)
      gradient = matmul(b - matmul(a, x), a)
      call check(all(x >= 0.0_wp) .and. any(x > 0.1_wp) .and. any(x <= 0.0_wp), 'some are at their bound')
      call check(all(gradient <= 1.0e-12_wp), 'no direction is better')
      call check(all(abs(gradient*x) <= 1.0e-12_wp), 'complementarity')
   end subroutine test_least_squares

   !> Plain projections onto the mirror image, of the table; and Cauchy's bound
   subroutine test_projections()
      type(chain_mass_type), allocatable :: parts(:)
      real(wp), allocatable :: before(:, :), after(:, :)
      integer :: i

      call suite('projections')
      parts = arch_parts(7)
      before = closing(arch(), parts, [1, 1, 1, 2, 2, 3, 3])
      ! The mirror image has part 8 - i where the arch has part i.
      after = reshape([([before(1, i), -before(2, i), before(3, i)], i=7, 1, -1)], [3, 7])
      call check_close(projection(parts, before, after), 0.6449595399261409_wp, 1.0e-12_wp, 'arch')
      call check_close(sum(after**2), sum(before**2), 1.0e-14_wp, 'mirror images have one length')
      parts = portal_parts()
      before = closing(portal(), parts, [0, 0, 1, 1, 1, 2, 2, 3, 3, 3])
      after = reshape([([before(1, i), -before(2, i), before(3, i)], i=10, 1, -1)], [3, 10])
      call check_close(projection(parts, before, after), 0.1628916324974953_wp, 1.0e-12_wp, 'portal')
   end subroutine test_projections

   !> Joints that depend on one another, and a chain that closes on itself
   subroutine test_ends()
      type(chain_type) :: chain
      type(factor_type) :: factor
      real(wp) :: capacity, end

      call suite('ends')
      chain = two_block(0.0_wp, 0.0_wp, 0.0_wp, 0.0_wp)
      call chain%at_rest(factor)
      call check(factor%rank == 6, 'a strip moves')
      chain%joints(3) = guide(2, 0, [0.0_wp, 3.0_wp], 0.5_wp*pi)
      chain%joints(2) = pin(1, 2, [0.0_wp, 1.8_wp])
      call chain%at_rest(factor)
      call check(factor%rank == 5, 'three hinges in line and a vertical guide do not')
      ! A crank of 1 m whose rod of 0.3 m slides on a vertical line: x = sin q + 0.3 cos psi = 0.18, cos psi > -1
      chain%bodies = [point_mass(1000.0_wp, [-1.0_wp, 0.5_wp], 100.0_wp), point_mass(1.0_wp, [0.09_wp, 1.12_wp], 0.01_wp)]
      chain%joints = [pin(1, 0, [0.0_wp, 0.0_wp]), pin(1, 2, [0.0_wp, 1.0_wp]), guide(2, 0, [0.18_wp, 1.24_wp], 0.0_wp)]
      chain%actions = chain%actions(:0)
      call find_end(chain, capacity, end)
      call check_close(end, asin(0.48_wp), 1.0e-12_wp, 'a crank ends where its rod lies flat')
      call check(capacity <= end, 'not before its moment vanishes')
   end subroutine test_ends

end program test_rigid_chains
