// SPDX-License-Identifier: GPL-2.0-or-later
#pragma once
#include <memory>
#include <vector>

#include "dem/box/box_records.hpp"
#include "dem/box/grain_box.hpp"
#include "dem/box/snapshot.hpp"
#include "dem/discs/disc_pass.hpp"
#include "dem/discs/plain_contact_loop.hpp"
#include "dem/lanes/instruction_set.hpp"

namespace LAMMPS_NS {
class LAMMPS;
}

namespace polargrain::dem {

/// Kernels compiled for an instruction set.
const DiscKernels& disc_kernels(InstructionSet set);

/// A box of discs that is stepped without the engine's lists, ghosts and passes: the same velocity Verlet,
/// the same box motion, damping and control of rotations as `fix cell/strain` with `fix nve/sphere`, in two
/// passes a step: one over the contacts and one over the discs. Tests hold it to the engine's own loop.
class DiscBox final : public GrainBox<2> {
 public:
  /// The part of the discs that never changes.
  struct Definition {
    LawCombination combination;
    std::vector<double> radii;   ///< m
    std::vector<double> masses;  ///< kg
    std::vector<int> types;      ///< from 0
    double thickness = 0.0;      ///< of the box, m
    double time_step = 0.0;      ///< s
    bool plain = false;          ///< run the plain twin of the loop over contacts
    InstructionSet instructions = best_instruction_set();
  };
  explicit DiscBox(Definition definition);

  /// Takes records that other boxes have too: they tell of this one until another one makes a pass.
  void share(std::shared_ptr<BoxRecords> records) { records_ = std::move(records); }

  void restore(const State& state) override;
  /// The same from a snapshot. @throws RunError when it is not one of these discs and laws
  void restore(const Snapshot<2>& snapshot);
  [[nodiscard]] StatePointer save() override;
  void begin(const BoxPath<2>& path, double damping_rate, const Loading& rotation, double time_step) override;
  /// As begin, but discs and box keep their velocities (ResidentBoxes); the weights of the rotation stay too.
  void go_on(const BoxPath<2>& path, double damping_rate, const Loading& rotation);
  void set_time_step(double seconds) { definition_.time_step = seconds; }
  /// The box as it is with the rates of the step behind it.
  [[nodiscard]] const BoxMotion<2>& motion() const { return motion_; }
  /// As restore, and the discs come with the affine motion `gradient`, `spin` of their box in the step behind them.
  void restore_moving(const State& state, const Eigen::Matrix2d& gradient, const Cosserat<2>::Rotation& spin);
  /// As save, but a disc that is folded back into the box takes the affine velocity of its new place.
  [[nodiscard]] StatePointer save_moving();
  void set_up() override;
  void run(int steps) override;

  void set_rotation_weights(std::span<const double> weights) override;
  void hold_rotation() override;
  [[nodiscard]] std::span<const double> weights() const override { return weights_; }
  [[nodiscard]] Cosserat<2>::Rotation multiplier() const override {
    return Cosserat<2>::Rotation(multiplier_);
  }
  [[nodiscard]] const Box<2>& box() const override { return motion_.box(); }
  [[nodiscard]] std::span<const Contact> contacts() const override;
  [[nodiscard]] ContactSums<2> contact_sums() const override;
  [[nodiscard]] Imbalance imbalance() const override;
  [[nodiscard]] std::span<const double> rotations() const override;
  [[nodiscard]] std::span<const double> places() const override;
  [[nodiscard]] GrainMotion<2> motion(int disc) const override;

 private:
  /// Makes the list anew; springs come from the former one.
  void find_candidates();
  /// Whether two discs that are no candidates may have come to touch.
  [[nodiscard]] bool outgrown();
  void place_images();
  void compute_forces(bool advance, bool record);
  /// @param records as of a DiscPass
  void run_kernel(bool advance, double* records);
  /// Contacts from the records of the last pass.
  void read_records() const;
  /// Adds lambda W to the torques of the contacts. @param damped the torques of the damping count too
  void control_rotation(bool damped);
  /// The pass over the discs, with the numbers of the step that ends.
  [[nodiscard]] DiscMotionPass motion_pass();
  /// The box goes on by a step, and the discs do its first half: the velocity change by the box, half a
  /// kick, drift. One pass over the discs does that and the second half of the step before.
  void begin_step(bool end_the_last);
  [[nodiscard]] bool controlled() const { return motion_.rotation_is_prescribed() && !weights_.empty(); }

  Definition definition_;
  PlainContactLoop plain_loop_;
  const DiscKernels& kernels_;
  DiscKernels::Pass pass_;
  double skin_ = 0.0;  ///< m
  std::vector<Disc> discs_;
  std::vector<DiscForce> forces_;
  std::vector<DiscMotion> motions_;
  CandidateList list_;
  CandidateList former_;
  std::vector<MovingImage> images_;
  Eigen::Matrix2d listed_inverse_ = Eigen::Matrix2d::Identity();  ///< H^-1 when the list was made, 1/m
  std::vector<Eigen::Vector2d> listed_places_;
  /// Bound of how far a disc has moved against the affine flow since the list was made, m.
  double wandered_ = 0.0;
  double largest_radius_ = 0.0;  ///< m
  BoxMotion<2> motion_;
  double damping_rate_ = 0.0;
  std::vector<double> weights_;
  double multiplier_ = 0.0;
  std::shared_ptr<BoxRecords> records_ = std::make_shared<BoxRecords>();
};

/// The discs of an initialised engine as they stand there, with the springs of its contact histories.
DiscBox::Definition disc_definition(LAMMPS_NS::LAMMPS& lammps, const LawCombination& combination,
                                    double thickness);
Snapshot<2> disc_snapshot(LAMMPS_NS::LAMMPS& lammps, const LawCombination& combination, const Box<2>& box,
                          std::span<const double> rotations);

/// The way back: places, motions and contact histories of the engine's grains from a snapshot, for those who
/// go on in the engine's own loop. The box is the caller's business; lists are not set up.
/// @throws RunError when the snapshot is not one of these grains and models
void put_discs(LAMMPS_NS::LAMMPS& lammps, const LawCombination& combination, const Snapshot<2>& snapshot);

}  // namespace polargrain::dem
