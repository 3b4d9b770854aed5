"""Finding: a property of a surface that its user should know."""

from __future__ import annotations

from dataclasses import asdict, dataclass, field
from typing import Any

#: The cure for a surface that may be open on purpose.
AS_SHELL = "leave a sheet such as cloth open: it is a shell"


@dataclass(frozen=True, kw_only=True)
class Finding:
    """One kind of fault, or a harmless peculiarity.

    name : its name, such as "holes"
    fault : whether it needs mending; otherwise it is only information
    count : how many there are
    text : what was found
    meaning : what it means for filling, posing and writing
    cure : what to do
    mended : whether `mend_surface` mends all or some of it
    details : numbers, as JSON
    """

    name: str
    fault: bool
    count: int
    text: str
    meaning: str
    cure: str
    mended: bool = False
    details: dict[str, Any] = field(default_factory=dict)

    def as_json(self) -> dict[str, Any]:
        """All fields."""
        return asdict(self)
