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
                                            "pore_pressure",
                                            "flow_velocity",
                                            "source",
                                            "error_estimate"};

/// A micro-rotation in space is a vector.
std::vector<std::string> usual_fields(int dimension) {
  std::vector<std::string> names = kUsualFields;
  if (dimension == 3) std::ranges::replace(names, "micro_rotation", "micro_rotation_vector");
  return names;
}

/// Corners and middle nodes around an outline. @param nodes its corners, then its middle nodes if it has some
std::vector<int> around(const std::vector<int>& nodes, int corners) {
  std::vector<int> made;
  for (int corner = 0; corner < corners; ++corner) {
    made.push_back(nodes[static_cast<std::size_t>(corner)]);
    if (static_cast<int>(nodes.size()) > corners)
      made.push_back(nodes[static_cast<std::size_t>(corners + corner)]);
  }
  return made;
}

/// A thing that is drawn of a mesh: an element, in space a face that belongs to one element alone.
struct Outline {
  int element;
  int beyond;  ///< the element on the other side of a face, or -1
  std::vector<int> corners;
  std::vector<int> nodes;  ///< around it
};

std::vector<Outline> outlines_of(const fem::Mesh<2>& mesh) {
  std::vector<Outline> outlines;
  for (const fem::Element<2>& element : mesh.elements) {
    const std::vector<int> corners(element.nodes.begin(), element.nodes.begin() + element.type->corners);
    outlines.push_back(
        {static_cast<int>(outlines.size()), -1, corners, around(element.nodes, element.type->corners)});
  }
  return outlines;
}

/// Faces between two elements stand there twice, once for each.
std::vector<Outline> outlines_of(const fem::Mesh<3>& mesh) {
  std::map<std::vector<int>, std::vector<Outline>> faces;
  for (int e = 0; e < static_cast<int>(mesh.elements.size()); ++e) {
    const auto& sides = mesh.elements[static_cast<std::size_t>(e)].type->sides;
    for (int side = 0; side < static_cast<int>(sides.size()); ++side) {
      const std::vector<int> nodes = mesh.side_nodes({e, side});
      const int count = static_cast<int>(nodes.size()) > 4 ? static_cast<int>(nodes.size()) / 2
                                                           : static_cast<int>(nodes.size());
      const std::vector<int> corners(nodes.begin(), nodes.begin() + count);
      std::vector<int> key = corners;
      std::ranges::sort(key);
      faces[key].push_back({e, -1, corners, around(nodes, count)});
    }
  }
  std::vector<Outline> outlines;
  for (auto& [key, of] : faces) {
    if (of.size() == 2) of[0].beyond = of[1].element, of[1].beyond = of[0].element;
    for (Outline& outline : of) outlines.push_back(std::move(outline));
  }
  return outlines;
}

/// By outline, whether it is seen: the element is there, and no other hides it.
std::vector<char> seen(const fem::Fields& fields, const std::vector<Outline>& outlines) {
  const fem::Field* const there = fem::find_field(fields.cells, "is_there");  // of stages
  const auto is_there = [&](int element) {
    if (element < 0) return false;
    const auto number = static_cast<std::size_t>(element);
    return there == nullptr || number >= there->values.size() || there->values[number] > 0.0;
  };
  std::vector<char> made;
  for (const Outline& outline : outlines)
    made.push_back(is_there(outline.element) && !is_there(outline.beyond) ? 1 : 0);
  return made;
}

