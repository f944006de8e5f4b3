// SPDX-License-Identifier: GPL-2.0-or-later
#include "fem/solver/end_of_run.hpp"

#include <algorithm>
#include <array>

#include "common/error.hpp"

namespace polargrain::fem {

template <int dim>
std::vector<typename EndOfRun<dim>::Point> EndOfRun<dim>::points() const {
  std::vector<Point> all;
  std::vector<std::size_t> next(material_of_region.size(), 0);
  for (std::size_t e = 0; e < mesh.elements.size(); ++e) {
    const ElementType<dim>& type = *mesh.elements[e].type;
    const VectorRows<dim> nodes = mesh.element_positions(static_cast<int>(e));
    const std::size_t material = material_of_region[region_of_element[e]];
    for (const QuadraturePoint<dim>& point : type.quadrature)
      all.push_back({nodes.transpose() * type.shape_functions(point.position).value, static_cast<int>(e),
                     next[material]++});
  }
  return all;
}

template <int dim>
std::size_t EndOfRun<dim>::points_of_material(std::size_t material) const {
  std::size_t count = 0;
  for (std::size_t e = 0; e < mesh.elements.size(); ++e)
    if (material_of_region[region_of_element[e]] == material)
      count += mesh.elements[e].type->quadrature.size();
  return count;
}

template <int dim>
void write_end(ArchiveWriter& archive, const EndOfRun<dim>& end) {
  const std::vector<std::string> types = element_names<dim>();
  std::vector<double> nodes;
  for (const auto& node : end.mesh.nodes) nodes.insert(nodes.end(), node.begin(), node.end());
  std::vector<std::int64_t> elements;
  for (std::size_t e = 0; e < end.mesh.elements.size(); ++e) {
    const Element<dim>& element = end.mesh.elements[e];
    elements.push_back(std::ranges::find(types, element.type->name) - types.begin());
    elements.push_back(static_cast<std::int64_t>(end.region_of_element[e]));
    elements.push_back(end.there[e]);
    elements.insert(elements.end(), element.nodes.begin(), element.nodes.end());
  }
  const std::vector<std::int64_t> materials(end.material_of_region.begin(), end.material_of_region.end());
  archive.write("nodes", std::span<const double>(nodes));
  archive.write("elements", std::span<const std::int64_t>(elements));
  archive.write("materials_of_regions", std::span<const std::int64_t>(materials));
  archive.write("dimension", std::span<const std::int64_t>(std::array<std::int64_t, 1>{dim}));
}

template <int dim>
EndOfRun<dim> read_end(ArchiveReader& archive) {
  const auto refuse_unless = [](bool right, const char* message) {
    if (!right) throw RunError(message);
  };
  refuse_unless(archive.integers("dimension") == std::vector<std::int64_t>{dim},
                "its body is of another dimension: one is of the plane, the other in space");
  constexpr const char* kDamaged = "its mesh is damaged";
  const std::vector<std::string> types = element_names<dim>();
  const std::vector<double> nodes = archive.doubles("nodes");
  const std::vector<std::int64_t> elements = archive.integers("elements");
  const std::vector<std::int64_t> materials = archive.integers("materials_of_regions");
  EndOfRun<dim> end;
  for (std::size_t at = 0; at + dim <= nodes.size(); at += dim)
    end.mesh.nodes.emplace_back(Eigen::Map<const typename Cosserat<dim>::Place>(&nodes[at]));
  for (const std::int64_t material : materials) {
    refuse_unless(material >= 0 && material < static_cast<std::int64_t>(materials.size()), kDamaged);
    end.material_of_region.push_back(static_cast<std::size_t>(material));
  }
  for (std::size_t at = 0; at < elements.size();) {
    refuse_unless(at + 3 <= elements.size() && elements[at] >= 0 &&
                      elements[at] < static_cast<std::int64_t>(types.size()) && elements[at + 1] >= 0 &&
                      elements[at + 1] < static_cast<std::int64_t>(materials.size()),
                  kDamaged);
    const ElementType<dim>& type = element_type<dim>(types[static_cast<std::size_t>(elements[at])]);
    end.region_of_element.push_back(static_cast<std::size_t>(elements[at + 1]));
    end.there.push_back(elements[at + 2] != 0 ? 1 : 0);
    at += 3;
    refuse_unless(at + static_cast<std::size_t>(type.nodes) <= elements.size(), kDamaged);
    Element<dim>& element = end.mesh.elements.emplace_back(Element<dim>{&type, {}});
    for (int a = 0; a < type.nodes; ++a, ++at) {
      refuse_unless(elements[at] >= 0 && elements[at] < static_cast<std::int64_t>(end.mesh.nodes.size()),
                    kDamaged);
      element.nodes.push_back(static_cast<int>(elements[at]));
    }
  }
  return end;
}

template <int dim>
bool is_same_mesh(const Mesh<dim>& one, const Mesh<dim>& other) {
  return one.nodes == other.nodes &&
         std::ranges::equal(one.elements, other.elements, [](const Element<dim>& a, const Element<dim>& b) {
           return a.type == b.type && a.nodes == b.nodes;
         });
}

template struct EndOfRun<2>;
template struct EndOfRun<3>;
template void write_end<2>(ArchiveWriter&, const EndOfRun<2>&);
template void write_end<3>(ArchiveWriter&, const EndOfRun<3>&);
template EndOfRun<2> read_end<2>(ArchiveReader&);
template EndOfRun<3> read_end<3>(ArchiveReader&);
template bool is_same_mesh<2>(const Mesh<2>&, const Mesh<2>&);
template bool is_same_mesh<3>(const Mesh<3>&, const Mesh<3>&);

}  // namespace polargrain::fem
