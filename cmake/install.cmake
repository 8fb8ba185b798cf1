# SPDX-License-Identifier: MIT
# Installs the headers, the CMake package and the pkg-config file. If Eigen or nanoflann was downloaded because no
# package was installed, its headers are installed too, so that the package of hmps works without them.
include(CMakePackageConfigHelpers)

set(HMPS_CMAKE_DIR ${CMAKE_INSTALL_DATADIR}/cmake/hmps)
set(HMPS_BUNDLE_DIR ${CMAKE_INSTALL_DATADIR}/hmps/third_party)

install(TARGETS hmps EXPORT hmpsTargets)
install(DIRECTORY include/hmps DESTINATION ${CMAKE_INSTALL_INCLUDEDIR} FILES_MATCHING PATTERN "*.hpp")
install(EXPORT hmpsTargets NAMESPACE hmps:: DESTINATION ${HMPS_CMAKE_DIR})
# For parent projects that export() a target of theirs from the build tree. An Eigen that the parent defines itself
# would have to be in such an export set too.
get_target_property(HMPS_EIGEN_IS_PACKAGE Eigen3::Eigen IMPORTED)
get_target_property(HMPS_NANOFLANN_IS_PACKAGE nanoflann::nanoflann IMPORTED)
if(HMPS_EIGEN_IS_PACKAGE AND HMPS_NANOFLANN_IS_PACKAGE)
  export(EXPORT hmpsTargets NAMESPACE hmps::)
endif()

configure_package_config_file(
  cmake/hmpsConfig.cmake.in hmpsConfig.cmake
  INSTALL_DESTINATION ${HMPS_CMAKE_DIR}
  PATH_VARS HMPS_BUNDLE_DIR
  NO_SET_AND_CHECK_MACRO)
# Before 1.0 a new minor version may change the interface.
write_basic_package_version_file(hmpsConfigVersion.cmake COMPATIBILITY SameMinorVersion ARCH_INDEPENDENT)
install(FILES ${CMAKE_CURRENT_BINARY_DIR}/hmpsConfig.cmake ${CMAKE_CURRENT_BINARY_DIR}/hmpsConfigVersion.cmake
              cmake/build_type.cmake cmake/find.cmake DESTINATION ${HMPS_CMAKE_DIR})

# hmps.pc gives folders relative to its own, so that the installed tree can be moved.
set(HMPS_PC_DIR ${CMAKE_INSTALL_DATADIR}/pkgconfig)
file(RELATIVE_PATH HMPS_PC_PREFIX ${CMAKE_INSTALL_FULL_DATADIR}/pkgconfig ${CMAKE_INSTALL_PREFIX})
file(RELATIVE_PATH HMPS_PC_INCLUDE ${CMAKE_INSTALL_PREFIX} ${CMAKE_INSTALL_FULL_INCLUDEDIR})
file(RELATIVE_PATH HMPS_PC_BUNDLE ${CMAKE_INSTALL_PREFIX} ${CMAKE_INSTALL_FULL_DATADIR}/hmps/third_party)
string(REGEX REPLACE "/$" "" HMPS_PC_PREFIX "${HMPS_PC_PREFIX}")
set(HMPS_PC_REQUIRES "")
set(HMPS_PC_CFLAGS "")
foreach(package IN ITEMS Eigen3 nanoflann)
  if(package IN_LIST HMPS_BUNDLED)
    string(APPEND HMPS_PC_CFLAGS " -I\${prefix}/${HMPS_PC_BUNDLE}/${package}")
  else()
    string(TOLOWER ${package} module)
    string(APPEND HMPS_PC_REQUIRES " ${module} >= ${HMPS_${package}_VERSION}")
  endif()
endforeach()
configure_file(cmake/hmps.pc.in hmps.pc @ONLY)
install(FILES ${CMAKE_CURRENT_BINARY_DIR}/hmps.pc DESTINATION ${HMPS_PC_DIR})

install(FILES LICENSE DESTINATION ${CMAKE_INSTALL_DATADIR}/doc/hmps)

if("Eigen3" IN_LIST HMPS_BUNDLED)
  install(DIRECTORY ${HMPS_Eigen3_HEADERS}/Eigen DESTINATION ${HMPS_BUNDLE_DIR}/Eigen3)
  file(GLOB licences ${HMPS_Eigen3_HEADERS}/COPYING.*)
  install(FILES ${licences} DESTINATION ${HMPS_BUNDLE_DIR}/Eigen3)
endif()
if("nanoflann" IN_LIST HMPS_BUNDLED)
  install(FILES ${HMPS_nanoflann_HEADERS}/nanoflann.hpp DESTINATION ${HMPS_BUNDLE_DIR}/nanoflann)
endif()
