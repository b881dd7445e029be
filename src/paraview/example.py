# SPDX-License-Identifier: BSD-3-Clause
# Samples to a surface, directly and after a level set, and to splats, without a display.
# usage: pvbatch example.py PclUvol.so samples.vtp array isovalue surface.vtp
import sys

from paraview.simple import *

plugin, samples_file, array, isovalue, surface_file = sys.argv[1:]
LoadPlugin(plugin, remote=False, ns=globals())
samples = XMLPolyDataReader(FileName=[samples_file])


def describe(name, filter):
    filter.UpdatePipeline()
    print(name, filter.GetDataInformation().GetNumberOfPoints(), "points", flush=True)


surface = UvolIsosurface(Input=samples, Scalars=["POINTS", array])
surface.Isovalues = [float(isovalue)]
describe("surface", surface)

levelset = UvolLevelSet(Input=samples, Scalars=["POINTS", array])
levelset.Isovalue = float(isovalue)
describe("level set", levelset)
smooth = UvolIsosurface(Input=levelset, Scalars=["POINTS", "phi"], Isovalues=[0.0])
describe("smooth surface", smooth)

describe("splats", UvolSplats(Input=surface))

SaveData(surface_file, proxy=surface)
