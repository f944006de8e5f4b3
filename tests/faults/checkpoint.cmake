# SPDX-License-Identifier: GPL-2.0-or-later
foreach(topic kill stop disk)
  polargrain_test(checkpoint_${topic}_test faults faults/checkpoint_${topic}_test.cpp LIBS polargrain_app)
  target_compile_definitions(checkpoint_${topic}_test PRIVATE POLARGRAIN="$<TARGET_FILE:fake_polargrain>")
  add_dependencies(checkpoint_${topic}_test fake_polargrain)
endforeach()
if(TARGET polargrain)
  # The same kills with real grains: some minutes.
  polargrain_test(checkpoint_grains_test long faults/checkpoint_grains_test.cpp LIBS polargrain_app)
  target_compile_definitions(checkpoint_grains_test PRIVATE POLARGRAIN="$<TARGET_FILE:polargrain>"
                             POLARGRAIN_SOURCE_DIRECTORY="${PROJECT_SOURCE_DIR}")
  add_dependencies(checkpoint_grains_test polargrain)
endif()

# Streams, directories and signals.
polargrain_test(faults_process_test faults faults/process_test.cpp LIBS polargrain_options)
target_compile_definitions(faults_process_test PRIVATE POLARGRAIN="$<TARGET_FILE:fake_polargrain>")
add_dependencies(faults_process_test fake_polargrain)
polargrain_test(faults_script_trust_test faults faults/script_trust_test.cpp LIBS polargrain_options)
target_compile_definitions(faults_script_trust_test PRIVATE POLARGRAIN="$<TARGET_FILE:fake_polargrain>")
add_dependencies(faults_script_trust_test fake_polargrain)
polargrain_test(faults_library_trust_test faults faults/library_trust_test.cpp LIBS polargrain_options)
target_compile_definitions(faults_library_trust_test PRIVATE POLARGRAIN="$<TARGET_FILE:fake_polargrain>")
add_dependencies(faults_library_trust_test fake_polargrain)
polargrain_test(faults_verify_test faults faults/verify_test.cpp LIBS polargrain_options)
target_compile_definitions(faults_verify_test PRIVATE POLARGRAIN="$<TARGET_FILE:fake_polargrain>")
add_dependencies(faults_verify_test fake_polargrain)
