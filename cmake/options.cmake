# What is built. As the main project everything but benchmarks and the ParaView plugin is on;
# within another project (add_subdirectory, FetchContent) only core is, unless asked for more.
# Packages are looked for by the parts that are on. A part whose needs are off is off by default.

# An option PCL_UVOL_BUILD_<name> for a part that needs other parts.
macro(pcl_uvol_part name help default)
  set(pcl_uvol_default ${default})
  foreach(need ${ARGN})
    if(NOT PCL_UVOL_BUILD_${need})
      set(pcl_uvol_default OFF)
    endif()
  endforeach()
  option(PCL_UVOL_BUILD_${name} "${help}" ${pcl_uvol_default})
  foreach(need ${ARGN})
    if(PCL_UVOL_BUILD_${name} AND NOT PCL_UVOL_BUILD_${need})
      message(FATAL_ERROR "PCL_UVOL_BUILD_${name} needs PCL_UVOL_BUILD_${need}: "
        "switch the second on (-DPCL_UVOL_BUILD_${need}=ON) or the first off (-DPCL_UVOL_BUILD_${name}=OFF).")
    endif()
  endforeach()
endmacro()

pcl_uvol_part(EXPRESSIONS "Build pcl_uvol::expressions (muParser)" ${PROJECT_IS_TOP_LEVEL})
pcl_uvol_part(FILTERS "Build pcl_uvol::filters (VTK)" ${PROJECT_IS_TOP_LEVEL})
pcl_uvol_part(IO "Build pcl_uvol::io (VTK, libpng, liblzf, zlib)" ${PROJECT_IS_TOP_LEVEL} FILTERS)
pcl_uvol_part(GL "Build pcl_uvol::gl (headers of OpenGL and EGL)" ${PROJECT_IS_TOP_LEVEL})
pcl_uvol_part(VTK "Build pcl_uvol::vtk (VTK)" ${PROJECT_IS_TOP_LEVEL} FILTERS GL)
pcl_uvol_part(MPI "Build pcl_uvol::mpi and the tools that use it (VTK with MPI)" ${PROJECT_IS_TOP_LEVEL})
pcl_uvol_part(TOOLS "Build the uvol_* tools; uvol_cluster and uvol_viewer only with PCL_UVOL_BUILD_VTK"
  ${PROJECT_IS_TOP_LEVEL} EXPRESSIONS IO GL)
pcl_uvol_part(PYTHON "Build the Python module (pybind11)" ${PROJECT_IS_TOP_LEVEL} EXPRESSIONS IO)
pcl_uvol_part(TESTS "Build the tests" ${PROJECT_IS_TOP_LEVEL} TOOLS VTK)
pcl_uvol_part(BENCHMARKS "Build the benchmarks (Google Benchmark, CGAL with TBB, Embree)" OFF TESTS)
pcl_uvol_part(FUZZERS "Build the fuzzers (clang): tools/fuzz.sh" OFF TESTS)
pcl_uvol_part(PARAVIEW_PLUGIN "Build the plugin for ParaView (ParaView_DIR: its SDK)" OFF GL)
option(PCL_UVOL_PRECOMPILE_HEADERS "Read the headers of PCL, Eigen and GoogleTest once for each library" ${PROJECT_IS_TOP_LEVEL})
option(PCL_UVOL_UNITY "Compile the sources of a folder together; OFF for editors and clang-tidy, which know single ones" ${PROJECT_IS_TOP_LEVEL})
option(PCL_UVOL_INSTALL "Install the libraries, their headers and the package" ${PROJECT_IS_TOP_LEVEL})
option(PCL_UVOL_WARNINGS_AS_ERRORS "Treat compiler warnings as errors" OFF)
if(PCL_UVOL_BUILD_PARAVIEW_PLUGIN AND NOT PCL_UVOL_INSTALL)
  message(FATAL_ERROR "PCL_UVOL_BUILD_PARAVIEW_PLUGIN finds core as a package: it needs -DPCL_UVOL_INSTALL=ON.")
endif()
