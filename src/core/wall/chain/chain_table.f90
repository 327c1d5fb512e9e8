!> A chain as a table of its terms (dondolo_wall_tabulated), at Chebyshev nodes from rest to a little beyond its capacity.
module dondolo_wall_chain_table
   use dondolo_base_kinds, only : pi, wp
   use dondolo_wall_chain, only : chain_type, motion_type
   use dondolo_wall_chain_check, only : chain_travel, chain_weights
   use dondolo_wall_chain_terms, only : chain_terms_type, set_at_rest, terms_at
   use dondolo_wall_tabulated, only : table_type
   implicit none
   private

   public :: chain_table_type, sample_chain

   !> Parts of the range at first and at last
   integer, parameter :: first_parts = 32, last_parts = 128

   !> The last coefficients of a series that is long enough / the largest
   real(wp), parameter :: small = 50.0_wp*epsilon(1.0_wp)

   !> Terms over the rotation, and what only checks need
   type :: chain_table_type
      type(table_type) :: terms
      !> Of each body and load weight [N] and displacement [m]; over the rotation d [m] and sum W x' [N m]
      real(wp), allocatable :: weight(:), displacement(:), travel(:), weighted_lever(:)
   end type chain_table_type

contains

   !> Sample a chain
   pure subroutine sample_chain(chain, last, table, is_smooth)
      class(chain_type), intent(in) :: chain
      !> Last rotation [rad]
      real(wp), intent(in) :: last
      type(chain_table_type), intent(out) :: table
      !> False: the terms change too fast near the end
      logical, intent(out) :: is_smooth

      type(motion_type) :: motion
      type(chain_terms_type) :: terms
      real(wp), allocatable :: columns(:, :)
      integer :: i, n

      call set_at_rest(chain, motion)
      call chain_weights(chain, motion, table%weight, table%displacement)
      n = first_parts
      do
         call set_at_rest(chain, motion)
         if (allocated(columns)) deallocate (columns)
         allocate (columns(0:n, 7))
         columns(:, 1) = [(last*sin(0.5_wp*pi*real(i, wp)/real(n, wp))**2, i=0, n - 1), last]
         is_smooth = .true.
         do i = 0, n
            call chain%move(columns(i, 1), motion, is_smooth)
            if (.not. is_smooth) return
            terms = terms_at(chain, motion)
            columns(i, 2:5) = [terms%inertia, terms%lever, terms%moment, terms%vertical_lever]
            call chain_travel(chain, table%weight, table%displacement, motion, columns(i, 6), columns(i, 7))
         end do
         is_smooth = all([(is_resolved(columns(:, i)), i=2, 7)])
         if (is_smooth .or. n >= last_parts) exit
         n = 2*n
      end do
      table%terms = table_type(columns(:, 1), columns(:, 2), columns(:, 3), columns(:, 4), columns(:, 5))
      table%travel = columns(:, 6)
      table%weighted_lever = columns(:, 7)
   end subroutine sample_chain

   !> Are the last coefficients of the series through values at the extrema of T_n small?
   pure logical function is_resolved(values)
      real(wp), intent(in) :: values(0:)

      real(wp) :: c(0:ubound(values, 1))
      integer :: i, k, n

      n = ubound(values, 1)
      do k = 0, n
         c(k) = sum([0.5_wp*values(0), values(1:n - 1), 0.5_wp*values(n)] &
            & *[(cos(pi*real(modulo(k*i, 2*n), wp)/real(n, wp)), i=0, n)])
      end do
      is_resolved = maxval(abs(c(n - 2:))) <= small*maxval(abs(c))
   end function is_resolved

end module dondolo_wall_chain_table
