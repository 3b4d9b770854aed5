"""The program that runs fTetWild in its own process (started by `ftetwild.py`).

Its only argument is a folder. It reads surface.npz there and writes tets.npz.
"""

from __future__ import annotations

import sys
from pathlib import Path
from types import ModuleType

import numpy as np


def main(folder: Path) -> None:
    # pytetwild 0.4 imports pyvista to register itself there, but does not need it for arrays
    sys.modules.setdefault("pyvista", ModuleType("pyvista"))
    from pytetwild.pytetwild import tetrahedralize

    with np.load(folder / "surface.npz") as surface:
        vertices, tets = tetrahedralize(
            surface["vertices"],
            surface["faces"],
            edge_length_fac=float(surface["edge_length"]),
            epsilon=float(surface["tolerance"]),
            num_threads=1,
            quiet=False,  # the passes that it prints are its progress
            vtk_ordering=True,  # positive volumes
        )
    np.savez(folder / "tets.npz", vertices=vertices, tets=tets)


if __name__ == "__main__":
    main(Path(sys.argv[1]))
