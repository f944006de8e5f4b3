// SPDX-License-Identifier: GPL-2.0-or-later
#pragma once
#include <cstdint>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "coupler/cells/grains_of_points.hpp"
#include "coupler/cells/points_at_limits.hpp"
#include "coupler/cells/space_cosserat_part.hpp"
#include "coupler/pool/pool.hpp"
#include "fem/material/material.hpp"

namespace polargrain::coupler {

/// CellMaterial in space: boxes of spheres, one a point, with all nine stresses. With free rotations skew stress and couple
/// stresses are those of SpaceCosseratPart; with controlled ones the cells give everything.
class SpaceCellMaterial : public fem::Material<3>, public GrainsOfPoints {
 public:
  /// @param pool must outlive the material @param definition from Pool::define, of spheres
  /// @param cosserat nothing: the answer of the cells is taken whole (CellRotations::controlled)
  /// @param note remarks to the user on them; may be empty
  SpaceCellMaterial(Pool& pool, std::uint32_t definition, const std::optional<CosseratParameters>& cosserat,
                    const std::string& note = {});

  /// Asks for the packing at rest, once; every point starts from it.
  void allocate(std::size_t points) override;
  /// Sends the increments of all points to the pool at once. A point whose increment is zero keeps its committed answer.
  void evaluate(std::span<const Increment<3>> increments, std::span<Response<3>> responses) override;
  /// Collects the states of the cells.
  void commit() override;
  void revert() override { trial_ = committed_; }
  void save(ArchiveWriter& archive) const override;
  void restore(ArchiveReader& archive) override;

  [[nodiscard]] double moment_length() const override { return 2.0 * mean_radius_; }
  /// The diagnostics of the cell (docs/file_formats.md), parted, and with free rotations skew_mobilisation and
  /// couple_mobilisation.
  [[nodiscard]] std::vector<std::string> field_names() const override;
  [[nodiscard]] std::vector<std::string> take_notes() override { return std::exchange(notes_, {}); }
  void fields(std::size_t point, std::span<double> values) const override;
  [[nodiscard]] std::vector<fem::Figure> figures() const override { return at_limits_.figures(); }
  [[nodiscard]] std::string at_limits() const override { return at_limits_.text(); }
  [[nodiscard]] StatePointer grains_of(std::size_t point) const override { return committed_[point].state; }

 private:
  struct PointState {
    Response<3> cell;  ///< the cell's own last answer
    CellDiagnostics diagnostics;
    StatePointer state;
    SpaceCosseratPart cosserat;

    template <RecordOf<PointState> Record, class Visit>
    friend void describe(Record& point, Visit&& visit) {
      visit(FieldNotes{"cell", "", "stress and tangent of the cell"}, point.cell);
      visit(FieldNotes{"diagnostics", "", "diagnostics of the cell"}, point.diagnostics);
      visit(FieldNotes{"state", "", "state of the cell"}, point.state);
      visit(FieldNotes{"cosserat", "", "skew and couple stress of the case"}, point.cosserat);
    }
  };

  static PointState taken(CellReply reply);
  [[nodiscard]] LimitsReached reached(const PointState& point) const;
  [[nodiscard]] double least_pressure() const;

  Pool& pool_;
  std::uint32_t definition_;
  std::optional<CosseratParameters> cosserat_;
  PointsAtLimits at_limits_;
  double contacts_ = 0.0;     ///< of the packing
  double pressure_ = 0.0;     ///< of the packing, mean, Pa
  double mean_radius_ = 0.0;  ///< of the grains, m; 0: their rotations are free
  std::vector<std::string> notes_;
  std::vector<PointState> committed_;
  std::vector<PointState> trial_;
};

}  // namespace polargrain::coupler
