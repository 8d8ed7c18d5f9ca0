# What `find_package(axijoint)` reads: the target axijoint::axijoint with modules and libraries. The languages
# C and Fortran must be enabled; the compiler must be the one that axijoint was built with.
include(${CMAKE_CURRENT_LIST_DIR}/axijoint-targets.cmake)
