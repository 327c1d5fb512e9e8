"""Catalogues of folders, and their tables, from the shell."""

import os
import subprocess
import sys
from pathlib import Path

import numpy as np
import pytest

import dondolo as dd

TIMED = "0,0.5\n0.01,-1.0\n0.02,0.5\n"
PEER = (
    "PEER\nValley, 1/2/1990, Hall, North, 67\nACCELERATION TIME SERIES IN UNITS OF G\nNPTS= 3, DT= .02 SEC\n.1 -.2 .1\n"
)


@pytest.fixture
def folder(tmp_path):
    place = tmp_path / "files"
    (place / "sub").mkdir(parents=True)
    (place / ".hidden").mkdir()
    (place / "timed.txt").write_text(TIMED)
    (place / "three.txt").write_text("t,a (g),b (g)\n0,1,2\n0.01,-1,3\n")
    (place / "plain.txt").write_text("0\n1\n0\n")
    (place / "sub" / "valley.AT2").write_text(PEER)
    (place / ".hidden" / "other.AT2").write_text(PEER)
    (place / "notes.md").write_text("# Notes\n\nNothing to read.\n")
    return place


def run(*arguments):
    done = subprocess.run([sys.executable, "-m", "dondolo", *map(str, arguments)], capture_output=True, text=True)
    return done.returncode, done.stdout, done.stderr


def test_a_folder(folder):
    code, out, err = run("catalogue", folder)
    assert code == 0
    assert out == f"written: {folder / 'catalogue.csv'} (3 records)\n"
    assert sorted(line.split(": ")[2].split("/")[-1] for line in err.splitlines()) == [
        "notes.md",
        "plain.txt",
        "timed.txt",
    ]
    assert "units must be given" in err
    assert "the format is not known" in err
    records = dd.read_catalogue(folder / "catalogue.csv")
    assert [record.name for record in records] == ["valley", "three.a_(g)", "three.b_(g)"]
    assert (folder / "catalogue.csv").read_text().splitlines()[1:] == [
        "file,channel,dt_s,units,event,date,station,component,magnitude",
        'sub/valley.AT2,,0.02,g,Valley,1990-01-02,"Hall, North",67,',
        "three.txt,a (g),0.01,g,,,,,",
        "three.txt,b (g),0.01,g,,,,,",
    ]
    code, out, err = run("catalogue", folder)
    assert code == 2
    assert "already exists" in err


def test_steps_and_units_for_files_without(folder, tmp_path):
    target = tmp_path / "all.csv"
    code, out, err = run("catalogue", folder, "-o", target, "--dt", "0.005", "--units", "m/s2")
    assert code == 0
    assert "(5 records)" in out
    assert "which counts, not what is given for files that do not state it" in err.splitlines()[-1]
    assert len(err.splitlines()) == 2
    records = {record.name: record for record in dd.read_catalogue(target)}
    assert records["plain"].dt == 0.005
    assert records["timed"].dt == 0.01
    assert records["timed"].peak_acceleration == 1.0
    assert records["valley"].peak_acceleration == 0.2 * 9.80665


def test_units_without_a_step(folder, tmp_path):
    (folder / "titled.txt").write_text("acceleration (cm/s2)\n1\n2\n3\n")
    target = tmp_path / "all.csv"
    code, _, err = run("catalogue", folder, "-o", target, "--dt", "0.005", "--units", "m/s2")
    assert code == 0
    assert "titled" not in err
    records = {record.name: record for record in dd.read_catalogue(target)}
    assert records["titled"].peak_acceleration == 3 * 0.01


def test_names_that_are_no_utf8(folder):
    odd = os.fsencode(folder) + b"/caf\xe9.AT2"
    try:
        with open(odd, "w") as file:
            file.write(PEER)
    except OSError:
        pytest.skip("this file system knows no such names")
    code, _, err = run("catalogue", folder)
    assert code == 0
    assert "a name that UTF-8 does not know" in err


def test_stems_that_stand_there_twice(folder):
    (folder / "sub" / "three.txt").write_text("t,a (g),b (g)\n0,1,2\n0.01,-1,3\n")
    (folder / "valley.acc").write_text(PEER)
    code, out, _ = run("catalogue", folder)
    assert code == 0
    assert "(6 records)" in out
    names = {record.name for record in dd.read_catalogue(folder / "catalogue.csv")}
    assert names == {
        "valley.AT2",
        "valley.acc",
        "three.txt.a_(g)",
        "three.txt.b_(g)",
        "sub/three.txt.a_(g)",
        "sub/three.txt.b_(g)",
    }


