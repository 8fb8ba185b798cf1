# SPDX-License-Identifier: MIT
# The options with which our own tests, examples and benchmarks are compiled. Only they link these targets.

add_library(hmps_development INTERFACE)
target_link_libraries(hmps_development INTERFACE hmps::hmps)
target_compile_options(
  hmps_development
  INTERFACE -Wall -Wextra -Wpedantic -Wshadow -Wconversion $<$<BOOL:${HMPS_WARNINGS_AS_ERRORS}>:-Werror>)
if(CMAKE_CXX_COMPILER_ID STREQUAL GNU)
  # Collects no garbage below a gigabyte: about a tenth of the compile time for a quarter more memory.
  target_compile_options(hmps_development INTERFACE "SHELL:--param ggc-min-heapsize=1000000")
endif()
if(HMPS_SANITIZE)
  target_compile_options(
    hmps_development INTERFACE -fsanitize=${HMPS_SANITIZE} -fno-sanitize-recover=all -fno-omit-frame-pointer)
  target_link_options(hmps_development INTERFACE -fsanitize=${HMPS_SANITIZE})
  if(HMPS_SANITIZE MATCHES "address" AND HMPS_SANITIZE MATCHES "undefined")
    # The address sanitizer reports these errors when they happen; checking for them before each access as well takes a
    # third of the compile time.
    target_compile_options(hmps_development INTERFACE -fno-sanitize=null,object-size,pointer-overflow,vptr)
  endif()
endif()

# Further warnings with which the small examples are compiled: users enable such warnings and include the headers with
# -I, so they see every warning in the library.
if(CMAKE_CXX_COMPILER_ID STREQUAL GNU)
  set(HMPS_USERS_WARNINGS -Wsign-conversion -Wdouble-promotion -Wuseless-cast -Wold-style-cast -Wnull-dereference
                          -Wextra-semi -Wzero-as-null-pointer-constant -Wundef -Wcast-qual -Wcast-align
                          -Wnon-virtual-dtor -Woverloaded-virtual -Wredundant-decls -Wduplicated-cond -Wduplicated-branches
                          -Wlogical-op -Wformat=2)
else()
  set(HMPS_USERS_WARNINGS -Wsign-conversion -Wdouble-promotion -Wold-style-cast -Wnull-dereference -Wextra-semi
                          -Wzero-as-null-pointer-constant -Wundef -Wcast-qual -Wcast-align -Wnon-virtual-dtor
                          -Woverloaded-virtual -Wcomma -Wshadow-all -Wdeprecated -Wunreachable-code -Wformat=2)
endif()

# For programs that would run for minutes under the sanitizers without optimisation. All others together take longer to
# compile than to run, and two and a half times as long to compile with optimisation. Forced inlining (see
# hmps/core/inline.hpp) would take half as long again to compile, and they run no faster with it.
add_library(hmps_long_running INTERFACE)
if(HMPS_SANITIZE)
  target_compile_options(hmps_long_running INTERFACE -O1 -U__OPTIMIZE__)
endif()

# By default, CMake marks precompiled headers as system headers, for which the compiler gives no warnings. Prevent that.
set(CMAKE_PCH_PROLOGUE "")

# The instruction set of this machine, for the programs whose speed matters.
add_library(hmps_native INTERFACE)
target_compile_options(hmps_native INTERFACE $<$<BOOL:${HMPS_NATIVE}>:-march=native>)
if(CMAKE_CXX_COMPILER_ID STREQUAL GNU AND CMAKE_CXX_COMPILER_VERSION VERSION_LESS 12.3)
  # It warns that variables in its own header for AVX-512 are or may be used uninitialized
  # (https://gcc.gnu.org/PR105593).
  target_compile_options(hmps_native INTERFACE -Wno-maybe-uninitialized -Wno-uninitialized)
endif()

# hmps_parsed_once(<target>): shares one precompiled header. For targets that are compiled with hmps_development and
# hmps_native and no other option that changes code.
function(hmps_parsed_once target)
  if(NOT TARGET hmps_parsed)
    set(empty ${PROJECT_BINARY_DIR}/hmps_parsed.cpp)
    file(CONFIGURE OUTPUT ${empty} CONTENT "")
    add_library(hmps_parsed OBJECT ${empty})
    target_link_libraries(hmps_parsed PRIVATE hmps_development hmps_native)
    target_precompile_headers(hmps_parsed PRIVATE <hmps/hmps.hpp>)
  endif()
  target_precompile_headers(${target} REUSE_FROM hmps_parsed)
endfunction()

# hmps_compiled_together(<target>): with HMPS_UNITY, the sources of the target are compiled together, so that templates
# that several of them use are instantiated once. For this, each source has a namespace of its own, except those with
# SKIP_UNITY_BUILD_INCLUSION.
function(hmps_compiled_together target)
  set_target_properties(${target} PROPERTIES UNITY_BUILD ${HMPS_UNITY} UNITY_BUILD_BATCH_SIZE 0)
endfunction()

# hmps_unit_tests(<target> <prefix> <source>...): adds the sources to the program <target>, which the first call creates
# and registers with ctest.
function(hmps_unit_tests target prefix)
  if(TARGET ${target})
    target_sources(${target} PRIVATE ${ARGN})
    return()
  endif()
  add_executable(${target} ${ARGN})
  hmps_compiled_together(${target})
  gtest_discover_tests(${target} TEST_PREFIX "${prefix}: " DISCOVERY_TIMEOUT 120 PROPERTIES TIMEOUT 600)
endfunction()

# The executors that this machine can run: hmps_openmp and hmps_onetbb exist where the library is found.
set(HMPS_EXECUTORS "")
find_package(OpenMP QUIET COMPONENTS CXX)
if(OpenMP_CXX_FOUND)
  add_library(hmps_openmp INTERFACE)
  target_link_libraries(hmps_openmp INTERFACE OpenMP::OpenMP_CXX)
  list(APPEND HMPS_EXECUTORS openmp)
endif()
find_package(TBB CONFIG QUIET)
if(TARGET TBB::tbb)
  add_library(hmps_onetbb INTERFACE)
  target_link_libraries(hmps_onetbb INTERFACE TBB::tbb)
  list(APPEND HMPS_EXECUTORS onetbb)
endif()
message(STATUS "hmps: executors to be tested: serial ${HMPS_EXECUTORS}")
list(TRANSFORM HMPS_EXECUTORS PREPEND hmps_ OUTPUT_VARIABLE HMPS_EXECUTOR_TARGETS)

# Packages that some of our programs need. hmps_missing(<variable> <target> ...) lists the targets that do not exist.
find_package(CLI11 CONFIG QUIET)
find_package(nlohmann_json CONFIG QUIET)
find_package(PkgConfig QUIET)
if(PkgConfig_FOUND)
  pkg_check_modules(cairo QUIET IMPORTED_TARGET cairo)
endif()
function(hmps_missing variable)
  set(missing "")
  foreach(target IN LISTS ARGN)
    if(NOT TARGET ${target})
      list(APPEND missing ${target})
    endif()
  endforeach()
  set(${variable} ${missing} PARENT_SCOPE)
endfunction()
