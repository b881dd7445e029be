# SPDX-License-Identifier: BSD-3-Clause
# Types of the public names; tests/python/test_module.py holds them against the code.
import os
from collections.abc import Callable, Iterator, Mapping, Sequence
from typing import Any, NamedTuple

import numpy as np
import numpy.typing as npt

__version__: str

Fields = Mapping[str, npt.ArrayLike] | None
PointsLike = npt.ArrayLike | Any
SurfaceLike = PointsLike | tuple[PointsLike, npt.ArrayLike]
MapLike = str | Sequence[Any] | None
Progress = bool | Callable[[str, float], object] | None

class _Points:
    records: np.ndarray
    origin: np.ndarray
    box: np.ndarray
    map: Map | None
    points: np.ndarray
    labels: dict[str, list[str]]
    def __len__(self) -> int: ...
    def __iter__(self) -> Iterator[str]: ...
    def __contains__(self, name: object) -> bool: ...
    def __getitem__(self, name: str) -> np.ndarray: ...
    def keys(self) -> list[str]: ...
    def save(self, path: str | os.PathLike[str], ascii: bool = ..., progress: Progress = ...) -> None: ...
    def to_vtk(self) -> Any: ...
    def to_pyvista(self) -> Any: ...
    def to_open3d(self) -> Any: ...
    def to_trimesh(self) -> Any: ...
    def to_dataframe(self) -> Any: ...

class _Drawable:
    def render(self, *, color: str = ..., colormap: str = ..., range: tuple[float, float] | None = ..., log: bool = ..., bar: bool = ..., size: int | Sequence[int] = ..., view: str = ..., eye: npt.ArrayLike | None = ..., at: npt.ArrayLike | None = ..., up: npt.ArrayLike | None = ..., fov: float = ..., parallel: bool = ..., zoom: float = ..., background: str | Sequence[float] = ..., surface_color: npt.ArrayLike | None = ..., exaggerate: npt.ArrayLike | None = ..., opacity: float | Sequence[float] | None = ..., lights: npt.ArrayLike | None = ..., material: dict[str, float] | None = ..., supersample: int = ..., culling: bool = ..., footprints: bool = ..., silhouettes: bool = ..., features: bool = ..., thickness: int = ..., line_color: npt.ArrayLike | None = ..., ticks: bool = ..., box: bool = ..., triad: bool = ..., scale_bar: bool = ..., unit: str = ..., title: str = ..., views: Sequence[str] = ..., passes: dict[str, Any] | None = ..., threads: int = ..., progress: Progress = ...) -> Picture: ...
    def raytrace(self, *, color: str = ..., colormap: str = ..., range: tuple[float, float] | None = ..., log: bool = ..., bar: bool = ..., size: int | Sequence[int] = ..., view: str = ..., eye: npt.ArrayLike | None = ..., at: npt.ArrayLike | None = ..., up: npt.ArrayLike | None = ..., fov: float = ..., parallel: bool = ..., zoom: float = ..., background: str | Sequence[float] = ..., surface_color: npt.ArrayLike | None = ..., exaggerate: npt.ArrayLike | None = ..., lights: npt.ArrayLike | None = ..., material: dict[str, float] | None = ..., supersample: int = ..., depth: int = ..., shadows: bool = ..., light_samples: int = ..., occlusion: int = ..., occlusion_distance: float = ..., reflect: float = ..., transparent: float = ..., index: float = ..., culling: bool = ..., splats: dict[str, Any] | None = ..., ticks: bool = ..., box: bool = ..., triad: bool = ..., scale_bar: bool = ..., unit: str = ..., title: str = ..., views: Sequence[str] = ..., threads: int = ..., progress: Progress = ...) -> Picture: ...
    def orbit(self, frames: int, *, raytraced: bool = ..., **options: Any) -> Iterator[Picture]: ...
    def save_page(self, path: str | os.PathLike[str], *, color: str = ..., colormap: str = ..., range: tuple[float, float] | None = ..., log: bool = ..., bar: bool = ..., view: str = ..., eye: npt.ArrayLike | None = ..., at: npt.ArrayLike | None = ..., up: npt.ArrayLike | None = ..., fov: float = ..., parallel: bool = ..., zoom: float = ..., background: str | Sequence[float] = ..., surface_color: npt.ArrayLike | None = ..., exaggerate: npt.ArrayLike | None = ..., lights: npt.ArrayLike | None = ..., material: dict[str, float] | None = ..., threads: int = ..., progress: Progress = ...) -> dict[str, Any]: ...

class Answers:
    values: np.ndarray
    errors: np.ndarray | None
    gradients: np.ndarray | None
    support: np.ndarray
    report: dict[str, Any]
    parameters: dict[str, Any]

