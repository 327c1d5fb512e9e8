"""Files that are small and made to exhaust a reader, and lists of many thousand wrong values.

Archives that inflate, overlap or state sizes that they do not have; entities that expand; content that is nested
deeply; and tables, cases and lists in which everything is wrong, whose messages must be made in linear time. Each
must be refused in one clear sentence within limits of time and memory.
"""

from __future__ import annotations

import io
import json
import zipfile
from collections.abc import Callable, Iterator
from pathlib import Path

from readers import PYTHON, SANITIZERS, Reader, Tally, template
from samples import Programs, write_inputs

# Wrong values of a list
MANY = 16_000
# Bytes that a bomb inflates to, and memory of a process that does not inflate it [kB]
LARGE = 600_000_000
MOST_MEMORY = 500_000
_HEADER = {"format": "dondolo result", "format_version": 1, "dondolo": "0.1.0"}
_CURVE = {
    "HazardCurve": {
        **{"levels": {"array": "0.npy"}, "annual_frequency": {"array": "0.npy"}, "im": "pga"},
        **{"fractiles": {"mapping": []}, "endless": False, "source": []},
    }
}
_NRML = (
    '<?xml version="1.0"?>{}<nrml xmlns="http://openquake.org/xmlns/nrml/0.5"><fragilityModel id="a" assetCategory="b"'
    ' lossCategory="structural"><description>{}</description></fragilityModel></nrml>'
)
_CASE = (
    "&job task = 'stripes', output = 'out/a' /\n&wall mechanism = 'one_sided', height = 1.5, thickness = 0.25 {} /\n"
    "&records catalogue = 'records.csv' /\n&stripes im = 'pga', levels = {} /\n"
)


def _array(shape: str, kind: str = "<f8", size: int = 16) -> bytes:
    """An array whose header states a shape."""
    text = f"{{'descr': '{kind}', 'fortran_order': False, 'shape': {shape}, }}\n".encode()
    return b"\x93NUMPY\x01\x00" + len(text).to_bytes(2, "little") + text + bytes(size)


def _archive(content: str, *members: bytes, way: int = zipfile.ZIP_STORED) -> bytes:
    """An archive of a tree and arrays."""
    made = io.BytesIO()
    with zipfile.ZipFile(made, "w") as archive:
        archive.writestr(zipfile.ZipInfo("dondolo.json"), content)
        for i, data in enumerate(members):
            archive.writestr(zipfile.ZipInfo(f"{i}.npy"), data, way)
    return made.getvalue()


def _overlapping() -> bytes:
    """An archive whose directory names one member two thousand times."""
    data = _archive(json.dumps(_HEADER | {"result": _CURVE}), _array("(125000,)", size=1_000_000))
    start = int.from_bytes(data[-6:-2], "little")
    directory = data[start:-22]
    entry = directory[directory.index(b"0.npy") - 46 :]
    many = directory + entry * 2000
    end = b"PK\5\6" + bytes(4) + (2002).to_bytes(2, "little") * 2 + len(many).to_bytes(4, "little")
    return data[:start] + many + end + start.to_bytes(4, "little") + bytes(2)


def archives() -> Iterator[bytes]:
    """Archives of results."""
    good = json.dumps(_HEADER | {"result": _CURVE})
    yield _archive(good, _array(f"({LARGE // 8},)", size=LARGE), way=zipfile.ZIP_DEFLATED)
    yield _archive(good, _array("(1000000,)", size=8_000_000), way=zipfile.ZIP_BZIP2)
    yield _archive(good, _archive(good, _array("(1000000,)", size=8_000_000), way=zipfile.ZIP_DEFLATED))
    yield _overlapping()
    shapes = ("(1000000000000,)", "(10000000000000000000000,)", "(-1,)", "(100000, 100000)", "(3,)", "(1,)")
    for shape in shapes:
        yield _archive(good, _array(shape))
    for kind in ("|O", "|V0", "|S0"):
        yield _archive(good, _array("(1000000000,)", kind, 8))
    for opening, closing in (("[", "]"), ('{"list": [', "]}"), ('{"mapping": [[1, ', "]]}")):
        for depth in (400, 200_000):
            tree = opening * depth + "0" + closing * depth
            yield _archive(f'{json.dumps(_HEADER)[:-1]}, "result": {tree}}}')
    for result in (None, True, 1.5, "walls", [], [_CURVE]):
        yield _archive(json.dumps(_HEADER | {"result": result}), _array("(2,)"))


def models() -> Iterator[bytes]:
    """Fragility models."""
    entities = "".join(f'<!ENTITY a{i} "{f"&a{i - 1};" * 10}">' for i in range(1, 10))
    declarations = (
        (f'<!DOCTYPE nrml [<!ENTITY a0 "ha">{entities}]>', "&a9;"),
        (f'<!DOCTYPE nrml [<!ENTITY a "{"x" * 200_000}">]>', "&a;" * 20_000),
        ('<!DOCTYPE nrml [<!ENTITY a SYSTEM "file:///dev/zero">]>', "&a;"),
        ('<!DOCTYPE nrml [<!ENTITY % a SYSTEM "http://localhost/a"> %a;]>', "a"),
        ("", "<a>" * 500_000),
        ("", "<a>" * 50_000 + "</a>" * 50_000),
    )
    for declaration, text in declarations:
        yield _NRML.format(declaration, text).encode()
    yield _NRML.format("", "\x1b[31m").encode()


