# Compiles for 64-bit ARM on another machine (docs/arm64.md): clang and lld know all
# processors; Debian's packages for arm64 are unpacked in build/arm64/root, by
# `./run build --arm64`.
set(CMAKE_SYSTEM_NAME Linux)
set(CMAKE_SYSTEM_PROCESSOR aarch64)

cmake_path(SET ARM64_ROOT NORMALIZE "${CMAKE_CURRENT_LIST_DIR}/../build/arm64/root")
if(NOT EXISTS ${ARM64_ROOT}/packages)
  message(FATAL_ERROR "No packages for arm64 in ${ARM64_ROOT}: "
    "`./run build --arm64` unpacks them there")
endif()
set(CMAKE_SYSROOT ${ARM64_ROOT})

# Programs of this machine only, everything else of the root only.
set(CMAKE_FIND_ROOT_PATH_MODE_PROGRAM NEVER)
set(CMAKE_FIND_ROOT_PATH_MODE_LIBRARY ONLY)
set(CMAKE_FIND_ROOT_PATH_MODE_INCLUDE ONLY)
set(CMAKE_FIND_ROOT_PATH_MODE_PACKAGE ONLY)
set(ENV{PKG_CONFIG_SYSROOT_DIR} ${ARM64_ROOT})
set(ENV{PKG_CONFIG_LIBDIR}
  ${ARM64_ROOT}/usr/lib/aarch64-linux-gnu/pkgconfig:${ARM64_ROOT}/usr/share/pkgconfig)

find_program(CMAKE_CXX_COMPILER clang++-19 REQUIRED)
set(CMAKE_CXX_COMPILER_TARGET aarch64-linux-gnu)
set(CMAKE_EXE_LINKER_FLAGS_INIT -fuse-ld=lld)
set(CMAKE_MODULE_LINKER_FLAGS_INIT -fuse-ld=lld)

# Runs programs for ARM on this machine. It opens files of the root before this machine's.
find_program(LANELIGHT_QEMU qemu-aarch64 REQUIRED)
set(CMAKE_CROSSCOMPILING_EMULATOR ${LANELIGHT_QEMU} -L ${ARM64_ROOT})
