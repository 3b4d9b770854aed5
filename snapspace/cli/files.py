"""File extensions by content; a test keeps them equal to those of the packages."""

from __future__ import annotations

from pathlib import Path

TET_INPUTS = (".mesh", ".meshb", ".msh", ".vtk", ".vtu", ".node", ".ele", ".veg")
SURFACE_INPUTS = (".obj", ".off", ".ply", ".stl", ".glb", ".gltf")
TET_OUTPUTS = (".msh", ".vtu", ".vtk", ".mesh")
SURFACE_OUTPUTS = (".obj", ".ply", ".off", ".stl")
FILMS = (".gif", ".mp4")
#: One file for all frames of a path.
ANIMATIONS = (*FILMS, ".glb")


def make_folder(folder: Path, *, option: str) -> None:
    """Creates a folder for output files; ValueError names the option if that fails."""
    try:
        folder.mkdir(parents=True, exist_ok=True)
    except OSError as error:
        raise ValueError(
            f"{folder}: cannot create the folder ({error.strerror}); give another {option}"
        ) from None
