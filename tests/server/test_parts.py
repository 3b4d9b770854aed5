"""Parts that a page paints become moduli of tets."""

from __future__ import annotations

import math
from collections.abc import Sequence
from dataclasses import replace
from pathlib import Path

import numpy as np
import pytest

from snapspace import PosingProblem, StableNeoHookean, read_problem
from snapspace.mesh import EmbeddedSurface
from snapspace.server.body import Body
from snapspace.server.body_session import BodySession
from snapspace.server.computation_queue import ComputationQueue
from snapspace.server.messages import Choose, Compute, HandleChoice, PartChoice, Save
from snapspace.server.models import Models
from snapspace.server.parts import part_factors, with_factors
from snapspace.server.reporter import Reporter
from snapspace.server.surface_regions import SurfaceRegions
from snapspace.server.wire import decoded

from ..shapes import bar_problem, surface_around

PROBLEM = bar_problem()
MESH = PROBLEM.mesh
X = MESH.vertices[:, 0]
MIDDLE = 0.5 * (X.min() + X.max())
FRONT = X < MIDDLE + 1e-9
SURFACE = surface_around(MESH)


def part(name: str, chosen: np.ndarray, factor: float = 10.0) -> PartChoice:
    return PartChoice(name=name, vertices=tuple(np.flatnonzero(chosen).tolist()), factor=factor)


def choose(*parts: PartChoice) -> Choose:
    handles = [
        HandleChoice(name=h.name, vertices=tuple(h.vertices.tolist()), moving=i > 0)
        for i, h in enumerate(PROBLEM.handles)
    ]
    bounds = (1.0, 1.0, 1.0)
    return Choose(request=1, handles=tuple(handles), translation=bounds, angle=bounds, parts=parts)


def compute(**options: object) -> Compute:
    order = Compute(request=1, target_error=0.5, most_samples=20, seed=0, stiffness=50.0)
    return replace(order, **options)  # type: ignore[arg-type]


def new_session(folder: Path, problem: PosingProblem | None = None) -> BodySession:
    body = Body(name="bar", mesh=MESH, file=None, folder=folder, problem=problem)
    return BodySession(body, Models())


def computed(session: BodySession, order: Compute) -> PosingProblem:
    """The problem for which a session would compute a model."""
    session.computation(
        order, queue=ComputationQueue(), report=Reporter(lambda _: None, 1), publish=lambda *_: None
    )
    assert session._problem is not None
    return session._problem


def test_tets_with_three_corners_in_a_part_are_multiplied() -> None:
    factors = part_factors([part("front", FRONT)], MESH, None)
    assert factors is not None
    inside = FRONT[MESH.tets].sum(axis=1) >= 3
    assert 0 < inside.sum() < len(inside)
    assert np.array_equal(factors, np.where(inside, 10.0, 1.0))
    material = with_factors(StableNeoHookean(lam=2.0, mu=0.5), factors)
    assert np.array_equal(material.moduli, factors[:, None] * [2.0, 0.5])
    assert part_factors([], MESH, None) is None
    plain = StableNeoHookean()
    assert with_factors(plain, None) is plain


def test_the_later_of_overlapping_parts_wins() -> None:
    parts = [part("front", FRONT), part("all", X >= X.min(), 0.5)]
    assert np.unique(part_factors(parts, MESH, None)).tolist() == [0.5]
    assert set(np.unique(part_factors(parts[::-1], MESH, None))) == {0.5, 10.0}


def test_a_part_of_a_surface_reaches_through_the_body() -> None:
    regions = SurfaceRegions(MESH, SURFACE)
    points = SURFACE.vertices(MESH.vertices)[:, 0]
    factors = part_factors([part("front", points < MIDDLE)], MESH, regions)
    assert factors is not None
    centres = X[MESH.tets].mean(axis=1)
    share = (centres - X.min()) / np.ptp(X)
    assert (factors[share < 0.35] == 10.0).all() and (factors[share > 0.65] == 1.0).all()


