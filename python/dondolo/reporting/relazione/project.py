"""What an engineer states of a project in a TOML file, for a calculation report."""

from __future__ import annotations

import os
import sys
import tomllib
from collections.abc import Mapping
from dataclasses import dataclass, field

from dondolo._base.files import read_text
from dondolo._fortran.library import check_characters
from dondolo.errors import InputError

# Words of the title page and of the parameters of design
WORDS = ("work", "place", "client", "designer", "date", "revision", "soil_reference", "knowledge_level")
# Numbers that the designer takes on: the library does not check them against a norm
NUMBERS = ("latitude", "longitude", "nominal_life", "use_coefficient")
# What only the engineer can write: paragraphs of the chapters, in their order
TEXTS = (
    "description",
    "survey",
    "purpose",
    "tests",
    "mechanism",
    "inward_rotation",
    "end_thrust",
    "chain_hinges",
    "load_analysis",
    "combinations",
    "analysis_reason",
    "code_suitability",
    "anchors",
    "record_selection",
    "building_index",
    "judgement",
)

# How values are written
_NOTATION = "texts are in quotes, Windows paths in single quotes, and numbers have a decimal point"


@dataclass(frozen=True)
class Project:
    """Data of a project.

    Attributes
    ----------
    words, numbers : mapping
        Group ``[project]``: of `WORDS` and `NUMBERS` those that are given.
    texts : mapping
        Group ``[texts]``: of `TEXTS` those that are written.
    """

    words: Mapping[str, str] = field(default_factory=dict)
    numbers: Mapping[str, float] = field(default_factory=dict)
    texts: Mapping[str, str] = field(default_factory=dict)


def read_project(path: str | os.PathLike[str] | None) -> Project:
    """Read the file of a project; a project without data if there is none.

    Raises
    ------
    InputError
        Not TOML; a group, a name or a type that it may not have; control characters and marks of direction.
    """
    if path is None:
        return Project()
    try:
        content = tomllib.loads(read_text(path))
    except tomllib.TOMLDecodeError as error:
        raise InputError(f"{os.fspath(path)}: {error}; {_NOTATION}") from None
    allowed = {"project": (*WORDS, *NUMBERS), "texts": TEXTS}
    for group, values in content.items():
        if group not in allowed or not isinstance(values, dict):
            raise InputError(f"{os.fspath(path)}: {group}: must be one of the groups [project] and [texts]")
        for name, value in values.items():
            if name not in allowed[group]:
                known = ", ".join(allowed[group])
                raise InputError(f"{os.fspath(path)}: [{group}] {name}: must be one of {known}")
            where = f"{os.fspath(path)}: [{group}] {name}"
            if name in NUMBERS:
                if (
                    isinstance(value, bool)
                    or not isinstance(value, int | float)
                    or not abs(value) <= sys.float_info.max
                ):
                    raise InputError(f"{where}: must be a number")
            elif not isinstance(value, str):
                raise InputError(f"{where}: must be a string in quotes")
            else:
                check_characters(where, value)
    given, texts = content.get("project", {}), content.get("texts", {})
    return Project(
        {name: given[name].strip() for name in WORDS if given.get(name, "").strip()},
        {name: float(given[name]) for name in NUMBERS if name in given},
        {name: text.strip() for name, text in texts.items() if text.strip()},
    )
