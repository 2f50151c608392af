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
    target_sources(${target} PRIVATE ${files})
    return()
  endif()
  target_sources(${target} PRIVATE ${alone})
  list(REMOVE_ITEM files ${alone})
  # What all targets of a group take of memory to compile is to stay below 1 GB.
  set(group_size 16)
  if(num_targets GREATER 1)
    set(group_size 6)
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

# A file that includes the others. Each of them says that itself is to be included for
# every target; the last word has the group.
function(lanelight_write_group group members)
  set(again "#undef HWY_TARGET_INCLUDE\n#define HWY_TARGET_INCLUDE \"${group}\"\n")
  set(text "// Written by cmake/kernel_groups.cmake.\n#include \"kernels/targets.h\"\n${again}")
  string(APPEND text "#include \"hwy/foreach_target.h\"\n")
  foreach(file ${members})
    string(APPEND text "#include \"${file}\"\n")
  endforeach()
  string(APPEND text "${again}")
  file(CONFIGURE OUTPUT ${group} CONTENT "${text}" @ONLY)
endfunction()
