# libFuzzer targets (label unit), only in the build with clang's sanitizers. Each starts from a kept
# corpus and runs for half a minute, or for -DMENISCUS_FUZZ_SECONDS. The tested files are compiled
# again with coverage, so that the fuzzer sees which branches are taken.
if(NOT (MENISCUS_SANITIZE AND CMAKE_CXX_COMPILER_ID STREQUAL "Clang"))
  return()
endif()
set(MENISCUS_FUZZ_SECONDS 25 CACHE STRING "Seconds of each fuzz test")

set(src ${PROJECT_SOURCE_DIR}/src)
file(GLOB fuzzed CONFIGURE_DEPENDS ${src}/numbers/*.cpp ${src}/parallel/*.cpp ${src}/input/*.cpp
  ${src}/state/*.cpp ${src}/io/hdf5*.cpp)
foreach(name checkpoint files info meta provenance run_directory)
  list(APPEND fuzzed ${src}/io/${name}.cpp)
endforeach()
add_library(meniscus_fuzzed OBJECT ${fuzzed})
target_include_directories(meniscus_fuzzed PUBLIC ${PROJECT_SOURCE_DIR}/include
  ${src} ${CMAKE_CURRENT_SOURCE_DIR} PRIVATE ${PROJECT_BINARY_DIR}/generated)
target_compile_definitions(meniscus_fuzzed PRIVATE MENISCUS_BUILD_FLAGS="fuzzer")
target_compile_options(meniscus_fuzzed PUBLIC -fsanitize=fuzzer-no-link)
target_link_libraries(meniscus_fuzzed PUBLIC meniscus_options Eigen3::Eigen fmt::fmt hdf5::hdf5
  tomlplusplus::tomlplusplus ${MUPARSER_LIBRARY} OpenSSL::Crypto)
add_dependencies(meniscus_fuzzed meniscus_version)

foreach(reader scene checkpoint)
  add_executable(meniscus_fuzz_${reader} fuzz/fuzz_${reader}.cpp)
  target_link_libraries(meniscus_fuzz_${reader} PRIVATE meniscus_fuzzed -fsanitize=fuzzer)
  # The kept corpus is the second directory; new inputs go into the first.
  file(MAKE_DIRECTORY ${CMAKE_CURRENT_BINARY_DIR}/fuzz/${reader})
  add_test(NAME fuzz.${reader} COMMAND meniscus_fuzz_${reader} -max_total_time=${MENISCUS_FUZZ_SECONDS}
    -max_len=1000 -timeout=20 -rss_limit_mb=2048 -malloc_limit_mb=512 -seed=1 -print_final_stats=1
    -artifact_prefix=${CMAKE_CURRENT_BINARY_DIR}/fuzz/
    ${CMAKE_CURRENT_BINARY_DIR}/fuzz/${reader} ${CMAKE_CURRENT_SOURCE_DIR}/fuzz/corpus_${reader})
  set_tests_properties(fuzz.${reader} PROPERTIES LABELS unit TIMEOUT 3600)
endforeach()