def templates() -> Iterator[bytes]:
    """Templates of Word."""
    entities = "".join(f'<!ENTITY a{i} "{f"&a{i - 1};" * 10}">' for i in range(1, 10))
    parts = (
        {"word/media/a.png": bytes(LARGE)},
        {"word/a.xml": b"<a>" + bytes(100_000_000)},
        {"word/a.xml": f'<!DOCTYPE a [<!ENTITY a0 "ha">{entities}]><a>&a9;</a>'.encode()},
        {"word/a.xml": f'<!DOCTYPE a [<!ENTITY a0 "ha">{entities}]><a b="&a9;"/>'.encode("utf-16")},
        {"word/a.xml": b'<!DOCTYPE a [<!ENTITY b SYSTEM "file:///dev/zero">]><a>&b;</a>'},
        {"word/a.xml": b"<a>" * 500_000},
        {f"word/{i}.bin": b"" for i in range(50_000)},
    )
    for members in parts:
        made = io.BytesIO(template())
        with zipfile.ZipFile(made, "a", zipfile.ZIP_DEFLATED) as archive:
            for name, content in members.items():
                archive.writestr(name, content)
        yield made.getvalue()


def bombs() -> Iterator[tuple[str, bytes]]:
    """Families of readers, and files that are made to exhaust them."""
    yield from (("archive", one) for one in archives())
    yield from (("nrml", one) for one in models())
    yield from (("template", one) for one in templates())


def lists() -> Iterator[tuple[str, bytes]]:
    """Families of readers, and files in which everything is wrong."""
    numbers = ", ".join(f"-{i}.5" for i in range(1, MANY))
    yield "case", _CASE.format("", numbers).encode()
    yield "case", _CASE.format(f", section_fill = {numbers}", "0.1").encode()
    yield "case", _CASE.format("".join(f", wrong{i} = 1" for i in range(MANY)), "0.1").encode()
    yield "case", (_CASE.format("", "0.1") + "".join(f"&wrong{i} a = 1 /\n" for i in range(MANY))).encode()
    head = "name,mechanism,height,thickness\n"
    for row in ("a{0},one_sided,-{0},0", "a,one_sided,1.5,0.25", "\x1b[31m{0},x{0},y,z", "a{0},one_sided,1.5"):
        yield "walls", (head + "".join(row.format(i + 1) + "\n" for i in range(MANY))).encode()
    for row in ("none{0}.txt,0.01,g", "r1.txt,-{0},g", "r1.txt,0.01,\u202e{0}", "r1.txt,0.01,g"):
        yield "catalogue", ("file,dt_s,units\n" + "".join(row.format(i + 1) + "\n" for i in range(MANY))).encode()
    for row in ("-{0},-1", "x{0},1", "{0},1,1"):
        table = "pga,annual_frequency\n" + "".join(row.format(i + 1) + "\n" for i in range(MANY))
        yield "hazard", table.encode()
        # Any numbers make a table of numbers.
        if row != "-{0},-1":
            yield "numbers", table.encode()
    yield "hazard", (",".join(f"c{i}" for i in range(MANY)) + "\n").encode()
    titles = ",".join(f"poe-{i}" for i in range(MANY))
    yield "openquake", (f"# investigation_time=50, imt='PGA'\nlon,lat,{titles}\n0,0{',2' * MANY}\n").encode()
    yield "openquake", f"# imt='{'PGA' * MANY}'\nlon,lat,poe-0.1\n0,0,{'9' * 400_000}\n".encode()


class Bombs:
    """Files that are made to exhaust readers.

    Parameters
    ----------
    programs : Programs
    folder : Path
        To work in.
    """

    def __init__(self, programs: Programs, folder: Path) -> None:
        self.programs, self.folder = programs, folder / "inputs"
        write_inputs(self.folder)

    def families(self) -> dict[str, Callable[[], Tally]]:
        """Bombs and lists."""
        return {"bombs": lambda: self.run("bombs", bombs()), "long lists": lambda: self.run("long lists", lists())}

    def run(self, name: str, files: Iterator[tuple[str, bytes]]) -> Tally:
        """Ask for each file; one that is read is a failure, for nothing in it is right."""
        tally = Tally(name)
        script = Path(__file__).with_name("results.py")
        readers = {
            True: Reader([self.programs.python, script, "attack"], self.folder, {}),
            False: Reader([self.programs.readers, "attack"], self.folder, SANITIZERS),
        }
        for number, (family, content) in enumerate(files):
            path = self.folder / f"attacked{'.npz' if family == 'archive' else '.nml' if family == 'case' else ''}"
            path.write_bytes(content)
            reader = readers[family in PYTHON]
            said = reader.ask(family, path)
            tally.note(f"UNSOUND: {said}" if said.startswith("read") else said, f"{name}:{number} ({family})")
            if (memory := reader.memory()) > MOST_MEMORY:
                tally.failures.append(f"{name}:{number} ({family}): MEMORY: {memory} kB")
        for reader in readers.values():
            if said := reader.end():
                tally.failures.append(f"{name}: at the end: {said}")
        return tally