def test_units_and_steps_of_comments(tmp_path):
    (tmp_path / "x.txt").write_text("# units: cm/s2\n# dt: 0.02\n0\n1\n2\n")
    (tmp_path / "y.csv").write_text("t,acc (g),vel (cm/s),disp (cm)\n0,1,2,3\n0.01,-1,3,4\n")
    code, _, err = run("catalogue", tmp_path, "--dt", "0.005", "--units", "m/s2")
    first = f"dondolo: {tmp_path / 'x.txt'}: dt = 0.005: the file states 0.02, which counts, "
    assert (code, err) == (0, f"{first}not what is given for files that do not state it (2 files)\n")
    x, y = dd.read_catalogue(tmp_path / "catalogue.csv")
    assert (x.dt, x.peak_acceleration) == (0.02, 0.02)
    assert (y.name, y.peak_acceleration) == ("y.acc_(g)", 9.80665)


def peer(component, quantity="ACCELERATION", units="G"):
    text = PEER.replace("North, 67", f"North, {component}")
    return text.replace("ACCELERATION TIME SERIES IN UNITS OF G", f"{quantity} TIME SERIES IN UNITS OF {units}")


# Files, and whether they are horizontal accelerograms
FILES = {
    # By their metadata, whatever they are called
    "RSN1_A000.AT2": (peer("0"), True),
    "RSN1_A-UP.AT2": (peer("90"), True),
    "RSN1_A-V.AT2": (peer("UP"), False),
    "RSN2_B.AT2": (peer("DWN"), False),
    "RSN3_C.AT2": (peer("-UP"), False),
    "RSN4_D.AT2": (peer("VERT"), False),
    "IT.ARL..HNE.txt": ("# component: HNZ\n0\n1\n0\n", False),
    "e.txt": ("# component: N90E\n0\n1\n0\n", True),
    "f.txt": ("# component: U-D\n0\n1\n0\n", False),
    "RSN7_NS.AT2": (peer("HNZ20"), False),
    "RSN8_UD.AT2": (peer("BHN00"), True),
    "RSN9_Z.AT2": (peer("HN3"), True),
    "g.txt": ("# component: düşey\n0\n1\n0\n", False),
    "h.txt": ("# COMPONENT = UD\n0\n1\n0\n", False),
    "i.txt": ("# COMPONENT = EW\n0\n1\n0\n", True),
    "j.txt": ("# Vertical component\n0\n1\n0\n", False),
    "k.txt": ("# Richtung: vertikal\n0\n1\n0\n", False),
    "l.txt": ("# channel: 3 (Up)\n0\n1\n0\n", False),
    "m.txt": ("# id: IT.AQV..HNZ\n0\n1\n0\n", False),
    "n.txt": ("# record: AQV NS\n0\n1\n0\n", True),
    "o.txt": ("time (s),acc UD (g)\n0,0\n0.01,1\n0.02,0\n", False),
    "p.txt": ("time (s),acc EW (g)\n0,0\n0.01,1\n0.02,0\n", True),
    "q.txt": ("accelerazione verticale\n0\n1\n0\n", False),
    "r.txt": ("Acceleration Z (g)\n0\n1\n0\n", False),
    "s.txt": ("Acceleration X (g)\n0\n1\n0\n", True),
    # By their names
    "20090406_AQV_UD.acc": ("0\n1\n0\n", False),
    "20090406_AQV_WE.acc": ("0\n1\n0\n", True),
    "GMN_V.txt": ("0\n1\n0\n", False),
    "V_TOWN.txt": ("0\n1\n0\n", False),
    "Z_GMN_NS.txt": ("0\n1\n0\n", True),
    "GMN_Z_filtered.txt": ("0\n1\n0\n", False),
    "GMN_Z_0.2-30Hz.txt": ("0\n1\n0\n", False),
    "GMN_NS_0.2-30Hz.txt": ("0\n1\n0\n", True),
    "gmn_senkrecht.txt": ("0\n1\n0\n", False),
    "GMN_V_NS.txt": ("0\n1\n0\n", True),
    "UP_EW_corrected.txt": ("0\n1\n0\n", True),
    "IT.AQK..HNZ.D.ACC.asc": ("0\n1\n0\n", False),
    "IT.AQK..HGZ.D.ACC.asc": ("0\n1\n0\n", False),
    "IT.AQK..HGE.D.ACC.asc": ("0\n1\n0\n", True),
    "B-STUDWN.txt": ("0\n1\n0\n", False),
    "station.Z": ("0\n1\n0\n", False),
    "XX.TOWN.00.BHZ00.txt": ("0\n1\n0\n", False),
    "scossa_verticale.txt": ("0\n1\n0\n", False),
    "000317za.cor": ("0\n1\n0\n", False),
    "000317xa.cor": ("0\n1\n0\n", True),
    "GROUP.txt": ("0\n1\n0\n", True),
    # No accelerations
    "RSN5_A000.VT2": (peer("0", "VELOCITY", "CM/S"), None),
    "RSN5_A000.DT2": (peer("0", "DISPLACEMENT", "CM"), None),
    "RSN6_A000.VT2": ("0\n1\n0\n", None),
    "AQV_NS_vel.txt": ("0\n1\n0\n", None),
    "_SearchResults.csv": ("0,1\n0.01,2\n0.02,1\n", None),
}


