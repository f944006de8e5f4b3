// SPDX-License-Identifier: GPL-2.0-or-later
#include <fmt/format.h>

#include <Eigen/LU>
#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>
#include <optional>
#include <string>
#include <vector>

#include "common/error.hpp"
#include "dem/cell/cell_state.hpp"
#include "dem/cell/packing_data.hpp"
#include "dem/cell/script_time_step.hpp"
#include "dem/cell/stock_laws.hpp"
#include "dem/contact/contact_library.hpp"
#include "dem/contact/contact_recorder.hpp"
#include "dem/engine/engine.hpp"
#include "dem/pack/fix_gravity.hpp"
#include "dem/pack/fix_space_box.hpp"
#include "dem/pack/pressed_box.hpp"
#include "dem/spheres/space_contact.hpp"
#include "grains_io/packing_data.hpp"

namespace polargrain::dem {

namespace {

class PressedSpheres final : public PressedBox {
 public:
  PressedSpheres(const PackingSpecification& specification, const Packing& packing,
                 const std::optional<MakingFriction>& friction, Fall fall, bool probe = false)
      : packing_(packing),
        frame_(frame_of_packing_data(packing)),
        script_file_(specification.script_file),
        recorder_(contact_recorder(engine_.lammps())) {
    add_contact_library(specification.contact_library);
    const auto count = static_cast<double>(packing.grains.size());
    for (const Grain& grain : packing.grains) {
      mean_mass_ += grain.mass / count;
      mean_radius_ += grain.radius / count;
      solid_ += 4.0 / 3.0 * std::numbers::pi * grain.radius * grain.radius * grain.radius;
    }
    LAMMPS_NS::LAMMPS& lammps = engine_.lammps();
    const PackingDataFile data(packing);
    data.define_variables(engine_);
    engine_.script(specification.script, specification.script_file);
    if (friction) set_friction(engine_, *friction);
    script_time_step_.emplace(lammps);
    engine_.command("fix polargrain_box all pack/space_box");
    strain_ = dynamic_cast<FixSpaceBox*>(lammps.modify->fix[lammps.modify->find_fix("polargrain_box")]);
    if (fall == Fall::yes) {
      gravity_ = &add_gravity(engine_);
    }
    lammps.atom->sortfreq = 0;  // the order of the grains is part of the state
    lammps.update->nsteps = 0;
    lammps.update->firststep = lammps.update->laststep = lammps.update->ntimestep;
    lammps.update->whichflag = 1;  // dynamics
    lammps.init();
    if (packing.state && state_fits(lammps, *packing.state)) restore_state(lammps, *packing.state);
    set_up();
    radii_ = inertia_of(lammps).radii;
    stiffest_.see(recorder_.contacts);
    if (!recorder_.contacts.empty() || script_time_step_->given() || probe) return;
    const PressedSpheres pressed(specification, pressed_together(packing), friction, Fall::no, true);
    stiffest_ = pressed.stiffest_;
    // Grains are folded back into the box once more: packings have the last bits that they always had.
    set_up();
  }

  void renew_time_step(double damping_rate) override {
    stiffest_.see(recorder_.contacts);
    script_time_step_->renew(engine_.lammps(), recorder_.contacts, stiffest_, damping_rate, script_file_);
  }

  void move(const Eigen::Vector3d& strain, const Eigen::Vector3d& shear, int steps,
            double damping_rate) override {
    LAMMPS_NS::LAMMPS& lammps = engine_.lammps();
    Eigen::Matrix3d gradient = strain.asDiagonal();
    for (int plane = 0; plane < 3; ++plane) gradient(kPlanes[plane][0], kPlanes[plane][1]) = shear(plane);
    strain_->begin(gradient, steps - 1, damping_rate);
    lammps.update->laststep =
        lammps.update->ntimestep + steps + 1;  // no step is the engine's last: it would print
    lammps.output->next = lammps.update->laststep;
    lammps.update->integrate->run(steps - 1);
    record([&lammps] { lammps.update->integrate->run(1); });
    check_grains();
  }

