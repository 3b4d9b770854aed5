"""Reading the user's poses: tet meshes, or surfaces that are filled and fitted."""

from __future__ import annotations

import time
from collections.abc import Sequence
from dataclasses import asdict, dataclass, field, replace
from pathlib import Path

import numpy as np
from numpy.typing import NDArray

from ..filling import SurfaceFilling
from ..fitting import DEVIATION, PoseFit, fit_poses
from ..mesh import (
    EmbeddedSurface,
    TetMesh,
    boundary_surface,
    embed_surface,
    open_surface,
    read_surface,
    read_tet_arrays,
    read_tets,
    tet_volumes,
)
from ..mesh.correspondence import check_same_faces, check_same_tets
from ..mesh.embed_surface import WHOLE_DIAGONAL
from ..mesh.input_path import existing_file
from ..mesh.inside_out import check_not_inside_out
from ..problem import Poses, ShellPoses
from ..registration import ScalePolicy
from .console import notice
from .files import SURFACE_INPUTS, TET_INPUTS
from .filling_options import filled
from .fit_cache import FitCache
from .pose_differences import check_surfaces_differ
from .pose_scales import notice_sizes, scaled_poses
from .progress import step_progress
from .shell_pose_files import read_shell_poses

FloatArray = NDArray[np.float64]


@dataclass(frozen=True, kw_only=True)
class PoseOptions:
    """How poses are read.

    tets : file with the tets of the first pose's surface; None fills the surface
    filling : how the surface is filled
    deviation : goal for the rms distance between fits and surfaces, relative to the diagonal; None
        for the default
    thickness : thickness of surfaces that are used as shells; None fills them
    scale : when to scale poses to the size of the first one
    accept_inverted : whether inverted tets in a pose are accepted
    repair : whether to repair faults of the mesh of --tets
    threads : number of threads, None for all
    """

    tets: Path | None
    filling: SurfaceFilling
    deviation: float | None
    thickness: float | None
    scale: ScalePolicy
    accept_inverted: bool
    repair: bool
    threads: int | None


@dataclass(frozen=True)
class PoseSet:
    """Poses with the user's surface, how they were fitted, and seconds by stage."""

    poses: Poses | ShellPoses
    surface: EmbeddedSurface
    fits: Sequence[PoseFit] = ()
    seconds: dict[str, float] = field(default_factory=dict)


def read_poses(files: Sequence[Path], options: PoseOptions, cache: FitCache) -> PoseSet:
    """Reads the poses of two or more files, all tet meshes or all surfaces.

    Raises
    ------
    ValueError
        For fewer than two files, a mixture of kinds, poses that do not correspond (the first
        difference is named), a surface that cannot be filled, or inverted tets unless accepted.
    """
    if len(files) < 2:
        raise ValueError(f"interpolate needs two poses or more, got {len(files)}")
    names = pose_names(files)
    for file in files:
        existing_file(file, known=SURFACE_INPUTS + TET_INPUTS)
    if options.thickness is not None:
        poses, surface = read_shell_poses(
            files, names, thickness=options.thickness, scale=options.scale
        )
        return PoseSet(poses, surface)
    kinds = {file.suffix.lower() in SURFACE_INPUTS for file in files}
    if len(kinds) == 2:
        raise ValueError(
            "some poses are tets and others surfaces; give all of one kind (with --tets the "
            "first surface's tets come from a file)"
        )
    if kinds == {True}:
        return _from_surfaces(files, names, options, cache)
    of_surfaces = {
        "--tets": options.tets,
        "--edge-length": options.filling.edge_length,
        "--exact": options.filling.exact or None,
        "--deviation": options.deviation,
    }
    for name, value in of_surfaces.items():
        if value is not None:
            raise ValueError(
                f"{name} is for poses that are surfaces, but these are tets; leave it out"
            )
    return _from_tets(files, names, options)


def pose_names(files: Sequence[Path]) -> list[str]:
    """The files' names without extension, with folder or number if names are equal."""
    for names in (
        [file.stem for file in files],
        [f"{file.parent.name}/{file.stem}" for file in files],
    ):
        if len(set(names)) == len(names):
            return names
    return [f"{number}: {file.stem}" for number, file in enumerate(files)]


def _from_tets(files: Sequence[Path], names: Sequence[str], options: PoseOptions) -> PoseSet:
    if options.repair:
        raise ValueError(
            "--repair would repair each pose differently, and they would no longer correspond; "
            "repair the first one, and make the others from it"
        )
    meshes = [read_tet_arrays(file) for file in files]
    check_same_tets(meshes, names)
    tets = meshes[0][1]
    if (tet_volumes(*meshes[0]) < 0).all():
        notice(f"notice: {names[0]}: all {len(tets)} tets were inverted and have been flipped")
        tets = np.ascontiguousarray(tets[:, [0, 2, 1, 3]])
    shapes = scaled_poses(
        np.stack([vertices for vertices, _ in meshes]), tets, names, policy=options.scale
    )
    poses = Poses(shapes, tets, names=names, accept_inverted=options.accept_inverted)
    notice_sizes(shapes, tets, names, policy=options.scale)
    return PoseSet(poses, boundary_surface(poses.reference))


