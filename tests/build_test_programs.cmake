# Builds all test programs and removes what earlier tests left behind, called with -DBINARY_DIR=...
#
# What is left behind must go: the runner would not run a test again after a change of its scene (it knows only of the
# program), and the program refuses a directory with results of another scene.
#
# Each compiled test of deal.II has a source interrupt_guard.cc; its runner takes one that is in place for the trace of
# an interrupted test and compiles everything again, and puts it aside, with the suffix _bck, after each test. So put
# all of them back in place before the build and aside after it, or nothing built here would be used.

file(GLOB_RECURSE guards "${BINARY_DIR}/tests/interrupt_guard.cc_bck")
foreach(guard ${guards})
  string(REGEX REPLACE "_bck$" "" original "${guard}")
  file(RENAME "${guard}" "${original}")
endforeach()

execute_process(COMMAND ${CMAKE_COMMAND} --build ${BINARY_DIR} --target test_programs --parallel 2
                RESULT_VARIABLE result)

file(GLOB_RECURSE guards "${BINARY_DIR}/tests/interrupt_guard.cc")
foreach(guard ${guards})
  file(RENAME "${guard}" "${guard}_bck")
endforeach()

foreach(leftover output failing_output diff failing_diff results)
  file(GLOB leftovers "${BINARY_DIR}/tests/*/${leftover}" "${BINARY_DIR}/tests/*/*/${leftover}")
  if(leftovers)
    file(REMOVE_RECURSE ${leftovers})
  endif()
endforeach()

if(NOT result EQUAL 0)
  message(FATAL_ERROR "The test programs could not be built.")
endif()
