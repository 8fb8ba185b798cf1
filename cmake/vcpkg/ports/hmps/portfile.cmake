# SPDX-License-Identifier: MIT
# An overlay port of the clone in which it lies: vcpkg install hmps --overlay-ports=<clone>/cmake/vcpkg/ports
set(VCPKG_BUILD_TYPE release) # there are only headers
get_filename_component(SOURCE_PATH "${CMAKE_CURRENT_LIST_DIR}/../../../.." ABSOLUTE)

vcpkg_cmake_configure(
  SOURCE_PATH "${SOURCE_PATH}"
  OPTIONS -DHMPS_BUILD_TESTS=OFF -DHMPS_BUILD_EXAMPLES=OFF -DHMPS_BUILD_BENCHMARKS=OFF
          -DHMPS_DOWNLOAD_DEPENDENCIES=OFF)
vcpkg_cmake_install()
vcpkg_cmake_config_fixup(CONFIG_PATH share/cmake/hmps)
vcpkg_fixup_pkgconfig()
file(REMOVE_RECURSE "${CURRENT_PACKAGES_DIR}/share/doc")
vcpkg_install_copyright(FILE_LIST "${SOURCE_PATH}/LICENSE")
file(INSTALL "${CMAKE_CURRENT_LIST_DIR}/usage" DESTINATION "${CURRENT_PACKAGES_DIR}/share/${PORT}")
