# SPDX-License-Identifier: GPL-2.0-or-later
# UMFPACK whose calls of the BLAS go to fem/solver/dense_kernels.cpp: the system's BLAS gives other last bits on
# every type of processor. A copy of the static library with the five names changed: what else in the process uses a
# BLAS keeps its own, which a routine of the same name in our programs would replace.
find_path(UMFPACK_INCLUDE_DIR umfpack.h PATH_SUFFIXES suitesparse REQUIRED)
find_library(UMFPACK_ARCHIVE libumfpack.a REQUIRED)
find_library(CHOLMOD_LIBRARY cholmod REQUIRED)
find_library(AMD_LIBRARY amd REQUIRED)
find_library(SUITESPARSECONFIG_LIBRARY suitesparseconfig REQUIRED)

set(umfpack_copy ${PROJECT_BINARY_DIR}/libumfpack_without_blas.a)
set(renamed "")
foreach(routine dgemm dtrsm dtrsv dgemv dger)
  list(APPEND renamed --redefine-sym ${routine}_=polargrain_${routine})
endforeach()
if(NOT EXISTS ${umfpack_copy} OR ${UMFPACK_ARCHIVE} IS_NEWER_THAN ${umfpack_copy}
   OR ${CMAKE_CURRENT_LIST_FILE} IS_NEWER_THAN ${umfpack_copy})
  execute_process(COMMAND ${CMAKE_OBJCOPY} ${renamed} ${UMFPACK_ARCHIVE} ${umfpack_copy} COMMAND_ERROR_IS_FATAL ANY)
endif()

add_library(polargrain_dense_kernels STATIC ${PROJECT_SOURCE_DIR}/fem/solver/dense_kernels.cpp)
target_link_libraries(polargrain_dense_kernels PRIVATE polargrain_options)
target_compile_options(polargrain_dense_kernels PRIVATE -ffp-contract=off)  # the version for AVX-512 could fuse

add_library(polargrain_umfpack INTERFACE)
target_include_directories(polargrain_umfpack SYSTEM INTERFACE ${UMFPACK_INCLUDE_DIR})
target_link_libraries(polargrain_umfpack INTERFACE ${umfpack_copy} polargrain_dense_kernels ${CHOLMOD_LIBRARY} ${AMD_LIBRARY}
                                                   ${SUITESPARSECONFIG_LIBRARY})
