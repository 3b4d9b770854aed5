"""A local server for the page: it poses models, and chooses handles on meshes."""

from .bodies import MESH_SUFFIXES, PROBLEM_SUFFIX, mesh_body, problem_body, read_mesh
from .serve import serve
from .shared_body import SharedBody

__all__ = [
    "MESH_SUFFIXES",
    "PROBLEM_SUFFIX",
    "SharedBody",
    "mesh_body",
    "problem_body",
    "read_mesh",
    "serve",
]
