"""The Blender extension: vertex groups are handles, empties drive the live solve.

The modules that use bpy are imported by `register` only.
"""


def register() -> None:
    """Adds settings, operators, the panel, and the handlers of the live solve."""
    from . import bake, compute, live, panel, settings

    for module in (settings, compute, bake, panel, live):
        module.register()


def unregister() -> None:
    """Removes what `register` added, in the opposite order."""
    from . import bake, compute, live, panel, settings

    for module in (live, panel, bake, compute, settings):
        module.unregister()
