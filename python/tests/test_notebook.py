"""In a notebook, run by a kernel of Jupyter: pictures and progress bars."""

import pytest

nbclient, nbformat, _ = (pytest.importorskip(name) for name in ("nbclient", "nbformat", "ipykernel"))

pytestmark = pytest.mark.slow

SETUP = """
import numpy as np
import dondolo as dd

wall = dd.FreeStandingWall(height=6.0, thickness=0.9)
sine = dd.Record(np.sin(2.0 * np.pi * 0.01 * np.arange(401)), 0.01)
motion = dd.simulate(wall, sine, 2.0)
"""
OWN = "import matplotlib.pyplot as plt\nlines = plt.plot([1, 2], [3, 4])\nlen(plt.gca().get_lines())"


def run(*cells):
    """Outputs of the cells of a notebook."""
    notebook = nbformat.v4.new_notebook(cells=[nbformat.v4.new_code_cell(cell) for cell in cells])
    nbclient.NotebookClient(notebook, timeout=120, kernel_name="python3").execute()
    return [cell.outputs for cell in notebook.cells]


def pictures(outputs):
    """Number of pictures among the outputs of a cell."""
    return sum("image/png" in output.get("data", {}) for output in outputs)


def value(outputs):
    """Result of a cell, as text."""
    return next(output.data["text/plain"] for output in outputs if output.output_type == "execute_result")


def test_every_cell_has_its_own_picture():
    drawn = ("axes = motion.plot()", "axes = motion.plot_peak()", "film = motion.animate()")
    _, *outputs, own = run(SETUP, *drawn, OWN)
    assert [pictures(cell) for cell in outputs] == [1, 1, 1]
    # The user's own line is alone in a figure of its own.
    assert (pictures(own), value(own)) == (1, "1")


def test_progress_and_a_report_leave_pictures_alone(tmp_path):
    missing = "import sys\nsys.modules['ipywidgets'] = None"
    stripes = "stripes = dd.multiple_stripe(wall, [sine], [0.1, 0.2])"
    report = f"dd.report(motion, {str(tmp_path / 'report.html')!r})"
    *_, ran, written, own = run(missing, SETUP, stripes, report, OWN)
    # A bar of plain text, and no warning that the widgets are missing
    shown = "".join(output.text for output in ran if output.name == "stderr")
    assert "history/s" in shown
    assert "Warning" not in shown
    assert written == []
    assert (pictures(own), value(own)) == (1, "1")


# Draws each result in a cell of its own; the last line of a cell is what it shows.
STUDY = """
parapet = dd.OneSidedWall(height=1.5, thickness=0.25, name="parapet")
records = dd.synthetic_records(magnitude=6.5, distance=10.0, site="shallow", n_records=12)
levels = [0.3, 0.5, 0.7, 0.9, 1.1, 1.4]
stripes = dd.multiple_stripe(parapet, records, levels, progress=False)
curve = stripes.fit()
other = dd.OneSidedWall(height=1.8, thickness=0.25, name="other")
people = dd.typology([parapet, other], records, levels, progress=False)
risk = curve.risk(dd.HazardCurve([0.05, 0.5, 3.0], [0.05, 0.001, 1e-7]))
two_block = dd.TwoBlockWall(3.0, 0.25)
options = {"progress": False}
"""
DRAWN = (
    "axes = parapet.plot()",
    "axes = dd.Population([parapet, other]).plot()",
    "axes = dd.RecordSet(records).plot()",
    "axes = stripes.plot()",
    "axes = stripes.plot_damage_states()",
    "axes = curve.plot()",
    "axes = people.plot()",
    "axes = people['all'].plot()",
    "axes = stripes.incremental().plot()",
    "axes = dd.cloud(parapet, records).plot()",
    "axes = risk.plot_deaggregation()",
    "axes = risk.uncertainty(n_draws=100).plot()",
    "axes = dd.compare_designs({'now': parapet, 'other': other}, records, levels, **options).plot()",
    "axes = dd.weakest_hinge(two_block, records, levels, hinges=[0.5, 0.7], **options).plot()",
)


def test_every_result_draws_one_picture_and_shows_a_table():
    """A figure in each cell, also after others, and the table of the object that ends the cell."""
    cells = [f"{line}\n{line.split('.plot')[0].removeprefix('axes = ')}" for line in DRAWN]
    _, _, *outputs, own = run(SETUP, STUDY, *cells, OWN)
    for line, cell in zip(DRAWN, outputs, strict=True):
        assert pictures(cell) == 1, line
        (table,) = (output.data["text/html"] for output in cell if output.output_type == "execute_result")
        assert "<table>" in table or "<td>" in table, line
    assert (pictures(own), value(own)) == (1, "1")


def test_bars_of_widgets_come_to_their_end():
    """With ipywidgets a bar is a widget; it is closed at the end, and nothing but it is shown."""
    pytest.importorskip("ipywidgets", reason="needs ipywidgets")
    bars = """
import ipywidgets, warnings
warnings.simplefilter("ignore")
from tqdm.notebook import tqdm_notebook
ended = []
close = tqdm_notebook.close
def watched(bar):
    if not bar.disable:
        ended.append((bar.n, bar.total))
    close(bar)
tqdm_notebook.close = watched
"""
    calls = (
        "stripes = dd.multiple_stripe(wall, [sine], [0.1, 0.2, 0.3])",
        "found = dd.typology([wall, dd.OneSidedWall(3.0, 0.25)], [sine], [0.1, 0.2, 0.3])",
        "sure = dd.multiple_stripe(wall, [sine], [0.1, 0.2], certify=True)",
    )
    _, _, *outputs, ended = run(bars, SETUP, *calls, "sorted(set(ended))")
    for cell in outputs:
        # No bar of text beside it, no warning
        assert "".join(output.text for output in cell if output.output_type == "stream").strip() == ""
        assert {output.output_type for output in cell} <= {"display_data", "stream"}
    counts = eval(value(ended))
    assert len(counts) > 1
    assert all(done == total for done, total in counts)
