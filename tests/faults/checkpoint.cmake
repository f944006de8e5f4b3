# SPDX-License-Identifier: GPL-2.0-or-later
foreach(topic kill stop disk)
  polargrain_test(checkpoint_${topic}_test faults faults/checkpoint_${topic}_test.cpp LIBS polargrain_app)
  target_compile_definitions(checkpoint_${topic}_test PRIVATE POLARGRAIN="$<TARGET_FILE:fake_polargrain>")
  add_dependencies(checkpoint_${topic}_test fake_polargrain)
endforeach()
if(TARGET polargrain)
  # The same kills with real grains: some minutes.
  polargrain_test(checkpoint_grains_test long faults/checkpoint_grains_test.cpp LIBS polargrain_app)
  target_compile_definitions(checkpoint_grains_test PRIVATE POLARGRAIN="$<TARGET_FILE:polargrain>")
  add_dependencies(checkpoint_grains_test polargrain)
endif()

find_package(nlohmann_json REQUIRED)
# Streams, directories and signals; whom to trust with what; results that carry their proof.
foreach(topic process script_trust library_trust verify doors)
  polargrain_test(faults_${topic}_test faults faults/${topic}_test.cpp LIBS polargrain_options nlohmann_json::nlohmann_json)
  target_compile_definitions(faults_${topic}_test PRIVATE POLARGRAIN="$<TARGET_FILE:fake_polargrain>")
  add_dependencies(faults_${topic}_test fake_polargrain)
endforeach()
