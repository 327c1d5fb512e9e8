"""The best setting of every program in turns, for ratios of times.

In a round each has one turn, so that a machine that slows down affects all of them. A program starts anew for every
turn, and the rounds come in groups at different times of the benchmark: the spread of the ratios shows what differs
from process to process, and what a machine does in the course of minutes.
"""

import csv
import statistics
import subprocess
import time
from dataclasses import asdict, dataclass, fields
from functools import partial
from operator import le

import arithmetic
from cores import Cores, additions
from programs import BUILD, DONDOLO, command_of, parse, peer_of, run_dondolo
from progress import say
from spread import Spread

SHARE, WRONG = 0.01, 1  # acceptable share of histories with an error above 1e-6, acceptable number of wrong flags
WORST = 2.0  # largest errors that differ by at most this factor are equal
ROUNDS, QUICK_ROUNDS = (3, 3, 3), (1, 1)  # of all programs in turns, in each of the groups
TURN = 0.3  # seconds: a program that needs less repeats its call until they are over, and the median counts
STILLNESS = 1e-3  # factor on the levels at which no history moves
SLOWEST = 20.0  # seconds: a program that needs more has no turns; the time of its settings counts

#: What is measured beside the programs of `programs.csv`
COLD, STILL, LIMIT = "dondolo, command, cold", "dondolo, call without motion", "arithmetic limit"
#: What the core of a turn has for it: milliseconds of 1e9 additions, and as own of 1e9 multiplications
CORE = "core"
#: Name of the turns of the engine's arithmetic for a mechanism: milliseconds of 1e9 operations
ARITHMETIC = "1e9 operations, "


@dataclass(frozen=True)
class Turn:
    """Time of one program in one round."""

    round: int  # 0: its setting alone, without rounds
    name: str  # program and method, or COLD, STILL, LIMIT, CORE or ARITHMETIC and a mechanism
    setting: float
    ms: float  # all histories
    own: float  # of it in the steps of a library called from Python, or in the histories of dondolo; 0: not known


def acceptable(result):
    """Whether a setting is accurate enough to be compared."""
    return result.share <= SHARE and result.flags <= WRONG


def cheapest(results):
    """Cheapest setting, None if there is none: the loosest of each method, and of these the fastest.

    Settings of a method often take the same steps, so that their times differ by chance, which is not to choose.
    """
    loosest = {}
    for each in results:
        loosest.setdefault(each.method, each)
    return min(loosest.values(), key=lambda each: each.ms_of_all, default=None)


def chosen(results):
    """Cheapest acceptable setting of a program, or the one with the fewest errors."""
    best = cheapest(filter(acceptable, results))
    return best or min(results, key=lambda each: (each.flags / each.histories + each.share, each.ms_of_all))


def by_program(results):
    """Results as {program: results}, in their order."""
    found = {}
    for each in results:
        found.setdefault(each.program, []).append(each)
    return found


def as_accurate(results, yardstick):
    """Cheapest setting of a program with no more errors than another result, None if there is none.

    The largest error is that of a history near collapse, which rounding alone changes: up to WORST is equal.
    """

    def errors(each, factor):
        return each.flags / each.histories, each.share, each.worst / factor

    return cheapest(each for each in results if all(map(le, errors(each, WORST), errors(yardstick, 1.0))))


def opponents(results):
    """Settings of the other programs that take turns, with names: the chosen one, and one as accurate as lanes."""
    lanes = next(each for each in results if (each.name, each.setting) == references(results)["lanes"])
    for program, several in by_program(results).items():
        if program != DONDOLO.name:
            best, accurate = chosen(several), as_accurate(several, lanes)
            yield program, best
            if accurate not in (None, best):
                yield f"{program}, as accurate", accurate


def contestants(results):
    """Dondolo's engines by default and the tight one, and the settings of the other programs that take turns."""
    own = references(results).values()
    found = [each for each in results if (each.name, each.setting) in own]
    return found + [each for _, each in opponents(results)]


class Rounds:
    """Programs that have their turns in every round."""

    def __init__(self, executable, problem, results, path, case):
        """Choose the contestants among the results; path and case are what they are called with."""
        self.executable, self.problem, self.case = executable, problem, case
        self.turns, self.number, self.cores = [], 0, Cores()
        self.programs = []  # (result, command)
        for each in contestants(results):
            peer = peer_of(each)
            if each.seconds > SLOWEST or not peer.waits:
                self.turns.append(self.turn(0, each, each.seconds, each.own))
                continue
            command = command_of(peer, case if peer.takes_case else path, each.method, each.setting, 0, problem)
            self.programs.append((each, command))

    def turn(self, number, result, seconds, own):
        """Turn of a program; of a part of the histories, scaled to all of them."""
        of_all = 1e3 * (result.ms_of_all / result.ms) * (len(self.problem) / result.histories)
        return Turn(number, result.name, result.setting, of_all * seconds, of_all * own)

    def group(self, rounds):
        """Run some rounds."""
        first = self.number + 1
        for number in range(first, first + rounds):
            self.number = number
            for each, command in self.programs:
                self.turns.append(self.turn(number, each, *self.taken(partial(calls_of, command))))
            arguments = (self.executable, self.problem.wall, self.problem.motions, 1e-8, "lanes", 1)
            (whole,), (histories,) = self.taken(partial(run_dondolo, *arguments))
            self.turns.append(Turn(number, COLD, 1e-8, 1e3 * whole, 1e3 * histories))
            still = self.taken(partial(still_seconds, self.case, self.problem))
            self.turns.append(Turn(number, STILL, 1e-8, 1e3 * still, 0.0))
            for mechanism, rate in self.taken(partial(arithmetic.measured, self.executable)).rates.items():
                self.turns.append(Turn(number, ARITHMETIC + mechanism, 0.0, 1e3 / rate, 0.0))
            if (BUILD / "arithmetic").is_file():
                self.turns.append(Turn(number, LIMIT, 0.0, 1e3 * self.taken(loop_seconds), 0.0))
            say(f"round {number}")

    def taken(self, take):
        """What a turn gives; what its core had for it is kept."""
        found, gauges = self.cores.turn(take)
        for each in gauges:
            self.turns.append(Turn(self.number, CORE, float(len(self.turns)), *(1e12 * seconds for seconds in each)))
        return found


