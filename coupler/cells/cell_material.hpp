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
#include "coupler/pool/pool.hpp"
#include "fem/material/begins_in_ground.hpp"
#include "fem/material/material.hpp"

namespace polargrain::coupler {

/// A material whose stress comes from boxes of grains, one a point, evaluated by the workers of a pool: of discs or spheres
/// in the plane, of spheres in space. Cells
/// with free rotations give the symmetric stress; skew stress and couple stresses are those of the Cosserat
/// part (cosserat_part.hpp). Cells with controlled rotations give everything.
template <int dim>
class CellMaterial : public fem::Material<dim>, public fem::BeginsInGround<dim>, public GrainsOfPoints {
 public:
  /// @param pool must outlive the material @param definition from Pool::define
  /// @param cosserat nothing: the answer of the cells is taken whole (CellRotations::controlled)
  /// @param note remarks to the user on them; may be empty
  CellMaterial(Pool& pool, std::uint32_t definition, const std::optional<CosseratParameters>& cosserat,
               const std::string& note = {});

  /// Asks for the packing at rest, once; every point starts from it.
  void allocate(std::size_t points) override;
  /// Of level ground: the boxes are led there (GroundStart).
  void set_ground_stress(std::size_t point, const typename Cosserat<dim>::Vector& stress) override {
    ground_.set(point, stress);
  }
  void begin_in_ground() override;
  /// Sends the increments of all points to the pool at once. A point whose increment is zero keeps its
  /// committed answer: nothing has happened to its grains.
  void evaluate(std::span<const Increment<dim>> increments, std::span<Response<dim>> responses) override;
  /// Collects the states of the cells.
  void commit() override;
  /// A step that is tried again asks for tangents from its first evaluation on.
  void revert() override {
    trial_ = committed_;
    evaluations_ = stress_alone_;
  }
  void save(ArchiveWriter& archive) const override;
  void restore(ArchiveReader& archive) override;
  /// A box is whole: each point takes that of the nearest one.
  fem::TakenOver take_over(ArchiveReader& archive, std::size_t count,
                           std::span<const fem::PointMean> means) override;

  /// The diagnostics of the cell (docs/file_formats.md), parted, and with free rotations skew_mobilisation and couple_mobilisation.
  [[nodiscard]] double moment_length() const override { return 2.0 * mean_radius_; }
  [[nodiscard]] std::vector<std::string> field_names() const override;
  /// Remarks of the engine on the packing and its script, once.
  [[nodiscard]] std::vector<std::string> take_notes() override { return std::exchange(notes_, {}); }
  void fields(std::size_t point, std::span<double> values) const override;
  [[nodiscard]] std::vector<fem::Figure> figures() const override;
  [[nodiscard]] std::string at_limits() const override { return at_limits_.text(); }
  [[nodiscard]] StatePointer grains_of(std::size_t point) const override {
    return committed_[point].cell.state;
  }

  /// A point and its cell.
  struct PointState {
    PointReply<dim> cell;  ///< the cell's own last answer, with its state
    CosseratPart<dim> cosserat;

    template <RecordOf<PointState> Record, class Visit>
    friend void describe(Record& point, Visit&& visit) {
      visit(FieldNotes{"cell", "", "the cell's last answer"}, point.cell);
      visit(FieldNotes{"cosserat", "", "skew and couple stress of the case"}, point.cosserat);
    }
  };
  /// The committed points, and the same given; nothing may be on trial.
  [[nodiscard]] const std::vector<PointState>& committed() const { return committed_; }
  void take_over(std::vector<PointState> points, const PointsAtLimits& at_limits);
  [[nodiscard]] const GroundStart<dim>& ground() const { return ground_; }
  [[nodiscard]] const PointsAtLimits& points_at_limits() const { return at_limits_; }

 private:
  [[nodiscard]] LimitsReached reached(const PointState& point) const;

  CellCalls<dim> calls_;
  std::optional<CosseratParameters> cosserat_;
  PointsAtLimits at_limits_;
  PackingAtStart<dim> packing_;
  GroundStart<dim> ground_;
  double mean_radius_ = 0.0;  ///< of the grains, m; 0: their rotations are free
  std::vector<std::string> notes_;
  int stress_alone_ = 0;  ///< evaluations of a step that ask for stress alone (CellTangent::secant)
  int evaluations_ = 0;   ///< of this step
  std::vector<PointState> committed_;
  std::vector<PointState> trial_;
};

}  // namespace polargrain::coupler
