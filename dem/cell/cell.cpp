// SPDX-License-Identifier: GPL-2.0-or-later
#include <algorithm>
#include <cmath>

#include "common/elementary_functions.hpp"
#include "common/error.hpp"
#include "common/plane_in_space.hpp"
#include "common/seconds.hpp"
#include "dem/box/rotation.hpp"
#include "dem/cell/averages.hpp"
#include "dem/cell/cell_answers.hpp"
#include "dem/cell/cell_service.hpp"
#include "dem/cell/cell_tangents.hpp"
#include "dem/cell/engine_box.hpp"
#include "dem/cell/fast_loop.hpp"
#include "dem/cell/grains_in_laboratory.hpp"
#include "dem/cell/packing_check.hpp"
#include "dem/cell/resident_boxes_of.hpp"
#include "dem/engine/liggghts.hpp"

namespace polargrain::dem {

namespace {

/// A network is looked at more closely when its frequencies may have risen so much since the packing was at rest. Its
/// time step has room for a quarter (kStepShare).
constexpr double kStiffer = 1.2;

/// The part of an increment that grains of this dimension can follow.
/// @throws RunError when discs cannot follow all of it
template <int dim>
Increment<dim> increment_of(const CellIncrement& increment) {
  if constexpr (dim == 2) {
    if (const std::string fault = out_of_plane_fault(increment); !fault.empty()) throw RunError(fault);
    return in_plane(increment);
  } else {
    return {increment};
  }
}

/// How much an increment strains and turns a cell.
template <int dim>
struct Extent {
  typename Cosserat<dim>::Rotation turn = Cosserat<dim>::Rotation::Zero();  ///< of R in I + h = R U, rad
  double strain = 0.0;                                                      ///< largest component of U - I
};

Extent<2> extent_of(const Eigen::Matrix2d& gradient) {
  const Eigen::Matrix2d one = Eigen::Matrix2d::Identity();
  const double turn = arc_tangent(gradient(1, 0) - gradient(0, 1), 2.0 + gradient.trace());
  return {Cosserat<2>::Rotation(turn), (rotation_by(-turn) * (one + gradient) - one).cwiseAbs().maxCoeff()};
}

Extent<3> extent_of(const Eigen::Matrix3d& gradient) {
  const Eigen::Matrix3d whole = Eigen::Matrix3d::Identity() + gradient;
  const double size = gradient.cwiseAbs().maxCoeff();
  // Beyond that there may be no turn.
  if (!(size < kLargestIncrement + kLargestTurn) || !(whole.determinant() > 0.1))
    return {Eigen::Vector3d::Zero(), size};
  const Eigen::Matrix3d rotation = rotation_of(whole);
  return {rotation_vector(rotation),
          (rotation.transpose() * whole - Eigen::Matrix3d::Identity()).cwiseAbs().maxCoeff()};
}

/// An engine with a packing of discs or of spheres, which stands in for the cells of one definition.
template <int dim>
class Cell final : public CellOfGrains {
 public:
  explicit Cell(const CellDefinition& definition);
  CellReply initial() override { return initial_; }
  CellReply evaluate(const CellRequest& request) override;
  std::unique_ptr<ResidentBoxes> residents() override;
  [[nodiscard]] std::span<const Contact> contacts() const override { return grains_->contacts(); }
  [[nodiscard]] GrainView view() override;

 private:
  struct ResidentKind;
  using Tangent = typename Cosserat<dim>::Matrix;
  using Loop = FastLoop<dim>;

