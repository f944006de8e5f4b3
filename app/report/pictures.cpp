// SPDX-License-Identifier: GPL-2.0-or-later
#include "app/report/pictures.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <cmath>
#include <map>

#include "common/error.hpp"
#include "fem/output/read_vtu.hpp"

namespace polargrain::app {
namespace {

/// Of all frames together: some 10 MB of text.
constexpr std::size_t kMostNumbers = 1500000;
constexpr std::size_t kMostFrames = 60;

/// The fields that tell most of a run, as far as they are there.
const std::vector<std::string> kUsualFields{"deviatoric_strain",
                                            "volume_strain",
                                            "displacement",
                                            "micro_rotation",
                                            "stress_ratio",
                                            "p",
                                            "q",
                                            "void_ratio",
                                            "plastic_shear",
                                            "coordination_number",
                                            "sliding_fraction",
                                            "couple_stress",
                                            "source",
                                            "error_estimate"};

/// Corners and middle nodes of an element, around it.
std::vector<int> outline_of(const fem::Element<2>& element) {
  std::vector<int> around;
  const int corners = element.type->corners;
  for (int side = 0; side < corners; ++side) {
    around.push_back(element.nodes[static_cast<std::size_t>(side)]);
    if (element.type->nodes > corners)
      around.push_back(element.nodes[static_cast<std::size_t>(corners + side)]);
  }
  return around;
}

/// Norm of the components of an entity; of a single one the value with its sign.
double value_at(const fem::Field& field, std::size_t entity) {
  const auto width = static_cast<std::size_t>(field.components);
  if (width == 1) return field.values[entity];
  double square = 0.0;
  for (std::size_t i = 0; i < width; ++i)
    square += field.values[entity * width + i] * field.values[entity * width + i];
  return std::sqrt(square);
}

/// By element; nothing where the file has no such field.
std::vector<double> element_values(const fem::FieldFile& file, const std::string& name) {
  std::vector<double> values;
  if (const fem::Field* const of_elements = fem::find_field(file.fields.cells, name)) {
    for (std::size_t e = 0; e < file.mesh.elements.size(); ++e) values.push_back(value_at(*of_elements, e));
  } else if (const fem::Field* const of_nodes = fem::find_field(file.fields.points, name)) {
    for (const fem::Element<2>& element : file.mesh.elements) {
      double sum = 0.0;
      for (int k = 0; k < element.type->corners; ++k)
        sum += value_at(*of_nodes, static_cast<std::size_t>(element.nodes[static_cast<std::size_t>(k)]));
      values.push_back(sum / element.type->corners);
    }
  }
  return values;
}

std::string unit_of(const fem::FieldFile& file, const std::string& name) {
  for (const std::vector<fem::Field>* const fields : {&file.fields.cells, &file.fields.points})
    if (const fem::Field* const field = fem::find_field(*fields, name)) return field->unit;
  return "";
}

/// Evenly, the first and the last among them.
std::vector<std::size_t> chosen(std::size_t files, std::size_t most) {
  std::vector<std::size_t> numbers;
  const std::size_t count = std::clamp<std::size_t>(most, 1, files);
  if (count == 1) return {files - 1};
  for (std::size_t k = 0; k < count; ++k) numbers.push_back(k * (files - 1) / (count - 1));
  return numbers;
}

std::map<int, double> times_of(const RunResult& result) {
  std::map<int, double> times;
  if (!result.history) return times;
  for (std::size_t row = 0; row < result.history->rows(); ++row)
    times[static_cast<int>(std::lround(result.history->number(row, result.history->column("step"))))] =
        result.history->number(row, result.history->column("time"));
  return times;
}

}  // namespace

MeshPicture picture_of(const RunResult& result, const std::vector<std::string>& fields) {
  MeshPicture picture;
  picture.title = result.name;
  if (result.fields.empty() || result.is_in_space()) return picture;
  const fem::FieldFile last = fem::read_vtu(result.fields.back().second);
  std::vector<std::string> names;
  for (const std::string& name : fields.empty() ? kUsualFields : fields) {
    if (!element_values(last, name).empty()) {
      names.push_back(name);
      picture.fields.push_back({name, unit_of(last, name)});
    } else if (!fields.empty()) {
      std::vector<std::string> known;
      for (const std::vector<fem::Field>* const of : {&last.fields.cells, &last.fields.points})
        for (const fem::Field& field : *of)
          if (std::ranges::find(known, field.name) == known.end()) known.push_back(field.name);
      throw InputError({result.fields.back().second.string(), 0,
                        fmt::format("has no field '{}'; it has {}", name, fmt::join(known, ", "))});
    }
  }
  for (const Eigen::Vector2d& node : last.mesh.nodes) picture.nodes.emplace_back(node(0), node(1));
  for (const fem::Element<2>& element : last.mesh.elements) picture.outlines.push_back(outline_of(element));
  const std::map<int, double> times = times_of(result);
  const std::size_t of_frame = 2 * picture.nodes.size() + names.size() * picture.outlines.size();
  const std::size_t most = std::min(kMostFrames, std::max<std::size_t>(1, kMostNumbers / of_frame));
  for (const std::size_t k : chosen(result.fields.size(), most)) {
    const auto& [step, path] = result.fields[k];
    const fem::FieldFile file = fem::read_vtu(path);
    if (file.mesh.elements.size() != picture.outlines.size() ||
        file.mesh.nodes.size() != picture.nodes.size())
      throw InputError({path.string(), 0, "has another mesh than the last field file"});
    MeshPicture::Frame frame;
    const auto time = times.find(step);
    frame.name = time == times.end() ? fmt::format("step {}", step)
                                     : fmt::format("step {}, time {:.4g}", step, time->second);
    const fem::Field* const displacement = fem::find_field(file.fields.points, "displacement");
    for (std::size_t node = 0; node < picture.nodes.size(); ++node)
      displacement != nullptr && displacement->components == 3
          ? frame.moved.emplace_back(displacement->values[3 * node], displacement->values[3 * node + 1])
          : frame.moved.emplace_back(0.0, 0.0);
    for (const std::string& name : names) {
      frame.values.push_back(element_values(file, name));
      frame.values.back().resize(picture.outlines.size(),
                                 std::nan(""));  // a field that this file does not have
    }
    picture.frames.push_back(std::move(frame));
  }
  return picture;
}

}  // namespace polargrain::app
