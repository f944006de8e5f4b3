// SPDX-License-Identifier: GPL-2.0-or-later
#pragma once
#include <filesystem>
#include <string>
#include <utility>
#include <vector>

namespace polargrain::app {

/// Text for HTML, between elements and as the value of an attribute in quotation marks of either kind: nothing in it has a
/// meaning there. The one place where text becomes HTML.
std::string escaped(const std::string& text);

/// One axis of a chart.
struct ChartAxis {
  std::string title;
  std::string unit = {};  ///< shown behind the title; empty: no unit
  bool logarithmic = false;
  bool percent = false;  ///< values are shares, shown as per cent
};

/// The data behind one name of a chart.
struct ChartSeries {
  std::string name;                               ///< shown with a point under the mouse, and in the legend
  std::vector<std::pair<double, double>> points;  ///< x, y; values that are not finite are left out
  bool line = false;                              ///< joined by a line, no marks
  bool dashed = false;
  bool square = false;    ///< marks are squares, otherwise discs
  bool is_named = false;  ///< the name stands beside the first point too
  double size = 5.0;      ///< of a mark: half its width, pixels
  std::string colour;     ///< fill of marks, of a line its colour; "text": as text; empty: the next of a list
};

/// A chart of a page: drawn in the reader's browser, values under the mouse, a part enlarged by drawing a rectangle
/// around it, all of it again by a double click. A legend where `with_legend`.
std::string chart(const ChartAxis& x, const ChartAxis& y, const std::vector<ChartSeries>& series,
                  bool with_legend);

/// A row of a table.
struct TableRow {
  std::vector<std::string> cells;  ///< text, not HTML; a single one takes the whole row
  std::string style = {};          ///< a class of page.css: "front", "group"; empty: plain
};

/// A table of figures, or of sentences, whose lines break. On a narrow page each row of sentences becomes a list.
enum class TableOf { figures, text };

/// A table that scrolls within the page where it is wider than that; numbers stand on the right.
std::string table(const std::vector<std::string>& titles, const std::vector<TableRow>& rows,
                  TableOf of = TableOf::figures);

/// Text that the reader opens with a click. @param body HTML
std::string details(const std::string& title, const std::string& body);

/// A field on a mesh that moves, drawn in the reader's browser: which field, which frame (or all of them in turn), how many
/// times the displacement, and the value under the mouse.
struct MeshPicture {
  struct PictureField {
    std::string name;
    std::string unit;
  };
  struct Frame {
    std::string name;                         ///< "step 5, time 0.1"
    std::vector<double> moved;                ///< displacement by node, its components one after the other, m
    std::vector<std::vector<double>> values;  ///< by field, by outline
    std::vector<int> hidden;                  ///< outlines that are not there
  };
  std::string title;
  int dimension = 2;          ///< components of a place; in space the picture can be turned
  std::vector<double> nodes;  ///< places by node, components one after the other, m
  std::vector<std::vector<int>>
      outlines;                  ///< of each element, in space of each outer face: its nodes around it
  std::vector<int> elements;     ///< of each outline
  std::size_t all_elements = 0;  ///< of the mesh
  std::vector<PictureField> fields;
  std::vector<Frame> frames;
};

std::string mesh_picture(const MeshPicture& picture);

/// An HTML file that needs no other. @param body HTML between the headline and the end
/// @param refresh_seconds the browser loads it anew so often; 0: never
std::string page(const std::string& title, const std::string& body, int refresh_seconds = 0);

/// Why no page may be written into a file, in words that follow its name: it holds something else than a page of this program.
/// Empty where a page may stand, also where nothing is yet.
std::string why_no_page(const std::filesystem::path& file,
                        const std::string& remedy = "name another file to write, or remove this one");

}  // namespace polargrain::app
