"""A creature with a head that can be moved: from a mesh to a live session."""

import numpy as np

import snapspace as ss
from snapspace.generators import creature, creature_handles

mesh = creature(tets=6_000)  # or ss.read_tets("dragon.mesh")
parts = creature_handles(mesh)
handles = ss.Handles([parts["feet"], parts["head"]], names=["feet", "head"])
domain = ss.HandleBox(translation=0.3, angle=np.deg2rad(45))
problem = ss.PosingProblem(mesh, handles, domain=domain)

model = ss.accurate_model(problem).model  # error 0.3 % on motions not used for training
model.save("creature.snapspace")

session = ss.load_posing("creature.snapspace").session()
report = session.move("head", euler=(0, 0, 0.6), translation=(0, 0.1, 0.1))
ss.write_surface("creature.obj", session.vertices, mesh.surface)
