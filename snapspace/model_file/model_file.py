"""Model files: one .snapspace file, a JSON header and raw arrays in safetensors layout."""

from __future__ import annotations

import json
from dataclasses import replace
from pathlib import Path

from ..arguments import as_path
from ..input_error import one_line
from ..mesh import ShellMesh, file_kind
from ..reduction import InterpolationModel, PosingModel, ReducedModel, check_model
from . import (
    error_estimator,
    interpolation,
    local_rows,
    material,
    posing,
    shown_surface,
    snapshot_energies,
    star_forms,
    timings,
)
from .container import (
    check_dtypes,
    check_finite,
    checksum,
    parsed,
    read_container,
    write_container,
)

FORMAT = "snapspace-model"
#: Format of packed models, for pages and <snapspace-viewer>, in the same container.
PACKED_FORMAT = "snapspace-page"
VERSION = 4
#: Versions that `load` reads. In version 1 the material was always St.Venant-Kirchhoff. Up to
#: version 2 bases were in double precision, and up to version 3 the checksum included the timings.
READABLE = (1, 2, 3, 4)
SUFFIX = ".snapspace"
POSING, CUBATURE, SHELL = "posing", "posing-cubature", "posing-shell"
INTERPOLATION, BLENDED_CUBATURE = "interpolation", "interpolation-cubature"
BLENDED_SHELL = "interpolation-shell"
_DTYPES = {
    POSING: posing.DTYPES,
    CUBATURE: posing.CUBATURE_DTYPES,
    SHELL: posing.SHELL_DTYPES,
    INTERPOLATION: interpolation.DTYPES,
    BLENDED_CUBATURE: interpolation.CUBATURE_DTYPES,
    BLENDED_SHELL: interpolation.SHELL_DTYPES,
}


def save_model(model: ReducedModel, path: str | Path) -> Path:
    """Writes a model; an existing file is replaced only when the new one is complete.

    Identical runs write identical files, except for timings and the checksum of timings. The
    checksum of everything else, the header's entry `checksum`, is the same.

    Raises
    ------
    ValueError
        If the name does not end in .snapspace or the file cannot be written.
    TypeError
        For a model that is neither a PosingModel nor an InterpolationModel.
    """
    check_model(model, "save_model", "give model, path")
    path = as_path("save_model", path)
    check_model_path(path)
    if isinstance(model, PosingModel):
        kind = POSING if model.cubature is None else CUBATURE
        if isinstance(model.problem.mesh, ShellMesh):
            kind = SHELL
        arrays, content = posing.posing_arrays(model), posing.posing_content(model)
    elif isinstance(model, InterpolationModel):
        kind = INTERPOLATION if model.cubature is None else BLENDED_CUBATURE
        if isinstance(model.problem.mesh, ShellMesh):
            kind = BLENDED_SHELL
        arrays = interpolation.interpolation_arrays(model)
        content = interpolation.interpolation_content(model)
    else:
        raise TypeError(f"save_model: {type(model).__name__} has no file format")
    record, seconds = timings.split(model.provenance)
    header = {
        "format": FORMAT,
        "version": str(VERSION),
        "kind": kind,
        "problem": json.dumps(content, sort_keys=True),
        "provenance": json.dumps(record, sort_keys=True),
        **timings.timing_header(seconds),
    }
    arrays |= error_estimator.estimator_arrays(model.error_estimator)
    arrays |= star_forms.sampled_arrays(model.problem, model.error_estimator)
    write_container(path, arrays, header)
    return path


def load(path: str | Path) -> PosingModel | InterpolationModel:
    """Reads a model file. Nothing in it is executed.

    Raises
    ------
    ValueError
        For something other than a path; if the file is missing, truncated, altered (checksum), of
        another kind, such as a mesh or a packed model, of a newer version, or of an unknown
        material; or if an array is missing, has the wrong type or size, or a number that is not
        finite. The message names the file and the cure.
    """
    path = as_path("load", path, what=f"{SUFFIX} file")
    if not path.is_file():
        raise ValueError(f"{path}: there is no such model file; `snapspace build` makes one")
    try:
        arrays, header = read_container(path)
    except ValueError:
        _check_kind(path)
        raise
    if header.get("format") == PACKED_FORMAT:
        raise ValueError(
            f"{path}: this is a packed model for <snapspace-viewer>, which holds the surface only; "
            "use the model that it was made from"
        )
    if header.get("format") != FORMAT:
        raise ValueError(f"{path}: not a snapspace model; `snapspace build` makes one")
    version = header.get("version", "none")
    if version not in {str(readable) for readable in READABLE}:
        raise ValueError(
            f"{path}: the version is {one_line(version[:40])}, but this snapspace reads versions "
            f"{', '.join(map(str, READABLE))}; install the snapspace that wrote it, or build "
            "the model again"
        )
    kind = header.get("kind", POSING)  # the first files had only this kind
    if kind not in _DTYPES:
        raise ValueError(
            f"{path}: the kind is {kind[:40]!r}, but this snapspace knows {', '.join(_DTYPES)}; "
            "install the snapspace that wrote it"
        )
    for part in (
        error_estimator,
        shown_surface,
        material,
        snapshot_energies,
        star_forms,
        local_rows,
    ):
        check_dtypes(path, arrays, part.dtypes(arrays))
    check_dtypes(path, arrays, _DTYPES[kind])
    if header.get("checksum") != checksum(arrays, header) or not timings.is_unaltered(header):
        raise ValueError(
            f"{path}: the checksum does not match: the file was altered; build it again"
        )
    check_finite(path, arrays)
    blends = kind in (INTERPOLATION, BLENDED_CUBATURE, BLENDED_SHELL)
    make = interpolation.interpolation_model if blends else posing.posing_model
    try:
        record = parsed(header, "provenance")
        if timings.TIMINGS in header:
            record = timings.merged(record, parsed(header, timings.TIMINGS)["entries"])
        model = make(arrays, parsed(header, "problem"), record)
        estimator = error_estimator.estimator(arrays)
        star_forms.check_sampled_stars(arrays, model.problem, estimator)
        return replace(model, error_estimator=estimator)
    except material.UnknownMaterialError as error:
        raise ValueError(
            f"{path}: {one_line(str(error))}; install the snapspace that wrote it"
        ) from None
    except (LookupError, TypeError, ValueError, ArithmeticError, AttributeError) as error:
        reason = f"no entry {error}" if isinstance(error, KeyError) else one_line(str(error))
        raise ValueError(f"{path}: the model is inconsistent ({reason}); build it again") from None


def _check_kind(path: Path) -> None:
    """ValueError, which says what the file is, unless its name ends in .snapspace."""
    if path.suffix.lower() != SUFFIX:
        raise ValueError(
            f"{path}: this is {file_kind(path)}, but a model ({SUFFIX}) is needed; `snapspace "
            "build` makes one of a problem, `snapspace interpolate` of poses"
        )


def check_model_path(path: Path) -> None:
    """ValueError for a name that does not end in .snapspace, or a folder that does not exist."""
    if path.suffix != SUFFIX:
        raise ValueError(f"{path}: a model file ends in {SUFFIX}")
    if not path.parent.is_dir():
        raise ValueError(f"{path}: the folder {path.parent} does not exist")
