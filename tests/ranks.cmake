# Renders with several ranks, where the program for them is built (LANELIGHT_MPI).
if(NOT LANELIGHT_MPI)
  return()
endif()

add_executable(lanelight_failing_rank render/ranks/failing_rank.cc)
target_link_libraries(lanelight_failing_rank PRIVATE lanelight_ranks)
set_target_properties(lanelight_failing_rank PROPERTIES
  RUNTIME_OUTPUT_DIRECTORY ${CMAKE_BINARY_DIR}/mpi)

file(STRINGS ${CMAKE_CURRENT_SOURCE_DIR}/render/ranks/ranks_test.py cases REGEX "^def test_")
foreach(line ${cases})
  string(REGEX REPLACE "^def test_([a-z_]*).*" "\\1" case "${line}")
  add_test(NAME ranks/${case}
    COMMAND Python3::Interpreter ${CMAKE_CURRENT_SOURCE_DIR}/render/ranks/ranks_test.py ${case}
            $<TARGET_FILE:lanelight> $<TARGET_FILE:lanelight_mpi>
            $<TARGET_FILE:lanelight_failing_rank> ${MPIEXEC_EXECUTABLE}
            ${CMAKE_SOURCE_DIR}/scenes)
  # Ranks that wait for a core hold up all others.
  set_tests_properties(ranks/${case} PROPERTIES LABELS mpi TIMEOUT 600 PROCESSORS 2)
endforeach()
