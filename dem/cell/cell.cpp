// SPDX-License-Identifier: GPL-2.0-or-later
#include <fmt/format.h>

#include <algorithm>
#include <chrono>
#include <cmath>

#include "common/error.hpp"
#include "dem/cell/averages.hpp"
#include "dem/cell/cell_service.hpp"
#include "dem/cell/cell_state.hpp"
#include "dem/cell/condensed_tangent.hpp"
#include "dem/cell/driver.hpp"
#include "dem/cell/engine_box.hpp"
#include "dem/cell/packing_check.hpp"
#include "dem/cell/quasi_static.hpp"
#include "dem/cell/tangents.hpp"
#include "dem/discs/disc_box.hpp"
#include "dem/engine/liggghts.hpp"

namespace polargrain::dem {

namespace {

/// Spring that holds each grain in the condensed tangent, over the mean normal stiffness. From 1e-6 to 1e-3
/// it changes no modulus by more than 1 %.
constexpr double kHold = 1e-4;

/// The largest strain, displacement gradient, rotation, or curvature times mean diameter that a cell takes in
/// one increment.
constexpr double kLargestIncrement = 0.25;

class Cell final : public CellService {
 public:
  explicit Cell(const CellDefinition& definition);
  CellReply initial() override;
  CellReply evaluate(const CellRequest& request) override;

 private:
  [[nodiscard]] bool controlled() const { return control_.rotations == CellRotations::controlled; }
  void check_rolling_model();
  /// Ends the process when the packing does not fit its script. @param pressure that it carries, Pa
  void check(const Packing& packing, double pressure, const std::string& script_file);
  /// The loop over discs where it knows the scene, else the engine's own.
  std::unique_ptr<GrainBox> choose_box(const Packing& packing);
  /// Neighbours and forces at the positions as they are; no step.
  void set_up();
  /// DEM steps; the contacts of the last force pass are recorded.
  void run(int steps);
  /// Weights of the grains in the mean rotation, from the recorded contacts (mode 2).
  void renew_weights();
  [[nodiscard]] double increment_size(const Increment& increment) const;
  [[nodiscard]] double volume() const { return grains_->box().area() * thickness_; }
  [[nodiscard]] Equilibrium equilibrium() const;
  [[nodiscard]] CellDiagnostics measure() const;
  [[nodiscard]] bool in_equilibrium(const Equilibrium& equilibrium) const;
  /// Stress of the recorded contacts, in the laboratory frame.
  [[nodiscard]] Response respond() const;
  /// Tangent of the recorded contacts, in the laboratory frame.
  [[nodiscard]] Matrix7 tangent();

