"""The page of ``dondolo serve``: signals at random moments, while it computes curves, motions and documents.

It must end within seconds, with the exit code of the signal, say nothing but that it was interrupted, and leave no
process and no temporary folder.
"""

from __future__ import annotations

import http.client
import json
import os
import random
import re
import signal
import subprocess
import threading
import time
from collections.abc import Callable
from pathlib import Path
from typing import Any

from readers import Tally
from samples import Programs, write_inputs

# What it may take to end, beside what the load of the machine asks for [s]
LONGEST = 2.0
CODES = {signal.SIGINT: 1, signal.SIGTERM: 143, signal.SIGHUP: 129}
_SETTINGS: dict[str, Any] = {
    "wall": {"mechanism": "one_sided", "height": 3.0, "thickness": 0.3},
    "records": {"polarity": "both"},
    "stripes": {"im": "pga", "levels": [0.01 * k for k in range(1, 400)]},
    "solver": {"engine": "rk45", "rtol": 1e-12, "atol": 1e-14},
    "check": {"ag": [0.2], "f0": [2.5], "tc_star": [0.35], "soil": "B"},
}
_ASKED = {
    "curve": {"settings": _SETTINGS},
    "motion": {"settings": _SETTINGS, "record": 1, "pga": 0.5},
    "document": {"settings": _SETTINGS, "kind": "report", "lang": "it"},
}


class Pages:
    """Servers that are ended.

    Parameters
    ----------
    programs : Programs
    folder : Path
        To work in.
    """

    def __init__(self, programs: Programs, folder: Path) -> None:
        self.programs, self.folder = programs, folder
        write_inputs(folder, samples=3000)
        (folder / "temporary").mkdir(exist_ok=True)

    def families(self, trials: int) -> dict[str, Callable[[], Tally]]:
        """Signals."""
        return {"signals of serve": lambda: self.run(trials)}

    def run(self, trials: int) -> Tally:
        """End servers at random moments."""
        tally, chance = Tally("signals of serve"), random.Random(0)
        for number in range(trials):
            what = [chance.choice((*_ASKED, "")) for _ in range(chance.choice((1, 3)))]
            sent, moment = chance.choice(list(CODES)), chance.choice((0.0, 0.3, 1.0, 2.5))
            said = self.end_one(list(filter(None, what)), sent, moment)
            tally.note(said, f"signals of serve:{number} ({sent.name} after {moment:g} s of {what})")
        return tally

    def end_one(self, what: list[str], sent: signal.Signals, moment: float) -> str:
        """What came of one server: as a reader's answer."""
        temporary = self.folder / "temporary"
        command = [self.programs.python, "-m", "dondolo", "serve", "--no-browser", "--records", "records.csv"]
        environment = os.environ | {"TMPDIR": str(temporary)}
        with subprocess.Popen(
            command, cwd=self.folder, stdout=subprocess.PIPE, stderr=subprocess.PIPE, text=True, env=environment
        ) as server:
            assert server.stdout is not None
            assert server.stderr is not None
            found = re.fullmatch(r"http://127\.0\.0\.1:(\d+)/\?token=(\S+)", server.stdout.readline().strip())
            if found is None:
                server.kill()
                return f"UNCLEAR: no address: {server.stderr.read()[-200:]}"
            for path in what:
                threading.Thread(target=_ask, args=(*found.groups(), path), daemon=True).start()
            time.sleep(moment)
            began = time.monotonic()
            server.send_signal(sent)
            try:
                server.wait(60.0)
            except subprocess.TimeoutExpired:
                server.kill()
                return "HANGS: more than 60 s"
            took, said = time.monotonic() - began, server.stderr.read()
        left = [one.name for one in temporary.iterdir()] + _processes(str(temporary))
        if left or server.returncode != CODES[sent] or said != "dondolo: interrupted\n" * (sent == signal.SIGINT):
            return f"UNSOUND: code {server.returncode}, leaves {left}, says {said[-200:]!r}"
        most = LONGEST * max(1.0, 2.0 * os.getloadavg()[0] / (os.cpu_count() or 1))
        return "refused it ended" if took < most else f"HANGS: {took:.1f} s"


def _ask(port: str, token: str, path: str) -> None:
    """Ask for something, and wait in vain."""
    for _ in range(100):
        try:
            here = http.client.HTTPConnection("127.0.0.1", int(port), timeout=120)
            head = {"content-type": "application/json", "cookie": f"dondolo-{port}={token}"}
            here.request("POST", f"/{path}", json.dumps(_ASKED[path]), head)
            here.getresponse().read()
        except ConnectionRefusedError:
            time.sleep(0.1)
        except (OSError, http.client.HTTPException):
            return
        else:
            return


def _processes(word: str) -> list[str]:
    """Processes that have a word among their arguments."""
    found = []
    for path in Path("/proc").glob("[0-9]*/cmdline"):
        try:
            if word.encode() in path.read_bytes():
                found.append(path.parent.name)
        except OSError:
            continue
    return found
