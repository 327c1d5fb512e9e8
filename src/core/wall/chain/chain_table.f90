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
      real(wp), allocatable :: columns(:, :), before(:, :)
      integer :: i, n

      call set_at_rest(chain, motion)
      call chain_weights(chain, motion, table%weight, table%displacement)
      n = first_parts
      do
         call set_at_rest(chain, motion)
         allocate (columns(0:n, 7))
         columns(:, 1) = [(last*sin(0.5_wp*pi*real(i, wp)/real(n, wp))**2, i=0, n - 1), last]
         ! Every second node is one of the series before.
         if (allocated(before)) columns(::2, 2:) = before(:, 2:)
         is_smooth = .true.
         do i = 0, n
            if (allocated(before) .and. modulo(i, 2) == 0) cycle
            call sample_at(columns(i, :), motion, is_smooth)
            if (.not. is_smooth) return
         end do
         is_smooth = are_resolved(columns(:, 2:))
         if (is_smooth .or. n >= last_parts) exit
         n = 2*n
         call move_alloc(columns, before)
      end do
      table%terms = table_type(columns(:, 1), columns(:, 2), columns(:, 3), columns(:, 4), columns(:, 5))
      table%travel = columns(:, 6)
      table%weighted_lever = columns(:, 7)

   contains

      !> The terms at a rotation
      pure subroutine sample_at(row, motion, is_there)
         !> In: the rotation; out: with J, L, M, S, d and sum W x'
         real(wp), intent(inout) :: row(:)
         !> In: at a rotation nearby
         type(motion_type), intent(inout) :: motion
         !> False: the chain ends before
         logical, intent(out) :: is_there

         type(chain_terms_type) :: terms

         call chain%move(row(1), motion, is_there)
         if (.not. is_there) return
         terms = terms_at(chain, motion)
         row(2:5) = [terms%inertia, terms%lever, terms%moment, terms%vertical_lever]
         call chain_travel(chain, table%weight, table%displacement, motion, row(6), row(7))
      end subroutine sample_at

   end subroutine sample_chain

   !> Are the last coefficients of the series through values at the extrema of T_n small?
   pure logical function are_resolved(columns)
      !> A series a column
      real(wp), intent(in) :: columns(0:, :)

      real(wp), dimension(0:ubound(columns, 1)) :: c, halved
      real(wp) :: cosine(0:2*ubound(columns, 1) - 1)
      integer :: column, i, k, n

      n = ubound(columns, 1)
      cosine = [(cos(pi*real(i, wp)/real(n, wp)), i=0, 2*n - 1)]
      do column = 1, size(columns, 2)
         halved = columns(:, column)
         halved([0, n]) = 0.5_wp*halved([0, n])
         do k = 0, n
            c(k) = sum(halved*cosine([(modulo(k*i, 2*n), i=0, n)]))
         end do
         are_resolved = maxval(abs(c(n - 2:))) <= small*maxval(abs(c))
         if (.not. are_resolved) return
      end do
   end function are_resolved

end module dondolo_wall_chain_table