class Clusters:
    labels: np.ndarray
    probabilities: np.ndarray
    tree: dict[str, np.ndarray]
    samples: Samples
    report: dict[str, Any]
    parameters: dict[str, Any]
    def __len__(self) -> int: ...
    def take(self, cluster: int) -> Samples: ...
    def surface(self, cluster: int, kind: str = ..., *, probability: str = ..., smoothing_length: str = ..., cells: int = ..., distance: float = ..., scale: npt.ArrayLike | str = ..., rotate: Sequence[float] | None = ..., threads: int = ..., progress: Progress = ...) -> Samples | tuple[Samples, np.ndarray]: ...

class Comparison:
    forth: Distances
    back: Distances
    largest: float
    surface: Samples

class Distances:
    mean: float
    root_mean_square: float
    percentile_99_9: float
    largest: float
    farthest: np.ndarray
    fields: dict[str, FieldDifference]
    at_vertices: np.ndarray

class DivergedError(ArithmeticError):
    code: str | None
    values: dict[str, float | str]

class Extractor:
    samples: Samples
    parameters: dict[str, Any]
    def __init__(self, points: PointsLike, fields: Fields = ...) -> None: ...
    def extract(self, *, iso: float | Sequence[float], field: str = ..., scale: npt.ArrayLike | str | None = ..., rotate: Sequence[float] | None = ..., outside: str = ..., interpolation: str = ..., neighbors: str = ..., voronoi_cells: int = ..., criterion: str = ..., smooth: bool = ..., mu: float | None = ..., level_set: dict[str, Any] | None = ..., normals: str = ..., normal_neighbors: int = ..., max_error: float | str | None = ..., drop_bridged: bool = ..., fill_gaps: bool = ..., outside_value: float | None = ..., validate: int = ..., validate_by: str = ..., mesh: bool | dict[str, Any] | None = ..., periodic: Sequence[float] | str | None = ..., periodic_mesh: str = ..., threads: int = ..., progress: Progress = ...) -> Surface: ...

class FieldDifference(NamedTuple):
    mean: float
    largest: float

class FieldError(KeyError):
    code: str | None
    values: dict[str, float | str]

class FieldMeasures(NamedTuple):
    mean: float
    integral: Figure
    sum: float

class Figure(NamedTuple):
    value: float
    error: float

class Interpolator:
    samples: Samples
    fields: list[str]
    parameters: dict[str, Any]
    variograms: dict[str, dict[str, Any]]
    def __init__(self, points: PointsLike, fields: Fields = ..., *, field: str | Sequence[str] = ..., model: str = ..., extrapolate: bool = ..., cell_mask: bool = ..., gradients: bool = ..., errors: bool = ..., scale: npt.ArrayLike | str = ..., rotate: Sequence[float] | None = ..., kriging: dict[str, Any] | None = ..., sph: dict[str, Any] | None = ..., shepard: dict[str, Any] | None = ..., periodic: Sequence[float] | str | None = ..., threads: int = ..., progress: Progress = ...) -> None: ...
    def evaluate(self, queries: PointsLike, threads: int | None = ..., progress: Progress = ...) -> Answers: ...
    def __call__(self, queries: PointsLike, threads: int | None = ..., progress: Progress = ...) -> tuple[np.ndarray, np.ndarray | None]: ...
    def probe(self, points: PointsLike, threads: int | None = ..., progress: Progress = ...) -> Samples: ...
    def validate(self, folds: int = ..., by: str = ..., threads: int | None = ..., progress: Progress = ...) -> dict[str, dict[str, float]]: ...
    def line(self, start: npt.ArrayLike, end: npt.ArrayLike, n: int = ..., threads: int | None = ..., progress: Progress = ...) -> Lattice: ...
    def slice(self, plane: str | tuple[npt.ArrayLike, npt.ArrayLike], size: int | Sequence[int] = ..., box: tuple[npt.ArrayLike, npt.ArrayLike] | None = ..., threads: int | None = ..., progress: Progress = ...) -> Lattice: ...
    def grid(self, n: int | Sequence[int] = ..., box: tuple[npt.ArrayLike, npt.ArrayLike] | None = ..., threads: int | None = ..., progress: Progress = ...) -> Lattice: ...

class Map(NamedTuple):
    longitude: float
    latitude: float
    unit: str = ...
    def to_map(self, longitude: npt.ArrayLike, latitude: npt.ArrayLike) -> tuple[np.ndarray, np.ndarray]: ...
    def to_globe(self, x: npt.ArrayLike, y: npt.ArrayLike) -> tuple[np.ndarray, np.ndarray]: ...

