"""core/online/snapspace_online.h as data: its functions, enums and structs."""

from __future__ import annotations

import re
from dataclasses import dataclass
from pathlib import Path

HEADER = Path(__file__).parent.parent / "core" / "online" / "snapspace_online.h"
PREFIX = "snapspace_"


@dataclass(frozen=True)
class Function:
    """A function of the header, and the names of its parameters."""

    name: str
    parameters: tuple[str, ...]
    returns: str


@dataclass(frozen=True)
class Field:
    """A field of a struct. `type` is "int", for pointers and enums too, or "double"."""

    name: str
    type: str
    offset: int


@dataclass(frozen=True)
class Struct:
    """A struct in the layout of a 32-bit WebAssembly module.

    Fields of inner structs are its own fields, named OUTER_INNER.
    """

    name: str
    size: int
    fields: tuple[Field, ...]

    @property
    def alignment(self) -> int:
        """The alignment in bytes: 8 if there is a double, else 4."""
        return 8 if any(field.type == "double" for field in self.fields) else 4


def functions() -> tuple[Function, ...]:
    """All functions, in the header's order."""
    body = re.sub(r"(typedef struct|enum) \w+ \{.*?\}[^;]*;", "", _code(), flags=re.S)
    found = re.findall(rf"([\w ]+\*?)\s*\b({PREFIX}\w+)\(([^)]*)\);", body)
    return tuple(
        Function(name, tuple(re.findall(r"(\w+)\s*(?:,|$)", parameters)), returns.strip())
        for returns, name, parameters in found
    )


def enums() -> dict[str, dict[str, int]]:
    """The values of all enums by name; the keys are the enums' names without prefix."""
    found = re.findall(rf"\benum {PREFIX}(\w+) \{{([^}}]*)\}};", _code())
    return {
        name: {
            key.removeprefix(PREFIX.upper()): int(value)
            for key, value in re.findall(r"(\w+) = (-?\d+)", body)
        }
        for name, body in found
    }


def structs() -> tuple[Struct, ...]:
    """All structs that are defined, in the header's order."""
    known: dict[str, Struct] = {}
    for name, body in re.findall(rf"typedef struct {PREFIX}(\w+) \{{([^}}]*)\}}", _code()):
        known[name] = _struct(name, body, known)
    return tuple(known.values())


def _struct(name: str, body: str, known: dict[str, Struct]) -> Struct:
    fields: list[Field] = []
    end, alignment = 0, 4
    for line in filter(None, (part.strip() for part in body.split(";"))):
        match = re.fullmatch(r"(?:const )?((?:enum )?\w+)\s*(\*?)\s*(\w+)", line)
        if match is None:
            raise ValueError(f"{HEADER.name}: each line must have one field, got '{line}'")
        kind, pointer, field = match.groups()
        inner = known.get(kind.removeprefix(PREFIX))
        if inner is not None and not pointer:
            end = _aligned(end, inner.alignment)
            own = [Field(f"{field}_{f.name}", f.type, end + f.offset) for f in inner.fields]
            size = inner.size
        elif kind == "double" and not pointer:
            end, size = _aligned(end, 8), 8
            own = [Field(field, "double", end)]
        elif pointer or kind == "int" or kind.startswith("enum "):
            size = 4
            own = [Field(field, "int", end)]
        else:
            raise ValueError(f"{HEADER.name}: the type of '{line}' is not supported")
        fields += own
        end += size
        alignment = max(alignment, *(8 if f.type == "double" else 4 for f in own))
    return Struct(name, _aligned(end, alignment), tuple(fields))


def _aligned(offset: int, alignment: int) -> int:
    return -(-offset // alignment) * alignment


def _code() -> str:
    text = re.sub(r"/\*.*?\*/", "", HEADER.read_text(encoding="utf-8"), flags=re.S)
    return re.sub(r"^\s*#.*$|extern \"C\" \{", "", text, flags=re.M)
