"""Whether a pose of a closed surface is inside out, as a mirror image is."""

from __future__ import annotations

from collections.abc import Sequence

from .arrays import FloatArray, IndexArray
from .closed_surface import enclosed_volume
from .edges import edges_of

#: What to do with a mirror image.
MIRROR_BACK = (
    "mirror it back (for a mirrored motion of a symmetric body, also exchange the vertices of both "
    "sides)"
)
#: Sheets that pass through themselves may enclose a little of the other sign.
SHARE = 0.5


def check_not_inside_out(shapes: FloatArray, faces: IndexArray, names: Sequence[str]) -> None:
    """Raise ValueError if a pose of a closed surface encloses the negative of the first's volume.

    Parameters
    ----------
    shapes : ndarray, (k, n, 3)
        In one unit of length.
    faces : ndarray of int, (f, 3)
        Open surfaces are accepted, since nothing tells their sides apart.
    names : sequence of str
        One per pose, for the message.

    Raises
    ------
    ValueError
        If the sign of the volume changes and at least half of its size remains. The message names
        the first such pose.
    """
    if edges_of(faces).balance.any():
        return
    first, *others = (enclosed_volume(shape, faces) for shape in shapes)
    for name, volume in zip(names[1:], others, strict=True):
        if volume * first < 0.0 and abs(volume) >= SHARE * abs(first):
            raise ValueError(
                f"{name}: is inside out, probably a mirror image: its faces enclose a volume of "
                f"{volume:g}, but those of {names[0]} {first:g}; {MIRROR_BACK}"
            )
