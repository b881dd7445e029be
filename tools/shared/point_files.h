// SPDX-License-Identifier: BSD-3-Clause
// How tools read and write points.
#pragma once

#include "shared/options.h"
#include <pcl_uvol/common/stage.h>
#include <pcl_uvol/expressions/derived_fields.h>
#include <pcl_uvol/io/dataset.h>

#include <array>
#include <cstddef>
#include <cstdint>
#include <string>
#include <vector>

namespace uvol_tools {

/** \brief What is read of a file: -where, the points for which that holds, -xyz, the
 * columns of a text file that hold the coordinates, -map, the map that longitude and
 * latitude are put on, -particles, the kind that is read of a snapshot, and -cells. */
class InputOptions {
public:
  void
  declare(Options& options);

  /** \brief How files are read; -scale, where a tool has it, makes up for axes of
   * several units.
   * \throws UsageError unless three columns are named, or none */
  pcl_uvol::LoadOptions
  makeLoadOptions() const;

  /** \brief For loadPoints(); "": all points. */
  const std::string&
  getWhere() const
  {
    return where_;
  }

private:
  const Options* options_ = nullptr; ///< of the tool
  std::string where_, xyz_, map_, particles_;
  bool cells_ = false;
};

/** \brief Declares -field.
 * \param field becomes "", which stands for the only candidate */
void
declareField(Options& options, std::string& field);

/** \brief The options by which a file comes onto the map of the command: that of the
 * first file that is on one. All files of a command, and of a series, have one
 * coordinate system so. */
pcl_uvol::LoadOptions
onMapOfCommand(pcl_uvol::LoadOptions options);

/** \brief Take the map of a file that was read for the files to come. It is warned of a
 * file that chose its map when the files before are on none.
 * \param options that the file was read with, from onMapOfCommand() */
void
keepMap(const std::string& path,
        const pcl_uvol::Dataset& points,
        const pcl_uvol::LoadOptions& options,
        pcl_uvol::Report& report);

/** \brief Read a mesh with its fields on the map of the command, as a step of the
 * report.
 * \param[out] triangles stay empty for a file of points
 * \throws IOError */
pcl_uvol::Dataset
loadMesh(const std::string& path,
         std::vector<pcl_uvol::Triangle>& triangles,
         pcl_uvol::Report& report);

/** \brief Read a file on the map of the command, as a step of the report; its notes
 * become warnings.
 * \param where keep only the points for which that holds, see selectRows; "": all
 * \param threads for that; 0: all cores
 * \param[out] in_file how many points the file has, if that is asked for
 * \throws IOError, and InvalidArgument for a file without points */
pcl_uvol::Dataset
loadPoints(const std::string& path,
           pcl_uvol::Report& report,
           const pcl_uvol::LoadOptions& options = {},
           const std::string& where = "",
           unsigned threads = 0,
           std::size_t* in_file = nullptr);

/** \brief Names of fields joined by commas, as parseNames() reads them. Where a field
 * has several parts with the commas between them as its name, they are that one name.
 * \throws UsageError that names the option */
std::vector<std::string>
parseFieldNames(const std::string& option,
                const std::string& value,
                const pcl_uvol::Dataset& points);

/** \brief Make sure that samples have the field that an option names, see
 * addDerivedField.
 * \param name becomes what stages call it; "" stays ""
 * \param periodic see DerivedFieldOptions::periodic */
void
addField(pcl_uvol::Dataset& samples,
         std::string& name,
         const Options& options,
         pcl_uvol::Report& report,
         const std::array<double, 3>& periodic = {});

/** \brief The same for points that have no derivatives.
 * \param because see DerivedFieldOptions::no_derivatives */
void
addField(pcl_uvol::Dataset& points,
         std::string& name,
         const std::string& because,
         const Options& options,
         pcl_uvol::Report& report);

/** \brief Warn of fields and names of a dataset that its file does not hold. */
void
warnOfLosses(const std::string& path,
             const pcl_uvol::Dataset& dataset,
             pcl_uvol::Report& report);

/** \brief The name of one of several files: out.ply becomes out_00010.ply.
 * \param digits of the number at least */
std::string
numberedPath(const std::string& path, std::uint64_t number, std::size_t digits = 5);

/** \brief Write a file, as a step of the report.
 * \throws IOError */
void
savePoints(const std::string& path,
           const pcl_uvol::Dataset& dataset,
           const pcl_uvol::SaveOptions& options,
           pcl_uvol::Report& report);

} // namespace uvol_tools
