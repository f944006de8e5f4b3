// SPDX-License-Identifier: GPL-2.0-or-later
#include "dem/spheres/sphere_cell.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "common/error.hpp"
#include "common/seconds.hpp"
#include "dem/cell/averages.hpp"
#include "dem/cell/cell_answers.hpp"
#include "dem/cell/grains_in_laboratory.hpp"
#include "dem/cell/packing_check.hpp"
#include "dem/cell/quasi_static.hpp"
#include "dem/cell/resident_boxes_of.hpp"
#include "dem/engine/liggghts.hpp"
#include "dem/sphere_loop/choose_box.hpp"
#include "dem/sphere_loop/sphere_box.hpp"
#include "dem/spheres/increment_slip.hpp"
#include "dem/spheres/rotation.hpp"
#include "dem/spheres/space_contact.hpp"
#include "dem/spheres/space_tangents.hpp"
#include "dem/spheres/sphere_engine.hpp"

namespace polargrain::dem {

namespace {

/// A network is looked at more closely when its frequencies may have risen so much since the packing was at rest. Its
/// time step has room for a quarter (kStepShare).
constexpr double kStiffer = 1.2;

/// Spring that holds each grain in the tangent of an increment, over the mean normal stiffness. Networks whose contacts
/// slide have motions with next to no stiffness, or a negative one; with kHold these can make the tangent several times
/// too large. In the cell the damping against the affine flow holds the grains: its rate times the mean mass over the time
/// of an increment is about this much. Chosen by differences of cells (bench/sphere_tangent_bench.cpp).
constexpr double kHoldOnTheWay = 3e-3;

/// @throws RunError when the places of its grains cannot be those of a packing
const CellDefinition& sound(const CellDefinition& definition) {
  if (const std::string fault = geometry_fault(definition.packing); !fault.empty()) throw RunError(fault);
  return definition;
}

class SphereCell final : public CellOfGrains {
 public:
  explicit SphereCell(const CellDefinition& definition);
  CellReply initial() override { return initial_; }
  CellReply evaluate(const CellRequest& request) override;
  std::unique_ptr<ResidentBoxes> residents() override;
  [[nodiscard]] std::span<const Contact> contacts() const override { return grains_->contacts(); }
  [[nodiscard]] GrainView view() override;

 private:
  struct ResidentKind;
  CellReply follow(const StatePointer& start, const CellIncrement& increment);
  /// The same with the time step as it is; nothing, when the contacts have stiffened beyond it and it was shortened.
  std::optional<CellReply> attempt(const StatePointer& start, const CellIncrement& increment);
  /// Ends the process when the packing does not fit its script. @param pressure that it carries, Pa
  void check(const Packing& packing, double pressure, const std::string& script_file);
  [[nodiscard]] bool controlled() const { return protocol_.controlled(); }
  /// Neighbours and forces at the positions as they are; no step.
  void set_up();
  void run();
  /// Weights of the grains in the mean rotation from the recorded contacts; none when no grain could be turned.
  [[nodiscard]] std::vector<double> weights() const { return weights(*grains_); }
  [[nodiscard]] std::vector<double> weights(const SpaceGrainBox& grains) const {
    return rotation_weights(grains.contacts(), engine_.grains(), space_normal_force);
  }
  [[nodiscard]] const SpaceBox& box() const { return grains_->box(); }
  [[nodiscard]] Equilibrium equilibrium(const SpaceGrainBox& grains) const;
  [[nodiscard]] CellDiagnostics measure(const SpaceGrainBox& grains) const;
  /// Stress and, with controlled rotations, couple stress of the recorded contacts, in the laboratory.
  [[nodiscard]] CellResponse respond(const SpaceGrainBox& grains, const Matrix18& tangent) const;
  [[nodiscard]] bool wants_slips() const { return control_.tangent == CellTangent::condensed; }
  /// Of the recorded contacts since the set-up of the increment; none where no tangent asks for them.
  [[nodiscard]] std::vector<SpaceSlip> slips(const CellIncrement& increment) const;
  /// Tangent of the recorded contacts, in the laboratory. @param slips over the increment it is the derivative by
  [[nodiscard]] Matrix18 tangent(std::span<const SpaceSlip> slips = {});

