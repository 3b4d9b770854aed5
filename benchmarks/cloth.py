"""Cloth: a hanging shell of about 10,000 triangles whose two upper corners are dragged at random.

    python benchmarks/cloth.py
    python benchmarks/cloth.py --triangles 10000 --drags 10000 --json
    python benchmarks/cloth.py --hinges --thickness 0.02   # neo-Hookean, with hinges

The model is that of a default build. A drag moves one corner, relative to the other one, to a
random point of the sampled box that is at most `--reach` half widths away. It is one frame of the
reduced session; with `--reach 2` it jumps through the whole box, often to its walls. Nothing may be
lost, turned over or thrown away:

- *not finite*, *not converged*: frames;
- *size*: distance of the farthest vertex from the midpoint of the held corners, in diagonals;
- *speed*: largest motion of a vertex between two frames, over that of a vertex of a handle;
- *bend*: largest angle between two neighbouring triangles in any frame, in degrees. Beyond 180 they
  would have turned over; an angle is followed from frame to frame by the signs of its sine;
- *area*: smallest and largest ratio of a triangle's area to that at rest.
"""

from __future__ import annotations

import argparse
import time
from typing import Any

import common
import numpy as np
from numpy.typing import NDArray

import snapspace as ss

FloatArray = NDArray[np.float64]
#: Width of a held corner, as a share of the cloth's side.
HELD = 0.08


def cloth(triangles: int, thickness: float) -> ss.ShellMesh:
    """A square of side one that hangs in folds, of right triangles whose diagonals alternate.

    triangles : about how many; thickness : as a share of the diagonal
    """
    count = round(np.sqrt(triangles / 2))
    x, y = np.meshgrid(np.linspace(0, 1, count + 1), np.linspace(0, 1, count + 1), indexing="ij")
    folds = 0.04 * (1.2 - y) * np.sin(3.0 * np.pi * x)
    vertices = np.stack([x, y, folds], axis=-1).reshape(-1, 3)
    corner = np.arange((count + 1) ** 2).reshape(count + 1, count + 1)
    a, b, c, d = corner[:-1, :-1], corner[1:, :-1], corner[1:, 1:], corner[:-1, 1:]
    turned = (np.add.outer(np.arange(count), np.arange(count)) % 2 == 1)[..., None]
    first = np.where(turned, np.stack([a, b, d], -1), np.stack([a, b, c], -1))
    second = np.where(turned, np.stack([b, c, d], -1), np.stack([a, c, d], -1))
    faces = np.concatenate([first.reshape(-1, 3), second.reshape(-1, 3)])
    diagonal = float(np.linalg.norm(np.ptp(vertices, axis=0)))
    return ss.ShellMesh(vertices, faces, thickness=thickness * diagonal)


def held_cloth(
    triangles: int, thickness: float, *, material: ss.Material | None
) -> ss.PosingProblem:
    """A cloth with both upper corners as handles."""
    mesh = cloth(triangles, thickness)
    x, y, _ = mesh.vertices.T
    corners = [(side < HELD) & (y > 1.0 - HELD) for side in (x, 1.0 - x)]
    domain = ss.HandleBox(translation=0.1 * mesh.diagonal, angle=np.pi / 4)
    handles = ss.Handles(corners, names=["left", "right"])
    return ss.PosingProblem(mesh, handles, domain=domain, material=material)


class Watch:
    """What happens to the triangles and hinges of a shell, frame by frame."""

    def __init__(self, mesh: ss.ShellMesh) -> None:
        self._mesh = mesh
        self._before = mesh.vertices
        self._angles = self._hinges(mesh.vertices)
        self._middle = mesh.vertices.mean(axis=0)
        self.not_finite, self.speed, self.size, self.turned = 0, 0.0, 0.0, 0
        self.bend = 0.0
        self.areas = [1.0, 1.0]

    def see(self, shape: FloatArray, held: NDArray[np.intp]) -> None:
        """Processes a frame; `held` are the vertices of handles."""
        if not np.isfinite(shape).all():
            self.not_finite += 1
            return
        way = np.linalg.norm(shape - self._before, axis=1)
        if way[held].max() > 0:
            self.speed = max(self.speed, float(way.max() / way[held].max()))
        self._before = shape
        away = np.linalg.norm(shape - shape[held].mean(axis=0), axis=1).max()
        self.size = max(self.size, float(away / self._mesh.diagonal))
        angles = self._hinges(shape)
        # the nearest of the angles that differ by whole turns
        angles += 2 * np.pi * np.round((self._angles - angles) / (2 * np.pi))
        self._angles = angles
        self.bend = max(self.bend, float(np.rad2deg(np.abs(angles).max())))
        self.turned += int((np.abs(angles) > np.pi).sum())
        ratio = np.linalg.norm(_normals(shape, self._mesh.triangles), axis=1) / (
            2.0 * self._mesh.areas
        )
        self.areas = [
            min(self.areas[0], float(ratio.min())),
            max(self.areas[1], float(ratio.max())),
        ]

    def _hinges(self, shape: FloatArray) -> FloatArray:
        """Angles of all hinges, in (-pi, pi]."""
        v0, v1, v2, v3 = (shape[self._mesh.hinges[:, k]] for k in range(4))
        edge = v1 - v0
        first, second = np.cross(edge, v2 - v0), np.cross(v3 - v0, edge)
        sine = np.linalg.norm(edge, axis=1) * np.einsum("hi,hi->h", first, v3 - v0)
        return np.asarray(np.arctan2(sine, np.einsum("hi,hi->h", first, second)))