class Lattice:
    shape: tuple[int, ...]
    points: np.ndarray
    report: dict[str, Any]
    parameters: dict[str, Any]
    def keys(self) -> list[str]: ...
    def to_xarray(self) -> Any: ...
    def save(self, path: str | os.PathLike[str]) -> None: ...
    def render(self, field: str = ..., *, contours: Sequence[float] = ..., colormap: str = ..., range: Sequence[float] | None = ..., log: bool = ..., samples: float | None = ..., label: str = ..., unit: str = ...) -> Picture: ...
    def __getitem__(self, name: str) -> np.ndarray: ...
    def __iter__(self) -> Iterator[str]: ...

class Measures(PieceMeasures):
    isovalues: list[PieceMeasures]
    pieces: list[PieceMeasures]
    vertex_areas: np.ndarray
    piece_of: np.ndarray
    report: dict[str, Any]
    parameters: dict[str, Any]

class Mesh(Surface):
    triangles: np.ndarray
    vertices: np.ndarray
    def measure(self, curved: bool = ..., find_intersections: bool = ..., threads: int = ..., progress: Progress = ..., *, drop_uncertain: bool = ...) -> Measures: ...
    def save(self, path: str | os.PathLike[str], ascii: bool = ..., progress: Progress = ...) -> Any: ...

class Picture:
    pixels: np.ndarray
    field: str
    range: tuple[float, float]
    report: dict[str, Any]
    parameters: dict[str, Any]
    def save(self, path: str | os.PathLike[str], dpi: float = ...) -> None: ...

class PieceMeasures:
    isovalue: float
    vertices: int
    triangles: int
    rims: int
    genus: int | None
    samples: int
    samples_beyond: int | None
    sums_beyond: dict[str, float]
    area: Figure
    cap_area: float
    volume: Figure
    capped_volume: float
    centroid: np.ndarray
    axes: np.ndarray
    half_axes: np.ndarray
    low: np.ndarray
    high: np.ndarray
    on_surface: dict[str, FieldMeasures]
    inside: dict[str, FieldMeasures]

class Projection:
    places: np.ndarray
    sources: np.ndarray
    labels: np.ndarray
    map: dict[str, Any]
    report: dict[str, Any]
    parameters: dict[str, Any]
    def render(self, view: str = ..., size: int | Sequence[int] = ...) -> Picture: ...

class ResultWarning(UserWarning):
    code: str
    values: dict[str, float | str]
    def __init__(self, text: str = ..., code: str = ..., values: dict[str, float | str] | None = ...) -> None: ...

class Samples(_Drawable, _Points):
    report: dict[str, Any]
    parameters: dict[str, Any]
    snapshots: list[tuple[int, Samples]]
    def __init__(self, points: PointsLike, fields: Fields = ...) -> None: ...
    @classmethod
    def from_dataframe(cls, frame: Any, points: Sequence[str] = ..., fields: Sequence[str] | None = ...) -> Samples: ...
    def compute(self, expression: str, threads: int = ..., progress: Progress = ...) -> Samples: ...
    def density(self, length: float = ..., threads: int = ..., progress: Progress = ...) -> Samples: ...
    def sampling(self, scale: npt.ArrayLike | str = ..., rotate: Sequence[float] | None = ..., threads: int = ..., progress: Progress = ...) -> Samples: ...
    def outer_layer(self, value: float, field: str = ..., threads: int = ..., progress: Progress = ...) -> Samples: ...
    def where(self, expression: str, threads: int = ..., progress: Progress = ...) -> Samples: ...
    def take(self, indices: npt.ArrayLike | slice) -> Samples: ...

class Surface(_Drawable, _Points):
    report: dict[str, Any]
    parameters: dict[str, Any]
    normals: np.ndarray
    def mesh(self, remesh: str = ..., edge_length: float = ..., open: bool = ..., drop_pieces: int = ..., threads: int = ..., progress: Progress = ...) -> Mesh: ...
    def measure(self, curved: bool = ..., find_intersections: bool = ..., threads: int = ..., progress: Progress = ..., *, drop_uncertain: bool = ...) -> Measures: ...

class VoronoiGrid:
    site: np.ndarray
    distance: np.ndarray
    origin: np.ndarray
    spacing: np.ndarray
    report: dict[str, Any]
    parameters: dict[str, Any]

def cluster(points: PointsLike, fields: Fields = ..., *, attributes: Sequence[str] = ..., labels: npt.ArrayLike | None = ..., standardized: bool = ..., k: int = ..., min_size: int = ..., cut: float = ..., single: bool = ..., threads: int = ..., progress: Progress = ...) -> Clusters: ...

