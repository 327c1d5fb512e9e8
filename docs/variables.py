"""Page of the site on the variables of a case, from the tables of the library."""

import re

from dondolo._fortran.library import Property, properties

# How the meaning of a variable says what applies where it is left out
LEFT_OUT = re.compile(r", ([^,;]+) if not given|; ([^,;]+) if not given")
MECHANISMS = next(row.choices for row in properties("wall") if row.name == "mechanism")

TITLES = {
    "job": "The task and its output",
    "wall": "One wall, for the tasks 'stripes' and 'history'; also as columns of a population",
    "building": "The building below a wall that does not stand on the ground; also as columns of a population",
    "uncertainty": "Uncertain properties of the one wall of a case, for the task 'typology' with `&wall`; each"
    " property is a distribution: 'uniform(low, high)', 'triangular(low, mode, high)', 'normal(mean, sd)' or"
    " 'lognormal(theta, beta)', the last two also with low, high, where they are truncated",
    "row": "Further columns of a population",
    "population": "A population of walls, for the task 'typology'",
    "records": "The accelerograms",
    "stripes": "The intensity measure and its levels",
    "solver": "Integration of the motions",
    "check": "A check by a building code beside the curves, for the tasks 'stripes' and 'typology'",
    "history": "The record and its level, for the task 'history'",
}
HEAD = """# Variables of a case

Every variable of a namelist file, group by group. `dondolo --template` prints the same as a case that runs.

```fortran
&wall mechanism = 'one_sided' height = 3.0 thickness = 0.25 /
```

The names of `&wall` and `&building` are also the columns of a population and the arguments of the walls and of
`dd.Building` in Python. Values of a list are in numbered columns, `period1`, `period2` ... In Python they are parts:
`tie_height` and `tie_area` of all ties are `height` and `area` of each `dd.Tie`. The same holds for `dd.Section`,
`dd.Load`, `dd.InertialMass` (`inertia_mass`), `dd.Thrust`, `dd.Spring`, `dd.DistributedSpring`, `dd.Wedge` and
`dd.Opening`;
`dd.Interlock` has the names that begin with `interlock`.

A variable without a default has no value if left out. An empty `only for` means all mechanisms and tasks.
"""


def allowed(row: Property) -> str:
    """What a value can be."""
    if row.choices:
        return ", ".join(f"'{choice}'" for choice in row.choices)
    low, high = (f"{limit:.6g}" if abs(limit) < 1e308 else "" for limit in (row.smallest, row.largest))
    if row.bounds == "less":
        return f"at least {low}, less than {high}"
    if row.bounds == "positive" and not low:
        return f"more than 0, at most {high}" if high else "more than 0"
    if low and high:
        return f"{low} to {high}"
    return f"at least {low}" if low else f"at most {high}" if high else ""


def default(row: Property) -> str:
    """Its default, or that it has none."""
    if row.instead:
        return "required, or " + re.sub(r"\b(?!and\b)\w+", lambda name: f"`{name[0]}`", row.instead)
    if row.default == "required":
        return "required"
    if row.default == "optional":
        said = LEFT_OUT.search(row.meaning)
        text = (said[1] or said[2]) if said else ""
        return f"`{text}`" if re.fullmatch(r"[\d.e-]+", text) else text
    return f"`'{row.default}'`" if row.kind == "text" else f"`{row.default}`" if row.default else ""


def table(group: str) -> list[str]:
    """Lines of the table of a group."""
    title = f"## {'Columns' if group == 'row' else f'&{group}'}"
    lines = [title, "", TITLES[group] + ".", "", "| variable | unit | default | allowed | only for | meaning |"]
    lines.append("|---|---|---|---|---|---|")
    for row in properties(group):
        owners = "" if set(row.owners) == set(MECHANISMS) else ", ".join(row.owners)
        meaning = LEFT_OUT.sub("", row.meaning)
        if row.not_with:
            meaning += "; not with " + ", ".join(f"`{name}`" for name in row.not_with)
        cells = [f"`{row.name}`", row.unit, default(row), allowed(row), owners, meaning]
        lines.append("| " + " | ".join(cells) + " |")
    return [*lines, ""]


def page() -> str:
    """The page."""
    return HEAD + "\n" + "\n".join(line for group in TITLES for line in table(group))
