// SPDX-License-Identifier: GPL-2.0-or-later
#include "fem/solver/quiet_boundary.hpp"

#include <Eigen/LU>
#include <algorithm>
#include <cmath>
#include <set>
#include <utility>

#include "fem/solver/loads.hpp"

namespace polargrain::fem {
namespace {

/// Moduli of plane waves along a direction, Pa.
struct WaveModuli {
  double along;
  double across;
};

/// Of the symmetric part of a tangent: micro-rotations follow slow waves.
template <int dim>
WaveModuli wave_moduli(const typename Cosserat<dim>::Matrix& tangent,
                       const typename Cosserat<dim>::Place& normal) {
  using Counts = Cosserat<dim>;
  // C_ijkl n_j n_l, the tensor of Christoffel, symmetrised in ij and kl.
  Eigen::Matrix<double, dim, dim> christoffel = Eigen::Matrix<double, dim, dim>::Zero();
  for (int i = 0; i < dim; ++i)
    for (int k = 0; k < dim; ++k)
      for (int j = 0; j < dim; ++j)
        for (int l = 0; l < dim; ++l) {
          double sum = 0.0;
          for (const auto& [a, b] : {std::pair{i, j}, std::pair{j, i}})
            for (const auto& [c, d] : {std::pair{k, l}, std::pair{l, k}})
              sum += 0.25 * tangent(Counts::stress_place(a, b), Counts::stress_place(c, d));
          christoffel(i, k) += sum * normal(j) * normal(l);
        }
  const double along = normal.dot(christoffel * normal);
  return {along, (christoffel.trace() - along) / (dim - 1)};
}

}  // namespace

template <int dim>
QuietBoundary<dim>::QuietBoundary(const Problem<dim>& problem, const Discretisation<dim>& discretisation,
                                  const std::vector<Response<dim>>& answers,
                                  const std::vector<double>& densities) {
  for (const std::string& boundary : problem.quiet) {
    for (const ShareOfSide<dim>& share : shares_of_boundary(problem.mesh, boundary)) {
      const auto element = static_cast<std::size_t>(share.element);
      typename Cosserat<dim>::Matrix tangent = Cosserat<dim>::Matrix::Zero();
      const std::size_t first = discretisation.first_point(element);
      const std::size_t last = discretisation.first_point(element + 1);
      for (std::size_t point = first; point < last; ++point)
        tangent += answers[point].tangent / static_cast<double>(last - first);
      const WaveModuli moduli = wave_moduli<dim>(tangent, share.normal);
      const Dashpot straight = share.normal * share.normal.transpose();
      const auto [place, is_new] = dashpots_.try_emplace(share.node, Dashpot::Zero());
      place->second +=
          share.area * (std::sqrt(densities[element] * moduli.along) * straight +
                        std::sqrt(densities[element] * moduli.across) * (Dashpot::Identity() - straight));
    }
  }
}

template <int dim>
QuietBoundary<dim>::QuietBoundary(const std::vector<double>& values) {
  constexpr std::size_t kRow = 1 + dim * dim;
  for (std::size_t at = 0; at + kRow <= values.size(); at += kRow)
    dashpots_[static_cast<int>(values[at])] = Eigen::Map<const Dashpot>(&values[at + 1]);
}

template <int dim>
std::vector<double> QuietBoundary<dim>::values() const {
  std::vector<double> all;
  for (const auto& [node, dashpot] : dashpots_) {
    all.push_back(node);
    all.insert(all.end(), dashpot.data(), dashpot.data() + dashpot.size());
  }
  return all;
}

template <int dim>
void QuietBoundary<dim>::join(const Constraints<dim>& constraints) {
  std::map<std::array<int, dim>, int> first;  // node of such equations
  std::map<int, Dashpot> joined;
  for (const auto& [node, dashpot] : dashpots_) {
    std::array<int, dim> equations{};
    for (int i = 0; i < dim; ++i)
      equations[static_cast<std::size_t>(i)] =
          constraints.equation(static_cast<std::size_t>(entry_of<dim>(node) + i));
    const bool moves = std::ranges::any_of(equations, [](int equation) { return equation >= 0; });
    const int at = moves ? first.try_emplace(equations, node).first->second : node;
    joined.try_emplace(at, Dashpot::Zero()).first->second += dashpot;
  }
  dashpots_ = std::move(joined);
}

template <int dim>
std::vector<std::size_t> QuietBoundary<dim>::entries(const Problem<dim>& problem) const {
  std::set<std::size_t> held;
  for (const PrescribedDof<dim>& item : problem.prescribed) {
    if (std::ranges::find(problem.quiet, item.on) != problem.quiet.end()) continue;
    for (const int node : problem.mesh.nodes_on(item.on))
      held.insert(entry_of<dim>(static_cast<std::size_t>(node), item.dof));
  }
  std::vector<std::size_t> all;
  for (const auto& [node, dashpot] : dashpots_)
    for (std::size_t i = 0; i < dim; ++i)
      if (const std::size_t entry = entry_of<dim>(static_cast<std::size_t>(node)) + i; !held.contains(entry))
        all.push_back(entry);
  return all;
}

template <int dim>
void QuietBoundary<dim>::add_forces(const Constraints<dim>& constraints, const Eigen::VectorXd& velocity,
                                    Eigen::VectorXd& forces) const {
  for (const auto& [node, dashpot] : dashpots_) {
    typename Cosserat<dim>::Place speed = Cosserat<dim>::Place::Zero();
    const auto first = static_cast<std::size_t>(entry_of<dim>(node));
    for (std::size_t i = 0; i < dim; ++i)
      if (const int equation = constraints.equation(first + i); equation >= 0)
        speed(static_cast<Eigen::Index>(i)) = velocity(equation);
    forces.template segment<dim>(static_cast<Eigen::Index>(first)) -= dashpot * speed;
  }
}

template <int dim>
typename QuietBoundary<dim>::Absorbed QuietBoundary<dim>::apply(const Constraints<dim>& constraints,
                                                                const Eigen::VectorXd& velocity,
                                                                const Eigen::VectorXd& masses, double seconds,
                                                                Eigen::VectorXd& next) const {
  Absorbed absorbed;
  for (const auto& [node, dashpot] : dashpots_) {
    // M (next - before) / dt = f - C (next + before) / 2; `next` holds the answer without C.
    Dashpot left = 0.5 * seconds * dashpot;
    Eigen::Matrix<double, dim, 1> before = Eigen::Matrix<double, dim, 1>::Zero();
    Eigen::Matrix<double, dim, 1> without = before;
    std::array<int, dim> equations{};
    for (int i = 0; i < dim; ++i) {
      const auto place = static_cast<std::size_t>(i);
      equations[place] = constraints.equation(static_cast<std::size_t>(entry_of<dim>(node) + i));
      if (equations[place] < 0) {  // moved by the case, along that axis
        left.row(i).setZero();
        left(i, i) = 1.0;
        continue;
      }
      before(i) = velocity(equations[place]);
      without(i) = masses(equations[place]) * next(equations[place]);
      left(i, i) += masses(equations[place]);
    }
    Eigen::Matrix<double, dim, 1> right = without - 0.5 * seconds * dashpot * before;
    for (int i = 0; i < dim; ++i)
      if (equations[static_cast<std::size_t>(i)] < 0) right(i) = 0.0;
    const Eigen::Matrix<double, dim, 1> after = left.partialPivLu().solve(right);
    const Eigen::Matrix<double, dim, 1> mean = 0.5 * (before + after);
    absorbed.over_step += seconds * mean.dot(dashpot * mean);
    absorbed.first_half += 0.5 * seconds * mean.dot(dashpot * before);
    for (int i = 0; i < dim; ++i)
      if (const int equation = equations[static_cast<std::size_t>(i)]; equation >= 0)
        next(equation) = after(i);
  }
  return absorbed;
}

template class QuietBoundary<2>;
template class QuietBoundary<3>;

}  // namespace polargrain::fem
