# SPDX-License-Identifier: GPL-2.0-or-later
if(TARGET polargrain AND TARGET polargrain_python)
  foreach(size test long)
    add_executable(study_${size} integration/study_${size}.cpp)
    target_link_libraries(study_${size} PRIVATE polargrain_common polargrain_options fmt::fmt GTest::gtest GTest::gtest_main)
    target_compile_definitions(study_${size} PRIVATE
      POLARGRAIN="$<TARGET_FILE:polargrain>" POLARGRAIN_LIGGGHTS="$<TARGET_FILE:polargrain-liggghts>"
      STUDY="${PROJECT_SOURCE_DIR}/cases/studies/biaxial.py" PYTHON="${Python_EXECUTABLE}"
      PYTHON_PACKAGE="${PROJECT_BINARY_DIR}/python")
    add_dependencies(study_${size} polargrain polargrain-liggghts polargrain_python)
  endforeach()
  gtest_discover_tests(study_test PROPERTIES LABELS integration TIMEOUT ${polargrain_patience} DISCOVERY_TIMEOUT 600)
  # Ten minutes on two cores: on request.
  gtest_discover_tests(study_long PROPERTIES LABELS long TIMEOUT 7200 DISCOVERY_TIMEOUT 600)
  # Layers of grains and a column of cells, reduced: bands as docs/studies/internal_length.md has them (two minutes).
  add_test(NAME LayerStudy.BandsAreAsThePageSays COMMAND /usr/bin/python3 ${PROJECT_SOURCE_DIR}/cases/studies/layer_study.py --check
           -o ${CMAKE_CURRENT_BINARY_DIR}/layer_study --programs ${PROJECT_BINARY_DIR}/app)
  set_tests_properties(LayerStudy.BandsAreAsThePageSays PROPERTIES LABELS long TIMEOUT 3600)
  # A control of it, on two of its three meshes (ten seconds).
  add_test(NAME LayerStudy.WithoutRotationsTheElementIsTheBand
           COMMAND /usr/bin/python3 ${PROJECT_SOURCE_DIR}/cases/studies/layer_controls.py cauchy --check --elements 5 10
           -o ${CMAKE_CURRENT_BINARY_DIR}/layer_controls --programs ${PROJECT_BINARY_DIR}/app)
  set_tests_properties(LayerStudy.WithoutRotationsTheElementIsTheBand PROPERTIES LABELS long TIMEOUT ${polargrain_patience})
  # Specimens between smooth and rough platens, two of 100 grains (five seconds).
  add_test(NAME BiaxialPlatens.RoughOnesMakeSpecimensStronger
           COMMAND ${CMAKE_COMMAND} -E env PYTHONPATH=${PROJECT_BINARY_DIR}/python /usr/bin/python3
           ${PROJECT_SOURCE_DIR}/cases/studies/biaxial_platens.py --check --seeds 2 --grains 100 --strain 0.02
           -o ${CMAKE_CURRENT_BINARY_DIR}/biaxial_platens --programs ${PROJECT_BINARY_DIR}/app ${PROJECT_BINARY_DIR}/app/standalone)
  set_tests_properties(BiaxialPlatens.RoughOnesMakeSpecimensStronger PROPERTIES LABELS long TIMEOUT ${polargrain_patience})
  # Columns of cells with controlled rotations on two meshes, before their peak (ten seconds).
  add_test(NAME LayerStudy.MeshesAgreeBeforeThePeak
           COMMAND ${CMAKE_COMMAND} -E env PYTHONPATH=${PROJECT_BINARY_DIR}/python /usr/bin/python3
           ${PROJECT_SOURCE_DIR}/cases/studies/layer_meshes.py --check --packings 1 --meshes 10 20 --softening
           -o ${CMAKE_CURRENT_BINARY_DIR}/layer_meshes --program ${PROJECT_BINARY_DIR}/app/polargrain)
  set_tests_properties(LayerStudy.MeshesAgreeBeforeThePeak PROPERTIES LABELS long TIMEOUT ${polargrain_patience})
  # A column whose slips drag their neighbours along, and one whose slips do not, on a coarse mesh (half a minute).
  add_test(NAME LayerStudy.ASpreadOfSlipsSlowsSoftening
           COMMAND ${CMAKE_COMMAND} -E env PYTHONPATH=${PROJECT_BINARY_DIR}/python /usr/bin/python3
           ${PROJECT_SOURCE_DIR}/cases/studies/layer_spread.py --check --columns 1 --places 10 --lengths 0 6 --way 1.5
           -o ${CMAKE_CURRENT_BINARY_DIR}/layer_spread)
  set_tests_properties(LayerStudy.ASpreadOfSlipsSlowsSoftening PROPERTIES LABELS long TIMEOUT ${polargrain_patience})
  # Two of the ten packings of docs/studies/far_biaxial.md (five minutes).
  add_test(NAME FarBiaxial.BandsAreFollowedToFifteenPercent
           COMMAND /usr/bin/python3 ${PROJECT_SOURCE_DIR}/cases/studies/far_biaxial.py --check --packings 2 --schemes cell,informed
           -o ${CMAKE_CURRENT_BINARY_DIR}/far_biaxial --programs ${PROJECT_BINARY_DIR}/app)
  set_tests_properties(FarBiaxial.BandsAreFollowedToFifteenPercent PROPERTIES LABELS long TIMEOUT 3600)
endif()
