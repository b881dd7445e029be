# The flags of all targets, and how a library is declared.

# The same bytes on every machine: no fused multiply-add unless written.
add_library(pcl_uvol_determinism INTERFACE)
target_compile_options(pcl_uvol_determinism INTERFACE -ffp-contract=off)

add_library(pcl_uvol_warnings INTERFACE)
# Of sources that are compiled together, one may have a local name that is a constant of another.
target_compile_options(pcl_uvol_warnings INTERFACE
  -Wall -Wextra $<$<NOT:$<BOOL:$<TARGET_PROPERTY:UNITY_BUILD>>>:-Wshadow> -Wnon-virtual-dtor -Woverloaded-virtual
  $<$<BOOL:${PCL_UVOL_WARNINGS_AS_ERRORS}>:-Werror>)

# A reader that writes out of bounds, which no test has met, ends in an error instead of somebody else's code. In core a whole
# extraction takes 1.0 % more instructions for it (uvol_isosurface, 60,000 samples of a gyroid, one thread, callgrind), and an
# isovalue of a tree that is there 0.7 % (tests/instructions); the tree takes 2.1 % and has no stack protector, nor have the
# vector kernels, which call nothing. Sanitizers have checks of their own.
add_library(pcl_uvol_hardening INTERFACE)
target_compile_options(pcl_uvol_hardening INTERFACE
  $<$<CONFIG:Release>:-fstack-protector-strong;-U_FORTIFY_SOURCE;-D_FORTIFY_SOURCE=3>)
target_link_options(pcl_uvol_hardening INTERFACE $<$<CONFIG:Release>:LINKER:-z,relro,-z,now>)

# Tools and the Python module call the libraries and need not be fast themselves: -O1 takes half of the time of -O3 to compile.
# Precompiled headers keep their level, so that these have some of their own, which serve shared libraries as well.
add_library(pcl_uvol_front_end INTERFACE)
target_compile_options(pcl_uvol_front_end INTERFACE -fPIC $<$<CONFIG:Release>:-O1>)

# PCL's and Eigen's headers take more than half of the time and of the memory that most sources take to compile.
# pcl_uvol_precompile_headers(NAME LIBRARIES... [SHARED] [HEADERS <header>...]) reads them once, with the flags of OpenMP and
# those that these libraries ask for, and for shared libraries; targets with the same flags, and any macros more, take what it
# has read.
function(pcl_uvol_precompile_headers name)
  if(NOT PCL_UVOL_PRECOMPILE_HEADERS)
    return()
  endif()
  cmake_parse_arguments(PARSE_ARGV 1 precompile SHARED "" HEADERS)
  set(source ${CMAKE_CURRENT_BINARY_DIR}/${name}.cpp) # a target has one
  if(NOT EXISTS ${source})
    file(WRITE ${source} "")
  endif()
  add_library(${name} OBJECT EXCLUDE_FROM_ALL ${source})
  set_target_properties(${name} PROPERTIES POSITION_INDEPENDENT_CODE ${precompile_SHARED})
  target_link_libraries(${name} PRIVATE
    ${precompile_UNPARSED_ARGUMENTS} pcl_common OpenMP::OpenMP_CXX pcl_uvol_warnings pcl_uvol_determinism)
  target_include_directories(${name} SYSTEM PRIVATE ${PCL_COMMON_INCLUDE_DIRS})
  target_precompile_headers(${name} PRIVATE <pcl/PCLPointCloud2.h> <pcl/point_cloud.h> <pcl/point_types.h> <Eigen/Dense>
    <algorithm> <array> <cmath> <functional> <limits> <memory> <optional> <sstream> <string> <vector>
    ${precompile_HEADERS})
  # With times in them, ccache would take each for another.
  target_compile_options(${name} PRIVATE "$<$<CXX_COMPILER_ID:Clang>:SHELL:-Xclang -fno-pch-timestamp>")
endfunction()

# ccache has to see which headers these are (-fpch-preprocess).
function(pcl_uvol_reuse_headers target name)
  target_link_libraries(${target} PRIVATE OpenMP::OpenMP_CXX)
  if(PCL_UVOL_PRECOMPILE_HEADERS)
    target_precompile_headers(${target} REUSE_FROM ${name})
    target_compile_options(${target} PRIVATE $<$<CXX_COMPILER_ID:GNU>:-fpch-preprocess>)
  endif()
endfunction()

