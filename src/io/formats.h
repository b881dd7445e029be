// SPDX-License-Identifier: BSD-3-Clause
// The file formats behind loadDataset and saveDataset.
#pragma once

#include <pcl_uvol/common/mesh.h>
#include <pcl_uvol/io/dataset.h>
#include <pcl_uvol/io/memory_need.h>

#include <optional>
#include <string>
#include <vector>

namespace pcl_uvol {
namespace io {

Dataset
readPcd(const std::string& path);

Dataset
readPly(const std::string& path);

/** What the headers promise; nothing where they are not whole, or promise more than the
 * file holds: reading tells what is wrong with them. @{ */
std::optional<PromisedCloud>
promisePcd(const std::string& path);

std::optional<PromisedCloud>
promisePly(const std::string& path);
/** @} */

/** \brief Text with a header line; the separator is found in it. */
Dataset
readText(const std::string& path, const LoadOptions& options);

/** \brief .vtk, .vtp, .vtu or .vts. \param ending in lower case, with its dot */
Dataset
readVtk(const std::string& path, const std::string& ending);

/** Writers write to `file`, which exists; errors call it `path`. @{ */
void
writePcd(const std::string& file,
         const std::string& path,
         const Dataset& dataset,
         const SaveOptions& options);

/** \brief \throws IOError if PLY lacks the type of a field */
void
checkPlyFields(const std::string& path, const std::vector<pcl::PCLPointField>& fields);

/** \brief \param triangles faces over the points; may be empty */
void
writePly(const std::string& file,
         const std::string& path,
         const Dataset& dataset,
         const std::vector<Triangle>& triangles,
         const SaveOptions& options);

void
writeCsv(const std::string& file, const std::string& path, const Dataset& dataset);

void
writeVtp(const std::string& file, const std::string& path, const Dataset& dataset);
/** @} */

} // namespace io
} // namespace pcl_uvol
