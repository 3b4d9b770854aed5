"""Model files: one .snapspace file in safetensors layout, a JSON header and raw arrays."""

from __future__ import annotations

import hashlib
import json
from pathlib import Path
from typing import Any

import numpy as np
from numpy.typing import NDArray
from safetensors import SafetensorError, safe_open
from safetensors.numpy import save

from .energy import StVK
from .mesh import TetMesh, mass_matrix
from .mesh.atomic_file import atomic_file
from .problem import HandleBox, Handles, PosingProblem
from .reduction import HandleQuadric, Quartic, ReducedModel, coefficient_count
from .subspace import AffineSubspace

FORMAT = "snapspace-model"
VERSION = 1
SUFFIX = ".snapspace"
Arrays = dict[str, NDArray[Any]]

_DTYPES = {
    "vertices": np.float64,
    "tets": np.int32,
    "handle_vertices": np.int32,
    "handle_sizes": np.int32,
    "basis": np.float64,
    "eigenvalues": np.float64,
    "quartic": np.float64,
    "handle_K": np.float64,
    "handle_L": np.float64,
    "handle_S": np.float64,
    "training_parameters": np.float64,
    "training_coordinates": np.float64,
}


def save_model(model: ReducedModel, path: str | Path) -> Path:
    """Writes a model; a file that is there is replaced only when the new one is complete.

    Raises
    ------
    ValueError
        If the name does not end in .snapspace or the file cannot be written.
    """
    path = Path(path)
    check_model_path(path)
    arrays, header = _arrays(model), _header(model)
    header["checksum"] = _checksum(arrays, header)
    with atomic_file(path) as temporary:
        temporary.write_bytes(_sorted_header(save(arrays, header)))
    return path


def load(path: str | Path) -> ReducedModel:
    """Reads a model file. Nothing in it is executed.

    Raises
    ------
    ValueError
        If the file is missing, truncated, altered (checksum), of another kind or of a newer
        version, or if an array is missing or has the wrong type or size. The message names the
        file and the cure.
    """
    path = Path(path)
    if not path.is_file():
        raise ValueError(f"{path}: there is no such model file; `snapspace build` makes one")
    arrays, header = _read(path)
    if header.get("format") != FORMAT:
        raise ValueError(f"{path}: not a snapspace model; `snapspace build` makes one")
    if header.get("version") != str(VERSION):
        raise ValueError(
            f"{path}: model version {header.get('version')}, this snapspace reads version "
            f"{VERSION}; install the snapspace that wrote it, or build the model again"
        )
    _check_arrays(path, arrays)
    if header.get("checksum") != _checksum(arrays, header):
        raise ValueError(
            f"{path}: the checksum does not match, the file was altered; build it again"
        )
    try:
        return _model(arrays, header)
    except (KeyError, TypeError, ValueError) as error:
        raise ValueError(
            f"{path}: the model does not fit together ({error}); build it again"
        ) from None


def check_model_path(path: Path) -> None:
    """Refuses a name that does not end in .snapspace, or a folder that does not exist."""
    if path.suffix != SUFFIX:
        raise ValueError(f"{path}: a model file ends in {SUFFIX}")
    if not path.parent.is_dir():
        raise ValueError(f"{path}: the folder {path.parent} does not exist")


def _arrays(model: ReducedModel) -> Arrays:
    problem = model.problem
    sizes = [len(handle.vertices) for handle in problem.handles]
    arrays = {
        "vertices": problem.mesh.vertices,
        "tets": problem.mesh.tets,
        "handle_vertices": problem.pinned,
        "handle_sizes": np.array(sizes, np.int32),
        # (d, 3n): a mode is contiguous, and fewer modes are a prefix
        "basis": model.subspace.basis.T,
        "eigenvalues": model.subspace.eigenvalues,
        "quartic": model.elastic.coefficients,
        "handle_K": model.handles.K,
        "handle_L": model.handles.L,
        "handle_S": model.handles.S,
        "training_parameters": model.training_parameters,
        "training_coordinates": model.training_coordinates,
    }
    return {name: np.ascontiguousarray(array) for name, array in arrays.items()}