@pytest.mark.slow
def test_vertical_components_and_velocities(tmp_path):
    for name, (content, _) in FILES.items():
        (tmp_path / name).write_text(content, encoding="utf-8")
    target = tmp_path / "all.csv"
    for option, kept in ([], (True,)), (["--vertical"], (True, False)):
        code, _, err = run("catalogue", tmp_path, "-o", target, "--dt", "0.01", "--units", "g", *option)
        assert code == 0
        files = {line.split(",")[0] for line in target.read_text().splitlines()[2:]}
        assert files == {name for name, (_, horizontal) in FILES.items() if horizontal in kept}
        left_out = {line.split(": ")[2] for line in err.splitlines() if ": left out: " in line}
        assert left_out == {str(tmp_path / name) for name in FILES} - {str(tmp_path / name) for name in files}
        assert ("a vertical component, by its component 'HNZ'" in err) is not bool(option)
        assert ("a vertical component, by its name 'GMN_V.txt'" in err) is not bool(option)
        assert "RSN6_A000.VT2: no acceleration, by 'vt2' in its name; it does not state its units" in err
        assert "_SearchResults.csv: a list of search results of PEER, not an accelerogram" in err


def test_what_a_file_states_otherwise_is_told(tmp_path):
    """By the rule of read_records; the file counts, as it would without what is given."""
    (tmp_path / "a.txt").write_text("# dt: 0.02\n# units: g\n0\n1\n0\n")
    (tmp_path / "b.txt").write_text("0\n1\n0\n")
    code, _, err = run("catalogue", tmp_path, "--dt", "0.02", "--units", "g")
    assert (code, err) == (0, "")
    target = tmp_path / "catalogue.csv"
    for dt, units, said in (("0.01", "g", "dt = 0.01: the file states 0.02"), ("0.02", "m/s2", "units = 'm/s2'")):
        code, _, err = run("catalogue", tmp_path, "-o", target, "--dt", dt, "--units", units)
        assert (code, len(err.splitlines())) == (0, 1)
        assert f"a.txt: {said}" in err
        assert "which counts, not what is given" in err
        assert dd.read_catalogue(target)[0].dt == 0.02


def test_times_with_few_decimals_need_the_step(tmp_path):
    """At 200 Hz, times of two decimals repeat: with the step they are read, and the catalogue has it."""
    rows = [f"{0.005 * i + 1e-9:.2f} {np.sin(0.3 * i):.4f}" for i in range(600)]
    (tmp_path / "motion.txt").write_text("\n".join(["time_s acc_g", *rows]) + "\n", encoding="utf-8")
    code, _, err = run("catalogue", tmp_path)
    assert code == 2
    assert "are read with a dt_s, or dt, that fits them (option --dt)" in err
    code, _, err = run("catalogue", tmp_path, "--dt", "0.005")
    assert code == 0
    assert "printed to 0.01 s, coarser than the step of 0.005 s, which fits all of them" in err
    (record,) = dd.read_catalogue(tmp_path / "catalogue.csv")
    assert record.dt == 0.005
    assert len(record) == 600


def test_vertical_channels(tmp_path):
    (tmp_path / "three.txt").write_text("t,N-S (g),E-W (g),V (g)\n0,1,2,3\n0.01,-1,3,4\n")
    code, out, err = run("catalogue", tmp_path)
    assert (code, "(2 records)" in out) == (0, True)
    assert err == f"dondolo: left out: {tmp_path / 'three.txt'}: a vertical component, by its channel 'V (g)'\n"


