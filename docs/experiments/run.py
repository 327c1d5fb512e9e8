"""Compare what dondolo computes with what was measured, for ./run experiments.

Writes docs/experiments.md, docs/studies/experiments.md, their figures and data/experiments/statistics.json, and in
out/experiments one line for each test (experiments.csv) and all statistics with versions and checksums
(experiments.json). With --check only the last two are written, and the command fails if statistics or pages differ from
the stored ones. Nothing is downloaded.
"""

import argparse
import csv
import json
import platform
import sys
import warnings
from pathlib import Path

import bent
import boulders
import campaigns
import numpy as np
import page
import strips
import values

import dondolo as dd

OUT = campaigns.ROOT / "out/experiments"
PAGE = campaigns.ROOT / "docs/experiments.md"
STUDY = campaigns.ROOT / "docs/studies/experiments.md"
#: Largest difference of counts of granite: two right integrators differ in 3 to 15 of 490 flags
COUNTS = 10
HEADER = ["campaign", "test", "specimen", "quantity", "measured", "computed", "ln_ratio", "right"]


def main(arguments: list[str]) -> int:
    """Run the command.

    Parameters
    ----------
    arguments : list of str
        Those of the command line.

    Returns
    -------
    int
        Status: 1 if something differs from what is stored.
    """
    options = _options(arguments)
    warnings.simplefilter("ignore", dd.errors.DondoloWarning)
    known = {name: campaigns.read(name) for name in campaigns.NAMES}
    kept = campaigns.stored()
    fresh, lines, inputs = {}, [], {}
    for name in options.campaign or campaigns.NAMES:
        campaign = known[name]
        inputs |= {f"{name}/{path.name}": campaigns.sha256(path) for path in campaign.files()}
        if not campaign.is_used:
            print(f"{name}: not used. {campaign.facts['use']}")
        elif name == "granite":
            found, rows = granite(campaign, options, kept.get(name, {}))
            if found:
                fresh[name], inputs["granite, raw"] = found, campaign.facts["sha256"]
                lines += rows
        else:
            found, rows = values.RUNNERS[name](campaign)
            if name == "sin01":
                more, rows = strip(campaign, options, kept.get(name, {}), rows)
                found |= more
            if name == "safego":
                found |= bending(campaign, kept.get(name, {}))
            fresh[name] = campaigns.rounded(found)
            lines += rows
            print(f"{name}: {len(rows)} tests")
    if options.hold:
        return 0
    statistics = {name: fresh.get(name, kept.get(name)) for name in campaigns.NAMES if name in fresh or name in kept}
    _write_out(statistics, lines, inputs)
    texts = {PAGE: page.text(statistics), STUDY: page.study(known, statistics)}
    if options.check:
        return _check(fresh, kept, texts)
    _write(campaigns.STORED, json.dumps(statistics, indent=1, ensure_ascii=False) + "\n")
    for path, text in texts.items():
        _write(path, text)
    import drawings

    drawings.draw(known, statistics, campaigns.ROOT / "docs/figures")
    print(f"{' and '.join(str(path.relative_to(campaigns.ROOT)) for path in texts)} and figures are written")
    return 0


def _options(arguments: list[str]) -> argparse.Namespace:
    """Arguments of the command line."""
    parser = argparse.ArgumentParser(prog="./run experiments", description="What is computed against what was measured")
    parser.add_argument("campaign", nargs="*", help=f"{', '.join(campaigns.NAMES)}; all if none is given")
    parser.add_argument("--raw", type=Path, metavar="FOLDER", help="folder with data that are not in the repository")
    parser.add_argument(
        "--check", action="store_true", help="compare with the stored statistics and page, and fail if they differ"
    )
    parser.add_argument("--hold", action="store_true", help="run the blind half of granite alone")
    options = parser.parse_args(arguments)
    unknown = [name for name in options.campaign if name not in campaigns.NAMES]
    if unknown:
        parser.error(f"unknown campaign '{unknown[0]}': must be one of {', '.join(campaigns.NAMES)}")
    return options


def granite(campaign, options, kept: dict) -> tuple[dict, list]:
    """Statistics of the boulders, from the raw folder if it is there; nothing if it is not.

    Parameters
    ----------
    campaign : Campaign
        The campaign.
    options : Namespace
        Arguments of the command line.
    kept : dict
        Stored statistics, whose slendernesses the blind half takes.

    Returns
    -------
    found, rows : dict, list
        Statistics and lines of experiments.csv; empty if there are no data.
    """
    folder = raw_folder(options.raw)
    if folder is None:
        print(
            f"granite: skipped, 490 motions are not here; get them from {campaign.facts['url']} (GPL-3, about 1 GB) and"
            " give the folder with --raw; only the stored statistics are shown."
        )
        return {}, []
    if options.hold:
        _hold(folder, kept)
        return {}, []
    paths = [*(folder / name for name in boulders.TABLES), *boulders.files_of(folder)]
    if boulders.digest(paths) != campaign.facts["sha256"]:
        print(f"granite: skipped, the files in {folder} are not those of the commit that campaign.json names.")
        return {}, []
    tests = boulders.read(folder, OUT)
    variants = {
        "unchanged": boulders.records_of(tests),
        "g 9.80665 m/s2": boulders.records_of(boulders.read(folder, OUT, gravity=9.80665)),
        "800 instead of 200 Hz": boulders.records_of(boulders.read(folder, OUT, kept=1)),
        "corner at 0.1003 Hz": boulders.records_of(boulders.read(folder, OUT, high_pass=0.1003)),
        "corner at 0.3 Hz": boulders.records_of(boulders.read(folder, OUT, high_pass=0.3)),
    }
    found = {"specimens": boulders.statistics(tests, variants["unchanged"])}
    found["processing"] = boulders.processing_effect(tests, variants, found["specimens"])
    import drawings

    factors = {
        name: boulders.smallest_factors(variants["unchanged"], one["alpha"]) for name, one in found["specimens"].items()
    }
    drawings.draw_tests(tests, found["specimens"], factors, OUT)
    rows = []
    for name in boulders.SPECIMENS:
        flag = boulders.flags(variants["unchanged"], [found["specimens"][name]["alpha"]])[0]
        for test, fell, computed in zip(tests.names, tests.fell[name], flag, strict=True):
            verdict = "right" if fell == computed else "wrong"
            rows.append(["granite", test, name, "overturned", int(fell), int(computed), "", verdict])
    print(f"granite: {len(rows)} outcomes; figures of single tests are in {OUT}, which git ignores")
    return campaigns.rounded(found), rows