def _header(model: ReducedModel) -> dict[str, str]:
    problem = model.problem
    bounds = problem.domain.half_widths[:6].tolist()
    content = {
        "material": {"model": "stvk", "lam": problem.material.lam, "mu": problem.material.mu},
        "stiffness": problem.stiffness,
        "domain": {"translation": bounds[:3], "angle": bounds[3:]},
        "handles": list(problem.handles.names),
        "lumped_mass": bool(model.subspace.mass.nnz == len(problem.mesh.vertices)),
    }
    return {
        "format": FORMAT,
        "version": str(VERSION),
        "problem": json.dumps(content, sort_keys=True),
        "provenance": json.dumps(model.provenance, sort_keys=True),
    }


def _sorted_header(content: bytes) -> bytes:
    """The same safetensors file with its header in order: the library writes it in a random one."""
    size = int.from_bytes(content[:8], "little")
    header = json.dumps(json.loads(content[8 : 8 + size]), sort_keys=True).encode()
    header += b" " * (-len(header) % 8)  # the arrays stay aligned
    return len(header).to_bytes(8, "little") + header + content[8 + size :]


def _checksum(arrays: Arrays, header: dict[str, str]) -> str:
    digest = hashlib.sha256()
    for key in sorted(header):
        if key != "checksum":
            digest.update(f"{key}={header[key]}\n".encode())
    for name in sorted(arrays):
        array = arrays[name]
        digest.update(f"{name} {array.dtype.str} {array.shape}\n".encode())
        digest.update(array.tobytes())
    return digest.hexdigest()


def _read(path: Path) -> tuple[Arrays, dict[str, str]]:
    try:
        with safe_open(path, framework="np") as file:
            arrays = {name: file.get_tensor(name) for name in file.keys()}
            return arrays, dict(file.metadata() or {})
    except (SafetensorError, OSError, ValueError) as error:
        raise ValueError(
            f"{path}: not a complete snapspace model ({error}); copy or build it again"
        ) from None


def _check_arrays(path: Path, arrays: Arrays) -> None:
    for name, dtype in _DTYPES.items():
        if name not in arrays:
            raise ValueError(f"{path}: the array '{name}' is missing; build the model again")
        if arrays[name].dtype != dtype:
            raise ValueError(
                f"{path}: the array '{name}' is {arrays[name].dtype}, not {np.dtype(dtype)}; "
                "build the model again"
            )


def _model(arrays: Arrays, header: dict[str, str]) -> ReducedModel:
    content = json.loads(header["problem"])
    problem = _problem(arrays, content)
    n, h = len(problem.mesh.vertices), len(problem.handles)
    d = len(arrays["basis"])
    k = len(arrays["training_parameters"])
    shapes = {
        "basis": (d, 3 * n),
        "quartic": (coefficient_count(d),),
        "handle_K": (d, d),
        "handle_L": (h, d, 12),
        "handle_S": (h, 4, 4),
        "training_parameters": (k, problem.dimension),
        "training_coordinates": (k, d),
    }
    for name, shape in shapes.items():
        if arrays[name].shape != shape:
            raise ValueError(f"'{name}' has shape {arrays[name].shape} and not {shape}")
    mass = mass_matrix(problem.mesh, lumped=content["lumped_mass"])
    tau = problem.mesh.vertices.reshape(-1)
    return ReducedModel(
        problem,
        AffineSubspace(tau, arrays["basis"].T, mass, arrays["eigenvalues"]),
        Quartic(d, arrays["quartic"]),
        HandleQuadric(arrays["handle_K"], arrays["handle_L"], arrays["handle_S"]),
        arrays["training_parameters"],
        arrays["training_coordinates"],
        json.loads(header["provenance"]),
    )


def _problem(arrays: Arrays, content: dict[str, Any]) -> PosingProblem:
    ends = np.cumsum(arrays["handle_sizes"])[:-1]
    handles = Handles(np.split(arrays["handle_vertices"], ends), names=content["handles"])
    domain = content["domain"]
    return PosingProblem(
        TetMesh(arrays["vertices"], arrays["tets"]),
        handles,
        material=StVK(lam=content["material"]["lam"], mu=content["material"]["mu"]),
        stiffness=content["stiffness"],
        domain=HandleBox(translation=tuple(domain["translation"]), angle=tuple(domain["angle"])),
    )
