// SPDX-License-Identifier: BSD-3-Clause
// Samples of nothing around a cloud, where its user knows that nothing is there.
#pragma once

#include <pcl_uvol/common/dataset.h>
#include <pcl_uvol/common/export.h>
#include <pcl_uvol/common/stage.h>

#include <pcl/types.h>

#include <string>

namespace pcl_uvol {

/** \brief Add samples with that value of a field outside of the others, about one
 * spacing away from them.
 *
 * They lie at the distance of the 12th neighbour of a sample, in those of 26 directions
 * in which a ball is empty that is as large as the one with its 24 neighbours. Other
 * fields are those of that sample. Hollows larger than such a ball count as outside.
 *
 * \param use points that count; null: all
 *
 * \param field of single numbers
 *
 * \param report gets the count "outer_samples"
 *
 * \throws InvalidArgument for a field that is not there or not of single numbers, for
 * a value that it cannot hold, and for a cloud of fewer than 25 distinct samples */
PCL_UVOL_EXPORTS void
addOuterLayer(Dataset& dataset,
              const pcl::Indices* use,
              const std::string& field,
              double value,
              unsigned threads,
              Report& report);

} // namespace pcl_uvol