def _normals(shape: FloatArray, triangles: NDArray[np.int32]) -> FloatArray:
    """Normals as long as twice the areas."""
    a, b, c = (shape[triangles[:, k]] for k in range(3))
    return np.asarray(np.cross(b - a, c - a))


def walk(box: ss.HandleBox, drags: int, reach: float, seed: int) -> FloatArray:
    """Random places of the box one after the other, (drags, 6)."""
    rng, half = np.random.default_rng(seed), box.half_widths
    places, place = np.empty((drags, len(half))), np.zeros(len(half))
    for row in places:
        place = np.clip(place + reach * half * rng.uniform(-1, 1, len(half)), -half, half)
        row[:] = place
    return places


def dragged(model: ss.PosingModel, *, drags: int, reach: float, seed: int) -> dict[str, Any]:
    """The figures of random drags of a model's handles, see `walk`."""
    problem = model.problem
    assert isinstance(problem.mesh, ss.ShellMesh)
    held = np.concatenate([handle.vertices for handle in problem.handles])
    session, watch = model.session(), Watch(problem.mesh)
    milliseconds, cpu, evaluations, statuses = [], [], [], []
    for w in walk(problem.domain, drags, reach, seed):
        begin = time.process_time()
        report = session.set_parameters(w)
        cpu.append(1e3 * (time.process_time() - begin))
        milliseconds.append(1e3 * report.seconds)
        evaluations.append(report.evaluations)
        statuses.append(report.status)
        watch.see(session.vertices, held)
    return {
        "drags": drags,
        "reach": reach,
        "not finite": watch.not_finite,
        "not converged": drags - statuses.count("converged"),
        "size": watch.size,
        "speed": watch.speed,
        "bend": watch.bend,
        "hinges turned over": watch.turned,
        "least area": watch.areas[0],
        "largest area": watch.areas[1],
        "ms median": float(np.median(milliseconds)),
        "ms 99 %": float(np.quantile(milliseconds, 0.99)),
        "ms largest": float(np.max(milliseconds)),
        "cpu ms median": float(np.median(cpu)),
        "cpu ms largest": float(np.max(cpu)),
        "evaluations median": float(np.median(evaluations)),
        "evaluations largest": int(np.max(evaluations)),
    }


def main() -> None:
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    parser.add_argument("--triangles", type=int, default=10_000)
    parser.add_argument("--thickness", type=float, default=0.02, help="share of the diagonal")
    parser.add_argument("--hinges", action="store_true", help="hinges instead of ARAP")
    parser.add_argument("--drags", type=int, default=10_000)
    parser.add_argument("--reach", type=float, default=0.2, help="longest drag, in half widths")
    parser.add_argument("--seed", type=int, default=0)
    parser.add_argument("--json", action="store_true", help="print one JSON object")
    args = parser.parse_args()
    material = ss.StableNeoHookean() if args.hinges else None
    problem = held_cloth(args.triangles, args.thickness, material=material)
    begin = time.perf_counter()
    built = ss.accurate_model(problem, seed=args.seed)
    seconds = time.perf_counter() - begin
    result = {
        "triangles": len(problem.mesh.cells),
        "thickness": args.thickness,
        "samples": len(built.model.training_parameters),
        "dimension": built.model.dimension,
        "elements": 0 if built.model.cubature is None else len(built.model.cubature.tets),
        "build s": seconds,
        **dragged(built.model, drags=args.drags, reach=args.reach, seed=args.seed + 1),
    }
    goals = {"not finite": "0", "hinges turned over": "0"}
    rows = [(name, value, goals.get(name, "")) for name, value in result.items()]
    common.show("cloth, two corners dragged", rows, result, args.json)


if __name__ == "__main__":
    main()
