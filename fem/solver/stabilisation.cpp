// SPDX-License-Identifier: GPL-2.0-or-later
#include "fem/solver/stabilisation.hpp"

#include <fmt/format.h>

#include <array>

#include "common/packed_values.hpp"
#include "fem/solver/discretisation.hpp"
#include "fem/solver/solver.hpp"

namespace polargrain::fem {
namespace {

/// Part of the elastic energy of the deformation in the patterns; two elements through a bent plate have a quarter, four 6 %.
constexpr double kNoticeable = 0.1;
constexpr double kRounding = 1e-10;  ///< strains of a body that nothing has moved

/// Young's modulus (plane strain: the modulus of bending, E / (1 - nu^2)) of a tangent taken as isotropic, Pa.
template <int dim>
double bending_modulus(const typename Cosserat<dim>::Matrix& tangent) {
  using Counts = Cosserat<dim>;
  double constrained = 0.0;
  double shear = 0.0;
  for (int i = 0; i < dim; ++i) {
    const int ii = Counts::stress_place(i, i);
    constrained += tangent(ii, ii) / dim;
    for (int j = 0; j < dim; ++j) {
      if (i == j) continue;
      const int ij = Counts::stress_place(i, j);
      shear += 0.5 * (tangent(ij, ij) + tangent(ij, Counts::stress_place(j, i))) / (dim * (dim - 1));
    }
  }
  if constexpr (dim == 2) return 4.0 * shear * (constrained - shear) / constrained;
  return shear * (3.0 * constrained - 4.0 * shear) / (constrained - shear);
}

/// Mean stiffness against curvature, N.
template <int dim>
double couple_modulus(const typename Cosserat<dim>::Matrix& tangent) {
  using Counts = Cosserat<dim>;
  return tangent.template bottomRightCorner<Counts::couples, Counts::couples>().trace() / Counts::couples;
}

}  // namespace

template <int dim>
std::shared_ptr<Stabilisation<dim>> Stabilisation<dim>::of(const Mesh<dim>& mesh, Continuum continuum,
                                                           double share) {
  std::shared_ptr<Stabilisation> made(new Stabilisation(mesh, continuum, share));
  return made->elements_.empty() ? nullptr : made;
}

template <int dim>
Stabilisation<dim>::Stabilisation(const Mesh<dim>& mesh, Continuum continuum, double share)
    : continuum_(continuum), share_(share) {
  for (std::size_t e = 0; e < mesh.elements.size(); ++e) {
    const Element<dim>& element = mesh.elements[e];
    if (element.type->averaged.empty()) continue;
    OfElement& made = elements_.emplace_back();
    made.number = static_cast<int>(e);
    made.hourglass = hourglass_modes<dim>(*element.type, mesh.element_positions(made.number));
    for (const int node : element.nodes)
      for (const Dof dof : node_dofs<dim>()) made.entries.push_back(entry_of<dim>(node, dof));
  }
}

template <int dim>
void Stabilisation<dim>::allocate() {
  for (OfElement& element : elements_) element.displacement_modulus = element.rotation_modulus = 0.0;
  energy_ = trial_energy_ = 0.0;
}

// Later tangents may be those of plastic flow, which would let the patterns grow.
template <int dim>
void Stabilisation<dim>::learn(const Discretisation<dim>& discretisation,
                               std::span<const Response<dim>> committed) {
  for (OfElement& element : elements_) {
    if (element.displacement_modulus > 0.0) continue;
    const auto& tangent =
        committed[discretisation.first_point(static_cast<std::size_t>(element.number))].tangent;
    element.displacement_modulus = share_ * bending_modulus<dim>(tangent);
    if (continuum_ == Continuum::cosserat) element.rotation_modulus = share_ * couple_modulus<dim>(tangent);
  }
}

template <int dim>
Eigen::VectorXd Stabilisation<dim>::stiffness(const OfElement& element, int component) const {
  return (component < dim ? element.displacement_modulus : element.rotation_modulus) *
         element.hourglass.weights;
}

template <int dim>
std::string Stabilisation<dim>::evaluate(const NodalStep& step, NodalForces& forces) {
  trial_energy_ = 0.0;
  for (const OfElement& element : elements_) {
    if (!(element.displacement_modulus > 0.0))
      return fmt::format("element {} has no stiffness at the start that its patterns could be held by",
                         element.number);
    const Eigen::VectorXd values = step.end(element.entries);
    const Eigen::Map<const Eigen::Matrix<double, Cosserat<dim>::dofs, Eigen::Dynamic>> of_nodes(
        values.data(), Cosserat<dim>::dofs, values.size() / Cosserat<dim>::dofs);
    const Eigen::MatrixXd patterns = of_nodes * element.hourglass.modes;  // a row an unknown, a column a mode
    Eigen::MatrixXd resisted = patterns;
    for (int i = 0; i < Cosserat<dim>::dofs; ++i)
      resisted.row(i).array() *= stiffness(element, i).transpose().array();
    trial_energy_ += 0.5 * patterns.cwiseProduct(resisted).sum();
    const Eigen::MatrixXd own = resisted * element.hourglass.modes.transpose();
    forces.internal(element.entries) += own.reshaped();
  }
  return {};
}

// Both parts are energies of elastic elements, whatever the material has become: this is a statement on the deformation.
template <int dim>
std::string Stabilisation<dim>::doubt(const Solver<dim>& solver) const {
  double seen = 0.0;
  double at_rest = 0.0;  // of strains that are rounding alone
  std::size_t point = 0;
  for (const OfElement& element : elements_) {
    while (solver.element_of_point(point) != element.number) ++point;
    typename Cosserat<dim>::Gradient strain;
    for (int i = 0; i < dim; ++i)
      for (int j = 0; j < dim; ++j)
        strain(i, j) = solver.state().strain[point](Cosserat<dim>::stress_place(i, j));
    const double stiffness = 0.5 * element.displacement_modulus / share_ * solver.volume_of_point(point);
    seen += stiffness * (0.5 * (strain + strain.transpose())).squaredNorm();
    at_rest += stiffness * kRounding * kRounding;
  }
  const double unseen = energy_ / share_;
  const double part = unseen / (seen + unseen);
  if (unseen <= at_rest || part <= kNoticeable) return {};
  return fmt::format(
      "{:.0f} % of the deformation, by its elastic energy, are patterns that the points of elements with one point do "
      "not see: springs resist these with {:.0f} % of the stiffness, so the body is too soft. Take more elements over "
      "the thickness that bends, or elements with more points",
      100.0 * part, 100.0 * share_);
}

template <int dim>
Eigen::MatrixXd Stabilisation<dim>::tangent(std::size_t number) const {
  const OfElement& element = elements_[number];
  const Eigen::MatrixXd& modes = element.hourglass.modes;
  const auto size = static_cast<Eigen::Index>(element.entries.size());
  Eigen::MatrixXd made = Eigen::MatrixXd::Zero(size, size);
  for (int i = 0; i < Cosserat<dim>::dofs; ++i) {
    const Eigen::MatrixXd of_component = modes * stiffness(element, i).asDiagonal() * modes.transpose();
    for (Eigen::Index a = 0; a < modes.rows(); ++a)
      for (Eigen::Index b = 0; b < modes.rows(); ++b)
        made(Cosserat<dim>::dofs * a + i, Cosserat<dim>::dofs * b + i) = of_component(a, b);
  }
  return made;
}

template <int dim>
void Stabilisation<dim>::save(ArchiveWriter& archive) const {
  std::vector<double> moduli{energy_};
  for (const OfElement& element : elements_) {
    moduli.push_back(element.displacement_modulus);
    moduli.push_back(element.rotation_modulus);
  }
  archive.write("stabilisation", std::span<const double>(moduli));
}

template <int dim>
void Stabilisation<dim>::restore(ArchiveReader& archive) {
  const std::vector<double> moduli = read_lists(archive, "stabilisation", 1, 1 + 2 * elements_.size());
  energy_ = trial_energy_ = moduli[0];
  for (std::size_t k = 0; k < elements_.size(); ++k) {
    elements_[k].displacement_modulus = moduli[1 + 2 * k];
    elements_[k].rotation_modulus = moduli[2 + 2 * k];
  }
}

template <int dim>
std::string doubt_of_one_point_elements(const Solver<dim>& solver) {
  for (const auto& contribution : solver.problem().contributions)
    if (const auto* const springs = dynamic_cast<const Stabilisation<dim>*>(contribution.get()))
      return springs->doubt(solver);
  return {};
}

template class Stabilisation<2>;
template class Stabilisation<3>;
template std::string doubt_of_one_point_elements<2>(const Solver<2>& solver);
template std::string doubt_of_one_point_elements<3>(const Solver<3>& solver);

}  // namespace polargrain::fem
