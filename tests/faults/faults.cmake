# SPDX-License-Identifier: GPL-2.0-or-later
# Things that die, hang, lie or come uninvited.
add_executable(faulty_line faults/faulty_line.cpp)
target_link_libraries(faulty_line PRIVATE polargrain_pool)
add_executable(strange_worker faults/strange_worker.cpp)
target_link_libraries(strange_worker PRIVATE polargrain_pool polargrain_fake_engine)

polargrain_test(faults_messages_test faults faults/messages_test.cpp LIBS polargrain_pool polargrain_fake_engine)
target_compile_definitions(faults_messages_test PRIVATE
  FAKE_WORKER="$<TARGET_FILE:fake_worker>" FAULTY_LINE="$<TARGET_FILE:faulty_line>"
  STRANGE_WORKER="$<TARGET_FILE:strange_worker>")
add_dependencies(faults_messages_test fake_worker faulty_line strange_worker)

polargrain_test(faults_guests_test faults faults/guests_test.cpp LIBS polargrain_pool polargrain_fake_engine)
target_compile_definitions(faults_guests_test PRIVATE FAKE_WORKER="$<TARGET_FILE:fake_worker>")
add_dependencies(faults_guests_test fake_worker)

polargrain_test(faults_liars_test faults faults/liars_test.cpp LIBS polargrain_pool polargrain_fake_engine)
target_compile_definitions(faults_liars_test PRIVATE FAKE_WORKER="$<TARGET_FILE:fake_worker>"
                                                     STRANGE_WORKER="$<TARGET_FILE:strange_worker>")
add_dependencies(faults_liars_test fake_worker strange_worker)

polargrain_test(faults_kills_test faults faults/kills_test.cpp LIBS polargrain_options Threads::Threads)
target_compile_definitions(faults_kills_test PRIVATE FAKE_POLARGRAIN="$<TARGET_FILE:fake_polargrain>")
add_dependencies(faults_kills_test fake_polargrain)

if(TARGET polargrain)
  polargrain_test(faults_engine_kills_test long faults/engine_kills_test.cpp LIBS polargrain_options Threads::Threads)
  target_compile_definitions(faults_engine_kills_test PRIVATE POLARGRAIN="$<TARGET_FILE:polargrain>")
  add_dependencies(faults_engine_kills_test polargrain)
endif()

if(TARGET polargrain)
  add_test(NAME slurm COMMAND ${CMAKE_CURRENT_SOURCE_DIR}/faults/slurm.sh $<TARGET_FILE:polargrain>
           ${PROJECT_SOURCE_DIR}/cases/biaxial/case.yaml --set steps.count=1 --set mesh.rectangle.elements=[1,2])
  set_tests_properties(slurm PROPERTIES COST 300 LABELS faults SKIP_RETURN_CODE 77 TIMEOUT ${polargrain_patience})
endif()

polargrain_test(faults_checks_test faults faults/checks_test.cpp LIBS polargrain_pool polargrain_fake_engine)
target_compile_definitions(faults_checks_test PRIVATE FAKE_WORKER="$<TARGET_FILE:fake_worker>"
                                                      FAKE_POLARGRAIN="$<TARGET_FILE:fake_polargrain>")
add_dependencies(faults_checks_test fake_worker fake_polargrain)

polargrain_test(faults_confinement_test faults faults/confinement_test.cpp LIBS polargrain_options)
target_compile_definitions(faults_confinement_test PRIVATE FAKE_POLARGRAIN="$<TARGET_FILE:fake_polargrain>")
add_dependencies(faults_confinement_test fake_polargrain)

# Faults of machines and networks; all of them on request.
foreach(preloaded rename_killer clock_steps)
  add_library(${preloaded} MODULE faults/${preloaded}.cpp)
  target_link_libraries(${preloaded} PRIVATE ${CMAKE_DL_LIBS})
endforeach()
foreach(size "" _reduced)
  string(REPLACE "_" "" argument "${size}")
  add_test(NAME fault_bed${size} COMMAND ${CMAKE_CURRENT_SOURCE_DIR}/faults/bed.sh $<TARGET_FILE:fake_polargrain>
           $<TARGET_FILE:strange_worker> $<TARGET_FILE:rename_killer>
           $<TARGET_FILE:clock_steps> ${argument})
endforeach()
set_tests_properties(fault_bed PROPERTIES LABELS long TIMEOUT ${polargrain_patience})
set_tests_properties(fault_bed_reduced PROPERTIES COST 300 LABELS faults TIMEOUT ${polargrain_patience})

polargrain_test(faults_soak_test long faults/soak_test.cpp LIBS polargrain_options Threads::Threads)
target_compile_definitions(faults_soak_test PRIVATE FAKE_POLARGRAIN="$<TARGET_FILE:fake_polargrain>"
                                                    STRANGE_WORKER="$<TARGET_FILE:strange_worker>")
add_dependencies(faults_soak_test fake_polargrain strange_worker)
