// SPDX-License-Identifier: GPL-2.0-or-later
#include "fem/solver/nodal_field.hpp"

#include "fem/element/dofs.hpp"

namespace polargrain::fem {

template <int dim>
FieldPlaces<dim>::FieldPlaces(std::size_t mesh_nodes, const std::vector<NodalField>& fields)
    : starts_{entry_of<dim>(static_cast<Eigen::Index>(mesh_nodes))} {
  for (const NodalField& field : fields) {
    std::vector<int>& entries = entries_.emplace_back(mesh_nodes, -1);
    auto entry = static_cast<int>(starts_.back());
    for (const int node : field.nodes) entries[static_cast<std::size_t>(node)] = entry++;
    starts_.push_back(entry);
  }
}

std::size_t number_of_field(const std::vector<NodalField>& fields, const std::string& name) {
  std::size_t number = 0;
  while (number < fields.size() && fields[number].name != name) ++number;
  return number;
}

template class FieldPlaces<2>;
template class FieldPlaces<3>;

}  // namespace polargrain::fem
