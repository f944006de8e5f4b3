# SPDX-License-Identifier: GPL-2.0-or-later
# A source file that holds what pages carry with them.
find_file(CHART_JS chart.min.js PATHS /usr/share/javascript/chart.js NO_DEFAULT_PATH REQUIRED
          DOC "The library that draws the charts of pages (Chart.js 3)")
function(polargrain_page_assets source)
  file(READ page/page.css POLARGRAIN_STYLE_SHEET)
  file(READ ${CHART_JS} POLARGRAIN_CHART_LIBRARY)
  # Where a browser would look for a file that is not there.
  string(REGEX REPLACE "//# sourceMappingURL=[^\n]*" "" POLARGRAIN_CHART_LIBRARY "${POLARGRAIN_CHART_LIBRARY}")
  file(READ page/charts.js POLARGRAIN_CHART_SCRIPT)
  file(READ page/mesh.js POLARGRAIN_MESH_SCRIPT)
  set_property(DIRECTORY APPEND PROPERTY CMAKE_CONFIGURE_DEPENDS page/page.css page/charts.js page/mesh.js ${CHART_JS})
  configure_file(page/assets.cpp.in ${source} @ONLY)
endfunction()
