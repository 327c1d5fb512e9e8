!> Accelerograms side by side, for many histories at once: all samples in one array, and where it is worth looking.
module dondolo_record_set
   use dondolo_base_kinds, only : wp
   use dondolo_base_threads, only : team_of
   use dondolo_record, only : compute_extremes, record_type
   implicit none
   private

   public :: record_set_type, new_record_set

   !> Samples in a block
   integer, parameter :: block_size = 64

   !> Part of the largest sample that strong motion reaches
   real(wp), parameter :: strong = 0.1_wp

   !> Samples of all records
   type :: record_set_type
      !> Samples of all records one after another, with two zeros after each: the ground after the record [m/s2]
      real(wp), allocatable :: samples(:)
      !> Their vertical components at the same places, zero for a record without one [m/s2]; not allocated: none has one
      real(wp), allocatable :: verticals(:)
      !> Samples before the first of each record
      integer, allocatable :: offset(:)
      !> Number of samples of each record
      integer, allocatable :: length(:)
      !> Smallest and largest sample of each block [m/s2]
      real(wp), allocatable, private :: lowest(:), highest(:)
      !> The same from each block to the end of its record [m/s2]
      real(wp), allocatable, private :: lowest_left(:), highest_left(:)
      !> Smallest vertical sample of each block, and from each block to the end of its record [m/s2]
      real(wp), allocatable, private :: lowest_vertical(:), lowest_vertical_left(:)
      !> Blocks before the first of each record
      integer, allocatable, private :: first_block(:)
   contains
      !> The next sample outside a range
      procedure :: next_outside
      !> The next sample that may lie outside a range that varies with the vertical component
      procedure :: next_outside_of_both
      !> How long the strong motion lasts
      procedure :: strong_blocks
   end type record_set_type

