// SPDX-License-Identifier: GPL-2.0-or-later
#include "fem/solver/free_rotations.hpp"

#include "fem/element/dofs.hpp"

#include <fmt/format.h>

#include <array>
#include <cmath>
#include <numeric>
#include <optional>
#include <set>
#include <vector>

namespace polargrain::fem {
namespace {

/// Stiffnesses below this share of the largest count as zero.
constexpr double kNothing = 1e-14;

/// Whether a tangent resists a relative rotation about each axis.
template <int dim>
std::array<bool, Cosserat<dim>::rotations> skew_stiffness(const typename Cosserat<dim>::Matrix& d) {
  using Counts = Cosserat<dim>;
  const double largest = d.template topLeftCorner<Counts::stresses, Counts::stresses>().cwiseAbs().maxCoeff();
  std::array<bool, Counts::rotations> stiff{};
  for (int k = 0; k < Counts::rotations; ++k) {
    const int i = (Counts::axis(k) + 1) % 3;
    const int j = (Counts::axis(k) + 2) % 3;
    const int ij = Counts::stress_place(i, j);
    const int ji = Counts::stress_place(j, i);
    const double skew = d(ji, ji) + d(ij, ij) - d(ji, ij) - d(ij, ji);
    stiff[static_cast<std::size_t>(k)] = std::abs(skew) > kNothing * largest;
  }
  return stiff;
}

template <int dim>
bool has_couple_stiffness(const typename Cosserat<dim>::Matrix& d, double element_volume) {
  using Counts = Cosserat<dim>;
  const double area = dim == 2 ? element_volume : std::pow(element_volume, 2.0 / 3.0);
  const double couple =
      d.template bottomRightCorner<Counts::couples, Counts::couples>().cwiseAbs().maxCoeff();
  return couple > kNothing * area *
                      d.template topLeftCorner<Counts::stresses, Counts::stresses>().cwiseAbs().maxCoeff();
}

}  // namespace

// Each rotation of a node is followed for itself: couple stiffness hands the resistance about an axis on within an element.
template <int dim>
std::string unresisted_rotation(const Mesh<dim>& mesh, const Discretisation<dim>& discretisation,
                                const Constraints<dim>& constraints,
                                std::span<const Response<dim>> responses) {
  constexpr auto rotations = static_cast<std::size_t>(Cosserat<dim>::rotations);
  const auto number_of = [](int node, std::size_t k) {
    return rotations * static_cast<std::size_t>(node) + k;
  };
  const auto dof_of = [](std::size_t k) { return node_dofs<dim>()[dim + k]; };
  const std::size_t count = rotations * mesh.nodes.size();
  std::vector<std::size_t> root(count);
  std::iota(root.begin(), root.end(), std::size_t{0});
  const auto find = [&](std::size_t item) {
    while (root[item] != item) item = root[item] = root[root[item]];
    return item;
  };
  std::vector<char> stiff(count, 0);
  std::vector<char> used(count, 0);
  for (std::size_t e = 0; e < discretisation.elements(); ++e) {
    if (!discretisation.is_there(e)) continue;
    std::array<bool, rotations> skew{};
    bool couple = false;
    for (std::size_t i = discretisation.first_point(e); i < discretisation.first_point(e + 1); ++i) {
      const auto here = skew_stiffness<dim>(responses[i].tangent);
      for (std::size_t k = 0; k < rotations; ++k) skew[k] = skew[k] || here[k];
      couple = couple || has_couple_stiffness<dim>(responses[i].tangent, discretisation.point(i).volume);
    }
    const int first = mesh.elements[e].nodes.front();
    for (const int node : mesh.elements[e].nodes) {
      for (std::size_t k = 0; k < rotations; ++k) {
        used[number_of(node, k)] = 1;
        if (skew[k]) stiff[number_of(node, k)] = 1;
        if (couple) root[find(number_of(node, k))] = find(number_of(first, k));
      }
    }
  }
  // Nodes whose micro-rotation is one unknown.
  std::vector<std::optional<std::size_t>> item_of(static_cast<std::size_t>(constraints.unknowns()));
  std::vector<char> held(count, 0);
  const auto for_each = [&](auto visit) {
    for (std::size_t node = 0; node < mesh.nodes.size(); ++node)
      for (std::size_t k = 0; k < rotations; ++k)
        visit(node, rotations * node + k, entry_of<dim>(node, dof_of(k)));
  };
  for_each([&](std::size_t, std::size_t item, std::size_t entry) {
    const int equation = constraints.equation(entry);
    if (equation < 0) return;
    auto& first = item_of[static_cast<std::size_t>(equation)];
    if (!first) first = item;
    root[find(item)] = find(*first);
  });
  for_each([&](std::size_t, std::size_t item, std::size_t entry) {
    if (stiff[item] != 0 || !constraints.is_free(entry)) held[find(item)] = 1;
  });
  std::set<std::size_t> free;
  for_each([&](std::size_t node, std::size_t item, std::size_t) {
    if (used[item] != 0 && held[find(item)] == 0) free.insert(node);
  });
  if (free.empty()) return {};
  return fmt::format(
      "nothing resists the micro-rotation of {} nodes, one at {}: give the material a Cosserat "
      "shear modulus Gc above zero, fix {} there, or use the Cauchy continuum",
      free.size(), place_text<dim>(mesh.nodes[*free.begin()]), dim == 2 ? "w" : "w1, w2 and w3");
}

template std::string unresisted_rotation<2>(const Mesh<2>& mesh, const Discretisation<2>& discretisation,
                                            const Constraints<2>& constraints,
                                            std::span<const Response<2>> responses);
template std::string unresisted_rotation<3>(const Mesh<3>& mesh, const Discretisation<3>& discretisation,
                                            const Constraints<3>& constraints,
                                            std::span<const Response<3>> responses);

}  // namespace polargrain::fem
