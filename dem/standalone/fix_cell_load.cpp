// SPDX-License-Identifier: GPL-2.0-or-later
#include "dem/standalone/fix_cell_load.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <cstring>
#include <fstream>
#include <iterator>
#include <numbers>
#include <vector>

#include "dem/cell/averages.hpp"
#include "dem/cell/quasi_static.hpp"
#include "dem/cell/script_time_step.hpp"
#include "dem/cell/stock_rolling.hpp"
#include "dem/contact/contact_recorder.hpp"
#include "dem/engine/private_access.hpp"

namespace polargrain::dem {

using LAMMPS_NS::Fix;
using LAMMPS_NS::LAMMPS;
namespace FixConst = LAMMPS_NS::FixConst;

namespace {

StatePointer read_state(const std::string& file, LAMMPS_NS::Error& error) {
  std::ifstream in(file, std::ios::binary);
  if (!in)
    error.all(FLERR, fmt::format("Fix cell/load: there is no file {} to take the state from", file).c_str());
  const std::vector<char> bytes{std::istreambuf_iterator<char>(in), {}};
  const auto view = std::as_bytes(std::span(bytes));
  return std::make_shared<const State>(std::vector<std::byte>(view.begin(), view.end()));
}

}  // namespace

FixCellLoad::FixCellLoad(LAMMPS* lammps, int count, char** words) : FixCellStrain(lammps, 3, words) {
  scalar_flag = vector_flag = 1;
  size_vector = static_cast<int>(answer_.size());
  global_freq = 1;
  extscalar = extvector = 0;
  atom->sortfreq = 0;  // the order of the grains is part of a state
  read(count, words);
}

void FixCellLoad::read(int count, char** words) {
  int at = 3;
  const auto number = [&] {
    if (++at >= count)
      error->all(FLERR, fmt::format("Illegal fix cell/load command: a value is missing at the end").c_str());
    return force->numeric(FLERR, words[at]);
  };
  const auto positive = [&](const char* what) {
    const double value = number();
    if (!(value > 0.0))
      error->all(FLERR, fmt::format("Illegal fix cell/load command: {} must be positive", what).c_str());
    return value;
  };
  for (; at < count; ++at) {
    const std::string word = words[at];
    if (word == "inertial_number") {
      control_.inertial_number = positive("inertial_number");
    } else if (word == "damping") {
      control_.damping = number();
      if (!(control_.damping >= 0.0 && control_.damping < 1.0))
        error->all(FLERR, "Illegal fix cell/load command: damping must be at least 0 and less than 1");
    } else if (word == "least_steps") {
      control_.least_steps = static_cast<int>(positive("least_steps"));
    } else if (word == "unbalanced") {
      control_.unbalanced_force_ratio = positive("unbalanced");
      control_.unbalanced_moment_ratio = positive("unbalanced");
    } else if (word == "most_relaxation_steps") {
      control_.most_relaxation_steps = static_cast<int>(positive("most_relaxation_steps"));
    } else if (word == "rotations" && at + 1 < count && std::strcmp(words[at + 1], "free") == 0) {
      control_.rotations = CellRotations::free;
      ++at;
    } else if (word == "rotations" && at + 1 < count && std::strcmp(words[at + 1], "controlled") == 0) {
      control_.rotations = CellRotations::controlled;
      ++at;
    } else if (word == "mean_grain") {
      mean_mass_ = positive("mean_grain");
      mean_radius_ = positive("mean_grain");
      density_ = positive("mean_grain");
    } else if (word == "turned") {
      turned_ = number();
    } else if (word == "packing_state" && at + 1 < count) {
      packing_state_ = words[++at];
    } else {
      error->all(FLERR, fmt::format("Illegal fix cell/load command: unknown or incomplete keyword '{}'; "
                                    "expected inertial_number, damping, least_steps, unbalanced, "
                                    "most_relaxation_steps, rotations free|controlled, mean_grain, turned or "
                                    "packing_state",
                                    word)
                            .c_str());
    }
  }
}

int FixCellLoad::setmask() {
  return FixCellStrain::setmask() | FixConst::PRE_FORCE;
}

void FixCellLoad::post_create() {
  if (!force->pair || !force->pair_match("gran", 1))
    error->all(FLERR, "Fix cell/load needs the contact models before it: pair_style gran");
  if (mean_mass_ == 0.0) find_mean_grain();
  Box box;
  box.length_x = domain->boxhi[0] - domain->boxlo[0];
  box.length_y = domain->boxhi[1] - domain->boxlo[1];
  box.tilt = domain->xy;
  box.rotation = turned_;
  begin(BoxPath(box, Eigen::Matrix2d::Zero(), 0), 0.0);
  update->nsteps = 0;
  update->firststep = update->laststep = update->ntimestep;
  update->whichflag = 1;  // dynamics
  const ScriptTimeStep time_step(*lmp);
  lmp->init();
  if (!packing_state_.empty()) go_on_from(read_state(packing_state_, *error));
  update->integrate->setup_minimal(1);
  update->whichflag = 0;

  const double pressure = -0.5 * (answer_[0] + answer_[1]);
  if (!(pressure > 0.0))
    error->all(FLERR,
               "Fix cell/load: the packing carries no pressure at rest: its grains do not touch, or the "
               "stiffness in the script is not the one the packing was made with");
  time_of_grain_ = 2.0 * mean_radius_ * std::sqrt(density_ / pressure);
  rate_ = 2.0 * control_.damping * std::sqrt(mean_normal_stiffness(contact_recorder().contacts) / mean_mass_);
  StockRolling(*lmp).complete(contact_recorder().contacts);
  const std::string remark =
      time_step.settle(*lmp, contact_recorder().contacts, inertia_of(*lmp), rate_, "this script");
  if (!remark.empty() && screen != nullptr) fmt::print(screen, "polargrain: {}\n", remark);
  least_force_ = kLeastForce * mean_contact_force(contact_recorder().contacts);
}

void FixCellLoad::find_mean_grain() {
  double mass = 0.0;
  double area = 0.0;
  const int count = grains();
  for (int k = 0; k < count; ++k) {
    mean_radius_ += atom->radius[k] / count;
    mass += atom->rmass[k];
    area += std::numbers::pi * atom->radius[k] * atom->radius[k];
  }
  mean_mass_ = mass / count;
  density_ = mass / (area * (domain->boxhi[2] - domain->boxlo[2]));
}

RestoredState FixCellLoad::go_on_from(StatePointer state) try {
  RestoredState restored = restore_state(*lmp, *state);
  begin(BoxPath(restored.box, Eigen::Matrix2d::Zero(), 0), rate_);
  set_rotations(restored.rotations);
  restored_ = std::move(state);
  return restored;
} catch (const std::exception& fault) {
  error->all(FLERR, fault.what());
  return {};
}

int FixCellLoad::modify_param(int count, char** words) {
  const std::string word = words[0];
  if (word == "state" && count > 1) {
    go_on_from(read_state(words[1], *error));
    return 2;
  }
  if (word == "report" && count > 1) {
    report(words[1]);
    return 2;
  }
  if (word != "increment" || count < 8)
    error->all(FLERR,
               "Illegal fix_modify command: fix cell/load takes state FILE, report WORD or increment with "
               "seven numbers: h11 h12 h21 h22 w k1 k2");
  std::array<double, 7> v{};
  for (std::size_t k = 0; k < v.size(); ++k) v[k] = force->numeric(FLERR, words[k + 1]);
  Increment increment;
  increment.displacement_gradient << v[0], v[1], v[2], v[3];
  increment.micro_rotation = v[4];
  increment.curvature << v[5], v[6];
  begin_increment(increment);
  return 8;
}

void FixCellLoad::begin_increment(const Increment& increment) try {
  // A cell is saved and restored between two increments: that folds the box and orders the grains. Without
  // steps in between the engine's lists know nothing of the contacts yet.
  const RestoredState restored =
      go_on_from(restored_ ? restored_ : save_state(*lmp, box().reduced(), rotations()));
  loading_ = loading_steps(control_, increment, time_of_grain_, mean_radius_, update->dt);
  done_ = 0;
  const BoxPath path(restored.box, increment.displacement_gradient, loading_);
  if (controlled())
    begin(path, rate_, RotationLoading{increment.micro_rotation, increment.curvature});
  else
    begin(path, rate_);
  set_rotations(restored.rotations);
} catch (const std::exception& fault) {
  error->all(FLERR, fault.what());
}

void FixCellLoad::start_recording() {
  contact_recorder().contacts.clear();
  contact_recorder().on = true;
}

void FixCellLoad::setup_pre_force(int) {
  start_recording();
}

void FixCellLoad::setup(int vflag) {
  restored_.reset();
  contact_recorder().on = false;
  // Before the first forces of an increment the weights come from the contacts at its start.
  if (controlled() && done_ == 0 && loading_ > 0) renew_weights();
  FixCellStrain::setup(vflag);
  look();
}

bool FixCellLoad::ends_chunk() const {
  const int steps = done_ > loading_ ? done_ - loading_ : done_;
  return done_ == loading_ || steps % kRelaxationChunk == 0;
}

void FixCellLoad::pre_force(int) {
  ++done_;
  if (ends_chunk() || update->ntimestep == lmp->output->next) start_recording();
}

void FixCellLoad::post_force(int vflag) {
  FixCellStrain::post_force(vflag);
  if (!contact_recorder().on) return;
  contact_recorder().on = false;
  look();
  if (controlled() && ends_chunk()) renew_weights();
}

void FixCellLoad::renew_weights() {
  const std::vector<double> weights = rotation_weights(contact_recorder().contacts, grains());
  if (!weights.empty()) set_rotation_weights(weights);
}

void FixCellLoad::look() {
  const std::vector<Contact>& contacts = contact_recorder().contacts;
  const Box now = box();
  const Eigen::Matrix2d frame = now.frame();
  const double volume = now.area() * (domain->boxhi[2] - domain->boxlo[2]);
  const Eigen::Matrix2d stress = frame * average_stress(contacts, volume) * frame.transpose();
  // As in cells: with free rotations the couple stress is nobody's business.
  Eigen::Vector2d couple_stress = Eigen::Vector2d::Zero();
  if (controlled()) couple_stress = frame * average_couple_stress(contacts, volume);
  const Unbalanced ratios = unbalanced(imbalance(), contacts, mean_radius_, least_force_);
  const bool at_rest = ratios.force_ratio <= control_.unbalanced_force_ratio &&
                       ratios.moment_ratio <= control_.unbalanced_moment_ratio;
  const bool given_up = done_ - loading_ >= control_.most_relaxation_steps;
  answer_ = {stress(0, 0),
             stress(1, 1),
             0.0,
             stress(0, 1),
             stress(1, 0),
             couple_stress(0),
             couple_stress(1),
             ratios.force_ratio,
             ratios.moment_ratio,
             done_ >= loading_ && (at_rest || given_up) ? 1.0 : 0.0,
             static_cast<double>(contacts.size())};
}

void FixCellLoad::report(const char* name) const {
  const std::string line = fmt::format(
      "cell: increment {} stress {:.17g} {:.17g} {:.17g} {:.17g} {:.17g} couple_stress {:.17g} "
      "{:.17g} unbalanced {:.3e} {:.3e} steps {}\n",
      name, answer_[0], answer_[1], answer_[2], answer_[3], answer_[4], answer_[5], answer_[6], answer_[7],
      answer_[8], done_);
  for (FILE* stream : {screen, logfile})
    if (stream) std::fputs(line.c_str(), stream);
}

double FixCellLoad::compute_scalar() {
  return loading_;
}

double FixCellLoad::compute_vector(int place) {
  return answer_.at(static_cast<std::size_t>(place));
}

void register_standalone_fixes(LAMMPS_NS::Modify& modify) {
  fix_table(modify)["cell/load"] = [](LAMMPS* lammps, int count, char** words) -> Fix* {
    return new FixCellLoad(lammps, count, words);
  };
}

}  // namespace polargrain::dem
