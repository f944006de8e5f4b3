// SPDX-License-Identifier: GPL-2.0-or-later
#pragma once
#include "dem/sphere_loop/space_grain_box.hpp"
#include "dem/spheres/sphere_engine.hpp"

namespace polargrain::dem {

/// A box of spheres that the engine itself steps: any contact models, any fixes of the script.
class EngineSphereBox final : public SpaceGrainBox {
 public:
  /// @param engine must outlive this
  explicit EngineSphereBox(SphereEngine& engine) : engine_(engine) {
    engine_.progress = [this] {
      if (progress) progress();
    };
  }

  void restore(const State& state) override { engine_.restore(state); }
  [[nodiscard]] StatePointer save() override { return engine_.save(); }
  void begin(const SpacePath& path, double damping_rate, const std::optional<SpaceRotation>& rotation,
             double /*time_step: the engine has it*/) override {
    engine_.strain().begin(path, damping_rate, rotation);
  }
  void set_up() override { engine_.set_up(); }
  void run(int steps) override { engine_.run(steps); }

  void set_rotation_weights(std::span<const double> weights) override {
    engine_.strain().set_rotation_weights(weights);
  }
  void hold_rotation() override { engine_.strain().setup(0); }
  [[nodiscard]] Eigen::Vector3d multiplier() const override { return engine_.strain().multiplier(); }
  [[nodiscard]] const SpaceBox& box() const override { return engine_.strain().box(); }
  [[nodiscard]] std::span<const Contact> contacts() const override { return engine_.contacts(); }
  [[nodiscard]] const Imbalance& imbalance() const override { return engine_.strain().imbalance(); }
  [[nodiscard]] std::span<const double> rotations() const override { return engine_.strain().rotations(); }
  [[nodiscard]] std::span<const double> places() const override { return engine_.places(); }
  [[nodiscard]] SpaceMotionOfGrain motion(int sphere) const override { return engine_.motion(sphere); }

 private:
  SphereEngine& engine_;
};

}  // namespace polargrain::dem
