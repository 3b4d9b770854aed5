"""The cure of inverted tets: a better mesh where they are slivers, else smaller motions."""

from __future__ import annotations

from types import SimpleNamespace

import numpy as np
import pytest

import snapspace as ss
from snapspace.cli.build_advice import _notice_inverted_frames, _notice_inverted_samples
from snapspace.generators import bar


def notice_of(capsys: pytest.CaptureFixture[str], *, height: float) -> str:
    """The notice of a build whose only sample has one inverted tet, of this height at rest."""
    mesh = bar(4, 2, 2)
    vertices = mesh.vertices.copy()
    tet = next(t for t in mesh.tets if not set(t) <= set(mesh.surface_vertices))
    top = next(v for v in tet if v not in mesh.surface_vertices)
    base = vertices[[v for v in tet if v != top]]
    normal = np.cross(base[1] - base[0], base[2] - base[0])
    normal *= np.sign((vertices[top] - base[0]) @ normal) / np.linalg.norm(normal)
    above = (vertices[top] - base[0]) @ normal
    vertices[top] -= (1.0 - height) * above * normal
    body = ss.TetMesh(vertices, mesh.tets)
    along = vertices[:, 0]
    handles = ss.Handles([along == along.min(), along == along.max()])
    problem = ss.PosingProblem(body, handles, domain=ss.HandleBox(translation=0.1, angle=0.1))
    shape = vertices.copy()
    shape[top] -= 1.1 * height * above * normal
    solved = ss.solve_snapshots(problem, ss.sample(problem.domain, 1), threads=1)
    report = ss.SampleReport("converged", 1, 1, 0.0, 0.0, 0.0, 0.0, 1)
    snapshots = ss.Snapshots.from_shapes(problem, solved.parameters, shape.reshape(1, -1), [report])
    model = SimpleNamespace(problem=problem)
    _notice_inverted_samples(SimpleNamespace(model=model, snapshots=snapshots))  # type: ignore[arg-type]
    return " ".join(capsys.readouterr().err.split())


def test_the_cure_of_inverted_slivers_is_a_better_mesh(capsys: pytest.CaptureFixture[str]) -> None:
    told = notice_of(capsys, height=0.01)
    assert "most of these are among those with a dihedral angle below 5 degrees" in told
    assert "`snapspace check` counts: make a mesh without them" in told
    assert "box of motions" not in told


def test_the_cure_of_other_inverted_tets_is_a_smaller_motion(
    capsys: pytest.CaptureFixture[str],
) -> None:
    told = notice_of(capsys, height=1.0)
    assert told.endswith("make the box of motions smaller")


@pytest.mark.parametrize(
    ("added", "full", "named"),
    [([0, 0, 1, 20], 5, False), ([0, 2, 4, 20], 5, True), ([0, 2, 4, 20], 170, False)],
)
def test_notably_more_inverted_tets_than_in_full_solutions_are_reported(
    capsys: pytest.CaptureFixture[str], added: list[int], full: int, named: bool
) -> None:
    """A median of half a tet was printed as 0."""
    reports = [ss.SampleReport("converged", 1, 1, 0.0, 0.0, 0.0, 0.0, full)] * len(added)
    reference = SimpleNamespace(reports=reports)
    validation = SimpleNamespace(inverted_tets=full + np.array(added), reference=reference)
    _notice_inverted_frames(validation)  # type: ignore[arg-type]
    told = capsys.readouterr().err
    assert ("have 3 more inverted tets" in told) == named and bool(told) == named
