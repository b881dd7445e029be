# SPDX-License-Identifier: BSD-3-Clause
"""Compare derived fields, and VTK's gradient filter on the cells, with the truth on the nodes of files.

python3 derived_fields_truth.py BIN FILE..., with BIN the folder of uvol_probe. The fields are sums of 12 random waves
whose length is 4, 8 and 16 median edges, and layers at z = 0 (tanh(z / thickness) along the wall, its square across).
Correlations are of values clipped at their 1st and 99th percentiles: of all nodes, and of those inside.
"""
import os
import sys
import tempfile

import numpy
import vtk
from vtk.util.numpy_support import numpy_to_vtk, vtk_to_numpy

import derived_fields

WRITERS = {".vts": vtk.vtkXMLStructuredGridWriter, ".vtu": vtk.vtkXMLUnstructuredGridWriter}
EXPRESSIONS = ["|grad(f)|", "Q(v)"]


def median_edge(grid):
    edges = vtk.vtkExtractEdges()
    edges.SetInputData(grid)
    edges.Update()
    places = vtk_to_numpy(edges.GetOutput().GetPoints().GetData()).astype(float)
    ends = places[vtk_to_numpy(edges.GetOutput().GetLines().GetConnectivityArray()).reshape(-1, 2)]
    return numpy.median(numpy.linalg.norm(ends[:, 0] - ends[:, 1], axis=1))


def make_waves(length):
    random = numpy.random.default_rng(1)
    vectors = random.normal(size=(12, 3))
    vectors *= 2.0 * numpy.pi / length / numpy.linalg.norm(vectors, axis=1)[:, None]
    amplitudes, phases = random.normal(size=(12, 3)), random.uniform(0.0, 2.0 * numpy.pi, 12)
    return lambda places: numpy.sin(places @ vectors.T + phases) @ amplitudes


def make_layer(thickness):
    waves = make_waves(20.0 * thickness)

    def layer(places):
        change, along = waves(places) / 3.0, numpy.tanh(places[:, 2] / thickness)
        return numpy.stack([along * (1.0 + 0.5 * change[:, 0]), along * 0.3 * change[:, 1],
                            along**2 * 0.3 * change[:, 2]], 1)
    return layer


def list_fields(path, grid):
    fields = {f"waves of {n} edges": make_waves(n * median_edge(grid)) for n in (4, 8, 16)}
    if os.path.basename(path) == "bluntfin.vts":
        fields["layer of 0.1"] = make_layer(0.1)
    return fields


def jacobian(field, places):
    """Derivatives of a field by complex steps, which have no error but rounding."""
    step = 1e-20
    columns = []
    for axis in range(3):
        shifted = places.astype(complex)
        shifted[:, axis] += 1j * step
        columns.append(field(shifted).imag / step)
    return numpy.stack(columns, 2)


def write(grid, values, path):
    copy = grid.NewInstance()
    copy.CopyStructure(grid)
    for name, array in (("v", values), ("f", values[:, 0])):
        column = numpy_to_vtk(numpy.ascontiguousarray(array), deep=1)
        column.SetName(name)
        copy.GetPointData().AddArray(column)
    writer = WRITERS[os.path.splitext(path)[1]]()
    writer.SetFileName(path)
    writer.SetInputData(copy)
    writer.Write()


def main():
    tools = sys.argv[1]
    names = [f"{quantity}: {pair}" for quantity in ("\\|grad f\\|", "Q") for pair in ("ours", "VTK's", "ours and VTK's")]
    print(f"| file, field | {' | '.join(names)} |\n|{'---|' * 7}")
    for path in sys.argv[2:]:
        reader = derived_fields.read(path)
        reader.Update()
        grid = reader.GetOutput()
        inside = ~derived_fields.at_border(path)
        places = vtk_to_numpy(grid.GetPoints().GetData()).astype(float)
        for name, field in list_fields(path, grid).items():
            exact = jacobian(field, places)
            truths = [numpy.linalg.norm(exact[:, 0], axis=1), -0.5 * numpy.einsum("nij,nji->n", exact, exact)]
            cells = []
            with tempfile.TemporaryDirectory() as folder:
                copy = os.path.join(folder, os.path.basename(path))
                write(grid, field(places), copy)
                for expression, truth in zip(EXPRESSIONS, truths):
                    theirs = derived_fields.by_cells(copy, expression)
                    ours = derived_fields.by_samples(tools, copy, expression)
                    known = numpy.isfinite(ours)
                    for a, b in ((ours, truth), (theirs, truth), (ours, theirs)):
                        cells.append(" (".join(f"{derived_fields.correlation(a[nodes], b[nodes]):.3f}"
                                               for nodes in (known, known & inside)) + ")")
            print(f"| {os.path.basename(path)}, {name} | {' | '.join(cells)} |", flush=True)


if __name__ == "__main__":
    main()
