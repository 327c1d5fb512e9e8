!> What --completion prints: how a shell completes the command line of dondolo.
module dondolo_completion
   use, intrinsic :: iso_fortran_env, only : output_unit
   use dondolo_arguments, only : option_names
   use dondolo_case_job_group, only : task_names
   use dondolo_example, only : example_names
   use dondolo_front_door, only : python_commands
   implicit none
   private

   public :: print_completion

contains

   !> Print a script that a shell reads at its start
   subroutine print_completion(shell)
      !> One of `shell_names`
      character(len=*), intent(in) :: shell

      ! Zsh understands the functions of bash after bashcompinit.
      if (shell == 'zsh') call print_line('autoload -Uz compinit bashcompinit && compinit && bashcompinit')
      call print_line('_dondolo() {')
      call print_line('   local word=${COMP_WORDS[COMP_CWORD]} before=${COMP_WORDS[COMP_CWORD-1]} words=')
      call print_line('   case $before in')
      call print_line('      --template) words="'//spaced(task_names)//'" ;;')
      call print_line('      --example) words="'//spaced(example_names)//'" ;;')
      call print_line('      --completion) words="bash zsh" ;;')
      call print_line('      *)')
      call print_line('         [[ $word == -* ]] && words="'//spaced(option_names)//'"')
      call print_line('         ((COMP_CWORD == 1)) && words+=" run '//spaced(python_commands)//'" ;;')
      call print_line('   esac')
      call print_line('   COMPREPLY=($(compgen -W "$words" -- "$word"))')
      call print_line('   ((${#COMPREPLY[@]})) || COMPREPLY=($(compgen -f -X ''!*.nml'' -- "$word") $(compgen -d -- "$word"))')
      call print_line('}')
      call print_line('complete -o filenames -F _dondolo dondolo')
   end subroutine print_completion

   !> Words with a blank between them
   pure function spaced(words) result(text)
      !> Words, padded with blanks
      character(len=*), intent(in) :: words(:)
      !> All of them
      character(len=sum(len_trim(words)) + size(words) - 1) :: text

      integer :: i, at

      text = ''
      at = 1
      do i = 1, size(words)
         text(at:) = trim(words(i))
         at = at + len_trim(words(i)) + 1
      end do
   end function spaced

   !> Print a line
   subroutine print_line(line)
      !> The line
      character(len=*), intent(in) :: line

      write (output_unit, '(a)') line
   end subroutine print_line

end module dondolo_completion
