// SPDX-License-Identifier: GPL-2.0-or-later
#pragma once
#include <memory>
#include <vector>

#include "coupler/cells/grains_of_points.hpp"
#include "fem/material/begins_in_ground.hpp"
#include "fem/material/material.hpp"

namespace polargrain::coupler {

/// A material of Newton's method in explicit steps, which are too small to bring its cells to rest in each of them. It takes
/// several together: its answer is that to the way since it committed last, and it commits after so many
/// steps, and whenever results are written. In between it goes to and fro without loss, however it yields.
template <int dim>
class GatheredMaterial : public fem::Material<dim>, public fem::BeginsInGround<dim>, public GrainsOfPoints {
 public:
  /// @param material not null, shows grains (GrainsOfPoints) @param steps that are taken together, at least 1
  /// @throws RunError without points, or when the material shows no grains
  GatheredMaterial(std::shared_ptr<fem::Material<dim>> material, int steps);

  void allocate(std::size_t points) override;
  /// Steps are taken together where they are explicit; iterations (`method: automatic`) ask the material itself.
  void expect(const fem::Asking& asking) override;
  void evaluate(std::span<const Increment<dim>> increments, std::span<Response<dim>> responses) override;
  void commit() override;
  void revert() override;
  [[nodiscard]] bool confirm() override { return gathers_ || material_->confirm(); }
  void settle() override;
  /// @throws RunError between settle and the next one
  void save(ArchiveWriter& archive) const override;
  void restore(ArchiveReader& archive) override;

  void set_initial_stress(std::size_t point, const typename Cosserat<dim>::Vector& stress) override {
    material_->set_initial_stress(point, stress);
  }
  void set_ground_stress(std::size_t point, const typename Cosserat<dim>::Vector& stress) override {
    if (led_ == nullptr) return set_initial_stress(point, stress);
    led_->set_ground_stress(point, stress);
  }
  void begin_in_ground() override {
    if (led_ != nullptr) led_->begin_in_ground();
  }
  [[nodiscard]] bool can_turn() const override { return material_->can_turn(); }
  [[nodiscard]] double moment_length() const override { return material_->moment_length(); }
  [[nodiscard]] std::vector<std::string> field_names() const override { return material_->field_names(); }
  void fields(std::size_t point, std::span<double> values) const override {
    material_->fields(point, values);
  }
  [[nodiscard]] std::vector<fem::Figure> figures() const override { return material_->figures(); }
  [[nodiscard]] std::string doubt() const override { return material_->doubt(); }
  [[nodiscard]] std::vector<std::string> take_notes() override { return material_->take_notes(); }
  [[nodiscard]] StatePointer grains_of(std::size_t point) const override { return grains_->grains_of(point); }
  [[nodiscard]] std::string at_limits() const override { return grains_->at_limits(); }

 private:
  std::shared_ptr<fem::Material<dim>> material_;
  const GrainsOfPoints* grains_;   ///< the same
  fem::BeginsInGround<dim>* led_;  ///< the same, where it can be led to a stress; else null
  int steps_;
  bool gathers_ = true;                ///< the steps are explicit
  bool was_dropped_ = false;           ///< the step that was evaluated last
  int gathered_ = 0;                   ///< steps since the material committed last
  std::vector<Increment<dim>> way_;    ///< by point, over these steps
  std::vector<Increment<dim>> trial_;  ///< the same with the step on trial
};

}  // namespace polargrain::coupler
