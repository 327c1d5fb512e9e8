"""Archives that are made to exhaust a reader: each is refused in one sentence before memory is spent on it."""

import io
import json
import struct
import tracemalloc
import zipfile

import numpy as np
import pytest

import dondolo as dd

HEADER = {"format": "dondolo result", "format_version": 1, "dondolo": "0.1.0"}
# What a file of some kilobytes may cost [bytes]
MOST = 20_000_000


def npy(array):
    with io.BytesIO() as file:
        np.lib.format.write_array(file, array)
        return file.getvalue()


def claiming(shape, descr="<f8", rest=b""):
    """An array whose header states a shape that its bytes do not have."""
    text = f"{{'descr': {descr!r}, 'fortran_order': False, 'shape': {shape}, }}".ljust(117) + "\n"
    return b"\x93NUMPY\x01\x00" + struct.pack("<H", len(text)) + text.encode() + rest


def archive(path, result, members=(), way=zipfile.ZIP_STORED):
    """Write an archive of a tree, or of the bytes of its content, and members."""
    with zipfile.ZipFile(path, "w") as file:
        content = result if isinstance(result, bytes) else json.dumps(HEADER | {"result": result})
        file.writestr(zipfile.ZipInfo("dondolo.json"), content)
        for name, data in members:
            file.writestr(zipfile.ZipInfo(name), data, way)


def curve(levels):
    """The tree of a hazard curve."""
    fields = {"levels": {"array": levels}, "annual_frequency": {"array": "1.npy"}, "im": "pga"}
    return {"HazardCurve": fields | {"fractiles": {"mapping": []}, "endless": False, "source": []}}


def refused(path, message):
    """Load a file: it is refused in one sentence, and costs little memory."""
    tracemalloc.start()
    try:
        with pytest.raises(dd.errors.InputError, match=message) as error:
            dd.load(path)
        _, peak = tracemalloc.get_traced_memory()
    finally:
        tracemalloc.stop()
    assert peak < MOST
    sentence = str(error.value)
    assert sentence.startswith(f"{path}: ")
    assert "\n" not in sentence
    assert len(sentence) < 500


@pytest.fixture
def path(tmp_path):
    return tmp_path / "result.npz"


GOOD = [("0.npy", npy(np.array([0.1, 0.2]))), ("1.npy", npy(np.array([0.01, 0.001])))]


def test_an_archive_of_its_own_kind_is_read(path):
    """What the others are changed from."""
    archive(path, curve("0.npy"), GOOD)
    np.testing.assert_array_equal(dd.load(path).levels, [0.1, 0.2])


@pytest.mark.parametrize("way", [zipfile.ZIP_DEFLATED, zipfile.ZIP_BZIP2, zipfile.ZIP_LZMA])
def test_compressed_members(path, way):
    """60 MB of zeros in a few kilobytes."""
    archive(path, curve("0.npy"), [("0.npy", npy(np.zeros(7_500_000))), GOOD[1]], way)
    assert path.stat().st_size < 100_000
    refused(path, r"is damaged: member '0\.npy' is compressed, which no saved result is")


def test_members_that_overlap(path):
    """A thousand entries of the directory for one member of 100 kB."""
    archive(path, curve("0.npy"), [("0.npy", npy(np.zeros(12_500))), GOOD[1]])
    data = path.read_bytes()
    with zipfile.ZipFile(path) as file:
        start, size = file.start_dir, len(data) - file.start_dir - 22
    directory = data[start : start + size]
    first = directory.index(b"0.npy") - 46
    entry = directory[first : first + 46 + 5]
    many = directory + entry * 1000
    end = struct.pack("<4s4H2LH", b"PK\5\6", 0, 0, 1003, 1003, len(many), start, 0)
    path.write_bytes(data[:start] + many + end)
    refused(path, r"is damaged: its members have \d+ bytes, more than the \d+ of the file")


def test_an_archive_in_an_archive(path):
    inner = path.with_name("inner.zip")
    with zipfile.ZipFile(inner, "w", zipfile.ZIP_DEFLATED) as file:
        file.writestr("0.npy", npy(np.zeros(5_000_000)))
    archive(path, curve("0.npy"), [("0.npy", inner.read_bytes()), GOOD[1]])
    refused(path, "is damaged: not a complete archive")


@pytest.mark.parametrize(
    "data",
    [
        claiming("(1000000000,)"),
        claiming("(10000000000000000000000,)"),
        claiming("(100000, 100000, 100000)", rest=bytes(800)),
        claiming("(-1,)", rest=bytes(16)),
        claiming("(-2, -1)", rest=bytes(16)),
        claiming("(3,)", rest=bytes(16)),
        claiming("(1,)", rest=bytes(16)),
        claiming("(1000000000000,)", "|V0"),
        claiming("(2,)", "|O", bytes(16)),
        claiming("(2,)", [("a", "<f8", (10**9,))], bytes(16)),
        claiming("(" * 3000 + ")" * 3000),
        b"\x93NUMPY\x09\x00" + bytes(200),
        b"",
    ],
)
def test_arrays_that_cannot_be(path, data):
    archive(path, curve("0.npy"), [("0.npy", data), GOOD[1]])
    refused(path, "is damaged")


@pytest.mark.parametrize("depth", [300, 1_000, 100_000])
@pytest.mark.parametrize("kind", ["[", '{"list": [', '{"mapping": [[1, '])
def test_deep_content(path, depth, kind):
    closing = {"[": "]", '{"list": [': "]}", '{"mapping": [[1, ': "]]}"}[kind]
    tree = json.dumps(HEADER)[:-1] + ', "result": ' + kind * depth + "0" + closing * depth + "}"
    archive(path, tree.encode())
    refused(path, "nested too deeply|is damaged|must be a result")


@pytest.mark.parametrize("result", [None, True, 3, 0.5, "walls", [], [1.0], {"list": []}, {"array": "0.npy"}])
def test_content_that_is_not_a_result(path, result):
    archive(path, result, GOOD)
    refused(path, r"was saved by dondolo 0\.1\.0: its content must be a result, not \w+")


def test_content_that_a_constructor_cannot_take(path):
    """Whatever it raises, in one line."""
    for fields in ({"levels": None}, {"fractiles": {"mapping": [[{"array": "0.npy"}, 1]]}}, {"source": 5}, {"im": [1]}):
        tree = curve("0.npy")
        tree["HazardCurve"] |= fields
        archive(path, tree, GOOD)
        refused(path, r"was saved by dondolo 0\.1\.0: ")


def test_a_device_has_no_end():
    with pytest.raises(dd.errors.InputError, match="/dev/zero: is a device, not a regular file"):
        dd.load("/dev/zero")