def _from_surfaces(
    files: Sequence[Path], names: Sequence[str], options: PoseOptions, cache: FitCache
) -> PoseSet:
    if options.repair and options.tets is None:
        raise ValueError("--repair is for the mesh of --tets, and there is none; leave it out")
    surfaces = [read_surface(file) for file in files]
    check_same_faces(surfaces, names)
    faces = surfaces[0][1]
    targets = scaled_poses(
        np.stack([vertices for vertices, _ in surfaces]), faces, names, policy=options.scale
    )
    check_not_inside_out(targets, faces, names)
    check_surfaces_differ(targets, faces)
    seconds: dict[str, float] = {}
    begin = time.perf_counter()
    mesh = _tets_of(files[0].name, targets[0], faces, options, cache)
    # if the tets were made in the surface, all of it follows them, even small parts that filling
    # left out
    farthest = WHOLE_DIAGONAL if options.tets is None else 0.02
    embedded = embed_surface(targets[0], faces, mesh, farthest=farthest)
    surface = replace(embedded, source=open_surface(files[0]))
    seconds["tets"] = time.perf_counter() - begin

    begin = time.perf_counter()
    shapes, fits = _fitted(mesh, surface, targets[1:], names[1:], options, cache)
    seconds["fitting"] = time.perf_counter() - begin
    poses = Poses(
        np.concatenate([mesh.vertices[None], shapes]),
        mesh.tets,
        names=names,
        accept_inverted=options.accept_inverted,
    )
    notice_sizes(targets, faces, names, policy=options.scale)
    return PoseSet(poses, surface, fits, seconds)


def _tets_of(
    name: str,
    vertices: FloatArray,
    faces: NDArray[np.int32],
    options: PoseOptions,
    cache: FitCache,
) -> TetMesh:
    if options.tets is not None:
        mesh = read_tets(options.tets, repair=options.repair)
        _check_size(mesh, vertices, options.tets)
        return mesh
    settings = asdict(options.filling)
    known = cache.load_tets(vertices, faces, settings)
    if known is not None:
        notice("resuming: the first pose was filled before")
        return known
    mesh, _ = filled(name, vertices, faces, options.filling)
    cache.save_tets(vertices, faces, settings, mesh)
    return mesh


def _check_size(mesh: TetMesh, vertices: FloatArray, file: Path) -> None:
    """Raises ValueError for tets in another unit of length than the surface."""
    diagonal = float(np.linalg.norm(np.ptp(vertices, axis=0)))
    if not 0.8 * diagonal <= mesh.diagonal <= 20.0 * diagonal:
        raise ValueError(
            f"{file}: the tets have a diagonal of {mesh.diagonal:g}, but the first surface has one "
            f"of {diagonal:g}; give tets of that surface in its unit of length, or leave --tets out"
        )


def _fitted(
    mesh: TetMesh,
    surface: EmbeddedSurface,
    targets: FloatArray,
    names: Sequence[str],
    options: PoseOptions,
    cache: FitCache,
) -> tuple[FloatArray, list[PoseFit]]:
    """Shapes (k, n, 3) fitted to the targets, some perhaps from the cache."""
    deviation = DEVIATION if options.deviation is None else options.deviation
    settings = {"deviation": deviation}  # the cache depends on these
    found = {
        number: known
        for number, target in enumerate(targets)
        if (known := cache.load_fit(mesh, surface, target, settings)) is not None
    }
    if found:
        notice(f"resuming: {len(found)} of {len(targets)} poses were fitted before")
    missing = [number for number in range(len(targets)) if number not in found]

    def keep(index: int, shape: FloatArray, fit: PoseFit) -> None:
        number = missing[index]
        cache.save_fit(mesh, surface, targets[number], settings, shape, fit)
        found[number] = shape, fit

    if missing:
        done_before = len(found)
        try:
            with step_progress(
                "fitted", done=done_before, total=len(targets), unit="poses"
            ) as progress:
                fit_poses(
                    mesh,
                    surface,
                    targets[missing],
                    deviation=deviation,
                    threads=options.threads,
                    progress=lambda done, _: progress(done_before + done, len(targets)),
                    on_finished=keep,
                )
        except KeyboardInterrupt:
            raise KeyboardInterrupt(
                f"{len(found)} of {len(targets)} fitted poses are kept; the same command "
                "resumes from there"
            ) from None
    # names are those of this run, since the same target may have had another name
    fits = [replace(found[number][1], name=name) for number, name in enumerate(names)]
    return np.stack([found[number][0] for number in range(len(targets))]), fits
