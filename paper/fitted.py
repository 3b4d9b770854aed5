"""fitted_poses: tets in the poses of a set of surfaces, fitted once for all programs."""

from __future__ import annotations

import hashlib
import time
from dataclasses import dataclass
from pathlib import Path

import numpy as np

import snapspace as ss
from snapspace.disk import read_checked, write_checked
from snapspace.fitting import fit_poses


@dataclass(frozen=True)
class FittedPoses:
    """Poses, with the mesh itself first, and the wall time of their fits in seconds."""

    poses: ss.Poses
    seconds: float


def fitted_poses(
    tets: Path, reference: Path, names: tuple[str, ...], *, folder: Path
) -> FittedPoses:
    """Fits a tet mesh to surfaces that have the faces of a reference surface.

    Parameters
    ----------
    tets : file of the tet mesh, in the pose of the reference surface
    reference : file of the reference surface
    names : the other surfaces' files without suffix, beside the reference and with its suffix
    folder : folder where fits are kept

    Returns
    -------
    FittedPoses
        Fits that were kept have the seconds that they took when they were made.
    """
    mesh = ss.read_tets(tets)
    surface = ss.embed_surface(*ss.read_surface(reference), mesh)
    files = [reference.with_name(f"{name}{reference.suffix}") for name in names]
    targets = np.stack([ss.read_surface(file)[0] for file in files])
    key = hashlib.sha256(f"{mesh.fingerprint} {ss.__version__}".encode())
    key.update(targets.tobytes())
    path = folder / f"{key.hexdigest()[:24]}.fits"
    if path.is_file():
        arrays, header = read_checked(path)
        shapes, seconds = arrays["shapes"], float(header["seconds"])
    else:
        begin = time.perf_counter()
        shapes = fit_poses(mesh, surface, targets, names=names).shapes
        seconds = time.perf_counter() - begin
        folder.mkdir(parents=True, exist_ok=True)
        write_checked(path, {"shapes": shapes}, {"seconds": repr(seconds)})
    every = np.concatenate([mesh.vertices[None], shapes])
    return FittedPoses(ss.Poses(every, mesh.tets, names=[reference.stem, *names]), seconds)
