// SPDX-License-Identifier: GPL-2.0-or-later
#pragma once
#include <string>
#include <utility>
#include <vector>

namespace polargrain::app {

/// With what < > & and quotation marks mean in HTML taken away.
std::string escaped(const std::string& text);

/// One axis of a chart.
struct ChartAxis {
  std::string title;
  bool logarithmic = false;
  bool percent = false;  ///< values are shares, shown as per cent
};

/// What one name of a chart stands for.
struct ChartSeries {
  std::string name;                               ///< shown with a point under the mouse, and in the legend
  std::vector<std::pair<double, double>> points;  ///< x, y; what is not finite is left out
  bool line = false;                              ///< joined by a line, no marks
  bool dashed = false;
  bool square = false;    ///< marks are squares, otherwise discs
  bool is_named = false;  ///< the name stands beside the first point too
  double size = 5.0;      ///< of a mark: half its width, pixels
  std::string colour;     ///< fill of marks, of a line its colour; empty: the next of a list
};

/// A chart of a page: drawn in the reader's browser, values under the mouse, a part enlarged by drawing a rectangle
/// around it, all of it again by a double click. A legend where `with_legend`.
std::string chart(const ChartAxis& x, const ChartAxis& y, const std::vector<ChartSeries>& series,
                  bool with_legend);

/// An HTML file that needs no other. @param body HTML between the headline and the end
std::string page(const std::string& title, const std::string& body);

}  // namespace polargrain::app