  CellControl control_;
  double time_of_grain_ = 0.0;  // mean diameter * sqrt(density / pressure), s; inertial number = rate * this
  double damping_rate_ = 0.0;   // 1/s
  double least_force_ = 0.0;    // N, see kLeastForce
  double thickness_ = 0.0;      // m
  Driver driver_;
  Inertia inertia_;  // of the grains, as contacts count them
  std::unique_ptr<GrainBox> grains_;
  CondensedTangent condensed_tangent_;
  CellReply initial_;
};

/// @throws RunError when the places of its grains are none of a packing
const CellDefinition& sound(const CellDefinition& definition) {
  if (const std::string fault = geometry_fault(definition.packing); !fault.empty()) throw RunError(fault);
  return definition;
}

Cell::Cell(const CellDefinition& definition)
    : control_(definition.control),
      thickness_(definition.packing.thickness),
      driver_(sound(definition).packing, definition.script, definition.script_file,
              definition.contact_library) {
  LAMMPS_NS::LAMMPS& lammps = driver_.lammps();
  if (controlled()) check_rolling_model();
  const Packing& packing = definition.packing;
  if (packing.state) restore_state(lammps, *packing.state);
  driver_.set_up();
  const std::string remark = driver_.settle_time_step(control_.damping);
  inertia_ = inertia_of(lammps);
  grains_ = choose_box(packing);
  grains_->progress = [this] {
    if (progress) progress();
  };
  // The forces of the start are there; setting them up twice would fold the grains back twice, to other last bits.
  if (controlled()) renew_weights();

  initial_.response = respond();
  initial_.response.message = remark;
  initial_.response.tangent = tangent();
  initial_.diagnostics = measure();
  const double pressure = -0.5 * (initial_.response.stress(k11) + initial_.response.stress(k22));
  check(packing, pressure, definition.script_file);
  const double density = driver_.grains() * driver_.mean_mass() / (driver_.grain_area() * packing.thickness);
  time_of_grain_ = 2.0 * driver_.mean_radius() * std::sqrt(density / pressure);
  damping_rate_ =
      2.0 * control_.damping * std::sqrt(mean_normal_stiffness(grains_->contacts()) / driver_.mean_mass());
  least_force_ = kLeastForce * mean_contact_force(grains_->contacts());
  initial_.state = grains_->save();
}

std::unique_ptr<GrainBox> Cell::choose_box(const Packing& packing) {
  LAMMPS_NS::LAMMPS& lammps = driver_.lammps();
  const DiscSelection selection = disc_combination(lammps);
  if (control_.loop == CellLoop::engine || !selection.combination)
    return std::make_unique<EngineBox>(driver_);
  DiscBox::Definition discs = disc_definition(lammps, *selection.combination, packing.thickness);
  discs.plain = control_.loop == CellLoop::plain;
  auto box = std::make_unique<DiscBox>(std::move(discs));
  box->restore(disc_snapshot(lammps, *selection.combination, driver_.strain().box(), {}));
  box->set_up();
  return box;
}

void Cell::check(const Packing& packing, double pressure, const std::string& script_file) {
  PackingAtRest found{pressure,
                      packing.pressure,
                      0.0,
                      equilibrium(),
                      overlaps_of(grains_->contacts(), inertia_.radii),
                      !controlled() || !grains_->weights().empty()};
  if (pressure > 0.0)
    found.stiffness_level = mean_normal_stiffness(grains_->contacts()) / (pressure * packing.thickness);
  const double unrest = std::max(control_.unbalanced_force_ratio, control_.unbalanced_moment_ratio);
  if (const std::string fault = packing_fault(found, unrest, script_file); !fault.empty())
    driver_.lammps().error->all(FLERR, fault.c_str());
}

void Cell::check_rolling_model() {
  LAMMPS_NS::LAMMPS& lammps = driver_.lammps();
  const auto has = [&lammps](const char* property) {
    return lammps.modify->find_fix_property(property, "property/global", "peratomtypepair", 0, 0,
                                            "polargrain", false) != nullptr;
  };
  if (has("coefficientRollingFriction") && !has("rollingStiffnessRatio"))
    lammps.error->all(
        FLERR,
        "With controlled rotations the rolling model must be li_chu (or off): the stock models do "
        "not feel the curvature of the cell");
}

CellReply Cell::initial() {
  return initial_;
}

CellReply Cell::evaluate(const CellRequest& request) {
  const auto start = std::chrono::steady_clock::now();
  if (const double size = increment_size(request.increment); !(size <= kLargestIncrement)) {
    // An iteration gone astray; running it would cost hours and answer nothing.
    CellReply reply;
    reply.response.quality = Quality::failed;
    reply.response.step_factor = 0.5;
    reply.response.message =
        fmt::format("the increment strains or turns the cell by {:.2g} at once; at most {} is taken", size,
                    kLargestIncrement);
    return reply;
  }
  grains_->restore(request.state ? *request.state : *initial_.state);
  const int loading = loading_steps(control_, request.increment, time_of_grain_, driver_.mean_radius(),
                                    driver_.strain().time_step());
  std::optional<RotationLoading> rotation;
  if (controlled()) rotation = {request.increment.micro_rotation, request.increment.curvature};
  grains_->begin(BoxPath(grains_->box(), request.increment.displacement_gradient, loading), damping_rate_,
                 rotation);
  set_up();

  run(loading);
  CellReply reply;
  // Taken while the box still moves: the contacts that slide now are those that slide along the increment. At
  // rest most of them have just come off their limit, and the tangent would be that of unloading.
  const Matrix7 loading_tangent = tangent();
  Equilibrium rest = equilibrium();
  int relaxed = 0;
  while (!in_equilibrium(rest) && relaxed < control_.most_relaxation_steps) {
    run(kRelaxationChunk);
    relaxed += kRelaxationChunk;
    rest = equilibrium();
  }
  reply.diagnostics = measure();
  reply.response = respond();
  reply.response.tangent = loading_tangent;
  if (!in_equilibrium(rest)) {
    reply.response.quality = Quality::unreliable;
    reply.response.step_factor = 0.5;
    reply.response.message = fmt::format(
        "the cell did not come to rest within {} DEM steps: unbalanced force ratio {:.2e} (asked {:.2e}), "
        "moment ratio {:.2e} (asked {:.2e})",
        relaxed, rest.unbalanced_force_ratio, control_.unbalanced_force_ratio, rest.unbalanced_moment_ratio,
        control_.unbalanced_moment_ratio);
  }
  std::string fault = answer_fault(overlaps_of(grains_->contacts(), inertia_.radii), rest.void_ratio);
  if (fault.empty())
    fault = step_fault(grains_->contacts(), inertia_, damping_rate_, driver_.strain().time_step());
  if (!fault.empty()) {
    reply.response.quality = Quality::unreliable;
    reply.response.step_factor = 0.5;
    reply.response.message = fault;
  }
  reply.diagnostics.dem_steps = loading + relaxed;
  reply.state = grains_->save();
  reply.diagnostics.engine_seconds =
      std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();
  return reply;
}

void Cell::set_up() {
  grains_->set_up();
  if (!controlled()) return;
  // The weights come from these contacts, never from an earlier evaluation; with them, the torques that hold
  // the mean rotation can be added to the first forces.
  renew_weights();
  grains_->hold_rotation();
}

void Cell::renew_weights() {
  const std::vector<double> weights = rotation_weights(grains_->contacts(), driver_.grains());
  if (!weights.empty()) grains_->set_rotation_weights(weights);
}

void Cell::run(int steps) {
  if (!controlled()) return grains_->run(steps);
  // The weights follow the forces, a chunk behind.
  for (; steps > 0; steps -= kRelaxationChunk) {
    grains_->run(std::min(steps, kRelaxationChunk));
    renew_weights();
  }
}

Equilibrium Cell::equilibrium() const {
  return equilibrium_of(grains_->contacts(), grains_->imbalance(), driver_.mean_radius(), least_force_,
                        grains_->box().area(), driver_.grain_area());
}

double Cell::increment_size(const Increment& increment) const {
  return std::max({increment.displacement_gradient.cwiseAbs().maxCoeff(), std::abs(increment.micro_rotation),
                   increment.curvature.norm() * 2.0 * driver_.mean_radius()});
}

CellDiagnostics Cell::measure() const {
  const Equilibrium rest = equilibrium();
  CellDiagnostics diagnostics;
  diagnostics.unbalanced_force_ratio = rest.unbalanced_force_ratio;
  diagnostics.unbalanced_moment_ratio = rest.unbalanced_moment_ratio;
  diagnostics.void_ratio = rest.void_ratio;
  diagnostics.coordination_number = rest.coordination_number;
  diagnostics.rattlers = rest.rattlers;
  diagnostics.multiplier = grains_->multiplier();

  const std::span<const Contact> contacts = grains_->contacts();
  const auto fraction = [&contacts](auto property) {
    const auto count = std::count_if(contacts.begin(), contacts.end(), property);
    return contacts.empty() ? 0.0 : static_cast<double>(count) / static_cast<double>(contacts.size());
  };
  diagnostics.contacts = static_cast<std::int64_t>(contacts.size());
  diagnostics.sliding_fraction = fraction([](const Contact& contact) { return contact.sliding(); });
  diagnostics.rolling_fraction = fraction([](const Contact& contact) { return contact.rolling_at_limit; });
  const Eigen::Matrix2d frame = grains_->box().frame();
  const Eigen::Matrix2d fabric = frame * fabric_tensor(contacts) * frame.transpose();
  diagnostics.fabric = {fabric(0, 0), fabric(1, 1), fabric(0, 1)};

  const std::span<const double> rotations = grains_->rotations();
  if (rotations.empty()) return diagnostics;
  const auto grains = static_cast<double>(rotations.size());
  for (const double rotation : rotations) diagnostics.mean_rotation += rotation / grains;
  double variance = 0.0;
  for (const double rotation : rotations)
    variance += std::pow(rotation - diagnostics.mean_rotation, 2) / grains;
  diagnostics.rotation_spread = std::sqrt(variance);
  return diagnostics;
}

bool Cell::in_equilibrium(const Equilibrium& equilibrium) const {
  return equilibrium.unbalanced_force_ratio <= control_.unbalanced_force_ratio &&
         equilibrium.unbalanced_moment_ratio <= control_.unbalanced_moment_ratio;
}

Response Cell::respond() const {
  const Eigen::Matrix2d frame = grains_->box().frame();
  const double v = volume();
  const Eigen::Matrix2d stress = frame * average_stress(grains_->contacts(), v) * frame.transpose();
  Response response;
  response.stress(k11) = stress(0, 0);
  response.stress(k22) = stress(1, 1);
  response.stress(k12) = stress(0, 1);
  response.stress(k21) = stress(1, 0);
  if (controlled()) response.stress.tail<2>() = frame * average_couple_stress(grains_->contacts(), v);
  return response;
}

Matrix7 Cell::tangent() {
  if (control_.tangent == CellTangent::none) return Matrix7::Zero();
  const std::span<const Contact> contacts = grains_->contacts();
  const Eigen::Matrix2d frame = grains_->box().frame();
  const double v = volume();
  if (control_.tangent == CellTangent::voigt) {
    return controlled() ? voigt_cosserat_tangent(contacts, frame, v) : voigt_tangent(contacts, frame, v);
  }
  const ContactNetwork network{contacts, driver_.grains(), frame, v, kHold};
  if (!controlled() && control_.tangent == CellTangent::condensed) {
    return condensed_tangent_.classical(network).value_or(voigt_tangent(contacts, frame, v));
  }
  const std::vector<double> weights =
      controlled() ? std::vector<double>(grains_->weights().begin(), grains_->weights().end())
                   : rotation_weights(contacts, driver_.grains());
  std::optional<Matrix7> condensed;
  // Grains that have no neighbours but one each have no mean rotation that could be held.
  if (!weights.empty()) condensed = condensed_tangent_.cosserat(network, weights);
  return condensed.value_or(voigt_cosserat_tangent(contacts, frame, v));
}

}  // namespace

std::unique_ptr<CellService> make_cell_service(const CellDefinition& definition) {
  return std::make_unique<Cell>(definition);
}

}  // namespace polargrain::dem
