!> A population that the case itself says: a facade, which its hinges make several walls of, or the variants of one wall
!> whose properties are not known for certain.
!>
!> Variants are a Latin hypercube (McKay, Beckman and Conover 1979): the range of every property is cut into as many parts
!> of equal probability as there are samples, and each part holds one. After the sample come, with a weight of 0, the wall
!> as it was given, that with all properties at their medians, and those with one property at its fractiles 5 and 95 %.
module dondolo_population_variants
   use dondolo_base_kinds, only : wp
   use dondolo_base_property, only : is_list, name_length
   use dondolo_base_text, only : to_text
   use dondolo_population_distribution, only : distribution_type
   use dondolo_record_random, only : new_hashed_random, random_type
   use dondolo_wall_properties, only : wall_input_type, wall_properties
   implicit none
   private

   public :: base_wall_type, sample_variants, ends_of_sources

   !> Fractiles at which one property alone is moved to its ends
   real(wp), parameter :: ends_of_sources(2) = [0.05_wp, 0.95_wp]

   !> The wall of whose hinges or variants all rows are made
   type, extends(wall_input_type) :: base_wall_type
      !> Its uncertain properties; none: it is a facade
      character(len=name_length), allocatable :: sources(:)
      !> Their values in each row (sources, rows); not a number in the row of the wall as it was given
      real(wp), allocatable :: values(:, :)
      !> Rows of the sample
      integer :: samples = 0
   contains
      !> Is it a wall with variants?
      procedure :: is_uncertain
      !> How many rows it says
      procedure :: rows
      !> Weight of a row
      procedure :: weight
      !> Make a variant of it
      procedure :: vary
      !> Row with all properties at their medians
      procedure :: row_of_medians
      !> Row with one property at one of its ends
      procedure :: row_of_end
   end type base_wall_type

contains

   !> Sample the variants of a wall, anew if it has some
   subroutine sample_variants(wall, sources, distributions, samples, seed)
      !> The wall: its variants are set
      type(base_wall_type), intent(inout) :: wall
      !> Its uncertain properties
      character(len=*), intent(in) :: sources(:)
      !> Their distributions
      type(distribution_type), intent(in) :: distributions(:)
      !> How many samples
      integer, intent(in) :: samples
      !> Seed of the random numbers, positive
      integer, intent(in) :: seed

      type(random_type) :: random
      integer :: parts(samples), i, k, other, part

      wall%sources = sources
      wall%samples = samples
      if (allocated(wall%values)) deallocate (wall%values)
      allocate (wall%values(size(sources), samples + 2 + 2*size(sources)))
      do k = 1, size(sources)
         ! A stream for each, so that a further source leaves the others as they are
         random = new_hashed_random(seed, k - 1)
         parts = [(i, i=1, samples)]
         do i = samples, 2, -1
            other = 1 + int(random%next()*real(i, wp))
            part = parts(i)
            parts(i) = parts(other)
            parts(other) = part
         end do
         do i = 1, samples
            wall%values(k, i) = distributions(k)%quantile((real(parts(i), wp) - random%next())/real(samples, wp))
         end do
         wall%values(k, samples + 1:) = distributions(k)%quantile(0.5_wp)
         do i = 1, 2
            wall%values(k, wall%row_of_end(k, i)) = distributions(k)%quantile(ends_of_sources(i))
         end do
      end do
   end subroutine sample_variants

   !> Is it a wall with variants?
   pure logical function is_uncertain(self)
      class(base_wall_type), intent(in) :: self

      is_uncertain = self%samples > 0
   end function is_uncertain

   !> How many rows it says: of a facade one, which becomes several
   pure integer function rows(self)
      class(base_wall_type), intent(in) :: self

      rows = 1
      if (self%is_uncertain()) rows = size(self%values, 2)
   end function rows

   !> Weight of a row: those behind the sample take no part in its curve
   pure real(wp) function weight(self, row)
      class(base_wall_type), intent(in) :: self
      integer, intent(in) :: row

      weight = merge(0.0_wp, 1.0_wp, self%is_uncertain() .and. row > self%samples)
   end function weight

   !> Row with all properties at their medians
   pure integer function row_of_medians(self) result(row)
      class(base_wall_type), intent(in) :: self

      row = self%samples + 2
   end function row_of_medians

   !> Row with one property at one of its ends
   pure integer function row_of_end(self, source, end)
      class(base_wall_type), intent(in) :: self
      !> Number of the property
      integer, intent(in) :: source
      !> 1 or 2, for the lower or the upper end
      integer, intent(in) :: end

      row_of_end = self%samples + 2*source + end
   end function row_of_end

   !> The wall of a row
   subroutine vary(self, row, input)
      class(base_wall_type), intent(in) :: self
      !> Number of the row
      integer, intent(in) :: row
      !> The wall as it is given; out: the variant, with a name of its own
      class(wall_input_type), intent(inout) :: input

      character(len=:), allocatable :: name
      integer :: k, behind

      behind = row - self%samples
      if (behind == 1) return
      name = trim(self%word('name'))
      do k = 1, size(self%sources)
         if (any(wall_properties%name == self%sources(k) .and. wall_properties%kind == is_list)) then
            call input%set(trim(self%sources(k)), [self%values(k, row)])
         else
            call input%set(trim(self%sources(k)), self%values(k, row))
         end if
      end do
      if (behind == 2) then
         name = name//', medians'
      else if (behind > 2) then
         k = (behind - 1)/2
         name = name//', '//trim(self%sources(k))//' at '//to_text(nint(100.0_wp*ends_of_sources(behind - 2*k)))//'%'
      else
         name = name//' '//repeat('0', max(0, 4 - len(to_text(row))))//to_text(row)
      end if
      call input%set('name', name)
   end subroutine vary

end module dondolo_population_variants
