// SPDX-License-Identifier: BSD-3-Clause
// Surfaces that are prepared apart from the renderer that draws them.
#include "render/renderer_setup.h"
#include <pcl_uvol/common/exceptions.h>
#include <pcl_uvol/render/image_space/image_space_renderer.h>

#include <gtest/gtest.h>
#include <pcl/conversions.h>

#include <stdexcept>
#include <thread>

namespace test_prepared_surface {

using pcl_uvol::Image;
using pcl_uvol::PreparedSurface;
using Renderer = pcl_uvol::ImageSpaceRenderer<pcl::PCLPointCloud2>;

pcl::PCLPointCloud2::ConstPtr
makeKnot(std::size_t n)
{
  pcl::PCLPointCloud2::Ptr cloud(new pcl::PCLPointCloud2);
  pcl::toPCLPointCloud2(*uvol_test::makeTorusKnot(n, 1), *cloud);
  return cloud;
}

/** The points lie so far apart that their discs are seen. */
Image
draw(Renderer& renderer)
{
  renderer.setSize(400, 300);
  Image image;
  renderer.render(image);
  return image;
}

TEST(PreparedSurface, IsDrawnAsOneThatTheRendererPrepares)
{
  const auto cloud = makeKnot(20000);
  Renderer own, given;
  own.setInputCloud(cloud);
  const Image expected = draw(own);
  const auto prepared = std::make_shared<PreparedSurface>(*cloud);
  given.setInputCloud(cloud);
  given.setPreparedSurface(prepared);
  prepared->findFootprints();
  EXPECT_EQ(expected.color, draw(given).color);
  EXPECT_EQ(own.getReport().counts, given.getReport().counts);
  EXPECT_EQ(expected.color, draw(given).color) << "again";

  const auto other = makeKnot(500); // which the renderer prepares
  own.setInputCloud(other);
  given.setInputCloud(other);
  EXPECT_EQ(draw(own).color, draw(given).color);
}

TEST(PreparedSurface, WithoutFootprintsTheRendererFindsThemUnlessItIsHasty)
{
  const auto cloud = makeKnot(20000);
  Renderer own, given;
  own.setInputCloud(cloud);
  given.setInputCloud(cloud);
  const Image with = draw(own);
  own.settings().footprints = false;
  const Image without = draw(own);
  ASSERT_NE(with.color, without.color);
  given.setPreparedSurface(std::make_shared<PreparedSurface>(*cloud));
  given.setHasty(true);
  EXPECT_EQ(without.color, draw(given).color);
  given.setHasty(false);
  EXPECT_EQ(with.color, draw(given).color);
  given.setHasty(true); // they are there
  EXPECT_EQ(with.color, draw(given).color);
}

TEST(PreparedSurface, IsDrawnAndColoredWhileItsFootprintsAreFound)
{
  const auto cloud = makeKnot(20000);
  const auto prepared = std::make_shared<PreparedSurface>(*cloud, 2);
  Renderer renderer;
  renderer.setInputCloud(cloud);
  renderer.setPreparedSurface(prepared);
  renderer.setHasty(true);
  std::thread worker([&] { prepared->findFootprints(); });
  for (int i = 0; i < 4; ++i) {
    renderer.setColorField(i % 2 == 0 ? "x" : "y");
    draw(renderer);
  }
  worker.join();
  const Image drawn = draw(renderer);
  Renderer own;
  own.setInputCloud(cloud);
  own.setColorField("y");
  EXPECT_EQ(draw(own).color, drawn.color);
}

TEST(PreparedSurface, ReportsWhatItCannotDo)
{
  const auto cloud = makeKnot(100);
  Renderer renderer;
  renderer.setInputCloud(makeKnot(200));
  renderer.setPreparedSurface(std::make_shared<PreparedSurface>(*cloud));
  Image image;
  EXPECT_THROW(renderer.render(image), pcl_uvol::InvalidArgument);
  EXPECT_THROW(PreparedSurface{pcl::PCLPointCloud2()}, pcl_uvol::InvalidArgument);

  PreparedSurface prepared(*cloud);
  EXPECT_THROW(prepared.findFootprints([](const std::string&, double) {
    throw std::runtime_error("It is ended.");
  }),
               std::runtime_error);
  EXPECT_NO_THROW(prepared.findFootprints());
}

} // namespace test_prepared_surface
