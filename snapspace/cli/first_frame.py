"""check_first_frame: a model counts as built only if a frame of it can be solved."""

from __future__ import annotations

import numpy as np

from ..reduction import InterpolationModel, PosingModel


def check_first_frame(model: PosingModel | InterpolationModel) -> None:
    """Solves one frame away from rest, as the model's users will.

    For posing the motion is half of every bound, for blending the middle of the first two poses.

    Raises
    ------
    ValueError
        If the frame cannot be solved, or has a number that is not finite.
    """
    if isinstance(model, PosingModel):
        session = model.session()
        report = session.pose(0.5 * model.problem.domain.half_widths)
        vertices = session.vertices
    else:
        blending = model.session()
        report = blending.blend(np.eye(len(model.problem.poses))[:2].mean(axis=0))
        vertices = blending.vertices
    finite = np.isfinite(report.value) and bool(np.isfinite(vertices).all())
    if not finite or report.status == "not_finite":
        raise ValueError(
            f"the model is not written: its first frame, in {model.dimension} dimensions, is not "
            f"finite (status {report.status}, energy {report.value:g}); its samples are kept; try "
            "a lower --dimension or another --material"
        )
