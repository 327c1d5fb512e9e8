"""Catalogues that sets of records are written to: the old one or the new one at any moment, and never some of both."""

import os
import re
import resource
import signal
import subprocess
import sys
import zlib
from pathlib import Path

import numpy as np
import pytest

import dondolo as dd
from dondolo._storage import tables

TIME = np.arange(0.0, 6.0, 0.01)


def suite(factor, vertical=True):
    """Records of different lengths, of which one has a vertical component."""
    made = []
    for i in range(3):
        samples = (factor * (1.0 + i) * np.sin((5.0 + i) * TIME) * np.exp(-((TIME - 2.0) ** 2)))[: 200 + 200 * i]
        up = 0.5 * samples if vertical and i == 1 else None
        made.append(dd.Record(samples, 0.01, f"motion {i}", vertical=up))
    return dd.RecordSet(made)


def peaks(path, **more):
    """What a reader finds."""
    return [record.peak_acceleration for record in dd.read_catalogue(path, **more)]


def listing(folder):
    return sorted(str(path.relative_to(folder)) for path in folder.rglob("*") if path.is_file())


def test_every_write_that_fails_leaves_the_old_catalogue(tmp_path, monkeypatch):
    path = tmp_path / "list.csv"
    old, new = suite(1.0), suite(2.0)
    old.to_catalogue(path)
    before = listing(tmp_path)
    assert len(before) == 5
    write = tables.write_lines
    for k in range(5):
        for error in (dd.errors.DondoloError("the disk is full"), KeyboardInterrupt()):
            calls = []

            def failing(target, lines, k=k, error=error, calls=calls):
                calls.append(target)
                if len(calls) == k + 1:
                    raise error
                write(target, lines)

            monkeypatch.setattr(tables, "write_lines", failing)
            with pytest.raises(type(error)):
                new.to_catalogue(path)
            assert len(calls) == k + 1
            assert peaks(path) == [record.peak_acceleration for record in old]
            assert listing(tmp_path) == before
    monkeypatch.setattr(tables, "write_lines", write)
    new.to_catalogue(path)
    assert peaks(path) == [record.peak_acceleration for record in new]
    after = listing(tmp_path)
    assert len(after) == 5
    assert set(after) & set(before) == {"list.csv"}
    # The same again changes nothing.
    content = [(tmp_path / name).read_bytes() for name in after]
    new.to_catalogue(path)
    assert listing(tmp_path) == after
    assert [(tmp_path / name).read_bytes() for name in after] == content


def test_a_change_after_the_table_is_in_place_costs_no_file(tmp_path, monkeypatch):
    path = tmp_path / "list.csv"
    suite(1.0).to_catalogue(path)
    write = tables.write_lines

    def late(target, lines):
        write(target, lines)
        if target == path:
            raise KeyboardInterrupt

    monkeypatch.setattr(tables, "write_lines", late)
    with pytest.raises(KeyboardInterrupt):
        suite(2.0).to_catalogue(path)
    assert peaks(path) == [record.peak_acceleration for record in suite(2.0)]


def test_a_file_of_another_version_is_refused(tmp_path, executable):
    """By Python and by the executable, of both components."""
    path = tmp_path / "list.csv"
    suite(1.0).to_catalogue(path)
    for file in sorted((tmp_path / "list").iterdir()):
        text = file.read_text()
        # One digit of one sample
        file.write_text(re.sub(r"\d\n\Z", lambda last: f"{(int(last[0]) + 1) % 10}\n", text))
        is_vertical = "_vertical_" in file.name
        sentence = rf"list\.csv: line \d: {re.escape(str(file))}: has the CRC-32 \w{{8}}, but the catalogue has \w{{8}}"
        # Where vertical components are not read they are not compared.
        if is_vertical:
            assert peaks(path)
        rows = dd.read_catalogue(path) if is_vertical else None
        assert rows is None or len(rows) == 3
        (tmp_path / "a.nml").write_text(
            "&job output = 'out/a' /\n&wall mechanism = 'one_sided' height = 1.5 thickness = 0.25 /\n"
            "&records catalogue = 'list.csv' /\n&stripes levels = 0.6, 0.8 /\n"
        )
        if not is_vertical:
            with pytest.raises(dd.errors.InputError, match=sentence):
                dd.read_catalogue(path)
            done = subprocess.run([executable, "a.nml"], cwd=tmp_path, capture_output=True, text=True, check=False)
            assert done.returncode == 2
            assert f"has the CRC-32 {zlib.crc32(file.read_bytes()):08x}" in done.stderr
            assert done.stderr.count("\n") == 1
        file.write_text(text)
    lines = path.read_text().splitlines()
    column = lines[2].split(",").index("crc32")
    cells = lines[3].split(",")
    for wrong in ("1234567", "xyzw0123", "0x123456"):
        cells[column] = wrong
        path.write_text("\n".join([*lines[:3], ",".join(cells), *lines[4:]]) + "\n")
        sentence = rf"line 4: crc32 = '{wrong}': must be a CRC-32 of 8 hexadecimal figures"
        with pytest.raises(dd.errors.InputError, match=sentence):
            dd.read_catalogue(path)
    # Nothing is compared where nothing is stated, and figures in upper case are the same.
    for right in ("", lines[3].split(",")[column].upper()):
        cells[column] = right
        path.write_text("\n".join([*lines[:3], ",".join(cells), *lines[4:]]) + "\n")
        assert len(peaks(path)) == 3


