"""Files of every version load, and give the same shapes as when they were written."""

from __future__ import annotations

import json
from pathlib import Path

import numpy as np
import pytest

from snapspace import PosingModel, load
from snapspace.model_file.container import read_container
from snapspace.model_file.model_file import READABLE

GOLDEN = Path(__file__).parent / "golden"
EXPECTED = {
    name: shape
    for version in READABLE
    for name, shape in json.loads((GOLDEN / f"v{version}.json").read_text("ascii")).items()
}


def test_there_is_a_file_of_every_kind_and_version() -> None:
    found: dict[int, set[str]] = {version: set() for version in READABLE}
    for name in EXPECTED:
        header = read_container(GOLDEN / name)[1]
        found[int(header["version"])].add(header.get("kind", "none"))
    exact, summed = {"posing", "interpolation"}, {"posing-cubature", "interpolation-cubature"}
    assert found[1] == exact | {"posing-cubature", "none"}
    assert all(kinds == exact | summed for version, kinds in found.items() if version > 1)
    assert {path.name for path in GOLDEN.glob("*.snapspace")} == set(EXPECTED)


@pytest.mark.parametrize("name", EXPECTED)
def test_it_gives_the_same_shape(name: str) -> None:
    model = load(GOLDEN / name)
    session = model.session()
    if isinstance(model, PosingModel):
        head = model.problem.handles.names[-1]
        session.move(head, euler=(0.1, -0.2, 0.15), translation=(0.1, 0.05, -0.1))
    else:
        session.blend([0.4, 0.6])
    expected = np.array(EXPECTED[name])
    assert np.abs(expected - model.problem.mesh.vertices).max() > 0.01
    np.testing.assert_allclose(session.vertices, expected, atol=1e-6 * model.problem.mesh.diagonal)
