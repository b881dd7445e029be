# SPDX-License-Identifier: BSD-3-Clause
"""How soon Ctrl-C ends the functions of the Python module.

usage: PYTHONPATH=build/release/python python3 tests/benchmarks/python_interrupts.py [POINTS [NAME ...]]

Each function whose name contains one of the given words (by default all) runs twice. The first run finds the longest
time without a report of progress, the second one gets Ctrl-C at the beginning of that time. A row tells, in seconds,
the time of the whole function and of the longest silence, both of the processors, of all threads together, so that
other programs do not matter; the time from Ctrl-C to KeyboardInterrupt; and the steps that were told before and after
the silence.
"""

import os
import signal
import sys
import tempfile
import threading
import time
import warnings

import numpy as np

import pcl_uvol as uvol

POINTS = int(sys.argv[1]) if len(sys.argv) > 1 else 1000000
WORDS = sys.argv[2:]
warnings.simplefilter("ignore")
folder = tempfile.TemporaryDirectory()


class Silence:
    """A listener that keeps the longest time of the processors between two reports of progress."""

    def __init__(self):
        self.start, self.first = time.perf_counter(), time.process_time()
        self.begin, self.last = self.start, self.first
        self.step, self.longest, self.delay, self.between = "start", 0.0, 0.0, ("start", "end")

    def __call__(self, step, done):
        now = time.process_time()
        if now - self.last > self.longest:
            self.longest, self.delay = now - self.last, self.begin - self.start
            self.between = (self.step, step)
        self.step, self.begin, self.last = f"{step} {100 * done:.0f} %", time.perf_counter(), now


def find_silence(call):
    """What a listener heard of a whole call."""
    silence = Silence()
    call(silence)
    silence("end", 1.0)
    return silence


def interrupt(call, delay):
    """The time from Ctrl-C to the exception; None if the call was done before."""
    pressed = []

    def press():
        pressed.append(time.perf_counter())
        signal.raise_signal(signal.SIGINT)

    timer = threading.Timer(delay, press)
    try:
        timer.start()
        call(None)
        timer.cancel()
        timer.join()
        time.sleep(0.01)  # a signal that came at last
    except KeyboardInterrupt:
        return time.perf_counter() - pressed[0]
    return None


def examine(name, call, *needs):
    """Print the row of a function; what it needs is made before."""
    if WORDS and not any(word in name for word in WORDS):
        return
    for make in needs:
        make()
    try:
        silence = find_silence(call)
    except Exception as error:
        print(f"{name:<28} {type(error).__name__}: {error}", flush=True)
        return
    took = interrupt(call, silence.delay + 0.02)
    ended = "    done" if took is None else f"{took:8.2f}"
    print(f"{name:<28}{silence.last - silence.first:8.2f}{silence.longest:8.2f}{ended}  {silence.between[0]} - "
          f"{silence.between[1]}", flush=True)


random = np.random.default_rng(3)
points = random.random((POINTS, 3), dtype=np.float32)
distances = np.linalg.norm(points - 0.5, axis=1)
noisy = distances + 0.05 * random.standard_normal(POINTS)
groups = random.integers(0, 3, POINTS)
fields = {"r": distances, "noisy": noisy, "vel": points - 0.5, "line": np.arange(POINTS, dtype=np.int32) // 100,
          "a": groups + 0.2 * random.standard_normal(POINTS), "b": (groups == 1) + 0.2 * random.standard_normal(POINTS)}
samples = uvol.Samples(points, fields)
sheet = random.standard_normal((POINTS, 3))
sheet = (sheet / np.linalg.norm(sheet, axis=1)[:, None]).astype(np.float32)
bare = uvol.Samples(sheet)
names = {ending: os.path.join(folder.name, "points." + ending) for ending in ("ply", "pcd", "csv", "vtp", "npz")}
kept = {}


def keep(name, make):
    """What several functions need, made when the first of them is examined."""
    if name not in kept:
        kept[name] = make()
    return kept[name]


def sphere():
    return keep("sphere", lambda: uvol.isosurface(samples, field="r", iso=0.45, outside="higher"))


def ball():
    """A surface of as many points as there are samples."""
    def make():
        return uvol.Samples(sheet, {**{f"normal_{axis}": sheet[:, k] for k, axis in enumerate("xyz")},
                                    "r": sheet[:, 0]})
    return keep("ball", make)


def mesh():
    return keep("mesh", lambda: sphere().mesh())


def clusters():
    return keep("clusters", lambda: uvol.cluster(samples, attributes=["a", "b"]))


def interpolator(model, **options):
    return keep(model, lambda: uvol.Interpolator(samples, field="r", model=model, **options))


def scene():
    path = os.path.join(folder.name, "scene.txt")
    if not os.path.exists(path):
        ball().save(os.path.join(folder.name, "ball.ply"))
        with open(path, "w") as file:
            file.write("cloud ball.ply\nlight directional 0 0 1\n")
    return path


