"""Writes the model files of this version that tests/model_file/test_golden.py loads.

Run it once for a new version, and never again: the files stand for those of users.
Versions 1 and 2 were written with the code of version 3, from the description of these formats:
double precision for the basis; in version 1 only St.Venant-Kirchhoff, no cubature in blends, and
at first no entry for the kind.
"""

from __future__ import annotations

import json
import sys
from pathlib import Path

import numpy as np

import snapspace as ss
from snapspace.model_file import VERSION

ROOT = Path(__file__).parent.parent
sys.path.insert(0, str(ROOT))
from fuzz.corpus import models, posing_model  # noqa: E402

FOLDER = ROOT / "tests" / "model_file" / "golden"


def main() -> None:
    expected = {}
    for name, model in {**dict(models()), "stvk-cubature": posing_model(energy="cubature")}.items():
        path = model.save(FOLDER / f"v{VERSION}-{name}.snapspace")
        expected[path.name] = frame(ss.load(path)).tolist()
    target = FOLDER / f"v{VERSION}.json"
    target.write_text(json.dumps(expected) + "\n", encoding="ascii", newline="\n")


def frame(model: ss.PosingModel | ss.InterpolationModel) -> np.ndarray:
    """A shape of the model, (n, 3)."""
    session = model.session()
    if isinstance(session, ss.PosingSession):
        head = model.problem.handles.names[-1]
        session.move(head, euler=(0.1, -0.2, 0.15), translation=(0.1, 0.05, -0.1))
    else:
        session.blend([0.4, 0.6])
    return session.vertices


if __name__ == "__main__":
    main()
