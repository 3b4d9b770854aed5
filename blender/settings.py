"""Settings of an object, saved in the .blend file."""

import math

import bpy

# Since 4.5 Blender wants to know which paths may begin with "//", the folder of the .blend file.
_RELATIVE = {"PATH_SUPPORTS_BLEND_RELATIVE"} if bpy.app.version >= (4, 5, 0) else set()
_PATH_OPTIONS = {"ANIMATABLE"} | _RELATIVE


class SnapspaceSettings(bpy.types.PropertyGroup):
    """How a model is made, where it is stored, and whether it is solved live."""

    translation: bpy.props.FloatProperty(
        name="Motion",
        description="How far handles move along each axis, as a share of the mesh's diagonal",
        default=0.15,
        min=0.0,
        max=2.0,
        subtype="FACTOR",
    )
    angle: bpy.props.FloatProperty(
        name="Angle",
        description="How far handles turn about each axis",
        default=math.radians(30),
        min=0.0,
        max=math.pi,
        subtype="ANGLE",
    )
    error: bpy.props.FloatProperty(
        name="Error",
        description="The search ends at this error on unseen motions or blends, in percent",
        default=0.5,
        min=0.01,
        max=100.0,
        subtype="PERCENTAGE",
    )
    edge_length: bpy.props.FloatProperty(
        name="Tets",
        description="Length of the tets' edges, as a share of the mesh's diagonal",
        default=0.025,
        min=0.005,
        max=0.2,
        precision=3,
    )
    model: bpy.props.StringProperty(name="Model", subtype="FILE_PATH", options=_PATH_OPTIONS)
    status: bpy.props.StringProperty()
    live: bpy.props.BoolProperty(
        name="Live", description="Solve whenever an empty or a weight changes", default=True
    )


def register() -> None:
    bpy.utils.register_class(SnapspaceSettings)
    bpy.types.Object.snapspace = bpy.props.PointerProperty(type=SnapspaceSettings)


def unregister() -> None:
    del bpy.types.Object.snapspace
    bpy.utils.unregister_class(SnapspaceSettings)
