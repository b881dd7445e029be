// An isosurface that carries every field of its samples, from file to file.
// usage: extract_with_fields IN OUT FIELD ISOVALUE, as in
//   extract_with_fields star.csv star.ply rho 0.1
#include <pcl_uvol/io/dataset.h>
#include <pcl_uvol/pipeline/isosurface_pipeline.h>

#include <iostream>

int
main(int argc, char** argv)
try {
  if (argc != 5) {
    std::cerr << "usage: extract_with_fields IN OUT FIELD ISOVALUE\n";
    return 2;
  }
  pcl_uvol::IsosurfacePipelineParameters parameters;
  parameters.isosurface.field = argv[3];
  parameters.isosurface.isovalues = {std::stod(argv[4])};

  pcl_uvol::IsosurfacePipeline pipeline;
  pipeline.setInput(
      std::make_shared<pcl_uvol::Dataset>(pcl_uvol::loadDataset(argv[1])));
  pipeline.setParameters(parameters);
  const pcl_uvol::IsosurfaceResult result = pipeline.run();
  pcl_uvol::saveDataset(argv[2], result.surface);

  // A result is good where there is no warning: show all of them.
  for (const pcl_uvol::Message& warning : result.report.warnings)
    std::cout << "Warning (" << warning.code << "): " << warning << '\n';
  std::cout << result.surface.cloud.width << " isopoints with";
  for (const auto& field : result.surface.cloud.fields)
    std::cout << ' ' << field.name;
  std::cout << '\n';
}
catch (const std::exception& error) { // pcl_uvol::Exception and what the STL throws
  std::cerr << error.what() << '\n';
  return 1;
}
