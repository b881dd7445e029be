// SPDX-License-Identifier: BSD-3-Clause
// Pictures of a series: they are drawn when all files have been read, with one camera
// and one scale of colours, so that they can be compared.
#pragma once

#include "charts/slice_plot.h"
#include "distributed/scratch_file.h"
#include "shared/options.h"
#include "shared/view_options.h"
#include <pcl_uvol/common/dataset.h>

#include <cstddef>
#include <cstdint>
#include <functional>
#include <optional>
#include <string>
#include <vector>

namespace uvol_tools {

/** \brief What is to be drawn, waiting on disk in the folder of temporary files. */
class PictureSeries {
public:
  /** \brief Add a surface.
   *
   * \param options of the command line that it comes from
   *
   * \param look of its picture, which learns what the pictures share
   *
   * \param surface with the field that colours it
   *
   * \param draw called once by draw(); keeps options and look
   *
   * \throws InvalidArgument for a field that has no scale, and IOError for a full disk
   */
  void
  add(const Options& options,
      ViewOptions& look,
      pcl_uvol::Dataset&& surface,
      const std::function<void(const pcl_uvol::Dataset& surface)>& draw);

  /** \brief Add a slice.
   *
   * \param has_own_scale the colours do not have the scale of all slices
   *
   * \param path of its picture
   *
   * \throws IOError for a full disk */
  void
  add(SlicePlot&& slice, bool has_own_scale, const std::string& path);

  /** \brief Number of pictures. */
  std::size_t
  size() const
  {
    return pictures_.size();
  }

  /** \brief Draw a picture, when all have been added.
   *
   * \throws what drawing throws */
  void
  draw(std::size_t index);

private:
  using Bytes = std::vector<std::uint8_t>;

  struct Picture {
    std::uint64_t offset; ///< of its bytes in the file
    std::size_t size;
    std::function<void(Bytes&& bytes)> draw;
  };

  /** Keep bytes until draw() hands them over. */
  void
  wait(const Bytes& bytes, std::function<void(Bytes&& bytes)> draw);

  std::optional<pcl_uvol::ScratchFile> file_;
  std::vector<Picture> pictures_;
  SharedView shared_;
};

} // namespace uvol_tools
