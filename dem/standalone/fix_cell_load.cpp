// SPDX-License-Identifier: GPL-2.0-or-later
#include "dem/standalone/fix_cell_load.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <numbers>
#include <vector>

#include "common/plane_in_space.hpp"
#include "common/record_values.hpp"
#include "dem/cell/averages.hpp"
#include "dem/cell/quasi_static.hpp"
#include "dem/cell/script_time_step.hpp"
#include "dem/contact/contact_recorder.hpp"
#include "dem/engine/extension.hpp"
#include "dem/standalone/cell_load_words.hpp"
#include "dem/standalone/fix_space_load.hpp"

namespace polargrain::dem {

using LAMMPS_NS::Fix;
using LAMMPS_NS::LAMMPS;
namespace FixConst = LAMMPS_NS::FixConst;

FixCellLoad::FixCellLoad(LAMMPS* lammps, int count, char** words)
    : FixCellStrain(lammps, 3, words), recorder_(contact_recorder(*lammps)), protocol_(CellControl{}) {
  scalar_flag = vector_flag = 1;
  size_vector = static_cast<int>(answer_.size());
  global_freq = 1;
  extscalar = extvector = 0;
  atom->sortfreq = 0;  // the order of the grains is part of a state
  const CellLoadWords read = read_cell_load_words(*lammps, count, words);
  if (read.frame)
    error->all(FLERR, "Illegal fix cell/load command: frame is for spheres in space; discs are turned");
  mean_ = read.mean_grain;
  turned_ = read.turned;
  packing_state_ = read.packing_state;
  protocol_ = QuasiStatic(read.control);
}

int FixCellLoad::setmask() {
  return FixCellStrain::setmask() | FixConst::PRE_FORCE;
}

void FixCellLoad::post_create() {
  if (!force->pair || !force->pair_match("gran", 1))
    error->all(FLERR, "Fix cell/load needs the contact models before it: pair_style gran");
  if (mean_.mass == 0.0)
    mean_ = mean_grain_of(
        *atom, [](double radius) { return std::numbers::pi * radius * radius; },
        domain->boxhi[2] - domain->boxlo[2]);
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
  if (!packing_state_.empty()) go_on_from(read_state_file(packing_state_, *error));
  update->integrate->setup_minimal(1);
  update->whichflag = 0;

  take_packing(*lmp, protocol_, mean_, recorder_.contacts, -0.5 * (answer_[0] + answer_[1]), time_step);
}

RestoredState FixCellLoad::go_on_from(StatePointer state) try {
  RestoredState restored = restore_state(*lmp, *state);
  begin(BoxPath(restored.box, Eigen::Matrix2d::Zero(), 0), protocol_.damping_rate());
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
    go_on_from(read_state_file(words[1], *error));
    return 2;
  }
  if (word == "report" && count > 1) {
    report(words[1]);
    return 2;
  }
  if (word == "increment" && (count == 8 || count == 22)) {
    begin_increment(read_increment(count - 1, words + 1));
    return count;
  }
  error->all(
      FLERR,
      "Illegal fix_modify command: fix cell/load takes state FILE, report WORD or increment with seven "
      "numbers (h11 h12 h21 h22 w k1 k2) or with 21 (h11 h12 h13 h21 ... h33 w1 w2 w3 k11 ... k33)");
  return 0;
}

Increment<2> FixCellLoad::read_increment(int count, char** words) const {
  RecordValues values;
  for (int k = 0; k < count; ++k) values.numbers.push_back(force->numeric(FLERR, words[k]));
  RecordReader reader(values, "an increment", false);
  if (count == 7) return reader.read<Increment<2>>();
  const auto increment = reader.read<CellIncrement>();
  if (const std::string fault = out_of_plane_fault(increment); !fault.empty())
    error->all(FLERR, ("Fix cell/load: " + fault).c_str());
  return in_plane(increment);
}

void FixCellLoad::begin_increment(const Increment<2>& increment) try {
  // A cell is saved and restored between two increments: that folds the box and orders the grains. Without
  // steps in between the engine's lists know nothing of the contacts yet.
  const RestoredState restored =
      go_on_from(restored_ ? restored_ : save_state(*lmp, box().reduced(), rotations()));
  begin(protocol_.begin(restored.box, increment, update->dt), protocol_.damping_rate(),
        protocol_.rotation_of(increment));
  set_rotations(restored.rotations);
} catch (const std::exception& fault) {
  error->all(FLERR, fault.what());
}

void FixCellLoad::start_recording() {
  recorder_.contacts.clear();
  recorder_.on = true;
}

void FixCellLoad::setup_pre_force(int) {
  start_recording();
}

void FixCellLoad::setup(int vflag) {
  restored_.reset();
  recorder_.on = false;
  // Before the first forces of an increment the weights come from the contacts at its start.
  if (protocol_.controlled() && protocol_.done() == 0 && protocol_.loading() > 0) renew_weights();
  FixCellStrain::setup(vflag);
  look();
}

void FixCellLoad::pre_force(int) {
  protocol_.advance(1);
  if (protocol_.looks_now() || update->ntimestep == lmp->output->next) start_recording();
}

void FixCellLoad::post_force(int vflag) {
  FixCellStrain::post_force(vflag);
  if (!recorder_.on) return;
  recorder_.on = false;
  look();
  if (protocol_.controlled() && protocol_.looks_now()) renew_weights();
}

void FixCellLoad::renew_weights() {
  const std::vector<double> weights = rotation_weights(recorder_.contacts, grains());
  if (!weights.empty()) set_rotation_weights(weights);
}

void FixCellLoad::look() {
  const std::vector<Contact>& contacts = recorder_.contacts;
  const Response<2> now = protocol_.read_out(contacts, box(), domain->boxhi[2] - domain->boxlo[2]);
  const Unbalanced ratios = unbalanced(imbalance(), contacts, mean_.radius, protocol_.least_force());
  std::ranges::copy(now.stress, answer_.begin());
  answer_[7] = ratios.force_ratio;
  answer_[8] = ratios.moment_ratio;
  answer_[9] = protocol_.ended(ratios.force_ratio, ratios.moment_ratio) ? 1.0 : 0.0;
  answer_[10] = static_cast<double>(contacts.size());
}

void FixCellLoad::report(const char* name) const {
  const std::string line = fmt::format(
      "cell: increment {} stress {:.17g} {:.17g} {:.17g} {:.17g} {:.17g} couple_stress {:.17g} "
      "{:.17g} unbalanced {:.3e} {:.3e} steps {}\n",
      name, answer_[0], answer_[1], answer_[2], answer_[3], answer_[4], answer_[5], answer_[6], answer_[7],
      answer_[8], protocol_.done());
  for (FILE* stream : {screen, logfile})
    if (stream) std::fputs(line.c_str(), stream);
}

double FixCellLoad::compute_scalar() {
  return protocol_.loading();
}

double FixCellLoad::compute_vector(int place) {
  return answer_.at(static_cast<std::size_t>(place));
}

namespace {
/// One name for both; the dimension of the script decides.
LAMMPS_NS::Fix* make_cell_load(LAMMPS* lammps, int count, char** words) {
  if (lammps->domain->dimension == 3) return new FixSpaceLoad(lammps, count, words);
  return new FixCellLoad(lammps, count, words);
}
const Extension kCellLoad([](LAMMPS& engine) { fix_table(*engine.modify)["cell/load"] = &make_cell_load; });
}  // namespace

}  // namespace polargrain::dem
