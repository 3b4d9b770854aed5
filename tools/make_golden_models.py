"""Writes the model files of every released version that tests/model_file/test_golden.py loads.

    python tools/make_golden_models.py 3

Run it for a version once, when that version is new, and never again: the files stand for those that
users have. Versions 1 and 2 were written from the description of these formats, after version 3 had
replaced them: double precision for the basis; in version 1 only St.Venant-Kirchhoff, no energies
summed over few tets in blends, and at first no entry for the kind.
"""

from __future__ import annotations

import json
import sys
from pathlib import Path

import numpy as np

import snapspace as ss
from snapspace.model_file import container

ROOT = Path(__file__).parent.parent
sys.path.insert(0, str(ROOT))
from fuzz.corpus import models, posing_model  # noqa: E402

FOLDER = ROOT / "tests" / "model_file" / "golden"


def main(version: str) -> None:
    expected = {}
    for name, model in {**dict(models()), "stvk-cubature": posing_model(energy="cubature")}.items():
        stvk = model.problem.material.kind == "stvk"
        if version == "1" and not stvk:
            continue
        path = model.save(FOLDER / f"v{version}-{name}.snapspace")
        written = [path]
        if version in ("1", "2"):
            _as_of_then(path, version)
        if version == "1" and name == "posing":
            written.append(_first_of_all(path))
        expected |= {file.name: frame(ss.load(file)).tolist() for file in written}
    target = FOLDER / f"v{version}.json"
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


def _as_of_then(path: Path, version: str) -> None:
    """The file as that version wrote it; the basis gets digits that single precision lacks."""
    arrays, header = container.read_container(path)
    basis = arrays["basis"].astype(np.float64)
    arrays["basis"] = basis + 1e-9 * np.abs(basis).max() * np.sin(np.arange(basis.size)).reshape(
        basis.shape
    )
    container.write_container(path, arrays, {**header, "version": version})


def _first_of_all(path: Path) -> Path:
    """The file without its kind, as when there was only one."""
    arrays, header = container.read_container(path)
    del header["kind"]
    first = path.with_name("v1-first.snapspace")
    container.write_container(first, arrays, header)
    return first


if __name__ == "__main__":
    main(sys.argv[1])
