// SPDX-License-Identifier: GPL-2.0-or-later
#include <fmt/format.h>

#include <Eigen/Eigenvalues>
#include <algorithm>
#include <chrono>
#include <cmath>
#include <numbers>

#include "common/error.hpp"
#include "dem/cell/averages.hpp"
#include "dem/cell/cell_service.hpp"
#include "dem/cell/cell_state.hpp"
#include "dem/cell/condensed_tangent.hpp"
#include "dem/cell/fix_cell_strain.hpp"
#include "dem/cell/packing_data.hpp"
#include "dem/engine/liggghts.hpp"

namespace polargrain::dem {

namespace {

/// DEM steps between two looks at the equilibrium while a cell relaxes.
constexpr int kRelaxationChunk = 20;

/// Spring that holds each grain in the condensed tangent, over the mean normal stiffness. From 1e-6 to 1e-3
/// it changes no modulus by more than 1 %.
constexpr double kHold = 1e-4;

/// The largest strain, displacement gradient or rotation a cell takes in one increment.
constexpr double kLargestIncrement = 0.25;

/// Magnitude of the largest principal strain.
double largest_strain(const Eigen::Matrix2d& displacement_gradient) {
  const Eigen::Matrix2d strain = 0.5 * (displacement_gradient + displacement_gradient.transpose());
  return Eigen::SelfAdjointEigenSolver<Eigen::Matrix2d>(strain, Eigen::EigenvaluesOnly)
      .eigenvalues()
      .cwiseAbs()
      .maxCoeff();
}

double increment_size(const Increment& increment) {
  return std::max(increment.displacement_gradient.cwiseAbs().maxCoeff(), std::abs(increment.micro_rotation));
}

class Cell final : public CellService {
 public:
  explicit Cell(const CellDefinition& definition);
  CellReply initial() override;
  CellReply evaluate(const CellRequest& request) override;

 private:
  /// Neighbours and forces at the positions as they are; no step.
  void set_up();
  /// DEM steps; the contacts of the last force pass are recorded.
  void run(int steps);
  void run_and_record(int steps);
  /// Weights of the grains in the mean rotation, from the recorded contacts (mode 2).
  void renew_weights();
  /// Ends the process in the engine's words when a grain was lost.
  void check_grains();
  [[nodiscard]] int loading_steps(const Increment& increment) const;
  [[nodiscard]] CellDiagnostics measure() const;
  [[nodiscard]] bool in_equilibrium(const CellDiagnostics& diagnostics) const;
  /// Stress of the recorded contacts, in the laboratory frame.
  [[nodiscard]] Response respond() const;
  /// Tangent of the recorded contacts, in the laboratory frame.
  [[nodiscard]] Matrix7 tangent() const;

