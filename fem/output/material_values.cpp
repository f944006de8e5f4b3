// SPDX-License-Identifier: GPL-2.0-or-later
#include "fem/output/material_values.hpp"

#include <algorithm>

namespace polargrain::fem {

template <int dim>
std::optional<double> MaterialValues<dim>::at(std::size_t point, std::string_view name) {
  if (point_ != point) {
    const auto [material, number] = solver_.material_of_point(point);
    const auto [known, added] = names_.try_emplace(material);
    if (added) known->second = material->field_names();
    own_names_ = &known->second;
    values_.assign(own_names_->size(), 0.0);
    material->fields(number, values_);
    point_ = point;
  }
  const auto place = std::ranges::find(*own_names_, name);
  if (place == own_names_->end()) return std::nullopt;
  return values_[static_cast<std::size_t>(place - own_names_->begin())];
}

template class MaterialValues<2>;
template class MaterialValues<3>;

}  // namespace polargrain::fem
