"""Makes the pictures of the docs, from generated shapes.

python docs/make_pictures.py
python docs/make_pictures.py helix poses
"""

from __future__ import annotations

import argparse
from collections.abc import Callable
from pathlib import Path

import numpy as np
from numpy.typing import NDArray
from pictures_creature import creature_picture
from pictures_helix import helix_picture
from pictures_materials import materials_picture
from pictures_poses import poses_picture

from snapspace.pictures import save_png

FOLDER = Path(__file__).parent / "pictures"
PICTURES: dict[str, Callable[[], NDArray[np.uint8]]] = {
    "creature": creature_picture,
    "helix": helix_picture,
    "materials": materials_picture,
    "poses": poses_picture,
}


def main() -> None:
    parser = argparse.ArgumentParser(description=__doc__)
    parser.add_argument("names", nargs="*", metavar="name", help=f"one of {', '.join(PICTURES)}")
    names = parser.parse_args().names or list(PICTURES)
    for name in names:
        if name not in PICTURES:
            parser.error(f"there is no picture '{name}'; the pictures are {', '.join(PICTURES)}")
    for name in names:
        save_png(FOLDER / f"{name}.png", PICTURES[name]())


if __name__ == "__main__":
    main()
