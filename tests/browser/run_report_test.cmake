# Writes the synthetic report with the C++ tests, then looks at it in the browser:
# cmake -DTESTS=lanelight_tests -DPYTHON=python3 -DFOLDER=... -P run_report_test.cmake
# The browser's test prints "skipped: ..." where there is no browser.
file(MAKE_DIRECTORY ${FOLDER})
set(ENV{LANELIGHT_SYNTHETIC_REPORT} ${FOLDER}/report.html)
execute_process(COMMAND ${TESTS} "The synthetic report can be written"
                RESULT_VARIABLE result OUTPUT_VARIABLE output)
if(NOT result EQUAL 0)
  message(FATAL_ERROR "no report: ${output}")
endif()
execute_process(COMMAND ${PYTHON} ${CMAKE_CURRENT_LIST_DIR}/report_test.py
                        ${FOLDER}/report.html ${FOLDER}/screenshots
                RESULT_VARIABLE result)
if(NOT result EQUAL 0 AND NOT result EQUAL 77)
  message(FATAL_ERROR "the browser's test failed: ${result}")
endif()