def bad(name: str = "front", chosen: Sequence[int] | None = None, factor: float = 10.0) -> list:
    vertices = np.flatnonzero(FRONT).tolist() if chosen is None else chosen
    return [PartChoice(name=name, vertices=tuple(vertices), factor=factor)]


@pytest.mark.parametrize("surface", [None, SURFACE])
@pytest.mark.parametrize(
    ("parts", "message"),
    [
        (bad(factor=0.0), "part 'front' has the factor 0, but it must be from 0.0001 to 10000"),
        (bad(factor=-2.0), "part 'front' has the factor -2"),
        (bad(factor=math.nan), "part 'front' has the factor nan"),
        (bad(factor=math.inf), "part 'front' has the factor inf"),
        (bad(factor=1e9), "part 'front' has the factor 1e"),
        (bad(chosen=[]), "part 'front' has no tet: three of a tet's corners must be in it"),
        (bad(chosen=[10**8]), "part 'front' has vertex index 100000000, but there are"),
        (bad(chosen=[-1]), "part 'front' has vertex index -1"),
        (bad(name=" "), "a part has no name"),
        (bad() + bad(), "the name 'front' is used by two parts"),
    ],
)
def test_a_bad_part_is_refused_by_name(
    parts: list[PartChoice], message: str, surface: EmbeddedSurface | None
) -> None:
    regions = None if surface is None else SurfaceRegions(MESH, surface)
    with pytest.raises(ValueError, match=message):
        part_factors(parts, MESH, regions)


@pytest.mark.parametrize("factor", ["NaN", "Infinity", "1e999", '"10"', "null"])
def test_a_factor_that_is_not_a_number_is_refused_by_the_decoder(factor: str) -> None:
    head = '{"type": "choose", "request": 1, "handles": [], "translation": [1, 1, 1], '
    part = f'{{"name": "a", "vertices": [1], "factor": {factor}}}'
    text = f'{head}"angle": [1, 1, 1], "parts": [{part}]}}'
    with pytest.raises(ValueError, match=r"choose.parts\[0\].factor"):
        decoded(text)


def test_parts_change_the_problem_and_do_not_accumulate(tmp_path: Path) -> None:
    given = StableNeoHookean(lam=3.0, mu=2.0)
    file = PosingProblem(
        MESH, PROBLEM.handles, domain=PROBLEM.domain, material=given, stiffness=50.0
    )
    session = new_session(tmp_path, file)
    session.choose(choose(part("front", FRONT)))
    first = computed(session, compute())
    again = computed(session, compute())
    assert first is again, "the same problem shares its solved samples"
    assert sorted(np.unique(first.material.moduli[:, 1])) == [2.0, 20.0]
    session.choose(choose())
    assert computed(session, compute()).material == given
    assert computed(session, compute()).fingerprint != first.fingerprint


def test_a_refused_part_leaves_the_last_choice(tmp_path: Path) -> None:
    session = new_session(tmp_path)
    session.choose(choose(part("front", FRONT)))
    with pytest.raises(ValueError, match="'tiny' has no tet"):
        session.choose(choose(PartChoice(name="tiny", vertices=(0,), factor=2.0)))
    assert not computed(session, compute()).material.uniform


def test_a_saved_problem_has_the_parts(tmp_path: Path) -> None:
    session = new_session(tmp_path)
    session.choose(choose(part("front", FRONT), part("tip", X > X.max() - 1.1, 0.1)))
    wanted = computed(session, compute(material="corotational", poisson=0.4)).material
    saved = session.save(Save(request=2, name="soft"))
    assert saved.problem is not None
    read = read_problem(saved.problem)
    assert read.material.kind == "corotational"
    np.testing.assert_allclose(read.material.moduli, wanted.moduli, rtol=1e-12)
    assert {0.1, 1.0, 10.0} == set(np.round(np.unique(read.material.mu), 12))
