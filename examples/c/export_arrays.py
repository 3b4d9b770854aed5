"""Writes the arrays of a posing model for pose.c, as one file of plain numbers.

python examples/c/export_arrays.py creature.snapspace creature.arrays
"""

import sys

import numpy as np

import snapspace as ss


def export_arrays(model_path: str, path: str) -> None:
    model = ss.load(model_path)
    if not isinstance(model, ss.PosingModel) or not isinstance(model.elastic, ss.Quartic):
        raise SystemExit(
            f"{model_path}: a posing model with an exact energy is needed; build one of a problem "
            'with "material": {"model": "stvk"}'
        )
    sizes = [model.dimension, len(model.problem.handles), len(model.problem.mesh.vertices)]
    numbers = [
        [model.value_scale, model.coordinate_scale],  # units of the termination tests
        model.elastic.coefficients,
        model.handles.K,
        model.handles.L,
        model.handles.S,
        model.subspace.tau,
        model.subspace.basis.T,  # mode after mode
    ]
    with open(path, "wb") as file:
        file.write(np.array(sizes, np.int32).tobytes())
        for array in numbers:
            file.write(np.ascontiguousarray(array, np.float64).tobytes())


if __name__ == "__main__":
    export_arrays(*sys.argv[1:])
