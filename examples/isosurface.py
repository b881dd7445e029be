# SPDX-License-Identifier: BSD-3-Clause
"""Isosurface with a field carried along, values between the samples, a closed mesh and its volume."""
import numpy as np
import pcl_uvol as uvol

points = np.random.default_rng(1).uniform(-1, 1, (100000, 3))
radius = np.linalg.norm(points, axis=1)
samples = uvol.Samples(points, {"radius": radius, "velocity": points[:, [1, 0, 2]] * (-1, 1, 0)})

surface = uvol.isosurface(samples, field="radius", iso=0.5, outside="higher")
radii = np.linalg.norm(surface.points, axis=1)
speed = np.linalg.norm(surface["velocity"], axis=1)
print(f"{len(surface.points)} isopoints at {radii.mean():.4f} from the centre, estimated error "
      f"{np.nanmedian(surface['error']):.1e}, speed {speed.mean():.3f}")

queries = np.array([[0.1, 0.2, 0.3], [0.3, 0.0, 0.0]])
values, errors = uvol.Interpolator(samples, field="radius")(queries)
for position, value, error in zip(queries, values.ravel(), errors.ravel()):
    print(f"radius at {position}: {value:.6f} +- {error:.1e}, true {np.linalg.norm(position):.6f}")

mesh = surface.mesh()
measures = mesh.measure()
print(f"{len(mesh.triangles)} triangles, volume {measures.volume.value:.5f} +- {measures.volume.error:.1e} "
      f"(ball {np.pi / 6:.5f}), genus {measures.genus}")
