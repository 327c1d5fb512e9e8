"""The best setting of every program in turns, for ratios of times.

Each round runs them one after the other, so that a machine that slows down affects all of them, and the spread of the
ratios over the rounds shows how sure they are.
"""

import csv
import statistics
import subprocess
from dataclasses import asdict, dataclass, fields

from programs import BUILD, DONDOLO, PEERS, run_dondolo, say

SHARE, WRONG = 0.01, 1  # acceptable share of histories with an error above 1e-6, acceptable number of wrong flags
SLOW = 20.0  # seconds: a program that needs more for its histories is not run again in every round

#: What is measured beside the programs of `programs.csv`
COLD, LIMIT = "dondolo, executable, cold", "arithmetic limit"


@dataclass(frozen=True)
class Turn:
    """Time of one program in one round."""

    round: int
    name: str  # program and method, or COLD or LIMIT
    setting: float
    ms: float  # all histories


def acceptable(result):
    """Whether a setting is accurate enough to be compared."""
    return result.share <= SHARE and result.flags <= WRONG


def chosen(results):
    """Cheapest acceptable setting of a program, or the one with the fewest errors."""
    good = [each for each in results if acceptable(each)]
    if good:
        return min(good, key=lambda each: each.ms_of_all)
    return min(results, key=lambda each: (each.flags / each.histories + each.share, each.ms_of_all))


def by_program(results):
    """Results as {program: results}, in their order."""
    found = {}
    for each in results:
        found.setdefault(each.program, []).append(each)
    return found


def contestants(results):
    """Dondolo's engines by default and the tight one, and the chosen setting of each other program."""
    own = [each for each in results if each.program == DONDOLO.name]
    found = [each for each in own if each.setting == 1e-8 or (each.method, each.setting) == ("lanes", 1e-12)]
    return found + [chosen(several) for name, several in by_program(results).items() if name != DONDOLO.name]


def alternate(executable, problem, results, path, case, rounds):
    """Run the contestants in turns; return the times of all rounds."""
    peers = {peer.name: peer for peer in (DONDOLO, *PEERS)}
    turns = []
    for number in range(1, rounds + 1):
        for each in contestants(results):
            if each.seconds > SLOW and number > 1:
                continue
            peer = peers[each.program]
            every = len(problem) * peer.part // 880 or 1
            # The first repeat warms up, but for programs that would take too long
            repeats = 2 if each.seconds < 1.0 else 1
            place = case if peer.takes_case else path
            command = [*peer.command, place, each.method.split(",")[0], each.setting, repeats, every]
            seconds = last_second(command)
            ms = 1e3 * seconds * (each.ms_of_all / each.ms) * (len(problem) / each.histories)
            turns.append(Turn(number, each.name, each.setting, ms))
        cold = run_dondolo(executable, problem.wall, problem.motions, 1e-8, "lanes", 1)
        turns.append(Turn(number, COLD, 1e-8, 1e3 * cold[0]))
        if (BUILD / "arithmetic").is_file():
            turns.append(Turn(number, LIMIT, 0.0, 1e3 * last_second([BUILD / "arithmetic", 3])))
        say(f"round {number} of {rounds}")
    return turns


def last_second(command):
    """Seconds of the last repeat of a program."""
    done = subprocess.run([str(word) for word in command], check=True, capture_output=True, text=True)
    return [float(line.split()[1]) for line in done.stdout.splitlines() if line.startswith("seconds ")][-1]


def times_of(turns, name, setting):
    """Milliseconds of a program in each round, as {round: ms}."""
    return {turn.round: turn.ms for turn in turns if turn.name == name and turn.setting == setting}


def ratio(turns, over, under):
    """Median, least and largest ratio of the times of two programs (name, setting) over the rounds that both ran in."""
    top, bottom = times_of(turns, *over), times_of(turns, *under)
    ratios = [top[each] / bottom[each] for each in sorted(top.keys() & bottom.keys())]
    return statistics.median(ratios), min(ratios), max(ratios), len(ratios)


def write_rounds(path, turns):
    """Write the times of all rounds."""
    with open(path, "w", newline="", encoding="utf-8") as file:
        writer = csv.DictWriter(file, [field.name for field in fields(Turn)])
        writer.writeheader()
        writer.writerows(asdict(turn) for turn in turns)


def read_rounds(path):
    """Read the times of all rounds."""
    with open(path, newline="", encoding="utf-8") as file:
        return [
            Turn(int(row["round"]), row["name"], float(row["setting"]), float(row["ms"]))
            for row in csv.DictReader(file)
        ]
