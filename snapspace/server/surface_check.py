"""What is wrong with the surface of a body, as a page shows it."""

from __future__ import annotations

import numpy as np

from ..doctor import check_surface, mend_surface
from . import messages
from .body import Body

#: More faces than this are not drawn: a page would wait for them.
MOST_INVENTED = 20_000


def surface_check(body: Body, request: int) -> messages.Checked:
    """The findings of `check_surface`, and what mending changed before the surface was filled.

    ValueError if the body came as tets.
    """
    surface = body.surface
    if surface is None:
        raise ValueError("this mesh came as tets, not as a surface; `snapspace check` checks tets")
    # a source has the very coordinates of the file: embedded ones differ in rounding at seams
    vertices = (
        surface.vertices(body.mesh.vertices) if surface.source is None else surface.source.vertices
    )
    report = check_surface(vertices, surface.faces)
    mended = mend_surface(vertices, surface.faces)
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
