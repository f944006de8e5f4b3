# SPDX-License-Identifier: GPL-2.0-or-later
# Half of the time of a compilation went into reading the same headers of Eigen, fmt and the standard library: they are
# read once for the libraries and once more, with GoogleTest, for the tests.
if(CMAKE_CXX_COMPILER_LAUNCHER MATCHES ccache AND NOT CMAKE_CXX_FLAGS MATCHES "-fpch-preprocess")
  add_compile_options($<$<COMPILE_LANGUAGE:CXX>:-fpch-preprocess>)  # or it knows no file that was compiled with such a header
endif()

function(polargrain_precompile name)  # polargrain_precompile(NAME headers...): a library to reuse from
  set(source ${CMAKE_CURRENT_BINARY_DIR}/${name}.cpp)
  file(CONFIGURE OUTPUT ${source} CONTENT "// Nothing but precompiled headers.\n")
  add_library(${name} OBJECT ${source})
  target_precompile_headers(${name} PRIVATE ${ARGN})
endfunction()

# Libraries that go into shared libraries too (the Python package, the MGIS behaviour): their code can lie anywhere in
# memory, and precompiled headers must have been made for that.
function(polargrain_goes_into_shared_libraries)  # polargrain_goes_into_shared_libraries(targets...)
  set_target_properties(${ARGN} PROPERTIES POSITION_INDEPENDENT_CODE ON)
  foreach(target ${ARGN})
    target_precompile_headers(${target} REUSE_FROM polargrain_precompiled_shared)
  endforeach()
endfunction()
