# SPDX-License-Identifier: GPL-2.0-or-later
# One interface target that every library and program of this project links: warnings are errors in our
# code, and the sanitizers asked for are on. Third-party headers come in as system includes.
add_library(polargrain_options INTERFACE)
target_compile_options(polargrain_options INTERFACE -Wall -Wextra -Werror)
target_include_directories(polargrain_options INTERFACE ${PROJECT_SOURCE_DIR})
if(POLARGRAIN_SANITIZE)
  target_compile_options(polargrain_options INTERFACE -fsanitize=${POLARGRAIN_SANITIZE} -fno-sanitize-recover=all
                                                     -fno-omit-frame-pointer)
  target_link_options(polargrain_options INTERFACE -fsanitize=${POLARGRAIN_SANITIZE})
endif()
