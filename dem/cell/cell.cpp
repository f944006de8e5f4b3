// SPDX-License-Identifier: GPL-2.0-or-later
#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "common/elementary_functions.hpp"
#include "common/error.hpp"
#include "common/plane_in_space.hpp"
#include "common/seconds.hpp"
#include "dem/cell/averages.hpp"
#include "dem/cell/cell_answers.hpp"
#include "dem/cell/cell_service.hpp"
#include "dem/cell/cell_state.hpp"
#include "dem/cell/condensed_tangent.hpp"
#include "dem/cell/driver.hpp"
#include "dem/cell/engine_box.hpp"
#include "dem/cell/grains_in_laboratory.hpp"
#include "dem/cell/packing_check.hpp"
#include "dem/cell/quasi_static.hpp"
#include "dem/cell/resident_boxes_of.hpp"
#include "dem/cell/tangents.hpp"
#include "dem/discs/disc_box.hpp"
#include "dem/discs/disc_state.hpp"
#include "dem/engine/liggghts.hpp"
#include "dem/spheres/sphere_cell.hpp"

namespace polargrain::dem {

namespace {

/// Angle of the rotation of an increment, rad: of R in I + h = R U.
double turn_of(const Eigen::Matrix2d& gradient) {
  return arc_tangent(gradient(1, 0) - gradient(0, 1), 2.0 + gradient.trace());
}

class Cell final : public CellOfGrains {
 public:
  explicit Cell(const CellDefinition& definition);
  CellReply initial() override;
  CellReply evaluate(const CellRequest& request) override;
  std::unique_ptr<ResidentBoxes> residents() override;
  [[nodiscard]] std::span<const Contact> contacts() const override { return grains_->contacts(); }
  [[nodiscard]] GrainView view() override;

 private:
  struct ResidentKind;
  /// Within the plane of the discs. @param start null: the packing
  CellReply follow(const StatePointer& start, const Increment<2>& increment);
  [[nodiscard]] bool controlled() const { return protocol_.controlled(); }
  /// Ends the process when the packing does not fit its script. @param pressure that it carries, Pa
  void check(const Packing& packing, double pressure, const std::string& script_file);
  /// The loop over discs where it knows the scene, else the engine's own.
  std::unique_ptr<GrainBox> choose_box(const Packing& packing);
  /// Neighbours and forces at the positions as they are; no step.
  void set_up();
  /// DEM steps to the next look; the contacts of the last force pass are recorded.
  void run();
  /// Weights of the grains in the mean rotation, from the recorded contacts (mode 2).
  void renew_weights();
  /// Largest strain, turn of the grains against the continuum, and curvature times mean diameter of an increment. @param turn
  /// of the continuum, rad, which is not among them
  [[nodiscard]] double increment_size(const Increment<2>& increment, double turn) const;
  [[nodiscard]] double volume() const { return grains_->box().area() * thickness_; }
  [[nodiscard]] Equilibrium equilibrium(const GrainBox& grains) const;
  [[nodiscard]] CellDiagnostics measure(const GrainBox& grains) const;
  /// Stress of the recorded contacts, in the laboratory frame.
  [[nodiscard]] CellResponse respond(const GrainBox& grains, const Matrix7& tangent) const;
  /// Tangent of the recorded contacts, in the laboratory frame. @param strain size of the increment that led to them
  [[nodiscard]] Matrix7 tangent(double strain);

