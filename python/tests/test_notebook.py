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
