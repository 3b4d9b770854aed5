"""Links public names that a page sets as code, such as `reduce`, to their description."""

from __future__ import annotations

import re

from docutils import nodes
from sphinx import addnodes
from sphinx.application import Sphinx

import snapspace

_NAME = re.compile(r"(?:ss\.)?((\w+)(?:\.\w+)?)(?:\(.*\))?")


def _link(app: Sphinx, document: nodes.document) -> None:
    for literal in list(document.findall(nodes.literal)):
        found = _NAME.fullmatch(literal.astext())
        linked = isinstance(literal.parent, nodes.reference | addnodes.pending_xref)
        if found and found[2] in snapspace.__all__ and not linked:
            target = addnodes.pending_xref(
                "", refdomain="py", reftype="obj", reftarget=f"snapspace.{found[1]}", refwarn=False
            )
            literal.replace_self(target)
            target += literal


def setup(app: Sphinx) -> dict[str, bool]:
    app.connect("doctree-read", _link)
    return {"parallel_read_safe": True, "parallel_write_safe": True}