def test_a_vertical_component_of_another_version_is_refused(tmp_path):
    path = tmp_path / "list.csv"
    records = dd.RecordSet([record for record in suite(1.0) if record.vertical is not None])
    records.to_catalogue(path)
    (file,) = (tmp_path / "list").glob("*_vertical_*")
    (back,) = dd.read_catalogue(path, vertical="recorded")
    assert np.array_equal(back.vertical, records[0].vertical)
    file.write_text(file.read_text().replace("\n0.", "\n1.", 1).replace("\n-0.", "\n-1.", 1))
    with pytest.raises(dd.errors.InputError, match=r"_vertical_.*: has the CRC-32"):
        dd.read_catalogue(path, vertical="recorded")


def test_what_is_the_users_stays(tmp_path):
    """A file that has been changed, one of the same name, and what else is in the folder."""
    path = tmp_path / "list.csv"
    suite(1.0).to_catalogue(path)
    first, *rest = sorted((tmp_path / "list").iterdir())
    first.write_text(first.read_text() + "0.0\n")
    mine = tmp_path / "list/mine.txt"
    mine.write_text("mine\n")
    # What the new catalogue would name
    suite(2.0).to_catalogue(tmp_path / "other.csv")
    taken = tmp_path / "list" / sorted((tmp_path / "other").iterdir())[0].name
    taken.write_text("taken\n")
    changed = first.read_bytes()
    suite(2.0).to_catalogue(path)
    assert (first.read_bytes(), mine.read_text(), taken.read_text()) == (changed, "mine\n", "taken\n")
    assert not any(file.exists() for file in rest)
    assert peaks(path) == [record.peak_acceleration for record in suite(2.0)]
    # Nor is a file outside the folder removed, whatever a table says.
    outside = tmp_path / "outside.txt"
    outside.write_text("1\n2\n")
    rows = path.read_text().splitlines()
    cells = rows[3].split(",")
    cells[0], cells[4] = "outside.txt", f"{zlib.crc32(outside.read_bytes()):08x}"
    path.write_text("\n".join([*rows[:3], ",".join(cells), *rows[4:]]) + "\n")
    suite(3.0).to_catalogue(path)
    assert outside.exists()


def test_what_a_killed_process_leaves_is_removed(tmp_path):
    path = tmp_path / "list.csv"
    suite(1.0).to_catalogue(path)
    program = f"""
import os, signal
import dondolo as dd
from dondolo._storage import tables
import sys
sys.path.insert(0, {str(Path(__file__).parent)!r})
from test_catalogue_publication import suite
write, calls = tables.write_lines, []
def killed(target, lines):
    calls.append(target)
    if len(calls) == 3:
        os.kill(os.getpid(), signal.SIGKILL)
    write(target, lines)
tables.write_lines = killed
suite(2.0).to_catalogue({str(path)!r})
"""
    before = listing(tmp_path)
    done = subprocess.run([sys.executable, "-c", program], capture_output=True, check=False)
    assert done.returncode == -signal.SIGKILL
    assert len(listing(tmp_path)) == len(before) + 3
    assert peaks(path) == [record.peak_acceleration for record in suite(1.0)]
    suite(3.0).to_catalogue(path)
    assert len(listing(tmp_path)) == len(before)
    assert peaks(path) == [record.peak_acceleration for record in suite(3.0)]


def test_a_disk_that_is_full(tmp_path):
    """Files of limited size: the first records have room, the last has none."""
    path = tmp_path / "list.csv"
    suite(1.0, vertical=False).to_catalogue(path)
    before = listing(tmp_path)
    limit, handler = resource.getrlimit(resource.RLIMIT_FSIZE), signal.signal(signal.SIGXFSZ, signal.SIG_IGN)
    try:
        resource.setrlimit(resource.RLIMIT_FSIZE, (9000, limit[1]))
        with pytest.raises(dd.errors.DondoloError, match="cannot be written: File too large"):
            suite(2.0, vertical=False).to_catalogue(path)
    finally:
        resource.setrlimit(resource.RLIMIT_FSIZE, limit)
        signal.signal(signal.SIGXFSZ, handler)
    assert peaks(path) == [record.peak_acceleration for record in suite(1.0)]
    assert listing(tmp_path) == before
    assert not [name for name in os.listdir(tmp_path) if name.endswith(".lock")]
