"""The program that runs fTetWild in its own process (started by `ftetwild.py`).

Its only argument is a folder. It reads surface.npz there and writes tets.npz.
"""

from __future__ import annotations

import sys
from pathlib import Path
from types import ModuleType

import numpy as np

#: The tets are improved until the worst has this conformal AMIPS energy; a regular tet has three.
#: fTetWild's default of 10 takes more than twice as long (docs/notes/filling.md), but solvers need
#: as many evaluations, and models have the same errors. With 100, dihedral angles fall to half a
#: degree.
STOP_ENERGY = 30.0


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
            num_threads=0,  # all: two threads take 0.5 to 0.8 of the time of one
            stop_energy=STOP_ENERGY,
            quiet=False,  # the passes that it prints are its progress
            vtk_ordering=True,  # positive volumes
        )
    np.savez(folder / "tets.npz", vertices=vertices, tets=tets)


if __name__ == "__main__":
    main(Path(sys.argv[1]))
