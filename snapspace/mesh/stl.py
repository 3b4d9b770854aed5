"""Writing binary STL surfaces.

We do not use meshio's writer: it does not notice a full disk, because NumPy's `tofile` drops the
error of its last bytes.
"""

from __future__ import annotations

from pathlib import Path

import numpy as np

from .arrays import FloatArray, IndexArray
from .stl_rows import TRIANGLE


def write_stl(path: Path, vertices: FloatArray, faces: IndexArray) -> None:
    """Write triangles with their corners and outward normals, in single precision."""
    corners = vertices[faces]
    normals = np.cross(corners[:, 1] - corners[:, 0], corners[:, 2] - corners[:, 0])
    lengths = np.linalg.norm(normals, axis=1, keepdims=True)
    rows = np.zeros(len(faces), TRIANGLE)
    rows["normal"] = np.divide(normals, lengths, out=np.zeros_like(normals), where=lengths > 0)
    rows["corners"] = corners
    header = b"binary STL of snapspace".ljust(80) + len(faces).to_bytes(4, "little")
    path.write_bytes(header + rows.tobytes())
