// SPDX-License-Identifier: GPL-2.0-or-later
#pragma once
#include <map>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "fem/solver/solver.hpp"

namespace polargrain::fem {

/// Fields of the committed points of materials (Material::fields), by point and name.
template <int dim>
class MaterialValues {
 public:
  /// @param solver must live as long as this, and commit nothing meanwhile
  explicit MaterialValues(const Solver<dim>& solver) : solver_(solver) {}

  /// Nothing where the material of the point has no field of that name.
  std::optional<double> at(std::size_t point, std::string_view name);

 private:
  const Solver<dim>& solver_;
  std::map<const Material<dim>*, std::vector<std::string>> names_;
  std::optional<std::size_t> point_;  ///< whose values are at hand
  const std::vector<std::string>* own_names_ = nullptr;
  std::vector<double> values_;
};

}  // namespace polargrain::fem
