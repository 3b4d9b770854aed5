"""What is wrong with a surface, as a page shows it."""

from __future__ import annotations

import numpy as np

from ..doctor import check_surface, mend_surface
from ..mesh import SurfaceFile
from ..mesh.arrays import FloatArray, IndexArray
from . import messages
from .body import Body

#: More faces than this are not drawn, since a page would wait for them.
MOST_INVENTED = 20_000


def surface_check(shown: Body | SurfaceFile, request: int) -> messages.Checked:
    """The findings of `check_surface`, and the changes of mending before the surface is filled.

    ValueError if a body came as tets.
    """
    vertices, faces = _surface_of(shown)
    report = check_surface(vertices, faces)
    mended = mend_surface(vertices, faces)
    first = len(mended.faces) - mended.invented
    invented = mended.faces[first:][:MOST_INVENTED]
    positions = np.asarray(mended.vertices[invented], np.float32).ravel()
    return messages.Checked(
        request=request,
        fine=report.fine,
        findings=tuple(
            messages.SurfaceFinding(
                name=finding.name,
                fault=finding.fault,
                text=finding.text,
                meaning=finding.meaning,
                cure=finding.cure.replace("--fix", "snapspace check --fix"),
            )
            for finding in report.findings
        ),
        mended=mended.notes,
        invented=tuple(positions.tolist()),
    )


def _surface_of(shown: Body | SurfaceFile) -> tuple[FloatArray, IndexArray]:
    if isinstance(shown, SurfaceFile):
        return shown.vertices, shown.faces
    surface = shown.surface
    if surface is None:
        raise ValueError("this mesh came as tets, not as a surface; `snapspace check` checks tets")
    # a source has the exact coordinates of the file; embedded ones differ in rounding at seams
    if surface.source is not None:
        return _surface_of(surface.source)
    return surface.vertices(shown.mesh.vertices), surface.faces
