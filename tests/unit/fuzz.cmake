# SPDX-License-Identifier: GPL-2.0-or-later
# The fuzz targets of tests/fuzz over their corpus and some mutations of it; under the sanitizers too, being unit tests.

add_library(fuzz_main OBJECT ${PROJECT_SOURCE_DIR}/tests/fuzz/corpus_main.cpp
                             ${PROJECT_SOURCE_DIR}/tests/support/sanitizer_defaults.cpp)
target_link_libraries(fuzz_main PRIVATE polargrain_options)

# polargrain_fuzz_corpus(TARGET MUTATIONS LIBS libraries...)
function(polargrain_fuzz_corpus target mutations)
  cmake_parse_arguments(arg "" "" "LIBS" ${ARGN})
  add_executable(fuzz_${target} ${PROJECT_SOURCE_DIR}/tests/fuzz/${target}.cpp)
  target_link_libraries(fuzz_${target} PRIVATE fuzz_main ${arg_LIBS})
  add_test(NAME fuzz_${target}
           COMMAND fuzz_${target} ${PROJECT_SOURCE_DIR}/tests/fuzz/corpus/${target}.inputs ${mutations})
  set_tests_properties(fuzz_${target} PROPERTIES LABELS unit TIMEOUT ${polargrain_patience})
endfunction()

polargrain_fuzz_corpus(messages 50000 LIBS polargrain_pool)
add_test(NAME fuzz_a_million_messages COMMAND fuzz_messages ${PROJECT_SOURCE_DIR}/tests/fuzz/corpus/messages.inputs 1000000)
set_tests_properties(fuzz_a_million_messages PROPERTIES LABELS long TIMEOUT 7200)
polargrain_fuzz_corpus(fields 1000 LIBS polargrain_band polargrain_fem)
if(TARGET polargrain_gmsh)
  polargrain_fuzz_corpus(meshes 200 LIBS polargrain_fem)
  add_dependencies(fuzz_meshes polargrain_gmsh)
endif()
