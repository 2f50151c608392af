# One fuzz target per file of tests/fuzz, with libFuzzer and the address and undefined
# behaviour sanitizers; needs clang and its run-time libraries. Only what reads input is
# compiled again for it. Inputs are first those of fuzz/corpus/<target>, where there are any,
# and those that <target>_ARGUMENTS names; new ones go to the first folder, in the build.
set(parse_fuzz_ARGUMENTS ${CMAKE_CURRENT_SOURCE_DIR}/scene/broken ${CMAKE_SOURCE_DIR}/scenes)
set(nanovdb_fuzz_ARGUMENTS -max_len=121 -len_control=0)  # ten changes
set(LANELIGHT_FUZZ_SECONDS 10 CACHE STRING "Seconds that ctest fuzzes each target")
file(GLOB FUZZ_SOURCES CONFIGURE_DEPENDS ${CMAKE_CURRENT_SOURCE_DIR}/fuzz/*.cc)
if(NOT FUZZ_SOURCES)
  return()
endif()

include(CheckCXXSourceCompiles)
set(CMAKE_REQUIRED_FLAGS "-fsanitize=fuzzer,address,undefined")
check_cxx_source_compiles(
  "extern \"C\" int LLVMFuzzerTestOneInput(const unsigned char*, unsigned long) { return 0; }"
  LANELIGHT_HAS_FUZZER)
unset(CMAKE_REQUIRED_FLAGS)
if(NOT LANELIGHT_HAS_FUZZER)
  message(STATUS "No fuzz targets: ${CMAKE_CXX_COMPILER_ID} has no -fsanitize=fuzzer here")
  return()
endif()

# A static library, so that only what the targets use is linked.
file(GLOB FUZZ_LIBRARY_SOURCES CONFIGURE_DEPENDS
  ${CMAKE_SOURCE_DIR}/src/base/core/*.cc ${CMAKE_SOURCE_DIR}/src/scene/parse/*.cc
  ${CMAKE_SOURCE_DIR}/src/base/image/*.cc ${CMAKE_SOURCE_DIR}/src/vocabulary/strategy/*.cc
  ${CMAKE_SOURCE_DIR}/src/vocabulary/path/*.cc ${CMAKE_SOURCE_DIR}/src/scene/compile/medium_*.cc
  ${CMAKE_SOURCE_DIR}/src/scene/compile/world_frame.cc
  ${CMAKE_CURRENT_SOURCE_DIR}/base/image/sparse_grid_file.cc
  ${CMAKE_CURRENT_SOURCE_DIR}/reference/measured.cc)
# It needs what the build writes of the version.
list(REMOVE_ITEM FUZZ_LIBRARY_SOURCES ${CMAKE_SOURCE_DIR}/src/base/core/version.cc)
set(FUZZ_FLAGS -O1 -gline-tables-only -fno-omit-frame-pointer -fno-sanitize-recover=all)
add_library(lanelight_fuzz_lib STATIC EXCLUDE_FROM_ALL ${FUZZ_LIBRARY_SOURCES})
lanelight_unity(lanelight_fuzz_lib ${FUZZ_LIBRARY_SOURCES})
# Alone, so that those of media which need the rest of the compiler are not linked.
file(GLOB FUZZ_MEDIUM_SOURCES CONFIGURE_DEPENDS
  ${CMAKE_SOURCE_DIR}/src/scene/compile/medium_*.cc)
set_source_files_properties(${CMAKE_SOURCE_DIR}/src/base/image/sparse_grid.cc
  ${CMAKE_SOURCE_DIR}/src/base/image/nanovdb_file.cc ${FUZZ_MEDIUM_SOURCES}
  PROPERTIES SKIP_UNITY_BUILD_INCLUSION ON)
# It goes over many thousand values of each grid, and would take ten times as long.
set_property(SOURCE ${CMAKE_SOURCE_DIR}/src/base/image/sparse_grid.cc APPEND PROPERTY
  COMPILE_OPTIONS -O2 -fno-sanitize-coverage=trace-cmp)
target_compile_options(lanelight_fuzz_lib PRIVATE ${FUZZ_FLAGS}
  -fsanitize=fuzzer-no-link,address,undefined)
target_link_libraries(lanelight_fuzz_lib PUBLIC lanelight_options hwy::hwy TBB::tbb
  OpenEXR::OpenEXR fmt::fmt nlohmann_json::nlohmann_json FastFloat::fast_float
  PkgConfig::STB PkgConfig::BLOSC PkgConfig::XXHASH PkgConfig::UTF8PROC ZLIB::ZLIB PNG::PNG)
target_include_directories(lanelight_fuzz_lib PRIVATE ${NANOVDB_INCLUDE}
  ${QOI_INCLUDE})

add_custom_target(lanelight_fuzz)
foreach(file ${FUZZ_SOURCES})
  get_filename_component(name ${file} NAME_WE)
  add_executable(${name} EXCLUDE_FROM_ALL ${file})
  target_compile_options(${name} PRIVATE ${FUZZ_FLAGS}
    -fsanitize=fuzzer,address,undefined)
  target_link_options(${name} PRIVATE -fsanitize=fuzzer,address,undefined)
  target_compile_definitions(${name} PRIVATE LANELIGHT_SOURCE_DIR="${CMAKE_SOURCE_DIR}")
  target_link_libraries(${name} PRIVATE lanelight_fuzz_lib)
  add_dependencies(lanelight_fuzz ${name})
  set(corpus ${CMAKE_BINARY_DIR}/corpus/${name})
  file(MAKE_DIRECTORY ${corpus})
  set(seeds ${corpus})
  if(EXISTS ${CMAKE_CURRENT_SOURCE_DIR}/fuzz/corpus/${name})
    list(APPEND seeds ${CMAKE_CURRENT_SOURCE_DIR}/fuzz/corpus/${name})
  endif()
  add_test(NAME fuzz/${name} COMMAND ${name} -max_total_time=${LANELIGHT_FUZZ_SECONDS}
    -timeout=10 -rss_limit_mb=2048 -print_final_stats=1 ${seeds}
    ${${name}_ARGUMENTS}
    WORKING_DIRECTORY ${CMAKE_BINARY_DIR})
  set_tests_properties(fuzz/${name} PROPERTIES LABELS fuzz TIMEOUT 300)
endforeach()
