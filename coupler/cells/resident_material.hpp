// SPDX-License-Identifier: GPL-2.0-or-later
#pragma once
#include <cstdint>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "coupler/cells/cell_calls.hpp"
#include "coupler/cells/cosserat_part.hpp"
#include "coupler/cells/grains_of_points.hpp"
#include "coupler/cells/ground_start.hpp"
#include "coupler/cells/packing_at_start.hpp"
#include "coupler/cells/points_at_limits.hpp"
#include "coupler/cells/resident_cells.hpp"
#include "coupler/pool/pool.hpp"
#include "coupler/protocol/resident_records.hpp"
#include "fem/material/begins_in_ground.hpp"
#include "fem/material/material.hpp"

namespace polargrain::coupler {

/// CellMaterial<dim> for explicit steps: its boxes stay with the workers and go on, one message a worker and step
/// (resident_cells.hpp). Skew and couple stress as there.
///
/// Boxes move when they are asked, so each step is evaluated once and committed; nothing can be dropped. Explicit steps ask
/// for no tangent: the one in the responses is that of the packing at rest.
///
/// Diagnostics and states are those of the last settle, but for contacts, coordination_number and
/// unbalanced_force_ratio, which are of the present.
template <int dim>
class ResidentMaterial : public fem::Material<dim>, public fem::BeginsInGround<dim>, public GrainsOfPoints {
 public:
  /// @param pool must outlive the material @param definition from Pool::define, for this material alone
  /// @param cosserat nothing: the answer of the cells is taken whole (CellRotations::controlled)
  /// @param dem_steps of each box in a step, at least 1 @param note remarks to the user on them; may be empty
  /// @throws RunError when there are no DEM steps in a step
  ResidentMaterial(Pool& pool, std::uint32_t definition, const std::optional<CosseratParameters>& cosserat,
                   int dem_steps, const std::string& note = {});

  /// Asks for the packing at rest, once; every box starts from it.
  void allocate(std::size_t points) override;
  /// As those of CellMaterial<dim>.
  void set_ground_stress(std::size_t point, const typename Cosserat<dim>::Vector& stress) override {
    ground_.set(point, stress);
  }
  void begin_in_ground() override;
  /// In real time: as many DEM steps a step as have its duration, at least two.
  void expect(const fem::Asking& asking) override;
  /// All boxes go on, each along its increment. When all increments are zero, as for the stress at the start, nobody is
  /// asked and the last answers count. @throws RunError when boxes have moved since the last commit
  void evaluate(std::span<const Increment<dim>> increments, std::span<Response<dim>> responses) override;
  void commit() override;
  /// @throws RunError when boxes have moved since the last commit
  void revert() override;
  /// Brings the diagnostics and the states of all boxes; to be called before results or checkpoints are written. Has a
  /// part in the bits that follow. @throws RunError between evaluate and commit
  void settle() override;
  [[nodiscard]] fem::Unrest unrest() const override;
  /// @throws RunError when boxes have moved since the last settle
  void save(ArchiveWriter& archive) const override;
  void restore(ArchiveReader& archive) override;

  [[nodiscard]] double moment_length() const override { return 2.0 * mean_radius_; }
  /// As those of CellMaterial<dim>.
  [[nodiscard]] std::vector<std::string> field_names() const override;
  /// Remarks of the engine on the packing and its script, once.
  [[nodiscard]] std::vector<std::string> take_notes() override { return std::exchange(notes_, {}); }
  void fields(std::size_t point, std::span<double> values) const override;
  [[nodiscard]] std::vector<fem::Figure> figures() const override;
  [[nodiscard]] std::string at_limits() const override { return at_limits_.text(); }
  [[nodiscard]] StatePointer grains_of(std::size_t point) const override { return points_[point].state; }

  /// A point and its box.
  struct PointState {
    typename Cosserat<dim>::Vector stress = Cosserat<dim>::Vector::Zero();  ///< of the cell, of the present
    CellDiagnostics diagnostics;
    StatePointer state;     ///< at the last settle
    ResidentMotion motion;  ///< then
    CosseratPart<dim> cosserat;

    template <RecordOf<PointState> Record, class Visit>
    friend void describe(Record& point, Visit&& visit) {
      visit(FieldNotes{"stress", "Pa, N/m", "stress of the cell"}, point.stress);
      visit(FieldNotes{"diagnostics", "", "diagnostics of the cell"}, point.diagnostics);
      visit(FieldNotes{"state", "", "state of the cell"}, point.state);
      visit(FieldNotes{"motion", "", "motion of the cell"}, point.motion);
      visit(FieldNotes{"cosserat", "", "skew and couple stress of the case"}, point.cosserat);
    }
  };
  /// The committed points, read out, and the same given: the boxes move in there. Nothing may be on trial.
  /// @throws RunError when boxes have moved since the last settle
  [[nodiscard]] const std::vector<PointState>& settled() const;
  void take_over(std::vector<PointState> points, const PointsAtLimits& at_limits);
  [[nodiscard]] const PointsAtLimits& points_at_limits() const { return at_limits_; }
  /// The packing that all boxes start from.
  [[nodiscard]] const PointReply<dim>& at_rest() const { return at_rest_; }

 private:
  void take(PointState& point, const ResidentAnswer& answer) const;
  [[nodiscard]] LimitsReached reached(const PointState& point) const;
  void forget_unrest();
  /// All boxes begin at the last settle.
  void start();

  CellCalls<dim> calls_;
  ResidentCells cells_;
  int dem_steps_;
  double dem_seconds_ = 0.0;  ///< of a DEM step of the packing at rest; 0: not asked yet
  double grains_;             ///< in a cell
  std::optional<CosseratParameters> cosserat_;
  PointsAtLimits at_limits_;
  PointReply<dim> at_rest_;  ///< the packing
  PackingAtStart<dim> packing_;
  GroundStart<dim> ground_;
  double mean_radius_ = 0.0;  ///< of the grains, m; 0: their rotations are free
  std::vector<std::string> notes_;
  std::vector<PointState> points_;
  std::vector<double>
      unrest_;  ///< by point: sum of unbalanced_force_ratio over the steps since the last settle
  int unrest_steps_ = 0;
  bool has_moved_ = false;   ///< since the last commit
  bool is_settled_ = false;  ///< nobody has moved since the last settle
};

}  // namespace polargrain::coupler
