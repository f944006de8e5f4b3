// SPDX-License-Identifier: GPL-2.0-or-later
#include "fem/spread/spread_slip.hpp"

#include <algorithm>
#include <cmath>
#include <iterator>
#include <set>

#include "common/error.hpp"
#include "fem/element/corner_shape.hpp"
#include "fem/element/dofs.hpp"
#include "fem/element/large_tangent.hpp"

namespace polargrain::fem {
namespace {

/// Full width at half maximum of (1 + |x|/l) exp(-|x|/l) over l: twice the root of (1 + x) exp(-x) = 1/2.
constexpr double kWidthOverLength = 3.356693980033321;
constexpr int kFields = static_cast<int>(std::size(kSpreadFields));

}  // namespace

template <int dim>
SpreadSlip<dim>::SpreadSlip(const Problem<dim>& problem, std::size_t field,
                            const std::map<std::string, std::shared_ptr<SlipDriven<dim>>>& materials,
                            SpreadOptions options)
    : options_(options), continuum_(problem.continuum), moves_(problem.deformation == Deformation::large) {
  const FieldPlaces<dim> places = problem.places();
  // The points of a material stand in the order of the mesh, whatever regions they are in (PointMaterials).
  std::map<int, std::size_t> batch_of_element;
  for (const auto& [region, material] : materials) {
    std::size_t batch = 0;
    while (batch < batches_.size() && batches_[batch].material != material) ++batch;
    if (batch == batches_.size()) batches_.push_back({material, {}});
    for (const int e : problem.mesh.regions.at(region)) batch_of_element[e] = batch;
  }
  for (const auto& [e, batch] : batch_of_element) add_element(problem, places, field, e, batch);
}

template <int dim>
void SpreadSlip<dim>::add_element(const Problem<dim>& problem, const FieldPlaces<dim>& places,
                                  std::size_t field, int number, std::size_t batch) {
  const Element<dim>& element = problem.mesh.elements[static_cast<std::size_t>(number)];
  const int corners = element.type->corners;
  const double length = options_.width / kWidthOverLength;
  Part& part = elements_.emplace_back();
  part.type = element.type;
  part.nodes = problem.mesh.element_positions(number);
  part.batch = batch;
  part.first = batches_[batch].slips.size();
  for (const int node : element.nodes)
    for (const Dof dof : node_dofs<dim>()) part.entries.push_back(entry_of<dim>(node, dof));
  std::vector<int>* const kinds[] = {&part.slips, &part.overstresses, &part.slips_between,
                                     &part.overstresses_between};
  for (std::size_t kind = 0; kind < kFields; ++kind) {
    for (int a = 0; a < corners; ++a)
      kinds[kind]->push_back(places.entry(field + kind, element.nodes[static_cast<std::size_t>(a)]));
    part.entries.insert(part.entries.end(), kinds[kind]->begin(), kinds[kind]->end());
  }

  const VectorRows<dim> nodes = problem.mesh.element_positions(number);
  const auto points = point_geometries<dim>(*element.type, nodes);
  const auto shapes = corner_shapes_in_place<dim>(*element.type, nodes);
  part.mass = part.slipping = Eigen::VectorXd::Zero(corners);
  part.spread.setZero(corners, corners);
  for (std::size_t i = 0; i < points.size(); ++i) {
    const double volume = points[i].volume;
    part.mass += volume * shapes[i].value;
    part.spread += (volume * length * length) * shapes[i].derivative * shapes[i].derivative.transpose();
    part.points.push_back({volume, shapes[i].value, strain_matrix<dim>(points[i], continuum_)});
  }
  part.spread.diagonal() += part.mass;
  batches_[batch].slips.resize(part.first + points.size(), 0.0);
}

template <int dim>
void SpreadSlip<dim>::learn(const Discretisation<dim>&, std::span<const Response<dim>>) {
  double stiffness = 0.0;
  bool is_explicit = false;
  for (const Batch& batch : batches_) {
    stiffness = std::max(stiffness, batch.material->slip_stiffness());
    is_explicit = is_explicit || batch.material->is_explicit();
  }
  stiffness_ = stiffness;
  const double overstress = is_explicit ? options_.overstress_of_explicit_steps : options_.overstress;
  for (Batch& batch : batches_) std::ranges::fill(batch.slips, 0.0);
  for (Part& part : elements_) {
    const auto answers = batches_[part.batch].material->slip_answers().subspan(part.first);
    double strength = 1e-4 * stiffness_;  // a point without strength has some overstress too
    for (std::size_t i = 0; i < part.points.size(); ++i) strength = std::max(strength, answers[i].scale);
    part.resistance = overstress * strength / stiffness_;
  }
}

template <int dim>
void SpreadSlip<dim>::prepare(const NodalStep& step) {
  for (const Part& part : elements_) {
    const Eigen::VectorXd growth = step.increment(part.slips);
    double* const slips = &batches_[part.batch].slips[part.first];
    for (std::size_t i = 0; i < part.points.size(); ++i) slips[i] = part.points[i].shape.dot(growth);
  }
  for (const Batch& batch : batches_) batch.material->set_slips(batch.slips);
}

// The signs make the tangent symmetric where the flow of the material is associated.
template <int dim>
std::string SpreadSlip<dim>::evaluate(const NodalStep& step, NodalForces& forces) {
  if (moves_) {
    start_ = step.start;
    increment_ = step.increment;
  }
  for (Part& part : elements_) {
    const auto answers = batches_[part.batch].material->slip_answers().subspan(part.first);
    const Eigen::VectorXd overstress = step.end(part.overstresses);
    const Eigen::VectorXd felt = step.end(part.overstresses_between);
    const Eigen::VectorXd fed = step.increment(part.slips_between);
    forces.internal(part.slips) += stiffness_ * (part.spread * felt);
    forces.parts(part.slips) += stiffness_ * (part.spread.cwiseAbs() * felt.cwiseAbs());
    const Eigen::VectorXd growth = step.increment(part.slips);
    const double* const asked = &batches_[part.batch].slips[part.first];
    for (std::size_t i = 0; i < part.points.size(); ++i) {
      const Point& point = part.points[i];
      const double beyond = point.shape.dot(growth) - asked[i];
      forces.internal(part.slips) -=
          (point.volume * (answers[i].drive + answers[i].drive_by_slip * beyond)) * point.shape;
      const Eigen::VectorXd scale = (point.volume * answers[i].scale) * point.shape;
      forces.parts(part.slips) += scale;
      forces.parts(part.slips_between) += scale;
      // A drive that is zero without slip rounds: slips are measured by the elastic strain at the strength too.
      forces.parts(part.overstresses) += scale;
      forces.parts(part.overstresses_between) += scale;
    }
    part.slipping = (overstress.array() > 0.0).template cast<double>();
    const Eigen::VectorXd source =
        part.mass.cwiseProduct(part.slipping).cwiseProduct(overstress) / part.resistance;
    forces.internal(part.overstresses) += stiffness_ * (part.spread * fed - source);
    // At rest, too, a slip is measured by the strain that the yield condition is away.
    forces.parts(part.overstresses) += stiffness_ * (part.spread.cwiseAbs() * fed.cwiseAbs() + source +
                                                     part.mass.cwiseProduct(overstress.cwiseAbs()));
    evaluate_between(part, step, forces);
  }
  return {};
}

template <int dim>
void SpreadSlip<dim>::evaluate_between(const Part& part, const NodalStep& step, NodalForces& forces) const {
  const Eigen::VectorXd growth = step.increment(part.slips), fed = step.increment(part.slips_between);
  const Eigen::VectorXd overstress = step.end(part.overstresses), felt = step.end(part.overstresses_between);
  const Eigen::MatrixXd absolute = part.spread.cwiseAbs();
  forces.internal(part.overstresses_between) +=
      stiffness_ * (part.spread * growth - part.mass.cwiseProduct(fed));
  forces.parts(part.overstresses_between) +=
      stiffness_ *
      (absolute * growth.cwiseAbs() + part.mass.cwiseProduct(fed.cwiseAbs() + overstress.cwiseAbs()));
  forces.internal(part.slips_between) +=
      stiffness_ * (part.spread * overstress - part.mass.cwiseProduct(felt));
  forces.parts(part.slips_between) +=
      stiffness_ * (absolute * overstress.cwiseAbs() + part.mass.cwiseProduct(felt.cwiseAbs()));
}

template <int dim>
std::vector<typename SpreadSlip<dim>::Coupling> SpreadSlip<dim>::couplings(const Part& part) const {
  std::vector<Coupling> made;
  if (!moves_) {
    for (const Point& point : part.points) made.push_back({point.volume, point.strain, point.strain});
    return made;
  }
  constexpr int kDofs = Cosserat<dim>::dofs;
  const auto nodes = part.nodes.rows();
  const std::vector<int> entries(part.entries.begin(), part.entries.begin() + kDofs * nodes);
  const Eigen::VectorXd start = start_(entries), increment = increment_(entries);
  const auto moved_by = [&](const Eigen::VectorXd& values) -> VectorRows<dim> {
    return values.reshaped(kDofs, nodes).template topRows<dim>().transpose();
  };
  const VectorRows<dim> before = part.nodes + moved_by(start), behind = before + moved_by(increment);
  const auto starts = point_geometries<dim>(*part.type, before),
             ends = point_geometries<dim>(*part.type, behind);
  for (std::size_t i = 0; i < starts.size(); ++i)
    made.push_back({ends[i].volume, strain_matrix<dim>(ends[i], continuum_),
                    large_strain_matrix<dim>(ends[i], starts[i],
                                             large_increment_at<dim>(starts[i], continuum_, increment, 1.0),
                                             continuum_, !part.type->averaged.empty())});
  return made;
}

template <int dim>
Eigen::MatrixXd SpreadSlip<dim>::tangent(std::size_t e) const {
  const Part& part = elements_[e];
  const auto answers = batches_[part.batch].material->slip_answers().subspan(part.first);
  const auto corners = static_cast<Eigen::Index>(part.slips.size());
  const auto size = static_cast<Eigen::Index>(part.entries.size());
  const auto moved = size - kFields * corners;
  Eigen::MatrixXd tangent = Eigen::MatrixXd::Zero(size, size);
  const std::vector<Coupling> couplings = this->couplings(part);
  for (std::size_t i = 0; i < part.points.size(); ++i) {
    const auto& [volume, shape, strain] = part.points[i];
    const Coupling& coupling = couplings[i];
    const SlipAnswer<dim>& answer = answers[i];
    tangent.block(0, moved, moved, corners) +=
        coupling.volume * (coupling.of_forces.transpose() * answer.stress_by_slip) * shape.transpose();
    tangent.block(moved, 0, corners, moved) -=
        volume * shape * (coupling.of_drive.transpose() * answer.drive_by_strain).transpose();
    tangent.block(moved, moved, corners, corners) -=
        (volume * answer.drive_by_slip) * shape * shape.transpose();
  }
  const auto block = [&](int row, int column) {
    return tangent.block(moved + row * corners, moved + column * corners, corners, corners);
  };
  block(1, 1).diagonal() = (-stiffness_ / part.resistance) * part.mass.cwiseProduct(part.slipping);
  // By kind: slips, overstresses, slips and overstresses between.
  const auto spread = [&](int row, int column) {
    block(row, column) = stiffness_ * part.spread;
    block(column, row) = stiffness_ * part.spread;
  };
  spread(0, 3);
  spread(1, 2);
  block(2, 3).diagonal() = -stiffness_ * part.mass;
  block(3, 2).diagonal() = -stiffness_ * part.mass;
  return tangent;
}

template <int dim>
std::vector<std::string> SpreadSlip<dim>::faults(const Problem<dim>& problem) const {
  std::vector<std::string> messages;
  if (!problem.lifetimes.empty())
    messages.emplace_back("slips are spread where no region comes or goes, so far");
  return messages;
}

template <int dim>
std::shared_ptr<SpreadSlip<dim>> add_spread_slip(Problem<dim>& problem, const SpreadOptions& options) {
  std::map<std::string, std::shared_ptr<SlipDriven<dim>>> materials;
  std::set<int> corners;
  for (const auto& [region, material] : problem.materials) {
    const auto driven = std::dynamic_pointer_cast<SlipDriven<dim>>(material);
    if (!driven) continue;
    materials[region] = driven;
    for (const int e : problem.mesh.regions.at(region)) {
      const Element<dim>& element = problem.mesh.elements[static_cast<std::size_t>(e)];
      corners.insert(element.nodes.begin(), element.nodes.begin() + element.type->corners);
    }
  }
  if (materials.empty()) throw RunError("no material has a slip that can be spread");
  const std::vector<int> nodes(corners.begin(), corners.end());
  const std::size_t first = problem.fields.size();
  for (const char* const name : kSpreadFields) {
    NodalField field{name, "", nodes};
    field.tied = true;
    field.tolerance = options.tolerance;
    problem.fields.push_back(std::move(field));
  }
  auto spread = std::make_shared<SpreadSlip<dim>>(problem, first, materials, options);
  problem.contributions.push_back(spread);
  return spread;
}

template class SpreadSlip<2>;
template class SpreadSlip<3>;
template std::shared_ptr<SpreadSlip<2>> add_spread_slip<2>(Problem<2>&, const SpreadOptions&);
template std::shared_ptr<SpreadSlip<3>> add_spread_slip<3>(Problem<3>&, const SpreadOptions&);

}  // namespace polargrain::fem
