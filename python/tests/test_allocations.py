"""What grows with the input is allocated with stat=, or its room is asked for beforehand in a file named here."""

import re

SOURCES = ("src", "app", "python/dondolo/_fortran")

# Who asks whether there is room, for what stands in which files
ASKED = {
    "src/dondolo/base/system/text_file.f90": r"src/dondolo/(base/(system/text_file|text/)|case/namelist/"
    r"|record/(formats/|metadata|record_(format|reader|table))|case/tasks/population_case)",
    "src/dondolo/record/catalogue.f90": r"src/dondolo/record/catalogue",
    "src/dondolo/case/input/read_case.f90": r"src/dondolo/record/(suite|record_set|reading_notes)",
    "src/dondolo/building/floors.f90": r"src/dondolo/building/floor",
    "src/dondolo/fragility/study.f90": r"src/dondolo/fragility/study",
    "src/dondolo/fragility/stripes.f90": r"src/dondolo/(fragility/(stripes|stripe_counts)|motion/common/queue)",
    "src/dondolo/fragility/certified.f90": r"src/dondolo/(fragility/certified|motion/certificate)",
    "src/dondolo/population/population_reader.f90": r"src/dondolo/population/(population_reader|run_\w+|row_result)\.",
    "src/dondolo/population/population.f90": r"src/dondolo/(population/(population|typology|weights)\."
    r"|base/numerics/order)",
    "src/dondolo/population/population_errors.f90": r"src/dondolo/population/population_errors",
    "src/dondolo/population/population_curves.f90": r"src/dondolo/(case/tasks/combine_rows"
    r"|population/(unions|population_curves))",
    "src/dondolo/case/results/columns.f90": r"src/dondolo/case/results/columns",
    "src/dondolo/population/store.f90": r"src/dondolo/population/store\.",
    "src/dondolo/interface/c_records.f90": r"src/dondolo/interface/c_records",
    "python/dondolo/_fortran/curves.f90": r"src/dondolo/fragility/logit|python/dondolo/_fortran/curves",
    "python/dondolo/_fortran/curve_parcel.f90": r"python/dondolo/_fortran/curve_parcel",
    "python/dondolo/_fortran/populations.f90": r"python/dondolo/_fortran/populations",
    "python/dondolo/_fortran/histories.f90": r"python/dondolo/_fortran/histories",
    "python/dondolo/_fortran/record_parcel.f90": r"python/dondolo/_fortran/(record_)?parcel",
    "python/dondolo/_fortran/results_parcel.f90": r"python/dondolo/_fortran/results_parcel",
    "python/dondolo/_fortran/store_parcel.f90": r"python/dondolo/_fortran/store_parcel",
    "python/dondolo/_fortran/stores.f90": r"python/dondolo/_fortran/stores",
    "python/dondolo/_fortran/stripes.f90": r"python/dondolo/_fortran/stripes",
    "python/dondolo/_fortran/walls.f90": r"python/dondolo/_fortran/walls",
    "python/dondolo/_fortran/uncertainty.f90": r"src/dondolo/population/sensitivity",
    "python/dondolo/_fortran/wall_parcel.f90": r"python/dondolo/_fortran/wall_parcel",
}

# What stays small, and why
SMALL = {
    "app/arguments|src/dondolo/base/system/process": "a word of the command line",
    "app/(synthetic44|benchmark_walls)": "records and walls of a fixed number",
    "app/union_lines": "levels of a union or two",
    "src/dondolo/base/system/checksum": "a chunk of a file",
    "src/dondolo/case/results/(csv_table|report_rows)": "a row of a table",
    "src/dondolo/case/results/replaced": "the beginning of a file, whose length is limited",
    "src/dondolo/(base/properties/|case/input/survey|building/building)": "lists of properties",
    "src/dondolo/wall/table_fit.f90": "rows of a table, 10000 at most",
    "src/dondolo/wall/(wall_(body|lists|ties)|tie_statics|interlocking)": "lists of properties",
    "src/dondolo/(case/(warnings/|groups/stripes_group)|fragility/ordinal)": "levels and states",
    "python/dondolo/_fortran/checks": "lines of the sheet of a check",
    "src/dondolo/fragility/tie_tallies": "levels and ties of a wall",
    "src/dondolo/motion/(common/restraint_state|lanes/normal_form)": "ties of a wall",
    "src/dondolo/motion/lanes/lane(s|_restraints|_state)": "lanes, whose number is fixed",
    "src/dondolo/record/last_number": "prints of a fixed number",
    "src/dondolo/record/synthetic/": "harmonics of a record whose duration is limited",
    "src/dondolo/base/system/number_table": "so many numbers as the reader allows",
    "src/dondolo/population/store_format": "a head, or a row, whose length is limited",
    "src/dondolo/population/variants": "some numbers for each sample, whose number is limited",
    "src/dondolo/interface/handles": "places of what was made, a chunk at a time",
    "src/dondolo/interface/c_text": "a name or a path",
}


def unasked(path):
    """Allocations of a source file whose size is not a number and that have no stat=."""
    text = re.sub(r"&[ \t]*(?:![^\n]*)?\n[ \t]*&?", " ", path.read_text())
    for content in re.findall(r"^[^!\n]*\ballocate ?\((.*)\)[ \t]*(?:!.*)?$", text, re.MULTILINE):
        sizes = re.findall(r"\(((?:[^()]|\([^()]*\))*)\)", content)
        if "stat=" not in content and ("len=" in content or not all(re.fullmatch(r"[\d:, ]*", x) for x in sizes)):
            yield content


def test_every_allocation_may_fail(root):
    files = [path for folder in SOURCES for path in (root / folder).rglob("*.[fF]90")]
    names = {path.relative_to(root).as_posix(): path for path in files}
    open_ones = {name for name, path in names.items() if any(unasked(path))}
    assert len(open_ones) > 10
    rules = [*ASKED.values(), *SMALL]
    assert [name for name in sorted(open_ones) if not any(re.match(rule, name) for rule in rules)] == []
    assert [rule for rule in rules if not any(re.match(rule, name) for name in open_ones)] == []
    for name in ASKED:
        assert re.search(r"call check_room\(", names[name].read_text()), name


def test_an_allocation_is_seen(tmp_path):
    path = tmp_path / "a.f90"
    path.write_text(
        "if (x) allocate (a(n), b(3)) ! why\nallocate (c(0))\nallocate (d(n), stat=k)\n! allocate (e(n))\n"
        "allocate (f(2), &\n   & g(size(h)))\nallocate (character(len=n) :: i)\ndeallocate (j(n))\nallocate (k)\n"
    )
    assert [found[0] for found in unasked(path)] == ["a", "f", "c"]
