// SPDX-License-Identifier: GPL-2.0-or-later
#pragma once
#include <memory>
#include <vector>

#include "dem/box/box_records.hpp"
#include "dem/box/grain_box.hpp"
#include "dem/box/snapshot.hpp"
#include "dem/lanes/instruction_set.hpp"
#include "dem/sphere_loop/sphere_constants.hpp"

namespace LAMMPS_NS {
class LAMMPS;
}

namespace polargrain::dem {

/// Kernels compiled for an instruction set, or their plain twin, which gives the same bits one contact at a time.
const SphereKernels& sphere_kernels(InstructionSet set, bool plain = false);

/// A box of spheres that is stepped without the engine's lists, ghosts and passes: the same velocity Verlet, the same
/// box motion, damping and control of rotations as `fix cell/strain` with `fix nve/sphere`, in two passes a step:
/// one over the contacts and one over the spheres. Tests hold it to the engine's own loop.
class SphereBox final : public GrainBox<3> {
 public:
  SphereBox(Spheres spheres, const SphereKernels& kernels);

  /// Called in every step with the rows of grains and forces (SpherePass), to add to the forces; may be empty.
  std::function<void(const double* grains, double* forces)> further_forces;

  /// Takes records that other boxes have too: they tell of this one until another one makes a pass.
  void share(std::shared_ptr<BoxRecords> records) { records_ = std::move(records); }

  void restore(const State& state) override;
  /// The same from a snapshot. @throws RunError when it is not one of these spheres and laws
  void restore(const Snapshot<3>& snapshot);
  [[nodiscard]] StatePointer save() override;
  void begin(const BoxPath<3>& path, double damping_rate, const Loading& rotation, double time_step) override;
  /// As begin, but spheres and box keep their velocities (ResidentBoxes); the weights of the rotation stay too.
  void go_on(const BoxPath<3>& path, double damping_rate, const Loading& rotation);
  void set_time_step(double seconds) { time_step_ = seconds; }
  /// The box as it is with the rates of the step behind it.
  [[nodiscard]] const BoxMotion<3>& motion() const { return motion_; }
  /// As restore, and the spheres come with the affine motion `gradient`, `spin` of their box in the step behind them.
  void restore_moving(const State& state, const Eigen::Matrix3d& gradient, const Eigen::Vector3d& spin);
  /// As save, but a sphere that is folded back into the box takes the affine velocity of its new place.
  [[nodiscard]] StatePointer save_moving();
  void set_up() override;
  void run(int steps) override;

  void set_rotation_weights(std::span<const double> weights) override;
  void hold_rotation() override;
  [[nodiscard]] std::span<const double> weights() const override { return weights_; }
  [[nodiscard]] Eigen::Vector3d multiplier() const override {
    return motion_.box().orientation * multiplier_;
  }
  [[nodiscard]] const Box<3>& box() const override { return motion_.box(); }
  [[nodiscard]] std::span<const Contact> contacts() const override;
  [[nodiscard]] ContactSums<3> contact_sums() const override;
  [[nodiscard]] Imbalance imbalance() const override { return imbalance_; }
  [[nodiscard]] std::span<const double> rotations() const override;
  [[nodiscard]] std::span<const double> places() const override;
  [[nodiscard]] GrainMotion<3> motion(int sphere) const override;

 private:
  [[nodiscard]] int count() const { return static_cast<int>(spheres_.radii.size()); }
  [[nodiscard]] bool controlled() const { return motion_.rotation_is_prescribed() && !weights_.empty(); }
  /// Makes the list anew. @param carried springs of the former one
  void find_candidates(const CarriedSprings& carried);
  /// Whether two spheres that are no candidates may have come to touch.
  [[nodiscard]] bool outgrown();
  void place_images();
  void compute_forces(bool advance, bool record);
  /// Contacts from the records of the last pass.
  void read_records() const;
  [[nodiscard]] const double* record_of(int candidate) const;
  [[nodiscard]] Contact contact_of(int candidate, const double* record) const;
  [[nodiscard]] SphereMotion motion_of_step();
  /// The box goes on by a step, and the spheres do its first half. One pass over them does that and the second half of
  /// the step before.
  void begin_step(bool end_the_last);
  /// Adds lambda V weight to the torques. @param damped the torques of the damping count too
  void control_rotation(bool damped);
  void sum_up();

  Spheres spheres_;
  const SphereKernels& kernels_;
  SphereKernels::Pass pass_;
  int springs_ = 0;              // of a contact in a state
  double skin_ = 0.0;            // m
  double largest_radius_ = 0.0;  // m
  // Two dummy spheres stand behind the others: they fill up the blocks of candidates.
  LineVector<double> grains_, forces_, accelerations_, turned_, inverse_mass_, inverse_inertia_;
  SphereList list_;
  LineVector<double> images_;
  std::shared_ptr<BoxRecords> records_ = std::make_shared<BoxRecords>();
  Eigen::Matrix3d listed_inverse_ = Eigen::Matrix3d::Identity();  // H^-1 when the list was made, 1/m
  std::vector<Eigen::Vector3d> listed_places_;
  double wandered_ = 0.0;  // bound of how far a sphere has moved against the affine flow since then, m
  double reach_ = 0.0;     // largest gap of candidates that may have closed since then, m
  BoxMotion<3> motion_;
  double time_step_ = 0.0;
  double damping_rate_ = 0.0;
  std::vector<double> weights_;
  Eigen::Vector3d multiplier_ = Eigen::Vector3d::Zero();  // in the frame of the box, Pa
  Imbalance imbalance_;
};

/// The spheres of an initialised engine as they stand there, with the springs of its contact histories.
Spheres spheres_of(LAMMPS_NS::LAMMPS& lammps, const LawCombination& combination);
Snapshot<3> sphere_snapshot(LAMMPS_NS::LAMMPS& lammps, const LawCombination& combination, const Box<3>& box,
                            std::span<const double> rotations);

/// The way back: places, motions and contact histories of the engine's grains from a snapshot, for those who go on in
/// the engine's own loop. The box is the caller's business; lists are not set up.
/// @throws RunError when the snapshot is not one of these grains and models
void put_spheres(LAMMPS_NS::LAMMPS& lammps, const LawCombination& combination, const Snapshot<3>& snapshot);

}  // namespace polargrain::dem
