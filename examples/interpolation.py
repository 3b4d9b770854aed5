"""A cylinder that becomes a helix: from two poses to blends with any weights."""

import numpy as np

import snapspace as ss
from snapspace.generators import cylinder, helix
from snapspace.mesh import tet_volumes

poses = [cylinder(), helix(turns=2.0)]  # or [ss.read_tets("lion0.mesh"), ss.read_tets(...)]
problem = ss.InterpolationProblem(poses)

samples = ss.sample(problem.domain, 30, method="grid")
snapshots = ss.solve_snapshots(problem, samples)
subspace = ss.snapshot_pca(snapshots, dimension=20)
model = ss.reduce(problem, subspace, snapshots=snapshots)

mesh, session = problem.mesh, model.session()
print("weights     volume  of the linear blend")
for t in np.linspace(0.0, 1.0, 7):
    session.blend([1 - t, t])
    volume = tet_volumes(session.vertices, mesh.tets).sum()
    linear = tet_volumes(problem.linear_blend([1 - t, t]), mesh.tets).sum()
    print(f"{1 - t:.2f} {t:.2f} {volume / mesh.volume:8.1%} {linear / mesh.volume:20.1%}")

session.blend([0.5, 0.5])
ss.write_surface("halfway.obj", session.vertices, mesh.surface)
