"""Damage to files that knows how they are built: lines, fields, numbers, keys, members, check sums; and bytes."""

from __future__ import annotations

import io
import json
import random
import re
import struct
import zipfile
from collections.abc import Callable
from typing import Any

# Numbers at limits, and words that stand where numbers do
NUMBERS = (
    "0 -0 1 -1 2 1e-320 5e-324 1e-300 1e300 1.7976931348623157e308 1e309 -1e309 1e99999 1e-99999 1d5 1q3 0x10 1_8 "
    "127 128 255 32767 32768 65536 2147483647 2147483648 -2147483648 4294967296 9223372036854775807 "
    "99999999999999999999999 0.1000000000000000055511151231257827 nan NaN -nan inf Infinity -inf +5 .5 5. . + - e5 1e "
    "1e+ 1,5 1.000,5 3*0.1 2147483647*1 1000000000*1 T F .true. null"
).split()
WORDS = [
    "", " ", "''", '""', '"', "'", "'''", "/", "&", "&end", "!", "#", "=", ",", ";", "\\", "..", "../../etc/passwd", "~",
    "/dev/zero", "/dev/null", "*", "?", "%s%n", "$(id)", "<script>", "&lt;", "\u200b", "\u202e", "\ufeff", "\u00e9",
    "\U0001f600", "\x00", "\x1b[31m", "\x7f", "\x85", "\u2028", "=1+1", "@x", "wall", "one_sided", "two_block", "both", "pga",
    "A" * 300, "9" * 500, "(" * 2000, "[" * 2000,
]  # fmt: skip
SEPARATORS = [",", ";", "\t", " ", "|", ":", "=", "  "]
_NUMBER = re.compile(r"[-+]?(?:\d+\.?\d*|\.\d+)(?:[eEdD][-+]?\d+)?")
_WORD = re.compile(r"[A-Za-z_]\w*")
_FIELD = re.compile(r"[,;\t|:=]|\s+")


def bytes_of(text: str) -> bytes:
    """A text as UTF-8; what came from bytes that are none goes back to them."""
    return text.encode("utf-8", "surrogateescape")


