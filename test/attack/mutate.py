"""Damage to text files that knows how they are built: lines, fields, numbers, separators, encodings; and to bytes."""

from __future__ import annotations

import random
import re
from collections.abc import Callable

# Numbers at limits, and words that stand where numbers do
NUMBERS = [
    "0", "-0", "1", "-1", "2", "1e-320", "5e-324", "1e-300", "1e300", "1.7976931348623157e308", "1e309", "-1e309",
    "1e99999", "1e-99999", "1d5", "1q3", "0x10", "1_8", "127", "128", "255", "32767", "32768", "65536", "2147483647",
    "2147483648", "-2147483648", "4294967296", "9223372036854775807", "99999999999999999999999",
    "0.1000000000000000055511151231257827", "nan", "NaN", "-nan", "inf", "Infinity", "-inf", "+5", ".5", "5.", ".",
    "+", "-", "e5", "1e", "1e+", "1,5", "1.000,5", "3*0.1", "2147483647*1", "1000000000*1", "T", "F", ".true.",
    "null",
]  # fmt: skip
WORDS = [
    "", " ", "''", '""', '"', "'", "'''", "/", "&", "&end", "!", "#", "=", ",", ";", "\\", "..", "../../etc/passwd",
    "~", "/dev/zero", "/dev/null", "*", "?", "%s%n", "$(id)", "<script>", "&lt;", "\u200b", "\u202e", "\ufeff",
    "\xe9", "\U0001f600", "\x00", "\x1b[31m", "\x7f", "\x85", "\u2028", "=1+1", "@x", "wall", "one_sided",
    "two_block", "both", "pga", "A" * 300, "9" * 500, "(" * 2000, "[" * 2000,
]  # fmt: skip
SEPARATORS = [",", ";", "\t", " ", "|", ":", "=", "  "]
_NUMBER = re.compile(r"[-+]?(?:\d+\.?\d*|\.\d+)(?:[eEdD][-+]?\d+)?")
_WORD = re.compile(r"[A-Za-z_]\w*")
_FIELD = re.compile(r"[,;\t|:=]|\s+")


def bytes_of(text: str) -> bytes:
    """A text as UTF-8; what came from bytes that are none goes back to them."""
    return text.encode("utf-8", "surrogateescape")


class TextDamage:
    """Damages text files.

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

    _LINES: tuple[Callable[[TextDamage, list[str]], list[str]], ...] = (
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
        kind = self.chance.choice(
            ("utf-8-sig", "utf-16", "utf-16-le", "utf-16-be", "utf-32", "latin-1", "cp1252", "utf-7")
        )
        return text.encode(kind, "replace")

    def _letters(self, content: bytes) -> bytes:
        """Characters outside ASCII, right or wrong ones, in the place of a letter."""
        at = self.chance.randrange(len(content) + 1)
        odd = (
            b"\xe9",
            b"\xc3\xa9",
            b"\xff\xfe",
            b"\xed\xa0\x80",
            b"\xc0\x80",
            b"\xf4\x90\x80\x80",
            b"\0",
            b"\x1b",
            b"\x80",
        )
        return content[:at] + self.chance.choice(odd) + content[at + 1 :]

    def _twice(self, content: bytes) -> bytes:
        return content * self.chance.choice((2, 2, 2, 50))

    def _empty(self, content: bytes) -> bytes:
        return self.chance.choice((b"", b"\n", b"\0" * 100, b" " * 100, b"\xef\xbb\xbf", b"\xff\xfe"))

    _WHOLE: tuple[Callable[[TextDamage, bytes], bytes], ...] = (
        *(_cut, _cut, _cut, _mixed, _mixed, _line_ends, _encoding, _letters, _letters, _twice, _empty),
    )
