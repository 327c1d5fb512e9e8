!> Limits of sizes: what is larger is surely no input of dondolo, and is refused in one line that names the limit. A limit
!> is far beyond what anybody needs and bounds memory and time. docs/files.md lists them all.
module dondolo_base_limits
   use, intrinsic :: iso_fortran_env, only : int64
   implicit none
   private

   !> Bytes of a case
   integer(int64), parameter, public :: longest_case = 2_int64**20

   !> Words, values and signs in a case
   integer, parameter, public :: most_tokens = 200000

   !> Bytes of a file of accelerograms
   integer(int64), parameter, public :: longest_record_file = 2_int64**30

   !> Columns of a file of plain columns
   integer, parameter, public :: most_columns = 63

   !> Samples of an accelerogram
   integer, parameter, public :: most_samples = 10000000

   !> Bytes of a table
   integer(int64), parameter, public :: longest_table = 2_int64**31 - 1

   !> Bytes of a line of a table, and of a cell over several lines
   integer, parameter, public :: longest_line = 2**20

   !> Cells of a row of a table
   integer, parameter, public :: most_cells = 10000

   !> Rows of a catalogue
   integer, parameter, public :: most_records = 100000

   !> Rows of a population
   integer, parameter, public :: most_walls = 10000000

   !> Numbers in a table of numbers, such as a hazard curve
   integer, parameter, public :: most_numbers = 1000000

   !> Bytes of a name, a title or a path
   integer, parameter, public :: longest_name = 1000

   !> Levels and EDP thresholds of a case
   integer, parameter, public :: most_levels = 1000, most_thresholds = 100

   !> Groups of a population
   integer, parameter, public :: most_groups = 64

end module dondolo_base_limits
