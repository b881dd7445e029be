# SPDX-License-Identifier: BSD-3-Clause
"""Compare derived fields with VTK's gradient filter on the cells of a file.

python3 derived_fields.py BIN FILE EXPRESSION..., with BIN the folder of uvol_probe, and Q(F) or |grad(F)| of point
data F. Nodes without a derivative have the one of the nearest node that has one. Correlations are of all nodes, and
of those inside: at the border of the cells differences are one-sided, and those of first and of second order disagree.
"""
import csv
import os
import subprocess
import sys
import tempfile

import numpy
import vtk
from vtk.util.numpy_support import vtk_to_numpy

READERS = {".vts": vtk.vtkXMLStructuredGridReader, ".vtu": vtk.vtkXMLUnstructuredGridReader}


def read(path):
    reader = READERS[os.path.splitext(path)[1]]()
    reader.SetFileName(path)
    return reader


def at_border(path):
    """Which nodes are on the border of the cells."""
    reader = read(path)
    numbers = vtk.vtkIdFilter()
    numbers.SetInputConnection(reader.GetOutputPort())
    numbers.SetPointIdsArrayName("node")
    border = vtk.vtkDataSetSurfaceFilter()
    border.SetInputConnection(numbers.GetOutputPort())
    border.Update()
    is_at_border = numpy.zeros(reader.GetOutput().GetNumberOfPoints(), bool)
    is_at_border[vtk_to_numpy(border.GetOutput().GetPointData().GetArray("node"))] = True
    return is_at_border


def by_cells(path, expression):
    """The same derivative from the cells."""
    reader = read(path)
    gradient = vtk.vtkGradientFilter()
    gradient.SetInputConnection(reader.GetOutputPort())
    gradient.SetInputArrayToProcess(0, 0, 0, 0, expression[expression.index("(") + 1:expression.index(")")].strip("|"))
    gradient.SetResultArrayName("gradient")
    gradient.Update()
    values = vtk_to_numpy(gradient.GetOutput().GetPointData().GetArray("gradient")).astype(float)
    if expression.startswith("|grad("):
        return numpy.linalg.norm(values, axis=1)
    jacobian = values.reshape(-1, 3, 3)
    return -0.5 * numpy.einsum("nij,nji->n", jacobian, jacobian)


def by_samples(tools, path, expression):
    """What an expression gives at the nodes."""
    with tempfile.TemporaryDirectory() as folder:
        table = os.path.join(folder, "out.csv")
        subprocess.run([os.path.join(tools, "uvol_probe"), path, table, "-points", path, "-model", "nearest", "-field",
                        expression], check=True, stdout=subprocess.DEVNULL)
        with open(table, newline="") as file:
            return numpy.array([float(row[expression] or "nan") for row in csv.DictReader(file)])


def clipped(values):
    return numpy.clip(values, *numpy.percentile(values, [1, 99]))


def correlation(cells, samples):
    return numpy.corrcoef(clipped(cells), clipped(samples))[0, 1] if cells.size > 1 else numpy.nan


def main():
    tools, path = sys.argv[1:3]
    is_at_border = at_border(path)
    for expression in sys.argv[3:]:
        cells, samples = by_cells(path, expression), by_samples(tools, path, expression)
        known = numpy.isfinite(samples)
        inside = known & ~is_at_border
        largest = numpy.abs(cells).max()
        beyond = (numpy.abs(samples[known]) > 10 * largest).sum()
        print(f"{os.path.basename(path)} {expression}: correlation {correlation(cells[known], samples[known]):.3f}, of "
              f"{inside.sum()} nodes inside {correlation(cells[inside], samples[inside]):.3f}, samples "
              f"{samples[known].min():.3g} to {samples[known].max():.3g}, cells {cells.min():.3g} to {cells.max():.3g}, "
              f"{beyond} beyond 10 times the largest")


if __name__ == "__main__":
    main()
