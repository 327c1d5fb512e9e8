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
      & '   dondolo --check CASE.nml     check the case and all its files and print what would run; run nothing', &
      & '   dondolo --walls A:B CASE.nml run rows A to B of a population only, into a file of counts', &
      & '   dondolo --merge CASE.nml COUNTS ...', &
      & '                                merge part files and write the result files', &
      & '   dondolo --status OUTPUT ...  print, from another terminal, the progress of a run and the time left', &
      & '   dondolo --template [TASK]    print a commented case for a task: stripes (default), history, typology', &
      & '   dondolo --example NAME       print a ready case, parapet for example, that finds its records anywhere', &
      & '   dondolo --benchmark [S]      measure the speed on 1, 2, 4 ... threads, S seconds (1) each on one', &
      & '   dondolo --completion SHELL   print the completion for bash or zsh: eval "$(dondolo --completion bash)"', &
      & '   dondolo --cite [CASE.nml]    print BibTeX of dondolo and the paper, and of the sources that a case uses', &
      & '   dondolo --version            print the version and build variant for this processor; with --verbose also', &
      & '                                commit, compiler, libraries and processor, for a question or an issue', &
      & '   dondolo --help               print this page', &
      & '', &
      & 'Commands of the Python package, if it is installed (dondolo plot --help prints the options of plot):', &
      & '   dondolo plot PREFIX          draw the figures of a run from its result files', &
      & '   dondolo report PREFIX        write a report of a run, in English or Italian, as HTML, Word or PDF', &
      & '   dondolo relazione PREFIX ... write a calculation report, in Italian or English, as Word, HTML or PDF', &
      & '   dondolo xlsx PREFIX          write the tables of a run into a workbook of Excel or LibreOffice', &
      & '   dondolo nrml PREFIX          write the curves of a run for OpenQuake', &
      & '   dondolo openquake PREFIX DIR write a job of OpenQuake for the walls of a run: damage and losses of a town', &
      & '   dondolo diff OLD NEW         compare two runs, and say which change of dondolo explains it', &
      & '   dondolo records CATALOGUE    print a table of the records of a catalogue', &
      & '   dondolo catalogue FOLDER     make a catalogue of the accelerograms in a folder', &
      & '   dondolo serve [CASE.nml]     show a wall in the browser: its curve moves with the sliders', &
      & '', &
      & 'Options of a run or a benchmark:', &
      & '   --threads N   number of threads, instead of the case''s; of a benchmark the most; 0: all, or OMP_NUM_THREADS', &
      & '   --quiet       print only warnings and errors; of a benchmark, only its figure of merit', &
      & '', &
      & 'A case is a Fortran namelist file:', &
      & '   &job          the task, ''stripes'', ''history'' or ''typology'', and the prefix of the result files', &
      & '   &wall         the wall (tasks stripes and history)', &
      & '   &building     the building that the wall stands on, if not on the ground', &
      & '   &population   a table of walls (task typology)', &
      & '   &uncertainty  distributions of properties of one wall, instead of a table of walls (task typology)', &
      & '   &records      the catalogue of accelerograms', &
      & '   &stripes      the intensity measure and its levels (tasks stripes and typology)', &
      & '   &solver       tolerances and the rotation that counts as collapse', &
      & '   &history      the record and its level (task history)', &
      & '   &check        the site of the checks by NTC 2018', &
      & '', &
      & 'E of masonry in Circolare 7/2019, Table C8.5.I, MPa, for young_modulus of free elements (in Pa); proposed is', &
      & 'the range from the mean to half of it, for cracks, as values assumed by the designer:', &
      & '   irregular stone, pebbles          690-1050     regular soft stone                1200-1620', &
      & '   roughly cut stone                1020-1440     squared stone blocks              2400-3300', &
      & '   split stone, well laid           1500-1980     solid bricks and lime mortar      1200-1800', &
      & '   irregular soft stone              900-1260     perforated bricks and cement      3500-5600', &
      & '', &
      & 'A case may have both &stripes and &history: both are checked and the task uses its own, so that one file', &
      & 'serves for the stripes of a wall and for one of its time histories.', &
      & 'Paths in a case are relative to its folder, those of results to the current folder.', &
      & '', &
      & 'A population runs in blocks that are added to a checkpoint, OUTPUT.checkpoint, from which a killed run', &
      & 'resumes when it is started again. At the end the checkpoint is removed.', &
      & '', &
      & 'One run at a time may write to an OUTPUT; its files appear together, once all are complete.', &
      & '', &
      & 'Exit codes: 0 success; 1 failure while running; 2 invalid input, or another run is writing to the output', &
      & '(nothing is run or written then). Ctrl-C, SIGTERM and SIGHUP stop a run, keep its checkpoint and end the', &
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
