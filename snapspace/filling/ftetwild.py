"""fTetWild in a process of its own."""

from __future__ import annotations

import os
import subprocess
import sys
import tempfile
from pathlib import Path

import numpy as np
from numpy.typing import NDArray

from ..extras import need_extra
from ..interruptible import POLL_SECONDS
from ..stopping import check_stop

_PROGRAM = Path(__file__).with_name("ftetwild_process.py")


def ftetwild(
    vertices: NDArray[np.float64],
    faces: NDArray[np.int32],
    *,
    edge_length: float,
    tolerance: float,
) -> tuple[NDArray[np.float64], NDArray[np.int32]]:
    """Tetrahedralise a surface with fTetWild on one thread.

    Parameters
    ----------
    vertices : ndarray, (s, 3)
    faces : ndarray of int32, (f, 3)
    edge_length, tolerance : float
        As shares of the diagonal of the bounding box.

    Returns
    -------
    vertices : ndarray, (n, 3)
    tets : ndarray of int32, (m, 4)
        As they come, m = 0 included.

    Raises
    ------
    MissingExtraError
        A ValueError, without the extra `snapspace[fill]`.
    ValueError
        If the process fails; the message ends with the last line that it wrote.

    Notes
    -----
    The C++ code prints, writes a file into the current folder, ends the process when it meets what
    it cannot handle, and does not return for a signal. In a process and a folder of its own it
    leaves nothing behind, takes nothing with it, and Ctrl-C stops it.
    """
    need_extra("fill", who="fill_surface")
    with tempfile.TemporaryDirectory(prefix="snapspace-") as name:
        folder = Path(name)
        np.savez(
            folder / "surface.npz",
            vertices=vertices,
            faces=faces,
            edge_length=edge_length,
            tolerance=tolerance,
        )
        status, output = _run(folder)
        result = folder / "tets.npz"
        if status or not result.is_file():
            lines = output.strip().splitlines() or ["it wrote nothing"]
            raise ValueError(
                f"fill_surface: fTetWild failed with exit status {status}: {lines[-1]}; "
                "check the surface in a mesh editor, or try another tolerance"
            )
        with np.load(result) as arrays:
            return arrays["vertices"], arrays["tets"]


def _run(folder: Path) -> tuple[int, str]:
    """Exit status and output of the program; its process is ended if this one is told to stop."""
    with subprocess.Popen(
        [sys.executable, str(_PROGRAM), str(folder)],
        stdin=subprocess.DEVNULL,
        stdout=subprocess.PIPE,
        stderr=subprocess.STDOUT,
        text=True,
        errors="replace",
        cwd=folder,
        # packages are found there as they are here
        env={**os.environ, "PYTHONPATH": os.pathsep.join(map(os.path.abspath, sys.path))},
    ) as process:
        try:
            while True:
                try:
                    output, _ = process.communicate(timeout=POLL_SECONDS)
                    return process.returncode, output
                except subprocess.TimeoutExpired:
                    check_stop()
        except BaseException:
            process.kill()
            raise
