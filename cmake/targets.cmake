# LANELIGHT_TARGETS: which SIMD targets kernels are compiled for. What each is, and why no
# others, is said in kernels/targets.h. Sets KERNEL_OPTIONS, which everything that has
# vector code is compiled with.
set(LANELIGHT_TARGETS all CACHE STRING
  "SIMD targets to compile kernels for: \"native\", the best that this machine runs; or a \
list, the best first, of \"all\", AVX3, AVX2, SSE4, NEON, EMU128 (plain C++, for machines \
without any, slow to build and to run)")

if(CMAKE_SYSTEM_PROCESSOR MATCHES "^(x86_64|amd64|AMD64)$")
  set(all_targets AVX3 AVX2 SSE4)
elseif(CMAKE_SYSTEM_PROCESSOR MATCHES "^(aarch64|arm64)$")
  set(all_targets NEON)
else()
  set(all_targets EMU128)
endif()

# The best target by the detection that the program uses at run time.
function(lanelight_native_target result)
  if(CMAKE_CROSSCOMPILING)
    message(FATAL_ERROR "LANELIGHT_TARGETS=native is for this machine, "
      "and the build for another one")
  endif()
  list(JOIN all_targets "," names)
  unset(ran CACHE)
  try_run(ran compiled SOURCES ${CMAKE_SOURCE_DIR}/cmake/native_target.cc
    COMPILE_DEFINITIONS "-DLANELIGHT_ALL_TARGETS=${names}"
    LINK_LIBRARIES hwy::hwy CXX_STANDARD 20
    COMPILE_OUTPUT_VARIABLE log RUN_OUTPUT_VARIABLE target)
  unset(ran CACHE)
  if(NOT compiled)
    message(FATAL_ERROR "cmake/native_target.cc does not compile:\n${log}")
  endif()
  string(STRIP "${target}" target)
  if(target STREQUAL "")
    list(JOIN all_targets ", " names)
    message(FATAL_ERROR "This machine's processor runs none of the SIMD targets ${names}. "
      "Kernels in plain C++ run on any, thirty times slower: `./run demo --simd EMU128`, "
      "or -DLANELIGHT_TARGETS=EMU128.")
  endif()
  set(${result} ${target} PARENT_SCOPE)
endfunction()

if(LANELIGHT_TARGETS STREQUAL "native")
  lanelight_native_target(targets)
  message(STATUS "SIMD target of this machine: ${targets}")
else()
  list(TRANSFORM LANELIGHT_TARGETS REPLACE "^all$" "${all_targets}" OUTPUT_VARIABLE targets)
  string(TOUPPER "${targets}" targets)
endif()
set(legal ${all_targets} EMU128)
list(REMOVE_DUPLICATES legal)
foreach(target ${targets})
  if(NOT target IN_LIST legal)
    list(JOIN legal ", " names)
    message(FATAL_ERROR "LANELIGHT_TARGETS: '${target}' is none of ${names}")
  endif()
endforeach()
if("EMU128" IN_LIST targets AND CMAKE_CXX_COMPILER_ID STREQUAL "GNU"
   AND CMAKE_CXX_COMPILER_VERSION VERSION_LESS 12.3)
  message(FATAL_ERROR "g++ ${CMAKE_CXX_COMPILER_VERSION} compiles Highway's EMU128 wrongly "
    "(its bug 106322); g++ 12.3, or clang, does not: CXX=clang++-19")
endif()

# Highway is told the list, and that the last of it may be taken for granted. (And what
# cmake/kernel_groups.cmake writes is found.)
list(TRANSFORM targets PREPEND "HWY_" OUTPUT_VARIABLE bits)
list(GET bits -1 floor)
list(JOIN bits "|" bits)
set(HIGHWAY_OPTIONS "-DLANELIGHT_TARGETS=(${bits})" -DLANELIGHT_FLOOR_TARGET=${floor}
  -I${CMAKE_BINARY_DIR})
set(KERNEL_OPTIONS ${HIGHWAY_OPTIONS})

# With one target, all vector code is of it, and the compiler may know: these are the
# features that Highway names function by function (HWY_TARGET_STR), and no
# others, so that the same instructions are there as among several targets. It then hands
# vectors over in registers instead of memory, even where a call disappears: half the time
# to compile. With several targets that would let code of one into functions of all.
set(features_SSE4 -mssse3 -msse4.1 -msse4.2 -mpclmul -maes)
set(features_AVX2 ${features_SSE4} -mavx -mavx2 -mbmi -mbmi2 -mfma -mf16c)
set(features_AVX3 ${features_AVX2} -mavx512f -mavx512vl -mavx512dq -mavx512bw)
list(LENGTH targets num_targets)
if(num_targets EQUAL 1)
  list(APPEND KERNEL_OPTIONS ${features_${targets}})
endif()
