# Every scene of inputs/ that shows a field is a test (label scene). It is checked, and run if its first line is one of
#   # test: full                run unchanged
#   # test: short OPTION...     run with options of `meniscus run`, e.g. --until 0.02ns
# tools/verify runs the other scenes in full (label verify, configuration full). For each line of the
# form below, it runs a variant of the scene into verification/SCENE-NAME:
#   # verify NAME: OPTION...
# A test passes by the exit code of the program; 7 means a missed expectation of the scene.

meniscus_scenes(scenes)
set_property(DIRECTORY APPEND PROPERTY CMAKE_CONFIGURE_DEPENDS ${scenes})
# Each test uses one thread, and several tests run at once. Results do not depend on threads.
set(scene_environment OMP_WAIT_POLICY=passive OMP_NUM_THREADS=1)

foreach(scene ${scenes})
  cmake_path(GET scene STEM name)
  set(run meniscus run ${scene} --overwrite --output)
  add_test(NAME scene.${name}.check COMMAND meniscus check ${scene})
  set_tests_properties(scene.${name}.check PROPERTIES LABELS scene
    ENVIRONMENT "${scene_environment}")

  file(STRINGS ${scene} first_line LIMIT_COUNT 1)
  if(first_line MATCHES "^# test: (full|short .+)$")
    string(REGEX REPLACE "^(full|short)" "" options "${CMAKE_MATCH_1}")
    separate_arguments(options UNIX_COMMAND "${options}")
    add_test(NAME scene.${name}.run
      COMMAND ${run} ${CMAKE_CURRENT_BINARY_DIR}/scenes/${name} ${options})
    set_tests_properties(scene.${name}.run PROPERTIES LABELS scene
      ENVIRONMENT "${scene_environment}")
  elseif(first_line MATCHES "^# test:")
    message(FATAL_ERROR "${scene}:1: neither '# test: full' nor '# test: short OPTION...'")
  endif()
  if(NOT first_line STREQUAL "# test: full")
    add_test(NAME scene.${name}.full CONFIGURATIONS full
      COMMAND ${run} ${PROJECT_SOURCE_DIR}/verification/${name})
    set_tests_properties(scene.${name}.full PROPERTIES LABELS verify
      ENVIRONMENT OMP_WAIT_POLICY=passive)
  endif()

  file(STRINGS ${scene} variants REGEX "^# verify [a-z]+: ")
  foreach(variant ${variants})
    string(REGEX REPLACE "^# verify ([a-z]+): .*" "\\1" variant_name "${variant}")
    string(REGEX REPLACE "^# verify [a-z]+: " "" options "${variant}")
    separate_arguments(options UNIX_COMMAND "${options}")
    add_test(NAME scene.${name}.${variant_name} CONFIGURATIONS full
      COMMAND ${run} ${PROJECT_SOURCE_DIR}/verification/${name}-${variant_name} ${options})
    set_tests_properties(scene.${name}.${variant_name} PROPERTIES LABELS verify
      ENVIRONMENT OMP_WAIT_POLICY=passive)
  endforeach()
endforeach()
