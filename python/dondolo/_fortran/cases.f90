!> Case files.
module cases
   use, intrinsic :: iso_c_binding, only : c_double, c_int64_t
   use dondolo_boundary, only : check_room
   use dondolo_case, only : case_type
   use dondolo_read_case, only : load_case => read_case
   use dondolo_error, only : error_type
   use dondolo_parcel, only : parcel_type, send
   use dondolo_member, only : member_type
   use dondolo_population_reader, only : read_rows
   use dondolo_record_parcel, only : pack_records
   use dondolo_result_tables, only : table_suffixes
   use dondolo_wall_parcel, only : pack_members
   implicit none
   private

   public :: read_case, result_tables

contains

   !> Read a case. Integers: number of walls, of levels, of records, of EDP thresholds, threads, record of the history from
   !> 1, number of values of ag, of f0 and of tc_star of a check, 0 without one, then walls and records as they are packed;
   !> reals: rtol, atol, edp_limit, 1 where errors are to be estimated, scale of the history (with its sign), levels,
   !> thresholds, the values of the check with its confidence and behaviour factors, then walls with their weights and
   !> probabilities, and records; text: task, title, output, im, polarity, engine, states, soil and topography of the check,
   !> then walls, their groups and facades, and records, and how its tables were read, where there is something to say of it
   subroutine read_case(path, sent)
      character(len=*), intent(in) :: path
      integer(c_int64_t), intent(out) :: sent(5)
      type(case_type) :: case
      type(member_type), allocatable :: members(:)
      type(parcel_type) :: parcel
      type(error_type), allocatable :: error
      real(c_double) :: scale
      integer :: i

      call load_case(path, case, error)
      if (.not. allocated(error)) then
         if (case%job%task == 'typology') then
            call read_rows(case%table, members, error)
         else
            allocate (members(1))
            members(1)%wall = case%wall
            members(1)%group = ''
            members(1)%facade = ''
         end if
      end if
      if (.not. allocated(error)) call check_room(error, walls=size(members))
      if (.not. allocated(error)) then
         if (.not. allocated(case%stripes%levels)) allocate (case%stripes%levels(0))
         scale = 1
         if (case%job%task == 'history') scale = case%history_scale()
         parcel%integers = [size(members), size(case%stripes%levels), size(case%suite%records), &
            & size(case%stripes%thresholds), case%job%threads, case%history%record, 0, 0, 0, merge(1, 0, case%designs)]
         parcel%reals = [case%solver%solver%rtol, case%solver%solver%atol, case%solver%solver%edp_limit, &
            & count([case%solver%solver%estimate_error, case%solver%solver%certify])*1.0_c_double, scale, case%stripes%levels, &
            & case%stripes%thresholds]
         call parcel%lines%add(case%job%task)
         call parcel%lines%add(case%job%title)
         call parcel%lines%add(case%job%output)
         call parcel%lines%add(case%stripes%scaling%name)
         call parcel%lines%add(case%records_input%polarity)
         call parcel%lines%add(trim(case%solver%solver%engine))
         call parcel%lines%add(case%stripes%states)
         call pack_check(case, parcel)
         call pack_members(members, parcel)
         call pack_records(case%suite%records, parcel, error)
         do i = 1, case%notes%count
            call parcel%lines%add(case%notes%line(i)%text)
         end do
      end if
      call send(parcel, error, sent)
   end subroutine read_case

   !> What the names of the tables of results end with, of any case: a line each
   subroutine result_tables(sent)
      integer(c_int64_t), intent(out) :: sent(5)
      type(parcel_type) :: parcel
      type(error_type), allocatable :: error
      integer :: i

      associate (suffixes => table_suffixes())
         do i = 1, size(suffixes)
            call parcel%lines%add(trim(suffixes(i)))
         end do
      end associate
      call send(parcel, error, sent)
   end subroutine result_tables

   !> Add the check of a case
   subroutine pack_check(case, parcel)
      type(case_type), intent(in) :: case
      !> Its integers 7 to 9 are set, reals and two lines added
      type(parcel_type), intent(inout) :: parcel

      if (.not. allocated(case%check)) then
         call parcel%lines%add('')
         call parcel%lines%add('')
         return
      end if
      associate (check => case%check)
         parcel%integers(7:9) = [size(check%ag), size(check%f0), size(check%tc_star)]
         call parcel%add(real([check%ag, check%f0, check%tc_star, check%confidence, check%behaviour], c_double))
         call parcel%lines%add(check%soil)
         call parcel%lines%add(check%topography)
      end associate
   end subroutine pack_check

end module cases
