"""What to cite: one list of sources for the executable, for results in Python, for reports and for CITATION.cff."""

import json
import re
import subprocess

import numpy as np
import pytest

import dondolo as dd


def entries(text):
    """Entries of BibTeX: key -> fields."""
    found = {}
    for body in re.split(r"(?m)^@", text)[1:]:
        kind, key = re.match(r"(\w+)\{(\w+),\n", body).groups()
        found[key] = {"kind": kind} | dict(re.findall(r"(?m)^  (\w+) = \{(.*)\},$", body))
        assert body.rstrip().endswith("\n}")
        assert body.count("{") == body.count("}")
    return found


@pytest.fixture(scope="module")
def everything(root):
    """All sources, by their keys."""
    text = (root / "src/study/files/references.f90").read_text()
    keys = re.findall(r"reference_type\('(\w+)'", text)
    from dondolo._fortran.library import bibtex

    found = entries("\n".join(bibtex(keys)))
    assert list(found) == ["dondolo", *keys]
    return found


def test_every_source_is_whole(everything):
    """Each has author, title, place and year, and no field is cut off by the length of its text."""
    fields = {"article": "journal", "misc": "howpublished", "inproceedings": "booktitle", "incollection": "booktitle"}
    for key, entry in everything.items():
        place = "note" if key == "dondolo" else fields[entry["kind"]]
        assert {"author", "title", place, "year"} <= set(entry), key
        assert entry["year"] in key or key == "dondolo"
        if entry["kind"] == "article":
            assert re.fullmatch(r"\d+", entry["volume"]), key
            assert re.fullmatch(r"\d+--\d+", entry["pages"]), key
    assert everything["sorrentino2011"]["title"].endswith("Experimental and analytic investigations")


def test_words_of_sources_are_known(root):
    """What sources are said to be of: mechanisms, models of restitution, measures, engines, and words that are used."""
    text = (root / "src/study/files/references.f90").read_text()
    words = set(" ".join(re.findall(r"reference_type\('\w+', '\w+', '([^']*)'", text)).split())
    walls = {"one_sided", "free_standing", "two_block", "corner"}
    models = {f"{wall}/{model}" for wall in walls for model in ("default", "sorrentino", "impulse", "constant")}
    measures = {"arias", "arias-trapz", "cav", "cav-trapz", "d5-75", "d5-95", "hi", "sa", "saavg", "pga/a0", "p*pgv/a0"}
    used = (root / "src/study/case/input/cited.f90").read_text() + (
        root / "src/study/case/input/survey.f90"
    ).read_text()
    used += (root / "python/dondolo/exchange/citing.py").read_text()
    others = {word for word in words - walls - models - measures if not re.search(rf"['\"]{word}['\"]", used)}
    published = re.findall(r"published_factor_type\('(\w+)'", (root / "src/core/wall/restitution.f90").read_text())
    assert others <= set(published)


def test_the_paper_is_that_of_the_citation_file(root, everything):
    """CITATION.cff has the fields that dondolo prints of the paper, and neither a DOI nor pages that nobody knows."""
    text = (root / "CITATION.cff").read_text()
    paper = everything["nale2021"]
    names = re.findall(r"family-names: (\w+)\n\s+given-names: (\w+)", text)
    assert " and ".join(f"{family}, {given}" for family, given in names) == paper["author"]
    assert f"title: {paper['title']}" in text
    assert f"collection-title: {paper['booktitle']}" in text
    assert f"year: {paper['year']}" in text
    assert re.search(r'(?m)^date-released: "\d{4}-\d\d-\d\d"$', text)
    assert "doi" not in text.lower().replace("no doi", "")
    assert "pages" not in paper


def test_a_case_names_its_sources(root, tmp_path, executable):
    """The executable, its file of a run, what Python reads of it, and its report."""
    path = root / "data/cases/two_block.nml"
    printed = subprocess.run([executable, "--cite", path], capture_output=True, text=True, check=True).stdout
    found = entries(printed)
    assert {
        "dondolo",
        "nale2021",
        "baker2015",
        "sorrentino2008",
        "liang1986",
        "mancl2001",
        "nigam1969",
        "sabetta1996",
    } == set(found)
    results = dd.run_case(path, progress=False)
    assert list(results.run.references) == list(found)[1:]
    assert dd.cite(results) == printed.rstrip("\n")
    dd.report(results, tmp_path / "report.html")
    page = (tmp_path / "report.html").read_text()
    assert all(f"{{{key}," in page for key in found)


