"""Campaigns of tests in data/experiments: what was measured, by whom, under which licence, and whether it is used."""

import csv
import hashlib
import json
from dataclasses import dataclass
from pathlib import Path

ROOT = Path(__file__).resolve().parents[2]
FOLDER = ROOT / "data/experiments"
STORED = FOLDER / "statistics.json"
#: Order of the page
NAMES = ("limestone", "elgawady", "granite", "sin01", "safego", "shakebot")
QUANTITIES = (
    "speed_ratio",
    "restitution_factor",
    "overturned",
    "stood",
    "peak_displacement",
    "base_shear",
    "onset_pga",
)
OUTCOMES = ("overturned", "stood")
COLUMNS = ("test", "specimen", "quantity", "measured", "motion", "scale", "pga", "pgv")
FACTS = ("title", "citation", "doi", "licence", "url", "sha256", "specimen", "measured", "motion", "split", "use")


@dataclass(frozen=True)
class Campaign:
    """A campaign of tests.

    Attributes
    ----------
    name : str
        Its folder.
    facts : dict
        What campaign.json says.
    tests : list of dict
        Rows of tests.csv as text; empty if the numbers are not in the repository.
    """

    name: str
    facts: dict
    tests: list

    @property
    def is_used(self) -> bool:
        """Whether it takes part; the reason is in `facts` if it does not."""
        return self.facts["use"] is True

    def files(self) -> list[Path]:
        """Its files, for their checksums."""
        return sorted((FOLDER / self.name).iterdir())


def read(name: str) -> Campaign:
    """Read a campaign and check it against the schema.

    Parameters
    ----------
    name : str
        Its folder in data/experiments.

    Returns
    -------
    Campaign

    Raises
    ------
    ValueError
        What of the schema does not hold, with file and row.
    """
    folder = FOLDER / name
    facts = json.loads((folder / "campaign.json").read_text(encoding="utf-8"))
    table = folder / "tests.csv"
    tests = []
    if table.is_file():
        with table.open(encoding="utf-8", newline="") as file:
            tests = list(csv.DictReader(file))
    campaign = Campaign(name, facts, tests)
    found = problems(campaign)
    if found:
        raise ValueError(f"{name}: {found[0]}")
    return campaign


def problems(campaign: Campaign) -> list[str]:
    """What of the schema does not hold for a campaign, one sentence each."""
    facts, found = campaign.facts, []
    if sorted(facts) != sorted(FACTS):
        found.append(f"campaign.json must have exactly {', '.join(FACTS)}")
        return found
    if facts["split"] not in ("open", "hold"):
        found.append(f"split = {facts['split']!r}: must be 'open' or 'hold'")
    if facts["use"] is not True and not (isinstance(facts["use"], str) and len(facts["use"].split()) > 5):
        found.append("use: must be true, or the reason why it is not used in a sentence")
    seen = set()
    for number, row in enumerate(campaign.tests, start=2):
        where = f"tests.csv, row {number}"
        missing = [column for column in (*COLUMNS, "note") if row.get(column) is None]
        if missing:
            found.append(f"{where}: has no column {missing[0]}")
            break
        if row["quantity"] not in QUANTITIES:
            found.append(f"{where}: quantity = {row['quantity']!r}: must be one of {', '.join(QUANTITIES)}")
        if row["quantity"] in OUTCOMES and row["measured"] not in ("", "0", "1"):
            found.append(f"{where}: measured = {row['measured']!r}: an outcome is 0, 1 or empty")
        if row["test"] in seen:
            found.append(f"{where}: test = {row['test']!r}: occurs before")
        seen.add(row["test"])
    return found


def distinct(tests: list) -> list:
    """Tests without exact duplicates, which their notes name."""
    return [row for row in tests if not row["note"].startswith("duplicate of ")]


def interval(text: str) -> tuple[float, float]:
    """Range of a field: a..b, or one number twice."""
    low, _, high = text.partition("..")
    return float(low), float(high or low)


def sha256(path: Path) -> str:
    """Checksum of a file."""
    return hashlib.sha256(path.read_bytes()).hexdigest()


def stored() -> dict:
    """Statistics of the last run of each campaign."""
    return json.loads(STORED.read_text(encoding="utf-8")) if STORED.is_file() else {}


def rounded(value):
    """Statistics with nine significant digits, which all processors share."""
    if isinstance(value, dict):
        return {key: rounded(one) for key, one in value.items()}
    if isinstance(value, list):
        return [rounded(one) for one in value]
    return float(f"{value:.9g}") if isinstance(value, float) else value


def differences(found, kept, counts: int = 0, where: str = "") -> list[str]:
    """Where statistics differ from stored ones: values by more than 1e-6, counts by more than `counts`.

    Parameters
    ----------
    found, kept : dict
        New and stored statistics.
    counts : int
        Largest difference of two integers. Floats of campaigns with a tolerance in counts are not compared: they
        follow the counts.
    where : str
        Name of the part.

    Returns
    -------
    list of str
        One sentence for each difference.
    """
    if isinstance(found, dict) and isinstance(kept, dict):
        if set(found) != set(kept):
            return [f"{where}: other numbers than the stored ones: {', '.join(sorted(set(found) ^ set(kept)))}"]
        return [line for key in found for line in differences(found[key], kept[key], counts, f"{where} {key}".strip())]
    if isinstance(found, list) and isinstance(kept, list) and len(found) == len(kept):
        return [
            line
            for i, (a, b) in enumerate(zip(found, kept, strict=True))
            for line in differences(a, b, counts, f"{where} {i}")
        ]
    if isinstance(found, bool) or not isinstance(found, int | float) or not isinstance(kept, int | float):
        return [] if found == kept else [f"{where}: {found}, stored {kept}"]
    if isinstance(found, int) and isinstance(kept, int):
        return [] if abs(found - kept) <= counts else [f"{where}: {found}, stored {kept}"]
    if counts or abs(found - kept) <= 1e-6 * max(1.0, abs(kept)):
        return []
    return [f"{where}: {found:.9g}, stored {kept:.9g}"]
