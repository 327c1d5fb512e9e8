"""Operations per second of the steps of the engine lanes, for each mechanism, from the executable's --benchmark."""

import re
import subprocess
from dataclasses import dataclass

#: Seconds of one measurement
LENGTH = 0.2

#: Multiplications and additions of the loop of peers/arithmetic.cpp, in 1e9
LOOP = 2.0 * 3.24e6 * 90.0 / 1e9


@dataclass(frozen=True)
class Report:
    """What --benchmark prints of the executable and its machine."""

    version: str
    processor: str
    compiler: str  # and its options, without folders
    variant: str
    rates: dict  # {mechanism: 1e9 operations per second}


def measured(executable):
    """Report of a short run on one thread."""
    command = [executable, "--benchmark", str(LENGTH), "--threads", "1"]
    return parse(subprocess.run(command, check=True, capture_output=True, text=True).stdout)


def parse(printed):
    """Read what --benchmark prints."""

    def found(pattern):
        return re.search(pattern, printed, re.MULTILINE).group(1).strip()

    rates = re.findall(r"^ +(\w+) +\d+ +([\d.]+) +[\d.]+$", printed, re.MULTILINE)
    return Report(
        found(r"^dondolo ([^,]+), benchmark"),
        found(r"^processor: (.*)"),
        f"{found('^compiler: (.*)')}, {' '.join(options(found('^options: (.*)')))}",
        found(r"^engine: lanes \((.*)\)"),
        {mechanism: float(rate) for mechanism, rate in rates},
    )


def options(words):
    """Options that change what is compiled: no folders, colours or warnings."""
    words = re.sub(r"-[IJ] +\S+", "", words).split()
    return [word for word in words if "/" not in word and not word.startswith(("-W", "-fdiagnostics"))]