  [[nodiscard]] Look look() const override {
    const std::vector<Contact>& contacts = recorder_.contacts;
    const double volume = strain_->base_vectors().determinant();
    const auto grains = static_cast<double>(packing_.grains.size());
    std::vector<bool> touched(packing_.grains.size(), false);
    Look seen;
    seen.contacts = static_cast<int>(contacts.size());
    double force = 0.0;
    for (const Contact& contact : contacts) {
      touched[static_cast<std::size_t>(contact.first)] = touched[static_cast<std::size_t>(contact.second)] =
          true;
      const Eigen::Vector3d branch = branch_of(contact);
      const Eigen::Vector3d on_first = force_of(contact);
      force += on_first.norm() / seen.contacts;
      seen.normal_stiffness += contact.normal_stiffness / seen.contacts;
      seen.stress += branch.cwiseProduct(on_first) / volume;
      seen.stiffness += contact.normal_stiffness / volume * branch.cwiseAbs2();
      const Eigen::Vector3d part = branch.cwiseAbs2() / branch.squaredNorm();
      for (int plane = 0; plane < 3; ++plane) {
        const auto [i, j] = kPlanes[plane];
        seen.shear(plane) += 0.5 * (branch(i) * on_first(j) + branch(j) * on_first(i)) / volume;
        seen.shear_stiffness(plane) +=
            branch.squaredNorm() / volume * part(j) *
            (contact.normal_stiffness * part(i) + contact.tangential_stiffness * (0.5 - part(i)));
      }
    }
    const auto carrying = static_cast<double>(std::count(touched.begin(), touched.end(), true));
    seen.rattlers = 1.0 - carrying / grains;
    seen.coordination_number = 2.0 * seen.contacts / grains;
    seen.void_ratio = volume / solid_ - 1.0;
    seen.overlaps = overlaps_of(contacts, radii_);
    seen.fabric = space_fabric(contacts);
    if (!(force > 0.0)) return seen;
    seen.unbalanced_force_ratio = strain_->sum_of_unbalanced_force() / carrying / force;
    seen.unbalanced_moment_ratio = strain_->sum_of_unbalanced_moment() / carrying / (force * mean_radius_);
    return seen;
  }

  Packing packing(bool keep_contacts) override {
    LAMMPS_NS::LAMMPS& lammps = engine_.lammps();
    const Eigen::Matrix3d box = strain_->base_vectors();
    Packing packing = packing_;
    const Eigen::Matrix2d turn = frame_.topLeftCorner<2, 2>();
    packing.box = turn * box.topLeftCorner<2, 2>();
    packing.thickness = box(2, 2);
    packing.lean = turn * box.topRightCorner<2, 1>();
    for (int k = 0; k < lammps.atom->nlocal; ++k) {
      Eigen::Vector3d position = Eigen::Map<const Eigen::Vector3d>(lammps.atom->x[k]);
      // Along the third base vector first: the others have nothing of what it folds.
      for (int axis = 2; axis >= 0; --axis) {
        const Eigen::Vector3d inner = box.inverse() * position;
        position -= std::floor(inner(axis)) * box.col(axis);
      }
      Grain& grain = packing.grains[static_cast<std::size_t>(lammps.atom->tag[k] - 1)];
      grain.position = turn * position.head<2>();
      grain.height = position.z();
    }
    packing.state = keep_contacts ? save_state(lammps, SpaceBox{box, frame_}) : nullptr;
    return packing;
  }

  [[nodiscard]] double mean_mass() const override { return mean_mass_; }
  [[nodiscard]] double mean_radius() const override { return mean_radius_; }
  [[nodiscard]] double time_step() const override { return lammps_->update->dt; }

 private:
  void set_up() {
    record([this] { engine_.lammps().update->integrate->setup_minimal(1); });
  }

  template <typename Steps>
  void record(const Steps& steps) {
    recorder_.contacts.clear();
    recorder_.on = true;
    steps();
    recorder_.on = false;
    StockLaws(engine_.lammps()).complete(recorder_.contacts);
  }

  void check_grains() {
    const LAMMPS_NS::Atom& atom = *engine_.lammps().atom;
    bool finite = true;
    for (int k = 0; k < atom.nlocal; ++k)
      finite = finite && std::isfinite(atom.x[k][0] + atom.x[k][1] + atom.x[k][2]);
    if (!finite || atom.nlocal != static_cast<int>(packing_.grains.size()))
      engine_.lammps().error->all(
          FLERR, "Lost atoms: the time step of the script is too large for these grains and contacts");
  }

  Packing packing_;
  Eigen::Matrix3d frame_;  // of the box, to the laboratory
  std::string script_file_;
  Engine engine_;
  ContactRecorder& recorder_;
  LAMMPS_NS::LAMMPS* lammps_ = &engine_.lammps();
  std::optional<ScriptTimeStep> script_time_step_;
  std::vector<double> radii_;  // m, as the contacts count the grains
  StiffestContact stiffest_;
  FixSpaceBox* strain_ = nullptr;
  double mean_mass_ = 0.0;
  double mean_radius_ = 0.0;
  double solid_ = 0.0;  // volume of the grains, m^3
};

}  // namespace

std::unique_ptr<PressedBox> make_space_box(const PackingSpecification& specification, const Packing& packing,
                                           const std::optional<MakingFriction>& friction, Fall fall) {
  return std::make_unique<PressedSpheres>(specification, packing, friction, fall);
}

std::unique_ptr<PressedBox> make_pressed_box(const PackingSpecification& specification,
                                             const Packing& packing,
                                             const std::optional<MakingFriction>& friction, Fall fall) {
  return packing.dimension == 3 ? make_space_box(specification, packing, friction, fall)
                                : make_plane_box(specification, packing, friction, fall);
}

}  // namespace polargrain::dem
