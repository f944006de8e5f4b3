// SPDX-License-Identifier: GPL-2.0-or-later
#include "dem/standalone/fix_space_load.hpp"

#include <fmt/format.h>

#include <numbers>
#include <vector>

#include "common/record_values.hpp"
#include "dem/cell/script_time_step.hpp"
#include "dem/spheres/space_contact.hpp"
#include "dem/standalone/cell_load_words.hpp"

namespace polargrain::dem {

namespace FixConst = LAMMPS_NS::FixConst;

FixSpaceLoad::FixSpaceLoad(LAMMPS_NS::LAMMPS* lammps, int count, char** words)
    : FixSpaceStrain(lammps, 3, words), recorder_(contact_recorder(*lammps)), protocol_(CellControl{}) {
  scalar_flag = vector_flag = 1;
  size_vector = static_cast<int>(answer_.size());
  global_freq = 1;
  extscalar = extvector = 0;
  atom->sortfreq = 0;  // the order of the grains is part of a state
  const CellLoadWords read = read_cell_load_words(*lammps, count, words);
  if (read.turned != 0.0)
    error->all(FLERR, "Illegal fix cell/load command: turned is for discs; spheres have a frame");
  mean_ = read.mean_grain;
  frame_ = read.frame.value_or(frame_);
  packing_state_ = read.packing_state;
  protocol_ = QuasiStatic(read.control);
}

int FixSpaceLoad::setmask() {
  return FixSpaceStrain::setmask() | FixConst::PRE_FORCE;
}

void FixSpaceLoad::post_create() {
  if (!force->pair || !force->pair_match("gran", 1))
    error->all(FLERR, "Fix cell/load needs the contact models before it: pair_style gran");
  if (mean_.mass == 0.0)
    mean_ = mean_grain_of(
        *atom, [](double radius) { return 4.0 / 3.0 * std::numbers::pi * radius * radius * radius; }, 1.0);
  SpaceBox box = engine_box();
  box.frame = frame_;
  begin(SpacePath(box, Eigen::Matrix3d::Zero(), 0), 0.0);
  update->nsteps = 0;
  update->firststep = update->laststep = update->ntimestep;
  update->whichflag = 1;  // dynamics
  const ScriptTimeStep time_step(*lmp);
  lmp->init();
  if (!packing_state_.empty()) go_on_from(read_state_file(packing_state_, *error));
  update->integrate->setup_minimal(1);
  update->whichflag = 0;

  take_packing(*lmp, protocol_, mean_, recorder_.contacts, -stress_.trace() / 3.0, time_step);
}

void FixSpaceLoad::go_on_from(StatePointer state) try {
  const RestoredState restored = restore_state(*lmp, *state);
  begin(SpacePath(restored.space.value(), Eigen::Matrix3d::Zero(), 0), protocol_.damping_rate());
  set_rotations(restored.rotations);
  restored_ = std::move(state);
} catch (const std::exception& fault) {
  error->all(FLERR, fault.what());
}

int FixSpaceLoad::modify_param(int count, char** words) {
  const std::string word = words[0];
  if (word == "state" && count > 1) {
    go_on_from(read_state_file(words[1], *error));
    return 2;
  }
  if (word == "report" && count > 1) {
    report(words[1]);
    return 2;
  }
  if (word == "increment" && count == 22) {
    RecordValues values;
    for (int k = 1; k < count; ++k) values.numbers.push_back(force->numeric(FLERR, words[k]));
    RecordReader reader(values, "an increment", false);
    begin_increment(reader.read<CellIncrement>());
    return count;
  }
  error->all(
      FLERR,
      "Illegal fix_modify command: fix cell/load takes state FILE, report WORD or, of spheres, increment with "
      "21 numbers (h11 h12 h13 h21 ... h33 w1 w2 w3 k11 ... k33)");
  return 0;
}

void FixSpaceLoad::begin_increment(const CellIncrement& increment) try {
  // A cell is saved and restored between two increments: that folds the grains into the box and orders them. Without
  // steps in between the engine's lists know nothing of the contacts yet.
  if (restored_) {
    go_on_from(restored_);
  } else {
    fold();
    go_on_from(save_state(*lmp, box(), rotations()));
  }
  lead(protocol_, increment);
} catch (const std::exception& fault) {
  error->all(FLERR, fault.what());
}

void FixSpaceLoad::start_recording() {
  recorder_.contacts.clear();
  recorder_.on = true;
}

void FixSpaceLoad::setup_pre_force(int) {
  start_recording();
}

void FixSpaceLoad::setup(int vflag) {
  restored_.reset();
  recorder_.on = false;
  // Before the first forces of an increment the weights come from the contacts at its start.
  if (protocol_.controlled() && protocol_.done() == 0 && protocol_.loading() > 0) renew_weights();
  FixSpaceStrain::setup(vflag);
  look();
}

void FixSpaceLoad::pre_force(int) {
  protocol_.advance(1);
  if (protocol_.looks_now() || update->ntimestep == lmp->output->next) start_recording();
}

void FixSpaceLoad::post_force(int vflag) {
  FixSpaceStrain::post_force(vflag);
  if (!recorder_.on) return;
  recorder_.on = false;
  look();
  if (protocol_.controlled() && protocol_.looks_now()) renew_weights();
}

void FixSpaceLoad::renew_weights() {
  set_rotation_weights(rotation_weights(recorder_.contacts, grains(), space_normal_force));
}

void FixSpaceLoad::look() {
  const std::vector<Contact>& contacts = recorder_.contacts;
  const Eigen::Matrix3d& frame = box().frame;
  stress_ = frame * space_stress(contacts, box().volume()) * frame.transpose();
  if (protocol_.controlled())
    couple_stress_ = frame * space_couple_stress(contacts, box().volume()) * frame.transpose();
  const Unbalanced ratios = unbalanced(imbalance(), contacts, mean_.radius, protocol_.least_force());
  const Eigen::Matrix3d& s = stress_;
  const Eigen::Matrix3d& m = couple_stress_;
  answer_ = {s(0, 0),
             s(1, 1),
             s(2, 2),
             s(0, 1),
             s(1, 0),
             m(0, 2),
             m(1, 2),
             ratios.force_ratio,
             ratios.moment_ratio,
             protocol_.ended(ratios.force_ratio, ratios.moment_ratio) ? 1.0 : 0.0,
             static_cast<double>(contacts.size()),
             s(0, 2),
             s(2, 0),
             s(1, 2),
             s(2, 1),
             m(0, 0),
             m(1, 1),
             m(2, 2),
             m(0, 1),
             m(1, 0),
             m(2, 0),
             m(2, 1)};
}

void FixSpaceLoad::report(const char* name) const {
  // Row by row.
  using Rows = Eigen::Matrix<double, 3, 3, Eigen::RowMajor>;
  const Rows s = stress_;
  const Rows m = couple_stress_;
  const std::string line = fmt::format(
      "cell: increment {} stress {:.17g} couple_stress {:.17g} unbalanced {:.3e} {:.3e} steps {}\n", name,
      fmt::join(s.data(), s.data() + 9, " "), fmt::join(m.data(), m.data() + 9, " "), answer_[7], answer_[8],
      protocol_.done());
  for (FILE* stream : {screen, logfile})
    if (stream) std::fputs(line.c_str(), stream);
}

}  // namespace polargrain::dem
