// SPDX-License-Identifier: GPL-2.0-or-later
#include <algorithm>
#include <cmath>
#include <string>
#include <vector>

#include "common/error.hpp"
#include "dem/cell/averages.hpp"
#include "dem/cell/cell_answers.hpp"
#include "dem/cell/cell_state.hpp"
#include "dem/cell/engine_box.hpp"
#include "dem/engine/liggghts.hpp"
#include "dem/lanes/instruction_set.hpp"
#include "dem/pack/fix_gravity.hpp"
#include "dem/pack/pressed_box.hpp"
#include "dem/sphere_loop/sphere_box.hpp"

namespace polargrain::dem {

namespace {

/// Of a length of the box; the engine's search for images is made for half a length.
constexpr double kMostTiltOfEngine = 0.5;

class PressedSpheres final : public PressedBox {
 public:
  PressedSpheres(const PackingSpecification& specification, const Packing& packing,
                 const std::optional<MakingFriction>& friction, Fall fall)
      : packing_(packing), engine_(engine_of(specification, packing, [this, friction, fall](Engine& engine) {
          if (friction) set_friction(engine, *friction);
          if (fall == Fall::yes) gravity_ = &add_gravity(engine);
        })) {
    for (const Grain& grain : packing.grains) solid_ += grain_size<3>(grain.radius);
    LAMMPS_NS::LAMMPS& lammps = engine_.lammps();
    if (packing.state && state_fits(lammps, *packing.state)) engine_.restore(*packing.state);
    engine_.set_up();
    radii_ = inertia_of(lammps).radii;
    stiffest_.see(engine_.contacts());
    if (engine_.contacts().empty() && !engine_.script_sets_time_step()) {
      Driver<3> probe(engine_of(specification, pressed_together(packing), [&friction](Engine& engine) {
        if (friction) set_friction(engine, *friction);
      }));
      probe.set_up();
      stiffest_.see(probe.contacts());
    }
    grains_ = choose_box(engine_, specification.loop);
    if (auto* const box = dynamic_cast<SphereBox*>(grains_.get()); box != nullptr && gravity_ != nullptr)
      box->further_forces = [this](const double* spheres, double* forces) {
        gravity_->act_on_rows(spheres, forces);
      };
    stepping_ = stepping_note(specification.loop, "the loop over spheres", sphere_combination(lammps),
                              name_of(best_instruction_set()));
  }

  void move(const Eigen::Vector3d& strain, const Eigen::Vector3d& shear, int steps,
            double damping_rate) override {
    Eigen::Matrix3d gradient = strain.asDiagonal();
    for (int plane = 0; plane < 3; ++plane) gradient(kPlanes[plane][0], kPlanes[plane][1]) = shear(plane);
    // The last step stands still, so that the grains keep nothing of the affine velocity.
    grains_->begin(BoxPath<3>::straight(grains_->box(), gradient, steps - 1), damping_rate, std::nullopt,
                   time_step());
    grains_->run(steps);
    const Eigen::Matrix3d& base = grains_->box().base;
    if (std::abs(base(0, 1)) > kMostTiltOfEngine * base(0, 0) ||
        std::abs(base(0, 2)) > kMostTiltOfEngine * base(0, 0) ||
        std::abs(base(1, 2)) > kMostTiltOfEngine * base(1, 1))
      throw RunError(
          "The box of the packing was sheared by more than half its length on the way to a stress without "
          "shear: take another seed or a smaller inertial_number");
  }

  [[nodiscard]] Look look() const override {
    const std::span<const Contact> contacts = grains_->contacts();
    const double volume = grains_->box().size();
    const auto grains = static_cast<double>(packing_.grains.size());
    std::vector<bool> touched(packing_.grains.size(), false);
    Look seen;
    seen.contacts = static_cast<int>(contacts.size());
    double force = 0.0;
    for (const Contact& contact : contacts) {
      touched[static_cast<std::size_t>(contact.first)] = touched[static_cast<std::size_t>(contact.second)] =
          true;
      const Eigen::Vector3d& branch = contact.branch;
      const Eigen::Vector3d& on_first = contact.force;
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
    if (!(force > 0.0)) return seen;
    const Imbalance left = grains_->imbalance();
    seen.unbalanced_force_ratio = left.force / carrying / force;
    seen.unbalanced_moment_ratio = left.moment / carrying / (force * mean_radius());
    return seen;
  }

  [[nodiscard]] Shape shape() const override {
    return {overlaps_of(grains_->contacts(), radii_), fabric_tensor(grains_->contacts())};
  }

  Packing packing(bool keep_contacts) override {
    const Box<3> box = grains_->box().reduced();
    const Eigen::Matrix2d turn = box.orientation.topLeftCorner<2, 2>();
    Packing packing = packing_;
    packing.box = turn * box.base.topLeftCorner<2, 2>();
    packing.thickness = box.base(2, 2);
    packing.lean = turn * box.base.topRightCorner<2, 1>();
    const std::span<const double> places = grains_->places();
    for (std::size_t k = 0; k < packing.grains.size(); ++k) {
      const Eigen::Vector3d place = box.folded(Eigen::Map<const Eigen::Vector3d>(&places[3 * k]));
      packing.grains[k].position = turn * place.head<2>();
      packing.grains[k].height = place.z();
    }
    packing.state = keep_contacts ? state() : nullptr;
    return packing;
  }

  [[nodiscard]] double mean_mass() const override { return engine_.mean_mass(); }
  [[nodiscard]] double mean_radius() const override { return engine_.mean_radius(); }
  [[nodiscard]] double time_step() const override { return engine_.strain().time_step(); }
  void renew_time_step(double damping_rate) override {
    stiffest_.see(grains_->contacts());
    engine_.renew_time_step(grains_->contacts(), stiffest_, damping_rate);
  }
  [[nodiscard]] const std::string& stepping() const override { return stepping_; }

 private:
  static Driver<3> engine_of(const PackingSpecification& specification, const Packing& packing,
                             const std::function<void(Engine&)>& after_script) {
    return {packing, specification.script, specification.script_file, specification.contact_library,
            after_script};
  }

  /// As the engine keeps it, whichever loop has stepped the grains: without their rotations, which count from the packing
  /// on.
  StatePointer state() {
    engine_.restore(*grains_->save());
    engine_.set_up();
    engine_.strain().fold();
    return save_state(engine_.lammps(), engine_.strain().box());
  }

  Packing packing_;
  Driver<3> engine_;
  std::unique_ptr<GrainBox<3>> grains_;
  std::vector<double> radii_;  // m, as the contacts count the grains
  StiffestContact stiffest_;
  double solid_ = 0.0;  // volume of the grains, m^3
  std::string stepping_;
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
