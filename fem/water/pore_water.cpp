// SPDX-License-Identifier: GPL-2.0-or-later
#include "fem/water/pore_water.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <set>

#include "common/packed_values.hpp"
#include "fem/element/corner_shape.hpp"
#include "fem/element/dofs.hpp"
#include "fem/solver/later_regions.hpp"

namespace polargrain::fem {
namespace {

/// Of an open side, over the conductance of the elements beside it: p is off by this share of its drop over an element.
constexpr double kOpenSide = 1e6;

/// Smaller parts are what rounding leaves of moved bodies and of pressures without gradient.
constexpr double kRoundingOfWater = 1e-6;

double porosity(double void_ratio) {
  return void_ratio / (1.0 + void_ratio);
}

/// det(1 + gradient) - 1 by the invariants: a difference of two volumes would leave no digit of small strains.
template <int dim>
double volume_change(const Eigen::Matrix<double, dim, dim>& gradient) {
  const double trace = gradient.trace();
  const double second = 0.5 * (trace * trace - (gradient * gradient).trace());
  return trace + second + (dim == 3 ? gradient.determinant() : 0.0);
}

}  // namespace

template <int dim>
PoreWater<dim>::PoreWater(const Problem<dim>& problem, std::size_t field,
                          std::map<std::string, WaterOfRegion> regions, PoreWaterOptions options)
    : regions_(std::move(regions)),
      options_(std::move(options)),
      is_large_(problem.deformation == Deformation::large) {
  const FieldPlaces<dim> places = problem.places();
  first_entry_ = places.start(field);
  outflow_ = Eigen::VectorXd::Zero(places.start(field + 1) - first_entry_);
  trial_outflow_ = flow_ = outflow_;
  for (const auto& [region, water] : regions_) {
    const auto elements = problem.mesh.regions.find(region);
    if (elements == problem.mesh.regions.end()) continue;  // a fault
    for (const int e : elements->second) add_element(problem, places, field, e, water);
  }
  for (const WaterFlux& flux : options_.fluxes) add_flux(problem, places, field, flux);
  for (std::size_t side = 0; side < options_.open_sides.size(); ++side) add_open_corners(problem, side);
}

template <int dim>
void PoreWater<dim>::open_side(const Problem<dim>& problem, OpenSide side) {
  options_.open_sides.push_back(std::move(side));
  add_open_corners(problem, options_.open_sides.size() - 1);
}

template <int dim>
void PoreWater<dim>::add_open_corners(const Problem<dim>& problem, std::size_t side) {
  const std::vector<int> nodes = problem.mesh.nodes_on(options_.open_sides[side].on);
  const std::set<int> there(nodes.begin(), nodes.end());
  for (ElementOfWater& element : elements_) {
    const std::vector<int>& own = problem.mesh.elements[static_cast<std::size_t>(element.number)].nodes;
    for (std::size_t a = 0; a < element.pressed.size(); ++a)
      if (there.contains(own[a]))
        element.open.push_back({static_cast<Eigen::Index>(a),
                                problem.mesh.nodes[static_cast<std::size_t>(own[a])](dim - 1), side, 0.0});
  }
}

template <int dim>
void PoreWater<dim>::add_element(const Problem<dim>& problem, const FieldPlaces<dim>& places,
                                 std::size_t field, int number, const WaterOfRegion& water) {
  const Element<dim>& element = problem.mesh.elements[static_cast<std::size_t>(number)];
  ElementOfWater& made = elements_.emplace_back();
  made.number = number;
  made.water = &water;
  for (const int node : element.nodes)
    for (int i = 0; i < dim; ++i) made.moved.push_back(entry_of<dim>(node) + i);
  for (int a = 0; a < element.type->corners; ++a)
    made.pressed.push_back(places.entry(field, element.nodes[static_cast<std::size_t>(a)]));
  made.entries = made.moved;
  made.entries.insert(made.entries.end(), made.pressed.begin(), made.pressed.end());

  made.type = element.type;
  made.nodes = problem.mesh.element_positions(number);
  made.points.resize(element.type->quadrature.size());
  place(made, made.nodes);
  for (Point& point : made.points) point.first_volume = point.volume;
}

template <int dim>
VectorRows<dim> PoreWater<dim>::positions(const ElementOfWater& element, const Eigen::VectorXd& nodal) {
  VectorRows<dim> nodes = element.nodes;
  for (Eigen::Index a = 0; a < nodes.rows(); ++a)
    for (int i = 0; i < dim; ++i) nodes(a, i) += nodal(element.moved[static_cast<std::size_t>(a * dim + i)]);
  return nodes;
}

template <int dim>
void PoreWater<dim>::place(ElementOfWater& element, const VectorRows<dim>& nodes) const {
  const auto points = point_geometries<dim>(*element.type, nodes);
  auto shapes = corner_shapes_in_place<dim>(*element.type, nodes);
  element.coupling.setZero(dim * element.type->nodes, element.type->corners);
  for (std::size_t i = 0; i < points.size(); ++i) {
    // dN_a / dx_i in the order of the displacements.
    const Eigen::MatrixXd columns = points[i].gradient.transpose();
    Point& point = element.points[i];
    point.volume = points[i].volume;
    point.divergence = columns.reshaped();
    point.weights = points[i].shape;
    point.shape = std::move(shapes[i]);
    element.coupling += point.volume * point.divergence * point.shape.value.transpose();
  }
}

template <int dim>
void PoreWater<dim>::refresh(ElementOfWater& element) const {
  const auto corners = static_cast<Eigen::Index>(element.pressed.size());
  element.storage.setZero(corners, corners);
  element.conduction.setZero(corners, corners);
  element.weight.setZero(corners);
  for (const Point& point : element.points) {
    const Eigen::VectorXd& n = point.shape.value;
    const double compliance = porosity(point.void_ratio) / element.water->bulk_modulus;
    element.storage += point.volume * compliance * n * n.transpose();
    if (element.water->undrained) continue;
    const double k = element.water->permeability.at(point.void_ratio);
    const VectorRows<dim>& gradient = point.shape.derivative;
    element.conduction += (point.volume * k / options_.unit_weight) * gradient * gradient.transpose();
    if (options_.table) element.weight += (point.volume * k) * gradient.col(dim - 1);
  }
}

template <int dim>
void PoreWater<dim>::add_flux(const Problem<dim>& problem, const FieldPlaces<dim>& places, std::size_t field,
                              const WaterFlux& flux) {
  const auto boundary = problem.mesh.boundaries.find(flux.on);
  if (boundary == problem.mesh.boundaries.end()) return;  // a fault
  for (const BoundarySide& side : boundary->second) {
    const ElementType<dim - 1>& type = *problem.mesh.side_of(side).type;
    const std::vector<int> numbers = problem.mesh.side_nodes(side);
    std::map<int, double> values;
    for (const QuadraturePoint<dim - 1>& place : type.quadrature) {
      const ShapeFunctions<dim - 1> geometry = type.shape_functions(place.position);
      Eigen::Matrix<double, dim, dim - 1> tangents = Eigen::Matrix<double, dim, dim - 1>::Zero();
      for (std::size_t a = 0; a < numbers.size(); ++a)
        tangents += problem.mesh.nodes[static_cast<std::size_t>(numbers[a])] *
                    geometry.derivative.row(static_cast<Eigen::Index>(a));
      const double area = std::sqrt((tangents.transpose() * tangents).determinant());
      const Eigen::VectorXd shape = corner_shape_functions<dim - 1>(type, place.position).value;
      for (Eigen::Index a = 0; a < shape.size(); ++a) {
        const int entry = places.entry(field, numbers[static_cast<std::size_t>(a)]);
        if (entry >= 0) values[entry] += place.weight * area * shape(a);
      }
    }
    UnitFlux& made = fluxes_.emplace_back(UnitFlux{side.element, {}, {}, &flux.value});
    for (const auto& [entry, value] : values) {
      made.entries.push_back(entry);
      made.values.push_back(value);
    }
  }
}

template <int dim>
void PoreWater<dim>::set_stage(int stage, const std::vector<char>& there) {
  stage_ = stage;
  is_there_ = there;
  for (ElementOfWater& element : elements_) element.is_there = stands(element.number);
  longest_ = 0.0;
}

template <int dim>
double PoreWater<dim>::longest_step() const {
  if (options_.pressure_change <= 0.0) return HUGE_VAL;
  return std::max(longest_, options_.shortest_step);
}

template <int dim>
void PoreWater<dim>::allocate() {
  longest_ = 0.0;
  outflow_.setZero();
  flow_.setZero();
  told_of_suction_ = tells_of_suction_ = false;
  for (ElementOfWater& element : elements_) {
    for (Point& point : element.points) point.void_ratio = point.trial_void_ratio = element.water->void_ratio;
    if (is_large_) place(element, element.nodes);
    refresh(element);
  }
}

template <int dim>
std::string PoreWater<dim>::evaluate(const NodalStep& step, NodalForces& forces) {
  const double theta = options_.theta;
  duration_ = step.duration();
  least_pressure_ = 0.0;
  change_ = 0.0;
  Eigen::VectorXd given = Eigen::VectorXd::Zero(outflow_.size());
  for (ElementOfWater& element : elements_) {
    if (!element.is_there) continue;
    const Eigen::VectorXd start = step.start(element.pressed);
    const Eigen::VectorXd change = step.increment(element.pressed);
    const Eigen::VectorXd moved = step.increment(element.moved);
    Eigen::VectorXd squeezed;
    if (is_large_) {
      squeezed = squeeze(element, step);
    } else {
      squeezed = element.coupling.transpose() * moved;
      // Strains of small deformation are shares of the first volume: in any number of steps they add up to one void ratio.
      for (Point& point : element.points)
        point.trial_void_ratio =
            point.void_ratio + (1.0 + element.water->void_ratio) * point.divergence.dot(moved);
    }
    if (loses_weight(element))
      for (const Point& point : element.points) {
        const double gained = options_.unit_weight * (point.volume - point.first_volume);
        for (Eigen::Index a = 0; a < point.weights.size(); ++a)
          forces.internal(element.moved[static_cast<std::size_t>(a * dim + dim - 1)]) +=
              gained * point.weights(a);
      }
    forces.internal(element.moved) -= element.coupling * (start + change);

    const Eigen::VectorXd mean = start + theta * change;
    const Eigen::VectorXd stored = element.storage * change;
    const Eigen::VectorXd led = duration_ * (element.conduction * mean);
    const Eigen::VectorXd sunk = duration_ * element.weight;
    forces.internal(element.pressed) -= squeezed + stored + led + sunk;
    forces.parts(element.pressed) +=
        squeezed.cwiseAbs() + stored.cwiseAbs() + led.cwiseAbs() + sunk.cwiseAbs() +
        kRoundingOfWater * (element.coupling.cwiseAbs().transpose() * moved.cwiseAbs() +
                            duration_ * (element.conduction.cwiseAbs() * mean.cwiseAbs()));
    pass_open_sides(element, step, start + change, forces, given);
    change_ = std::max(change_, change.cwiseAbs().maxCoeff());
    least_pressure_ = std::min(least_pressure_, (start + change).minCoeff());
  }
  for (const UnitFlux& flux : fluxes_) {
    if (!stands(flux.element)) continue;
    const double brought =
        duration_ * (theta * flux.table->at(step.time) + (1.0 - theta) * flux.table->at(step.start_time));
    for (std::size_t k = 0; k < flux.entries.size(); ++k) {
      forces.internal(flux.entries[k]) += brought * flux.values[k];
      forces.parts(flux.entries[k]) += std::abs(brought * flux.values[k]);
      given(flux.entries[k] - first_entry_) += brought * flux.values[k];
    }
  }
  // The rows of free pressures vanish, with what interfaces have added before. Water of a flux or an open side goes through
  // the boundary too.
  trial_outflow_ = outflow_ + forces.internal.segment(first_entry_, outflow_.size()) - given;
  return {};
}

template <int dim>
void PoreWater<dim>::pass_open_sides(ElementOfWater& element, const NodalStep& step,
                                     const Eigen::VectorXd& pressures, NodalForces& forces,
                                     Eigen::VectorXd& outside) {
  for (OpenCorner& open : element.open) {
    open.conductance = 0.0;
    const OpenSide& side = options_.open_sides[open.side];
    if (!side.holds(stage_)) continue;
    const double free = options_.unit_weight * side.depth(step.time, open.height);
    const double excess = pressures(open.corner) - free;
    // Dry ground has no water to draw in.
    if (free == 0.0 && excess <= 0.0) continue;
    open.conductance = kOpenSide * duration_ * element.conduction(open.corner, open.corner);
    const double left = open.conductance * excess;
    const int entry = element.pressed[static_cast<std::size_t>(open.corner)];
    forces.internal(entry) -= left;
    // The excess is a rounded difference.
    forces.parts(entry) +=
        std::abs(left) + kRoundingOfWater * open.conductance * (std::abs(pressures(open.corner)) + free);
    outside(entry - first_entry_) -= left;
  }
}

template <int dim>
Eigen::VectorXd PoreWater<dim>::squeeze(ElementOfWater& element, const NodalStep& step) const {
  // Water flows and is stored where the step begins, pushes where it ends, and leaves what has gone of the volume.
  place(element, positions(element, step.start));
  refresh(element);
  Eigen::VectorXd squeezed = Eigen::VectorXd::Zero(static_cast<Eigen::Index>(element.pressed.size()));
  const Eigen::VectorXd moved = step.increment(element.moved);
  const Eigen::VectorXd pressures = step.end(element.pressed);
  for (Point& point : element.points) {
    const Eigen::Matrix<double, dim, dim> gradient =
        moved.reshaped(dim, element.type->nodes) *
        point.divergence.reshaped(dim, element.type->nodes).transpose();
    const double change = volume_change<dim>(gradient);
    squeezed += point.volume * change * point.shape.value;
    point.trial_void_ratio = point.void_ratio + (1.0 + point.void_ratio) * change;
    point.trial_pressure = point.shape.value.dot(pressures);
  }
  place(element, positions(element, step.start + step.increment));
  return squeezed;
}

template <int dim>
Eigen::MatrixXd PoreWater<dim>::tangent(std::size_t e) const {
  const ElementOfWater& element = elements_[e];
  const Eigen::Index u = element.coupling.rows();
  const Eigen::Index p = element.coupling.cols();
  Eigen::MatrixXd tangent = Eigen::MatrixXd::Zero(u + p, u + p);
  if (!element.is_there) return tangent;
  tangent.topRightCorner(u, p) = -element.coupling;
  if (is_large_) {
    // The faces that a pressure pushes on turn and stretch.
    for (const Point& point : element.points) {
      const double force = point.trial_pressure * point.volume;
      tangent.topLeftCorner(u, u) -= force * point.divergence * point.divergence.transpose();
      for (Eigen::Index a = 0; a < u; ++a)
        for (Eigen::Index b = 0; b < u; ++b)
          tangent(a, b) +=
              force * point.divergence(a - a % dim + b % dim) * point.divergence(b - b % dim + a % dim);
    }
  }
  if (loses_weight(element))
    for (const Point& point : element.points)
      for (Eigen::Index a = 0; a < point.weights.size(); ++a)
        tangent.row(a * dim + dim - 1).head(u) +=
            (options_.unit_weight * point.volume * point.weights(a)) * point.divergence.transpose();
  tangent.bottomLeftCorner(p, u) = -element.coupling.transpose();
  tangent.bottomRightCorner(p, p) = -(element.storage + options_.theta * duration_ * element.conduction);
  for (const OpenCorner& open : element.open) tangent(u + open.corner, u + open.corner) -= open.conductance;
  return tangent;
}

template <int dim>
void PoreWater<dim>::commit() {
  for (ElementOfWater& element : elements_) {
    for (Point& point : element.points) point.void_ratio = point.trial_void_ratio;
    if (!is_large_) refresh(element);
  }
  flow_.setZero();
  if (duration_ > 0.0) {
    flow_ = (trial_outflow_ - outflow_) / duration_;
    // Steps grow no faster than pressures slow down.
    const double factor =
        0.8 * options_.pressure_change / std::max(change_, 1e-12 * options_.pressure_change);
    longest_ = duration_ * std::clamp(factor, 0.5, 2.0);
  }
  outflow_ = trial_outflow_;
  // Air comes in at less than a metre of suction in sand.
  if (!told_of_suction_ && options_.table && least_pressure_ < -options_.unit_weight)
    tells_of_suction_ = told_of_suction_ = true;
}

template <int dim>
void PoreWater<dim>::save(ArchiveWriter& archive) const {
  std::vector<double> void_ratios;
  for (const ElementOfWater& element : elements_)
    for (const Point& point : element.points) void_ratios.push_back(point.void_ratio);
  archive.write("void_ratios", std::span<const double>(void_ratios));
  archive.write("outflow",
                std::span<const double>(outflow_.data(), static_cast<std::size_t>(outflow_.size())));
  archive.write("longest_step", std::span<const double>(&longest_, 1));
  archive.write("flow", std::span<const double>(flow_.data(), static_cast<std::size_t>(flow_.size())));
}

template <int dim>
void PoreWater<dim>::restore(ArchiveReader& archive) {
  std::size_t points = 0;
  for (const ElementOfWater& element : elements_) points += element.points.size();
  const std::vector<double> void_ratios = read_lists(archive, "void_ratios", points, 1);
  const std::vector<double> outflow =
      read_lists(archive, "outflow", static_cast<std::size_t>(outflow_.size()), 1);
  longest_ = read_lists(archive, "longest_step", 1, 1)[0];
  const std::vector<double> flow = read_lists(archive, "flow", outflow.size(), 1);
  outflow_ = Eigen::Map<const Eigen::VectorXd>(outflow.data(), outflow_.size());
  flow_ = Eigen::Map<const Eigen::VectorXd>(flow.data(), flow_.size());
  auto next = void_ratios.begin();
  for (ElementOfWater& element : elements_) {
    for (Point& point : element.points) point.void_ratio = point.trial_void_ratio = *next++;
    refresh(element);
  }
}

template <int dim>
double PoreWater<dim>::permeability(std::size_t e) const {
  const ElementOfWater& element = elements_[e];
  return element.water->undrained ? 0.0 : element.water->permeability.at(element.points.front().void_ratio);
}

template <int dim>
typename Cosserat<dim>::Place PoreWater<dim>::velocity(std::size_t e, std::size_t point,
                                                       const Eigen::VectorXd& nodal) const {
  const ElementOfWater& element = elements_[e];
  const Point& at = element.points[point];
  typename Cosserat<dim>::Place velocity = Cosserat<dim>::Place::Zero();
  if (element.water->undrained) return velocity;
  const double k = element.water->permeability.at(at.void_ratio);
  const auto shape =
      is_large_ ? corner_shapes_in_place<dim>(*element.type, positions(element, nodal))[point] : at.shape;
  velocity = -(k / options_.unit_weight) * (shape.derivative.transpose() * nodal(element.pressed));
  if (options_.table) velocity(dim - 1) -= k;
  return velocity;
}

template <int dim>
std::vector<std::string> PoreWater<dim>::take_notes() {
  if (!tells_of_suction_) return {};
  tells_of_suction_ = false;
  return {fmt::format(
      "the pore pressure falls to {:.3g} kPa, a suction of more than 1 m of water: real ground draws in air there, "
      "this one stays saturated",
      1e-3 * least_pressure_)};
}

template <int dim>
std::vector<std::string> PoreWater<dim>::faults(const Problem<dim>& problem) const {
  std::vector<std::string> messages;
  std::set<int> wet;
  std::set<std::string> unstable;
  for (const auto& [region, water] : regions_) {
    const auto elements = problem.mesh.regions.find(region);
    if (elements == problem.mesh.regions.end()) {
      messages.push_back(fmt::format("the mesh has no region '{}'", region));
      continue;
    }
    if (comes_later(problem, region))
      messages.push_back(fmt::format(
          "'{}' comes in a later stage and is then dry; name the regions with water, without it", region));
    bool twice = false;
    for (const int e : elements->second) {
      twice = !wet.insert(e).second || twice;
      const ElementType<dim>& type = *problem.mesh.elements[static_cast<std::size_t>(e)].type;
      if (type.nodes == type.corners) unstable.insert(type.name);
    }
    if (twice)
      messages.push_back(fmt::format("elements of '{}' are in another region with water too", region));
    if (!(water.bulk_modulus > 0.0) || !(water.void_ratio > 0.0))
      messages.push_back(fmt::format("bulk modulus and void ratio of '{}' must be positive", region));
  }
  for (const std::string& type : unstable)
    messages.push_back(fmt::format(
        "elements {} have displacements and pressures of one degree, which makes pressures oscillate: take "
        "elements with middle nodes ({})",
        type, dim == 2 ? "Q8R, T6" : "H20R, T10"));
  for (const WaterFlux& flux : options_.fluxes) {
    const auto boundary = problem.mesh.boundaries.find(flux.on);
    if (boundary == problem.mesh.boundaries.end()) {
      messages.push_back(fmt::format("a flux needs a boundary, '{}' is not a boundary", flux.on));
    } else if (std::ranges::none_of(boundary->second,
                                    [&](const BoundarySide& side) { return wet.contains(side.element); })) {
      messages.push_back(fmt::format("a flux comes in at '{}', where no element has water", flux.on));
    }
  }
  return messages;
}

template <int dim>
std::shared_ptr<PoreWater<dim>> add_pore_water(Problem<dim>& problem,
                                               std::map<std::string, WaterOfRegion> regions,
                                               const PoreWaterOptions& options) {
  std::set<int> corners;
  std::set<int> carriers;
  for (const auto& [region, water] : regions) {
    const auto elements = problem.mesh.regions.find(region);
    if (elements == problem.mesh.regions.end()) continue;
    for (const int e : elements->second) {
      const Element<dim>& element = problem.mesh.elements[static_cast<std::size_t>(e)];
      carriers.insert(e);
      corners.insert(element.nodes.begin(), element.nodes.begin() + element.type->corners);
    }
  }
  NodalField pressure{kPorePressure, "Pa", {corners.begin(), corners.end()}};
  pressure.tied = true;
  pressure.elements.assign(carriers.begin(), carriers.end());
  if (options.table) {
    for (const int node : pressure.nodes)
      pressure.initial.push_back(
          options.unit_weight *
          (*options.table - problem.mesh.nodes[static_cast<std::size_t>(node)](dim - 1)));
  }
  problem.fields.push_back(std::move(pressure));
  auto water =
      std::make_shared<PoreWater<dim>>(problem, problem.fields.size() - 1, std::move(regions), options);
  problem.contributions.push_back(water);
  return water;
}

template <int dim>
const PoreWater<dim>* pore_water_of(const Problem<dim>& problem) {
  for (const auto& contribution : problem.contributions)
    if (const auto* const water = dynamic_cast<const PoreWater<dim>*>(contribution.get())) return water;
  return nullptr;
}

template const PoreWater<2>* pore_water_of<2>(const Problem<2>&);
template const PoreWater<3>* pore_water_of<3>(const Problem<3>&);
template class PoreWater<2>;
template class PoreWater<3>;
template std::shared_ptr<PoreWater<2>> add_pore_water<2>(Problem<2>&, std::map<std::string, WaterOfRegion>,
                                                         const PoreWaterOptions&);
template std::shared_ptr<PoreWater<3>> add_pore_water<3>(Problem<3>&, std::map<std::string, WaterOfRegion>,
                                                         const PoreWaterOptions&);

}  // namespace polargrain::fem
