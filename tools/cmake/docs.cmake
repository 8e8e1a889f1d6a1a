# The documents as HTML, `cmake --build build --target docs`: pandoc writes Markdown documents to docs/ of the
# build tree, doxygen writes the headers to docs/api. Without pandoc or doxygen the part is left out.
find_program(PANDOC pandoc)
find_program(DOXYGEN doxygen)
if(NOT PANDOC AND NOT DOXYGEN)
  return()
endif()
set(docs ${CMAKE_CURRENT_BINARY_DIR}/docs)
set(pages)
if(PANDOC)
  file(GLOB_RECURSE texts CONFIGURE_DEPENDS RELATIVE ${CMAKE_CURRENT_SOURCE_DIR} inputs/*.md src/*.md)
  foreach(text README.md tests/README.md .github/CHANGELOG.md .github/CONTRIBUTING.md ${texts})
    string(REGEX REPLACE "\\.md$" ".html" page ${text})
    cmake_path(GET page PARENT_PATH folder)
    add_custom_command(OUTPUT ${docs}/${page} DEPENDS ${text} tools/docs/page.lua tools/docs/page.css
      COMMAND ${CMAKE_COMMAND} -E make_directory ${docs}/${folder}
      COMMAND ${PANDOC} --from gfm --to html5 --standalone --self-contained
        --lua-filter ${CMAKE_CURRENT_SOURCE_DIR}/tools/docs/page.lua
        --css ${CMAKE_CURRENT_SOURCE_DIR}/tools/docs/page.css
        --resource-path ${CMAKE_CURRENT_SOURCE_DIR}/${folder}
        --output ${docs}/${page} ${CMAKE_CURRENT_SOURCE_DIR}/${text} VERBATIM)
    list(APPEND pages ${docs}/${page})
  endforeach()
endif()
if(DOXYGEN)
  configure_file(tools/docs/Doxyfile.in ${CMAKE_CURRENT_BINARY_DIR}/generated/Doxyfile @ONLY)
  file(GLOB_RECURSE headers CONFIGURE_DEPENDS include/*.hpp src/*.hpp)
  add_custom_command(OUTPUT ${docs}/api/index.html DEPENDS ${headers} tools/docs/Doxyfile.in
    COMMAND ${CMAKE_COMMAND} -E make_directory ${docs}
    COMMAND ${DOXYGEN} ${CMAKE_CURRENT_BINARY_DIR}/generated/Doxyfile VERBATIM)
  list(APPEND pages ${docs}/api/index.html)
endif()
add_custom_target(docs DEPENDS ${pages})
