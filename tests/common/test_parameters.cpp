// SPDX-License-Identifier: BSD-3-Clause
// Parameters of all stages: they survive JSON, and equality sees every member.
#include "support/messages.h"
#include <pcl_uvol/common/exceptions.h>
#include <pcl_uvol/common/parameters.h>
#include <pcl_uvol/derivatives/gradient_estimation.h>
#include <pcl_uvol/multivariate/cluster_membership.h>
#include <pcl_uvol/multivariate/density_clustering.h>
#include <pcl_uvol/multivariate/star_coordinates.h>
#include <pcl_uvol/neighbors/voronoi_diagram.h>
#include <pcl_uvol/pipeline/isosurface_pipeline.h>
#include <pcl_uvol/surface/splat_generation.h>
#include <pcl_uvol/surface/surface_normals.h>

#include <gtest/gtest.h>

#include <optional>
#include <set>
#include <string>
#include <tuple>
#include <type_traits>
#include <vector>

namespace test_parameters {

using pcl_uvol::InvalidArgument;
using pcl_uvol::IsosurfaceParameters;
using pcl_uvol::IsosurfacePipelineParameters;
using pcl_uvol::LevelSetParameters;
using pcl_uvol::Message;

/** Another value than before. */
template <typename T>
void
change(T& value)
{
  if constexpr (std::is_same_v<T, bool>)
    value = !value;
  else if constexpr (std::is_enum_v<T>) {
    for (const auto& [other, word] : listWords(T()))
      if (other != value) {
        value = other;
        return;
      }
  }
  else if constexpr (std::is_floating_point_v<T>)
    value = value != value ? T(0.5) : value + T(0.25);
  else if constexpr (std::is_integral_v<T>)
    ++value;
  else if constexpr (std::is_same_v<T, std::string>)
    value += "\"|v,é|";
  else if constexpr (std::is_same_v<T, std::optional<double>>)
    value = 0.125;
  else if constexpr (std::is_same_v<T, std::optional<bool>>)
    value = !value.value_or(true);
  else if constexpr (std::is_same_v<T, std::optional<pcl_uvol::MeshingParameters>>)
    value.emplace();
  else if constexpr (std::is_same_v<T, std::optional<Eigen::Array3d>>)
    value.emplace(0.0, 1.5, 0.0);
  else if constexpr (std::is_same_v<T, std::vector<double>>)
    value.push_back(0.1);
  else if constexpr (std::is_same_v<T, std::vector<std::string>>)
    value.emplace_back("rho");
  else if constexpr (std::is_base_of_v<Eigen::DenseBase<T>, T>)
    value[1] += 1.5f;
  else
    pcl_uvol::forEachMember<T>(
        [&](const char*, auto pointer) { change(value.*pointer); });
}

template <typename Parameters>
class StageParameters : public testing::Test {
};

using AllParameters = testing::Types<IsosurfaceParameters,
                                     LevelSetParameters,
                                     IsosurfacePipelineParameters,
                                     pcl_uvol::NaturalNeighborParameters,
                                     pcl_uvol::GradientParameters,
                                     pcl_uvol::SurfaceNormalParameters,
                                     pcl_uvol::SplatParameters,
                                     pcl_uvol::ClusteringParameters,
                                     pcl_uvol::StarCoordinateParameters,
                                     pcl_uvol::MembershipParameters,
                                     pcl_uvol::VoronoiParameters>;
TYPED_TEST_SUITE(StageParameters, AllParameters);

TYPED_TEST(StageParameters, SurviveJson)
{
  EXPECT_EQ(TypeParam(), TypeParam::fromJson(TypeParam().toJson()));
  TypeParam changed;
  pcl_uvol::forEachMember<TypeParam>(
      [&](const char*, auto pointer) { change(changed.*pointer); });
  EXPECT_NE(TypeParam(), changed);
  EXPECT_EQ(changed, TypeParam::fromJson(changed.toJson())) << changed.toJson();
}

TYPED_TEST(StageParameters, AreUnequalInEveryMember)
{
  std::set<std::string> names;
  pcl_uvol::forEachMember<TypeParam>([&](const char* name, auto pointer) {
    TypeParam changed;
    change(changed.*pointer);
    EXPECT_NE(TypeParam(), changed) << name;
    EXPECT_NE(TypeParam().toJson(), changed.toJson()) << name;
    EXPECT_TRUE(names.insert(name).second) << name << " is listed twice";
  });
}

TYPED_TEST(StageParameters, HaveDefaultsInJson)
{
  EXPECT_EQ(TypeParam(), TypeParam::fromJson("{}"));
}

TYPED_TEST(StageParameters, RefuseUnknownNamesAndWhatIsNoJson)
{
  for (const char* const text : {"", "{", "[]", "1", "null", "{\"unknown\": 1}"})
    EXPECT_THROW(TypeParam::fromJson(text), InvalidArgument) << text;
}

TEST(Parameters, NameWhatIsWrongInJson)
{
  const auto refusal = [](const char* text) {
    return uvol_test::thrownBy<InvalidArgument>(
        [text] { IsosurfacePipelineParameters::fromJson(text); });
  };
  for (const auto& [text, name, value, expected] :
       {std::tuple(R"({"isosurface": {"outside": "left"}})",
                   "isosurface.outside",
                   "\"left\"",
                   "one of lower, higher"),
        std::tuple(R"({"isosurface": {"scale": [1, 2]}})",
                   "isosurface.scale",
                   "[1,2]",
                   "a list of 3"),
        std::tuple(R"({"normal_neighbors": -3})",
                   "normal_neighbors",
                   "-3",
                   "a whole number from 0"),
        std::tuple(R"({"smooth": 1})", "smooth", "1", "true or false"),
        std::tuple(R"({"isosurface": {"voronoi_cells": 4294967296}})",
                   "isosurface.voronoi_cells",
                   "4294967296",
                   "a whole number from 0")})
    EXPECT_EQ(Message("wrong_parameter",
                      {{"name", name}, {"value", value}, {"expected", expected}}),
              refusal(text));
  EXPECT_EQ(Message("wrong_parameter",
                    {{"name", "cluster"},
                     {"value", "2147483648"},
                     {"expected", "a whole number"}}),
            uvol_test::thrownBy<InvalidArgument>([] {
              pcl_uvol::MembershipParameters::fromJson(R"({"cluster": 2147483648})");
            }));
  EXPECT_EQ(-1, pcl_uvol::MembershipParameters::fromJson(R"({"cluster": -1})").cluster);
  const Message unknown = refusal(R"({"isosurfaces": {}})");
  EXPECT_EQ("unknown_parameter", unknown.code);
  EXPECT_EQ("isosurface", uvol_test::wordOf(unknown, "similar"));
  EXPECT_EQ(0u, uvol_test::wordOf(unknown, "names").find("isosurface, "));
}

TEST(Parameters, ReplaceWhatJsonCannotHold)
{
  IsosurfaceParameters latin1;
  latin1.field = "T \xb0";
  EXPECT_EQ("T \xef\xbf\xbd", IsosurfaceParameters::fromJson(latin1.toJson()).field);
}

TEST(Parameters, UnderstandTheOldWordForFits)
{
  EXPECT_EQ(IsosurfaceParameters(),
            IsosurfaceParameters::fromJson(R"({"interpolation": "smooth"})"));
  EXPECT_STREQ("fit", pcl_uvol::toWord(pcl_uvol::Interpolation::Fit));
}

TEST(Parameters, HaveNullForWhatIsNotGiven)
{
  LevelSetParameters given;
  given.mu = 0.5;
  given.isovalue = 2.0;
  const std::string text = R"({"mu": null, "isovalue": null})";
  EXPECT_EQ(LevelSetParameters(), LevelSetParameters::fromJson(text));
  EXPECT_EQ(given, LevelSetParameters::fromJson(R"({"mu": 0.5, "isovalue": 2})"));
}

} // namespace test_parameters
