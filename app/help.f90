!> What --help prints.
module dondolo_help
   use, intrinsic :: iso_fortran_env, only : output_unit
   implicit none
   private

   public :: print_help

   !> The page
   character(len=*), parameter :: page(*) = [character(len=110) :: &
      & 'dondolo: fragility of masonry walls that rock and overturn in earthquakes', &
      & '', &
      & '   dondolo CASE.nml             run a case and write its result files; also dondolo run CASE.nml', &
      & '   dondolo --check CASE.nml     check the case and all its files, say what would run, run nothing', &
      & '   dondolo --walls A:B CASE.nml run rows A to B of a population only, into a file of counts', &
      & '   dondolo --merge CASE.nml COUNTS ...', &
      & '                                merge part files and write the result files', &
      & '   dondolo --status OUTPUT ...  from another terminal: who runs, how far, what time is left', &
      & '   dondolo --template [TASK]    print a commented case for a task: stripes (default), history, typology', &
      & '   dondolo --example NAME       print a ready case, parapet for example, that finds its records anywhere', &
      & '   dondolo --benchmark [S]      measure the speed on 1, 2, 4 ... threads, S seconds (1) each on one', &
      & '   dondolo --completion SHELL   print the completion for bash or zsh: eval "$(dondolo --completion bash)"', &
      & '   dondolo --version            print the version, and the build variant for this processor', &
      & '   dondolo --help               print this page', &
      & '', &
      & 'Commands of the Python package, where it is installed (dondolo plot --help says more of each):', &
      & '   dondolo plot PREFIX          draw the figures of a run from its result files', &
      & '   dondolo report PREFIX        write a report of a run: one HTML file; with --pdf, PDF', &
      & '   dondolo xlsx PREFIX          write its tables into a workbook of Excel or LibreOffice', &
      & '   dondolo nrml PREFIX          write its curves for OpenQuake', &
      & '   dondolo records CATALOGUE    print a table of the records of a catalogue', &
      & '   dondolo catalogue FOLDER     make a catalogue of the accelerograms in a folder', &
      & '', &
      & 'Options of a run or a benchmark:', &
      & '   --threads N   number of threads instead of the case''s, most of a benchmark; 0: all, or OMP_NUM_THREADS', &
      & '   --quiet       print warnings and errors only; of a benchmark, its figure of merit', &
      & '', &
      & 'A case is a Fortran namelist file:', &
      & '   &job          what is to be done: ''stripes'', ''history'' or ''typology''; where the results go', &
      & '   &wall         the wall (tasks stripes and history)', &
      & '   &building     the building whose motion shakes it, if it does not stand on the ground', &
      & '   &population   a table of walls (task typology)', &
      & '   &uncertainty  what of one wall is uncertain, instead of a table of walls (task typology)', &
      & '   &records      the catalogue of accelerograms', &
      & '   &stripes      the intensity measure and its levels (tasks stripes and typology)', &
      & '   &solver       tolerances and the rotation that counts as collapse', &
      & '   &history      which record, and how strong (task history)', &
      & '   &check        the site of a check by NTC 2018 beside the curves', &
      & 'Groups &stripes and &history are allowed in any case: a task checks both and uses what it needs, so that', &
      & 'one file serves to run the stripes of a wall and to look at one of its histories.', &
      & 'Paths in a case are relative to the case, those of the results to the current folder.', &
      & '', &
      & 'A population runs in blocks, and a checkpoint, OUTPUT.checkpoint, grows with them: a run that was killed', &
      & 'goes on where it was when it is started again. At the end the checkpoint is removed.', &
      & '', &
      & 'One run at a time writes an OUTPUT; its files are published at once, when all are whole.', &
      & '', &
      & 'Exit code: 0 done; 1 failed while running; 2 wrong input, or another run is writing the output (nothing is', &
      & 'run or written then). Ctrl-C, SIGTERM and SIGHUP end a run in order, with its checkpoint, and then the', &
      & 'process by the signal (130, 143 and 129 in a shell); a second signal ends it at once.']

contains

   !> Print the page
   subroutine print_help()

      integer :: i

      do i = 1, size(page)
         write (output_unit, '(a)') trim(page(i))
      end do
   end subroutine print_help

end module dondolo_help
