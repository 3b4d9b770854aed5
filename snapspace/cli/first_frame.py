"""A model is called built once a frame of it was solved."""

from __future__ import annotations

import numpy as np

from ..reduction import InterpolationModel, PosingModel


def check_first_frame(model: PosingModel | InterpolationModel) -> None:
    """Solves one frame, away from rest, as whoever opens the model will.

    Of posing that is half of every bound, of blending the middle of the first two poses.

    Raises
    ------
    ValueError
        If the frame cannot be solved, or a number of it is not finite.
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
            f"finite (status {report.status}, energy {report.value:g}); its samples are kept, take "
            "a lower --dimension or another --material"
        )
