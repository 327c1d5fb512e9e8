"""Valid files to begin with: small records, cases of every task, tables, results, archives, checkpoints."""

from __future__ import annotations

import math
import os
import subprocess
import sys
from dataclasses import dataclass, field
from pathlib import Path

ROOT = Path(__file__).resolve().parents[2]
# Longest recorded accelerogram that is taken, as it would take all the time [bytes]
LONGEST = 100_000


@dataclass(frozen=True)
class Programs:
    """What is attacked.

    Attributes
    ----------
    executable, checked, readers : Path
        The executable as it is installed; the executable and test/test_readers.f90 built with sanitizers.
    python : Path
        Python with dondolo installed.
    """

    executable: Path
    checked: Path
    readers: Path
    python: Path = field(default_factory=lambda: Path(sys.executable))


def write_record(path: Path, strength: float, samples: int = 300) -> None:
    """A burst of a sine of growing and falling strength."""
    values = (
        strength * math.sin(0.09 * i) * math.exp(-(((i - samples / 2) / (samples / 5)) ** 2)) for i in range(samples)
    )
    path.write_text("".join(f"{value:.6f}\n" for value in values))


def write_inputs(folder: Path, walls: int = 12, samples: int = 300) -> None:
    """Records, a catalogue and a table of walls, for the cases of `case`."""
    folder.mkdir(parents=True, exist_ok=True)
    lines = ["file,dt_s,units,place"]
    for i in range(1, 4):
        write_record(folder / f"r{i}.txt", 1.5 + i, samples)
        lines.append(f'r{i}.txt,0.01,m/s2,"here, {i}"')
    (folder / "records.csv").write_text("\n".join(lines) + "\n")
    kinds = ("one_sided", "two_block", "free_standing")
    rows = [
        f'"wall {i:02}, {kinds[i % 3]}",{kinds[i % 3]},{1.2 + 0.13 * i:.2f},{0.2 + 0.02 * (i % 4):.2f},{1 + i % 5},'
        f"{'north' if i % 2 else 'south'}"
        for i in range(walls)
    ]
    (folder / "walls.csv").write_text("\n".join(["name,mechanism,height,thickness,weight,group", *rows]) + "\n")


def case(task: str, output: str = "out/study", more: str = "") -> str:
    """A case of a task on the inputs of `write_inputs`."""
    wall = "&wall\n   name = 'parapet'\n   mechanism = 'one_sided'\n   height = 1.5\n   thickness = 0.25\n/\n"
    people = "&population\n   file = 'walls.csv'\n/\n"
    history = "&history\n   record = 2\n   im_level = 0.4\n/\n" if task == "history" else ""
    levels = "" if task == "history" else "   levels = 0.1, 0.2, 0.3, 0.5, 0.8\n"
    states = "" if task == "history" else "   edp_thresholds = 0.1, 0.4\n"
    return (
        f"! a case\n&job\n   task = '{task}'\n   title = 'It''s a study'\n   output = '{output}'\n"
        f"   threads = 1\n{more}/\n"
        f"{people if task == 'typology' else wall}"
        f"&records\n   catalogue = 'records.csv'\n   polarity = '{'as_recorded' if task == 'history' else 'both'}'\n/\n"
        f"&stripes\n   im = 'pga'\n{levels}{states}/\n&solver\n   engine = 'auto'\n   rtol = 1e-6\n/\n{history}"
    )


TASKS = ("history", "stripes", "typology")

_CATALOGUES = [
    "file;dt_s;units\nr1.txt;0,01;m/s2\nr2.txt;0,02;g\n",
    "file,dt_s,units,channel,format\n# remark\nr1.txt,0.01,m/s2,1,columns\n\nr3.txt,0.005,cm/s2,,\n",
]
_WALLS = [
    "mechanism;height;thickness\none_sided;1,5;0,25\ntwo_block;3,0;0,4\n",
    "name,mechanism,height,thickness,density,hinge,restitution,restitution_value,overburden,overburden_inertia,bearing,"
    "bearing_distance,weight,group,p_occ\na,two_block,3,0.3,1800,0.6,constant,0.9,5000,0.5,inner,0.06,2,g,0.5\n"
    'a,one_sided,3,0.3,1800,,impulse,,,,,,2,g,1\n"b ""x"", y",free_standing,2,0.4,,,,,,,,,,,\n',
]
_NUMBERS = [
    "pga,annual_frequency\n0.05,0.02\n0.1,0.008\n0.2,0.002\n0.4,0.0004\n",
    "ag (g/10);Tr (years);F0;Tc* (s)\n0,5;30;2,4;0,3\n1,2;475;2,5;0,32\n2,0;2475;2,6;0,33\n",
    "# hazard\nsa(0.5),poe,investigation_time\n0.1,0.5,50\n0.3,0.1,50\n0.6,0.02,50\n",
]

