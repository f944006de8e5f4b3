// SPDX-License-Identifier: GPL-2.0-or-later
#include "fem/solver/stabilisation.hpp"

#include <fmt/format.h>

#include <algorithm>

#include "common/packed_values.hpp"
#include "fem/material/rotation.hpp"
#include "fem/solver/discretisation.hpp"
#include "fem/solver/solver.hpp"

namespace polargrain::fem {
namespace {

/// Part of the elastic energy of the deformation in the patterns; two elements through a bent plate have a quarter, four 6 %.
constexpr double kNoticeable = 0.1;
constexpr double kRounding = 1e-10;  ///< strains of a body that nothing has moved
/// A point whose grains have parted leaves its patterns this part of their springs, so that the system stays regular.
constexpr double kLeastSecant = 1e-4;

/// Of a tangent taken as isotropic, Pa.
struct Moduli {
  double shear = 0.0;
  double bending = 0.0;  ///< Young's modulus; in plane strain E / (1 - nu^2)
};

template <int dim>
Moduli moduli_of(const typename Cosserat<dim>::Matrix& tangent) {
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
  if constexpr (dim == 2) return {shear, 4.0 * shear * (constrained - shear) / constrained};
  return {shear, shear * (3.0 * constrained - 4.0 * shear) / (constrained - shear)};
}

/// Mean stiffness against curvature, N.
template <int dim>
double couple_modulus(const typename Cosserat<dim>::Matrix& tangent) {
  using Counts = Cosserat<dim>;
  return tangent.template bottomRightCorner<Counts::couples, Counts::couples>().trace() / Counts::couples;
}

/// Of a tangent taken as isotropic, N: of the trace of the curvature, of its transpose, of itself.
template <int dim>
std::array<double, 3> couple_moduli_of(const typename Cosserat<dim>::Matrix& tangent) {
  using Counts = Cosserat<dim>;
  if constexpr (dim == 2) {
    return {0.0, 0.0, couple_modulus<dim>(tangent)};
  } else {
    std::array<double, 3> sums{};
    for (int i = 0; i < dim; ++i)
      for (int j = 0; j < dim; ++j) {
        if (i == j) continue;
        const int ij = Counts::couple_place(i, j);
        sums[0] += tangent(Counts::couple_place(i, i), Counts::couple_place(j, j));
        sums[1] += tangent(ij, Counts::couple_place(j, i));
        sums[2] += tangent(ij, ij);
      }
    for (double& sum : sums) sum /= dim * (dim - 1);
    return sums;
  }
}

/// Of the couple stresses that these moduli answer to a curvature, N/m.
template <int dim, class Curvature>
double norm_of_couples(const std::array<double, 3>& moduli, const Curvature& curvature) {
  if constexpr (dim == 2) {
    return moduli[2] * curvature.norm();
  } else {
    Eigen::Matrix3d couples = moduli[1] * curvature.transpose() + moduli[2] * curvature;
    couples.diagonal().array() += moduli[0] * curvature.trace();
    return couples.norm();
  }
}

/// The rotation of a deformation from the mesh as it was made.
template <int dim>
StretchAndTurn<dim> path_of(const typename Cosserat<dim>::Gradient& gradient) {
  Increment<dim> all;
  all.configuration = Configuration::start;
  all.displacement_gradient = gradient;
  return stretch_and_turn(all);
}

/// Norm of the symmetric part less its mean.
template <int dim>
double deviator_norm(const typename Cosserat<dim>::Gradient& tensor) {
  typename Cosserat<dim>::Gradient symmetric = 0.5 * (tensor + tensor.transpose());
  symmetric.diagonal().array() -= symmetric.trace() / dim;
  return symmetric.norm();
}

void raise(double& largest, double value) {
  largest = std::max(largest, value);
}

/// A norm over that of the first tangent. Without strain the point is as it was.
double over_first(double there, double expected, double rounding) {
  return expected > rounding ? std::clamp(there / expected, kLeastSecant, 1.0) : 1.0;
}

}  // namespace

template <int dim>
std::shared_ptr<Stabilisation<dim>> Stabilisation<dim>::of(const Mesh<dim>& mesh, Continuum continuum,
                                                           Deformation deformation, double share) {
  std::shared_ptr<Stabilisation> made(new Stabilisation(mesh, continuum, deformation, share));
  return made->elements_.empty() ? nullptr : made;
}

template <int dim>
Stabilisation<dim>::Stabilisation(const Mesh<dim>& mesh, Continuum continuum, Deformation deformation,
                                  double share)
    : continuum_(continuum), deformation_(deformation), share_(share) {
  for (std::size_t e = 0; e < mesh.elements.size(); ++e) {
    const Element<dim>& element = mesh.elements[e];
    if (element.type->averaged.empty()) continue;
    OfElement& made = elements_.emplace_back();
    made.number = static_cast<int>(e);
    const VectorRows<dim> nodes = mesh.element_positions(made.number);
    made.hourglass = hourglass_modes<dim>(*element.type, nodes);
    made.gradient = point_geometries<dim>(*element.type, nodes).front().gradient;
    for (const int node : element.nodes)
      for (const Dof dof : node_dofs<dim>()) made.entries.push_back(entry_of<dim>(node, dof));
  }
  Stabilisation::allocate();
}

template <int dim>
void Stabilisation<dim>::allocate() {
  for (OfElement& element : elements_) {
    element.shear_modulus = 0.0;
    element.couple_moduli = {};
    element.modulus = {};
    element.largest_stress = element.largest_elastic_stress = {};
    element.secant = {1.0, 1.0};
    element.first_stress.setZero();
    element.committed = {};
    if (turns()) element.committed.patterns.setZero(Cosserat<dim>::rotations, element.hourglass.modes.cols());
    element.trial = element.committed;
  }
}

// Moduli are those of the first tangent: later ones may be of plastic flow, which would let the patterns grow. A secant stays
// above zero.
template <int dim>
void Stabilisation<dim>::learn(const Discretisation<dim>& discretisation,
                               std::span<const Response<dim>> committed) {
  for (OfElement& element : elements_) {
    const Response<dim>& answer =
        committed[discretisation.first_point(static_cast<std::size_t>(element.number))];
    if (element.modulus.displacement > 0.0) {
      follow(element, answer.stress);
      continue;
    }
    const Moduli first = moduli_of<dim>(answer.tangent);
    element.shear_modulus = first.shear;
    element.modulus.displacement = share_ * first.bending;
    if (continuum_ == Continuum::cosserat) {
      element.couple_moduli = couple_moduli_of<dim>(answer.tangent);
      element.modulus.rotation = share_ * couple_modulus<dim>(answer.tangent);
    }
    element.first_stress = answer.stress;
  }
}

// Deviators, since the patterns bend and shear. They are compared in the axes of the material as it was first.
template <int dim>
void Stabilisation<dim>::follow(OfElement& element, const typename Cosserat<dim>::Vector& stress) const {
  using Counts = Cosserat<dim>;
  typename Counts::Vector change = stress;
  typename Counts::Gradient strain = element.committed.gradient;
  if (deformation_ == Deformation::large) {
    const StretchAndTurn<dim> path = path_of<dim>(strain);
    change = rotated(stress, inverse(path.turn));
    strain = path.stretch.displacement_gradient;
  }
  change -= element.first_stress;
  typename Counts::Gradient tensor;
  for (int i = 0; i < dim; ++i)
    for (int j = 0; j < dim; ++j) tensor(i, j) = change(Counts::stress_place(i, j));
  const double elastic = 2.0 * element.shear_modulus;
  Pair& largest = element.largest_stress;
  Pair& expected = element.largest_elastic_stress;
  raise(largest.displacement, deviator_norm<dim>(tensor));
  raise(expected.displacement, elastic * deviator_norm<dim>(strain));
  raise(largest.rotation, change.template tail<Counts::couples>().norm());
  raise(expected.rotation, norm_of_couples<dim>(element.couple_moduli, element.committed.curvature));
  // Large micro-rotations leave a curvature of rounding, which tells nothing of the stiffness.
  const double of_rounding = norm_of_couples<dim>(
      element.couple_moduli, CurvatureTensor(CurvatureTensor::Constant(kRounding * element.gradient.norm())));
  element.secant = {over_first(largest.displacement, expected.displacement, elastic * kRounding),
                    over_first(largest.rotation, expected.rotation, of_rounding)};
}

template <int dim>
Eigen::VectorXd Stabilisation<dim>::stiffness(const OfElement& element, int component) const {
  return (component < dim ? element.modulus.displacement * element.secant.displacement
                          : element.modulus.rotation * element.secant.rotation) *
         element.hourglass.weights;
}

// Half-way through the step the axes are known to second order; a step that turns the body alone adds nothing at all.
template <int dim>
typename Stabilisation<dim>::RotationPatterns Stabilisation<dim>::turned_patterns(
    OfElement& element, const Eigen::VectorXd& increment) const requires(dim == 3) {
  using Counts = Cosserat<dim>;
  const Moved& start = element.committed;
  Moved& end = element.trial;
  const Eigen::Map<const Eigen::Matrix<double, Counts::dofs, Eigen::Dynamic>> of_nodes(
      increment.data(), Counts::dofs, increment.size() / Counts::dofs);
  const typename Counts::Gradient half_way = 0.5 * (start.gradient + end.gradient);
  const Turn<dim> back = inverse(path_of<dim>(half_way).turn);
  const auto rotations = of_nodes.template bottomRows<Counts::rotations>();
  end.curvature = start.curvature + back * rotations * element.gradient;
  end.patterns = start.patterns + back * rotations * element.hourglass.modes;
  return path_of<dim>(end.gradient).turn * end.patterns;
}

template <int dim>
std::string Stabilisation<dim>::evaluate(const NodalStep& step, NodalForces& forces) {
  using Counts = Cosserat<dim>;
  for (OfElement& element : elements_) {
    if (!(element.modulus.displacement > 0.0))
      return fmt::format("element {} has no stiffness at the start that its patterns could be held by",
                         element.number);
    const Eigen::VectorXd values = step.end(element.entries);
    const Eigen::Map<const Eigen::Matrix<double, Counts::dofs, Eigen::Dynamic>> of_nodes(
        values.data(), Counts::dofs, values.size() / Counts::dofs);
    Eigen::MatrixXd patterns = of_nodes * element.hourglass.modes;  // a row an unknown, a column a mode
    element.trial.gradient = of_nodes.template topRows<dim>() * element.gradient;
    element.trial.curvature = of_nodes.template bottomRows<Counts::rotations>() * element.gradient;
    if constexpr (dim == 3)
      if (turns())
        patterns.template bottomRows<Counts::rotations>() =
            turned_patterns(element, step.increment(element.entries));
    Eigen::MatrixXd resisted = patterns;
    for (int i = 0; i < Counts::dofs; ++i)
      resisted.row(i).array() *= stiffness(element, i).transpose().array();
    const Eigen::MatrixXd own = resisted * element.hourglass.modes.transpose();
    forces.internal(element.entries) += own.reshaped();

    const Eigen::VectorXd squares = patterns.array().square().matrix() * element.hourglass.weights;
    element.trial.energy = {0.5 * element.modulus.displacement * squares.head(dim).sum(),
                            0.5 * element.modulus.rotation * squares.tail(Counts::rotations).sum()};
  }
  return {};
}

template <int dim>
void Stabilisation<dim>::commit() {
  for (OfElement& element : elements_) element.committed = element.trial;
}

// Both parts are energies of elastic elements, whatever the material has become: this is a statement on the deformation.
template <int dim>
std::string Stabilisation<dim>::doubt(const Solver<dim>& solver) const {
  double seen = 0.0;
  double unseen = 0.0;
  double at_rest = 0.0;  // of strains that are rounding alone
  std::size_t point = 0;
  for (const OfElement& element : elements_) {
    while (solver.element_of_point(point) != element.number) ++point;
    typename Cosserat<dim>::Gradient strain;
    for (int i = 0; i < dim; ++i)
      for (int j = 0; j < dim; ++j)
        strain(i, j) = solver.state().strain[point](Cosserat<dim>::stress_place(i, j));
    const double stiffness = 0.5 * element.modulus.displacement / share_ * solver.volume_of_point(point);
    seen += stiffness * (0.5 * (strain + strain.transpose())).squaredNorm();
    unseen += (element.committed.energy.displacement + element.committed.energy.rotation) / share_;
    at_rest += stiffness * kRounding * kRounding;
  }
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
  std::vector<double> values;
  for (const OfElement& element : elements_) {
    const Moved& moved = element.committed;
    for (const Pair& pair : {element.modulus, element.largest_stress, element.largest_elastic_stress,
                             element.secant, moved.energy})
      values.insert(values.end(), {pair.displacement, pair.rotation});
    values.push_back(element.shear_modulus);
    values.insert(values.end(), element.couple_moduli.begin(), element.couple_moduli.end());
    values.insert(values.end(), moved.curvature.reshaped().begin(), moved.curvature.reshaped().end());
    values.insert(values.end(), element.first_stress.begin(), element.first_stress.end());
    values.insert(values.end(), moved.gradient.reshaped().begin(), moved.gradient.reshaped().end());
    values.insert(values.end(), moved.patterns.reshaped().begin(), moved.patterns.reshaped().end());
  }
  archive.write("stabilisation", std::span<const double>(values));
}

template <int dim>
void Stabilisation<dim>::restore(ArchiveReader& archive) {
  std::size_t length = 14 + Cosserat<dim>::components + dim * dim + dim * Cosserat<dim>::rotations;
  // Patterns of one type of element, since no other has springs in space.
  if (turns()) length += static_cast<std::size_t>(elements_.front().committed.patterns.size());
  const std::vector<double> values = read_lists(archive, "stabilisation", elements_.size(), length);
  auto value = values.begin();
  for (OfElement& element : elements_) {
    Moved& moved = element.committed;
    for (Pair* const pair : {&element.modulus, &element.largest_stress, &element.largest_elastic_stress,
                             &element.secant, &moved.energy}) {
      pair->displacement = *value++;
      pair->rotation = *value++;
    }
    element.shear_modulus = *value++;
    for (double& modulus : element.couple_moduli) modulus = *value++;
    for (double& part : moved.curvature.reshaped()) part = *value++;
    for (double& stress : element.first_stress) stress = *value++;
    for (double& part : moved.gradient.reshaped()) part = *value++;
    for (double& part : moved.patterns.reshaped()) part = *value++;
    element.trial = moved;
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
