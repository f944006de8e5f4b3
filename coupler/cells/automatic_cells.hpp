// SPDX-License-Identifier: GPL-2.0-or-later
#pragma once
#include <memory>
#include <span>
#include <string>
#include <vector>

#include "coupler/cells/cell_material.hpp"
#include "coupler/cells/resident_material.hpp"

namespace polargrain::coupler {

/// Cells of a run whose steps are balanced by iterations at times and explicit at others: a CellMaterial while iterations
/// ask, a ResidentMaterial while explicit steps do. Where the method changes, each point and its grains pass from one
/// to the other; boxes begin without motion, and iterations begin from the grains as they were read out.
template <int dim>
class AutomaticCells : public fem::Material<dim>, public fem::BeginsInGround<dim>, public GrainsOfPoints {
 public:
  /// Both must be of the same packing, script and Cosserat part, and not allocated.
  AutomaticCells(std::unique_ptr<CellMaterial<dim>> cells, std::unique_ptr<ResidentMaterial<dim>> residents);

  void allocate(std::size_t points) override;
  void set_ground_stress(std::size_t point, const typename Cosserat<dim>::Vector& stress) override {
    cells_->set_ground_stress(point, stress);
  }
  void begin_in_ground() override { cells_->begin_in_ground(); }
  /// Passes the points on where the method changes.
  void expect(const fem::Asking& asking) override;
  void evaluate(std::span<const Increment<dim>> increments, std::span<Response<dim>> responses) override {
    active().evaluate(increments, responses);
  }
  void commit() override { active().commit(); }
  void revert() override { active().revert(); }
  void settle() override { active().settle(); }
  [[nodiscard]] fem::Unrest unrest() const override { return active().unrest(); }
  void save(ArchiveWriter& archive) const override;
  void restore(ArchiveReader& archive) override;

  [[nodiscard]] double moment_length() const override { return cells_->moment_length(); }
  [[nodiscard]] std::vector<std::string> field_names() const override { return cells_->field_names(); }
  void fields(std::size_t point, std::span<double> values) const override { active().fields(point, values); }
  [[nodiscard]] std::vector<std::string> take_notes() override { return cells_->take_notes(); }
  [[nodiscard]] std::vector<fem::Figure> figures() const override { return active().figures(); }
  [[nodiscard]] std::string at_limits() const override;
  [[nodiscard]] StatePointer grains_of(std::size_t point) const override;

 private:
  [[nodiscard]] fem::Material<dim>& active();
  [[nodiscard]] const fem::Material<dim>& active() const;
  /// The boxes' own packing at rest is asked for when they are needed first.
  void allocate_residents();
  void pass_to_residents();
  void pass_to_cells();

  std::unique_ptr<CellMaterial<dim>> cells_;
  std::unique_ptr<ResidentMaterial<dim>> residents_;
  std::size_t points_ = 0;
  bool has_residents_ = false;  ///< they are allocated
  bool is_explicit_ = false;
};

}  // namespace polargrain::coupler
