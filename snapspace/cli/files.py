"""Extensions by what they hold; a test keeps them equal to what the mesh room reads and writes."""

from __future__ import annotations

TET_INPUTS = (".mesh", ".meshb", ".msh", ".vtk", ".vtu", ".node", ".ele", ".veg")
SURFACE_INPUTS = (".obj", ".off", ".ply", ".stl")
TET_OUTPUTS = (".msh", ".vtu", ".vtk", ".mesh")
SURFACE_OUTPUTS = (".obj", ".ply", ".off", ".stl")
