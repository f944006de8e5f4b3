# SPDX-License-Identifier: GPL-2.0-or-later
# One interface target that every library and program of this project links: warnings are errors in our
# code, and the sanitizers asked for are on. Third-party headers come in as system includes.
add_library(polargrain_options INTERFACE)
target_compile_options(polargrain_options INTERFACE -Wall -Wextra -Werror)
# False alarms of g++ 12 inside std::string, which precompiled headers no longer hide as a system header's.
target_compile_options(polargrain_options INTERFACE -Wno-array-bounds -Wno-restrict -Wno-stringop-overflow
                                             -Wno-stringop-overread)
# Several files that are compiled as one (CMAKE_UNITY_BUILD) are to the compiler headers, in which a nameless namespace is doubtful.
if(CMAKE_UNITY_BUILD)
  target_compile_options(polargrain_options INTERFACE -Wno-subobject-linkage)
endif()
# Before it has used 1 GB g++ collects no garbage, which took it a tenth of its time.
target_compile_options(polargrain_options INTERFACE $<$<CXX_COMPILER_ID:GNU>:--param=ggc-min-heapsize=1048576>)
target_include_directories(polargrain_options INTERFACE ${PROJECT_SOURCE_DIR})
# Eigen divides products of matrices into blocks by the caches that it finds in the processor, which may change the
# order of sums: with its fixed sizes results have the same bits everywhere.
target_compile_definitions(polargrain_options INTERFACE EIGEN_NO_CPUID)
if(POLARGRAIN_SANITIZE)
  target_compile_options(polargrain_options INTERFACE -fsanitize=${POLARGRAIN_SANITIZE} -fno-sanitize-recover=all
                                                     -fno-omit-frame-pointer)
  target_compile_options(polargrain_options INTERFACE -Wno-maybe-uninitialized)  # g++ 12 is wrong about it among the checks
  target_link_options(polargrain_options INTERFACE -fsanitize=${POLARGRAIN_SANITIZE})
  if(POLARGRAIN_SANITIZE_WITHOUT)
    target_compile_options(polargrain_options INTERFACE -fno-sanitize=${POLARGRAIN_SANITIZE_WITHOUT})
  endif()
endif()
# For code that computes little: nearly as quick to compile as without optimisation. A header that is precompiled with another
# level of optimisation brings its own, whatever the command says. It sees less, and g++ 12 takes more for uninitialised that is not.
add_library(polargrain_less_optimised INTERFACE)
target_compile_options(polargrain_less_optimised INTERFACE -O1 -Wno-maybe-uninitialized)
