// SPDX-License-Identifier: GPL-2.0-or-later
#include "app/report/busiest_grains.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <optional>
#include <span>

#include "app/grains/cell_paths.hpp"
#include "app/grains/show_grains.hpp"
#include "app/page/page.hpp"
#include "app/report/grain_drawing.hpp"
#include "common/error.hpp"
#include "common/write_file.hpp"
#include "coupler/case/data_files.hpp"
#include "coupler/pool/private_directory.hpp"
#include "fem/output/read_vtu.hpp"

namespace polargrain::app {
namespace {

namespace fs = std::filesystem;

constexpr const char* kMeasure = "deviatoric_strain";

struct Busiest {
  std::size_t point;
  std::int64_t element;
  double strain;
};

/// Of the elements with cells.
std::optional<Busiest> busiest_of(const RunResult& result, const CellPaths& paths) {
  const fem::FieldFile<2> last = fem::read_vtu(result.fields.back().second);
  const fem::Field* const field = fem::find_field(last.fields.cells, kMeasure);
  if (field == nullptr) return std::nullopt;
  std::optional<Busiest> busiest;
  for (std::size_t point = 0; point < paths.points(); ++point) {
    const std::int64_t element = paths.element(point);
    if (paths.cell(point) == nullptr || element < 0 ||
        static_cast<std::size_t>(element) >= field->values.size())
      continue;
    const double strain = field->values[static_cast<std::size_t>(element)];
    if (!busiest || strain > busiest->strain) busiest = {point, element, strain};
  }
  return busiest;
}

}  // namespace

std::string busiest_grains(const RunResult& result, const ScriptRules& scripts,
                           const WorkerEngine& engine) try {
  if (result.is_at_work || result.fields.empty() || result.is_in_space() ||
      !fs::exists(result.directory / kCellPathsFolder))
    return "";
  const CellPaths paths(result.directory);
  const std::vector<int> kept = paths.steps();
  const int last = result.fields.back().first;
  if (!std::ranges::binary_search(kept, last)) return "";
  const std::optional<Busiest> busiest = busiest_of(result, paths);
  if (!busiest) return "";
  const coupler::PrivateDirectory folder;
  const auto file_of = [&folder](int step) { return folder.path() / fmt::format("{}.html", step); };
  const std::vector<std::size_t> points{busiest->point};
  const std::set<int> steps{kept.front(), last};
  // Unlike those of other runs on the page, and fit for an identifier.
  const std::string directory = result.directory.string();
  const std::string name = polargrain::name_of(std::as_bytes(std::span(directory))).text();
  const fs::path log = folder.path() / "engine.log";
  show_grains(
      {paths, points, steps, scripts, engine, log}, [&](std::size_t, int step, const GrainView& view) {
        write_file(file_of(step),
                   grain_figure(view, fmt::format("grains-{}-{}", name, step), fmt::format("step {}", step)));
      });
  std::string text = fmt::format(
      "<p>{}: the grains of point {}, in element {}, which has sheared most at the end ({} {:.3g}). Any other: <code>polargrain "
      "grains {} --point N</code></p>\n<div class='grid'>\n",
      escaped(result.name), busiest->point, busiest->element, "deviatoric strain", busiest->strain,
      escaped(directory));
  for (const int step : steps) text += coupler::content_of(file_of(step));
  return text + "</div>\n";
} catch (const std::exception& error) {  // the rest of the page is worth more
  return fmt::format("<p>The grains of {} are not shown: {}</p>\n", escaped(result.name),
                     escaped(error.what()));
}

}  // namespace polargrain::app