  CellControl control_;
  QuasiStatic protocol_;
  double grain_volume_ = 0.0;  // m^3
  SphereEngine engine_;
  Inertia inertia_;
  std::unique_ptr<SpaceGrainBox> grains_;
  double time_step_ = 0.0;        // s, for the packing at rest
  double frequency_bound_ = 0.0;  // rad/s, of the packing at rest
  IncrementSlip increment_slip_;
  CondensedSpaceTangent condensed_tangent_;
  CellReply initial_;
};

SphereCell::SphereCell(const CellDefinition& definition)
    : control_(definition.control),
      protocol_(definition.control),
      grain_volume_(definition.packing.grain_volume()),
      engine_(sound(definition)) {
  engine_.progress = [this] {
    if (progress) progress();
  };
  if (controlled() && is_bent(control_)) check_rolling_model(engine_.lammps());
  engine_.set_up();
  const std::string remark = engine_.settle_time_step(control_.damping);
  inertia_ = inertia_of(engine_.lammps());
  time_step_ = engine_.strain().time_step();
  grains_ = choose_box(engine_, control_.loop);
  grains_->progress = [this] {
    if (progress) progress();
  };
  frequency_bound_ = frequency_bound(grains_->contacts(), inertia_);
  initial_.response = respond(*grains_, tangent());
  initial_.response.message =
      remarks_at_rest(remark, control_, "the loop over spheres", sphere_combination(engine_.lammps()),
                      name_of(best_instruction_set()));
  initial_.diagnostics = measure(*grains_);
  const double pressure = -initial_.response.stress.trace() / 3.0;
  check(definition.packing, pressure, definition.script_file);
  const double density = engine_.grains() * engine_.mean_mass() / grain_volume_;
  protocol_.take_scales({engine_.mean_mass(), engine_.mean_radius(), density}, grains_->contacts(), pressure);
  initial_.state = grains_->save();
}

void SphereCell::check(const Packing& packing, double pressure, const std::string& script_file) {
  PackingAtRest found{pressure,
                      packing.pressure,
                      0.0,
                      equilibrium(*grains_),
                      overlaps_of(grains_->contacts(), inertia_.radii),
                      !controlled() || !weights().empty(),
                      true};
  if (pressure > 0.0)
    found.stiffness_level =
        mean_normal_stiffness(grains_->contacts()) / (pressure * 2.0 * engine_.mean_radius());
  const double unrest = std::max(control_.unbalanced_force_ratio, control_.unbalanced_moment_ratio);
  if (const std::string fault = packing_fault(found, unrest, script_file); !fault.empty())
    engine_.lammps().error->all(FLERR, fault.c_str());
}

CellReply SphereCell::evaluate(const CellRequest& request) {
  const auto start = Clock::now();
  CellReply reply = follow(request.state, request.increment);
  reply.diagnostics.engine_seconds = seconds_since(start);
  return reply;
}

CellReply SphereCell::follow(const StatePointer& start, const CellIncrement& increment) {
  const Eigen::Matrix3d& gradient = increment.displacement_gradient;
  double size = gradient.cwiseAbs().maxCoeff();
  Eigen::Vector3d turn = Eigen::Vector3d::Zero();
  if (size < kLargestIncrement + kLargestTurn) {  // beyond that there may be no turn
    const Eigen::Matrix3d whole = Eigen::Matrix3d::Identity() + gradient;
    if (whole.determinant() > 0.1) {
      const Eigen::Matrix3d rotation = rotation_of(whole);
      turn = rotation_vector(rotation);
      size = (rotation.transpose() * whole - Eigen::Matrix3d::Identity()).cwiseAbs().maxCoeff();
    }
  }
  if (controlled())
    size = std::max({size, (increment.rotation - turn).cwiseAbs().maxCoeff(),
                     increment.curvature.norm() * 2.0 * engine_.mean_radius()});
  if (const std::optional<CellReply> astray = gone_astray(size, turn.norm())) return *astray;
  // Not the step of the increment before: an answer depends on what is asked alone.
  set_time_step(engine_.lammps(), time_step_);
  std::optional<CellReply> reply;
  while (!(reply = attempt(start, increment))) {
  }
  return *std::move(reply);
}

std::optional<CellReply> SphereCell::attempt(const StatePointer& start, const CellIncrement& increment) {
  grains_->restore(start ? *start : *initial_.state);
  const double time_step = engine_.strain().time_step();
  const SpaceLead lead = lead_along(protocol_, box(), increment, time_step);
  grains_->begin(lead.path, protocol_.damping_rate(), lead.rotation, time_step);
  set_up();
  if (wants_slips())
    increment_slip_.start(grains_->contacts(), grains_->places().data(), grains_->rotations(), box(),
                          engine_.grains());
  const bool stiffer = frequency_bound(grains_->contacts(), inertia_) > kStiffer * frequency_bound_;
  if (stiffer && engine_.shorten_time_step(grains_->contacts(), inertia_, protocol_.damping_rate()))
    return {};

  while (!protocol_.loaded()) run();
  // Taken while the box still moves: see the cell of discs.
  const Matrix18 loading_tangent = tangent(slips(increment));
  Equilibrium rest = equilibrium(*grains_);
  while (!protocol_.ended(rest.unbalanced_force_ratio, rest.unbalanced_moment_ratio)) {
    run();
    rest = equilibrium(*grains_);
  }
  CellReply reply;
  reply.diagnostics = measure(*grains_);
  reply.response = respond(*grains_, loading_tangent);
  judge(reply.response, reply.diagnostics, protocol_, control_, rest, grains_->contacts(), inertia_,
        engine_.strain().time_step(), kMostVoidRatioInSpace);
  if (reply.response.quality == Quality::unreliable &&
      engine_.shorten_time_step(grains_->contacts(), inertia_, protocol_.damping_rate()))
    return {};
  reply.diagnostics.dem_steps = protocol_.done();
  reply.state = grains_->save();
  return reply;
}

GrainView SphereCell::view() {
  std::vector<GrainView::Grain> grains(inertia_.radii.size());
  const LAMMPS_NS::Atom& atom = *engine_.lammps().atom;
  const std::span<const double> rotations = grains_->rotations();
  for (std::size_t k = 0; k < grains.size(); ++k) {
    GrainView::Grain& grain = grains[k];
    grain.id = atom.tag[k] - 1;
    grain.radius = inertia_.radii[k];
    const SpaceMotionOfGrain motion = grains_->motion(static_cast<int>(k));
    grain.position = motion.place;
    grain.velocity = motion.velocity;
    grain.spin = motion.spin;
    if (!rotations.empty()) grain.rotation = Eigen::Map<const Eigen::Vector3d>(&rotations[3 * k]);
  }
  GrainView view =
      grains_in_laboratory(std::move(grains), grains_->contacts(), box().reduced().base, box().frame);
  view.dimension = 3;
  return view;
}

struct SphereCell::ResidentKind {
  using Box = SphereBox;
  SphereCell& cell;
  Spheres spheres;
  const SphereKernels& kernels;

