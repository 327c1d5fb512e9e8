!> The order of numbers by their size.
module dondolo_base_order
   use dondolo_base_invariant, only : assert, checked
   use dondolo_base_kinds, only : wp
   implicit none
   private

   public :: make_order

contains

   !> Order of numbers, from the smallest; equal ones stay in the order they stand in (merge sort from the bottom up)
   pure subroutine make_order(numbers, order)
      !> The numbers
      real(wp), intent(in) :: numbers(:)
      !> Their places, from that of the smallest
      integer, allocatable, intent(out) :: order(:)

      integer, allocatable :: merged(:), before(:)
      integer :: width, first, middle, last, i, j, k

      allocate (order(size(numbers)), merged(size(numbers)))
      do i = 1, size(order)
         order(i) = i
      end do
      width = 1
      do while (width < size(order))
         do first = 1, size(order), 2*width
            middle = min(first + width - 1, size(order))
            last = min(first + 2*width - 1, size(order))
            i = first
            j = middle + 1
            do k = first, last
               if (j > last) then
                  merged(k) = order(i)
                  i = i + 1
               else if (i > middle) then
                  merged(k) = order(j)
                  j = j + 1
               else if (numbers(order(j)) < numbers(order(i))) then
                  merged(k) = order(j)
                  j = j + 1
               else
                  merged(k) = order(i)
                  i = i + 1
               end if
            end do
         end do
         call move_alloc(order, before)
         call move_alloc(merged, order)
         call move_alloc(before, merged)
         width = 2*width
      end do
      if (checked) call assert(.not. any(numbers(order(2:)) < numbers(order(:size(order) - 1))), 'sorted numbers do not fall')
   end subroutine make_order

end module dondolo_base_order
