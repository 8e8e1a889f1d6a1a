# Runs every study in its short form (label verify), which asserts orders and targets. tools/verify
# (configuration full) runs it in full and writes verification/NAME.
file(GLOB study_sources CONFIGURE_DEPENDS ${PROJECT_SOURCE_DIR}/src/study/*.cpp)

foreach(source ${study_sources})
  file(STRINGS ${source} registration REGEX "^const bool registered")
  if(NOT registration)
    continue()  # a part of studies
  endif()
  cmake_path(GET source STEM name)
  add_test(NAME study.${name}.short COMMAND meniscus study ${name} --short
    --output ${CMAKE_CURRENT_BINARY_DIR}/studies/${name})
  add_test(NAME study.${name}.full CONFIGURATIONS full COMMAND meniscus study ${name}
    --output ${PROJECT_SOURCE_DIR}/verification/${name})
  set_tests_properties(study.${name}.short PROPERTIES LABELS verify
    ENVIRONMENT "OMP_WAIT_POLICY=passive;OMP_NUM_THREADS=1")
  set_tests_properties(study.${name}.full PROPERTIES LABELS verify
    PROCESSORS 2 ENVIRONMENT OMP_WAIT_POLICY=passive)
endforeach()