  CellControl control_;
  QuasiStatic protocol_;
  double thickness_ = 0.0;  // m
  Driver driver_;
  Inertia inertia_;  // of the grains, as contacts count them
  std::unique_ptr<GrainBox> grains_;
  CondensedTangent condensed_tangent_;
  CellReply initial_;
  StatePointer shown_;  ///< of the last evaluation, or the packing
};

/// @throws RunError when the places of its grains cannot be those of a packing
const CellDefinition& sound(const CellDefinition& definition) {
  if (const std::string fault = geometry_fault(definition.packing); !fault.empty()) throw RunError(fault);
  return definition;
}

Cell::Cell(const CellDefinition& definition)
    : control_(definition.control),
      protocol_(definition.control),
      thickness_(definition.packing.thickness),
      driver_(sound(definition).packing, definition.script, definition.script_file,
              definition.contact_library) {
  LAMMPS_NS::LAMMPS& lammps = driver_.lammps();
  if (controlled() && is_bent(control_)) check_rolling_model(lammps);
  const Packing& packing = definition.packing;
  if (packing.state) restore_packing([&] { restore_state(lammps, *packing.state); });
  driver_.set_up();
  const std::string remark = driver_.settle_time_step(control_.damping);
  inertia_ = inertia_of(lammps);
  grains_ = choose_box(packing);
  grains_->progress = [this] {
    if (progress) progress();
  };
  // The forces of the start are there; setting them up twice would fold the grains back twice, to other last bits.
  if (controlled()) renew_weights();

  initial_.response = respond(*grains_, tangent(0.0));
  initial_.response.message =
      remarks_at_rest(remark, control_, "the loop over discs", disc_combination(lammps));
  initial_.diagnostics = measure(*grains_);
  const double pressure = -0.5 * (initial_.response.stress(0, 0) + initial_.response.stress(1, 1));
  check(packing, pressure, definition.script_file);
  const double density = driver_.grains() * driver_.mean_mass() / (driver_.grain_area() * packing.thickness);
  protocol_.take_scales({driver_.mean_mass(), driver_.mean_radius(), density}, grains_->contacts(), pressure);
  shown_ = initial_.state = grains_->save();
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
                      equilibrium(*grains_),
                      overlaps_of(grains_->contacts(), inertia_.radii),
                      !controlled() || !grains_->weights().empty()};
  if (pressure > 0.0)
    found.stiffness_level = mean_normal_stiffness(grains_->contacts()) / (pressure * packing.thickness);
  const double unrest = std::max(control_.unbalanced_force_ratio, control_.unbalanced_moment_ratio);
  if (const std::string fault = packing_fault(found, unrest, script_file); !fault.empty())
    driver_.lammps().error->all(FLERR, fault.c_str());
}

CellReply Cell::initial() {
  return initial_;
}

CellReply Cell::evaluate(const CellRequest& request) {
  const auto start = Clock::now();
  if (const std::string fault = out_of_plane_fault(request.increment); !fault.empty()) throw RunError(fault);
  CellReply reply = follow(request.state, in_plane(request.increment));
  reply.diagnostics.engine_seconds = seconds_since(start);
  return reply;
}

CellReply Cell::follow(const StatePointer& start, const Increment<2>& increment) {
  const double turn = turn_of(increment.displacement_gradient);
  if (const std::optional<CellReply> astray = gone_astray(increment_size(increment, turn), std::abs(turn)))
    return *astray;
  grains_->restore(start ? *start : *initial_.state);
  grains_->begin(protocol_.begin(grains_->box(), increment, driver_.strain().time_step()),
                 protocol_.damping_rate(), protocol_.rotation_of(increment));
  set_up();

  while (!protocol_.loaded()) run();
  // Taken while the box still moves: the contacts that slide now are those that slide along the increment. At
  // rest most of them have just come off their limit, and the tangent would be that of unloading.
  const Matrix7 loading_tangent = tangent(protocol_.size());
  Equilibrium rest = equilibrium(*grains_);
  while (!protocol_.ended(rest.unbalanced_force_ratio, rest.unbalanced_moment_ratio)) {
    run();
    rest = equilibrium(*grains_);
  }
  CellReply reply;
  reply.diagnostics = measure(*grains_);
  reply.response = respond(*grains_, loading_tangent);
  judge(reply.response, reply.diagnostics, protocol_, control_, rest, grains_->contacts(), inertia_,
        driver_.strain().time_step(), kMostVoidRatio);
  reply.diagnostics.dem_steps = protocol_.done();
  shown_ = reply.state = grains_->save();
  return reply;
}

GrainView Cell::view() {
  std::vector<GrainView::Grain> grains(inertia_.radii.size());
  const LAMMPS_NS::Atom& atom = *driver_.lammps().atom;
  const std::span<const double> rotations = grains_->rotations();
  for (std::size_t k = 0; k < grains.size(); ++k) {
    GrainView::Grain& grain = grains[k];
    grain.id = atom.tag[k] - 1;
    grain.radius = inertia_.radii[k];
    if (!rotations.empty()) grain.rotation.z() = rotations[k];
  }
  if (is_disc_state(*shown_)) {  // which the engine itself does not hold
    const DiscSnapshot snapshot = decode_discs(*shown_);
    for (std::size_t k = 0; k < grains.size(); ++k) {
      const DiscSnapshot::Motion& disc = snapshot.discs[k];
      grains[k].position = {disc.x, disc.y, 0.0};
      grains[k].velocity = {disc.vx, disc.vy, 0.0};
      grains[k].spin.z() = disc.spin;
    }
  } else {
    for (std::size_t k = 0; k < grains.size(); ++k) {
      grains[k].position = {atom.x[k][0], atom.x[k][1], 0.0};
      grains[k].velocity = {atom.v[k][0], atom.v[k][1], 0.0};
      grains[k].spin.z() = atom.omega[k][2];
    }
  }
  const Box box = grains_->box().reduced();
  Eigen::Matrix3d base = Eigen::Matrix3d::Zero();
  base.topLeftCorner<2, 2>() = box.base_vectors();
  base(2, 2) = thickness_;
  Eigen::Matrix3d frame = Eigen::Matrix3d::Identity();
  frame.topLeftCorner<2, 2>() = box.frame();
  return grains_in_laboratory(std::move(grains), grains_->contacts(), base, frame);
}

void Cell::set_up() {
  grains_->set_up();
  if (!controlled()) return;
  // The weights come from these contacts, never from an earlier evaluation; with them, the torques that hold
  // the mean rotation can be added to the first forces.
  renew_weights();
  grains_->hold_rotation();
}

struct Cell::ResidentKind {
  using Box = DiscBox;
  Cell& cell;
  DiscBox::Definition discs;

