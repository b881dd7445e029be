// SPDX-License-Identifier: BSD-3-Clause
#include "common/parameter_json.h"
#include "common/scalar_field.h"
#include "multivariate/membership.h"
#include <pcl_uvol/multivariate/cluster_membership.h>

#include <algorithm>

namespace pcl_uvol {

namespace {

std::vector<float>
readField(const CloudView& cloud, const pcl::Indices& indices, const std::string& name)
{
  const ScalarField field(cloud.fields, name);
  std::vector<float> values;
  values.reserve(indices.size());
  for (const auto index : indices)
    values.push_back(
        static_cast<float>(field.read(cloud.point(static_cast<std::size_t>(index)))));
  return values;
}

/** Those of other clusters tell nothing about this one. */
void
multiplyByProbabilities(const CloudView& cloud,
                        const pcl::Indices& indices,
                        const std::string& field,
                        std::vector<float>& members)
{
  const std::vector<float> probabilities = readField(cloud, indices, field);
  for (std::size_t i = 0; i < members.size(); ++i) {
    if (probabilities[i] < 0.0f || probabilities[i] > 1.0f)
      throw InvalidArgument("no_probabilities", {{"field", field}});
    members[i] *= probabilities[i];
  }
}

} // namespace

std::vector<float>
detail::computeMembership(const CloudView& cloud,
                          const pcl::Indices& indices,
                          const std::vector<int>& labels,
                          const MembershipParameters& parameters,
                          unsigned threads,
                          Report& report)
{
  if (labels.size() != cloud.count)
    throw InvalidArgument("labels_of_other_points",
                          {{"labels", labels.size()}, {"points", cloud.count}});
  std::vector<std::int32_t> own;
  for (const auto index : indices)
    own.push_back(labels[static_cast<std::size_t>(index)]);
  std::vector<float> members = membership(own, parameters.cluster);
  report.count("cluster_points", std::count(members.begin(), members.end(), 1.0f));
  if (!parameters.probability.empty())
    multiplyByProbabilities(cloud, indices, parameters.probability, members);
  if (!parameters.smoothing_length.empty())
    members = smoothMembership(cloud,
                               indices,
                               members,
                               readField(cloud, indices, parameters.smoothing_length),
                               threads,
                               report);
  return members;
}

std::string
MembershipParameters::toJson() const
{
  return writeJson(*this);
}

MembershipParameters
MembershipParameters::fromJson(const std::string& text)
{
  return readJson<MembershipParameters>(text);
}

} // namespace pcl_uvol
