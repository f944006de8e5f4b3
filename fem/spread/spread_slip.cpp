// SPDX-License-Identifier: GPL-2.0-or-later
#include "fem/spread/spread_slip.hpp"

#include <algorithm>
#include <cmath>
#include <set>

#include "common/error.hpp"
#include "fem/element/corner_shape.hpp"
#include "fem/element/dofs.hpp"

namespace polargrain::fem {

template <int dim>
SpreadSlip<dim>::SpreadSlip(const Problem<dim>& problem, std::size_t slip, std::size_t overstress,
                            const std::map<std::string, std::shared_ptr<SlipDriven<dim>>>& materials,
                            SpreadOptions options)
    : options_(options) {
  const FieldPlaces<dim> places = problem.places();
  // The points of a material stand in the order of the mesh, whatever regions they are in (PointMaterials).
  std::map<int, std::size_t> batch_of_element;
  for (const auto& [region, material] : materials) {
    std::size_t batch = 0;
    while (batch < batches_.size() && batches_[batch].material != material) ++batch;
    if (batch == batches_.size()) batches_.push_back({material, {}});
    for (const int e : problem.mesh.regions.at(region)) batch_of_element[e] = batch;
    stiffness_ = std::max(stiffness_, material->slip_stiffness());
  }
  for (const auto& [e, batch] : batch_of_element) add_element(problem, places, slip, overstress, e, batch);
}

template <int dim>
void SpreadSlip<dim>::add_element(const Problem<dim>& problem, const FieldPlaces<dim>& places,
                                  std::size_t slip, std::size_t overstress, int number, std::size_t batch) {
  const Element<dim>& element = problem.mesh.elements[static_cast<std::size_t>(number)];
  const int corners = element.type->corners;
  const double length = options_.width / (2.0 * std::log(2.0));
  Part& part = elements_.emplace_back();
  part.batch = batch;
  part.first = batches_[batch].slips.size();
  for (const int node : element.nodes)
    for (const Dof dof : node_dofs<dim>()) part.entries.push_back(entry_of<dim>(node, dof));
  for (int a = 0; a < corners; ++a) {
    const int node = element.nodes[static_cast<std::size_t>(a)];
    part.slips.push_back(places.entry(slip, node));
    part.overstresses.push_back(places.entry(overstress, node));
  }
  part.entries.insert(part.entries.end(), part.slips.begin(), part.slips.end());
  part.entries.insert(part.entries.end(), part.overstresses.begin(), part.overstresses.end());

  const VectorRows<dim> nodes = problem.mesh.element_positions(number);
  const auto points = point_geometries<dim>(*element.type, nodes);
  const auto shapes = corner_shapes_in_place<dim>(*element.type, nodes);
  part.mass = part.slipping = Eigen::VectorXd::Zero(corners);
  part.spread.setZero(corners, corners);
  for (std::size_t i = 0; i < points.size(); ++i) {
    const double volume = points[i].volume;
    part.mass += volume * shapes[i].value;
    part.spread += (volume * length * length) * shapes[i].derivative * shapes[i].derivative.transpose();
    part.points.push_back({volume, shapes[i].value, strain_matrix<dim>(points[i], problem.continuum)});
  }
  part.spread.diagonal() += part.mass;
  batches_[batch].slips.resize(part.first + points.size(), 0.0);
}

template <int dim>
void SpreadSlip<dim>::learn(const Discretisation<dim>&, std::span<const Response<dim>>) {
  for (Part& part : elements_) {
    const auto answers = batches_[part.batch].material->slip_answers().subspan(part.first);
    double strength = 1e-6 * stiffness_;  // a point without strength has some overstress too
    for (std::size_t i = 0; i < part.points.size(); ++i) strength = std::max(strength, answers[i].scale);
    part.resistance = options_.overstress * strength / stiffness_;
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
  for (Part& part : elements_) {
    const auto answers = batches_[part.batch].material->slip_answers().subspan(part.first);
    const Eigen::VectorXd growth = step.increment(part.slips);
    const Eigen::VectorXd overstress = step.end(part.overstresses);
    forces.internal(part.slips) += stiffness_ * (part.spread * overstress);
    forces.parts(part.slips) += stiffness_ * (part.spread.cwiseAbs() * overstress.cwiseAbs());
    for (std::size_t i = 0; i < part.points.size(); ++i) {
      const Point& point = part.points[i];
      forces.internal(part.slips) -= (point.volume * answers[i].drive) * point.shape;
      forces.parts(part.slips) += (point.volume * answers[i].scale) * point.shape;
    }
    part.slipping = (overstress.array() > 0.0).template cast<double>();
    const Eigen::VectorXd source =
        part.mass.cwiseProduct(part.slipping).cwiseProduct(overstress) / part.resistance;
    forces.internal(part.overstresses) += stiffness_ * (part.spread * growth - source);
    // At rest, too, a slip is measured by the strain that the yield condition is away.
    forces.parts(part.overstresses) += stiffness_ * (part.spread.cwiseAbs() * growth.cwiseAbs() + source +
                                                     part.mass.cwiseProduct(overstress.cwiseAbs()));
  }
  return {};
}

template <int dim>
Eigen::MatrixXd SpreadSlip<dim>::tangent(std::size_t e) const {
  const Part& part = elements_[e];
  const auto answers = batches_[part.batch].material->slip_answers().subspan(part.first);
  const auto corners = static_cast<Eigen::Index>(part.slips.size());
  const auto moved = static_cast<Eigen::Index>(part.entries.size()) - 2 * corners;
  const auto size = moved + 2 * corners;
  Eigen::MatrixXd tangent = Eigen::MatrixXd::Zero(size, size);
  for (std::size_t i = 0; i < part.points.size(); ++i) {
    const auto& [volume, shape, strain] = part.points[i];
    const SlipAnswer<dim>& answer = answers[i];
    tangent.block(0, moved, moved, corners) +=
        volume * (strain.transpose() * answer.stress_by_slip) * shape.transpose();
    tangent.block(moved, 0, corners, moved) -=
        volume * shape * (strain.transpose() * answer.drive_by_strain).transpose();
    tangent.block(moved, moved, corners, corners) -=
        (volume * answer.drive_by_slip) * shape * shape.transpose();
  }
  tangent.block(moved, moved + corners, corners, corners) = stiffness_ * part.spread;
  tangent.block(moved + corners, moved, corners, corners) = stiffness_ * part.spread;
  tangent.bottomRightCorner(corners, corners).diagonal() =
      (-stiffness_ / part.resistance) * part.mass.cwiseProduct(part.slipping);
  return tangent;
}

template <int dim>
std::vector<std::string> SpreadSlip<dim>::faults(const Problem<dim>& problem) const {
  std::vector<std::string> messages;
  if (problem.deformation == Deformation::large)
    messages.emplace_back("slips are spread in small deformation only, so far");
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
  for (const auto& [name, unit] : {std::pair{kSlip, ""}, std::pair{kOverstress, ""}}) {
    NodalField field{name, unit, nodes};
    field.tied = true;
    problem.fields.push_back(std::move(field));
  }
  const std::size_t last = problem.fields.size() - 1;
  auto spread = std::make_shared<SpreadSlip<dim>>(problem, last - 1, last, materials, options);
  problem.contributions.push_back(spread);
  return spread;
}

template class SpreadSlip<2>;
template class SpreadSlip<3>;
template std::shared_ptr<SpreadSlip<2>> add_spread_slip<2>(Problem<2>&, const SpreadOptions&);
template std::shared_ptr<SpreadSlip<3>> add_spread_slip<3>(Problem<3>&, const SpreadOptions&);

}  // namespace polargrain::fem
