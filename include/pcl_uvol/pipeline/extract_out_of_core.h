// SPDX-License-Identifier: BSD-3-Clause
// Isosurface extraction from a file that need not fit into memory.
#pragma once

#include <pcl_uvol/common/export.h>
#include <pcl_uvol/common/report.h>
#include <pcl_uvol/io/point_stream.h>
#include <pcl_uvol/isosurface/iso_edges.h>
#include <pcl_uvol/isosurface/piece_isopoints.h>

#include <pcl/PCLPointCloud2.h>
#include <pcl/point_cloud.h>

#include <cstdint>
#include <string>

namespace pcl_uvol {

/** \brief Where samples go that memory does not hold. */
struct OutOfCoreSettings {
  std::uint64_t max_memory = 0;     ///< bytes that the process may take
  std::string scratch_folder = "."; ///< 24 bytes per sample lie there at a time
  unsigned threads = 0;             ///< 0 = all cores
};

/** \brief What IsosurfaceExtraction gives, with the samples it rests on. */
struct PCL_UVOL_EXPORTS OutOfCoreIsosurface {
  pcl::PointCloud<PointIso> isopoints;
  IsoEdges edges;              ///< their ends as indices into samples
  pcl::PCLPointCloud2 samples; ///< the points of the file that edges end at
};

/** \brief The least bound in bytes that extractOutOfCore() takes for that many samples
 * and isovalues. */
PCL_UVOL_EXPORTS std::uint64_t
leastOutOfCoreMemory(std::uint64_t samples, std::size_t isovalues);

/** \brief Extract the isosurface of a field of a stream of points, within a bound of
 * memory.
 *
 * The points go to scratch files, are parted into pieces by the first levels of the
 * kd-tree (see Decomposition) and taken through memory piece by piece, to be ordered;
 * isopoints are then found in those blocks of the pieces that the surface crosses, with
 * what they need of the samples around them. They are those of IsosurfaceExtraction,
 * byte for byte and in that order. Scratch files have no names, so that none is left
 * behind; on a file system that cannot shorten files at their beginning they take twice
 * the room. The bound holds for the whole process as long as the isosurface itself is
 * small beside it; pieces are made that small.
 * \param report gets the counts and times of IsosurfaceExtraction, the counts "pieces"
 * and "scratch_bytes" (isopoints apart), and the times of "scratch", "decomposition"
 * and "exchange"
 * \throws InvalidArgument for an unknown field, a bound that is too small, and without
 * a usable sample \throws IOError for a stream that breaks off and a scratch folder
 * that is full or takes no files */
PCL_UVOL_EXPORTS OutOfCoreIsosurface
extractOutOfCore(PointStream& points,
                 const IsosurfaceSettings& settings,
                 const OutOfCoreSettings& out_of_core,
                 Report& report);

} // namespace pcl_uvol
