#include <pcl_uvol/mpi/mpi_communicator.h>

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
    std::cout << "rank " << communicator.rank() << " of " << communicator.size()
              << '\n';
  }
  controller->Finalize();
}
