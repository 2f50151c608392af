# lanelight_kernel_groups(TARGET FILES ALONE...): adds kernel files to a target, those of a
# folder some at a time in one file, except those to be compiled alone. Highway's headers,
# which every kernel file includes once per SIMD target, are most of what a small kernel
# costs to compile. CMake's own unity builds cannot do that: what includes itself for each
# target has to be the whole group. Names in the namespace of a target must differ within a
# folder, as they must anyway where they are not in an unnamed one.
function(lanelight_kernel_groups target files)
  foreach(file ${ARGN})
    list(APPEND alone ${CMAKE_SOURCE_DIR}/${file})
  endforeach()
  if(NOT LANELIGHT_UNITY)
    set(alone ${files})
  endif()
  foreach(file ${alone})
    lanelight_each_target(${file})
  endforeach()
  target_sources(${target} PRIVATE ${alone})
  list(REMOVE_ITEM files ${alone})
  # None takes much longer than another, nor more than 1 GB of memory to compile.
  set(group_size 8)
  if(num_targets GREATER 1 OR LANELIGHT_SANITIZE)
    set(group_size 4)
  endif()
  foreach(file ${files})
    get_filename_component(folder ${file} DIRECTORY)
    get_filename_component(folder ${folder} NAME)
    list(APPEND folders ${folder})
    list(APPEND of_${folder} ${file})
  endforeach()
  list(REMOVE_DUPLICATES folders)
  foreach(folder ${folders})
    list(LENGTH of_${folder} count)
    math(EXPR parts "(${count} + ${group_size} - 1) / ${group_size}")
    foreach(part RANGE 1 ${parts})
      # Shares as equal as they can be.
      math(EXPR begin "${count} * (${part} - 1) / ${parts}")
      math(EXPR length "${count} * ${part} / ${parts} - ${begin}")
      list(SUBLIST of_${folder} ${begin} ${length} members)
      set(group ${CMAKE_BINARY_DIR}/generated/kernels_${folder}_${part}.cc)
      lanelight_write_group(${group} "${members}")
      target_sources(${target} PRIVATE ${group})
    endforeach()
  endforeach()
endfunction()

# A file that includes the others, and is what is included again for every target.
function(lanelight_write_group group members)
  set(text "// Written by cmake/kernel_groups.cmake.\n#define HWY_TARGET_INCLUDE \"${group}\"\n")
  foreach(file ${members})
    string(APPEND text "#include \"${file}\"\n")
  endforeach()
  file(CONFIGURE OUTPUT ${group} CONTENT "${text}" @ONLY)
endfunction()

# A file with vector code that is compiled alone is included again for every target itself.
function(lanelight_each_target file)
  cmake_path(ABSOLUTE_PATH file BASE_DIRECTORY ${CMAKE_CURRENT_SOURCE_DIR})
  set_source_files_properties(${file} PROPERTIES
    COMPILE_DEFINITIONS "HWY_TARGET_INCLUDE=\"${file}\"")
endfunction()

# Takes back what guards the headers of kernels, so that they are read again for another
# target.
file(GLOB_RECURSE guards CONFIGURE_DEPENDS RELATIVE ${CMAKE_SOURCE_DIR}/kernels kernels/*-inl.h)
list(REMOVE_ITEM guards simd/each_target-inl.h)
list(TRANSFORM guards REPLACE "[/.-]" "_")
list(TRANSFORM guards TOUPPER)
list(TRANSFORM guards REPLACE "(.+)" "#undef LANELIGHT_\\1_\n")
list(JOIN guards "" guards)
file(CONFIGURE OUTPUT ${CMAKE_BINARY_DIR}/generated/kernel_guards.h CONTENT "${guards}" @ONLY)
