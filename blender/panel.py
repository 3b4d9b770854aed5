"""The panel in the sidebar of the 3D view."""

import bpy

from .mesh_data import pose_keys


class SNAPSPACE_PT_panel(bpy.types.Panel):
    """Settings, operators, and the state of the current model"""

    bl_label = "Snapspace"
    bl_space_type = "VIEW_3D"
    bl_region_type = "UI"
    bl_category = "Snapspace"

    @classmethod
    def poll(cls, context: bpy.types.Context) -> bool:
        return context.object is not None and context.object.type == "MESH"

    def draw(self, context: bpy.types.Context) -> None:
        owner, layout = context.object, self.layout
        settings = owner.snapspace
        layout.use_property_split = True
        column = layout.column()
        column.prop(settings, "translation")
        column.prop(settings, "angle")
        column.prop(settings, "edge_length")
        column.prop(settings, "error")
        groups = sum(group.name[0] != "_" for group in owner.vertex_groups)
        layout.operator("snapspace.compute", text=f"Compute ({groups} handles)")
        poses = pose_keys(owner)
        if poses:
            layout.operator("snapspace.compute_blend", text=f"Compute Blends ({len(poses)} poses)")
        if settings.status:
            layout.label(text=settings.status)
        if settings.model:
            layout.prop(settings, "live")
            layout.operator("snapspace.bake")


def register() -> None:
    bpy.utils.register_class(SNAPSPACE_PT_panel)


def unregister() -> None:
    bpy.utils.unregister_class(SNAPSPACE_PT_panel)
