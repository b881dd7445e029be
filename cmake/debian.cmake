# Debian packages by CPack, as tools/package.sh makes them: one per component of the installation.
if(NOT PROJECT_IS_TOP_LEVEL)
  return()
endif()
set(soversion ${PROJECT_VERSION_MAJOR}.${PROJECT_VERSION_MINOR})
set(CPACK_GENERATOR DEB)
# Whoever makes packages maintains them: $DEBEMAIL.
set(email "$ENV{DEBEMAIL}")
if(NOT email)
  set(email maintainer@pcl-uvol.invalid)
endif()
set(CPACK_PACKAGE_CONTACT "The pcl_uvol authors <${email}>")
set(CPACK_PACKAGE_VENDOR "The pcl_uvol authors")
set(CPACK_DEB_COMPONENT_INSTALL ON)
set(CPACK_COMPONENTS_GROUPING IGNORE)
set(CPACK_STRIP_FILES ON)
set(CPACK_DEBIAN_FILE_NAME DEB-DEFAULT)
set(CPACK_DEBIAN_PACKAGE_RELEASE 1)
set(CPACK_PRE_BUILD_SCRIPTS ${CMAKE_CURRENT_LIST_DIR}/compress_documents.cmake)
set(CPACK_DEBIAN_PACKAGE_SHLIBDEPS ON)
set(CPACK_DEBIAN_PACKAGE_SHLIBDEPS_PRIVATE_DIRS ${CMAKE_LIBRARY_OUTPUT_DIRECTORY})
set(CPACK_DEBIAN_PACKAGE_GENERATE_SHLIBS ON)
set(CPACK_DEBIAN_PACKAGE_CONTROL_STRICT_PERMISSION ON)
set(CPACK_COMPONENTS_ALL)

# A package of a component. The rest are names of packages that it needs besides what dpkg-shlibdeps finds.
macro(pcl_uvol_debian component package section summary text)
  string(TOUPPER ${component} key)
  list(APPEND CPACK_COMPONENTS_ALL ${component})
  set(CPACK_DEBIAN_${key}_PACKAGE_NAME ${package})
  set(CPACK_DEBIAN_${key}_PACKAGE_SECTION ${section})
  set(CPACK_DEBIAN_${key}_DESCRIPTION "${summary}\n${text}")
  set(needs ${ARGN})
  list(JOIN needs ", " needs)
  set(CPACK_DEBIAN_${key}_PACKAGE_DEPENDS "${needs}")
  install(FILES CHANGELOG.md DESTINATION share/doc/${package} RENAME changelog COMPONENT ${component})
  install(FILES ${PROJECT_BINARY_DIR}/changelog.Debian DESTINATION share/doc/${package} COMPONENT ${component})
  install(FILES LICENSE DESTINATION share/doc/${package} RENAME copyright COMPONENT ${component})
endmacro()

string(TIMESTAMP date "%a, %d %b %Y %H:%M:%S +0000" UTC) # of SOURCE_DATE_EPOCH where that is set
file(WRITE ${PROJECT_BINARY_DIR}/changelog.Debian
  "pcl-uvol (${PROJECT_VERSION}-1) unstable; urgency=medium\n\n  * Packages by tools/package.sh.\n\n -- ${CPACK_PACKAGE_CONTACT}  ${date}\n")
file(WRITE ${PROJECT_BINARY_DIR}/triggers "activate-noawait ldconfig\n")
foreach(key CORE LIBRARIES MPI)
  set(CPACK_DEBIAN_${key}_PACKAGE_CONTROL_EXTRA ${PROJECT_BINARY_DIR}/triggers)
endforeach()
set(same "(= ${PROJECT_VERSION}-1)")
set(libraries_needed "libpcl-uvol-core${soversion} ${same}" "libpcl-uvol${soversion} ${same}")
set(purpose "pcl_uvol extracts isosurfaces straight from scattered samples with scalars, as\n oriented points or closed meshes that carry every field of the samples.")
pcl_uvol_debian(core libpcl-uvol-core${soversion} libs "surfaces from scattered samples: algorithms"
  "${purpose}\n This package has the library without files, pictures of windows and VTK.")
pcl_uvol_debian(libraries libpcl-uvol${soversion} libs "surfaces from scattered samples: files, VTK, OpenGL"
  "${purpose}\n This package has file formats, expressions, OpenGL and filters of VTK."
  "libpcl-uvol-core${soversion} ${same}")
pcl_uvol_debian(development libpcl-uvol-dev libdevel "surfaces from scattered samples: headers"
  "${purpose}\n This package has the headers and the package of CMake."
  ${libraries_needed} libpcl-dev libflann-dev liblz4-dev nlohmann-json3-dev)
if(PCL_UVOL_BUILD_TOOLS)
  pcl_uvol_debian(tools pcl-uvol-tools science "surfaces from scattered samples: command line"
    "${purpose}\n This package has the tools, their manual pages and completion in bash." ${libraries_needed})
endif()
if(TARGET uvol_viewer)
  pcl_uvol_debian(uvol_viewer pcl-uvol-viewer science "surfaces from scattered samples: window"
    "${purpose}\n This package has a window that shows surfaces, with a slider for isovalues."
    ${libraries_needed})
endif()
if(PCL_UVOL_BUILD_PYTHON)
  pcl_uvol_debian(python python3-pcl-uvol python "surfaces from scattered samples: Python module"
    "${purpose}\n This package has the module pcl_uvol." ${libraries_needed} python3 python3-numpy)
endif()
if(PCL_UVOL_BUILD_MPI)
  pcl_uvol_debian(mpi libpcl-uvol-mpi${soversion} libs "surfaces from scattered samples: MPI"
    "${purpose}\n This package has the library for many processes."
    "libpcl-uvol-core${soversion} ${same}")
  pcl_uvol_debian(mpi_development libpcl-uvol-mpi-dev libdevel "surfaces from scattered samples: headers for MPI"
    "${purpose}\n This package has the header for many processes, and CMake's component for it."
    "libpcl-uvol-dev ${same}" "libpcl-uvol-mpi${soversion} ${same}" libvtk9-dev)
  if(TARGET uvol_isosurface_mpi)
    pcl_uvol_debian(uvol_isosurface_mpi pcl-uvol-mpi science "surfaces from scattered samples: tool for MPI"
      "${purpose}\n This package has the tool for many processes."
      ${libraries_needed} "libpcl-uvol-mpi${soversion} ${same}" openmpi-bin)
  endif()
endif()
# The site of tools/docs.sh, once it is there.
set(PCL_UVOL_DOCUMENTATION "" CACHE PATH "Folder of the built documentation, for the package pcl-uvol-doc")
if(PCL_UVOL_DOCUMENTATION)
  install(DIRECTORY ${PCL_UVOL_DOCUMENTATION}/ DESTINATION share/doc/pcl-uvol-doc/html COMPONENT documentation)
  pcl_uvol_debian(documentation pcl-uvol-doc doc "surfaces from scattered samples: documentation"
    "${purpose}\n This package has walkthroughs, the manual and the pages of the API, in HTML.")
  set(CPACK_DEBIAN_DOCUMENTATION_PACKAGE_ARCHITECTURE all)
  set(CPACK_DEBIAN_DOCUMENTATION_PACKAGE_SHLIBDEPS OFF)
endif()
include(CPack)
