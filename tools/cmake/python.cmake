# The package for Python: build/python/meniscus has its files and, with -DMENISCUS_PYTHON=ON, the
# extension module, so that PYTHONPATH=build/python is all that is needed.

file(GLOB PYTHON_SOURCES CONFIGURE_DEPENDS src/python/meniscus/*.py src/python/meniscus/*.pyi
  src/python/meniscus/py.typed)
set(PYTHON_PACKAGE ${CMAKE_CURRENT_BINARY_DIR}/python/meniscus)
file(MAKE_DIRECTORY ${PYTHON_PACKAGE})
foreach(source ${PYTHON_SOURCES})
  cmake_path(GET source FILENAME name)
  file(CREATE_LINK ${source} ${PYTHON_PACKAGE}/${name} SYMBOLIC)
endforeach()
install(FILES ${PYTHON_SOURCES} DESTINATION ${CMAKE_INSTALL_DATADIR}/meniscus/python/meniscus)

if(MENISCUS_PYTHON)
  set(Python_EXECUTABLE /usr/bin/python3 CACHE FILEPATH "The Python that loads the extension module")
  find_package(Python REQUIRED COMPONENTS Interpreter Development.Module)
  find_package(pybind11 REQUIRED)
  # From the same object files as the program, as the library.
  pybind11_add_module(meniscus_python MODULE NO_EXTRAS src/python/module.cpp)
  set_target_properties(meniscus_python PROPERTIES OUTPUT_NAME _meniscus UNITY_BUILD OFF
    LIBRARY_OUTPUT_DIRECTORY ${PYTHON_PACKAGE})
  target_compile_options(meniscus_python PRIVATE $<$<CONFIG:Release>:-O1>)
  target_link_libraries(meniscus_python PRIVATE ${meniscus_core})
  install(TARGETS meniscus_python
    LIBRARY DESTINATION ${CMAKE_INSTALL_DATADIR}/meniscus/python/meniscus)
endif()