  CellReply follow(const StatePointer& start, const Increment<dim>& increment);
  /// The same with the time step as it is; nothing, when contacts of spheres have stiffened beyond it and it was shortened.
  std::optional<CellReply> attempt(const StatePointer& start, const Increment<dim>& increment);
  [[nodiscard]] bool controlled() const { return protocol_.controlled(); }
  /// Ends the process when the packing does not fit its script. @param pressure that it carries, Pa
  void check(const Packing& packing, double pressure, const std::string& script_file);
  /// Neighbours and forces at the positions as they are; no step.
  void set_up();
  /// DEM steps to the next look; the contacts of the last force pass are recorded.
  void run();
  /// Weights of the grains in the mean rotation, from the recorded contacts (mode 2). Where nothing carries, they stay.
  void renew_weights(GrainBox<dim>& grains) const;
  [[nodiscard]] double volume(const GrainBox<dim>& grains) const {
    return grains.box().size() * driver_.depth();
  }
  [[nodiscard]] Equilibrium equilibrium(const GrainBox<dim>& grains) const;
  [[nodiscard]] CellDiagnostics measure(const GrainBox<dim>& grains) const;
  /// Stress and, with controlled rotations, couple stress of the recorded contacts, in the laboratory.
  [[nodiscard]] CellResponse respond(const GrainBox<dim>& grains, const Tangent& tangent) const;
  /// Tangent of the recorded contacts, in the laboratory. @param way null: at rest
  [[nodiscard]] Tangent tangent(const typename CellTangents<dim>::Way* way = nullptr);