  [[nodiscard]] std::unique_ptr<Box> make() const {
    auto box = std::make_unique<Box>(discs);
    box->progress = cell.grains_->progress;
    return box;
  }
  void alive() const {
    if (cell.progress) cell.progress();
  }
  void hold(Box& box) const {
    if (!cell.controlled()) return;
    const std::vector<double> weights = rotation_weights(box.contacts(), cell.driver_.grains());
    if (!weights.empty()) box.set_rotation_weights(weights);
  }
  void put(Box& box, const ResidentStart& start) const {
    box.restore_moving(start.state ? *start.state : *cell.initial_.state,
                       start.motion.gradient.topLeftCorner<2, 2>(), start.motion.spin.z());
    // The torques that hold the mean rotation belong to the forces of the start: prescribed, it has the spin behind it.
    if (cell.controlled())
      box.go_on(BoxPath(box.box(), Eigen::Matrix2d::Zero(), 1, Pace::even), cell.protocol_.damping_rate(),
                RotationLoading{});
    box.set_up();
    hold(box);
    box.hold_rotation();
  }
  void go_on(Box& box, int steps, const CellIncrement& increment) const {
    if (const std::string fault = out_of_plane_fault(increment); !fault.empty()) throw RunError(fault);
    const Increment<2> plane = in_plane(increment);
    box.go_on(BoxPath(box.box(), plane.displacement_gradient, steps, Pace::even),
              cell.protocol_.damping_rate(), cell.protocol_.rotation_of(plane));
    box.run(steps);
    hold(box);
  }
  [[nodiscard]] ResidentAnswer answer(const Box& box) const {
    const CellResponse response = cell.respond(box, Matrix7::Zero());
    return {response.stress, response.couple_stress,
            quick_force_ratio(box.imbalance(), box.contacts(), cell.protocol_.least_force()),
            2.0 * static_cast<double>(box.contacts().size()) / cell.driver_.grains(),
            cell.driver_.strain().time_step()};
  }
  [[nodiscard]] ResidentReadOut read(Box& box) const {
    ResidentReadOut all;
    all.reply.response = cell.respond(box, Matrix7::Zero());
    all.reply.diagnostics = cell.measure(box);
    all.motion.gradient.topLeftCorner<2, 2>() = box.motion().gradient();
    all.motion.spin.z() = box.motion().spin();
    all.reply.state = box.save_moving();
    return all;
  }
};

std::unique_ptr<ResidentBoxes> Cell::residents() {
  LAMMPS_NS::LAMMPS& lammps = driver_.lammps();
  const DiscSelection selection = disc_combination(lammps);
  if (!selection.combination) throw RunError(no_residents(selection));
  return std::make_unique<ResidentBoxesOf<ResidentKind>>(
      ResidentKind{*this, disc_definition(lammps, *selection.combination, thickness_)});
}

void Cell::renew_weights() {
  const std::vector<double> weights = rotation_weights(grains_->contacts(), driver_.grains());
  if (!weights.empty()) grains_->set_rotation_weights(weights);
}

void Cell::run() {
  const int steps = protocol_.steps_to_next_look();
  grains_->run(steps);
  protocol_.advance(steps);
  if (controlled()) renew_weights();
}

Equilibrium Cell::equilibrium(const GrainBox& grains) const {
  return equilibrium_of(grains.contacts(), grains.imbalance(), driver_.mean_radius(), protocol_.least_force(),
                        grains.box().area(), driver_.grain_area());
}

double Cell::increment_size(const Increment<2>& increment, double turn) const {
  const auto [sine, cosine] = sine_and_cosine(turn);
  Eigen::Matrix2d back;
  back << cosine, sine, -sine, cosine;
  const Eigen::Matrix2d one = Eigen::Matrix2d::Identity();
  const Eigen::Matrix2d stretch = back * (one + increment.displacement_gradient) - one;
  return std::max({stretch.cwiseAbs().maxCoeff(),
                   controlled() ? std::abs(increment.micro_rotation - turn) : 0.0,
                   increment.curvature.norm() * 2.0 * driver_.mean_radius()});
}

CellDiagnostics Cell::measure(const GrainBox& grains) const {
  const std::span<const Contact> contacts = grains.contacts();
  CellDiagnostics diagnostics = diagnostics_of(equilibrium(grains), contacts, inertia_.radii,
                                               [](const Contact& contact) { return contact.sliding(); });
  diagnostics.multiplier = grains.multiplier();
  const Eigen::Matrix2d frame = grains.box().frame();
  const Eigen::Matrix2d fabric = frame * fabric_tensor(contacts) * frame.transpose();
  diagnostics.fabric = {fabric(0, 0), fabric(1, 1), fabric(0, 1)};

  const std::span<const double> rotations = grains.rotations();
  if (rotations.empty()) return diagnostics;
  const auto number = static_cast<double>(rotations.size());
  for (const double rotation : rotations) diagnostics.mean_rotation += rotation / number;
  double variance = 0.0;
  for (const double rotation : rotations)
    variance += std::pow(rotation - diagnostics.mean_rotation, 2) / number;
  diagnostics.rotation_spread = std::sqrt(variance);
  return diagnostics;
}

CellResponse Cell::respond(const GrainBox& grains, const Matrix7& tangent) const {
  Response<2> response = protocol_.read_out(grains.contacts(), grains.box(), thickness_);
  response.tangent = tangent;
  return in_space(response, KnownComponents::plane);
}

Matrix7 Cell::tangent(double strain) {
  if (control_.tangent == CellTangent::none) return Matrix7::Zero();
  const std::span<const Contact> contacts = grains_->contacts();
  const Eigen::Matrix2d frame = grains_->box().frame();
  const double v = volume();
  if (control_.tangent == CellTangent::voigt) {
    return controlled() ? voigt_cosserat_tangent(contacts, frame, v) : voigt_tangent(contacts, frame, v);
  }
  const ContactNetwork network{contacts, driver_.grains(), frame, v, kHold, strain};
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

std::unique_ptr<CellOfGrains> make_cell_service(const CellDefinition& definition) {
  if (definition.packing.dimension == 3) return make_sphere_cell(definition);
  return std::make_unique<Cell>(definition);
}

}  // namespace polargrain::dem
