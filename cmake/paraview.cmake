# The plugin for ParaView. A configuration of its own: ParaView's VTK is not that of the libraries.
include(ExternalProject)
set(ParaView_DIR "" CACHE PATH "Folder of paraview-config.cmake")
set(paraview_settings)
foreach(setting ParaView_DIR CMAKE_PREFIX_PATH CMAKE_BUILD_TYPE CMAKE_CXX_FLAGS CMAKE_C_COMPILER CMAKE_CXX_COMPILER
                CMAKE_CXX_COMPILER_LAUNCHER CMAKE_INSTALL_LIBDIR)
  if(${setting})
    list(APPEND paraview_settings "-D${setting}:STRING=${${setting}}")
  endif()
endforeach()
ExternalProject_Add(pcl_uvol_paraview
  SOURCE_DIR ${PROJECT_SOURCE_DIR}/src/paraview
  BINARY_DIR ${PROJECT_BINARY_DIR}/paraview
  DEPENDS pcl_uvol_core pcl_uvol_gl
  CMAKE_CACHE_ARGS -Dpcl_uvol_DIR:PATH=${PROJECT_BINARY_DIR} ${paraview_settings}
  BUILD_ALWAYS ON
  INSTALL_COMMAND "")
install(SCRIPT ${PROJECT_BINARY_DIR}/paraview/cmake_install.cmake)
