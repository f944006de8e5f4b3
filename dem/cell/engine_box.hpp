// SPDX-License-Identifier: GPL-2.0-or-later
#pragma once
#include "dem/cell/driver.hpp"
#include "dem/cell/grain_box.hpp"

namespace polargrain::dem {

/// A box of grains that the engine itself steps: any contact models, any fixes of the script.
class EngineBox final : public GrainBox {
 public:
  /// @param driver must outlive this
  explicit EngineBox(Driver& driver);

  void restore(const State& state) override;
  [[nodiscard]] StatePointer save() override;
  void begin(const BoxPath& path, double damping_rate, std::optional<RotationLoading> rotation) override;
  void set_up() override { driver_.set_up(); }
  void run(int steps) override { driver_.run(steps); }

  void set_rotation_weights(std::span<const double> weights) override;
  void hold_rotation() override { driver_.strain().setup(0); }
  [[nodiscard]] std::span<const double> weights() const override { return driver_.strain().weights(); }
  [[nodiscard]] double multiplier() const override { return driver_.strain().multiplier(); }
  [[nodiscard]] Box box() const override { return driver_.strain().box(); }
  [[nodiscard]] std::span<const Contact> contacts() const override { return driver_.contacts(); }
  [[nodiscard]] Imbalance imbalance() const override { return driver_.strain().imbalance(); }
  [[nodiscard]] std::span<const double> rotations() const override { return driver_.strain().rotations(); }

 private:
  Driver& driver_;
  std::vector<double> restored_rotations_;
};

}  // namespace polargrain::dem
