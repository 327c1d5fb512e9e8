"""States of the page of ``dondolo serve`` with a value that is refused: of every field, and of every kind of part."""

WALLS = {
    "one_sided": {
        "mechanism": "one_sided",
        "height": 6.0,
        "thickness": 0.5,
        "load": [12e3],
        "load_height": [6.0],
        "load_depth": [0.2],
        "load_inertia": "both",
        "thrust": [500.0],
        "thrust_height": [5.0],
        "tie_height": [5.7],
        "tie_bar": [0.014],
        "tie_spacing": [3.0],
        "tie_length": [8.0],
        "tie_plate_width": [0.3],
        "tie_plate_height": [0.3],
        "tie_plate_thickness": [0.02],
        "masonry_compression": 2e6,
        "masonry_shear": 4e4,
        "masonry_tension": 5e4,
    },
    "free_standing": {
        "mechanism": "free_standing",
        "section_height": [1.5, 1.0],
        "section_thickness": [0.4, 0.3],
        "load": [2e3],
        "load_height": [2.5],
        "load_depth": [0.2],
        "load_inertia": "both",
    },
    "two_block": {
        "mechanism": "two_block",
        "height": 3.0,
        "thickness": 0.25,
        "hinge": 0.6,
        "overburden": 5e3,
        "overburden_inertia": 0.5,
    },
    "horizontal": {
        "mechanism": "horizontal",
        "length": 5.0,
        "thickness": 0.45,
        "end_thrust": 25e3,
        "compressive_strength": 1.5e6,
        "push": [300.0],
        "push_x": [2.0],
        "sides": 1,
        "restitution_value": 0.7,
    },
    "corner": {
        "mechanism": "corner",
        "height": 3.2,
        "thickness": 0.5,
        "hinge_depth": 0.03,
        "wing_angle": 20.0,
        "wing_length": 1.2,
        "load_total": [6e3],
        "load_depth": [0.45],
        "load_height": [3.2],
        "load_inertia": "both",
        "thrust_total": [2e3],
        "thrust_depth": [0.4],
        "thrust_height": [3.2],
    },
}
OTHERS = {
    "job": {"task": "stripes"},
    "records": {"polarity": "both"},
    "stripes": {"im": "pga", "levels": [0.5]},
    "building": {"period": [0.3], "damping": [0.05], "storeys": 2, "level": 0.0, "building_height": 8.0},
    "check": {"ag": [0.2], "f0": [2.5], "tc_star": [0.35], "soil": "B", "knowledge_factor": 1.2},
}


def states(tables):
    """Each field of each kind of wall beyond what it may be, of another type, of another length, and left out."""
    for mechanism, wall in WALLS.items():
        whole = {**OTHERS, "wall": wall}
        for group, table in tables.items():
            here = whole.get(group, {})
            for name, row in table.items():
                if row["owners"] and mechanism not in row["owners"] and "stripes" not in row["owners"]:
                    continue
                if name == "output":
                    # The page has no field for it.
                    continue
                for value in _values(row, here.get(name)):
                    yield {**whole, group: {**here, name: value}}
                if name in here and (group, name) != ("job", "task"):
                    yield {**whole, group: {other: here[other] for other in here if other != name}}
        yield {**whole, "wall": {**wall, "zz": 0.4}}


def _values(row, usual):
    """Values that a field of the page can get: of a number of each part numbers, else words."""
    kind = row["kind"]
    if kind == "logical":
        return ["zz", True]
    if kind in ("text", "words") or row["choices"]:
        return ["zz", "z" * 300, 0.3]
    ends = [
        -1.0,
        1e12,
        0.0,
        1e3,
        *(end for end in (2.0 * row["low"] - 1.0, 2.0 * row["high"] + 1.0) if abs(end) < 1e300),
    ]
    if kind == "integer":
        return [*map(int, ends[:4]), 1.5, "zz"]
    if kind != "list":
        return [*ends, "zz"]
    parts = len(usual) if isinstance(usual, list) else 1
    return [*([end] * parts for end in ends), [0.1] * (parts + 1), ["zz"] * parts]
