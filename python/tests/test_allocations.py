"""What grows with the input is allocated with stat=, or its room is asked for beforehand in a file named here."""

import re

SOURCES = ("src", "app", "python/dondolo/_fortran")

# Who asks whether there is room, for what stands in which files
ASKED = {
    "src/study/files/text_file.f90": r"src/(study/files/|core/base/text/|study/case/namelist/"
    r"|study/records/(formats/|(format|record_reader|record_table))|core/record/metadata|study/case/tasks/population_case)",
    "src/study/records/catalogue.f90": r"src/study/records/catalogue",
    "src/study/case/input/read_case.f90": r"src/(core/record/(suite|record_set)|study/records/reading_notes)",
    "src/core/building/floors.f90": r"src/core/building/floor",
    "src/core/fragility/study.f90": r"src/core/fragility/study",
    "src/core/fragility/stripes.f90": r"src/core/(fragility/(stripes|stripe_counts)|motion/common/queue)",
    "src/core/fragility/certified.f90": r"src/core/(fragility/certified|motion/certificate)",
    "src/core/fragility/rounding.f90": r"src/core/fragility/rounding",
    "src/study/population/population_reader.f90": r"src/study/population/(population_reader|run_\w+|row_result)\.",
    "src/study/population/population.f90": r"src/(study/population/(population|typology|weights)\."
    r"|core/base/numerics/order)",
    "src/study/population/population_errors.f90": r"src/study/population/population_errors",
    "src/study/population/population_curves.f90": r"src/(study/case/tasks/combine_rows"
    r"|study/population/(unions|population_curves))",
    "src/study/case/results/columns.f90": r"src/study/case/results/columns",
    "src/study/population/store.f90": r"src/study/population/store\.",
    "src/study/interface/c_records.f90": r"src/study/interface/c_records",
    "python/dondolo/_fortran/curves.f90": r"src/core/fragility/logit|python/dondolo/_fortran/curves",
    "python/dondolo/_fortran/curve_parcel.f90": r"python/dondolo/_fortran/curve_parcel",
    "python/dondolo/_fortran/populations.f90": r"python/dondolo/_fortran/populations",
    "python/dondolo/_fortran/histories.f90": r"python/dondolo/_fortran/histories",
    "python/dondolo/_fortran/record_parcel.f90": r"python/dondolo/_fortran/(record_)?parcel",
    "python/dondolo/_fortran/results_parcel.f90": r"python/dondolo/_fortran/results_parcel",
    "python/dondolo/_fortran/store_parcel.f90": r"python/dondolo/_fortran/store_parcel",
    "python/dondolo/_fortran/stores.f90": r"python/dondolo/_fortran/stores",
    "python/dondolo/_fortran/stripes.f90": r"python/dondolo/_fortran/stripes",
    "python/dondolo/_fortran/walls.f90": r"python/dondolo/_fortran/walls",
    "python/dondolo/_fortran/uncertainty.f90": r"src/study/population/sensitivity",
    "python/dondolo/_fortran/wall_parcel.f90": r"python/dondolo/_fortran/wall_parcel",
}

# What stays small, and why
SMALL = {
    "app/arguments|src/study/files/process": "a word of the command line",
    "app/(synthetic44|benchmark_walls)": "records and walls of a fixed number",
    "app/union_lines": "levels of a union or two",
    "src/study/files/checksum": "a chunk of a file",
    "src/study/case/results/(csv_table|report_rows)": "a row of a table",
    "src/study/case/results/replaced": "the beginning of a file, whose length is limited",
    "src/core/(base/properties/|building/building)": "lists of properties",
    "src/study/case/(input/survey|groups/uncertainty)": "lists of properties",
    "src/core/wall/chain/|src/study/population/chain_files": "bodies of a chain and rows of their tables",
    "src/core/wall/table_fit.f90": "rows of a table, 10000 at most",
    "src/core/wall/(wall_(body|lists|ties)|tie_statics|interlocking|two_block|wedge|elevation)": "lists of properties",
    "src/(study/case/(warnings/|groups/stripes_group)|core/fragility/ordinal)": "levels and states",
    "python/dondolo/_fortran/checks": "lines of the sheet of a check",
    "src/core/fragility/tie_tallies": "levels and ties of a wall",
    "src/core/motion/(common/restraint_state|lanes/normal_form)": "ties of a wall",
    "src/core/motion/lanes/lane(s|_restraints|_scatter|_state)": "lanes, whose number is fixed; two for each record",
    "src/core/check/(check_input|hazard_grid|tie_curves)": "limit states; nodes of the grid that is built in; ties",
    "src/core/building/swing": "modes of a building",
    "src/core/motion/(ensemble|common/elastic_filter)": "blocks of 32 samples of the records",
    "src/core/record/measures/response_spectrum": "a block of samples, whose number is fixed",
    "src/study/records/last_number": "prints of a fixed number",
    "src/core/record/synthetic/": "harmonics of a record whose duration is limited",
    "src/study/files/number_table": "so many numbers as the reader allows",
    "src/study/population/store_format": "a head, or a row, whose length is limited",
    "src/study/population/variants": "some numbers for each sample, whose number is limited",
    "src/study/interface/handles": "places of what was made, a chunk at a time",
    "src/study/interface/c_text": "a name or a path",
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
