!> Write the synthetic suite: `dondolo-synthetic44 [folder]` makes synthetic44.csv and synthetic44/ in a folder,
!> data/records unless given; the folder synthetic44 must exist.
program synthetic44_program
   use, intrinsic :: iso_fortran_env, only : error_unit
   use dondolo_base_error, only : error_type
   use dondolo_base_kinds, only : wp
   use dondolo_base_text, only : to_text
   use dondolo_record, only : record_type
   use dondolo_record_synthetic_suite, only : scenario_type, suite_record, synthetic44
   implicit none

   !> Decimals of the files [m/s2]: half a unit of the last is below 1e-9 of any peak above 0.05 m/s2
   integer, parameter :: decimals = 10

   character(len=*), parameter :: name = 'synthetic44'
   character(len=:), allocatable :: folder, file
   type(scenario_type) :: chosen
   type(record_type) :: record
   type(error_type), allocatable :: error
   integer :: catalogue, scenario, component, length

   call get_command_argument(1, length=length)
   allocate (character(len=length) :: folder)
   if (length > 0) call get_command_argument(1, folder)
   if (length == 0) folder = 'data/records'
   open (newunit=catalogue, file=folder//'/'//name//'.csv', action='write')
   write (catalogue, '(a)') &
      & '# Synthetic accelerograms (no recordings), model of Sabetta and Pugliese (1996): see dondolo_synthetic', &
      & 'file,dt_s,units,format,event,magnitude,distance_km,site,component,pga_m_s2'
   do scenario = 1, size(synthetic44)
      chosen = synthetic44(scenario)
      do component = 1, 2
         call suite_record(scenario, component, record, error)
         if (allocated(error)) then
            write (error_unit, '(a)') 'dondolo-synthetic44: '//error%message
            error stop 1, quiet=.true.
         end if
         file = name//'/'//record%name//'.txt'
         call write_column(folder//'/'//file, record%acceleration)
         write (catalogue, '(*(a))') file, ',', to_text(record%dt), ',m/s2,synthetic,', trim(chosen%name), ',', &
            & to_text(chosen%magnitude), ',', to_text(chosen%distance), ',', trim(chosen%site), ',', &
            & record%name(len(record%name):), ',', to_text(anint(1.0e4_wp*record%pga())/1.0e4_wp)
      end do
   end do
   close (catalogue)

contains

   !> Write values, one a line
   subroutine write_column(file, values)
      !> Path of the file
      character(len=*), intent(in) :: file
      !> Values
      real(wp), intent(in) :: values(:)

      character(len=32) :: layout, line
      integer :: unit, i

      open (newunit=unit, file=file, action='write')
      write (layout, '(a, i0, a)') '(f24.', decimals, ')'
      do i = 1, size(values)
         write (line, layout) values(i)
         write (unit, '(a)') trim(adjustl(line))
      end do
      close (unit)
   end subroutine write_column

end program synthetic44_program
