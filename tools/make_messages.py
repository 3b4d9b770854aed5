"""Writes messages.ts and page_messages.ts in web/engine: the server's messages for the page.

Run this after a change of the messages; a test compares the files with the output of this script.

    python tools/make_messages.py [--check]
"""

from __future__ import annotations

import dataclasses
import inspect
import re
import sys
import types
import typing
from pathlib import Path

from snapspace.server import messages

FOLDER = Path(__file__).parent.parent / "web" / "engine"
SIMPLE = {int: "number", float: "number", str: "string", bool: "boolean", type(None): "null"}
ALIASES = {messages.Vector: "Vector", messages.Matrix: "Matrix"}

NINE = ", ".join(["number"] * 9)
HEAD = "// Written by tools/make_messages.py from snapspace/server/messages.py.\n"
ROWS = f"""\
export type Vector = readonly [number, number, number];
export type Matrix = readonly [{NINE}];
"""
SHARED = [*ALIASES.values(), *(part.__name__ for part in messages.PARTS)]


def files() -> dict[Path, str]:
    """The TypeScript modules: what the page sends with the parts of messages, and the others."""
    parts = [_interface(part, tagged=False) for part in messages.PARTS]
    sent = [_interface(each, tagged=True) for each in messages.FROM_PAGE]
    page = [HEAD, ROWS, *parts, *sent, _union("PageMessage", messages.FROM_PAGE)]
    received = [_interface(each, tagged=True) for each in messages.FROM_SERVER]
    text = "\n".join(received)
    used = ", ".join(name for name in SHARED if re.search(rf": (readonly )?{name}\b", text))
    own = "./page_messages.ts"
    links = f'import type {{ {used} }} from "{own}";\n\nexport type * from "{own}";\n'
    server = [HEAD, links, *received, _union("ServerMessage", messages.FROM_SERVER)]
    return {
        FOLDER / "page_messages.ts": "\n".join(page),
        FOLDER / "messages.ts": "\n".join(server),
    }


def _interface(message: type, *, tagged: bool) -> str:
    lines = [_comment(message), f"export interface {message.__name__} {{"]
    if tagged:
        lines.append(f'  readonly type: "{messages.type_name(message)}";')
    hints = typing.get_type_hints(message)
    for field in dataclasses.fields(message):
        optional = "?" if field.default is not dataclasses.MISSING else ""
        lines.append(f"  readonly {field.name}{optional}: {_type(hints[field.name])};")
    return "\n".join([*lines, "}\n"])


def _type(hint: typing.Any) -> str:
    if hint in SIMPLE:
        return SIMPLE[hint]
    if hint in ALIASES:
        return ALIASES[hint]
    if dataclasses.is_dataclass(hint) and isinstance(hint, type):
        return hint.__name__
    arguments = typing.get_args(hint)
    if isinstance(hint, types.UnionType) or typing.get_origin(hint) is typing.Union:
        return " | ".join(_type(argument) for argument in arguments)
    if typing.get_origin(hint) is tuple and len(arguments) == 2 and arguments[1] is Ellipsis:
        return f"readonly {_type(arguments[0])}[]"
    raise TypeError(f"make_messages: no TypeScript for {hint}")


def _comment(message: type) -> str:
    lines = inspect.getdoc(message).splitlines()  # type: ignore[union-attr]
    if len(lines) == 1:
        return f"/** {lines[0]} */"
    body = [f" * {line}".rstrip() for line in lines[1:]]
    return "\n".join([f"/** {lines[0]}", *body, " */"])


def _union(name: str, members: tuple[type, ...]) -> str:
    # one per line if they do not fit into a line, as prettier formats them
    names = [member.__name__ for member in members]
    line = f"export type {name} = {' | '.join(names)};"
    if len(line) <= 110:
        return line + "\n"
    second = f"  {' | '.join(names)};"
    if len(second) <= 110:
        return f"export type {name} =\n{second}\n"
    return "\n".join([f"export type {name} =", *(f"  | {each}" for each in names)]) + ";\n"


def main() -> int:
    """Writes the files; with --check only checks whether they are up to date."""
    found = files()
    if "--check" not in sys.argv[1:]:
        for path, text in found.items():
            path.write_text(text, encoding="utf-8")
            print(f"wrote {path}")
        return 0
    old = [path.name for path, text in found.items() if path.read_text(encoding="utf-8") != text]
    if old:
        print(f"make_messages: {', '.join(old)} are not up to date; run tools/make_messages.py")
    return len(old) and 1


if __name__ == "__main__":
    sys.exit(main())
