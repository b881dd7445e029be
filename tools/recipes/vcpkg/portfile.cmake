# SOURCE_PATH: where a release archive was extracted, by vcpkg_from_git or vcpkg_extract_source_archive.
vcpkg_cmake_configure(SOURCE_PATH "${SOURCE_PATH}"
  OPTIONS -DPCL_UVOL_BUILD_EXPRESSIONS=OFF -DPCL_UVOL_BUILD_FILTERS=OFF -DPCL_UVOL_BUILD_GL=OFF
          -DPCL_UVOL_BUILD_MPI=OFF)
vcpkg_cmake_install()
vcpkg_cmake_config_fixup(PACKAGE_NAME pcl_uvol CONFIG_PATH lib/cmake/pcl_uvol)
file(REMOVE_RECURSE "${CURRENT_PACKAGES_DIR}/debug/include")
vcpkg_install_copyright(FILE_LIST "${SOURCE_PATH}/LICENSE")
