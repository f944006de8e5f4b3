# SPDX-License-Identifier: GPL-2.0-or-later
# polargrain_contact_laws(NAME [NORMAL headers...] [TANGENTIAL headers...] [COHESION headers...] [ROLLING headers...]
#                         [COMPILED combinations...])
#
# NAME.so: a library of the contact laws in these headers, for `contact_library:` in a case or specification and
# `polargrain-liggghts -contact`. Each law can be combined with all others by its name in a script; combinations listed
# after COMPILED, such as "MY_HOOKE,TANGENTIAL_HISTORY,COHESION_OFF,ROLLING_OFF", are compiled as one, for speed.
function(polargrain_contact_laws name)
  cmake_parse_arguments(arg "" "" "NORMAL;TANGENTIAL;COHESION;ROLLING;COMPILED" ${ARGN})
  if(arg_UNPARSED_ARGUMENTS)
    message(FATAL_ERROR "polargrain_contact_laws(${name}): say of each header which kind of law it holds, for example "
                        "NORMAL ${arg_UNPARSED_ARGUMENTS}")
  endif()
  set(lists ${CMAKE_CURRENT_BINARY_DIR}/${name})
  foreach(kind normal tangential cohesion rolling)
    string(TOUPPER ${kind} KIND)
    set(includes "")
    foreach(header ${arg_${KIND}})
      get_filename_component(path ${header} ABSOLUTE)
      if(NOT EXISTS ${path})
        message(FATAL_ERROR "polargrain_contact_laws(${name}): there is no header ${path}")
      endif()
      string(APPEND includes "#include \"${path}\"\n")
    endforeach()
    file(CONFIGURE OUTPUT ${lists}/own_${kind}_model.h CONTENT "${includes}")
    file(CONFIGURE OUTPUT ${lists}/style_${kind}_model.h
         CONTENT "#include \"dem/engine/model_lists/style_${kind}_model.h\"\n#include \"own_${kind}_model.h\"\n")
  endforeach()
  set(source "#include \"dem/contact/own_contact_laws.hpp\"\n")
  foreach(combination ${arg_COMPILED})
    string(APPEND source "POLARGRAIN_COMPILED(${combination})\n")
  endforeach()
  file(CONFIGURE OUTPUT ${lists}/${name}.cpp CONTENT "${source}")
  add_library(${name} MODULE ${lists}/${name}.cpp)
  set_target_properties(${name} PROPERTIES PREFIX "")
  target_include_directories(${name} BEFORE PRIVATE ${lists})
  target_link_libraries(${name} PRIVATE polargrain::contact_law)
endfunction()
