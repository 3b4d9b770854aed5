"""Captions in dark grey under the shapes of a contact sheet."""

from __future__ import annotations

from collections.abc import Sequence

import numpy as np
from numpy.typing import NDArray

from ..extras import need_extra

_DARK = (58, 56, 54)
_LIGHT = (235, 233, 230)


def write_captions(
    image: NDArray[np.uint8],
    labels: Sequence[str],
    places: Sequence[tuple[int, int]],
    *,
    size: int,
) -> None:
    """Write labels into an image (h, w, 3), centred below the places (x, y), `size` pixels high.

    The text is dark on a light image and light on a dark one.
    """
    need_extra("pictures", who="render_row")
    from PIL import Image, ImageDraw, ImageFont

    paper = Image.fromarray(image)
    pen = ImageDraw.Draw(paper)
    font = ImageFont.load_default(size=size)
    ink = _DARK if image[0].mean() > 110.0 else _LIGHT
    for label, (x, y) in zip(labels, places, strict=True):
        pen.text((x, y + size // 3), label, fill=ink, font=font, anchor="ma")
    image[:] = np.asarray(paper)
