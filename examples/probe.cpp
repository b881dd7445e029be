// The field between its samples, with its standard error and what it rests on.
#include "samples.h"
#include <pcl_uvol/interpolation/field_interpolation.h>

#include <iostream>

int
main()
{
  pcl_uvol::FieldInterpolation<pcl::PointXYZI> interpolation;
  interpolation.setInputCloud(makeBall(50000));
  interpolation.setFields({"intensity"});

  pcl_uvol::InterpolatedFields result;
  interpolation.interpolateAt({{0.3, 0.0, 0.0}, {0.3, 0.3, 0.3}, {5.0, 0.0, 0.0}},
                              result);
  for (std::size_t i = 0; i < result.size; ++i)
    if (result.support[i] == pcl_uvol::FieldSupport::Outside)
      std::cout << "outside of the samples\n";
    else
      std::cout << result.getValue(0, i) << " +- " << result.getError(0, i)
                << ", gradient along x " << result.getGradient(0, i)[0] << '\n';
}