# Sources are compiled together, a dozen at a time or as many as BATCH says: each source would read the same headers and
# make the same functions of templates again. Sources of one folder are joined, so names in unnamed namespaces are unique
# within a batch, better within the folder; those of tests have namespaces of their own, named as the file, and are joined
# ACROSS_FOLDERS. To be called in the folder of the target, once it has its sources; those with options of their own stay alone.
function(pcl_uvol_unite target)
  if(NOT PCL_UVOL_UNITY)
    return()
  endif()
  cmake_parse_arguments(PARSE_ARGV 1 unite ACROSS_FOLDERS BATCH "")
  if(NOT unite_BATCH)
    set(unite_BATCH 12)
  endif()
  get_target_property(sources ${target} SOURCES)
  list(FILTER sources INCLUDE REGEX "\\.cpp$")
  foreach(source IN LISTS sources)
    cmake_path(GET source PARENT_PATH folder)
    if(unite_ACROSS_FOLDERS)
      set(folder ${target})
    endif()
    string(MAKE_C_IDENTIFIER "count_${folder}" count)
    if(NOT DEFINED ${count})
      set(${count} 0)
    endif()
    math(EXPR part "${${count}} / ${unite_BATCH}")
    math(EXPR ${count} "${${count}} + 1")
    cmake_path(GET folder FILENAME name)
    set_source_files_properties(${source} PROPERTIES UNITY_GROUP ${name}_${part})
  endforeach()
  set_target_properties(${target} PROPERTIES UNITY_BUILD ON UNITY_BUILD_MODE GROUP)
endfunction()

# One copy of the vector kernels per instruction set, and the objects of all of them (src/CMakeLists.txt).
set(pcl_uvol_simd_levels baseline avx2 avx512)
list(TRANSFORM pcl_uvol_simd_levels REPLACE "(.+)" "$<TARGET_OBJECTS:pcl_uvol_kernels_\\1>"
  OUTPUT_VARIABLE pcl_uvol_kernel_objects)

# The part of the installation, a Debian package of its own, that a library belongs to: core needs no VTK, mpi
# is apart from the others, which need VTK. What is needed to compile with mpi, its targets for CMake among it, is
# apart as well: others need no MPI.
set(pcl_uvol_component_of_core core)
set(pcl_uvol_component_of_mpi mpi)
set(pcl_uvol_development_of_mpi mpi_development)
set(pcl_uvol_targets_of_mpi pcl_uvol_mpi_targets)

# A library target pcl_uvol::<name> from the sources of some modules.
function(pcl_uvol_add_library name)
  set(sources)
  foreach(module IN LISTS ARGN)
    file(GLOB_RECURSE module_sources CONFIGURE_DEPENDS ${PROJECT_SOURCE_DIR}/src/${module}/*.cpp)
    list(APPEND sources ${module_sources})
    list(FILTER sources EXCLUDE REGEX "_kernel\\.cpp$")
  endforeach()
  add_library(pcl_uvol_${name} SHARED ${sources})
  if(name STREQUAL "core") # its templates of Eigen take four fifths as long in batches of three dozen
    pcl_uvol_unite(pcl_uvol_core BATCH 36)
  else()
    pcl_uvol_unite(pcl_uvol_${name})
  endif()
  add_library(pcl_uvol::${name} ALIAS pcl_uvol_${name})
  set_target_properties(pcl_uvol_${name} PROPERTIES
    EXPORT_NAME ${name} VERSION ${PROJECT_VERSION}
    SOVERSION ${PROJECT_VERSION_MAJOR}.${PROJECT_VERSION_MINOR} # until 1.0
    INSTALL_RPATH "$ORIGIN")
  target_compile_features(pcl_uvol_${name} PUBLIC cxx_std_17)
  target_include_directories(pcl_uvol_${name} PUBLIC
    $<BUILD_INTERFACE:${PROJECT_SOURCE_DIR}/include> $<INSTALL_INTERFACE:${CMAKE_INSTALL_INCLUDEDIR}>
    PRIVATE ${PROJECT_SOURCE_DIR}/src)
  target_link_libraries(pcl_uvol_${name} PRIVATE
    $<BUILD_INTERFACE:pcl_uvol_warnings> $<BUILD_INTERFACE:pcl_uvol_determinism>)
  target_link_libraries(pcl_uvol_${name} PRIVATE $<BUILD_INTERFACE:pcl_uvol_hardening>)
  set_property(GLOBAL APPEND PROPERTY pcl_uvol_components ${name})
  if(PCL_UVOL_INSTALL)
    set(component libraries)
    set(development development)
    set(targets pcl_uvol_targets)
    foreach(part component development targets)
      if(DEFINED pcl_uvol_${part}_of_${name})
        set(${part} ${pcl_uvol_${part}_of_${name}})
      endif()
    endforeach()
    install(TARGETS pcl_uvol_${name} EXPORT ${targets}
      LIBRARY COMPONENT ${component} NAMELINK_COMPONENT ${development})
  endif()
endfunction()
