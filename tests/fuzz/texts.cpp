// SPDX-License-Identifier: BSD-3-Clause
// Bytes as texts: parameters in JSON, and expressions.
#include "promises.h"
#include "random_cloud.h"
#include "targets.h"
#include <pcl_uvol/expressions/derived_fields.h>
#include <pcl_uvol/interpolation/interpolation_parameters.h>
#include <pcl_uvol/multivariate/density_clustering.h>
#include <pcl_uvol/pipeline/isosurface_pipeline.h>
#include <pcl_uvol/surface/splat_generation.h>

namespace uvol_fuzz {

namespace {

/** What JSON gives is what its JSON gives. */
template <typename Parameters>
void
requireJsonRoundTrip(const std::string& text)
{
  refusalOf<pcl_uvol::InvalidArgument>([&] {
    const Parameters parameters = Parameters::fromJson(text);
    require(Parameters::fromJson(parameters.toJson()) == parameters,
            "parameters survive JSON");
  });
}

/** Ten samples of a smooth field. */
pcl_uvol::Dataset
makeSamples()
{
  constexpr std::size_t count = 10;
  std::vector<std::uint8_t> numbers{0, 0, 0}; // whole numbers, not scaled
  for (std::size_t i = 0; i < count; ++i)
    for (const std::size_t factor : {1, 3, 7, 2})
      numbers.push_back(static_cast<std::uint8_t>(i * factor % 11));
  Bytes bytes(numbers.data(), numbers.size());
  pcl_uvol::Dataset samples;
  samples.cloud =
      *takeCloud(bytes, std::array<const char*, 4>{"x", "y", "z", "intensity"});
  return samples;
}

} // namespace

void
readParameters(const std::uint8_t* bytes, std::size_t size)
{
  const std::string text(reinterpret_cast<const char*>(bytes), size);
  requireJsonRoundTrip<pcl_uvol::IsosurfacePipelineParameters>(text);
  requireJsonRoundTrip<pcl_uvol::InterpolationParameters>(text);
  requireJsonRoundTrip<pcl_uvol::ClusteringParameters>(text);
  requireJsonRoundTrip<pcl_uvol::SplatParameters>(text);
}

void
readExpression(const std::uint8_t* bytes, std::size_t size)
{
  const std::string text(reinterpret_cast<const char*>(bytes), size);
  static const pcl_uvol::Dataset samples = makeSamples();
  refusalOf<pcl_uvol::InvalidArgument>([&] {
    pcl_uvol::Dataset dataset = samples;
    pcl_uvol::Report report;
    pcl_uvol::addDerivedField(dataset, text, {1, ""}, report);
    require(dataset.cloud.width == samples.cloud.width, "no sample is lost");
  });
  refusalOf<pcl_uvol::InvalidArgument>([&] {
    pcl_uvol::Dataset dataset = samples;
    pcl_uvol::Report report;
    pcl_uvol::selectRows(dataset, text, {1, ""}, report);
  });
}

} // namespace uvol_fuzz
