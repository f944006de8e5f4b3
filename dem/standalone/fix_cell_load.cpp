// SPDX-License-Identifier: GPL-2.0-or-later
#include "dem/standalone/fix_cell_load.hpp"

#include <fmt/format.h>

#include <vector>

#include "common/plane_in_space.hpp"
#include "common/record_values.hpp"
#include "dem/cell/script_time_step.hpp"
#include "dem/engine/extension.hpp"
#include "dem/standalone/cell_load_words.hpp"

namespace polargrain::dem {

using LAMMPS_NS::LAMMPS;
namespace FixConst = LAMMPS_NS::FixConst;

template <int dim>
FixCellLoad<dim>::FixCellLoad(LAMMPS* lammps, int count, char** words)
    : FixCellStrain<dim>(lammps, 3, words), recorder_(contact_recorder(*lammps)), protocol_(CellControl{}) {
  this->scalar_flag = this->vector_flag = 1;
  this->size_vector = dim == 2 ? 11 : 22;
  this->global_freq = 1;
  this->extscalar = this->extvector = 0;
  atom->sortfreq = 0;  // the order of the grains is part of a state
  const CellLoadWords read = read_cell_load_words(*lammps, count, words);
  if constexpr (dim == 2) {
    if (read.frame)
      error->all(FLERR, "Illegal fix cell/load command: frame is for spheres in space; discs are turned");
    orientation_ = read.turned;
  } else {
    if (read.turned != 0.0)
      error->all(FLERR, "Illegal fix cell/load command: turned is for discs; spheres have a frame");
    orientation_ = read.frame.value_or(orientation_);
  }
  mean_ = read.mean_grain;
  packing_state_ = read.packing_state;
  protocol_ = QuasiStatic(read.control);
}

template <int dim>
int FixCellLoad<dim>::setmask() {
  return FixCellStrain<dim>::setmask() | FixConst::PRE_FORCE;
}

template <int dim>
void FixCellLoad<dim>::post_create() {
  if (!force->pair || !force->pair_match("gran", 1))
    error->all(FLERR, "Fix cell/load needs the contact models before it: pair_style gran");
  if (mean_.mass == 0.0)
    mean_ = mean_grain_of(*atom, grain_size<dim>, dim == 2 ? domain->boxhi[2] - domain->boxlo[2] : 1.0);
  Box<dim> box = this->engine_box();
  box.orientation = orientation_;
  this->begin(BoxPath<dim>(box), 0.0);
  update->nsteps = 0;
  update->firststep = update->laststep = update->ntimestep;
  update->whichflag = 1;  // dynamics
  const ScriptTimeStep time_step(*lmp);
  lmp->init();
  if (!packing_state_.empty()) go_on_from(read_state_file(packing_state_, *error));
  update->integrate->setup_minimal(1);
  update->whichflag = 0;

  take_packing(*lmp, protocol_, mean_, recorder_.contacts, pressure(), time_step);
}

template <int dim>
double FixCellLoad<dim>::pressure() const {
  return dim == 2 ? -0.5 * (found_.stress(0, 0) + found_.stress(1, 1)) : -found_.stress.trace() / 3.0;
}

template <int dim>
void FixCellLoad<dim>::go_on_from(StatePointer state) try {
  const RestoredState<dim> restored = restore_state<dim>(*lmp, *state);
  this->begin(BoxPath<dim>(restored.box), protocol_.damping_rate());
  this->set_rotations(restored.rotations);
  restored_ = std::move(state);
} catch (const std::exception& fault) {
  error->all(FLERR, fault.what());
}

template <int dim>
int FixCellLoad<dim>::modify_param(int count, char** words) {
  const std::string word = words[0];
  if (word == "state" && count > 1) {
    go_on_from(read_state_file(words[1], *error));
    return 2;
  }
  if (word == "report" && count > 1) {
    report(words[1]);
    return 2;
  }
  if (word == "increment" && ((dim == 2 && count == 8) || count == 22)) {
    begin_increment(read_increment(count - 1, words + 1));
    return count;
  }
  error->all(
      FLERR,
      "Illegal fix_modify command: fix cell/load takes state FILE, report WORD or increment with 21 numbers "
      "(h11 h12 h13 h21 ... h33 w1 w2 w3 k11 ... k33) or, of discs, with seven (h11 h12 h21 h22 w k1 k2)");
  return 0;
}

template <int dim>
Increment<dim> FixCellLoad<dim>::read_increment(int count, char** words) const {
  RecordValues values;
  for (int k = 0; k < count; ++k) values.numbers.push_back(force->numeric(FLERR, words[k]));
  RecordReader reader(values, "an increment", false);
  if constexpr (dim == 2) {
    if (count == 7) return reader.read<Increment<2>>();
    const auto increment = reader.read<CellIncrement>();
    if (const std::string fault = out_of_plane_fault(increment); !fault.empty())
      error->all(FLERR, ("Fix cell/load: " + fault).c_str());
    return in_plane(increment);
  } else {
    return {reader.read<CellIncrement>()};
  }
}

template <int dim>
void FixCellLoad<dim>::begin_increment(const Increment<dim>& increment) try {
  // A cell is saved and restored between two increments: that reduces the box, folds spheres into it, and orders the
  // grains. Without steps in between the engine's lists know nothing of the contacts yet.
  if (!restored_) {
    if (dim == 3) this->fold();
    restored_ = save_state(*lmp, dim == 2 ? this->box().reduced() : this->box(), this->rotations());
  }
  go_on_from(restored_);
  const Lead<dim> lead = protocol_.begin(this->box(), increment, update->dt);
  this->begin(lead.path, protocol_.damping_rate(), lead.rotation);
} catch (const std::exception& fault) {
  error->all(FLERR, fault.what());
}

template <int dim>
void FixCellLoad<dim>::start_recording() {
  recorder_.contacts.clear();
  recorder_.on = true;
}

template <int dim>
void FixCellLoad<dim>::setup_pre_force(int) {
  start_recording();
}

template <int dim>
void FixCellLoad<dim>::setup(int vflag) {
  restored_.reset();
  recorder_.on = false;
  // Before the first forces of an increment the weights come from the contacts at its start.
  if (protocol_.controlled() && protocol_.done() == 0 && protocol_.loading() > 0) renew_weights();
  FixCellStrain<dim>::setup(vflag);
  look();
}

template <int dim>
void FixCellLoad<dim>::pre_force(int) {
  protocol_.advance(1);
  if (protocol_.looks_now() || update->ntimestep == output->next) start_recording();
}

template <int dim>
void FixCellLoad<dim>::post_force(int vflag) {
  FixCellStrain<dim>::post_force(vflag);
  if (!recorder_.on) return;
  recorder_.on = false;
  look();
  if (protocol_.controlled() && protocol_.looks_now()) renew_weights();
}

template <int dim>
void FixCellLoad<dim>::renew_weights() {
  const std::vector<double> weights = rotation_weights(recorder_.contacts, this->grains());
  if (!weights.empty()) this->set_rotation_weights(weights);
}

template <int dim>
void FixCellLoad<dim>::look() {
  const std::vector<Contact>& contacts = recorder_.contacts;
  found_ = protocol_.read_out(contacts, frame_in_space(this->box()), this->volume());
  const Unbalanced ratios = unbalanced(this->imbalance(), contacts, mean_.radius, protocol_.least_force());
  const double ended = protocol_.ended(ratios.force_ratio, ratios.moment_ratio) ? 1.0 : 0.0;
  const Eigen::Matrix3d& s = found_.stress;
  const Eigen::Matrix3d& m = found_.couple_stress;
  answer_ = {s(0, 0), s(1, 1), s(2, 2), s(0, 1), s(1, 0), m(0, 2), m(1, 2), ratios.force_ratio,
             ratios.moment_ratio, ended, static_cast<double>(contacts.size()),
             // of spheres
             s(0, 2), s(2, 0), s(1, 2), s(2, 1), m(0, 0), m(1, 1), m(2, 2), m(0, 1), m(1, 0), m(2, 0),
             m(2, 1)};
}

template <int dim>
void FixCellLoad<dim>::report(const char* name) const {
  std::vector<double> stress, couple_stress;
  if constexpr (dim == 2) {
    stress.assign(answer_.begin(), answer_.begin() + 5);
    couple_stress.assign(answer_.begin() + 5, answer_.begin() + 7);
  } else {
    for (int i = 0; i < 3; ++i)
      for (int j = 0; j < 3; ++j) {
        stress.push_back(found_.stress(i, j));
        couple_stress.push_back(found_.couple_stress(i, j));
      }
  }
  const std::string line = fmt::format(
      "cell: increment {} stress {:.17g} couple_stress {:.17g} unbalanced {:.3e} {:.3e} steps {}\n", name,
      fmt::join(stress, " "), fmt::join(couple_stress, " "), answer_[7], answer_[8], protocol_.done());
  for (FILE* stream : {this->screen, this->logfile})
    if (stream) std::fputs(line.c_str(), stream);
}

template class FixCellLoad<2>;
template class FixCellLoad<3>;

namespace {
/// One name for both; the dimension of the script decides.
LAMMPS_NS::Fix* make_cell_load(LAMMPS* lammps, int count, char** words) {
  if (lammps->domain->dimension == 3) return new FixCellLoad<3>(lammps, count, words);
  return new FixCellLoad<2>(lammps, count, words);
}
const Extension kCellLoad([](LAMMPS& engine) { fix_table(*engine.modify)["cell/load"] = &make_cell_load; });
}  // namespace

}  // namespace polargrain::dem
