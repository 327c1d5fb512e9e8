"""What Python costs beyond Fortran: `python boundary.py RECORDS.csv`, of the installation that runs it.

The stripes of one wall under every record at 20 levels, by the executable and by `multiple_stripe`, counted in machine
instructions by valgrind: counts do not depend on what else the machine does. Of each program a run with one level more
is taken off from a run with many, so that the start of the programs, the reading of the records and their upload cancel.
Without valgrind the same is timed, in alternating pairs.
"""