# Hazard curves as the OpenQuake engine exports them, and fragility models for it
_OPENQUAKE = [
    "#,,,,\"generated_by='OpenQuake engine 3.20.0', kind='mean', investigation_time=50.0, imt='PGA'\"\n"
    "lon,lat,depth,poe-0.0500000,poe-0.1000000,poe-0.2000000\n13.4,42.35,0.0,9.0E-01,4.0E-01,5.0E-02\n",
    '# mean, investigation_time=50.0, imt="PGV"\ncustom_site_id,lon,lat,depth,poe-5.0,poe-10.0,poe-20.0,poe-40.0\n'
    "a1,13.40000,42.35000,0.00000,1.0,3.1E-01,8.0E-02,0.0\n",
]
_NRML = [
    f"""<?xml version="1.0" encoding="utf-8"?>
<nrml xmlns="http://openquake.org/xmlns/nrml/0.5">
  <fragilityModel id="walls" assetCategory="buildings" lossCategory="structural">
    <description>rocking walls</description>
    <limitStates>damage collapse</limitStates>
    <fragilityFunction id="lognormal" format="continuous" shape="logncdf">
      <imls imt="{imt}" noDamageLimit="0.05" minIML="0.05" maxIML="3"/>
      <!-- theta = 0.3, beta = 0.4 -->
      <params ls="damage" mean="0.3249861" stddev="0.1354063"/>
      <params ls="collapse" mean="0.65" stddev="0.27"/>
    </fragilityFunction>
    <fragilityFunction id="levels" format="discrete">
      <imls imt="SA(0.5)" noDamageLimit="0.02">0.1 0.2 0.4 0.8</imls>
      <poes ls="damage">0.0 0.25 0.6 0.9</poes>
      <poes ls="collapse">0.0 0.0 0.3 0.75</poes>
    </fragilityFunction>
  </fragilityModel>
</nrml>
"""
    for imt in ("PGA", "PGV")
]


def readers_samples(programs: Programs, folder: Path) -> dict[str, list[bytes]]:
    """Valid files of each family of Fortran readers; the inputs of cases are written to `folder`."""
    write_inputs(folder)
    made: dict[str, list[bytes]] = {}
    made["case"] = [case(task).encode() for task in TASKS]
    for task in TASKS:
        template = subprocess.run(
            [programs.executable, "--template", task], capture_output=True, text=True, check=True
        ).stdout
        template = template.replace("data/records/synthetic44.csv", "records.csv").replace(
            "data/walls/population.csv", "walls.csv"
        )
        made["case"].append(template.encode())
    made["catalogue"] = [(folder / "records.csv").read_bytes(), *(text.encode() for text in _CATALOGUES)]
    made["walls"] = [(folder / "walls.csv").read_bytes(), *(text.encode() for text in _WALLS)]
    made["walls"].append((ROOT / "data/walls/population.csv").read_bytes())
    made["numbers"] = [text.encode() for text in _NUMBERS]
    made["openquake"] = [text.encode() for text in _OPENQUAKE]
    made["nrml"] = [text.encode() for text in _NRML]
    made["store"] = [checkpoint(programs, folder, more) for more in ("", "   histories = .true.\n")]
    (folder / "samples").mkdir(exist_ok=True)
    subprocess.run([programs.readers, "samples", folder / "samples"], check=True)
    # Recorded accelerograms too, where there are any
    recorded = Path(os.environ.get("DONDOLO_RECORDS", "none")) / "formats"
    paths = [
        path for path in (*(folder / "samples").iterdir(), *recorded.glob("*/*")) if path.stat().st_size <= LONGEST
    ]
    made["records"] = [path.read_bytes() for path in sorted(paths)]
    return made


def checkpoint(programs: Programs, folder: Path, more: str) -> bytes:
    """A complete checkpoint: the counts of all rows."""
    path = folder / "whole.nml"
    path.write_text(case("typology", str(folder / "whole"), more))
    subprocess.run([programs.executable, "--quiet", "--walls", "1:12", path], check=True, capture_output=True)
    (counts,) = folder.glob("whole_walls_*.counts")
    content = counts.read_bytes()
    counts.unlink()
    return content


def result_sets(programs: Programs, folder: Path) -> dict[str, dict[str, bytes]]:
    """Result files of each task by the end of their names."""
    made = {}
    write_inputs(folder)
    for task in TASKS:
        path = folder / f"{task}.nml"
        path.write_text(case(task, str(folder / task / "study")))
        subprocess.run([programs.executable, "--quiet", path], check=True, capture_output=True)
        made[task] = {file.name.removeprefix("study"): file.read_bytes() for file in (folder / task).iterdir()}
    return made
