// SPDX-License-Identifier: BSD-3-Clause
#include "io/label_comments.h"

#include "common/numbers.h"
#include "common/printable.h"
#include "io/files.h"

namespace pcl_uvol {
namespace io {
namespace {

constexpr std::string_view key = "label";

} // namespace

void
addLabelComments(const Dataset& dataset,
                 const std::vector<std::string>& fields,
                 const std::vector<std::string>& words,
                 std::vector<std::string>& comments)
{
  for (std::size_t i = 0; i < fields.size(); ++i)
    if (const auto* const names =
            findLabels(dataset.cloud.fields, dataset.labels, fields[i]))
      for (std::size_t label = 0; label < names->size(); ++label)
        comments.push_back(std::string(key) + ' ' + words[i] + ' ' +
                           std::to_string(label) + ' ' + (*names)[label]);
}

void
takeLabelComment(std::string_view comment, LabelNames& labels)
{
  std::vector<std::string_view> words;
  splitWords(comment, words);
  std::uint64_t label = 0;
  if (words.size() < 4 || words[0] != key || !parseCount(words[2], label))
    return;
  const auto before = static_cast<std::size_t>(words[2].data() - comment.data());
  const std::string name(comment.substr(before + words[2].size() + 1));
  const auto known = labels.find(std::string(words[1]));
  if (known == labels.end()
          ? label == 0
          : label == known->second.size() && known->second.back() < name)
    labels[std::string(words[1])].push_back(name);
}

} // namespace io

} // namespace pcl_uvol