def strip(campaign, options, kept: dict, rows: list) -> tuple[dict, list]:
    """Outcomes of SIN-01 under its motions, or the stored ones without them.

    Parameters
    ----------
    campaign : Campaign
        The campaign.
    options : Namespace
        Arguments of the command line.
    kept : dict
        Stored statistics.
    rows : list
        Lines of experiments.csv without motions.

    Returns
    -------
    found, rows : dict, list
        `motions`, if they have ever been run, and lines of experiments.csv.
    """
    folder = strips.raw_folder(options.raw, campaign)
    if folder is None:
        print(
            "sin01: outcomes skipped, its 15 motions are not here; they are in yopi1838/Hanze_SAFEGO on GitHub,"
            " without a licence: ask its authors, and give the folder with --raw."
        )
        return {"motions": kept["motions"]} if "motions" in kept else {}, rows
    found, rows = strips.sin01(campaign, folder)
    names = [f"{row['motion']}{strips.ENDING}" for row in campaign.tests]
    print(f"sin01: sha256 of its motions {boulders.digest([folder / name for name in names])}")
    return {"motions": found}, rows


def bending(campaign, kept: dict) -> dict:
    """Displacements of the strips of SAFEGO with joints that bend, or the stored ones without the record.

    Parameters
    ----------
    campaign : Campaign
        The campaign.
    kept : dict
        Stored statistics.

    Returns
    -------
    dict
        `bent`, if they have ever been computed.
    """
    folder = bent.record_folder()
    if folder is not None:
        return {"bent": bent.safego(campaign, folder)}
    print(
        "safego: bending skipped, the record of Tolmezzo is not here; DONDOLO_RECORDS names the folder of italy44.csv."
    )
    return {"bent": kept["bent"]} if "bent" in kept else {}


def raw_folder(given: Path | None) -> Path | None:
    """The folder of the boulders in a folder of a user, None if it is not there."""
    if given is None:
        return None
    for place in (given, given / "data/Shake_Table_Response", given / "granite"):
        if all((place / name).is_file() for name in boulders.TABLES):
            return place
    return None


def _hold(folder: Path, kept: dict) -> None:
    """Print the result of the blind half, or why it did not run."""
    paths = boulders.files_of(folder, large=True)
    if len(paths) != boulders.BLIND:
        print(f"granite: the blind half is not run, {len(paths)} of its {boulders.BLIND} motions are here.")
        return
    print(f"granite, blind half: sha256 {boulders.digest(paths)}")
    alphas = {name: kept["specimens"][name]["alpha"] for name in boulders.SPECIMENS}
    for what, one in boulders.hold(boulders.read(folder, OUT, large=True), alphas).items():
        verdict = "inside" if one["inside"] else "OUTSIDE"
        print(
            f"specimen {what}: right {one['right']:.3f} of {one['n']}, band from {one['band']:.2f}: {verdict}"
            f" (always stands {one['always_stands']:.3f})"
        )


def _check(fresh: dict, kept: dict, texts: dict[Path, str]) -> int:
    """Print what differs from the stored statistics and pages."""
    wrong = []
    for name, found in fresh.items():
        wrong += campaigns.differences(found, kept.get(name), COUNTS if name == "granite" else 0, name)
    for path, text in texts.items():
        if not path.is_file() or path.read_text(encoding="utf-8") != text:
            wrong.append(f"{path.relative_to(campaigns.ROOT)} is not what the statistics give: run ./run experiments")
    passed = f"{', '.join(fresh) or 'nothing'}: as stored; the pages are those of the statistics"
    print("\n".join(wrong) if wrong else passed)
    return 1 if wrong else 0


def _write_out(statistics: dict, lines: list, inputs: dict) -> None:
    """Write experiments.csv and experiments.json."""
    OUT.mkdir(parents=True, exist_ok=True)
    with (OUT / "experiments.csv").open("w", encoding="utf-8", newline="") as file:
        writer = csv.writer(file, lineterminator="\n")
        writer.writerows([HEADER, *lines])
    versions = {"dondolo": dd.__version__, "numpy": np.__version__, "python": platform.python_version()}
    everything = {"versions": versions, "sha256": inputs, "statistics": statistics}
    _write(OUT / "experiments.json", json.dumps(everything, indent=1, ensure_ascii=False) + "\n")


def _write(path: Path, text: str) -> None:
    """Write a text with the same bytes on every system."""
    path.write_text(text, encoding="utf-8", newline="\n")


if __name__ == "__main__":
    sys.exit(main(sys.argv[1:]))
