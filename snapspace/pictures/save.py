"""Writing pictures to files."""

from __future__ import annotations

import os
from pathlib import Path
from typing import Any

import numpy as np

from ..arguments import as_path
from ..disk import atomic_file
from ..extras import need_extra


def save_png(path: str | os.PathLike[str], image: Any) -> Path:
    """Write an image as PNG: completely, or not at all.

    The bytes go to a temporary file in the same folder, which is renamed at the end. An existing
    file at `path` stays until the new picture is complete.

    Parameters
    ----------
    path : path
        Ends in ``.png``; its folder exists.
    image : ndarray, (h, w, 3) uint8
        sRGB, as `render` returns it.

    Returns
    -------
    Path
        The file written.

    Raises
    ------
    MissingExtraError
        A ValueError, if the extra `snapspace[pictures]` is not installed.
    ValueError
        If the extension is not ``.png``, the folder does not exist, `image` is not an image, or the
        file cannot be written.
    """
    target = as_path("save_png", path)
    if target.suffix.lower() != ".png":
        raise ValueError(f"save_png: {target} does not end in .png; name it {target.stem}.png")
    if not target.parent.is_dir():
        raise ValueError(f"save_png: folder {target.parent} does not exist; create it first")
    if target.is_dir():
        raise ValueError(f"save_png: {target} is a folder; give the name of a file")
    pixels = np.asarray(image)
    if pixels.dtype != np.uint8 or pixels.ndim != 3 or pixels.shape[2] != 3 or not pixels.size:
        raise ValueError(
            f"save_png: image has shape {pixels.shape} and type {pixels.dtype}; "
            "give (h, w, 3) uint8"
        )

    need_extra("pictures", who="save_png")
    from PIL import Image

    with atomic_file(target) as temporary:
        Image.fromarray(pixels).save(temporary, format="PNG", optimize=True)
    return target
