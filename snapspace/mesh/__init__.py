"""Meshes of solids and shells: the mesh itself, its mass, repair, reading and writing."""

from .body import Body
from .check_body import check_body
from .embed_surface import embed_file, embed_surface
from .embedded_surface import EmbeddedSurface, boundary_surface
from .file_kind import file_kind
from .mass import (
    apply_mass,
    check_mass,
    mass_gram,
    mass_inner,
    mass_matrix,
    mass_norm,
    mass_norms,
    mass_of_cells,
)
from .mirror_plane import MirrorPlane, check_plane
from .quality import dihedral_angles, tet_volumes, triangle_areas
from .read import TET_SUFFIXES, MeshNotice, read_tet_arrays, read_tets
from .read_surface import SURFACE_SUFFIXES, read_surface
from .repair import repair_tets
from .shape_rows import as_shape, shape_or_rows, shape_rows
from .shell_mesh import ShellMesh
from .shell_of_file import shell_of_file
from .solid import solid_of
from .surface import boundary_faces, compact_surface, vertex_normals
from .surface_file import Appearance, SurfaceFile, SurfaceMaterial, open_surface
from .tet_mesh import TetMesh
from .write import SURFACE_OUTPUTS, TET_OUTPUTS, write_surface, write_tets

__all__ = [
    "SURFACE_OUTPUTS",
    "SURFACE_SUFFIXES",
    "TET_OUTPUTS",
    "TET_SUFFIXES",
    "Appearance",
    "Body",
    "EmbeddedSurface",
    "MeshNotice",
    "MirrorPlane",
    "ShellMesh",
    "SurfaceFile",
    "SurfaceMaterial",
    "TetMesh",
    "apply_mass",
    "as_shape",
    "boundary_faces",
    "boundary_surface",
    "check_body",
    "check_mass",
    "check_plane",
    "compact_surface",
    "dihedral_angles",
    "embed_file",
    "embed_surface",
    "file_kind",
    "mass_gram",
    "mass_inner",
    "mass_matrix",
    "mass_norm",
    "mass_norms",
    "mass_of_cells",
    "open_surface",
    "read_surface",
    "read_tet_arrays",
    "read_tets",
    "repair_tets",
    "shape_or_rows",
    "shape_rows",
    "shell_of_file",
    "solid_of",
    "tet_volumes",
    "triangle_areas",
    "vertex_normals",
    "write_surface",
    "write_tets",
]
