// Samples that many processes hold parts of: mpirun -np 4 mpi. Every process keeps the
// isopoints of its piece of space; their union is what one process would find.
#include "samples.h"
#include <pcl_uvol/mpi/mpi_communicator.h>
#include <pcl_uvol/pipeline/isosurface_pipeline.h>

#include <pcl/conversions.h>
#include <vtkMPIController.h>
#include <vtkNew.h>

#include <iostream>

int
main(int argc, char** argv)
{
  vtkNew<vtkMPIController> controller;
  controller->Initialize(&argc, &argv);
  {
    pcl_uvol::MpiCommunicator communicator(*controller);
    // The part of this process: every size()-th of the samples.
    const pcl::PointCloud<pcl::PointXYZI>::Ptr all = makeBall(100000);
    pcl::PointCloud<pcl::PointXYZI> part;
    for (std::size_t i = communicator.rank(); i < all->size(); i += communicator.size())
      part.push_back((*all)[i]);
    const auto samples = std::make_shared<pcl_uvol::Dataset>();
    pcl::toPCLPointCloud2(part, samples->cloud);

    pcl_uvol::IsosurfacePipelineParameters parameters;
    parameters.isosurface.isovalues = {0.5};
    parameters.normals = pcl_uvol::NormalMethod::Edge; // where no fit serves
    pcl_uvol::DistributedIsosurfacePipeline pipeline(communicator);
    pipeline.setInput(samples);
    pipeline.setParameters(parameters);
    const pcl_uvol::IsosurfaceResult result = pipeline.run();

    std::vector<std::uint64_t> count{result.surface.cloud.width};
    communicator.allReduce(count);
    if (communicator.rank() == 0)
      std::cout << count[0] << " isopoints, " << result.surface.cloud.width
                << " of them from the first process\n";
  }
  controller->Finalize();
}
