"""Packages that only some parts of Snapspace need, and the extras that install them."""

from __future__ import annotations

import sys
from importlib.util import find_spec

#: The modules that each extra installs; `pyproject.toml` has their distributions and versions.
EXTRAS = {
    "dask": ("distributed",),
    "fill": ("pytetwild",),
    "pictures": ("PIL",),
    "video": ("imageio_ffmpeg",),
    "view": ("starlette", "uvicorn", "websockets"),
}

#: Distributions whose name is not that of their module.
_DISTRIBUTIONS = {"PIL": "pillow", "imageio_ffmpeg": "imageio-ffmpeg"}


class MissingExtraError(ValueError, ImportError):
    """A package that the called function needs is missing; the message names the extra."""


def missing(extra: str) -> tuple[str, ...]:
    """The modules of an extra that are not installed; imports none of them."""
    return tuple(name for name in EXTRAS[extra] if find_spec(name) is None)


def need_extra(extra: str, *, who: str) -> None:
    """Raises MissingExtraError, with the command that installs the extra, if it is missing."""
    absent = missing(extra)
    if absent:
        cure = f'pip install "snapspace[{extra}]"'
        if extra == "fill" and sys.platform == "darwin" and _is_intel():
            cure = "it has no wheels for Intel Macs; fill with quick tets, or on another machine"
        noun = "package" if len(absent) == 1 else "packages"
        names = ", ".join(_DISTRIBUTIONS.get(name, name) for name in absent)
        raise MissingExtraError(f"{who} needs the {noun} {names}: {cure}")


def _is_intel() -> bool:
    import platform

    return platform.machine() == "x86_64"
