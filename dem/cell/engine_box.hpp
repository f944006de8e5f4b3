// SPDX-License-Identifier: GPL-2.0-or-later
#pragma once
#include <memory>

#include "common/cell.hpp"
#include "dem/box/grain_box.hpp"
#include "dem/cell/driver.hpp"

namespace polargrain::dem {

/// A box of grains that the engine itself steps: any contact models, any fixes of the script.
template <int dim>
class EngineBox final : public GrainBox<dim> {
 public:
  using typename GrainBox<dim>::Loading;

  /// @param driver must outlive this
  explicit EngineBox(Driver<dim>& driver);

  void restore(const State& state) override { driver_.restore(state); }
  [[nodiscard]] StatePointer save() override { return driver_.save(); }
  void begin(const BoxPath<dim>& path, double damping_rate, const Loading& rotation,
             double /*time_step: the engine has it*/) override {
    driver_.strain().begin(path, damping_rate, rotation);
  }
  void set_up() override { driver_.set_up(); }
  void run(int steps) override { driver_.run(steps); }

  void set_rotation_weights(std::span<const double> weights) override {
    driver_.strain().set_rotation_weights(weights);
  }
  void hold_rotation() override { driver_.strain().setup(0); }
  [[nodiscard]] std::span<const double> weights() const override { return driver_.strain().weights(); }
  [[nodiscard]] typename Cosserat<dim>::Rotation multiplier() const override {
    return driver_.strain().multiplier();
  }
  [[nodiscard]] const Box<dim>& box() const override { return driver_.strain().box(); }
  [[nodiscard]] std::span<const Contact> contacts() const override { return driver_.contacts(); }
  [[nodiscard]] ContactSums<dim> contact_sums() const override { return sums_of<dim>(driver_.contacts()); }
  [[nodiscard]] Imbalance imbalance() const override { return driver_.strain().imbalance(); }
  [[nodiscard]] std::span<const double> rotations() const override { return driver_.strain().rotations(); }
  [[nodiscard]] std::span<const double> places() const override { return driver_.places(); }
  [[nodiscard]] GrainMotion<dim> motion(int grain) const override;

 private:
  Driver<dim>& driver_;
};

/// The box that steps the grains of an engine that has been set up, with their contacts: the loop over discs or spheres
/// where it knows the scene and `loop` allows it, else the engine's own. @param driver must outlive it
template <int dim>
std::unique_ptr<GrainBox<dim>> choose_box(Driver<dim>& driver, CellLoop loop);

}  // namespace polargrain::dem
