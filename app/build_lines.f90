!> What --version --verbose prints: all of the build and the machine that may explain a difference between two.
module dondolo_build_lines
   use, intrinsic :: iso_fortran_env, only : compiler_version, output_unit
   use dondolo_base_kinds, only : wp
   use dondolo_base_lapack, only : lapack_version
   use dondolo_files_version, only : build_commit
   use dondolo_machine, only : processor_name, surroundings
   use dondolo_motion_lane_variants, only : engine_options
   implicit none
   private

   public :: print_build

contains

   !> Print it
   subroutine print_build()

      character(len=:), allocatable :: options

      call engine_options(options)
      call print_line('commit', build_commit())
      call print_line('compiler', compiler_version())
      call print_line('options', options)
      write (output_unit, '(a, i0, a)') 'reals: ', storage_size(1.0_wp), ' bits'
      call print_line('LAPACK', lapack_version())
      call print_line('processor', processor_name())
      call print_line('machine', surroundings())
   end subroutine print_build

   !> Print a line
   subroutine print_line(name, value)
      !> What it is
      character(len=*), intent(in) :: name
      !> Its value
      character(len=*), intent(in) :: value

      write (output_unit, '(a)') name//': '//trim(value)
   end subroutine print_line

end module dondolo_build_lines