  CellControl control_;
  QuasiStatic protocol_;
  Driver<dim> driver_;
  Inertia inertia_;                // of the grains, as contacts count them
  std::vector<std::int64_t> ids_;  // of the packing's grains, which the engine counts from 1
  std::unique_ptr<GrainBox<dim>> grains_;
  double time_step_ = 0.0;        // s, for the packing at rest
  double frequency_bound_ = 0.0;  // rad/s, of the packing at rest
  CellTangents<dim> tangents_;
  CellReply initial_;
};

template <int dim>
Cell<dim>::Cell(const CellDefinition& definition)
    : control_(definition.control),
      protocol_(definition.control),
      driver_(definition),
      tangents_(definition.control, driver_.grains()) {
  const auto tell = [this] {
    if (progress) progress();
  };
  driver_.progress = tell;
  LAMMPS_NS::LAMMPS& lammps = driver_.lammps();
  if (controlled() && is_bent(control_)) check_rolling_model(lammps);
  driver_.set_up();
  const std::string remark = driver_.settle_time_step(control_.damping);
  inertia_ = inertia_of(lammps);
  for (const Grain& grain : definition.packing.grains) ids_.push_back(grain.id);
  time_step_ = driver_.strain().time_step();
  grains_ = choose_box(driver_, control_.loop);
  grains_->progress = tell;
  frequency_bound_ = frequency_bound(grains_->contacts(), inertia_);
  // The forces of the start are there; setting them up twice would fold the grains back twice, to other last bits.
  if (controlled()) renew_weights(*grains_);

  initial_.response = respond(*grains_, tangent());
  initial_.response.message =
      remarks_at_rest(remark, control_, Loop::name, Loop::selection(lammps), Loop::instructions());
  initial_.diagnostics = measure(*grains_);
  const Eigen::Matrix3d& stress = initial_.response.stress;
  const double pressure = dim == 2 ? -0.5 * (stress(0, 0) + stress(1, 1)) : -stress.trace() / 3.0;
  check(definition.packing, pressure, definition.script_file);
  const double density = driver_.grains() * driver_.mean_mass() / (driver_.grain_sizes() * driver_.depth());
  protocol_.take_scales({driver_.mean_mass(), driver_.mean_radius(), density}, grains_->contacts(), pressure);
  initial_.state = grains_->save();
}

template <int dim>
void Cell<dim>::check(const Packing& packing, double pressure, const std::string& script_file) {
  PackingAtRest found{pressure,
                      packing.pressure,
                      0.0,
                      equilibrium(*grains_),
                      overlaps_of(grains_->contacts(), inertia_.radii),
                      !controlled() || !grains_->weights().empty(),
                      dim == 3};
  const double length = dim == 2 ? packing.thickness : 2.0 * driver_.mean_radius();
  if (pressure > 0.0)
    found.stiffness_level = mean_normal_stiffness(grains_->contacts()) / (pressure * length);
  const double unrest = std::max(control_.unbalanced_force_ratio, control_.unbalanced_moment_ratio);
  if (const std::string fault = packing_fault(found, unrest, script_file); !fault.empty())
    driver_.lammps().error->all(FLERR, fault.c_str());
}

template <int dim>
CellReply Cell<dim>::evaluate(const CellRequest& request) {
  const auto start = Clock::now();
  CellReply reply = follow(request.state, increment_of<dim>(request.increment));
  reply.diagnostics.engine_seconds = seconds_since(start);
  return reply;
}

template <int dim>
CellReply Cell<dim>::follow(const StatePointer& start, const Increment<dim>& increment) {
  const Extent<dim> extent = extent_of(increment.displacement_gradient);
  const RotationLoading<dim> loading = RotationLoading<dim>::of(increment);
  double size = extent.strain;
  if (dim == 2 || controlled()) size = std::max(size, loading.curvature.norm() * 2.0 * driver_.mean_radius());
  if (controlled()) size = std::max(size, (loading.rotation - extent.turn).cwiseAbs().maxCoeff());
  if (const std::optional<CellReply> astray = gone_astray(size, extent.turn.norm())) return *astray;
  // Not the step of the increment before: an answer depends on what is asked alone.
  if (dim == 3) set_time_step(driver_.lammps(), time_step_);
  std::optional<CellReply> reply;
  while (!(reply = attempt(start, increment))) {
  }
  return *std::move(reply);
}

template <int dim>
std::optional<CellReply> Cell<dim>::attempt(const StatePointer& start, const Increment<dim>& increment) {
  grains_->restore(start ? *start : *initial_.state);
  const double time_step = driver_.strain().time_step();
  const Lead<dim> lead = protocol_.begin(grains_->box(), increment, time_step);
  grains_->begin(lead.path, protocol_.damping_rate(), lead.rotation, time_step);
  set_up();
  tangents_.start(*grains_);
  const auto shortened = [this] {
    return dim == 3 && driver_.shorten_time_step(grains_->contacts(), inertia_, protocol_.damping_rate());
  };
  if (dim == 3 && frequency_bound(grains_->contacts(), inertia_) > kStiffer * frequency_bound_ && shortened())
    return {};

  while (!protocol_.loaded()) run();
  // Taken while the box still moves: the contacts that slide now are those that slide along the increment. At
  // rest most of them have just come off their limit, and the tangent would be that of unloading.
  const typename CellTangents<dim>::Way way{increment, protocol_.size()};
  const Tangent loading_tangent = tangent(&way);
  Equilibrium rest = equilibrium(*grains_);
  while (!protocol_.ended(rest.unbalanced_force_ratio, rest.unbalanced_moment_ratio)) {
    run();
    rest = equilibrium(*grains_);
  }
  CellReply reply;
  reply.diagnostics = measure(*grains_);
  reply.response = respond(*grains_, loading_tangent);
  judge(reply.response, reply.diagnostics, protocol_, control_, rest, grains_->contacts(), inertia_,
        driver_.strain().time_step(), dim == 2 ? kMostVoidRatio : kMostVoidRatioInSpace);
  if (reply.response.quality == Quality::unreliable && shortened()) return {};
  reply.diagnostics.dem_steps = protocol_.done();
  reply.state = grains_->save();
  return reply;
}

template <int dim>
GrainView Cell<dim>::view() {
  constexpr std::size_t turns = Cosserat<dim>::rotations;
  constexpr int axis = Cosserat<dim>::axis(0);
  std::vector<GrainView::Grain> grains(inertia_.radii.size());
  const LAMMPS_NS::Atom& atom = *driver_.lammps().atom;
  const std::span<const double> rotations = grains_->rotations();
  for (std::size_t k = 0; k < grains.size(); ++k) {
    GrainView::Grain& grain = grains[k];
    grain.id = ids_[static_cast<std::size_t>(atom.tag[k] - 1)];
    grain.radius = inertia_.radii[k];
    const GrainMotion<dim> motion = grains_->motion(static_cast<int>(k));
    std::ranges::copy(motion.place, grain.position.data());
    std::ranges::copy(motion.velocity, grain.velocity.data());
    std::ranges::copy(motion.spin, grain.spin.data() + axis);
    if (!rotations.empty()) std::copy_n(&rotations[turns * k], turns, grain.rotation.data() + axis);
  }
  const Box<dim> box = grains_->box().reduced();
  Eigen::Matrix3d base = Eigen::Matrix3d::Zero();
  base(2, 2) = driver_.depth();
  base.topLeftCorner<dim, dim>() = box.base;
  GrainView view = grains_in_laboratory(std::move(grains), grains_->contacts(), base, frame_in_space(box));
  view.dimension = dim;
  return view;
}

template <int dim>
void Cell<dim>::set_up() {
  grains_->set_up();
  if (!controlled()) return;
  // The weights come from these contacts, never from an earlier evaluation; with them, the torques that hold
  // the mean rotation can be added to the first forces.
  renew_weights(*grains_);
  grains_->hold_rotation();
}

template <int dim>
struct Cell<dim>::ResidentKind {
  using Grains = typename Loop::Grains;
  Cell& cell;
  LawCombination combination;
  /// Thousands of boxes wait side by side, and a record is as large as a box.
  std::shared_ptr<BoxRecords> records = std::make_shared<BoxRecords>();