class Damage:
    """Damages files.

    Parameters
    ----------
    chance : random.Random
        What decides; the same seed gives the same damage.
    others : list of bytes
        Valid files of the same family, to mix with.
    """

    def __init__(self, chance: random.Random, others: list[bytes]) -> None:
        self.chance, self.others = chance, others

    def text(self, content: bytes) -> bytes:
        """Damage a text file in one to four ways."""
        for _ in range(self.chance.choice((1, 1, 1, 2, 2, 3, 4))):
            kind = self.chance.random()
            if kind < 0.7:
                lines = content.decode("utf-8", "surrogateescape").split("\n")
                content = bytes_of("\n".join(self.chance.choice(self._LINES)(self, lines)))
            elif kind < 0.85:
                content = self.chance.choice(self._WHOLE)(self, content)
            else:
                content = self.bytes(content)
        return content

    def bytes(self, content: bytes) -> bytes:
        """Damage bytes: flip, insert, remove, double, cut."""
        data, chance = bytearray(content), self.chance
        for _ in range(chance.randint(1, 3)):
            at, length = chance.randrange(len(data) + 1), chance.choice((1, 1, 2, 4, 8, 40))
            kind = chance.randrange(6)
            if kind == 0 and at < len(data):
                data[at] ^= 1 << chance.randrange(8)
            elif kind == 1:
                data[at:at] = chance.randbytes(length)
            elif kind == 2:
                del data[at : at + length]
            elif kind == 3:
                data[at:at] = data[at : at + length]
            elif kind == 4:
                data[at : at + length] = chance.choice((b"\0", b"\xff", b"\n", b"9")) * length
            elif chance.random() < 0.3:
                del data[at:]
        return bytes(data)

    # Lines

    def _token(self, lines: list[str]) -> list[str]:
        """Another number or word in the place of one."""
        i = self.chance.randrange(len(lines))
        for pattern in self.chance.sample((_NUMBER, _WORD, _NUMBER), 3):
            if found := list(pattern.finditer(lines[i])):
                one = self.chance.choice(found)
                by = self.chance.choice(NUMBERS if self.chance.random() < 0.7 else WORDS)
                lines[i] = lines[i][: one.start()] + by + lines[i][one.end() :]
                break
        return lines

    def _fields(self, lines: list[str]) -> list[str]:
        """Remove, double or swap fields of a line, or change what is between them."""
        i = self.chance.randrange(len(lines))
        marks = _FIELD.findall(lines[i])
        if not marks:
            return lines
        mark = self.chance.choice(marks)
        parts = lines[i].split(mark)
        k, kind = self.chance.randrange(len(parts)), self.chance.randrange(6)
        if kind == 0:
            del parts[k]
        elif kind == 1:
            parts[k:k] = [parts[k]] * self.chance.choice((1, 1, 2, 3000))
        elif kind == 2:
            j = self.chance.randrange(len(parts))
            parts[k], parts[j] = parts[j], parts[k]
        elif kind == 3:
            mark = self.chance.choice(SEPARATORS)
        elif kind == 4:
            parts[k] = self.chance.choice(('"', "'", "")) + parts[k] + self.chance.choice(('"', "'", "\n"))
        else:
            parts[k] = self.chance.choice(WORDS)
        lines[i] = mark.join(parts)
        return lines

    def _line(self, lines: list[str]) -> list[str]:
        """Remove, double, swap, repeat or insert lines."""
        i, j = self.chance.randrange(len(lines)), self.chance.randrange(len(lines))
        kind = self.chance.randrange(7)
        if kind == 0:
            del lines[min(i, j) : max(i, j)]
        elif kind == 1:
            lines.insert(j, lines[i])
        elif kind == 2:
            lines[i], lines[j] = lines[j], lines[i]
        elif kind == 3:
            lines[i:i] = [lines[i]] * self.chance.choice((2, 20, 1000))
        elif kind == 4:
            lines.insert(i, self.chance.choice((*WORDS, *NUMBERS)))
        elif kind == 5:
            del lines[i]
        else:
            lines[i] = self.chance.choice(("#", "!", "|", " ", "\t", "&")) + lines[i]
        return lines or [""]

    def _count(self, lines: list[str]) -> list[str]:
        """Change an integer, such as a number of values that a header states, by a little or a lot."""
        i = self.chance.randrange(len(lines))
        if found := list(re.finditer(r"\d+", lines[i])):
            one = self.chance.choice(found)
            by = int(one.group()[:15]) + self.chance.choice((-1, 1, 7, -1000, 10**6, 2**31 - 2, 10**12))
            lines[i] = lines[i][: one.start()] + f"{by:{len(one.group())}}" + lines[i][one.end() :]
        return lines

    def _long(self, lines: list[str]) -> list[str]:
        """A line that is very long."""
        i = self.chance.randrange(len(lines))
        more = self.chance.choice((",", " ", "x", '"', "1,", "(", "\t", "'"))
        lines[i] += more * self.chance.choice((100, *[5000] * 8, 1_100_000))
        return lines

    _LINES: tuple[Callable[[Damage, list[str]], list[str]], ...] = (
        *(_token, _token, _token, _token, _token, _fields, _fields, _fields, _line, _line, _count, _count),
        *(_token, _token, _token, _token, _token, _fields, _fields, _fields, _line, _line, _count, _long),
    )

    # The file as a whole

    def _cut(self, content: bytes) -> bytes:
        return content[: self.chance.randrange(len(content) + 1)]

    def _mixed(self, content: bytes) -> bytes:
        """The beginning of a file and the end of another."""
        other = self.chance.choice(self.others)
        return content[: self.chance.randrange(len(content) + 1)] + other[self.chance.randrange(len(other) + 1) :]

    def _line_ends(self, content: bytes) -> bytes:
        return content.replace(b"\n", self.chance.choice((b"\r\n", b"\r", b"\n\n", b"\n\r", b"\x0b", b" \n", b"")))

    def _encoding(self, content: bytes) -> bytes:
        text = content.decode("utf-8", "replace")
        kind = self.chance.choice(("utf-8-sig", "utf-16", "utf-16-le", "utf-16-be", "utf-32", "latin-1", "cp1252", "utf-7"))
        return text.encode(kind, "replace")

    def _letters(self, content: bytes) -> bytes:
        """Characters outside ASCII, right or wrong ones, in the place of a letter."""
        at = self.chance.randrange(len(content) + 1)
        odd = (b"\xe9", b"\xc3\xa9", b"\xff\xfe", b"\xed\xa0\x80", b"\xc0\x80", b"\xf4\x90\x80\x80", b"\0", b"\x1b", b"\x80")
        return content[:at] + self.chance.choice(odd) + content[at + 1 :]

    def _twice(self, content: bytes) -> bytes:
        return content * self.chance.choice((2, 2, 2, 50))

    def _empty(self, content: bytes) -> bytes:
        return self.chance.choice((b"", b"\n", b"\0" * 100, b" " * 100, b"\xef\xbb\xbf", b"\xff\xfe"))

    _WHOLE: tuple[Callable[[Damage, bytes], bytes], ...] = (
        *(_cut, _cut, _cut, _mixed, _mixed, _line_ends, _encoding, _letters, _letters, _twice, _empty),
    )

    # Trees of JSON

    def tree(self, value: Any) -> Any:
        """Change one place in a tree of JSON."""
        places: list[tuple[Any, Any]] = []

        def walk(node: Any) -> None:
            pairs = node.items() if isinstance(node, dict) else enumerate(node) if isinstance(node, list) else ()
            for key, inner in pairs:
                places.append((node, key))
                walk(inner)

        walk(value)
        if not places:
            return self.chance.choice(_ODD)
        node, key = self.chance.choice(places)
        kind = self.chance.randrange(5)
        if kind == 0:
            del node[key]
        elif kind == 1 and isinstance(node, list):
            node[key:key] = [node[key]] * self.chance.choice((1, 2, 1000))
        elif kind == 1 and isinstance(node, dict):
            node[self.chance.choice((key + "x", key.upper(), "", "\0", "__class__", "format"))] = node[key]
        elif kind == 2:
            other, place = self.chance.choice(places)
            node[key] = json.loads(json.dumps(other[place])) if place in other or isinstance(other, list) else None
        elif kind == 3 and isinstance(node[key], (int, float)):
            node[key] = self.chance.choice((0, -1, -node[key], 10**400, 1e308, 0.5, node[key] + 1, 2**31, 2**63))
        else:
            node[key] = self.chance.choice(_ODD)
        return value

    def json(self, content: bytes) -> bytes:
        """Damage a JSON file: its tree, its text, how deep it is."""
        kind = self.chance.random()
        if kind < 0.1:
            deep = self.chance.choice((10, 1000, 100_000))
            inner = self.chance.choice((b"[", b'{"a":')) * deep
            at = content.find(b":", self.chance.randrange(len(content))) + 1
            return content[:at] + inner + content[at:]
        if kind < 0.35:
            return self.text(content)
        try:
            value = json.loads(content)
        except ValueError:
            return self.text(content)
        for _ in range(self.chance.choice((1, 1, 2, 3))):
            value = self.tree(value)
        return json.dumps(value).encode()

    # Archives

    def archive(self, content: bytes) -> bytes:
        """Damage a .npz: its tree, the heads and contents of its arrays, its members, its bytes."""
        kind = self.chance.random()
        if kind < 0.25:
            return self.bytes(content)
        with zipfile.ZipFile(io.BytesIO(content)) as archive:
            members = [(name, archive.read(name)) for name in archive.namelist()]
        way = zipfile.ZIP_STORED
        i = self.chance.randrange(len(members))
        name, data = members[i]
        if kind < 0.65:
            name, data = members[i := 0]
            value = json.loads(data)
            for _ in range(self.chance.choice((1, 1, 2, 3))):
                value["result"] = self.tree(value["result"])
            members[0] = (name, json.dumps(value).encode())
        elif kind < 0.8 and name.endswith(".npy"):
            members[i] = (name, self._array(data))
        elif kind < 0.9:
            change = self.chance.randrange(5)
            if change == 0:
                del members[i]
            elif change == 1:
                members.append(members[i])
            elif change == 2:
                members[i] = (self.chance.choice(("../x", "/x", "0.npy", "x" * 60000, "")), data)
            elif change == 3:
                members[i] = (name, data + bytes(20_000_000))
                way = zipfile.ZIP_DEFLATED
            else:
                self.chance.shuffle(members)
        else:
            members[i] = (name, self.bytes(data))
        made = io.BytesIO()
        with zipfile.ZipFile(made, "w", way) as archive:
            for name, data in members:
                archive.writestr(zipfile.ZipInfo(name), data, way)
        return made.getvalue()

    def _array(self, data: bytes) -> bytes:
        """Damage the head of an .npy: its type and shape, its length."""
        (length,) = struct.unpack_from("<H", data, 8)
        head = data[10 : 10 + length].decode("latin-1")
        kind = self.chance.randrange(4)
        if kind == 0:
            types = ("|O", "<f4", ">f8", "<i8", "|S8", "<U9", "|V8", "<M8[s]", "<c16", "|b1", "nonsense", "<f16")
            head = re.sub(r"'descr': '[^']*'", f"'descr': '{self.chance.choice(types)}'", head)
        elif kind == 1:
            shapes = ("()", "(0,)", "(-1,)", "(1,)", "(2147483648,)", "(10000000000000000000000,)", "(2, 3)", "(1e3,)", "x")
            head = re.sub(r"\([^)]*\)", self.chance.choice(shapes), head)
        elif kind == 2:
            head = head.replace("False", self.chance.choice(("True", "None", "(" * 500, "__import__('os')")))
        else:
            return data[:10] + self.bytes(data[10:])
        return data[:8] + struct.pack("<H", len(head)) + head.encode("latin-1") + data[10 + length :]

    # Checkpoints

    def store(self, content: bytes) -> bytes:
        """Damage a checkpoint; half of the time its fingerprints are made right again."""
        if self.chance.random() < 0.3:
            return self.bytes(content)
        head, entries = split_store(content)
        if self.chance.random() < 0.5:
            head = self.text(head)[:200_000]
        else:
            i = self.chance.randrange(len(entries))
            kind = self.chance.randrange(6)
            if kind == 0:
                entries.insert(i, entries[self.chance.randrange(len(entries))])
            elif kind == 1:
                del entries[i]
            elif kind == 2:
                self.chance.shuffle(entries)
            else:
                row, histories, length = struct.unpack_from("=iiq", entries[i])
                body = entries[i][32:]
                if kind == 3:
                    row = self.chance.choice((0, -1, 1, 2**31 - 1, row + 1, -(2**31)))
                elif kind == 4:
                    histories = self.chance.choice((0, -1, 2**31 - 1, histories + 1, 1))
                    length = self.chance.choice((length, 0, -1, 2**62, length + 1))
                else:
                    body = self.bytes(body)
                start = struct.pack("=iiq", row, histories, length)
                entries[i] = start + fingerprint(start, body) + body
        return join_store(head, entries)


