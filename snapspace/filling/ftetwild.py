"""fTetWild in its own process."""

from __future__ import annotations

import contextlib
import os
import re
import subprocess
import sys
import tempfile
import threading
from collections.abc import Callable
from pathlib import Path
from typing import IO

import numpy as np
from numpy.typing import NDArray

from ..extras import need_extra
from ..interruptible import POLL_SECONDS
from ..mesh.morton_order import morton_order
from ..stopping import check_stop

_PROGRAM = Path(__file__).with_name("ftetwild_process.py")
_WATCH = Path(__file__).with_name("ftetwild_watch.py")
_PASS = re.compile(r"/+ pass (\d+) /+")  # as it begins to improve all tets once more
# Seconds to wait for the watch process to end before it is killed.
_PATIENCE = 10.0


def ftetwild(
    vertices: NDArray[np.float64],
    faces: NDArray[np.int32],
    *,
    edge_length: float,
    tolerance: float,
    progress: Callable[[int], None] | None = None,
) -> tuple[NDArray[np.float64], NDArray[np.int32]]:
    """Tetrahedralises a surface with fTetWild on all threads.

    Parameters
    ----------
    vertices : ndarray, (s, 3)
        Points of the surface.
    faces : ndarray of int32, (f, 3)
        Its triangles.
    edge_length, tolerance : float
        As shares of the diagonal of the bounding box.
    progress : callable, optional
        Called with the number of passes over all tets so far. How many it will need is not known.

    Returns
    -------
    vertices : ndarray, (n, 3)
        Vertices of the tets.
    tets : ndarray of int32, (m, 4)
        The tets, unchecked; m may be 0.

    Raises
    ------
    MissingExtraError
        If the extra `snapspace[fill]` is not installed; a ValueError.
    ValueError
        If the process fails; the message ends with the last line that it wrote.

    Notes
    -----
    The C++ code prints, writes a file into the current folder, ends the process on input that it
    cannot handle, and ignores signals. In its own process and folder it leaves nothing behind, does
    not end this process, and can be stopped by Ctrl-C. It also ends when this process is killed,
    see `ftetwild_watch.py`.
    """
    need_extra("fill", who="fill_surface")
    # Its tree of bounding boxes halves the faces in the order of the input. If neighbours are far
    # apart in that order, every query visits most faces: 50,000 faces took over ten minutes.
    vertices, faces = morton_order(vertices, faces)
    with tempfile.TemporaryDirectory(prefix="snapspace-") as name:
        folder = Path(name)
        np.savez(
            folder / "surface.npz",
            vertices=vertices,
            faces=faces,
            edge_length=edge_length,
            tolerance=tolerance,
        )
        status, output = _run(folder, progress)
        result = folder / "tets.npz"
        if status or not result.is_file():
            lines = output.strip().splitlines() or ["it wrote nothing"]
            raise ValueError(
                f"fill_surface: fTetWild failed with exit status {status}: {lines[-1]}; "
                "check the surface in a mesh editor, or try another tolerance"
            )
        with np.load(result) as arrays:
            return arrays["vertices"], arrays["tets"]


class _Output:
    """What a process writes, read as it comes."""

    def __init__(self, stream: IO[str], progress: Callable[[int], None] | None) -> None:
        self._progress = progress
        self._lines: list[str] = []
        self._passes = self._reported = 0
        self._thread = threading.Thread(target=self._read, args=(stream,), daemon=True)
        self._thread.start()

    def text(self) -> str:
        """All of it, after the process has ended."""
        self._thread.join()
        return "".join(self._lines)

    def report(self) -> None:
        """Calls `progress` with the number of passes, if there are more than at the last call."""
        passes = self._passes
        if self._progress is not None and passes > self._reported:
            self._reported = passes
            self._progress(passes)

    def _read(self, stream: IO[str]) -> None:
        for line in stream:
            self._lines.append(line)
            found = _PASS.match(line)
            if found:
                self._passes = int(found[1]) + 1


def _waited(process: subprocess.Popen[str]) -> int | None:
    """Exit status of a process; None if it does not end within `POLL_SECONDS`."""
    try:
        return process.wait(POLL_SECONDS)
    except subprocess.TimeoutExpired:
        return None


def _run(folder: Path, progress: Callable[[int], None] | None = None) -> tuple[int, str]:
    """Exit status and output of the program; ends its process if this one must stop."""
    watched, alive = os.pipe()  # `alive` closes when this process ends in any way
    try:
        with subprocess.Popen(
            [sys.executable, str(_WATCH), str(folder), str(_PROGRAM)],
            stdin=watched,
            stdout=subprocess.PIPE,
            stderr=subprocess.STDOUT,
            text=True,
            errors="replace",
            # Ctrl-C in a terminal reaches all its processes, but only this one decides what ends
            start_new_session=True,
            # the process finds the same packages as this one
            env={**os.environ, "PYTHONPATH": os.pathsep.join(map(os.path.abspath, sys.path))},
        ) as process:
            os.close(watched)
            watched = -1
            try:
                assert process.stdout is not None
                output = _Output(process.stdout, progress)
                while (status := _waited(process)) is None:
                    check_stop()
                    output.report()
                text = output.text()
                output.report()  # passes that ended since the last look
                return status, text
            except BaseException:
                os.close(alive)
                alive = -1
                with contextlib.suppress(subprocess.TimeoutExpired):
                    process.wait(_PATIENCE)
                process.kill()
                raise
    finally:
        for handle in (watched, alive):
            if handle >= 0:
                os.close(handle)