  [[nodiscard]] std::unique_ptr<Grains> make() const {
    auto box = Loop::make(cell.driver_, combination, cell.control_.loop == CellLoop::plain);
    box->progress = cell.grains_->progress;
    box->set_time_step(cell.time_step_);
    box->share(records);
    return box;
  }
  void alive() const {
    if (cell.progress) cell.progress();
  }
  void hold(Grains& box) const {
    if (cell.controlled()) cell.renew_weights(box);
  }
  void put(Grains& box, const ResidentStart& start) const {
    constexpr int axis = Cosserat<dim>::axis(0);
    box.restore_moving(start.state ? *start.state : *cell.initial_.state,
                       start.motion.gradient.template topLeftCorner<dim, dim>(),
                       start.motion.spin.template segment<Cosserat<dim>::rotations>(axis));
    // The torques that hold the mean rotation belong to the forces of the start: prescribed, it has the spin behind it.
    if (cell.controlled())
      box.go_on(BoxPath<dim>(box.box(), Box<dim>::Matrix::Zero(), 1, Pace::even),
                cell.protocol_.damping_rate(), RotationLoading<dim>{});
    box.set_up();
    hold(box);
    box.hold_rotation();
    if (dim == 2) return;
    // Contacts that have stiffened since the packing was at rest ask for a shorter time step.
    const double stiffer =
        frequency_bound(box.contacts(), cell.inertia_) / (kStiffer * cell.frequency_bound_);
    box.set_time_step(cell.time_step_ / std::max(1.0, stiffer));
  }
  void go_on(Grains& box, int steps, const CellIncrement& whole) const {
    const auto increment = increment_of<dim>(whole);
    box.go_on(BoxPath<dim>(box.box(), increment.displacement_gradient, steps, Pace::even),
              cell.protocol_.damping_rate(), cell.protocol_.rotation_of(increment));
    box.run(steps);
    hold(box);
  }
  [[nodiscard]] ResidentAnswer answer(const Grains& box) const {
    const ContactSums<dim> sums = box.contact_sums();
    const Eigen::Matrix3d frame = frame_in_space(box.box());
    const double volume = cell.volume(box);
    Eigen::Matrix3d stress = Eigen::Matrix3d::Zero();
    stress.template topLeftCorner<dim, dim>() = sums.virial / volume;
    ResidentAnswer answer;
    answer.stress = frame * stress * frame.transpose();
    if (cell.controlled())
      answer.couple_stress = frame * average_couple_stress(box.contacts(), volume) * frame.transpose();
    answer.unbalanced_force_ratio = quick_force_ratio(box.imbalance(), sums, cell.protocol_.least_force());
    answer.coordination_number = 2.0 * sums.contacts / cell.driver_.grains();
    return answer;
  }
  [[nodiscard]] double time_step() const { return cell.time_step_; }
  [[nodiscard]] ResidentReadOut read(Grains& box) const {
    ResidentReadOut all;
    all.motion.gradient.template topLeftCorner<dim, dim>() = box.motion().gradient();
    all.motion.spin.template segment<Cosserat<dim>::rotations>(Cosserat<dim>::axis(0)) = box.motion().spin();
    const StatePointer state = box.save_moving();
    put(box, {state, all.motion});
    all.reply.response = cell.respond(box, Tangent::Zero());
    all.reply.diagnostics = cell.measure(box);
    all.reply.state = state;
    return all;
  }
};

template <int dim>
std::unique_ptr<ResidentBoxes> Cell<dim>::residents() {
  const LawSelection selection = Loop::selection(driver_.lammps());
  if (!selection.combination) throw RunError(no_residents(selection));
  return std::make_unique<ResidentBoxesOf<ResidentKind>>(ResidentKind{*this, *selection.combination});
}

template <int dim>
void Cell<dim>::renew_weights(GrainBox<dim>& grains) const {
  const std::vector<double> weights = rotation_weights(grains.contacts(), driver_.grains());
  if (!weights.empty()) grains.set_rotation_weights(weights);
}

template <int dim>
void Cell<dim>::run() {
  const int steps = protocol_.steps_to_next_look();
  grains_->run(steps);
  protocol_.advance(steps);
  if (controlled()) renew_weights(*grains_);
}

template <int dim>
Equilibrium Cell<dim>::equilibrium(const GrainBox<dim>& grains) const {
  return equilibrium_of(grains.contacts(), grains.imbalance(), driver_.mean_radius(), protocol_.least_force(),
                        grains.box().size(), driver_.grain_sizes());
}

template <int dim>
CellDiagnostics Cell<dim>::measure(const GrainBox<dim>& grains) const {
  const std::span<const Contact> contacts = grains.contacts();
  CellDiagnostics diagnostics = diagnostics_of(equilibrium(grains), contacts, inertia_.radii);
  constexpr int turns = Cosserat<dim>::rotations;
  diagnostics.multiplier = grains.multiplier()(turns - 1);
  const Eigen::Matrix3d frame = frame_in_space(grains.box());
  const Eigen::Matrix3d fabric = frame * fabric_tensor(contacts) * frame.transpose();
  diagnostics.fabric = {fabric(0, 0), fabric(1, 1), fabric(0, 1)};

  const std::span<const double> rotations = grains.rotations();
  if (rotations.empty()) return diagnostics;
  // About e_3, the last of each grain. Sums keep the order that results were published with.
  const auto number = static_cast<Eigen::Index>(rotations.size() / turns);
  if constexpr (dim == 2) {
    for (const double rotation : rotations)
      diagnostics.mean_rotation += rotation / static_cast<double>(number);
    double variance = 0.0;
    for (const double rotation : rotations)
      variance += std::pow(rotation - diagnostics.mean_rotation, 2) / static_cast<double>(number);
    diagnostics.rotation_spread = std::sqrt(variance);
  } else {
    const auto about_3 = Eigen::Map<const Eigen::Matrix3Xd>(rotations.data(), 3, number).row(2).array();
    diagnostics.mean_rotation = about_3.mean();
    diagnostics.rotation_spread = std::sqrt((about_3 - diagnostics.mean_rotation).square().mean());
  }
  return diagnostics;
}

template <int dim>
CellResponse Cell<dim>::respond(const GrainBox<dim>& grains, const Tangent& tangent) const {
  CellResponse response;
  if constexpr (dim == 2) {
    Response<2> slopes;
    slopes.tangent = tangent;
    response = in_space(slopes, KnownComponents::plane);
  } else {
    response.tangent = tangent;
  }
  const QuasiStatic::ReadOut found =
      protocol_.read_out(grains.contacts(), frame_in_space(grains.box()), volume(grains));
  response.stress = found.stress;
  response.couple_stress = found.couple_stress;
  return response;
}

template <int dim>
typename Cell<dim>::Tangent Cell<dim>::tangent(const typename CellTangents<dim>::Way* way) {
  if (controlled()) return tangents_.of(*grains_, grains_->weights(), volume(*grains_), way);
  std::vector<double> weights;
  if (control_.tangent == CellTangent::cosserat)
    weights = rotation_weights(grains_->contacts(), driver_.grains());
  return tangents_.of(*grains_, weights, volume(*grains_), way);
}

}  // namespace

std::unique_ptr<CellOfGrains> make_cell_service(const CellDefinition& definition) {
  if (definition.packing.dimension == 3) return std::make_unique<Cell<3>>(definition);
  return std::make_unique<Cell<2>>(definition);
}

}  // namespace polargrain::dem
