// SPDX-License-Identifier: BSD-3-Clause
// What colours the viewer's surface: one of its fields after the other.
#pragma once

#include "shared/render_options.h"

#include <pcl/PCLPointCloud2.h>
#include <vtkLookupTable.h>
#include <vtkNew.h>

#include <string>
#include <vector>

namespace uvol_tools {

/** \brief The fields that a surface can be coloured by, and the one that does. */
class ColorChoice {
public:
  /** \param look names the first field, and the range of its colours if it has one;
   * outlives this object. Where it names none, several isovalues have a colour each */
  ColorChoice(const RenderOptions& look, const pcl::PCLPointCloud2& cloud);

  /** \brief "" for one colour. */
  const std::string&
  getField() const
  {
    return fields_[chosen_];
  }

  /** \brief Whether numbers of a field have colours, which the table holds. */
  bool
  hasScale() const;

  vtkLookupTable&
  getTable()
  {
    return *table_;
  }

  /** \brief Choose the next field, one colour among them, and start over at the end. */
  void
  next();

  /** \brief Colour a renderer's surface.
   * \throws InvalidArgument for a field without a number; the surface then has one
   * colour */
  void
  apply(const pcl::PCLPointCloud2& cloud, pcl_uvol::ImageSpaceRendererBase& renderer);

  /** \brief Give another renderer the colours of the last apply(). */
  void
  colorLike(pcl_uvol::ImageSpaceRendererBase& renderer) const;

  /** \brief The colours of points by the last apply(); none for one colour. */
  std::vector<pcl_uvol::Rgba>
  colorPoints(const pcl::PCLPointCloud2& cloud) const;

  /** \brief Whether window and pictures have a bar. */
  bool
  hasLegend() const;

  /** \brief Draw the bar of the last apply() into a picture. */
  void
  drawLegend(pcl_uvol::Image& image) const;

private:
  /** What the colours of the last apply() stand for. */
  struct Legend {
    pcl_uvol::ColorMapping mapping;
    pcl_uvol::ColorScale scale;
    std::vector<pcl_uvol::CategoryColor> categories;
    bool is_known = false;
  };

  const RenderOptions& look_;
  std::vector<std::string> fields_; // that of the options first, and again by its name
  std::size_t chosen_ = 0;
  Legend legend_;
  vtkNew<vtkLookupTable> table_;
};

} // namespace uvol_tools
