# The installed package. The build folder is a package as well: pcl_uvol_DIR may name it.
include(CMakePackageConfigHelpers)
set(config_dir ${CMAKE_INSTALL_LIBDIR}/cmake/pcl_uvol)
get_property(pcl_uvol_components GLOBAL PROPERTY pcl_uvol_components)
configure_package_config_file(src/pcl_uvolConfig.cmake.in ${PROJECT_BINARY_DIR}/pcl_uvolConfig.cmake
  INSTALL_DESTINATION ${config_dir})
write_basic_package_version_file(${PROJECT_BINARY_DIR}/pcl_uvolConfigVersion.cmake
  COMPATIBILITY SameMinorVersion) # until 1.0
install(DIRECTORY include/pcl_uvol DESTINATION ${CMAKE_INSTALL_INCLUDEDIR} COMPONENT development
  PATTERN mpi EXCLUDE)
install(EXPORT pcl_uvol_targets NAMESPACE pcl_uvol:: FILE pcl_uvolTargets.cmake DESTINATION ${config_dir}
  COMPONENT development)
install(FILES ${PROJECT_BINARY_DIR}/pcl_uvolConfig.cmake ${PROJECT_BINARY_DIR}/pcl_uvolConfigVersion.cmake
  DESTINATION ${config_dir} COMPONENT development)
export(EXPORT pcl_uvol_targets NAMESPACE pcl_uvol:: FILE ${PROJECT_BINARY_DIR}/pcl_uvolTargets.cmake)
if(PCL_UVOL_BUILD_MPI)
  install(DIRECTORY include/pcl_uvol/mpi DESTINATION ${CMAKE_INSTALL_INCLUDEDIR}/pcl_uvol COMPONENT mpi_development)
  install(EXPORT pcl_uvol_mpi_targets NAMESPACE pcl_uvol:: FILE pcl_uvolMpiTargets.cmake DESTINATION ${config_dir}
    COMPONENT mpi_development)
  export(EXPORT pcl_uvol_mpi_targets NAMESPACE pcl_uvol:: FILE ${PROJECT_BINARY_DIR}/pcl_uvolMpiTargets.cmake)
endif()