print(f"{POINTS} points, {os.cpu_count()} processors\n{'function':<28}   whole silence  Ctrl-C  between", flush=True)
surface = dict(field="r", iso=0.3)
for name, options in {
        "isosurface": {}, "isosurface linear": dict(interpolation="linear"), "isosurface exact": dict(neighbors="exact"),
        "isosurface voronoi": dict(neighbors="voronoi"), "isosurface pca": dict(normals="pca"),
        "isosurface validate": dict(validate=3), "isosurface fill_gaps": dict(fill_gaps=True),
        "isosurface max_error": dict(max_error=0.01), "isosurface drop_bridged": dict(drop_bridged=True),
        "isosurface auto scale": dict(scale="auto"), "isosurface periodic": dict(periodic=[1, 1, 1]),
        "isosurface of |grad|": dict(field="|grad(r)|", iso=1.0), "isosurface mesh": dict(mesh=True),
        "isosurface mesh none": dict(mesh=dict(remesh="none")),
        "isosurface smooth": dict(field="noisy", smooth=True)}.items():
    examine(name, lambda progress: uvol.isosurface(uvol.Samples(points, fields), **{**surface, **options},
                                                   progress=progress))
examine("Surface.mesh", lambda progress: sphere().mesh(progress=progress), sphere)
examine("Surface.measure", lambda progress: sphere().measure(progress=progress), sphere)
examine("Mesh.measure", lambda progress: mesh().measure(progress=progress), mesh)
examine("Mesh.measure intersections", lambda progress: mesh().measure(find_intersections=True, progress=progress), mesh)
examine("Samples.compute", lambda progress: uvol.Samples(points, fields).compute("|curl(vel)|", progress=progress))
examine("Samples.compute formula", lambda progress: uvol.Samples(points, fields).compute("log10(r)", progress=progress))
examine("Samples.where", lambda progress: samples.where("sin(r) > 0.2 && |vel| < 3", progress=progress))
examine("Samples.take", lambda progress: samples.take(np.arange(POINTS)[::-1]))
examine("Samples.density", lambda progress: samples.density(progress=progress))
examine("Samples.outer_layer", lambda progress: samples.outer_layer(2.0, "r", progress=progress))
examine("info", lambda progress: uvol.info(samples, progress=progress))
queries = random.random((POINTS // 5, 3))
for model in ("fit", "natural", "laplace", "kriging", "sph", "shepard", "nearest", "auto"):
    examine(f"Interpolator {model}",
            lambda progress: uvol.Interpolator(samples, field="r", model=model, progress=progress))
    if model != "auto":
        examine(f"evaluate {model}", lambda progress: interpolator(model).evaluate(queries, progress=progress),
                lambda: interpolator(model))
examine("Interpolator.probe", lambda progress: interpolator("fit").probe(sphere(), progress=progress), sphere)
examine("Interpolator.slice", lambda progress: interpolator("fit").slice("z=0.5", progress=progress))
examine("Interpolator.grid", lambda progress: interpolator("nearest").grid(128, progress=progress))
for by in ("random", "blocks", "line"):
    examine(f"Interpolator.validate {by}", lambda progress: interpolator("fit").validate(3, by, progress=progress))
examine("level_set", lambda progress: uvol.level_set(samples, field="noisy", iso=0.3, progress=progress))
examine("level_set snapshots", lambda progress: uvol.level_set(samples, field="noisy", iso=0.3, mu=0.5, snapshots=10,
                                                               progress=progress))
examine("normals", lambda progress: uvol.normals(bare, progress=progress))
examine("splats", lambda progress: uvol.splats(bare, progress=progress))
examine("render", lambda progress: ball().render(progress=progress), ball)
examine("render no normals", lambda progress: bare.render(progress=progress))
examine("render large", lambda progress: ball().render(size=4000, color="r", silhouettes=True, progress=progress), ball)
examine("render sphere", lambda progress: sphere().render(progress=progress), sphere)
examine("raytrace", lambda progress: ball().raytrace(progress=progress), ball)
examine("raytrace occlusion", lambda progress: ball().raytrace(occlusion=16, reflect=0.5, progress=progress), ball)
examine("raytrace of a scene", lambda progress: uvol.raytrace(scene(), progress=progress))
examine("cluster", lambda progress: uvol.cluster(samples, attributes=["a", "b"], progress=progress))
for kind in ("membership", "distance", "hull", "hull-distance"):
    examine(f"Clusters.surface {kind}", lambda progress: clusters().surface(0, kind, progress=progress), clusters)
for method in ("star", "pca"):
    examine(f"project {method}", lambda progress: uvol.project(samples, attributes=["a", "b", "r", "noisy"],
                                                               labels=groups, method=method, progress=progress))
examine("voronoi", lambda progress: uvol.voronoi(samples, cells=256, progress=progress))
for ending, path in names.items():
    examine(f"write {ending}", lambda progress: samples.save(path, ascii=ending == "pcd", progress=progress))
    if os.path.exists(path):
        examine(f"read {ending}", lambda progress: uvol.read(path, progress=progress))
examine("Mesh.save", lambda progress: mesh().save(os.path.join(folder.name, "mesh.ply"), progress=progress), mesh)
examine("read_mesh", lambda progress: uvol.read_mesh(os.path.join(folder.name, "mesh.ply")))
