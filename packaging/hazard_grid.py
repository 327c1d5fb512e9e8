"""Write the hazard of NTC 2018, src/core/check/hazard_data.c, from a file of annex B of D.M. 14 January 2008.

Usage: python packaging/hazard_grid.py FILE [SOURCE]

FILE, which may be compressed by xz, has a line of integers for each node of table 1: ID, longitude and latitude (ED50)
[1e-6 deg], then a_g [1e-5 of g/10], F_0 [1e-4] and T_C* [1e-6 s] for each return period. The decree prints three
decimals, and so many are written.
"""

import hashlib
import lzma
import sys
from pathlib import Path

RETURN_PERIODS = 9
# What a_g, F_0 and T_C* have in the file / a unit of the third decimal
UNITS = (100, 10, 1000)
# Digits of numbers: characters of a text in C, without those that end it, or begin an escape or a trigraph. The last
# digit of a number is less than LAST, and those before it are not.
DIGITS = [chr(code) for code in range(35, 127) if chr(code) not in "?\\"]
LAST = 64
SOURCE = Path(__file__).parent.parent / "src/core/check/hazard_data.c"

HEAD = """\
/* The grid of seismic hazard that NTC 2018, 3.2 refers to: D.M. 14 January 2008, annex B, table 1 (Gazzetta
   Ufficiale n. 29 of 4 February 2008, S.O. 30), an official act. packaging/hazard_grid.py wrote this file, from
   numbers whose text has the sha256 {checksum}.

   A run is nodes whose IDs follow each other, from west to east: ID of the first, number of nodes, least and greatest
   latitude [1e-6 deg], and two texts of numbers. Of each node the first has longitude and latitude (ED50) [1e-6 deg],
   the second a_g [1e-3 of g/10], F_0 [1e-3] and T_C* [1e-3 s] for each return period, less those for the return period
   before. A number is the difference from that of the node before, of the first node from 0;
   dondolo_check_hazard_grid reads it. */
#include <string.h>

static const struct run {{
   int id, count, south, north;
   const char *places, *values;
}} runs[] = {{
"""

TAIL = """};

/* Number of runs */
int dondolo_hazard_runs(void)
{
   return (int)(sizeof runs / sizeof runs[0]);
}

/* A run, from 0: ID of its first node, number of nodes, and the latitudes that they lie between */
void dondolo_hazard_run(int number, int *id, int *count, int *south, int *north)
{
   const struct run *run = &runs[number];

   *id = run->id;
   *count = run->count;
   *south = run->south;
   *north = run->north;
}

/* The text of a run, of its places or its values, and its length */
const char *dondolo_hazard_text(int number, int is_of_values, int *length)
{
   const char *text = is_of_values ? runs[number].values : runs[number].places;

   *length = (int)strlen(text);
   return text;
}
"""


def encoded(number: int) -> str:
    """A number as digits: 0, 1, -1, 2, -2 ... are 0, 1, 2, 3, 4 ..."""
    rest, last = divmod(2 * number - 1 if number > 0 else -2 * number, LAST)
    text = DIGITS[last]
    while rest:
        rest, digit = divmod(rest - 1, len(DIGITS) - LAST)
        text = DIGITS[LAST + digit] + text
    return text


def differences(rows: list[list[int]]) -> str:
    """Rows of numbers, each as its difference from the row before."""
    before = [[0] * len(rows[0]), *rows[:-1]]
    pairs = (pair for both in zip(before, rows, strict=True) for pair in zip(*both, strict=True))
    return "".join(encoded(b - a) for a, b in pairs)


def literal(text: str) -> str:
    """A text in lines of C."""
    return "".join(f'\n   "{text[at : at + 112]}"' for at in range(0, len(text), 112))


def main(path: str, source: str | Path = SOURCE) -> None:
    """Write the source."""
    content = Path(path).read_bytes()
    if path.endswith(".xz"):
        content = lzma.decompress(content)
    places: dict[int, list[int]] = {}
    values: dict[int, list[int]] = {}
    for line in content.decode().splitlines():
        node, longitude, latitude, *numbers = map(int, line.split())
        assert len(numbers) == 3 * RETURN_PERIODS
        places[node] = [longitude, latitude]
        rounded = [(number + UNITS[i % 3] // 2) // UNITS[i % 3] for i, number in enumerate(numbers)]
        values[node] = [b - a for a, b in zip([0, 0, 0, *rounded[:-3]], rounded, strict=True)]
    runs: list[list[int]] = []
    for node in sorted(places):
        if not runs or node != runs[-1][-1] + 1:
            runs.append([])
        runs[-1].append(node)
    parts = [HEAD.format(checksum=hashlib.sha256(content).hexdigest())]
    for run in runs:
        texts = [literal(differences([of[node] for node in run])) for of in (places, values)]
        latitudes = [places[node][1] for node in run]
        parts.append(f"   {{{run[0]}, {len(run)}, {min(latitudes)}, {max(latitudes)},{texts[0]},{texts[1]}}},\n")
    Path(source).write_text("".join(parts) + TAIL, encoding="ascii", newline="\n")


if __name__ == "__main__":
    main(*sys.argv[1:])
