// SPDX-License-Identifier: GPL-2.0-or-later
#include "dem/pack/prepare.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <numbers>

#include "common/error.hpp"
#include "dem/cell/averages.hpp"
#include "dem/cell/cell_state.hpp"
#include "dem/cell/fix_cell_strain.hpp"
#include "dem/cell/packing_data.hpp"
#include "dem/cell/tangents.hpp"
#include "dem/engine/engine.hpp"
#include "dem/engine/liggghts.hpp"
#include "dem/pack/placement.hpp"

namespace polargrain::dem {

namespace {

/// DEM steps between two looks at the stress; the box makes one smooth move in between.
constexpr int kChunk = 20;
constexpr int kChunksOfProgress = 100;

/// One compression of one loose start.
class Compression {
 public:
  Compression(const PackingSpecification& specification, Packing packing, double friction);
  /// Until the packing is at rest under its pressure. @throws RunError after too many steps
  void compress(const std::function<void(const PackingReached&)>& progress);
  [[nodiscard]] PreparedPacking result();

 private:
  void set_property(const char* name, double value, bool required);
  void run_chunk(const Eigen::Vector2d& strain);
  /// The move of both axes that brings the stress to its aim if the grains moved affinely.
  [[nodiscard]] Eigen::Vector2d next_strain() const;
  void measure();
  [[nodiscard]] bool done() const;
  [[nodiscard]] double damping_rate() const;

