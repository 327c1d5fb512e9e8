"""Damage to trees of JSON, to archives of results and to checkpoints, whose check sums can be made right again."""

from __future__ import annotations

import copy
import io
import json
import re
import struct
import zipfile
from typing import Any

from mutate import TextDamage

# What stands in JSON where something else is expected
_ODD: tuple[Any, ...] = (
    *(None, True, False, 0, -1, 1e308, float("nan"), float("inf"), 10**30, "", "nan", "\0", "\u202e", [], {}, [[]]),
    *("x" * 1000, {"float": "nan"}, {"float": "x"}, {"array": "0.npy"}, {"array": "99.npy"}, {"Wall": {}}, {"list": 3}),
    *({"mapping": [[[], 1]]}, {"mapping": [[{"list": []}, 1]]}, {"scalar": "0.npy"}, {"State": 7}, {"a": 1, "b": 2}),
)


class Damage(TextDamage):
    """Damages files of every kind; see `TextDamage`."""

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
            return copy.deepcopy(self.chance.choice(_ODD))
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
            node[key] = copy.deepcopy(self.chance.choice(_ODD))
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

    def office(self, content: bytes) -> bytes:
        """Damage a file of Word: the text or the bytes of one of its parts, which parts there are, its own bytes."""
        kind = self.chance.random()
        if kind < 0.2:
            return self.bytes(content)
        with zipfile.ZipFile(io.BytesIO(content)) as archive:
            members = [(name, archive.read(name)) for name in archive.namelist()]
        for _ in range(self.chance.choice((1, 1, 3))):
            i = self.chance.randrange(len(members))
            name, data = members[i]
            if kind < 0.9:
                members[i] = (name, self.text(data) if kind < 0.6 else self.bytes(data))
            elif len(members) > 1:
                members[i : i + 1] = self.chance.choice(([], [members[i]] * 2, [("word/x.xml", data)]))
        made = io.BytesIO()
        with zipfile.ZipFile(made, "w", zipfile.ZIP_DEFLATED) as archive:
            for name, data in members:
                archive.writestr(name, data)
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
            shapes = (
                "()",
                "(0,)",
                "(-1,)",
                "(1,)",
                "(2147483648,)",
                "(10000000000000000000000,)",
                "(2, 3)",
                "(1e3,)",
                "x",
            )
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
            kind = self.chance.randrange(7)
            if kind == 0:
                entries.insert(i, entries[self.chance.randrange(len(entries))])
            elif kind == 1:
                del entries[i]
            elif kind == 2:
                self.chance.shuffle(entries)
            else:
                row, histories, ties, spare, length = struct.unpack_from("=iiiiq", entries[i])
                body = entries[i][40:]
                if kind == 3:
                    row = self.chance.choice((0, -1, 1, 2**31 - 1, row + 1, -(2**31)))
                elif kind == 4:
                    histories = self.chance.choice((0, -1, 2**31 - 1, histories + 1, 1))
                    length = self.chance.choice((length, 0, -1, 2**62, length + 1))
                elif kind == 5:
                    ties = self.chance.choice((-1, 2**31 - 1, ties + 1, 1, -(2**31)))
                    length = self.chance.choice((length, length + 24, -1, 2**62))
                else:
                    body = self.bytes(body)
                start = struct.pack("=iiiiq", row, histories, ties, spare, length)
                entries[i] = start + fingerprint(start, body) + body
        return join_store(head, entries)


def split_store(content: bytes) -> tuple[bytes, list[bytes]]:
    """Head and rows of a valid checkpoint."""
    first, _, rest = content.partition(b"\n")
    at = int(first.split()[3])
    head, rows = rest[:at], []
    while at + 40 <= len(rest):
        (length,) = struct.unpack_from("=q", rest, at + 16)
        rows.append(rest[at : at + length])
        at += length
    return head, rows


def join_store(head: bytes, rows: list[bytes]) -> bytes:
    """A checkpoint of a head and rows, with the fingerprint of the head."""
    return b"dondolo counts 4 %8d %s\n" % (len(head), fingerprint(head, b"")) + head + b"".join(rows)


def fingerprint(*texts: bytes) -> bytes:
    """Fingerprint of texts, as src/core/base/numerics/fingerprint.f90 makes it."""
    out = b""
    for prime, base, value in ((2147483647, 1103515245, 1), (2147483629, 1597334677, 2)):
        for text in texts:
            words = struct.unpack(f"={-(-len(text) // 4)}i", text + b" " * (-len(text) % 4))
            for word in (len(text), *words):
                value = (value * base + word % prime + 1) % prime
        out += b"%08X" % value
    return out
