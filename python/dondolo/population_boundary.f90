!> Between the flat arguments of dondolo_f2py and populations: their store, which Python holds by a handle, and their curves.
module dondolo_population_boundary
   use, intrinsic :: iso_c_binding, only : c_double, c_f_pointer, c_int, c_intptr_t, c_loc, c_ptr
   use, intrinsic :: iso_fortran_env, only : int64
   use dondolo_boundary, only : split_lines
   use dondolo_error, only : error_type
   use dondolo_fragility, only : status_names
   use dondolo_lines, only : lines_type
   use dondolo_population_counts, only : new_population_counts, population_counts_type
   use dondolo_roster, only : number_of_group, roster_row_type, roster_type
   use dondolo_row_result, only : row_result_type, shape_type
   use dondolo_store, only : store_type
   use dondolo_store_format, only : bytes_of_entry, pack_entry
   use dondolo_wall, only : mechanism_names
   implicit none
   private

   public :: hold_store, store_of, release_store, pack_block, bytes_of_integers, new_population, set_curves

contains

   !> Hold a store for Python
   subroutine hold_store(store, handle)
      !> The store; its contents are copied
      type(store_type), intent(in) :: store
      !> Its address
      integer(c_intptr_t), intent(out) :: handle

      type(store_type), pointer :: held

      allocate (held)
      held = store
      handle = transfer(c_loc(held), handle)
   end subroutine hold_store

   !> The store that Python holds
   function store_of(handle) result(store)
      !> Its address
      integer(c_intptr_t), intent(in) :: handle
      !> The store
      type(store_type), pointer :: store

      type(c_ptr) :: address

      address = transfer(handle, address)
      call c_f_pointer(address, store)
   end function store_of

   !> Close a store and free it
   subroutine release_store(handle)
      !> Its address, which is of no use any more
      integer(c_intptr_t), intent(in) :: handle

      type(store_type), pointer :: store

      store => store_of(handle)
      call store%close()
      deallocate (store)
   end subroutine release_store

   !> Rows as integers that a store takes, from wherever they were computed
   subroutine pack_block(rows, shape, integers)
      !> The rows
      type(row_result_type), intent(in) :: rows(:)
      !> How many numbers there are of a row
      type(shape_type), intent(in) :: shape
      !> The bytes of the rows, zeros behind them
      integer(c_int), allocatable, intent(out) :: integers(:)

      character(len=:), allocatable :: bytes
      integer(int64) :: at, length
      integer :: i

      length = 0
      do i = 1, size(rows)
         length = length + bytes_of_entry(shape, rows(i)%histories)
      end do
      allocate (character(len=(length + 3)/4*4) :: bytes)
      bytes(length + 1:) = repeat(achar(0), len(bytes) - int(length))
      at = 0
      do i = 1, size(rows)
         length = bytes_of_entry(shape, rows(i)%histories)
         call pack_entry(rows(i), bytes(at + 1:at + length))
         at = at + length
      end do
      integers = transfer(bytes, [0_c_int])
   end subroutine pack_block

   !> The bytes of integers
   subroutine bytes_of_integers(integers, bytes)
      !> Integers
      integer(c_int), intent(in) :: integers(:)
      !> Bytes
      character(len=:), allocatable, intent(out) :: bytes

      allocate (character(len=4*size(integers, kind=int64)) :: bytes)
      bytes = transfer(integers, bytes)
   end subroutine bytes_of_integers

   !> A population with the counts of one damage state, without curves
   subroutine new_population(population, texts, levels, collapses, histories, shares, rows, error)
      !> The population
      type(population_counts_type), intent(out) :: population
      !> Two lines a row: mechanism and group
      character(len=*), intent(in) :: texts
      !> Levels of intensity
      real(c_double), intent(in) :: levels(:)
      !> Histories that reach the state (levels, rows)
      integer(c_int), intent(in) :: collapses(:, :)
      !> Histories of each stripe (levels, rows)
      integer(c_int), intent(in) :: histories(:, :)
      !> Weight of the wall and probability that the mechanism can occur (2, rows)
      real(c_double), intent(in) :: shares(:, :)
      !> How many rows each wall has
      integer(c_int), intent(in) :: rows(:)
      !> Lack of memory
      type(error_type), allocatable, intent(out) :: error

      type(roster_type) :: roster
      type(lines_type) :: words
      integer :: i, first, group

      call split_lines(texts, words)
      roster%count = size(histories, 2)
      allocate (roster%row(roster%count))
      do i = 1, roster%count
         group = 0
         associate (name => words%line(2*i)%text)
            if (len(name) > 0) then
               group = number_of_group(roster%groups, name)
               if (group == 0) then
                  call roster%groups%add(name)
                  group = roster%groups%count
               end if
            end if
         end associate
         roster%row(i) = roster_row_type(.true., findloc(mechanism_names == words%line(2*i - 1)%text, .true., dim=1), &
            & group, shares(1, i), shares(2, i))
      end do
      first = 1
      do i = 1, size(rows)
         roster%row(first)%continues = .false.
         first = first + rows(i)
      end do
      call new_population_counts(population, roster, levels, 1, error)
      if (allocated(error)) return
      population%histories = histories
      population%reached(:, 1, :) = collapses
   end subroutine new_population

   !> Set the curves of the rows of a population: those that were fitted to it before
   subroutine set_curves(population, curves, statuses)
      !> The population
      type(population_counts_type), intent(inout) :: population
      !> Their numbers, of which theta and beta come first (8, rows)
      real(c_double), intent(in) :: curves(:, :)
      !> Places of their statuses among the names
      integer(c_int), intent(in) :: statuses(:)

      integer :: i

      do i = 1, size(statuses)
         population%curve(1, i)%status = status_names(statuses(i))
         population%curve(1, i)%theta = curves(1, i)
         population%curve(1, i)%beta = curves(2, i)
      end do
   end subroutine set_curves

end module dondolo_population_boundary