  const PackingSpecification& specification_;
  Packing packing_;
  Engine engine_;
  FixCellStrain* strain_ = nullptr;
  double mean_mass_ = 0.0;
  double mean_radius_ = 0.0;
  double grain_area_ = 0.0;
  double damping_rate_ = 0.0;
  Eigen::Matrix2d stress_ = Eigen::Matrix2d::Zero();
  PackingReached reached_;
};

Compression::Compression(const PackingSpecification& specification, Packing packing, double friction)
    : specification_(specification), packing_(std::move(packing)), engine_(true) {
  const auto count = static_cast<double>(packing_.grains.size());
  for (const Grain& grain : packing_.grains) {
    mean_mass_ += grain.mass / count;
    mean_radius_ += grain.radius / count;
    grain_area_ += std::numbers::pi * grain.radius * grain.radius;
  }
  reached_.friction = friction;
  const PackingDataFile data(packing_);
  engine_.command(fmt::format("variable packing index {}", data.path()));
  engine_.script(specification.script, specification.script_file);
  // The models read their parameters when the engine initialises, below.
  set_property("coefficientFriction", friction, friction > 0.0);
  if (friction == 0.0) set_property("coefficientRollingFriction", 0.0, false);
  engine_.command("fix polargrain_pack all cell/strain");
  LAMMPS_NS::LAMMPS& lammps = engine_.lammps();
  strain_ = dynamic_cast<FixCellStrain*>(lammps.modify->fix[lammps.modify->find_fix("polargrain_pack")]);
  lammps.atom->sortfreq = 0;
  strain_->begin(BoxPath(Box::from_base_vectors(packing_.box), Eigen::Matrix2d::Zero(), 0), 0.0);
  lammps.update->nsteps = 0;
  lammps.update->firststep = lammps.update->laststep = lammps.update->ntimestep;
  lammps.update->whichflag = 1;  // dynamics
  lammps.init();
  lammps.update->integrate->setup_minimal(1);
}

void Compression::set_property(const char* name, double value, bool required) {
  LAMMPS_NS::LAMMPS& lammps = engine_.lammps();
  const LAMMPS_NS::Fix* property = lammps.modify->find_fix_property(
      name, "property/global", "peratomtypepair", 0, 0, "polargrain pack", false);
  // A fix given again under its name is replaced.
  if (property != nullptr)
    engine_.command(
        fmt::format("fix {} all property/global {} peratomtypepair 1 {:.17g}", property->id, name, value));
  if (property == nullptr && required)
    lammps.error->all(FLERR,
                      "The packing is to be made with friction, but the script has no property/global "
                      "coefficientFriction for one atom type");
}

void Compression::compress(const std::function<void(const PackingReached&)>& progress) {
  Eigen::Vector2d strain = Eigen::Vector2d::Zero();
  for (std::int64_t chunk = 1; !done(); ++chunk) {
    if (reached_.dem_steps > static_cast<double>(specification_.most_steps))
      throw RunError(fmt::format(
          "the packing did not come to rest within {} DEM steps: pressure {:.4g} kPa, anisotropy {:.1e}, "
          "unbalanced force "
          "ratio {:.1e}, moment ratio {:.1e}, coordination number {:.2f}; raise unbalanced_force_ratio, "
          "damping or most_steps",
          specification_.most_steps, 1e-3 * reached_.pressure, reached_.anisotropy,
          reached_.unbalanced_force_ratio, reached_.unbalanced_moment_ratio, reached_.coordination_number));
    run_chunk(strain);
    measure();
    strain = next_strain();
    if (progress && chunk % kChunksOfProgress == 0) progress(reached_);
  }
}

void Compression::run_chunk(const Eigen::Vector2d& strain) {
  LAMMPS_NS::LAMMPS& lammps = engine_.lammps();
  LAMMPS_NS::Update& update = *lammps.update;
  // The last step stands still, so that the grains keep nothing of the affine velocity.
  strain_->begin(BoxPath(strain_->box(), Eigen::Matrix2d(strain.asDiagonal()), kChunk - 1), damping_rate_);
  update.laststep = update.ntimestep + kChunk + 1;  // no step is the engine's last: it would print
  lammps.output->next = update.laststep;
  update.integrate->run(kChunk - 1);
  contact_recorder().contacts.clear();
  contact_recorder().on = true;
  update.integrate->run(1);
  contact_recorder().on = false;
  reached_.dem_steps += kChunk;
  bool finite = true;
  for (int k = 0; k < lammps.atom->nlocal; ++k)
    finite = finite && std::isfinite(lammps.atom->x[k][0]) && std::isfinite(lammps.atom->x[k][1]);
  if (!finite || lammps.atom->nlocal != static_cast<int>(packing_.grains.size()))
    lammps.error->all(FLERR,
                      "Lost atoms: the time step of the script is too large for these grains and contacts");
}

Eigen::Vector2d Compression::next_strain() const {
  const Box box = strain_->box();
  const double time_of_grain =
      2.0 * mean_radius_ * std::sqrt(specification_.density / specification_.pressure);
  const double most = specification_.inertial_number / time_of_grain * kChunk * strain_->time_step();
  const Matrix7 affine = voigt_tangent(contact_recorder().contacts, Eigen::Matrix2d::Identity(),
                                       box.area() * packing_.thickness);
  Eigen::Vector2d strain;
  for (int axis = 0; axis < 2; ++axis) {
    const double missing = specification_.pressure + stress_(axis, axis);
    const double stiffness = affine(axis == 0 ? k11 : k22, k11) + affine(axis == 0 ? k11 : k22, k22);
    strain(axis) = std::clamp(stiffness > 0.0 ? -missing / stiffness : -most, -most, most);
  }
  return strain;
}

double Compression::damping_rate() const {
  const double stiffness = mean_normal_stiffness(contact_recorder().contacts);
  return 2.0 * specification_.damping * std::sqrt(stiffness / mean_mass_);
}

void Compression::measure() {
  const std::vector<Contact>& contacts = contact_recorder().contacts;
  const auto count = static_cast<double>(packing_.grains.size());
  damping_rate_ = std::max(damping_rate_, damping_rate());
  stress_ = average_stress(contacts, strain_->box().area() * packing_.thickness);
  std::vector<bool> touched(packing_.grains.size(), false);
  for (const Contact& contact : contacts)
    touched[static_cast<std::size_t>(contact.first)] = touched[static_cast<std::size_t>(contact.second)] =
        true;
  const auto carrying = static_cast<double>(std::count(touched.begin(), touched.end(), true));
  const double force = mean_contact_force(contacts);
  const double trace = stress_.trace();
  reached_.void_ratio = strain_->box().area() / grain_area_ - 1.0;
  reached_.coordination_number = 2.0 * static_cast<double>(contacts.size()) / count;
  reached_.rattlers = 1.0 - carrying / count;
  reached_.pressure = -0.5 * trace;
  if (contacts.empty() || trace == 0.0) return;
  reached_.anisotropy = (stress_(0, 0) - stress_(1, 1)) / trace;
  reached_.shear = (stress_(0, 1) + stress_(1, 0)) / trace;
  reached_.unbalanced_force_ratio = strain_->sum_of_unbalanced_force() / carrying / force;
  reached_.unbalanced_moment_ratio = strain_->sum_of_unbalanced_moment() / carrying / (force * mean_radius_);
}

bool Compression::done() const {
  const double allowed = specification_.pressure_tolerance * specification_.pressure;
  return std::abs(stress_(0, 0) + specification_.pressure) <= allowed &&
         std::abs(stress_(1, 1) + specification_.pressure) <= allowed &&
         reached_.unbalanced_force_ratio <= specification_.unbalanced_force_ratio &&
         reached_.unbalanced_moment_ratio <= specification_.unbalanced_force_ratio;
}

PreparedPacking Compression::result() {
  LAMMPS_NS::LAMMPS& lammps = engine_.lammps();
  const Box box = strain_->box();
  PreparedPacking prepared;
  prepared.specification = specification_.text;
  prepared.reached = reached_;
  prepared.packing = packing_;
  prepared.packing.box = box.base_vectors();
  for (int k = 0; k < lammps.atom->nlocal; ++k) {
    // Grains leave the box between two neighbour lists: fold them back.
    Eigen::Vector2d position(lammps.atom->x[k][0], lammps.atom->x[k][1]);
    position.x() -= box.length_x * std::floor(position.x() / box.length_x);
    position.y() -= box.length_y * std::floor(position.y() / box.length_y);
    // The data file counts the grains, which stand in the order of their ids, from 1.
    prepared.packing.grains[static_cast<std::size_t>(lammps.atom->tag[k] - 1)].position = position;
  }
  if (reached_.friction > 0.0) prepared.packing.state = save_state(lammps, box);
  return prepared;
}

}  // namespace

PreparedPacking prepare_packing(const PackingSpecification& specification,
                                const std::function<void(const PackingReached&)>& progress) {
  const Packing loose = place_grains(specification);
  const auto with_friction = [&](double friction) {
    Compression compression(specification, loose, friction);
    compression.compress(progress);
    return compression.result();
  };
  if (!specification.void_ratio) return with_friction(specification.friction);

  // More friction while compressed leaves more voids: bisection. Not quite monotonous, so it may fail, and
  // then says so.
  const double wanted = *specification.void_ratio;
  const auto fits = [&](const PreparedPacking& packing) {
    return std::abs(packing.reached.void_ratio - wanted) <= specification.void_ratio_tolerance;
  };
  double low = 0.0;
  double high = specification.friction;
  PreparedPacking dense = with_friction(low);
  if (fits(dense)) return dense;
  PreparedPacking loosest = with_friction(high);
  if (fits(loosest)) return loosest;
  if (wanted < dense.reached.void_ratio || wanted > loosest.reached.void_ratio)
    throw RunError(fmt::format(
        "a void ratio of {:.4g} is out of reach: friction from 0 to {:.4g} gives {:.4f} to {:.4f}", wanted,
        high, dense.reached.void_ratio, loosest.reached.void_ratio));
  for (int trial = 0; trial < 12; ++trial) {
    const double friction = 0.5 * (low + high);
    PreparedPacking packing = with_friction(friction);
    if (fits(packing)) return packing;
    (packing.reached.void_ratio < wanted ? low : high) = friction;
  }
  throw RunError(fmt::format(
      "no friction gave a void ratio of {:.4g} within {:.1e}; raise void_ratio_tolerance or take more grains",
      wanted, specification.void_ratio_tolerance));
}

}  // namespace polargrain::dem