@pytest.mark.slow
@pytest.mark.parametrize("part", ["italy", "formats"])
def test_vertical_components_of_recordings(part, recordings, tmp_path):
    target = tmp_path / "all.csv"
    code, _, err = run("catalogue", recordings / part, "-o", target, "--dt", "0.005", "--units", "m/s2")
    vertical = [line for line in err.splitlines() if "a vertical component" in line]
    assert (code, len(vertical)) == (0, {"italy": 27, "formats": 6}[part])
    files = [line.split(",")[0] for line in target.read_text().splitlines()[2:]]
    assert not any("_UD" in name or "_UP" in name or "BNZ" in name for name in files)
    # Four columns without titles are read by a caller alone who says what they are.
    assert "multi_column" not in str(files)
    assert len(files) == {"italy": 54, "formats": 28}[part]


@pytest.mark.slow
def test_nothing_to_read(tmp_path):
    code, _, err = run("catalogue", tmp_path)
    assert code == 2
    assert "no accelerogram that can be read" in err
    assert not (tmp_path / "catalogue.csv").exists()
    code, _, err = run("catalogue", tmp_path / "none")
    assert code == 2
    assert "no such folder" in err
    file = tmp_path / "1.txt"
    file.write_text("0.0\n0.1\n-0.2\n0.1\n")
    code, _, err = run("catalogue", file)
    assert code == 2
    assert "1.txt: is a file: must be the folder of the accelerograms" in err
    code, _, err = run("catalogue", tmp_path)
    assert code == 2
    assert "does not state its time step and its units: dt and units" in err
    assert "(options --dt and --units)" in err
    # One taken for a catalogue
    code, _, err = run("records", file)
    assert code == 2
    assert "1.txt: no column 'file': it looks like an accelerogram, not a catalogue" in err
    (tmp_path / "one.csv").write_text("file;dt_s;units\n1.txt;0,01;g\n")
    code, _, err = run("records", tmp_path / "one.csv")
    assert code == 0
    assert "note: " in err
    assert "semicolons, decimal commas" in err
    assert "warning" not in err


@pytest.mark.slow
def test_table(folder, executable, tmp_path):
    run("catalogue", folder)
    code, out, err = run("records", folder / "catalogue.csv")
    assert code == 0
    assert "1990-01-02" not in out
    assert "Valley, Hall, North" in out
    assert "begins at 50 % of its PGA" in out
    (tmp_path / "case.nml").write_text(
        "&job task='stripes' output='x' /\n&wall name='w' mechanism='one_sided' height=1 thickness=0.2 /\n"
        "&records catalogue='files/catalogue.csv' /\n&stripes levels=0.1 /\n"
    )
    done = subprocess.run([executable, "--check", tmp_path / "case.nml"], capture_output=True, text=True)
    assert done.returncode == 0, done.stderr
    assert out in done.stdout
    code, out, err = run("records", folder / "none.csv")
    assert code == 2
    assert "none.csv: no such file" in err


@pytest.mark.slow
def test_only_a_catalogue_is_replaced(folder, tmp_path):
    target = tmp_path / "list.csv"
    for _ in range(2):
        assert run("catalogue", folder, "-o", target)[0] == 0
    survey = tmp_path / "walls.csv"
    survey.write_text("name,mechanism,height,thickness\n")
    code, _, err = run("catalogue", folder, "-o", survey)
    assert code == 2
    assert "walls.csv: exists, and is not a catalogue of files of dondolo" in err
    assert survey.read_text() == "name,mechanism,height,thickness\n"


@pytest.mark.skipif(not Path("/proc/self/fd").is_dir(), reason="no list of open files")
@pytest.mark.parametrize("vertical", ["none", "recorded"])
@pytest.mark.parametrize(
    "text",
    [
        "file,dt_s,units\na.txt,.01,g\n",
        "file,dt_s,units,vertical\na.txt,.01,g,\n",
        "file,dt\na.txt,.01\n",
        "x\n1\n",
        "",
    ],
)
def test_refused_catalogues_are_closed(tmp_path, text, vertical):
    """Else a program that goes on would run out of files."""
    path = tmp_path / "bad.csv"
    path.write_text(text)
    before = len(os.listdir("/proc/self/fd"))
    for _ in range(3):
        with pytest.raises(dd.errors.InputError):
            dd.read_catalogue(path, vertical=vertical)
    assert len(os.listdir("/proc/self/fd")) == before