def test_the_commit_is_one_everywhere(tmp_path, executable):
    """In the entry of dondolo, in the file of a run and in that which Python writes."""
    note = entries(dd.cite())["dondolo"]["note"]
    commit = re.fullmatch(rf"Version {re.escape(dd.__version__)}, commit (unknown|[0-9a-f]{{12}}(-dirty)?)", note)[1]
    curve_of = dd.multiple_stripe(dd.OneSidedWall(1.5, 0.25), dd.example_records()[:4], [0.6, 0.8, 1.0], progress=False)
    curve_of.write_results(tmp_path / "stripes")
    assert json.loads((tmp_path / "stripes_run.json").read_text())["commit"] == commit
    assert dd.read_results(tmp_path / "stripes").run.commit == commit


@pytest.mark.parametrize("task", ["stripes", "typology"])
def test_files_of_python_name_the_same_sources(task, tmp_path, monkeypatch):
    """`write_results` of objects, and the case of the same walls, records and levels."""
    monkeypatch.chdir(tmp_path)
    records = dd.synthetic_records(6.5, 10.0, "shallow", n_records=6)
    dd.RecordSet(records).to_catalogue("records.csv")
    walls = dd.Population([dd.TwoBlockWall(3.0, 0.25, hinge=0.6, name="strip")])
    walls.to_csv("walls.csv")
    group = "&wall mechanism = 'two_block', height = 3.0, thickness = 0.25, hinge = 0.6 /\n"
    if task == "typology":
        group = "&population file = 'walls.csv' /\n"
    (tmp_path / "case.nml").write_text(
        f"&job task = '{task}' /\n{group}&records catalogue = 'records.csv' /\n"
        "&stripes im = 'hi', levels = 0.5, 1.0, 1.5 /\n"
    )
    case = dd.run_case("case.nml", progress=False)
    options = {"im": "hi", "progress": False}
    if task == "typology":
        dd.typology(walls, records, [0.5, 1.0, 1.5], **options).write_results("ours")
    else:
        dd.multiple_stripe(walls.walls[0], records, [0.5, 1.0, 1.5], **options).write_results("ours")
    ours = json.loads((tmp_path / "ours_run.json").read_text())["references"]
    assert {"baker2015", "liang1986", "sorrentino2008", "housner1952"} <= set(ours)
    # The catalogue says that its records are synthetic
    assert "sabetta1996" in ours
    assert ours == list(case.run.references)
    assert list(dd.read_results("ours").run.references) == ours


def test_results_name_what_they_used():
    """Of walls, records, curves and analyses, each once."""
    records = dd.synthetic_records(6.5, 10.0, "shallow", n_records=4)
    wall = dd.OneSidedWall(1.5, 0.25)
    assert set(entries(dd.cite())) == {"dondolo", "nale2021"}
    assert set(entries(dd.cite(wall))) == {"dondolo", "nale2021", "housner1963", "sorrentino2011"}
    stripes = dd.multiple_stripe(wall, records, [0.5, 1.0, 1.5, 2.0], im="hi", progress=False)
    found = set(entries(dd.cite(stripes)))
    assert found == set(entries(dd.cite(stripes, records)))
    assert "sabetta1996" not in dd.cite(stripes.fit())
    assert found >= {"housner1952", "nigam1969", "sabetta1996"}
    assert "baker2015" not in found
    assert "dormand1980" in dd.cite(dd.simulate(wall, records[0]))
    assert "jalayer2017" in dd.cite(dd.cloud(wall, dd.RecordSet(dd.example_records()), progress=False))
    curve = dd.fit_fragility([0.2, 0.4], [11, 33], 44)
    assert "baker2015" in dd.cite(curve)
    assert "liang1986" not in dd.cite(curve)
    people = dd.Population([wall, dd.TwoBlockWall(3.0, 0.25, hinge=0.6)])
    found = set(entries(dd.cite(dd.typology(people, dd.example_records(), [0.5, 1.0, 1.5], progress=False))))
    assert found >= {"housner1963", "sorrentino2008", "baker2015", "liang1986"}
    with pytest.raises(dd.errors.InputError, match="has no sources to cite"):
        dd.cite(np.pi)