# What stands in JSON where something else is expected
_ODD: tuple[Any, ...] = (
    *(None, True, False, 0, -1, 1e308, float("nan"), float("inf"), 10**30, "", "nan", "\0", "\u202e", [], {}, [[]], "x" * 1000),
    *({"float": "nan"}, {"float": "x"}, {"array": "0.npy"}, {"array": "99.npy"}, {"Wall": {}}, {"list": 3}, {"mapping": [[[], 1]]}),
    *({"mapping": [[{"list": []}, 1]]}, {"scalar": "0.npy"}, {"State": 7}, {"a": 1, "b": 2}),
)  # fmt: skip


def split_store(content: bytes) -> tuple[bytes, list[bytes]]:
    """Head and rows of a valid checkpoint."""
    first, _, rest = content.partition(b"\n")
    at = int(first.split()[3])
    head, rows = rest[:at], []
    while at + 32 <= len(rest):
        (length,) = struct.unpack_from("=q", rest, at + 8)
        rows.append(rest[at : at + length])
        at += length
    return head, rows


def join_store(head: bytes, rows: list[bytes]) -> bytes:
    """A checkpoint of a head and rows, with the fingerprint of the head."""
    return b"dondolo counts 3 %8d %s\n" % (len(head), fingerprint(head, b"")) + head + b"".join(rows)


def fingerprint(*texts: bytes) -> bytes:
    """Fingerprint of texts, as src/dondolo/base/numerics/fingerprint.f90 makes it."""
    out = b""
    for prime, base, value in ((2147483647, 1103515245, 1), (2147483629, 1597334677, 2)):
        for text in texts:
            words = struct.unpack(f"={-(-len(text) // 4)}i", text + b" " * (-len(text) % 4))
            for word in (len(text), *words):
                value = (value * base + word % prime + 1) % prime
        out += b"%08X" % value
    return out