  [[nodiscard]] std::unique_ptr<Box> make() const {
    auto box = std::make_unique<Box>(spheres, kernels);
    box->progress = cell.grains_->progress;
    box->set_time_step(cell.time_step_);
    return box;
  }
  void alive() const {
    if (cell.progress) cell.progress();
  }
  void hold(Box& box) const {
    if (cell.controlled()) box.set_rotation_weights(cell.weights(box));
  }
  void put(Box& box, const ResidentStart& start) const {
    box.restore_moving(start.state ? *start.state : *cell.initial_.state, start.motion.gradient,
                       start.motion.spin);
    // The torques that hold the mean rotation belong to the forces of the start: prescribed, it has the spin behind it.
    if (cell.controlled())
      box.go_on(SpacePath(box.box(), Eigen::Matrix3d::Zero(), 1, Pace::even), cell.protocol_.damping_rate(),
                SpaceRotation{});
    box.set_up();
    hold(box);
    box.hold_rotation();
    // Contacts that have stiffened since the packing was at rest ask for a shorter time step.
    const double stiffer =
        frequency_bound(box.contacts(), cell.inertia_) / (kStiffer * cell.frequency_bound_);
    box.set_time_step(cell.time_step_ / std::max(1.0, stiffer));
  }
  void go_on(Box& box, int steps, const CellIncrement& increment) const {
    std::optional<SpaceRotation> rotation;
    if (cell.controlled()) rotation = SpaceRotation{increment.rotation, increment.curvature};
    box.go_on(SpacePath(box.box(), increment.displacement_gradient, steps, Pace::even),
              cell.protocol_.damping_rate(), rotation);
    box.run(steps);
    hold(box);
  }
  [[nodiscard]] ResidentAnswer answer(const Box& box) const {
    const CellResponse response = cell.respond(box, Matrix18::Zero());
    return {response.stress, response.couple_stress,
            quick_force_ratio(box.imbalance(), box.contacts(), cell.protocol_.least_force()),
            2.0 * static_cast<double>(box.contacts().size()) / cell.engine_.grains(), cell.time_step_};
  }
  [[nodiscard]] ResidentReadOut read(Box& box) const {
    ResidentReadOut all;
    all.reply.response = cell.respond(box, Matrix18::Zero());
    all.reply.diagnostics = cell.measure(box);
    all.motion.gradient = box.motion().gradient();
    all.motion.spin = box.motion().spin();
    all.reply.state = box.save_moving();
    return all;
  }
};

std::unique_ptr<ResidentBoxes> SphereCell::residents() {
  LAMMPS_NS::LAMMPS& lammps = engine_.lammps();
  const DiscSelection selection = sphere_combination(lammps);
  if (!selection.combination) throw RunError(no_residents(selection));
  return std::make_unique<ResidentBoxesOf<ResidentKind>>(
      ResidentKind{*this, spheres_of(lammps, *selection.combination),
                   sphere_kernels(best_instruction_set(), control_.loop == CellLoop::plain)});
}

void SphereCell::set_up() {
  grains_->set_up();
  if (!controlled()) return;
  // As with discs: weights of these contacts, and torques that hold the mean rotation with the first forces.
  grains_->set_rotation_weights(weights());
  grains_->hold_rotation();
}

void SphereCell::run() {
  const int steps = protocol_.steps_to_next_look();
  grains_->run(steps);
  protocol_.advance(steps);
  if (controlled()) grains_->set_rotation_weights(weights());
}

Equilibrium SphereCell::equilibrium(const SpaceGrainBox& grains) const {
  return equilibrium_of(grains.contacts(), grains.imbalance(), engine_.mean_radius(), protocol_.least_force(),
                        grains.box().volume(), grain_volume_);
}

CellDiagnostics SphereCell::measure(const SpaceGrainBox& grains) const {
  const std::span<const Contact> contacts = grains.contacts();
  CellDiagnostics diagnostics =
      diagnostics_of(equilibrium(grains), contacts, inertia_.radii, slides_in_space);
  const Eigen::Matrix3d fabric = grains.box().frame * space_fabric(contacts) * grains.box().frame.transpose();
  diagnostics.fabric = {fabric(0, 0), fabric(1, 1), fabric(0, 1)};
  diagnostics.multiplier = grains.multiplier().z();

  const std::span<const double> rotations = grains.rotations();
  if (rotations.empty()) return diagnostics;
  const auto number = static_cast<Eigen::Index>(rotations.size() / 3);
  const Eigen::Map<const Eigen::Matrix3Xd> turned(rotations.data(), 3, number);
  diagnostics.mean_rotation = turned.row(2).mean();
  diagnostics.rotation_spread =
      std::sqrt((turned.row(2).array() - diagnostics.mean_rotation).square().mean());
  return diagnostics;
}

CellResponse SphereCell::respond(const SpaceGrainBox& grains, const Matrix18& tangent) const {
  CellResponse response;
  response.known = KnownComponents::all;
  const Eigen::Matrix3d& frame = grains.box().frame;
  response.stress = frame * space_stress(grains.contacts(), grains.box().volume()) * frame.transpose();
  if (controlled())
    response.couple_stress =
        frame * space_couple_stress(grains.contacts(), grains.box().volume()) * frame.transpose();
  response.tangent = tangent;
  return response;
}

std::vector<SpaceSlip> SphereCell::slips(const CellIncrement& increment) const {
  if (!wants_slips()) return {};
  Eigen::Matrix3d curvature = Eigen::Matrix3d::Zero();
  if (controlled()) curvature = increment.curvature;
  return increment_slip_.until(grains_->contacts(), grains_->rotations(), box(), curvature);
}

Matrix18 SphereCell::tangent(std::span<const SpaceSlip> slips) {
  if (control_.tangent == CellTangent::none) return Matrix18::Zero();
  const double hold = slips.empty() ? kHold : kHoldOnTheWay;
  const SpaceNetwork network{grains_->contacts(), engine_.grains(), box().frame, box().volume(), hold, slips};
  if (control_.tangent == CellTangent::voigt)
    return controlled() ? voigt_cosserat_space_tangent(network) : voigt_space_tangent(network);
  if (control_.tangent == CellTangent::condensed && !controlled())
    return condensed_tangent_.classical(network).value_or(voigt_space_tangent(network));
  std::optional<Matrix18> condensed;
  // Grains that have no neighbours but one each have no mean rotation that could be held.
  if (const std::vector<double> held = weights(); !held.empty())
    condensed = condensed_tangent_.cosserat(network, held);
  return condensed.value_or(voigt_cosserat_space_tangent(network));
}

}  // namespace

std::unique_ptr<CellOfGrains> make_sphere_cell(const CellDefinition& definition) {
  return std::make_unique<SphereCell>(definition);
}

}  // namespace polargrain::dem
