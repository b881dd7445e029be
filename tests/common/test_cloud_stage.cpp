// SPDX-License-Identifier: BSD-3-Clause
// The input of all stages: what CloudStage gives to their work, and what it refuses.
#include <pcl_uvol/common/cloud_view.h>

#include <gtest/gtest.h>
#include <pcl/conversions.h>
#include <pcl/point_types.h>

namespace test_cloud_stage {

using pcl_uvol::CloudView;
using pcl_uvol::InvalidArgument;

/** Adds up x, and counts how often it has to forget. */
template <typename PointT>
class SumStage : public pcl_uvol::CloudStage<PointT> {
public:
  float
  compute()
  {
    float sum = 0.0f;
    this->withInput("SumStage",
                    [&](const CloudView& cloud, const pcl::Indices& indices) {
                      for (const auto index : indices)
                        sum += cloud.xyz(static_cast<std::size_t>(index))[0];
                    });
    return sum;
  }

  int forgotten = 0;

private:
  void
  forgetInput() override
  {
    ++forgotten;
  }
};

pcl::PointCloud<pcl::PointXYZ>::Ptr
makeCloud()
{
  pcl::PointCloud<pcl::PointXYZ>::Ptr cloud(new pcl::PointCloud<pcl::PointXYZ>);
  for (const float x : {1.0f, 2.0f, 4.0f})
    cloud->push_back({x, 0.0f, 0.0f});
  return cloud;
}

template <typename Stage, typename CloudPtr>
void
expectSums(const CloudPtr& cloud)
{
  Stage stage;
  EXPECT_THROW(stage.compute(), InvalidArgument);
  stage.setInputCloud(cloud);
  EXPECT_EQ(7.0f, stage.compute());
  EXPECT_EQ(7.0f, stage.compute());
  stage.setIndices(std::make_shared<pcl::Indices>(pcl::Indices{2, 0, 2}));
  EXPECT_EQ(9.0f, stage.compute());
  for (const pcl::Indices& wrong :
       {pcl::Indices{}, pcl::Indices{3}, pcl::Indices{0, -1}}) {
    stage.setIndices(std::make_shared<pcl::Indices>(wrong));
    EXPECT_THROW(stage.compute(), InvalidArgument);
  }
  stage.setIndices(pcl::IndicesPtr());
  EXPECT_EQ(7.0f, stage.compute());
  EXPECT_EQ(1, stage.forgotten);
  stage.setInputCloud(cloud); // the same one, changed in place perhaps
  EXPECT_EQ(2, stage.forgotten);
  stage.setInputCloud(nullptr);
  EXPECT_EQ(3, stage.forgotten);
  EXPECT_THROW(stage.compute(), InvalidArgument);
}

TEST(CloudStage, TakesCloudsOfPointTypes)
{
  expectSums<SumStage<pcl::PointXYZ>>(makeCloud());
}

TEST(CloudStage, TakesCloudsOfFieldsKnownAtRunTime)
{
  pcl::PCLPointCloud2::Ptr cloud(new pcl::PCLPointCloud2);
  pcl::toPCLPointCloud2(*makeCloud(), *cloud);
  expectSums<SumStage<pcl::PCLPointCloud2>>(cloud);
}

} // namespace test_cloud_stage
