"""Films of shapes: GIF and MP4."""

from __future__ import annotations

import os
from collections.abc import Iterator, Sequence
from pathlib import Path
from typing import Any

import numpy as np
from numpy.typing import NDArray

from ..arguments import as_path
from ..disk import atomic_file
from ..extras import need_extra
from .backdrop import backdrop, to_bytes
from .checks import checked_samples, checked_size
from .scene import Scene

FILMS = (".gif", ".mp4")


def save_film(
    path: str | os.PathLike[str],
    shapes: Sequence[Any],
    faces: Any,
    *,
    frames_per_second: float = 30.0,
    size: tuple[int, int] = (640, 480),
    azimuth: float = -60.0,
    elevation: float = 15.0,
    up: str = "z",
    colors: Any = None,
    ground: bool = True,
    background: Sequence[float] | None = None,
    field_of_view: float = 24.0,
    margin: float = 0.10,
    samples: int = 2,
) -> Path:
    """Draws shapes of one mesh as `render` does, and writes them as a film that repeats.

    The camera does not move and frames all shapes together. The file is written completely or not
    at all.

    Parameters
    ----------
    path : path
        Ends in .gif, or in .mp4 (H.264), which needs `pip install "snapspace[video]"`.
    shapes : sequence of (n, 3)
        One shape per frame.
    faces : array_like of int, (f, 3)
    frames_per_second : float, default 30
        From 1 to 100. GIF rounds the time of a frame to hundredths of a second: 30 becomes 33.
    size : (int, int), default (640, 480)
        In pixels; both even for .mp4.
    azimuth, elevation, up, colors, ground, background, field_of_view, margin, samples
        As for `render`.

    Returns
    -------
    Path
        The file written.

    Raises
    ------
    MissingExtraError
        A ValueError, if the extra `snapspace[pictures]` or, for .mp4, `snapspace[video]` is not
        installed.
    ValueError
        As for `render`, and for no shapes, another extension, a folder that does not exist, a rate
        out of range, or a size that is not even.
    """
    target = _checked_path(path)
    width, height = checked_size(size, who="save_film")
    if not 1.0 <= frames_per_second <= 100.0:
        raise ValueError(
            f"save_film: frames_per_second is {frames_per_second}, but must be from 1 to 100"
        )
    if not len(shapes):
        raise ValueError("save_film: there are no shapes; give one for each frame")
    movie = target.suffix.lower() == ".mp4"
    if movie:
        _check_movie(width, height)
    need_extra("pictures", who="save_film")
    paper = backdrop(width, height, background)
    scene = Scene.of(shapes, faces, [colors] * len(shapes), who="save_film")
    exposures = scene.exposures(
        size=(width, height),
        azimuth=azimuth,
        elevation=elevation,
        up=up,
        field_of_view=field_of_view,
        margin=margin,
        ground=ground,
        samples=checked_samples(samples, who="save_film"),
    )
    frames = (to_bytes(one.over(paper * one.shadow()[:, :, None])) for one in exposures)
    with atomic_file(target) as unfinished:
        if movie:
            _write_movie(unfinished, frames, (width, height), frames_per_second)
        else:
            _write_gif(unfinished, frames, frames_per_second)
    return target


def _write_gif(path: Path, frames: Iterator[NDArray[np.uint8]], rate: float) -> None:
    from PIL import Image

    # without dithering, parts that do not move do not flicker, and files are small
    none, cut = Image.Dither.NONE, Image.Quantize.MEDIANCUT
    images = (Image.fromarray(frame).quantize(256, method=cut, dither=none) for frame in frames)
    first = next(images)
    duration = 10 * max(1, round(100.0 / rate))  # ms
    first.save(path, save_all=True, append_images=images, duration=duration, loop=0, optimize=False)


def _write_movie(
    path: Path, frames: Iterator[NDArray[np.uint8]], size: tuple[int, int], rate: float
) -> None:
    import imageio_ffmpeg

    writer = imageio_ffmpeg.write_frames(
        str(path), size, fps=rate, codec="libx264", quality=8, macro_block_size=2
    )
    writer.send(None)
    try:
        for frame in frames:
            writer.send(np.ascontiguousarray(frame))
    finally:
        writer.close()


def _checked_path(path: str | os.PathLike[str]) -> Path:
    target = as_path("save_film", path)
    if target.suffix.lower() not in FILMS:
        raise ValueError(
            f"save_film: {target} has an unknown extension; known are {', '.join(FILMS)}"
        )
    if not target.parent.is_dir():
        raise ValueError(f"save_film: folder {target.parent} does not exist; create it first")
    if target.is_dir():
        raise ValueError(f"save_film: {target} is a folder; give the name of a file")
    return target


def _check_movie(width: int, height: int) -> None:
    if width % 2 or height % 2:
        raise ValueError(f"save_film: size is {width} x {height}, but .mp4 takes even numbers")
    need_extra("video", who="save_film: .mp4")
