// SPDX-License-Identifier: BSD-3-Clause
// What is fed with random bytes: the readers and the stages. Each target takes any
// bytes, and throws where the library breaks a promise.
#pragma once

#include <cstddef>
#include <cstdint>
#include <string>
#include <vector>

namespace uvol_fuzz {

/** What the bytes become; tools/fuzz.sh takes these words. */
enum class Group { readers, texts, stages };

struct Target {
  const char* name; ///< also of its folder of files to start with
  Group group;
  void (*run)(const std::uint8_t* bytes, std::size_t size);
};

const std::vector<Target>&
listTargets();

/** Targets that read bytes as a file of some ending. @{ */
void
readPcd(const std::uint8_t* bytes, std::size_t size);
void
readPly(const std::uint8_t* bytes, std::size_t size);
void
readText(const std::uint8_t* bytes, std::size_t size);
void
readLegacyVtk(const std::uint8_t* bytes, std::size_t size);
void
readXmlVtk(const std::uint8_t* bytes, std::size_t size);
void
readNrrd(const std::uint8_t* bytes, std::size_t size);
void
readMetaImage(const std::uint8_t* bytes, std::size_t size);
void
readGadget(const std::uint8_t* bytes, std::size_t size);
void
readHdf5(const std::uint8_t* bytes, std::size_t size);
void
readVtkHdf(const std::uint8_t* bytes, std::size_t size);
/** Not there where the build lacks the library of NetCDF. */
void
readNetcdf(const std::uint8_t* bytes, std::size_t size);
void
readBgeo(const std::uint8_t* bytes, std::size_t size);
void
readLas(const std::uint8_t* bytes, std::size_t size);
void
readNpy(const std::uint8_t* bytes, std::size_t size);
void
readNpz(const std::uint8_t* bytes, std::size_t size);
void
readObj(const std::uint8_t* bytes, std::size_t size);
void
readOff(const std::uint8_t* bytes, std::size_t size);
void
readStl(const std::uint8_t* bytes, std::size_t size);
/** @} */

/** Targets that read bytes as a file that names others, or has others beside or within
 * it. @{ */
void
readScene(const std::uint8_t* bytes, std::size_t size);
void
readFileList(const std::uint8_t* bytes, std::size_t size);
void
readPlot3d(const std::uint8_t* bytes, std::size_t size);
void
readPacked(const std::uint8_t* bytes, std::size_t size);
/** @} */

/** Targets that make texts of bytes. @{ */
void
readParameters(const std::uint8_t* bytes, std::size_t size);
void
readExpression(const std::uint8_t* bytes, std::size_t size);
/** @} */

/** Targets that make points, values and parameters of bytes. @{ */
void
extractIsosurface(const std::uint8_t* bytes, std::size_t size);
void
meshSurface(const std::uint8_t* bytes, std::size_t size);
void
evolveLevelSet(const std::uint8_t* bytes, std::size_t size);
void
interpolateFields(const std::uint8_t* bytes, std::size_t size);
void
clusterAttributes(const std::uint8_t* bytes, std::size_t size);
void
makeSplats(const std::uint8_t* bytes, std::size_t size);
void
traceRays(const std::uint8_t* bytes, std::size_t size);
void
renderPoints(const std::uint8_t* bytes, std::size_t size);
void
fillGaps(const std::uint8_t* bytes, std::size_t size);
/** Samples in a box that repeats. */
void
extractInBox(const std::uint8_t* bytes, std::size_t size);
void
estimateNormals(const std::uint8_t* bytes, std::size_t size);
void
measureSurface(const std::uint8_t* bytes, std::size_t size);
/** A discrete Voronoi diagram. */
void
divideSpace(const std::uint8_t* bytes, std::size_t size);
/** The hull of a cluster. */
void
wrapCluster(const std::uint8_t* bytes, std::size_t size);
/** The convex hull of samples. */
void
wrapSamples(const std::uint8_t* bytes, std::size_t size);
/** Star coordinates. */
void
projectAttributes(const std::uint8_t* bytes, std::size_t size);
/** @} */

} // namespace uvol_fuzz
