"""What the tests share: the repository, its records, walls, and the executable."""

from __future__ import annotations

import os
import signal
import subprocess
import sys
from collections.abc import Iterator
from pathlib import Path
from types import SimpleNamespace

import numpy as np
import pytest

import dondolo as dd
from dondolo._fortran import _core

ROOT = Path(__file__).resolve().parents[2]


@pytest.fixture(scope="session")
def root() -> Path:
    """The repository."""
    return ROOT


@pytest.fixture(scope="session")
def records() -> list[dd.Record]:
    """The embedded synthetic accelerograms."""
    return dd.read_catalogue(ROOT / "data/records/synthetic44.csv")


@pytest.fixture(scope="session")
def recordings() -> Path:
    """The folder of recorded accelerograms, which are not part of dondolo."""
    folder = Path(os.environ.get("DONDOLO_RECORDS", ""))
    if not (folder / "italy44.csv").is_file():
        pytest.skip("no recorded accelerograms here: DONDOLO_RECORDS names their folder")
    return folder


@pytest.fixture(scope="session")
def recorded(recordings: Path) -> dict[str, dd.Record]:
    """Recorded accelerograms by their names."""
    return {record.name: record for record in dd.read_catalogue(recordings / "italy44.csv")}


@pytest.fixture(scope="session")
def few(records: list[dd.Record]) -> list[dd.Record]:
    """Some of them."""
    return records[::6]


@pytest.fixture(scope="session")
def wall() -> dd.OneSidedWall:
    """A wall that collapses readily."""
    return dd.OneSidedWall(height=1.5, thickness=0.25, name="parapet")


@pytest.fixture(scope="session")
def stripes(wall: dd.OneSidedWall, records: list[dd.Record]) -> dd.results.Stripes:
    """Stripes with a good fit."""
    return dd.multiple_stripe(wall, records, levels=[0.2, 0.4, 0.6, 0.8, 1.0, 1.2], progress=False)


@pytest.fixture
def replace_procedure(monkeypatch: pytest.MonkeyPatch):
    """Put something in the place of a procedure of the extension, whose modules do not let theirs be replaced."""

    def replace(name: str, stand_in: object) -> None:
        module, procedure = name.split(".")
        there = getattr(_core, module)
        procedures = {name: getattr(there, name) for name in dir(there) if not name.startswith("__")}
        assert procedure in procedures
        monkeypatch.setattr(_core, module, SimpleNamespace(**procedures | {procedure: stand_in}))

    return replace


@pytest.fixture(scope="session")
def executable() -> str:
    """The executable of the same build as the extension."""
    places = [Path(sys.executable).with_name("dondolo"), *Path(ROOT).glob("build-python/dondolo")]
    if "DONDOLO_EXECUTABLE" in os.environ:
        places = [Path(os.environ["DONDOLO_EXECUTABLE"])]
    for place in places:
        if place.is_file() and os.access(place, os.X_OK):
            return str(place)
    pytest.skip("no executable: pip install . puts it beside python, DONDOLO_EXECUTABLE names another")


@pytest.fixture
def run(executable: str, tmp_path: Path):
    """Run the executable in an empty folder."""

    def call(*arguments: str | Path) -> subprocess.CompletedProcess[str]:
        command = [executable, *map(str, arguments)]
        return subprocess.run(command, cwd=tmp_path, capture_output=True, text=True, check=False)

    return call


@pytest.fixture(scope="session")
def sine() -> dd.Record:
    """Four cycles of a sine of 1 m/s2 and 1 s."""
    return dd.Record(np.sin(2.0 * np.pi * 0.01 * np.arange(401)), 0.01, name="sine")


def pytest_configure(config: pytest.Config) -> None:
    """Tests read files by their place in the repository."""
    config.addinivalue_line("markers", "slow: takes more than a few seconds")


@pytest.fixture(scope="session", autouse=True)
def interruptible() -> None:
    """Ctrl-C works even where the shell that started the tests ignores it."""
    signal.signal(signal.SIGINT, signal.default_int_handler)


@pytest.fixture(scope="module", autouse=True)
def environment() -> Iterator[None]:
    """The tests of a file leave the environment as they found it."""
    before = dict(os.environ)
    yield
    after = dict(os.environ)
    for changes in (before, after):
        changes.pop("PYTEST_CURRENT_TEST", None)
    assert after == before
