!> Distributions of an uncertain property, as written in a case: 'triangular(0.5, 0.6, 0.75)'.
module dondolo_population_distribution
   use dondolo_base_error, only : error_type, not_a_word, out_of_range, raise_input
   use dondolo_base_kinds, only : wp
   use dondolo_base_normal, only : normal_cdf, normal_quantile
   use dondolo_base_numbers, only : parse_real
   use dondolo_base_text, only : join, lower, rounded, to_text
   use dondolo_wall_restitution, only : cut_off, published_factors
   implicit none
   private

   public :: distribution_type, new_distribution, least_share

   !> Names of the distributions
   character(len=10), parameter :: kinds(*) = [character(len=10) :: 'uniform', 'triangular', 'normal', 'lognormal']

   !> How they are called, for messages
   character(len=*), parameter :: help = 'must be ''uniform(low, high)'', ''triangular(low, mode, high)'', '// &
      & '''normal(mean, sd)'' or ''lognormal(theta, beta)'', the last two optionally with the bounds low, high'

   !> Least probability between the bounds of a truncated distribution: less is probably a mistake, and loses digits
   real(wp), parameter :: least_share = 1.0e-6_wp

   !> A distribution
   type :: distribution_type
      !> Its name, one of kinds
      character(len=10) :: kind = 'uniform'
      !> Its parameters in the order of its call
      real(wp), allocatable :: parameters(:)
   contains
      !> The value that is not exceeded with a probability
      procedure :: quantile
      !> Where the normal distribution behind it begins and ends
      procedure, private :: ends
   end type distribution_type

contains

   !> Make a distribution of its text
   subroutine new_distribution(found, property, text, error)
      type(distribution_type), intent(out) :: found
      !> The property that is distributed so
      character(len=*), intent(in) :: property
      !> Name and parameters; for restitution_factor also the name of a published range
      character(len=*), intent(in) :: text
      !> It is none
      type(error_type), allocatable, intent(out) :: error

      character(len=len(text)) :: plain
      real(wp) :: ends(2)
      integer :: opening, closing, i
      logical :: ok

      plain = lower(adjustl(text))
      allocate (found%parameters(0))
      i = findloc(published_factors%name == plain, .true., dim=1)
      if (i > 0 .and. property == 'restitution_factor') then
         found%kind = published_factors(i)%kind
         found%parameters = cut_off(i, 0.0_wp)
         return
      end if
      opening = index(plain, '(')
      closing = len_trim(plain)
      ok = opening > 1
      if (ok) ok = any(kinds == plain(:opening - 1)) .and. plain(closing:closing) == ')'
      if (ok) then
         found%kind = plain(:opening - 1)
         call take_numbers(plain(opening + 1:closing - 1), found%parameters, ok)
      end if
      if (ok) ok = are_right(found%kind, found%parameters)
      if (ok) then
         ends = found%ends()
         if (ends(2) - ends(1) >= least_share) return
         call raise_input(error, property//' = '''//text//''': low and high leave '//rounded(ends(2) - ends(1))// &
            & ' of the distribution between them, must leave '//to_text(least_share)//' at least', &
            & out_of_range, property)
         return
      end if
      call raise_input(error, property//' = '''//text//''': '//help, not_a_word, property)
      if (property == 'restitution_factor') error%message = error%message//'; or a published range: '// &
         & join(published_factors%name)
   end subroutine new_distribution

   !> Numbers with commas between them
   subroutine take_numbers(text, numbers, ok)
      character(len=*), intent(in) :: text
      real(wp), allocatable, intent(out) :: numbers(:)
      !> Are all of them numbers?
      logical, intent(out) :: ok

      real(wp) :: number
      integer :: first, last

      allocate (numbers(0))
      first = 1
      do
         last = index(text(first:)//',', ',') + first - 2
         call parse_real(text(first:last), number, ok)
         if (.not. ok) return
         numbers = [numbers, number]
         if (last >= len(text)) return
         first = last + 2
      end do
   end subroutine take_numbers

   !> Do parameters make a distribution?
   pure logical function are_right(kind, p)
      character(len=*), intent(in) :: kind
      !> The parameters
      real(wp), intent(in) :: p(:)

      are_right = .false.
      select case (kind)
      case ('uniform')
         if (size(p) == 2) are_right = p(1) < p(2)
      case ('triangular')
         if (size(p) == 3) are_right = p(1) < p(3) .and. p(1) <= p(2) .and. p(2) <= p(3)
      case default
         if (size(p) == 2 .or. size(p) == 4) are_right = p(2) > 0.0_wp .and. (kind == 'normal' .or. all(p > 0.0_wp))
         if (are_right .and. size(p) == 4) are_right = p(3) < p(4)
      end select
   end function are_right

   !> The value that is not exceeded with a probability
   pure real(wp) function quantile(self, probability) result(value)
      class(distribution_type), intent(in) :: self
      !> The probability, between 0 and 1
      real(wp), intent(in) :: probability

      real(wp) :: ends(2), share

      associate (p => self%parameters)
         select case (self%kind)
         case ('uniform')
            value = p(1) + (p(2) - p(1))*probability
         case ('triangular')
            share = (p(2) - p(1))/(p(3) - p(1))
            if (probability < share) then
               value = p(1) + sqrt(probability*(p(3) - p(1))*(p(2) - p(1)))
            else
               value = p(3) - sqrt((1.0_wp - probability)*(p(3) - p(1))*(p(3) - p(2)))
            end if
         case default
            ends = self%ends()
            value = normal_quantile(ends(1) + (ends(2) - ends(1))*probability)
            if (self%kind == 'normal') value = p(1) + p(2)*value
            if (self%kind == 'lognormal') value = p(1)*exp(p(2)*value)
            if (size(p) == 4) value = min(p(4), max(p(3), value))
         end select
      end associate
   end function quantile

   !> Probabilities at which the normal distribution behind a distribution begins and ends: 0 and 1 unless it is cut off
   pure function ends(self)
      class(distribution_type), intent(in) :: self
      real(wp) :: ends(2)

      ends = [0.0_wp, 1.0_wp]
      associate (p => self%parameters)
         if (size(p) < 4) return
         if (self%kind == 'normal') ends = normal_cdf((p(3:4) - p(1))/p(2))
         if (self%kind == 'lognormal') ends = normal_cdf(log(p(3:4)/p(1))/p(2))
      end associate
   end function ends

end module dondolo_population_distribution
