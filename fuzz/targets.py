"""Targets: readers of files, each with a check that its result is valid."""

from __future__ import annotations

import warnings
from collections.abc import Callable
from dataclasses import dataclass
from pathlib import Path
from random import Random

import numpy as np

import snapspace as ss
from snapspace.snapshots.sample_file import read_samples

from . import corpus
from .containers import changed_container
from .mutate import mutated
from .page_reader import PageReader

#: The longest message that counts as one line.
LONGEST_MESSAGE = 1000


class FaultError(Exception):
    """A reader neither returned a valid object nor refused the file in one line."""


@dataclass(frozen=True)
class Target:
    """A reader, and the kind of files that it reads.

    corpus : folder of its files in the corpus
    read : reads a file and checks the result; ValueError if the file is refused
    container : whether mutations may also change entries and arrays, with a matching checksum
    """

    corpus: str
    read: Callable[[Path], None]
    container: bool = False

    def mutated(self, data: bytes, random: Random, others: list[bytes]) -> bytes:
        """A mutation of a file's content."""
        if self.container and random.random() < 0.8:
            return changed_container(data, random)
        return mutated(data, random, others)


def run(target: Target, path: Path) -> bool:
    """Whether the reader accepted the file; FaultError if it has a fault."""
    try:
        with warnings.catch_warnings():
            warnings.simplefilter("ignore")  # overflow, and notices about meshes
            target.read(path)
    except ValueError as error:
        text = str(error)
        if isinstance(error, UnicodeError):
            raise FaultError(f"{type(error).__name__}: {error}") from error
        if not text or len(text.splitlines()) > 1 or len(text) > LONGEST_MESSAGE:
            raise FaultError(f"not one line: {text[:2000]!r}") from error
        return False
    except FaultError:
        raise
    except BaseException as error:
        raise FaultError(f"{type(error).__name__}: {error}") from error
    return True


def _load(path: Path) -> None:
    """Loads a model and solves in it: an accepted model must not harm the solver."""
    model = ss.load(path)
    session = model.session()
    if isinstance(session, ss.PosingSession):
        session.move(model.problem.handles.names[-1], translation=(0.01, 0, 0))
    else:
        session.blend(np.full(len(model.problem.poses), 1 / len(model.problem.poses)))
    _need(session.vertices.shape == model.problem.mesh.vertices.shape, "the shape of a frame")


def _read_tets(path: Path) -> None:
    mesh = ss.read_tets(path)
    _need(bool(np.isfinite(mesh.vertices).all()), "finite vertices")
    _need(0 <= mesh.tets.min() and mesh.tets.max() < len(mesh.vertices), "indices in range")


def _read_surface(path: Path) -> None:
    vertices, faces = ss.read_surface(path)
    _need(bool(np.isfinite(vertices).all()), "finite vertices")
    _need(0 <= faces.min() and faces.max() < len(vertices), "indices in range")
    file = ss.open_surface(path)
    look = file.appearance
    if look is not None:
        polygons = look.material_of_polygon
        _need(len(polygons) == len(file.starts) - 1, "a material for each polygon")
        _need(0 <= polygons.min() and polygons.max() < len(look.materials), "materials in range")


def _read_problem(path: Path) -> None:
    ss.read_problem(path, mesh=corpus.mesh())


def _load_snapshots(path: Path) -> None:
    loaded = ss.load_snapshots(path, corpus.posing_problem())
    _need(bool(np.isfinite(loaded.parameters).all()), "finite parameters")


def _read_timeline(path: Path) -> None:
    timeline = ss.read_timeline(path)
    shares = [share for _, share in timeline.shares(9)]
    _need(all(0.0 <= share <= 1.0 for share in shares), "shares of the way")


def _need(holds: bool, what: str) -> None:
    if not holds:
        raise FaultError(f"an object without {what}")


def _read_page(path: Path) -> None:
    answer = PageReader.running().read(path)
    if answer.startswith("refused: "):
        raise ValueError(answer)
    if answer != "read":
        raise FaultError(answer)


def _read_samples(path: Path) -> None:
    read_samples(path)


TARGETS = {
    "load": Target("model", _load, container=True),
    "load_snapshots": Target("samples", _load_snapshots, container=True),
    "checkpoint": Target("checkpoint", _read_samples, container=True),
    "read_problem": Target("problem", _read_problem),
    "read_surface": Target("surface", _read_surface),
    "read_tets": Target("tets", _read_tets),
    "read_timeline": Target("timeline", _read_timeline),
    "page_model": Target("model", _read_page, container=True),
    "page_export": Target("page", _read_page, container=True),
}
