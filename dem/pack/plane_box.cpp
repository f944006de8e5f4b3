// SPDX-License-Identifier: GPL-2.0-or-later
#include <cmath>
#include <span>
#include <vector>

#include "common/stepping_note.hpp"
#include "dem/cell/averages.hpp"
#include "dem/cell/cell_state.hpp"
#include "dem/cell/driver.hpp"
#include "dem/engine/liggghts.hpp"
#include "dem/pack/fix_gravity.hpp"
#include "dem/pack/pressed_box.hpp"
#include "grains_io/packing_data.hpp"

namespace polargrain::dem {

namespace {

class PlaneBox final : public PressedBox {
 public:
  PlaneBox(const PackingSpecification& specification, const Packing& packing,
           const std::optional<MakingFriction>& friction, Fall fall)
      : packing_(packing),
        turn_(frame_of_packing_data(packing).topLeftCorner<2, 2>()),
        driver_(packing, specification.script, specification.script_file, specification.contact_library,
                [this, friction, fall](Engine& engine) {
                  if (friction) set_friction(engine, *friction);
                  if (fall == Fall::yes) gravity_ = &add_gravity(engine);
                }) {
    if (packing.state && state_fits(driver_.lammps(), *packing.state))
      restore_state<2>(driver_.lammps(), *packing.state);
    driver_.set_up();
    radii_ = inertia_of(driver_.lammps()).radii;
    stiffest_.see(driver_.contacts());
    if (driver_.contacts().empty() && !driver_.script_sets_time_step()) {
      Driver<2> probe(pressed_together(packing), specification.script, specification.script_file,
                      specification.contact_library);
      probe.set_up();
      stiffest_.see(probe.contacts());
      // Grains are folded back into the box once more: packings have the last bits that they always had.
      driver_.set_up();
    }
  }

  void move(const Eigen::Vector3d& strain, const Eigen::Vector3d& shear, int steps,
            double damping_rate) override {
    Eigen::Matrix2d h;
    h << strain(0), shear(0), 0.0, strain(1);
    h = turn_ * h * turn_.transpose();
    // The last step stands still, so that the grains keep nothing of the affine velocity.
    driver_.strain().begin(BoxPath<2>(driver_.strain().box().reduced(), h, steps - 1), damping_rate);
    driver_.run(steps);
  }

  [[nodiscard]] Look look() const override {
    const std::span<const Contact> contacts = driver_.contacts();
    const double volume = driver_.strain().box().size() * driver_.depth();
    const Equilibrium equilibrium = driver_.equilibrium();
    Look seen;
    seen.contacts = static_cast<int>(contacts.size());
    seen.unbalanced_force_ratio = equilibrium.unbalanced_force_ratio;
    seen.unbalanced_moment_ratio = equilibrium.unbalanced_moment_ratio;
    seen.coordination_number = equilibrium.coordination_number;
    seen.rattlers = equilibrium.rattlers;
    seen.void_ratio = equilibrium.void_ratio;
    seen.normal_stiffness = mean_normal_stiffness(contacts);
    const Eigen::Matrix3d stress = average_stress(contacts, volume);
    seen.stress << stress(0, 0), stress(1, 1), 0.0;
    seen.shear(0) = 0.5 * (stress(0, 1) + stress(1, 0));
    for (const Contact& contact : contacts) {
      const double length = contact.branch.norm();
      const Eigen::Array2d part = (contact.branch.head<2>() / length).array().square();
      const double kn = contact.normal_stiffness * length * length / volume;
      const double kt = contact.tangential_stiffness * length * length / volume;
      seen.stiffness.head<2>().array() += kn * part;
      seen.shear_stiffness(0) += kn * part(0) * part(1) + 0.5 * kt * part(1) * (part(1) - part(0));
    }
    return seen;
  }

  [[nodiscard]] Shape shape() const override {
    Shape shape;
    shape.overlaps = overlaps_of(driver_.contacts(), radii_);
    shape.fabric = fabric_tensor(driver_.contacts());
    return shape;
  }

  Packing packing(bool keep_contacts) override {
    LAMMPS_NS::LAMMPS& lammps = driver_.lammps();
    const Box<2> box = driver_.strain().box().reduced();
    Packing packing = packing_;
    packing.box = turn_ * box.base;
    for (int k = 0; k < lammps.atom->nlocal; ++k) {
      // Grains leave the box between two neighbour lists: fold them back.
      const Eigen::Vector2d position = box.folded({lammps.atom->x[k][0], lammps.atom->x[k][1]});
      // The data file counts the grains from 1.
      packing.grains[static_cast<std::size_t>(lammps.atom->tag[k] - 1)].position = turn_ * position;
    }
    packing.state = keep_contacts ? save_state(lammps, box) : nullptr;
    return packing;
  }

  [[nodiscard]] double mean_mass() const override { return driver_.mean_mass(); }
  [[nodiscard]] double mean_radius() const override { return driver_.mean_radius(); }
  [[nodiscard]] double time_step() const override { return driver_.strain().time_step(); }
  void renew_time_step(double damping_rate) override {
    stiffest_.see(driver_.contacts());
    driver_.renew_time_step(driver_.contacts(), stiffest_, damping_rate);
  }
  [[nodiscard]] const std::string& stepping() const override { return stepping_; }

 private:
  Packing packing_;
  Eigen::Matrix2d turn_;  // of the box, to the laboratory
  Driver<2> driver_;
  std::vector<double> radii_;  // m, as the contacts count the grains
  StiffestContact stiffest_;
  std::string stepping_{std::string(kSteppingNote) + "LIGGGHTS's own loop, as all packings of discs"};
};

}  // namespace

std::unique_ptr<PressedBox> make_plane_box(const PackingSpecification& specification, const Packing& packing,
                                           const std::optional<MakingFriction>& friction, Fall fall) {
  return std::make_unique<PlaneBox>(specification, packing, friction, fall);
}

}  // namespace polargrain::dem
