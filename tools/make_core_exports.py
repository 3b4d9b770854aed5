"""Writes web/engine/core_exports.ts: functions, codes and structs of core/online for the page.

They come from core/online/snapspace_online.h. Run this after a change of the header; a test
compares the file with the output of this script.

    python tools/make_core_exports.py [--check]
"""

from __future__ import annotations

import sys
from pathlib import Path

sys.path.insert(0, str(Path(__file__).parent))

import core_header

PATH = Path(__file__).parent.parent / "web" / "engine" / "core_exports.ts"
WIDEST = 110  # characters per line, as for prettier

HEAD = """\
// Written by tools/make_core_exports.py from core/online/snapspace_online.h.

/** What web/generated/core.wasm exports; pointers are numbers. */
export interface CoreExports {
  memory: WebAssembly.Memory;
  _initialize(): void;
  malloc(bytes: number): number;
  free(pointer: number): void;
"""

LAYOUT = """\
/** A struct in the memory of the core: its bytes, and its fields. Pointers are integers. */
export interface Layout {
  readonly size: number;
  readonly fields: Readonly<Record<string, readonly ["int" | "double", number]>>;
}
"""


def exports_text() -> str:
    """The TypeScript module."""
    lines = [HEAD.rstrip("\n")]
    for function in core_header.functions():
        lines += _function(function)
    parts = ["\n".join([*lines, "}\n"])]
    for name, values in core_header.enums().items():
        body = ", ".join(f"{key}: {value}" for key, value in values.items())
        parts.append(_one_or_many(f"export const {name.upper()} = {{", body, "} as const;"))
    parts.append(LAYOUT)
    parts += [_struct(struct) for struct in core_header.structs()]
    return "\n".join(parts)


def _function(function: core_header.Function) -> list[str]:
    returns = "void" if function.returns == "void" else "number"
    parameters = [f"{_camel(name)}: number" for name in function.parameters]
    line = f"  {function.name}({', '.join(parameters)}): {returns};"
    if len(line) <= WIDEST:
        return [line]
    return [f"  {function.name}(", *(f"    {each}," for each in parameters), f"  ): {returns};"]


def _one_or_many(head: str, body: str, tail: str) -> str:
    line = f"{head} {body} {tail}"
    if len(line) <= WIDEST:
        return line + "\n"
    return "\n".join([head, *(f"  {each}," for each in body.split(", ")), tail]) + "\n"


def _struct(struct: core_header.Struct) -> str:
    name = struct.name.upper()
    fields = [
        f'    {_camel(field.name)}: ["{field.type}", {field.offset}],' for field in struct.fields
    ]
    head = [f"export const {name} = {{", f"  size: {struct.size},", "  fields: {"]
    return "\n".join([*head, *fields, "  },", "} as const satisfies Layout;\n"])


def _camel(name: str) -> str:
    first, *others = name.split("_")
    return first + "".join(part.capitalize() for part in others)


def main() -> int:
    """Writes the file; with --check only checks whether it is up to date."""
    if "--check" not in sys.argv[1:]:
        PATH.write_text(exports_text(), encoding="utf-8")
        print(f"wrote {PATH}")
        return 0
    if PATH.read_text(encoding="utf-8") == exports_text():
        return 0
    print("make_core_exports: core_exports.ts is not up to date; run tools/make_core_exports.py")
    return 1


if __name__ == "__main__":
    sys.exit(main())
