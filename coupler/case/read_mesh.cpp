// SPDX-License-Identifier: GPL-2.0-or-later
#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <map>
#include <optional>
#include <set>

#include "coupler/case/data_files.hpp"
#include "coupler/case/element_limits.hpp"
#include "coupler/case/parts.hpp"
#include "fem/mesh/box.hpp"
#include "fem/mesh/cut.hpp"
#include "fem/mesh/cylinder.hpp"
#include "fem/mesh/gmsh.hpp"
#include "fem/mesh/gmsh_content.hpp"
#include "fem/mesh/rectangle.hpp"

namespace polargrain::coupler {
namespace {

/// Divides the faces of each boundary into those of the patch and of the rest, where both have some: top_patch, top_rest.
void divide_faces(fem::Mesh<3>& mesh) {
  const std::vector<int>& patch = mesh.regions.at("patch");  // ascending
  std::map<std::string, std::vector<fem::BoundarySide>> made;
  for (const auto& [name, faces] : mesh.boundaries) {
    std::vector<fem::BoundarySide> inside, outside;
    for (const fem::BoundarySide& face : faces)
      (std::ranges::binary_search(patch, face.element) ? inside : outside).push_back(face);
    if (inside.empty() || outside.empty()) continue;
    made[name + "_patch"] = std::move(inside);
    made[name + "_rest"] = std::move(outside);
  }
  mesh.boundaries.merge(made);
}

/// A patch that ends within elements would become a whole element larger or smaller. @param patch its sizes
template <class Specification>
void refuse_patch_within_elements(const std::vector<double>& patch, const Specification& body,
                                  Section& section) {
  constexpr double kRounding = 0.01;  // of an element: 66.7 mm are two thirds of 100 mm
  for (std::size_t i = 0; i < patch.size(); ++i) {
    const double edge = body.size[i] / body.elements[i];
    const double fits = patch[i] / edge;
    if (patch[i] >= body.size[i] || std::abs(fits - std::round(fits)) <= kRounding) continue;
    const double less = std::floor(fits) * edge;
    section.fault(
        "patch",
        fmt::format(
            "patch: its size number {}, {:.4g} m, ends within an element of {:.4g} m; give {}{:.4g} m, or "
            "change the number of elements",
            i + 1, patch[i], edge, less > 0.0 ? fmt::format("{:.4g} m or ", less) : "", less + edge));
  }
}

/// Divides the elements into the region `patch`, whose centres lie within its sizes of the lower left corner (in space: and
/// front), and the region `rest`.
template <int dim, class Specification>
void make_patch(const std::vector<double>& patch, const Specification& body, Section& section,
                fem::Mesh<dim>& mesh) {
  const Eigen::Map<const typename Cosserat<dim>::Place> size(patch.data());
  for (int e = 0; e < static_cast<int>(mesh.elements.size()); ++e) {
    const typename Cosserat<dim>::Place centre = mesh.element_positions(e).colwise().mean();
    mesh.regions[(centre.array() < size.array()).all() ? "patch" : "rest"].push_back(e);
  }
  if (mesh.regions.count("patch") == 0 || mesh.regions.count("rest") == 0) {
    section.fault("patch",
                  "patch: holds no element, or all of them; its size is measured from the lower left corner "
                  "to the centres of elements");
    return;
  }
  refuse_patch_within_elements(patch, body, section);
  if constexpr (dim == 3) divide_faces(mesh);
}

/// Makes node sets of the rows of nodes at given heights.
void make_levels(const Entry& entry, CaseParts& parts) {
  fem::Mesh<2>& mesh = parts.result.problem.mesh;
  Section levels(entry, "mesh.rectangle.levels", parts.faults);
  for (const Entry::Member& member : entry.members) {
    const double height = levels.quantity(member.key, Dimension::length, Limit::not_negative);
    if (mesh.node_sets.count(member.key) > 0 || mesh.boundaries.count(member.key) > 0) {
      levels.fault(member.key, fmt::format("{}: a part of every rectangle has that name", member.key));
      continue;
    }
    // Rows are whole parts of the height; no row is farther off than rounding.
    std::vector<int> nodes;
    for (int node = 0; node < static_cast<int>(mesh.nodes.size()); ++node)
      if (std::abs(mesh.nodes[node].y() - height) < 1e-9 * mesh.nodes.back().y()) nodes.push_back(node);
    if (nodes.empty())
      levels.fault(
          member.key,
          fmt::format("{}: no nodes are at a height of {} m; elements have theirs at their edges and "
                      "in the middle of these",
                      member.key, height));
    mesh.node_sets[member.key] = nodes;
  }
  levels.finish();
}

/// Two corners of a part of the rectangle, the lower left one first: [x1, x2, x1, x2].
struct Corners {
  Eigen::Vector2d low, high;
};

Corners read_corners(Section& section, const std::string& key) {
  const std::vector<double> x = section.quantities(key, 4, Dimension::length, Limit::any);
  const Corners corners{{x[0], x[1]}, {x[2], x[3]}};
  if ((corners.low.array() > corners.high.array()).any())
    section.fault(key, fmt::format("{}: give the lower left corner first: [LEFT, BOTTOM, RIGHT, TOP]", key));
  return corners;
}

/// Name of a region that is no part of the body.
constexpr const char* kVoid = "void";

/// Makes regions of the elements whose centres lie in rectangles; the others become the region `rest`. Elements of `void` go.
void make_regions(const Entry& entry, CaseParts& parts) {
  fem::Mesh<2>& mesh = parts.result.problem.mesh;
  Section regions(entry, "mesh.rectangle.regions", parts.faults);
  std::vector<std::string> region_of(mesh.elements.size(), "rest");
  for (const Entry::Member& member : entry.members) {
    if (mesh.regions.contains(member.key) || member.key == "rest") {
      regions.fault(member.key, fmt::format("{}: a region of every rectangle has that name", member.key));
      regions.find(member.key);
      continue;
    }
    const Corners corners = read_corners(regions, member.key);
    const std::vector<int> found = fem::elements_between(mesh, corners.low, corners.high);
    for (const int e : found) {
      std::string& region = region_of[static_cast<std::size_t>(e)];
      if (region != "rest") {
        regions.fault(member.key,
                      fmt::format("{}: lies over '{}'; an element has one region", member.key, region));
        break;
      }
      region = member.key;
    }
    if (found.empty())
      regions.fault(member.key, fmt::format("{}: the centre of no element lies in it", member.key));
  }
  regions.finish();
  for (std::size_t e = 0; e < mesh.elements.size(); ++e)
    mesh.regions[region_of[e]].push_back(static_cast<int>(e));
  if (const auto gone = mesh.regions.find(kVoid); gone != mesh.regions.end()) {
    std::vector<char> removed(mesh.elements.size(), 0);
    for (const int e : gone->second) removed[static_cast<std::size_t>(e)] = 1;
    if (gone->second.size() == mesh.elements.size()) {
      regions.fault(kVoid, "void: it holds all elements");
      return;
    }
    mesh = fem::cut(mesh, removed);
  }
}

/// Whether an end of a line lies inside of a side, so that the line would be shorter or longer than it was given.
/// @param axis along the line
bool ends_within_side(const fem::Mesh<2>& mesh, const std::vector<int>& nodes, const Corners& corners,
                      int axis, double near) {
  double least = HUGE_VAL;
  double largest = -HUGE_VAL;
  for (const int node : nodes) {
    const Eigen::Vector2d& x = mesh.nodes[static_cast<std::size_t>(node)];
    if (std::abs(x(1 - axis) - corners.low(1 - axis)) > near) return false;
    least = std::min(least, x(axis));
    largest = std::max(largest, x(axis));
  }
  const auto is_within = [&](double end) { return end > least + near && end < largest - near; };
  return is_within(corners.low(axis)) || is_within(corners.high(axis));
}

/// Makes boundaries of the sides of elements along lines; those inside of the body may become boundaries when one of their
/// sides is removed.
void make_lines(const Entry& entry, CaseParts& parts) {
  fem::Mesh<2>& mesh = parts.result.problem.mesh;
  Section lines(entry, "mesh.rectangle.lines", parts.faults);
  const double near = 1e-9 * mesh.nodes.back().norm();
  for (const Entry::Member& member : entry.members) {
    if (mesh.node_sets.contains(member.key) || mesh.boundaries.contains(member.key)) {
      lines.fault(member.key, fmt::format("{}: a part of every rectangle has that name", member.key));
      lines.find(member.key);
      continue;
    }
    const Corners corners = read_corners(lines, member.key);
    if ((corners.high - corners.low).minCoeff() > near)
      lines.fault(member.key, fmt::format("{}: lines of a rectangle are level or upright", member.key));
    const int axis = corners.high.x() - corners.low.x() > near ? 0 : 1;
    std::vector<fem::BoundarySide> sides;
    std::set<std::vector<int>> seen;
    bool is_cut = false;
    for (std::size_t e = 0; e < mesh.elements.size(); ++e) {
      for (std::size_t k = 0; k < mesh.elements[e].type->sides.size(); ++k) {
        const fem::BoundarySide side{static_cast<int>(e), static_cast<int>(k)};
        std::vector<int> nodes = mesh.side_nodes(side);
        const bool on_line = std::ranges::all_of(nodes, [&](int node) {
          const Eigen::Vector2d& x = mesh.nodes[static_cast<std::size_t>(node)];
          return ((x - corners.low).array() > -near).all() && ((corners.high - x).array() > -near).all();
        });
        is_cut = is_cut || ends_within_side(mesh, nodes, corners, axis, near);
        std::ranges::sort(nodes);
        if (on_line && seen.insert(nodes).second) sides.push_back(side);
      }
    }
    if (is_cut)
      lines.fault(
          member.key,
          fmt::format("{}: it ends between two corners of elements; let it end at corners", member.key));
    else if (sides.empty())
      lines.fault(member.key, fmt::format("{}: no side of an element lies on it", member.key));
    mesh.boundaries[member.key] = std::move(sides);
  }
  lines.finish();
}

void check_number(Section& section, int dimension, double count) {
  if (const std::string fault = too_many_elements(dimension, count); !fault.empty())
    section.fault("elements", "elements: " + fault);
}

void read_rectangle(const Entry& entry, const std::string& element, CaseParts& parts) {
  const std::size_t faults_before = parts.faults.size();
  Section section(entry, "mesh.rectangle", parts.faults);
  fem::RectangleSpecification specification{};
  const std::vector<double> size = section.quantities("size", 2, Dimension::length, Limit::positive);
  const std::vector<int> elements = section.wholes("elements", 2, 1);
  specification.size = {size[0], size[1]};
  specification.elements = {elements[0], elements[1]};
  const bool has_patch = section.find("patch") != nullptr;
  std::vector<double> patch;
  if (has_patch) patch = section.quantities("patch", 2, Dimension::length, Limit::positive);
  const Entry* levels = section.find("levels");
  const Entry* regions = section.find("regions");
  const Entry* lines = section.find("lines");
  if (has_patch && regions != nullptr)
    section.fault("patch", "patch: 'regions' divide the elements already; keep one of them");
  section.finish();
  check_number(section, 2, static_cast<double>(specification.elements[0]) * specification.elements[1]);
  if (parts.faults.size() == faults_before && !element.empty()) {
    parts.result.problem.mesh = fem::rectangle(specification, element);
    if (has_patch) make_patch<2>(patch, specification, section, parts.result.problem.mesh);
    if (levels != nullptr) make_levels(*levels, parts);
    if (regions != nullptr) make_regions(*regions, parts);
    if (lines != nullptr) make_lines(*lines, parts);
  }
}

void read_box(const Entry& entry, const std::string& element, CaseParts& parts) {
  const std::size_t faults_before = parts.faults.size();
  Section section(entry, "mesh.box", parts.faults);
  fem::BoxSpecification specification{};
  const std::vector<double> size = section.quantities("size", 3, Dimension::length, Limit::positive);
  const std::vector<int> elements = section.wholes("elements", 3, 1);
  double count = 1.0;
  for (std::size_t i = 0; i < 3; ++i) {
    specification.size[i] = size[i];
    specification.elements[i] = elements[i];
    count *= elements[i];
  }
  const bool has_patch = section.find("patch") != nullptr;
  std::vector<double> patch;
  if (has_patch) patch = section.quantities("patch", 3, Dimension::length, Limit::positive);
  section.finish();
  check_number(section, 3, count);
  if (parts.faults.size() != faults_before || element.empty()) return;
  parts.result.space->mesh = fem::box(specification, element);
  if (has_patch) make_patch<3>(patch, specification, section, parts.result.space->mesh);
}

void read_cylinder(const Entry& entry, const std::string& element, CaseParts& parts) {
  const std::size_t faults_before = parts.faults.size();
  Section section(entry, "mesh.cylinder", parts.faults);
  fem::CylinderSpecification specification{};
  specification.radius = section.quantity("radius", Dimension::length, Limit::positive);
  specification.height = section.quantity("height", Dimension::length, Limit::positive);
  const std::vector<int> elements = section.wholes("elements", 3, 1);
  specification.quarter = elements[0];
  specification.rings = elements[1];
  specification.layers = elements[2];
  const std::string sector = section.choice_or("sector", {"whole", "half", "quarter"}, "whole");
  using Sector = fem::CylinderSpecification::Sector;
  specification.sector = sector == "half"      ? Sector::half
                         : sector == "quarter" ? Sector::quarter
                                               : Sector::whole;
  section.finish();
  if (parts.faults.size() == faults_before && specification.quarter % 2 != 0)
    section.fault("elements", fmt::format("elements: the first number, of elements along a quarter of the "
                                          "circumference, must be even, found {}",
                                          specification.quarter));
  check_number(section, 3, fem::number_of_elements(specification));
  if (parts.faults.size() != faults_before || element.empty()) return;
  try {
    parts.result.space->mesh = fem::cylinder(specification, element);
  } catch (const RunError& error) {
    parts.faults.push_back(entry.fault(fmt::format("mesh.cylinder: {}", error.what())));
  }
}

/// The mesh of what a file holds, and the choice of its element. @param content nothing: the file could not be read
template <int dim>
void make_from_file(Section& mesh, const std::string& name, std::optional<fem::GmshContent> content,
                    CaseParts& parts) {
  constexpr std::string_view kReduced = fem::kSerendipity<dim>;
  constexpr std::string_view kFull = kReduced.substr(0, kReduced.size() - 1);
  const std::string element =
      mesh.choice_or("element", fem::element_names<dim>(), fem::element_names<dim>().front());
  if (element != kReduced && element != kFull && element != fem::kOnePoint<dim>) {
    if (!element.empty())
      mesh.fault(
          "element",
          fmt::format("element: the mesh file holds the kinds of its elements; for its {} choose {} or "
                      "{}, for those with corners alone {}, found '{}'",
                      dim == 2 ? "quadrilaterals of 8 nodes" : "hexahedra of 20 nodes", kReduced, kFull,
                      fem::kOnePoint<dim>, element));
    return;
  }
  if (!content) return;
  try {
    parts.result.problem_of<dim>().mesh = fem::mesh_of<dim>(name, *std::move(content), element);
  } catch (const InputError& error) {
    for (const Fault& fault : error.faults()) mesh.fault("file", fmt::format("{}: {}", name, fault.message));
  }
}

void read_file(Section& mesh, CaseParts& parts) {
  const std::string name = mesh.text("file", "the path of a mesh that Gmsh has written (.msh)");
  std::optional<fem::GmshContent> content;
  if (const auto file = find_data_file(name, parts.directory); name.empty()) {
  } else if (!file) {
    mesh.fault("file",
               fmt::format("file: there is no mesh '{}' beside the case; correct the path or make the "
                           "mesh (gmsh -2 SHAPE.geo, in space gmsh -3)",
                           name));
  } else {
    try {
      content = fem::read_gmsh_content(file->lexically_normal());
    } catch (const InputError& error) {
      for (const Fault& fault : error.faults())
        mesh.fault("file", fmt::format("{}: {}", name, fault.message));
    }
  }
  if (content && fem::dimension_of(*content) == 3) {
    parts.result.space.emplace();
    make_from_file<3>(mesh, name, std::move(content), parts);
  } else {
    make_from_file<2>(mesh, name, std::move(content), parts);
  }
}

}  // namespace

void read_mesh(const Entry& entry, CaseParts& parts) {
  const std::size_t faults_before = parts.faults.size();
  Section mesh(entry, "mesh", parts.faults);
  const Entry* rectangle = mesh.find("rectangle");
  const Entry* box = mesh.find("box");
  const Entry* cylinder = mesh.find("cylinder");
  const Entry* file = mesh.find("file");
  if (box != nullptr || cylinder != nullptr) parts.result.space.emplace();
  const auto element = [&]<int dim>() {
    return mesh.choice_or("element", fem::element_names<dim>(), fem::element_names<dim>().front());
  };
  if ((rectangle != nullptr) + (box != nullptr) + (cylinder != nullptr) + (file != nullptr) > 1) {
    mesh.find("element");
    mesh.fault(file != nullptr       ? "file"
               : cylinder != nullptr ? "cylinder"
                                     : "box",
               "give one of a rectangle, a box, a cylinder and a file; remove the others");
  } else if (box != nullptr) {
    read_box(*box, element.operator()<3>(), parts);
  } else if (cylinder != nullptr) {
    read_cylinder(*cylinder, element.operator()<3>(), parts);
  } else if (rectangle != nullptr) {
    read_rectangle(*rectangle, element.operator()<2>(), parts);
  } else if (file != nullptr) {
    read_file(mesh, parts);
  } else {
    element.operator()<2>();
    if (entry.kind == Entry::Kind::map)
      parts.faults.push_back(
          entry.fault("mesh: the key 'rectangle' is missing; give a map with size and elements, a 'box' or a "
                      "'cylinder' in space, or a 'file'"));
  }
  mesh.finish();
  parts.has_mesh = parts.faults.size() == faults_before;
}

}  // namespace polargrain::coupler
