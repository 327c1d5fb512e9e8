"""The commands of Python that the executable hands over: nothing in a study is taken for a module of theirs."""

import os
import subprocess
from pathlib import Path

import pytest

# Modules that every command imports, early or late, of the package and of the standard library
MODULES = ("dondolo", "numpy", "html", "argparse", "sitecustomize", "usercustomize", "encodings")


@pytest.mark.parametrize("path", [None, "", ":", ".", "./", ":{other}", "{other}:", "{other}:.:/", "..:{other}"])
def test_a_study_is_no_folder_of_modules(path, executable, root, tmp_path):
    for name in MODULES:
        (tmp_path / f"{name}.py").write_text(f"open({str(tmp_path / 'ran')!r}, 'a').write('{name} ')\n")
    other = tmp_path / "other"
    other.mkdir()
    environment = {name: value for name, value in os.environ.items() if name != "PYTHONPATH"}
    if path is not None:
        environment["PYTHONPATH"] = path.format(other=other)
    command = [executable, "records", root / "data/records/synthetic44.csv"]
    done = subprocess.run(command, cwd=tmp_path, env=environment, capture_output=True, text=True, check=False)
    assert (done.returncode, done.stderr) == (0, "")
    assert "synthetic" in done.stdout or len(done.stdout.splitlines()) > 44
    assert not (tmp_path / "ran").exists()


def test_folders_of_modules_that_are_asked_for_stay(executable, root, tmp_path):
    """PYTHONPATH as clusters set it, and what it names besides the current folder."""
    (tmp_path / "study").mkdir()
    (tmp_path / "modules").mkdir()
    ran = tmp_path / "ran"
    (tmp_path / "modules/sitecustomize.py").write_text(f"open({str(ran)!r}, 'w').write('modules')\n")
    for path in (f":{tmp_path}/modules", "../modules", f"{tmp_path}/none:.:{tmp_path}/modules:"):
        ran.unlink(missing_ok=True)
        subprocess.run(
            [executable, "records", root / "data/records/synthetic44.csv"],
            cwd=tmp_path / "study",
            env=os.environ | {"PYTHONPATH": path},
            capture_output=True,
            check=True,
        )
        assert Path(ran).read_text() == "modules"
