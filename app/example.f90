!> What --example prints: a ready case that finds its files wherever it is saved.
module dondolo_example
   use, intrinsic :: iso_fortran_env, only : int64, output_unit
   use dondolo_base_error, only : error_type, raise_missing
   use dondolo_files_process, only : own_folder
   use dondolo_files_system, only : file_exists
   use dondolo_files_text_file, only : read_text_file, text_file_type
   implicit none
   private

   public :: example_names, find_installed, print_example, substitute

   !> The cases in data/cases
   character(len=*), parameter :: example_names(*) = [character(len=19) :: &
      & 'arch', 'cavity_wall', 'compound', 'corner', 'designs', 'elastic_strip', 'elevation', 'facade', &
      & 'facade_hinges', 'facade_strip', 'facades', 'frame', 'gable', 'garden_wall', 'historic_centre', 'history', &
      & 'horizontal', 'panel', 'parapet', 'parapet_on_building', 'pinnacle', 'population', 'portal', 'storey_strip', &
      & 'tied_facade', 'tied_portal', 'two_block', 'uncertain_strip']

   !> How the cases say that they run from the repository
   character(len=*), parameter :: from_repository = 'from the root of the repository: dondolo data/cases/'

   !> Bytes of a case, more than any has
   integer(int64), parameter :: longest = 1000000_int64

contains

   !> Print a ready case. Its paths, relative to the folder of the cases, become absolute
   subroutine print_example(name, error)
      !> One of `example_names`
      character(len=*), intent(in) :: name
      !> The examples are not installed
      type(error_type), allocatable, intent(out) :: error

      type(text_file_type) :: text
      character(len=:), allocatable :: folder, file, line
      integer :: i

      call find_installed(folder)
      file = folder//'cases/'//name//'.nml'
      if (.not. file_exists(file)) then
         call raise_missing(error, '--example: '//file//': no such file; the examples come with an installation by pip')
         return
      end if
      call read_text_file(file, text, error, longest)
      if (allocated(error)) return
      do i = 1, text%lines()
         line = text%line(i)
         call substitute(line, from_repository, 'dondolo ')
         call substitute(line, '''../', ''''//folder)
         write (output_unit, '(a)') line
      end do
   end subroutine print_example

   !> Where an installation has cases, records and walls, with a slash at the end
   subroutine find_installed(folder)
      !> Folder, which exists only in an installation
      character(len=:), allocatable, intent(out) :: folder

      call own_folder(folder)
      ! bin and share are side by side.
      folder = folder(:max(index(folder, '/', back=.true.), 1))//'share/dondolo/'
   end subroutine find_installed

   !> Put something else in the place of a part, where a line has it
   pure subroutine substitute(line, part, by)
      !> Line
      character(len=:), allocatable, intent(inout) :: line
      !> Part to look for, and what to put in its place
      character(len=*), intent(in) :: part, by

      integer :: at

      at = index(line, part)
      if (at > 0) line = line(:at - 1)//by//line(at + len(part):)
   end subroutine substitute

end module dondolo_example