contains

   !> Join records. Each thread writes the samples of some of them, which the system then places in the memory of the node
   !> that the thread runs on: those of all records lie in the memory of all nodes
   subroutine new_record_set(set, records, threads)
      !> Their samples together
      type(record_set_type), intent(out) :: set
      type(record_type), intent(in) :: records(:)
      !> Number of threads, 0: all that OpenMP gives; one if absent
      integer, intent(in), optional :: threads

      integer :: i, samples, blocks, team

      team = 1
      if (present(threads)) team = team_of(threads, size(records))
      allocate(set%offset(size(records)), set%length(size(records)), set%first_block(size(records)))
      samples = 0
      blocks = 0
      do i = 1, size(records)
         set%offset(i) = samples
         set%first_block(i) = blocks
         set%length(i) = size(records(i)%acceleration)
         samples = samples + set%length(i) + 2
         blocks = blocks + (set%length(i) - 1)/block_size + 1
      end do
      allocate(set%samples(samples), set%lowest(blocks), set%highest(blocks), set%lowest_left(blocks), &
         & set%highest_left(blocks))
      !$omp parallel do num_threads(team) if(team > 1) default(none) shared(set, records)
      do i = 1, size(records)
         call add_record(set, i, records(i)%acceleration)
      end do
      !$omp end parallel do
      do i = 1, size(records)
         if (.not. allocated(records(i)%vertical)) cycle
         call add_verticals(set, records)
         return
      end do
   end subroutine new_record_set

   !> Join the samples of one record
   pure subroutine add_record(set, record, a)
      !> Samples of the records together
      type(record_set_type), intent(inout) :: set
      !> Number of the record
      integer, intent(in) :: record
      !> Its samples [m/s2]
      real(wp), intent(in) :: a(:)

      integer :: j, k, n

      n = size(a)
      associate (before => set%offset(record), first => set%first_block(record))
         set%samples(before + 1:before + n) = a
         set%samples(before + n + 1:before + n + 2) = 0.0_wp
         do k = first + (n - 1)/block_size + 1, first + 1, -1
            j = (k - first - 1)*block_size + 1
            call compute_extremes(a(j:min(j + block_size - 1, n)), set%lowest(k), set%highest(k))
            set%lowest_left(k) = set%lowest(k)
            set%highest_left(k) = set%highest(k)
            if (j + block_size > n) cycle
            set%lowest_left(k) = min(set%lowest(k), set%lowest_left(k + 1))
            set%highest_left(k) = max(set%highest(k), set%highest_left(k + 1))
         end do
      end associate
   end subroutine add_record

   !> Blocks from the first to the last of strong motion
   pure integer function strong_blocks(self, record)
      class(record_set_type), intent(in) :: self
      !> Number of the record
      integer, intent(in) :: record

      real(wp) :: largest((self%length(record) - 1)/block_size + 1)

      associate (first => self%first_block(record) + 1, last => self%first_block(record) + size(largest))
         largest = max(-self%lowest(first:last), self%highest(first:last))
      end associate
      associate (is_strong => largest >= strong*maxval(largest))
         strong_blocks = findloc(is_strong, .true., dim=1, back=.true.) - findloc(is_strong, .true., dim=1) + 1
      end associate
   end function strong_blocks

   !> Join the vertical components of records
   pure subroutine add_verticals(set, records)
      !> Samples of the records together
      type(record_set_type), intent(inout) :: set
      type(record_type), intent(in) :: records(:)

      real(wp) :: ignored
      integer :: i, j, k

      allocate (set%verticals(size(set%samples)), set%lowest_vertical(size(set%lowest)), source=0.0_wp)
      allocate (set%lowest_vertical_left(size(set%lowest)))
      do i = 1, size(records)
         associate (before => set%offset(i), n => set%length(i), first => set%first_block(i))
            if (allocated(records(i)%vertical)) set%verticals(before + 1:before + n) = records(i)%vertical
            do k = (n - 1)/block_size, 0, -1
               j = first + k + 1
               call compute_extremes(set%verticals(before + k*block_size + 1:before + min((k + 1)*block_size, n)), &
                  & set%lowest_vertical(j), ignored)
               set%lowest_vertical_left(j) = set%lowest_vertical(j)
               if (k < (n - 1)/block_size) set%lowest_vertical_left(j) = min(set%lowest_vertical(j), &
                  & set%lowest_vertical_left(j + 1))
            end do
         end associate
      end do
   end subroutine add_verticals

   !> The next sample that, scaled, lies outside a range
   pure integer function next_outside(self, record, first, scale, low, high) result(sample)
      class(record_set_type), intent(in) :: self
      !> Number of the record
      integer, intent(in) :: record
      !> Sample to begin with, from 1
      integer, intent(in) :: first
      !> Factor on the samples
      real(wp), intent(in) :: scale
      !> The range [m/s2]
      real(wp), intent(in) :: low, high

      integer :: block, i

      associate (before => self%offset(record), n => self%length(record), block_1 => self%first_block(record) + 1)
         sample = n + 1
         if (first > n) return
         ! What is left of the first block
         block = block_1 + (first - 1)/block_size
         if (is_outside(self%lowest(block)) .or. is_outside(self%highest(block))) then
            do i = first, min((block - block_1 + 1)*block_size, n)
               if (.not. is_outside(self%samples(before + i))) cycle
               sample = i
               return
            end do
         end if
         block = block + 1
         if (block > block_1 + (n - 1)/block_size) return
         if (.not. (is_outside(self%lowest_left(block)) .or. is_outside(self%highest_left(block)))) return
         ! There is one: the search always succeeds.
         do while (.not. (is_outside(self%lowest(block)) .or. is_outside(self%highest(block))))
            block = block + 1
         end do
         sample = (block - block_1)*block_size + 1
         do while (.not. is_outside(self%samples(before + sample)))
            sample = sample + 1
         end do
      end associate

   contains

      !> Does a sample lie outside? Multiplication keeps the order of samples, so that a block's extremes tell of all
      pure logical function is_outside(acceleration)
         !> Sample [m/s2]
         real(wp), intent(in) :: acceleration

         is_outside = scale*acceleration < low .or. scale*acceleration > high
      end function is_outside

   end function next_outside

   !> The next sample that, scaled, may lie outside a range that widens with the vertical component: none before it does. Whoever
   !> asks looks closer
   pure integer function next_outside_of_both(self, record, first, scale, trigger, widening, both_sides) result(sample)
      class(record_set_type), intent(in) :: self
      !> Number of the record, which has a vertical component
      integer, intent(in) :: record
      !> Sample to begin with, from 1
      integer, intent(in) :: first
      !> Factor on the samples; its sign is for the horizontal ones
      real(wp), intent(in) :: scale
      !> The range without vertical motion: it begins at minus this [m/s2]
      real(wp), intent(in) :: trigger
      !> What its ends move outwards by for a unit of vertical acceleration
      real(wp), intent(in) :: widening
      !> Does it end at the trigger? Otherwise it has no upper end
      logical, intent(in) :: both_sides

      ! Rounding must not hide a sample.
      real(wp), parameter :: margin = 1.0e-9_wp
      integer :: block

      sample = first
      do while (sample <= self%length(record))
         block = self%first_block(record) + (sample - 1)/block_size + 1
         if (may_be_outside(self%lowest(block), self%highest(block), self%lowest_vertical(block))) then
            do sample = sample, min(((sample - 1)/block_size + 1)*block_size, self%length(record))
               associate (a => self%samples(self%offset(record) + sample), v => self%verticals(self%offset(record) + sample))
                  if (may_be_outside(a, a, v)) return
               end associate
            end do
         else if (.not. may_be_outside(self%lowest_left(block), self%highest_left(block), &
            & self%lowest_vertical_left(block))) then
            exit
         else
            sample = ((sample - 1)/block_size + 1)*block_size + 1
         end if
      end do
      sample = self%length(record) + 1

   contains

      !> May samples lie outside?
      pure logical function may_be_outside(lowest, highest, vertical)
         !> The smallest and the largest of them, and the smallest vertical sample [m/s2]
         real(wp), intent(in) :: lowest, highest, vertical

         real(wp) :: limit

         limit = trigger + widening*abs(scale)*vertical
         limit = limit - margin*(trigger + abs(limit))
         may_be_outside = min(scale*lowest, scale*highest) < -limit &
            & .or. (both_sides .and. max(scale*lowest, scale*highest) > limit)
      end function may_be_outside

   end function next_outside_of_both

end module dondolo_record_set
