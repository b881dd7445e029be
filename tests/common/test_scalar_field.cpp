// SPDX-License-Identifier: BSD-3-Clause
// Field expressions: components, lengths, defaults, and what they say when wrong.
#include "io/random_dataset.h"
#include <pcl_uvol/common/exceptions.h>

#include <tuple>

using pcl_uvol::InvalidArgument;
using pcl_uvol::Message;
using pcl_uvol::ScalarField;
using namespace uvol_test;

namespace test_scalar_field {

std::string
defaultOf(const std::vector<FieldSpec>& specs)
{
  return ScalarField::defaultName(makeDataset(specs, 0, 1).cloud.fields);
}

Message
errorOf(const std::vector<FieldSpec>& specs, const std::string& expression)
{
  const auto fields = makeDataset(specs, 0, 1).cloud.fields;
  return uvol_test::thrownBy<InvalidArgument>([&] { ScalarField(fields, expression); });
}

const std::vector<FieldSpec> vectors{{"vel", Type::FLOAT32, 3},
                                     {"acc_0", Type::FLOAT64},
                                     {"acc_1", Type::FLOAT64},
                                     {"id", Type::INT32}};

TEST(ScalarField, ReadsEveryType)
{
  for (const std::uint8_t type : allDatatypes()) {
    auto dataset = makeDataset({{"f", type}}, 1, 1);
    std::uint8_t* const to = &dataset.cloud.data[dataset.cloud.fields.back().offset];
    std::memset(to, 0, pcl_uvol::datatypeSize(type));
    if (type == Type::FLOAT32)
      put(to, 42.0f);
    else if (type == Type::FLOAT64)
      put(to, 42.0);
    else
      put(to, std::uint8_t{42});
    EXPECT_EQ(valueOf(dataset, "f", 0), 42.0) << int(type);
  }
}

TEST(ScalarField, NegativeIntegersKeepTheirSign)
{
  auto dataset = makeDataset({{"f", Type::INT16}}, 1, 1);
  put(&dataset.cloud.data[dataset.cloud.fields.back().offset], std::int16_t{-5});
  EXPECT_EQ(valueOf(dataset, "f", 0), -5.0);
  EXPECT_EQ(valueOf(dataset, "|f|", 0), 5.0);
}

TEST(ScalarField, ComponentsAndLengths)
{
  const auto dataset = makeDataset(vectors, 1, 2);
  const double v0 = valueOf(dataset, "vel[0]", 0), v1 = valueOf(dataset, "vel[1]", 0),
               v2 = valueOf(dataset, " vel [2] ", 0);
  EXPECT_NE(v0, v1);
  EXPECT_EQ(valueOf(dataset, "|vel|", 0), std::sqrt(v0 * v0 + v1 * v1 + v2 * v2));
  const double a0 = valueOf(dataset, "acc_0", 0), a1 = valueOf(dataset, "acc[1]", 0);
  EXPECT_EQ(a1, valueOf(dataset, "acc_1", 0));
  EXPECT_EQ(valueOf(dataset, "|acc|", 0), std::sqrt(a0 * a0 + a1 * a1));
  EXPECT_EQ(valueOf(dataset, "|acc_0, vel[1]|", 0), std::sqrt(a0 * a0 + v1 * v1));
}

TEST(ScalarField, ExactNamesComeFirst)
{
  const auto dataset = makeDataset({{"a[1]", Type::INT32},
                                    {"|b|", Type::INT32},
                                    {" c", Type::INT32},
                                    {"e, m", Type::INT32},
                                    {"d [m/s]", Type::INT32, 2}},
                                   1,
                                   3);
  EXPECT_EQ(ScalarField(dataset.cloud.fields, "a[1]").getName(), "a[1]");
  EXPECT_FALSE(ScalarField(dataset.cloud.fields, "|b|").isLength());
  EXPECT_EQ(ScalarField(dataset.cloud.fields, " c").getName(), " c");
  EXPECT_EQ(ScalarField(dataset.cloud.fields, "e, m").getName(), "e, m");
  EXPECT_EQ(1u, ScalarField(dataset.cloud.fields, "|e, m|").getComponents().size());
  const ScalarField component(dataset.cloud.fields, "d [m/s][1]");
  EXPECT_EQ(component.getComponents().front().offset,
            dataset.cloud.fields.back().offset + 4);
}

TEST(ScalarField, ErrorsListTheFields)
{
  const Message unknown = errorOf({{"a", Type::INT16}}, "b");
  EXPECT_EQ("b", uvol_test::wordOf(unknown, "field"));
  EXPECT_EQ("x (float32), y (float32), z (float32), a (int16)",
            uvol_test::wordOf(unknown, "fields"));
  EXPECT_NE(errorOf(vectors, "vel").text().find("|vel|"), std::string::npos);
  EXPECT_EQ(Message("component_too_large", {{"field", "vel[3]"}, {"last", 2}}),
            errorOf(vectors, "vel[3]"));
  for (const char* const wrong : {"",
                                  "[0]",
                                  "vel[]",
                                  "vel[-1]",
                                  "vel[1",
                                  "vel[a]",
                                  "|",
                                  "||",
                                  "|,|",
                                  "|id,|",
                                  "|q|"})
    EXPECT_NE("", errorOf(vectors, wrong).code) << wrong;
}

TEST(ScalarField, Default)
{
  EXPECT_EQ(defaultOf({{"a", Type::INT16}, {"intensity", Type::FLOAT32}}), "intensity");
  EXPECT_EQ(defaultOf({{"rgb", Type::FLOAT32},
                       {"normal_x", Type::FLOAT32},
                       {"nx", Type::FLOAT32},
                       {"curvature", Type::FLOAT32},
                       {"alpha", Type::UINT8},
                       {"density", Type::FLOAT64}}),
            "density");
  for (const auto& [specs, code, fields] :
       {std::tuple(std::vector<FieldSpec>{{"a", Type::INT16}, {"b", Type::INT16}},
                   "several_scalar_fields",
                   "a (int16), b (int16)"),
        std::tuple(std::vector<FieldSpec>{}, "no_scalar_field", ""),
        std::tuple(std::vector<FieldSpec>{{"v", Type::FLOAT32, 3}},
                   "several_scalar_fields",
                   "v (float32 x 3)")}) {
    const Message error =
        uvol_test::thrownBy<InvalidArgument>([&, &given = specs] { defaultOf(given); });
    EXPECT_EQ(code, error.code);
    EXPECT_NE(std::string::npos, uvol_test::wordOf(error, "fields").find(fields));
  }
}

} // namespace test_scalar_field
