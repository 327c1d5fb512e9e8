!> A wall that is not known for certain: distributions, variants, indices
program test_uncertainty
   use checks, only : check, check_close, check_error, check_ok, finish, suite
   use dondolo_base_error, only : error_type
   use dondolo_base_kinds, only : wp
   use dondolo_base_spelling, only : meant
   use dondolo_population_distribution, only : distribution_type, new_distribution
   use dondolo_population_sensitivity, only : new_sensitivity, sensitivity_type, smallest_sample
   use dondolo_population_variants, only : sample_variants, base_wall_type
   use dondolo_wall_properties, only : wall_input_type
   implicit none

   call test_quantiles()
   call test_wrong_texts()
   call test_variants()
   call test_indices()
   call test_spelling()
   call finish()

contains

   !> A distribution of its text
   function distribution_of(text) result(found)
      character(len=*), intent(in) :: text
      type(distribution_type) :: found
      type(error_type), allocatable :: error

      call new_distribution(found, 'restitution_factor', text, error)
      call check_ok(error, text)
   end function distribution_of

   !> Quantiles in closed form, and of the normal distribution from tables
   subroutine test_quantiles()
      real(wp), parameter :: exact = 8*epsilon(1.0_wp), z = 1.64485362695147271486_wp
      type(distribution_type) :: d

      call suite('quantiles')
      d = distribution_of('Graziotti_2016')
      call check_close(d%quantile(0.5_wp), 0.87_wp, exact, 'a published range')
      d = distribution_of('colombo_2025')
      call check_close(d%quantile(0.5_wp), 0.990_wp, exact, 'a published mean')
      call check_close(d%quantile(0.975_wp) - d%quantile(0.025_wp), 2.0_wp*1.96_wp*0.018_wp, 0.02_wp, 'and its width')
      d = distribution_of('uniform( 2, 4 )')
      call check_close(d%quantile(0.25_wp), 2.5_wp, exact, 'uniform')
      d = distribution_of('triangular(0, 1, 4)')
      call check_close(d%quantile(0.25_wp), 1.0_wp, exact, 'triangular, at its mode')
      call check_close(d%quantile(0.0625_wp), 0.5_wp, exact, 'triangular, below')
      call check_close(d%quantile(0.8125_wp), 2.5_wp, exact, 'triangular, above')
      d = distribution_of('triangular(0, 0, 1)')
      call check_close(d%quantile(0.75_wp), 0.5_wp, exact, 'triangular, without a rise')
      d = distribution_of('normal(10, 2)')
      call check_close(d%quantile(0.95_wp), 10.0_wp + 2.0_wp*z, exact, 'normal, above')
      call check_close(d%quantile(0.05_wp), 10.0_wp - 2.0_wp*z, exact, 'normal, below')
      d = distribution_of('lognormal(3, 0.5)')
      call check_close(d%quantile(0.95_wp), 3.0_wp*exp(0.5_wp*z), exact, 'lognormal')
      d = distribution_of('normal(0, 1, 0, 9)')
      call check_close(d%quantile(0.9_wp), z, 1.0e-14_wp, 'half of a normal distribution')
      call check_close(d%quantile(0.0_wp), 0.0_wp, 1.0e-14_wp, 'its lower end')
   end subroutine test_quantiles

   !> What is no distribution
   subroutine test_wrong_texts()
      character(len=26), parameter :: texts(*) = [character(len=26) :: '', '()', 'uniform', 'uniform()', 'uniform(1)', &
         & 'uniform(2, 1)', 'uniform(1, 1)', 'uniform(1, 2, 3)', 'triangular(1, 0, 2)', 'normal(1, 0)', 'normal(1, 2, 3)', &
         & 'normal(1, 2, 4, 3)', 'lognormal(-1, 1)', 'lognormal(1, 1, 0, 2)', 'uniform(1, 2', 'uniform 1, 2', 'uniform(1,, 2)', &
         & 'beta(1, 2)', 'graziotti']
      type(distribution_type) :: d
      type(error_type), allocatable :: error
      integer :: i

      call suite('no distributions')
      do i = 1, size(texts)
         call new_distribution(d, 'hinge', trim(texts(i)), error)
         call check_error(error, 'hinge = '''//trim(texts(i))//''': must be ''uniform(low, high)''', texts(i))
      end do
      call new_distribution(d, 'hinge', 'graziotti_2016', error)
      call check(index(error%message, 'published') == 0, 'ranges are of the restitution')
      call new_distribution(d, 'hinge', 'normal(0.6, 0.02, 0.8, 0.9)', error)
      call check_error(error, 'hinge = ''normal(0.6, 0.02, 0.8, 0.9)'': low and high leave ', 'nothing is left of a normal')
      call new_distribution(d, 'hinge', 'lognormal(0.6, 0.02, 0.8, 0.9)', error)
      call check_error(error, 'hinge = ''lognormal(0.6, 0.02, 0.8, 0.9)'': low and high leave ', 'nor of a lognormal')
      call new_distribution(d, 'hinge', 'normal(0.6, 0.1, 0.8, 0.9)', error)
      call check(.not. allocated(error), 'a tail')
   end subroutine test_wrong_texts

   !> Every part of equal probability holds one sample; the rows behind the sample
   subroutine test_variants()
      integer, parameter :: n = 50
      type(base_wall_type) :: wall, other
      type(wall_input_type) :: row
      integer :: hits(n), i, k

      call suite('variants')
      call wall%set('name', 'W')
      call wall%set('hinge', 0.6_wp)
      call check(wall%rows() == 1 .and. .not. wall%is_uncertain(), 'a facade is one row')
      call sample_variants(wall, [character(len=20) :: 'hinge', 'density'], [distribution_of('uniform(0, 1)'), &
         & distribution_of('uniform(0, 50)')], n, 7)
      call check(wall%rows() == n + 6, 'rows')
      do k = 1, 2
         hits = 0
         do i = 1, n
            associate (part => 1 + int(wall%values(k, i)*merge(50.0_wp, 1.0_wp, k == 1)))
               hits(part) = hits(part) + 1
            end associate
         end do
         call check(all(hits == 1), 'a Latin hypercube')
      end do
      call check(abs(wall%weight(n) - 1.0_wp) + abs(wall%weight(n + 1)) <= 0.0_wp, 'weights')
      row = wall%wall_input_type
      call wall%vary(n + 1, row)
      call check(trim(row%word('name')) == 'W' .and. abs(row%number('hinge') - 0.6_wp) <= 0.0_wp, 'the wall as given')
      call wall%vary(n + 2, row)
      call check(trim(row%word('name')) == 'W, medians', 'the medians')
      call check_close(row%number('density'), 25.0_wp, 1.0e-14_wp, 'a median')
      call wall%vary(n + 6, row)
      call check(trim(row%word('name')) == 'W, density at 95%', 'an end')
      call check_close(row%number('density'), 47.5_wp, 1.0e-14_wp, 'the end')
      call check_close(row%number('hinge'), 0.5_wp, 1.0e-14_wp, 'the others at their medians')
      ! A further source leaves the others as they are
      call other%set('name', 'W')
      call sample_variants(other, [character(len=20) :: 'hinge'], [distribution_of('uniform(0, 1)')], n, 7)
      call check(all(abs(other%values(1, :n) - wall%values(1, :n)) <= 0.0_wp), 'a stream for each source')
   end subroutine test_variants

   !> A sum whose parts are known, and too few samples
   subroutine test_indices()
      integer, parameter :: n = 7
      type(sensitivity_type) :: found
      type(error_type), allocatable :: error
      real(wp) :: x(n*n, 2), y(n*n)
      integer :: i, j

      call suite('indices')
      do j = 1, n
         do i = 1, n
            x(i + n*(j - 1), :) = [real(i, wp), real(j, wp)]
         end do
      end do
      y = 3.0_wp*x(:, 1) + x(:, 2)
      call new_sensitivity(found, x, y, error)
      call check_ok(error, 'a sum')
      call check_close(found%first(1), 0.9_wp, 1.0e-12_wp, 'first of a sum')
      call check_close(found%total(2), 0.1_wp, 1.0e-12_wp, 'total of a sum')
      call check(found%rest < 1.0e-20_wp, 'nothing is left')
      ! Of (i - 4)(j - 4) nothing is of one alone
      call new_sensitivity(found, x, (x(:, 1) - 4.0_wp)*(x(:, 2) - 4.0_wp), error)
      call check(maxval(found%first) < 1.0e-12_wp, 'first of a product')
      call check_close(found%total(1), 1.0_wp, 1.0e-12_wp, 'total of a product')
      call new_sensitivity(found, x, spread(2.0_wp, 1, n*n), error)
      call check_ok(error, 'an outcome without scatter')
      call check(maxval(found%total) <= 0.0_wp, 'nothing to explain')
      call check(smallest_sample(2) == 16, 'two for each polynomial')
      call new_sensitivity(found, x(:15, :), y(:15), error)
      call check_error(error, '15 samples with a curve: must be at least 16 for indices of 2 quantities', 'too few')
      x(:, 2) = x(:, 1)
      call new_sensitivity(found, x, y, error)
      call check_error(error, 'two quantities have the same ranks', 'one quantity twice')
   end subroutine test_indices

   !> Names that are near, and names that are not
   subroutine test_spelling()
      character(len=9), parameter :: names(3) = [character(len=9) :: 'height', 'thickness', 'im']

      call suite('spelling')
      call check(trim(meant('heigth', names)) == '; did you mean ''height''?', 'swapped')
      call check(trim(meant('tickness', names)) == '; did you mean ''thickness''?', 'left out')
      call check(trim(meant('thicknesss', names)) == '; did you mean ''thickness''?', 'put in')
      call check(trim(meant('hinge', names)) == '', 'another word')
      call check(trim(meant('in', names)) == '', 'a short one')
      call check(trim(meant('im', names(:0))) == '', 'no names')
   end subroutine test_spelling

end program test_uncertainty
