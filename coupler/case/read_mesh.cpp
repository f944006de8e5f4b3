// SPDX-License-Identifier: GPL-2.0-or-later
#include <fmt/format.h>

#include "coupler/case/data_files.hpp"
#include "coupler/case/parts.hpp"
#include "fem/mesh/gmsh.hpp"
#include "fem/mesh/rectangle.hpp"

namespace polargrain::coupler {
namespace {

void read_rectangle(const Entry& entry, const std::string& element, CaseParts& parts) {
  const std::size_t faults_before = parts.faults.size();
  Section section(entry, "mesh.rectangle", parts.faults);
  fem::RectangleSpecification specification{};
  const std::vector<double> size = section.quantities("size", 2, Dimension::length, Limit::positive);
  const std::vector<int> elements = section.wholes("elements", 2, 1);
  specification.size = {size[0], size[1]};
  specification.elements = {elements[0], elements[1]};
  section.finish();
  if (parts.faults.size() == faults_before && !element.empty()) {
    parts.result.problem.mesh = fem::rectangle(specification, element);
  }
}

void read_file(Section& mesh, const std::string& element, CaseParts& parts) {
  const std::string name = mesh.text("file", "the path of a mesh that Gmsh has written (.msh)");
  if (element != "Q8R" && element != "Q8") {
    if (!element.empty()) {
      mesh.fault("element", fmt::format("element: the kinds of elements stand in the mesh file; '{}' is none "
                                        "of the choices for its quadrilaterals of 8 nodes, Q8R and Q8",
                                        element));
    }
    return;
  }
  if (name.empty()) return;
  const auto file = find_data_file(name, parts.directory);
  if (!file) {
    mesh.fault("file",
               fmt::format("file: there is no mesh '{}' beside the case; correct the path or make the "
                           "mesh (gmsh -2 SHAPE.geo)",
                           name));
    return;
  }
  try {
    parts.result.problem.mesh = fem::read_gmsh(file->lexically_normal(), element);
  } catch (const InputError& error) {
    for (const Fault& fault : error.faults()) mesh.fault("file", fmt::format("{}: {}", name, fault.message));
  }
}

}  // namespace

void read_mesh(const Entry& entry, CaseParts& parts) {
  const std::size_t faults_before = parts.faults.size();
  Section mesh(entry, "mesh", parts.faults);
  const std::string element = mesh.choice_or("element", fem::element_names(), "Q8R");
  const Entry* rectangle = mesh.find("rectangle");
  const bool file = mesh.find("file") != nullptr;
  if (rectangle != nullptr && file) {
    mesh.fault("file", "either a file or a rectangle; remove one of them");
  } else if (rectangle != nullptr) {
    read_rectangle(*rectangle, element, parts);
  } else if (file) {
    read_file(mesh, element, parts);
  } else if (entry.kind == Entry::Kind::map) {
    parts.faults.push_back(
        entry.fault("mesh: the key 'rectangle' is missing; give a map with size and elements, or a 'file'"));
  }
  mesh.finish();
  parts.has_mesh = parts.faults.size() == faults_before;
}

}  // namespace polargrain::coupler
