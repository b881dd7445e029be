// SPDX-License-Identifier: BSD-3-Clause
// Names of labels in files that hold numbers only: a comment for each of them,
// "label hole 3 A-117", which our readers understand.
#pragma once

#include "common/records.h"

#include <string>
#include <string_view>
#include <vector>

namespace pcl_uvol {
namespace io {

/** \brief Append the comments that the labels of a dataset need.
 * \param fields names of fields of the dataset
 * \param words what the file calls them, one each */
void
addLabelComments(const Dataset& dataset,
                 const std::vector<std::string>& fields,
                 const std::vector<std::string>& words,
                 std::vector<std::string>& comments);

/** \brief Take the name that a comment gives a label, if it does: they come in order.
 * \param comment without what marks it */
void
takeLabelComment(std::string_view comment, LabelNames& labels);

} // namespace io

} // namespace pcl_uvol
