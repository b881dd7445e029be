// SPDX-License-Identifier: BSD-3-Clause
// Pictures that are begun on a graphics card and finished on the CPU.
#include "gl/context.h"
#include "shared/fallback_backend.h"
#include "support/messages.h"
#include "support/surfaces.h"
#include <pcl_uvol/render/image_space/image_space_renderer.h>

#include <gtest/gtest.h>

#include <functional>
#include <memory>

namespace test_fallback_backend {

using pcl_uvol::Image;

/** A card that does what it is told. */
class Card : public pcl_uvol::ImageSpaceBackend {
public:
  explicit Card(const std::function<void(Image&, pcl_uvol::Report&)>& draw)
      : draw_(draw)
  {
  }

  std::string
  describe() const override
  {
    return "card";
  }

  void
  render(const pcl_uvol::Frame&, Image& image, pcl_uvol::Report& report) override
  {
    ++calls;
    draw_(image, report);
  }

  int calls = 0;

private:
  std::function<void(Image&, pcl_uvol::Report&)> draw_;
};

class FallbackBackend : public testing::Test {
protected:
  FallbackBackend()
  {
    renderer_.setInputCloud(uvol_test::makeSphere(2000, 1));
    renderer_.setSize(40, 30);
    renderer_.render(expected_);
  }

  pcl_uvol::ImageSpaceRenderer<pcl::PointNormal> renderer_;
  Image expected_, image_;
};

TEST_F(FallbackBackend, DrawsOnTheCpuWhatACardCannot)
{
  const auto card = std::make_shared<Card>([](Image& image, pcl_uvol::Report& report) {
    image.color.assign(7, 1);
    report.count("half_done", 1);
    throw pcl_uvol::GlError("There is no memory left.");
  });
  renderer_.setBackend(std::make_shared<uvol_tools::FallbackBackend>(card));
  renderer_.render(image_);
  EXPECT_EQ(expected_.color, image_.color);
  ASSERT_EQ(1u, renderer_.getReport().warnings.size());
  const pcl_uvol::Message& warning = renderer_.getReport().warnings[0];
  EXPECT_EQ("graphics_card_failed", warning.code);
  EXPECT_EQ("There is no memory left.", uvol_test::wordOf(warning, "reason"));
  EXPECT_EQ(0u, renderer_.getReport().getCount("half_done"));
  EXPECT_EQ(0u, renderer_.describeBackend().find("cpu"));
  renderer_.render(image_); // without another try
  EXPECT_EQ(1, card->calls);
  EXPECT_TRUE(renderer_.getReport().warnings.empty());
}

TEST_F(FallbackBackend, LeavesOtherErrorsAndGoodPicturesAlone)
{
  const auto card = std::make_shared<Card>([](Image& image, pcl_uvol::Report&) {
    image.width = image.height = 1;
    image.color = {1, 2, 3, 255};
  });
  renderer_.setBackend(std::make_shared<uvol_tools::FallbackBackend>(card));
  renderer_.render(image_);
  EXPECT_EQ((std::vector<std::uint8_t>{1, 2, 3, 255}), image_.color);
  EXPECT_EQ("card", renderer_.describeBackend());
  renderer_.setBackend(std::make_shared<uvol_tools::FallbackBackend>(
      std::make_shared<Card>([](Image&, pcl_uvol::Report&) {
        throw pcl_uvol::InvalidArgument("The camera is wrong.");
      })));
  EXPECT_THROW(renderer_.render(image_), pcl_uvol::InvalidArgument);
}

} // namespace test_fallback_backend
