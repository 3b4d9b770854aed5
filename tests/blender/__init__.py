"""The Blender extension, in Blender as a Python module (bpy from PyPI), without a window.

bpy is under the GPL and has 350 MB, so the tests do not depend on it: they are skipped without it.
"""
