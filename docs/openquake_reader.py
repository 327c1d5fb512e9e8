"""Probabilities of a fragility model by the OpenQuake engine's reader; run by the engine's Python, and never imported.

Usage: PYTHON docs/openquake_reader.py FRAGILITY.xml LEVELS.json; prints taxonomy -> state -> probabilities as JSON.
"""

import json
import sys

import numpy as np
from openquake.hazardlib import nrml
from openquake.risklib.read_nrml import update_validators

update_validators()
model = nrml.to_python(sys.argv[1])
with open(sys.argv[2], encoding="utf-8") as file:
    levels = json.load(file)
found = {}
for (_, taxonomy), functions in model.items():
    built = functions.build(model.limitStates)
    found[taxonomy] = {
        state: np.asarray(one(np.array(levels[taxonomy]))).tolist()
        for state, one in zip(model.limitStates, built, strict=True)
    }
json.dump(found, sys.stdout)
