"""Findings about how faces meet: holes, orientation, non-manifold edges, parts, duplicates."""

from __future__ import annotations

import numpy as np
from numpy.typing import NDArray

from ..counted import counted
from ..mesh.arrays import FloatArray, IndexArray
from ..mesh.edges import Edges
from ..point_text import point_text
from .cleaned import Cleaned
from .components import face_components, orientation
from .fill_holes import closable_holes
from .finding import AS_SHELL, Finding
from .holes import Hole, is_sheet, vertices_at
from .minor_parts import minor_parts
from .parts_apart import parts_apart

#: Parts with a smaller share of the volume are dust, which filling leaves out. The area decides if
#: the surface is not closed.
DUST = 1e-3


def edge_findings(vertices: FloatArray, faces: IndexArray, edges: Edges) -> list[Finding]:
    """All findings about edges; none for a closed, consistently oriented surface in one part."""
    turn, _, twisted = orientation(edges)
    fans = int((edges.uses > 2).sum())
    parts = int(face_components(faces, len(vertices)).max()) + 1
    found: list[Finding] = []
    beside = np.zeros(len(faces), np.bool_)  # open parts that filling leaves out
    if (edges.uses == 1).any():
        oriented = np.where(turn[:, None], faces[:, ::-1], faces)  # as mending does it first
        diagonal = float(np.linalg.norm(np.ptp(vertices, axis=0)))
        holes = closable_holes(vertices, oriented)
        left = vertices_at(hole for hole, fill in holes if fill is None)
        beside = minor_parts(vertices, faces, left)
        sheet = is_sheet(vertices, faces)
        found.append(_holes(holes, sheet, diagonal, beside=bool(beside.any())))
    if turn.any() or twisted.any():
        found.append(_orientation(turn, twisted))
    if fans:
        first = edges.ends[np.flatnonzero(edges.uses > 2)[0]].tolist()
        found.append(
            Finding(
                name="non-manifold edges",
                fault=bool((edges.balance[edges.uses > 2] != 0).any()),
                count=fans,
                text=f"{counted(fans, 'edge has', 'edges have')} more than two faces (the first "
                f"between vertices {first[0]} and {first[1]})",
                meaning="inside and outside are clear only where as many faces run one way as the "
                "other",
                cure="delete the inner faces in a mesh editor, or fill it with fTetWild",
            )
        )
    if parts > 1:
        group = np.full(len(faces), -1)
        group[~beside], share = parts_apart(vertices, faces[~beside])
        found.append(_parts(parts, group, share))
    return found


def copy_findings(clean: Cleaned, unused: int) -> list[Finding]:
    """Findings about redundant points and faces."""
    found: list[Finding] = []
    if clean.merged:
        repeat = counted(clean.merged, "vertex repeats", "vertices repeat")
        found.append(
            Finding(
                name="seams",
                fault=False,
                count=clean.merged,
                text=f"{repeat} the position of another one",
                meaning="usual at seams of texture coordinates; they count as one here and move "
                "together",
                cure="nothing",
                mended=True,
            )
        )
    for name, count, text in (
        (
            "degenerate faces",
            clean.degenerate,
            f"{counted(clean.degenerate, 'face names', 'faces name')} a vertex twice",
        ),
        (
            "duplicate faces",
            clean.duplicate,
            f"{counted(clean.duplicate, 'face has', 'faces have')} the same vertices as another "
            "face",
        ),
    ):
        if count:
            found.append(
                Finding(
                    name=name,
                    fault=True,
                    count=count,
                    text=text,
                    meaning="they enclose nothing, and make the inside ambiguous",
                    cure="drop them: --fix",
                    mended=True,
                )
            )
    if unused:
        found.append(
            Finding(
                name="unused vertices",
                fault=False,
                count=unused,
                text=f"{counted(unused, 'vertex belongs', 'vertices belong')} to no face",
                meaning="they are kept in the file, but do not move",
                cure="nothing; --fix drops them",
                mended=True,
            )
        )
    return found


def _holes(
    holes: list[tuple[Hole, IndexArray | None]], sheet: bool, diagonal: float, *, beside: bool
) -> Finding:
    """`beside`: whether holes that cannot be closed are in parts beside the body only."""
    some = [
        f"{hole.edges} edges, length {hole.length:.4g}, around {point_text(hole.center, diagonal)}"
        for hole, _ in holes[:3]
    ]
    more = f"; and {len(holes) - 3} more" if len(holes) > 3 else ""
    can = sum(fill is not None for _, fill in holes)
    share = "them" if can == len(holes) else f"{can} of {len(holes)}"
    if can == len(holes):
        filling = "closes them"
    elif beside:
        closes = f"closes {share}, and " * (can > 0)
        filling = f"{closes}leaves out open parts such as cloth, which the nearest tets carry"
    elif can:
        filling = f"closes {share}, and leaves the others to the winding number (fTetWild)"
    else:
        filling = "closes none of them, and guesses the inside by the winding number (fTetWild)"
    cures = [f"--fix closes {share}"] * (can > 0)
    cures.append("leave cloth and hair open" if beside else "close them in a mesh editor")
    if sheet:
        cures.append(AS_SHELL)
    return Finding(
        name="holes",
        fault=True,
        count=len(holes),
        text=f"it is not closed: {counted(len(holes), 'hole')} ({'; '.join(some)}{more})",
        meaning=f"tets need an inside; filling {filling}",
        cure="; or ".join(cures),
        mended=can > 0,
        details={
            "sheet": sheet,
            "holes": [
                {
                    "edges": hole.edges,
                    "length": hole.length,
                    "diameter": hole.diameter,
                    "center": hole.center.tolist(),
                    "closed_by_fix": fill is not None,
                }
                for hole, fill in holes
            ],
        },
    )


def _parts(count: int, group: NDArray[np.intp], share: FloatArray) -> Finding:
    large = int((share > DUST).sum())
    dust = len(share) - large
    text = f"it has {count} parts without a common vertex"
    if large > 1:
        first = int(np.flatnonzero(group == 1)[0])
        text += f"; {large} of them are separate (face {first} is in the second largest)"
    if dust:
        text += f"; {dust} {'is' if dust == 1 else 'are'} separate and small"
    return Finding(
        name="components",
        fault=large > 1,
        count=count,
        text=text,
        meaning="filling needs one solid: it refuses large separate parts, leaves out those below "
        f"{DUST:.1%} of the volume, and makes one solid of overlapping ones",
        cure="join them, or remove separate parts; eyes and clothes can follow the body with "
        "`snapspace pose --surface FILE`",
        details={"shares": share[:100].tolist()},
    )


def _orientation(turn: NDArray[np.bool_], twisted: NDArray[np.bool_]) -> Finding:
    if twisted.any():
        count = int(twisted.sum())
        return Finding(
            name="flipped faces",
            fault=True,
            count=count,
            text=f"{counted(count, 'face forms', 'faces form')} a band that cannot be oriented, "
            "like a Moebius strip",
            meaning="it has no inside",
            cure="cut it in a mesh editor",
        )
    count = int(turn.sum())
    return Finding(
        name="flipped faces",
        fault=True,
        count=count,
        text=f"{counted(count, 'face is', 'faces are')} oriented against their neighbours (the "
        f"first: face {int(np.flatnonzero(turn)[0])})",
        meaning="orientation determines what is inside",
        cure="flip them: --fix",
        mended=True,
    )
