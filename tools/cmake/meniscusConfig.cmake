# The file that find_package(meniscus) reads in an installed tree: the target meniscus::meniscus.
include(CMakeFindDependencyMacro)
find_dependency(Eigen3 3.4 NO_MODULE)
find_dependency(fmt)
find_dependency(OpenMP COMPONENTS CXX)
include("${CMAKE_CURRENT_LIST_DIR}/meniscusTargets.cmake")