def compare(a: SurfaceLike, b: SurfaceLike, *, threads: int = ..., progress: Progress = ...) -> Comparison: ...

def empty(count: int, fields: Mapping[str, npt.DTypeLike] | None = ...) -> np.ndarray: ...

def from_vtk(dataset: Any) -> Samples: ...

def info(points: PointsLike, fields: Fields = ..., *, scale: npt.ArrayLike | str = ..., rotate: Sequence[float] | None = ..., threads: int = ..., progress: Progress = ...) -> dict[str, Any]: ...

def isosurface(points: PointsLike, fields: Fields = ..., *, iso: float | Sequence[float], field: str = ..., scale: npt.ArrayLike | str | None = ..., rotate: Sequence[float] | None = ..., outside: str = ..., interpolation: str = ..., neighbors: str = ..., voronoi_cells: int = ..., criterion: str = ..., smooth: bool = ..., mu: float | None = ..., level_set: dict[str, Any] | None = ..., normals: str = ..., normal_neighbors: int = ..., max_error: float | str | None = ..., drop_bridged: bool = ..., fill_gaps: bool = ..., outside_value: float | None = ..., validate: int = ..., validate_by: str = ..., mesh: bool | dict[str, Any] | None = ..., periodic: Sequence[float] | str | None = ..., periodic_mesh: str = ..., threads: int = ..., progress: Progress = ...) -> Surface: ...

def level_set(points: PointsLike, fields: Fields = ..., *, iso: float, field: str = ..., scale: npt.ArrayLike | str = ..., rotate: Sequence[float] | None = ..., start: str | Mapping[str, Any] | None = ..., snapshots: int = ..., periodic: Sequence[float] | str | None = ..., mu: float | None = ..., scheme: str = ..., flow: str = ..., bound: str = ..., integration: str = ..., reinitialization: str = ..., outside: str = ..., k: int = ..., max_steps: int = ..., tolerance: float = ..., band_width: float = ..., threads: int = ..., progress: Progress = ...) -> Samples: ...

def measure(surface: SurfaceLike, *, samples: PointsLike | None = ..., curved: bool = ..., find_intersections: bool = ..., drop_uncertain: bool = ..., threads: int = ..., progress: Progress = ...) -> Measures: ...

def normals(points: PointsLike, fields: Fields = ..., *, scale: npt.ArrayLike | str = ..., rotate: Sequence[float] | None = ..., view_point: npt.ArrayLike | None = ..., k: int = ..., threads: int = ..., progress: Progress = ...) -> Samples: ...

def project(points: PointsLike, fields: Fields = ..., *, attributes: Sequence[str], labels: npt.ArrayLike | None = ..., standardized: bool = ..., method: str = ..., threads: int = ..., progress: Progress = ...) -> Projection: ...

def raytrace(scene: str | os.PathLike[str], *, folder: str | os.PathLike[str] = ..., size: int | Sequence[int] | None = ..., view: str | None = ..., eye: npt.ArrayLike | None = ..., at: npt.ArrayLike | None = ..., up: npt.ArrayLike | None = ..., fov: float | None = ..., parallel: bool = ..., zoom: float = ..., turn: float = ..., background: str | Sequence[float] | None = ..., lights: npt.ArrayLike | None = ..., supersample: int | None = ..., depth: int | None = ..., shadows: bool | None = ..., light_samples: int | None = ..., occlusion: int | None = ..., occlusion_distance: float | None = ..., culling: bool | None = ..., threads: int = ..., progress: Progress = ...) -> Picture: ...

def read(path: str | os.PathLike[str], xyz: Sequence[str] = ..., particles: str = ..., cells: bool = ..., progress: Progress = ..., map: MapLike = ...) -> Samples: ...

def read_mesh(path: str | os.PathLike[str], map: MapLike = ...) -> tuple[Samples, np.ndarray]: ...

def read_volume(path: str | os.PathLike[str]) -> tuple[np.ndarray, tuple[float, float, float], tuple[float, float, float], str]: ...

def splats(points: PointsLike, fields: Fields = ..., *, delta: float = ..., delta_is_length: bool = ..., overlap: float = ..., gaussians: bool = ..., color: str = ..., threads: int = ..., progress: Progress = ...) -> Samples: ...

def voronoi(points: PointsLike, fields: Fields = ..., *, cells: int | Sequence[int] = ..., margin: int = ..., threads: int = ..., progress: Progress = ...) -> VoronoiGrid: ...

def write(path: str | os.PathLike[str], points: PointsLike, fields: Fields = ..., triangles: npt.ArrayLike | None = ..., ascii: bool = ..., progress: Progress = ...) -> None: ...