def call(process):
    """One call of a program that waits: seconds, and those within its own steps."""
    process.stdin.write("\n")
    process.stdin.flush()
    own = 0.0
    for line in process.stdout:
        first, _, rest = line.partition(" ")
        if first == "own":
            own = float(rest)
        elif first == "seconds":
            return float(rest), own
    raise RuntimeError(f"a program of the rounds ended: {' '.join(map(str, process.args))}")


def calls_of(command):
    """Median of the calls of one turn, of a new process that is warm after a call that is not timed."""
    pipes = {"stdin": subprocess.PIPE, "stdout": subprocess.PIPE, "stderr": subprocess.DEVNULL}
    with subprocess.Popen(command, text=True, **pipes) as process:
        try:
            call(process)
            calls, start = [], time.monotonic()
            while not calls or time.monotonic() - start < TURN:
                calls.append(call(process))
        finally:
            process.kill()
    return tuple(map(statistics.median, zip(*calls, strict=True)))


def still_seconds(case, problem):
    """Median of the seconds of calls from Python, one after the other, of as many histories that never move."""
    command = [*command_of(DONDOLO, case, "lanes", 1e-8, 200, problem), str(STILLNESS)]
    done = subprocess.run(command, check=True, capture_output=True, text=True)
    _, seconds, _, rows = parse(done.stdout)
    if rows[:, 0].any():
        raise RuntimeError(f"{STILL}: a history moves")
    return statistics.median(seconds)


def loop_seconds():
    """Median of the seconds of the loop that shows what the processor can do."""
    done = subprocess.run([BUILD / "arithmetic", "20"], check=True, capture_output=True, text=True)
    return statistics.median(float(line.split()[1]) for line in done.stdout.splitlines())


def core_of(turns):
    """Spread of the additions that a core did in the time of a multiplication, None if they were not measured."""
    found = [additions(turn.ms, turn.own) for turn in turns if turn.name == CORE]
    return Spread.of(found) if found else None


def times_of(turns, name, setting, what="ms"):
    """Milliseconds of a program in each round, as {round: ms}."""
    return {turn.round: getattr(turn, what) for turn in turns if turn.name == name and turn.setting == setting}


def ratio(turns, over, under, what="ms"):
    """Spread of the ratio of the times of two programs (name, setting) over the rounds that both ran in.

    A program without rounds is compared with all rounds of the other.
    """
    top, bottom = times_of(turns, *over, what), times_of(turns, *under)
    if set(top) == {0}:
        top = dict.fromkeys(bottom, top[0])
    return Spread.of(top[each] / bottom[each] for each in top.keys() & bottom.keys())


def compared(results):
    """What the rounds compare, as (name, result, what): settings of other programs, or their libraries' own steps."""
    for name, best in opponents(results):
        yield name, best, "ms"
        if best.own > 0.0:
            yield f"{name}, own steps", best, "own"


def references(results):
    """Engines of dondolo that the others are compared with, as {name: (name, setting)}."""
    own = [each for each in results if each.program == DONDOLO.name]
    engines = {each.method: (each.name, each.setting) for each in own if each.setting == 1e-8}
    return engines | {"lanes, 1e-12": ("dondolo, lanes", 1e-12)}


def shares(turns):
    """Share of the limit of the processor's arithmetic that the steps reach, as {mechanism: spread}."""
    names = dict.fromkeys(turn.name for turn in turns if turn.name.startswith(ARITHMETIC))
    if not times_of(turns, LIMIT, 0.0):
        return {}
    return {
        name.removeprefix(ARITHMETIC): ratio(turns, (LIMIT, 0.0), (name, 0.0)).times(1.0 / arithmetic.LOOP)
        for name in names
    }


def write_rounds(path, turns):
    """Write the times of all rounds."""
    with open(path, "w", newline="", encoding="utf-8") as file:
        writer = csv.DictWriter(file, [field.name for field in fields(Turn)])
        writer.writeheader()
        writer.writerows(asdict(turn) for turn in turns)


def read_rounds(path):
    """Read the times of all rounds."""
    with open(path, newline="", encoding="utf-8") as file:
        return [Turn(**{f.name: f.type(row[f.name]) for f in fields(Turn)}) for row in csv.DictReader(file)]
