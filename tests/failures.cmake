# What must not harm a render: kills, bad disks, foreign states (tests/failures/), and the
# schedulers of docs/cluster.md (tests/cluster/). A few of each kind in the ordinary run,
# all of them with the label slow.
add_library(lanelight_faults MODULE failures/faults.cc)
target_link_libraries(lanelight_faults PRIVATE ${CMAKE_DL_LIBS})

foreach(test kill disk foreign)
  set(command Python3::Interpreter ${CMAKE_CURRENT_SOURCE_DIR}/failures/${test}_test.py
              $<TARGET_FILE:lanelight> $<TARGET_FILE:lanelight_faults>)
  add_test(NAME failures/${test} COMMAND ${command})
  set_tests_properties(failures/${test} PROPERTIES LABELS cli TIMEOUT 600)
  add_test(NAME "failures/${test} slow" COMMAND ${command} --full)
  set_tests_properties("failures/${test} slow" PROPERTIES LABELS slow TIMEOUT 3600)
endforeach()

# One after the other: they look at the time.
foreach(test slurm parallel snakemake)
  add_test(NAME cluster/${test}
    COMMAND ${CMAKE_CURRENT_SOURCE_DIR}/cluster/run_${test}.sh $<TARGET_FILE:lanelight>)
  set_tests_properties(cluster/${test} PROPERTIES LABELS cluster TIMEOUT 3600
    SKIP_RETURN_CODE 77 RUN_SERIAL TRUE)
endforeach()
