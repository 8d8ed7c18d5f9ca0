# Finds what axijoint is linked to, and says all that is missing at once: target `libraries`. Where to look: -D
# CMAKE_PREFIX_PATH="DIRECTORY;..." and HDF5_ROOT; another BLAS with LAPACK: -D BLA_VENDOR=NAME.
if(NOT DEFINED BLA_VENDOR)
   set(BLA_VENDOR OpenBLAS)
endif()
find_package(LAPACK QUIET)
find_package(HDF5 QUIET COMPONENTS Fortran)
find_library(METIS_LIBRARY metis)
find_library(CHOLMOD_LIBRARY cholmod)
find_path(CHOLMOD_INCLUDE_DIR suitesparse/cholmod.h)

set(missing)
foreach(known
      "LAPACK_FOUND/BLAS and LAPACK (${BLA_VENDOR})"
      "HDF5_Fortran_FOUND/HDF5 with its Fortran modules, made by this gfortran (h5fc on the PATH, or HDF5_ROOT)"
      "METIS_LIBRARY/METIS 5"
      "CHOLMOD_LIBRARY/CHOLMOD of SuiteSparse"
      "CHOLMOD_INCLUDE_DIR/suitesparse/cholmod.h, the header of CHOLMOD")
   string(REGEX MATCH "^([A-Za-z0-9_]+)/(.*)" ignored ${known})
   if(NOT ${CMAKE_MATCH_1})
      string(APPEND missing "\n  ${CMAKE_MATCH_2}")
   endif()
endforeach()
if(missing)
   message(FATAL_ERROR "axijoint lacks:${missing}\n(doc/install.md says where they come from)")
endif()

add_library(libraries INTERFACE)
add_library(axijoint::libraries ALIAS libraries)
target_include_directories(libraries INTERFACE ${HDF5_Fortran_INCLUDE_DIRS} ${CHOLMOD_INCLUDE_DIR})
target_compile_options(libraries INTERFACE -fopenmp)
target_link_options(libraries INTERFACE -fopenmp)
target_link_libraries(libraries INTERFACE ${HDF5_Fortran_LIBRARIES} ${LAPACK_LIBRARIES}
   ${CHOLMOD_LIBRARY} ${METIS_LIBRARY} m)
