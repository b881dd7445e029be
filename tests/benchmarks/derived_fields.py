# SPDX-License-Identifier: BSD-3-Clause
"""Compare derived fields with VTK's gradient filter on the cells of a file.

python3 derived_fields.py BIN FILE EXPRESSION..., with BIN the folder of uvol_probe, and Q(F) or |grad(F)| of point
data F. Nodes without a derivative have the one of the nearest node that has one.
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


def by_cells(path, expression):
    """The same derivative from the cells."""
    reader = READERS[os.path.splitext(path)[1]]()
    reader.SetFileName(path)
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


def main():
    tools, path = sys.argv[1:3]
    for expression in sys.argv[3:]:
        cells, samples = by_cells(path, expression), by_samples(tools, path, expression)
        known = numpy.isfinite(samples)
        correlation = numpy.corrcoef(clipped(cells[known]), clipped(samples[known]))[0, 1]
        largest = numpy.abs(cells).max()
        beyond = (numpy.abs(samples[known]) > 10 * largest).sum()
        print(f"{os.path.basename(path)} {expression}: correlation {correlation:.3f}, samples "
              f"{samples[known].min():.3g} to {samples[known].max():.3g}, cells {cells.min():.3g} to {cells.max():.3g}, "
              f"{beyond} beyond 10 times the largest")


if __name__ == "__main__":
    main()
