# SPDX-License-Identifier: BSD-3-Clause
"""What the Python module costs: importing it, and a call beside the steps of the library. How soon Ctrl-C ends the
functions is told by python_interrupts.py.

usage: PYTHONPATH=build/release/python python3 tests/benchmarks/python_calls.py
"""

import time

import numpy as np

start, processor = time.perf_counter(), time.process_time()
import pcl_uvol as uvol  # noqa: E402

print(f"import beyond numpy: {1e3 * (time.perf_counter() - start):.0f} ms, "
      f"{1e3 * (time.process_time() - processor):.0f} ms of the processor")

import warnings  # noqa: E402

warnings.simplefilter("ignore")
random = np.random.default_rng(3)

small = uvol.Extractor(random.random((5, 3)), {"a": random.random(5)})
small.extract(iso=7.0, threads=1)
processor, calls = time.process_time(), 1000
for _ in range(calls):
    small.extract(iso=7.0, threads=1)
print(f"a call that finds nothing among 5 samples: {1e3 * (time.process_time() - processor) / calls:.2f} ms of the "
      "processor")

points = random.random((1000000, 3))
noisy = np.linalg.norm(points - 0.5, axis=1) + 0.05 * random.standard_normal(len(points))
singles = points.astype(np.float32)


def spent(call, times=8):
    """Range of the processor time of this thread, in milliseconds: the library's steps run on others."""
    figures = []
    for _ in range(times):
        begin = time.thread_time()
        call()
        figures.append(1e3 * (time.thread_time() - begin))
    return f"{min(figures):.1f} to {max(figures):.1f} ms of this thread"


print("a million samples from float32 points:", spent(lambda: uvol.Samples(singles, {"r": noisy})))
print("a million samples from float64 points:", spent(lambda: uvol.Samples(points, {"r": noisy})))
print("a million samples from records of empty():", spent(lambda: uvol.Samples(uvol.empty(10**6, {"r": "f8"}))))
samples = uvol.Samples(singles, {"r": noisy})
extractor = uvol.Extractor(samples)
surface = extractor.extract(iso=0.3)
print("an isosurface of a million samples:", spent(lambda: extractor.extract(iso=0.3)))
print("a picture of it:", spent(lambda: surface.render(size=500)))
print("splats of it:", spent(lambda: uvol.splats(surface), 3))
print("two steps of a level set of a million samples:", spent(lambda: uvol.level_set(samples, iso=0.3, mu=0.5, max_steps=2), 3))
print("a Voronoi grid of 100 cells of a million samples:", spent(lambda: uvol.voronoi(samples, cells=100), 3))
print("samples chosen among a million:", spent(lambda: samples.where("r > 0.3"), 3))
nearest = uvol.Interpolator(samples, model="nearest", errors=False, gradients=False)
print("a million answers:", spent(lambda: nearest(points), 3))
halves = noisy > 0.3
print("a projection of a million samples:",
      spent(lambda: uvol.project(samples, attributes=["r", "x", "y", "z"], labels=halves, method="pca"), 3))
