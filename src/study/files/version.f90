!> The version of dondolo, the same as in fpm.toml, and the commit that was built.
module dondolo_files_version
   use, intrinsic :: iso_c_binding, only : c_char, c_size_t
   implicit none
   private

   public :: dondolo_version_text, build_commit

   !> Version
   character(len=*), parameter :: dondolo_version_text = '0.1.0'

   interface

      !> Write the commit; see commit.c
      subroutine write_commit(text, room) bind(c, name='dondolo_write_commit')
         import :: c_char, c_size_t
         !> The text
         character(kind=c_char), intent(out) :: text(*)
         !> Its length
         integer(c_size_t), value :: room
      end subroutine write_commit

   end interface

contains

   !> The commit that was built, with `-dirty` at its end if the sources differed from it; `unknown` outside a repository and in
   !> builds by fpm
   function build_commit() result(commit)
      !> Filled up with blanks
      character(len=48) :: commit

      call write_commit(commit, len(commit, c_size_t))
   end function build_commit

end module dondolo_files_version