/// Leaves out those that no frame shows. @returns the numbers of what is hidden in each frame
std::vector<std::vector<int>> keep_seen(const std::vector<std::vector<char>>& by_frame,
                                        std::vector<Outline>& outlines) {
  std::vector<std::vector<int>> hidden(by_frame.size());
  std::vector<Outline> kept;
  for (std::size_t k = 0; k < outlines.size(); ++k) {
    if (std::ranges::none_of(by_frame, [&](const auto& seen) { return seen[k] != 0; })) continue;
    for (std::size_t frame = 0; frame < by_frame.size(); ++frame)
      if (by_frame[frame][k] == 0) hidden[frame].push_back(static_cast<int>(kept.size()));
    kept.push_back(std::move(outlines[k]));
  }
  outlines = std::move(kept);
  return hidden;
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

/// By outline; nothing where the file has no such field.
std::vector<double> values_of(const fem::Fields& fields, const std::vector<Outline>& outlines,
                              const std::string& name) {
  std::vector<double> values;
  if (const fem::Field* const of_elements = fem::find_field(fields.cells, name)) {
    for (const Outline& outline : outlines)
      values.push_back(value_at(*of_elements, static_cast<std::size_t>(outline.element)));
  } else if (const fem::Field* const of_nodes = fem::find_field(fields.points, name)) {
    for (const Outline& outline : outlines) {
      double sum = 0.0;
      for (const int node : outline.corners) sum += value_at(*of_nodes, static_cast<std::size_t>(node));
      values.push_back(sum / static_cast<double>(outline.corners.size()));
    }
  }
  return values;
}

std::string unit_of(const fem::Fields& all, const std::string& name) {
  for (const std::vector<fem::Field>* const fields : {&all.cells, &all.points})
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

/// The first @p dim components of the displacements; zero where the file has no displacements.
template <int dim>
std::vector<double> movements_of(const fem::Fields& fields, std::size_t nodes) {
  std::vector<double> moved(dim * nodes, 0.0);
  const fem::Field* const displacement = fem::find_field(fields.points, "displacement");
  if (displacement == nullptr || displacement->components != 3) return moved;
  for (std::size_t node = 0; node < nodes; ++node)
    std::copy_n(displacement->values.begin() + static_cast<std::ptrdiff_t>(3 * node), dim,
                moved.begin() + static_cast<std::ptrdiff_t>(dim * node));
  return moved;
}

template <int dim>
MeshPicture picture_for(const RunResult& result, const std::vector<std::string>& fields) {
  MeshPicture picture;
  picture.title = result.name;
  picture.dimension = dim;
  const fem::FieldFile<dim> last = fem::read_vtu<dim>(result.fields.back().second);
  std::vector<Outline> outlines = outlines_of(last.mesh);
  const bool has_stages = fem::find_field(last.fields.cells, "is_there") != nullptr;
  std::vector<std::vector<char>> seen_by_file;
  for (const auto& [step, path] : result.fields) {
    seen_by_file.push_back(seen(has_stages ? fem::read_vtu<dim>(path).fields : last.fields, outlines));
    if (!has_stages) break;
  }
  const std::vector<std::vector<int>> hidden = keep_seen(seen_by_file, outlines);
  picture.all_elements = last.mesh.elements.size();
  std::vector<std::string> names;
  for (const std::string& name : fields.empty() ? usual_fields(dim) : fields) {
    if (!values_of(last.fields, outlines, name).empty()) {
      names.push_back(name);
      picture.fields.push_back({name, unit_of(last.fields, name)});
    } else if (!fields.empty()) {
      std::vector<std::string> known;
      for (const std::vector<fem::Field>* const of : {&last.fields.cells, &last.fields.points})
        for (const fem::Field& field : *of)
          if (std::ranges::find(known, field.name) == known.end()) known.push_back(field.name);
      throw InputError({result.fields.back().second.string(), 0,
                        fmt::format("has no field '{}'; it has {}", name, fmt::join(known, ", "))});
    }
  }
  for (const auto& node : last.mesh.nodes)
    picture.nodes.insert(picture.nodes.end(), node.begin(), node.end());
  for (const Outline& outline : outlines) {
    picture.outlines.push_back(outline.nodes);
    picture.elements.push_back(outline.element);
  }
  const std::map<int, double> times = times_of(result);
  const std::size_t of_frame = picture.nodes.size() + names.size() * picture.outlines.size();
  const std::size_t most = std::min(kMostFrames, std::max<std::size_t>(1, kMostNumbers / of_frame));
  for (const std::size_t k : chosen(result.fields.size(), most)) {
    const auto& [step, path] = result.fields[k];
    const fem::FieldFile<dim> file = fem::read_vtu<dim>(path);
    if (file.mesh.elements.size() != last.mesh.elements.size() ||
        file.mesh.nodes.size() != last.mesh.nodes.size())
      throw InputError({path.string(), 0, "has another mesh than the last field file"});
    MeshPicture::Frame frame;
    const auto time = times.find(step);
    frame.name = time == times.end() ? fmt::format("step {}", step)
                                     : fmt::format("step {}, time {:.4g}", step, time->second);
    frame.moved = movements_of<dim>(file.fields, file.mesh.nodes.size());
    for (const std::string& name : names) {
      frame.values.push_back(values_of(file.fields, outlines, name));
      frame.values.back().resize(picture.outlines.size(),
                                 std::nan(""));  // a field that this file does not have
    }
    frame.hidden = hidden[has_stages ? k : 0];
    picture.frames.push_back(std::move(frame));
  }
  return picture;
}

}  // namespace

MeshPicture picture_of(const RunResult& result, const std::vector<std::string>& fields) {
  if (result.fields.empty()) {
    MeshPicture none;
    none.title = result.name;
    return none;
  }
  return result.is_in_space() ? picture_for<3>(result, fields) : picture_for<2>(result, fields);
}

}  // namespace polargrain::app