  CellControl control_;
  int grains_ = 0;
  double thickness_ = 0.0;      // m
  double grain_area_ = 0.0;     // sum, m^2
  double mean_radius_ = 0.0;    // m
  double time_of_grain_ = 0.0;  // mean diameter * sqrt(density / pressure), s; inertial number = rate * this
  double damping_rate_ = 0.0;   // 1/s
  Engine engine_;
  FixCellStrain* strain_ = nullptr;
  CellReply initial_;
};

Cell::Cell(const CellDefinition& definition) : control_(definition.control), engine_(true) {
  const Packing& packing = definition.packing;
  grains_ = static_cast<int>(packing.grains.size());
  thickness_ = packing.thickness;
  double mass = 0.0;
  for (const Grain& grain : packing.grains) {
    grain_area_ += std::numbers::pi * grain.radius * grain.radius;
    mean_radius_ += grain.radius / static_cast<double>(packing.grains.size());
    mass += grain.mass;
  }

  const PackingDataFile data(packing);
  engine_.command(fmt::format("variable packing index {}", data.path()));
  engine_.script(definition.script, definition.script_file);
  engine_.command("fix polargrain_cell all cell/strain");

  LAMMPS_NS::LAMMPS& lammps = engine_.lammps();
  strain_ = dynamic_cast<FixCellStrain*>(lammps.modify->fix[lammps.modify->find_fix("polargrain_cell")]);
  lammps.atom->sortfreq = 0;  // the order of the grains is part of the state
  const Box box = Box::from_base_vectors(packing.box).reduced();
  strain_->begin(BoxPath(box, Eigen::Matrix2d::Zero(), 0), 0.0);
  lammps.update->nsteps = 0;
  lammps.update->firststep = lammps.update->laststep = lammps.update->ntimestep;
  lammps.update->whichflag = 1;  // dynamics
  lammps.init();
  if (packing.state) restore_state(lammps, *packing.state);
  set_up();

  initial_.response = respond();
  initial_.response.tangent = tangent();
  initial_.diagnostics = measure();
  const double pressure = -0.5 * (initial_.response.stress(k11) + initial_.response.stress(k22));
  if (!(pressure > 0.0))
    lammps.error->all(
        FLERR,
        "The packing carries no pressure at rest: its grains do not touch, or the stiffness in the "
        "script is not the one the packing was made with");
  time_of_grain_ = 2.0 * mean_radius_ * std::sqrt(mass / (grain_area_ * thickness_) / pressure);
  const double mean_mass = mass / static_cast<double>(packing.grains.size());
  damping_rate_ =
      2.0 * control_.damping * std::sqrt(mean_normal_stiffness(contact_recorder().contacts) / mean_mass);
  initial_.state = save_state(lammps, box);
}

CellReply Cell::initial() {
  return initial_;
}

CellReply Cell::evaluate(const CellRequest& request) {
  const auto start = std::chrono::steady_clock::now();
  LAMMPS_NS::LAMMPS& lammps = engine_.lammps();
  lammps.update->ntimestep = 0;  // nothing of an earlier evaluation may show in this one
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
  const Box box = restore_state(lammps, request.state ? *request.state : *initial_.state);
  const int loading = loading_steps(request.increment);
  const BoxPath path(box, request.increment.displacement_gradient, loading);
  if (control_.rotations == CellRotations::controlled)
    strain_->begin(path, damping_rate_, RotationLoading{request.increment.micro_rotation});
  else
    strain_->begin(path, damping_rate_);
  set_up();

  run(loading);
  CellReply reply;
  // Taken while the box still moves: the contacts that slide now are those that slide along the increment. At
  // rest most of them have just come off their limit, and the tangent would be that of unloading.
  const Matrix7 loading_tangent = tangent();
  reply.diagnostics = measure();
  int relaxed = 0;
  while (!in_equilibrium(reply.diagnostics) && relaxed < control_.most_relaxation_steps) {
    run(kRelaxationChunk);
    relaxed += kRelaxationChunk;
    reply.diagnostics = measure();
  }
  reply.response = respond();
  reply.response.tangent = loading_tangent;
  if (!in_equilibrium(reply.diagnostics)) {
    reply.response.quality = Quality::unreliable;
    reply.response.step_factor = 0.5;
    reply.response.message = fmt::format(
        "the cell did not come to rest within {} DEM steps: unbalanced force ratio {:.2e} (asked {:.2e}), "
        "moment ratio {:.2e} (asked {:.2e})",
        relaxed, reply.diagnostics.unbalanced_force_ratio, control_.unbalanced_force_ratio,
        reply.diagnostics.unbalanced_moment_ratio, control_.unbalanced_moment_ratio);
  }
  reply.diagnostics.dem_steps = loading + relaxed;
  reply.state = save_state(lammps, strain_->box().reduced());
  reply.diagnostics.engine_seconds =
      std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();
  return reply;
}

void Cell::set_up() {
  contact_recorder().contacts.clear();
  contact_recorder().on = true;
  engine_.lammps().update->integrate->setup_minimal(1);
  contact_recorder().on = false;
  if (control_.rotations == CellRotations::free) return;
  // The weights come from these contacts, never from an earlier evaluation; with them, the torques that hold the mean
  // rotation can be added to the first forces.
  renew_weights();
  strain_->setup(0);
}

void Cell::renew_weights() {
  if (control_.rotations == CellRotations::free) return;
  // Torque that the contacts of a grain can carry, up to the coefficient of friction; none with fewer than
  // two contacts, or the multiplier would spin up the grains that nothing holds.
  const auto grains = static_cast<std::size_t>(strain_->grains());
  std::vector<double> capacities(grains, 0.0);
  std::vector<int> count(grains, 0);
  for (const Contact& contact : contact_recorder().contacts) {
    const double force = std::max(0.0, contact.normal_force());
    capacities[contact.first] += contact.arm_first * force;
    capacities[contact.second] += contact.arm_second * force;
    ++count[contact.first];
    ++count[contact.second];
  }
  double sum = 0.0;
  for (std::size_t k = 0; k < grains; ++k) sum += capacities[k] = count[k] < 2 ? 0.0 : capacities[k];
  if (sum > 0.0) strain_->set_torque_capacities(capacities);
}

void Cell::run(int steps) {
  if (control_.rotations == CellRotations::controlled) {
    // The weights follow the forces, a chunk behind.
    for (; steps > kRelaxationChunk; steps -= kRelaxationChunk) {
      run_and_record(kRelaxationChunk);
      renew_weights();
    }
  }
  run_and_record(steps);
  renew_weights();
}

void Cell::run_and_record(int steps) {
  LAMMPS_NS::Update& update = *engine_.lammps().update;
  update.laststep = update.ntimestep + steps + 1;  // no step is the engine's last: it would print
  engine_.lammps().output->next = update.laststep;
  if (steps > 1) update.integrate->run(steps - 1);
  contact_recorder().contacts.clear();
  contact_recorder().on = true;
  update.integrate->run(1);
  contact_recorder().on = false;
  check_grains();
}

void Cell::check_grains() {
  LAMMPS_NS::LAMMPS& lammps = engine_.lammps();
  // The engine looks only when it prints, which a cell never lets it do.
  bool finite = true;
  for (int k = 0; k < lammps.atom->nlocal; ++k)
    finite = finite && std::isfinite(lammps.atom->x[k][0]) && std::isfinite(lammps.atom->x[k][1]);
  if (lammps.atom->nlocal == grains_ && finite) return;
  const std::string message = fmt::format(
      "Lost atoms: original {} current {}: the time step is too large for the stiffness of the contacts, or "
      "grains were pressed into each other",
      grains_, finite ? lammps.atom->nlocal : 0);
  lammps.error->all(FLERR, message.c_str());
}

int Cell::loading_steps(const Increment& increment) const {
  const Eigen::Matrix2d& h = increment.displacement_gradient;
  double size = largest_strain(h);
  // Grains that turn against the continuum slide on each other as fast as a shear strain of that size makes
  // them.
  if (control_.rotations == CellRotations::controlled)
    size = std::max(size, std::abs(increment.micro_rotation - 0.5 * (h(1, 0) - h(0, 1))));
  const double steps = std::ceil(size * time_of_grain_ / (control_.inertial_number * strain_->time_step()));
  if (!(steps < 1e9)) throw RunError("the increment asks for more than 1e9 DEM steps");
  return std::max(control_.least_steps, static_cast<int>(steps));
}

CellDiagnostics Cell::measure() const {
  const std::vector<Contact>& contacts = contact_recorder().contacts;
  std::vector<bool> touched(static_cast<std::size_t>(strain_->grains()), false);
  CellDiagnostics diagnostics;
  double sliding = 0.0;
  for (const Contact& contact : contacts) {
    touched[static_cast<std::size_t>(contact.first)] = touched[static_cast<std::size_t>(contact.second)] =
        true;
    if (contact.sliding()) sliding += 1.0;
  }
  const auto carrying = static_cast<double>(std::count(touched.begin(), touched.end(), true));
  const double contact_force = mean_contact_force(contacts);
  const auto count = static_cast<double>(contacts.size());
  diagnostics.contacts = static_cast<std::int64_t>(contacts.size());
  diagnostics.multiplier = strain_->multiplier();
  diagnostics.void_ratio = strain_->box().area() / grain_area_ - 1.0;
  if (!contacts.empty()) {
    diagnostics.unbalanced_force_ratio = strain_->sum_of_unbalanced_force() / carrying / contact_force;
    diagnostics.unbalanced_moment_ratio =
        strain_->sum_of_unbalanced_moment() / carrying / (contact_force * mean_radius_);
    diagnostics.coordination_number = 2.0 * count / static_cast<double>(touched.size());
    diagnostics.sliding_fraction = sliding / count;
  }
  return diagnostics;
}

bool Cell::in_equilibrium(const CellDiagnostics& diagnostics) const {
  return diagnostics.unbalanced_force_ratio <= control_.unbalanced_force_ratio &&
         diagnostics.unbalanced_moment_ratio <= control_.unbalanced_moment_ratio;
}

Response Cell::respond() const {
  const std::vector<Contact>& contacts = contact_recorder().contacts;
  const Box box = strain_->box();
  const Eigen::Matrix2d frame = box.frame();
  const double volume = box.area() * thickness_;
  const Eigen::Matrix2d stress = frame * average_stress(contacts, volume) * frame.transpose();
  Response response;
  response.stress(k11) = stress(0, 0);
  response.stress(k22) = stress(1, 1);
  response.stress(k12) = stress(0, 1);
  response.stress(k21) = stress(1, 0);
  return response;
}

Matrix7 Cell::tangent() const {
  const std::vector<Contact>& contacts = contact_recorder().contacts;
  const Box box = strain_->box();
  const double volume = box.area() * thickness_;
  if (control_.tangent == CellTangent::none) return Matrix7::Zero();
  if (control_.tangent == CellTangent::condensed && control_.rotations == CellRotations::controlled)
    if (const auto condensed =
            condensed_cosserat_tangent(contacts, strain_->weights(), box.frame(), volume, kHold))
      return *condensed;
  if (control_.tangent == CellTangent::condensed && control_.rotations == CellRotations::free)
    if (const auto condensed = condensed_tangent(contacts, strain_->grains(), box.frame(), volume, kHold))
      return *condensed;
  return voigt_tangent(contacts, box.frame(), volume);
}

}  // namespace

std::unique_ptr<CellService> make_cell_service(const CellDefinition& definition) {
  return std::make_unique<Cell>(definition);
}

}  // namespace polargrain::dem
