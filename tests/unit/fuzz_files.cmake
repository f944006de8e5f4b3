# SPDX-License-Identifier: GPL-2.0-or-later
# Files of users, broken in every way. With clang and -DPOLARGRAIN_FUZZ=ON the target `fuzz_files` is a coverage-guided
# fuzzer (libFuzzer); with any compiler `fuzz_files_test` runs mutations with a fixed seed, also under the sanitizers.
polargrain_test(fuzz_files_test unit fuzz/files_test.cpp fuzz/files.cpp support/sanitizer_defaults.cpp LIBS polargrain_app)
if(POLARGRAIN_FUZZ)
  add_executable(fuzz_files fuzz/files.cpp fuzz/files_fuzzer.cpp)
  target_link_libraries(fuzz_files PRIVATE polargrain_app -fsanitize=fuzzer)
endif()
# Text packings and HDF5 ones; the corpus is that of a coverage-guided run of fuzz.sh.
polargrain_fuzz_corpus(packings 1500 LIBS polargrain_common)
