// SPDX-License-Identifier: GPL-2.0-or-later
#pragma once
#include <optional>
#include <span>
#include <string>
#include <utility>
#include <vector>

#include "coupler/cells/cell_calls.hpp"
#include "coupler/cells/cosserat_part.hpp"
#include "coupler/cells/grains_of_points.hpp"
#include "coupler/cells/own_answer.hpp"
#include "coupler/cells/points_at_limits.hpp"
#include "fem/material/elastoplastic.hpp"
#include "fem/material/material.hpp"
#include "fem/material/mobilisation.hpp"

namespace polargrain::coupler {

/// When the cells are asked.
enum class InformedUpdate {
  frozen,      ///< once a committed step, for the cone of the next one: first order in the step
  fixed_point  ///< in every evaluation, for the cone of this step: a cell call a Newton iteration
};

/// The consequence where law and cell disagree by more than the limit.
enum class BeyondMismatch {
  tell,  ///< the run goes on with the law, and says so
  cell   ///< from the next step on the point's stress and tangent are those of its cell, for good
};

template <int dim>
struct InformedParameters {
  fem::ElasticParameters<dim> elastic;  ///< of the law; its initial stress is that of the packing
  /// Of the law's invariant. Nothing: the standard ones, or, with controlled rotations, those of the cell (cell_limits.hpp).
  std::optional<fem::InvariantWeights> weights = {};
  /// lp of grains whose rotations are free, m: the law yields at couple stresses of lp times the pressure, whatever its
  /// friction. Nothing: the weights say where.
  std::optional<double> plastic_length = {};
  /// Of grains whose rotations are free: the skew stress of the law is at most so many times its pressure in the plane.
  std::optional<double> skew_limit = {};
  fem::MobilisationOptions mobilisation;
  InformedUpdate update = InformedUpdate::frozen;
  /// Of grains whose rotations are controlled, m: their skew and couple stresses inform the law too. 0: they are free.
  double mean_diameter = 0.0;
  /// Mismatch of law and cell (field stress_mismatch) beyond which a point's stress is no longer its grains'.
  double mismatch_limit = 0.3;
  BeyondMismatch beyond_mismatch = BeyondMismatch::tell;

  /// Takes over the moduli of G, Gc and lc, lp, and the limit of the skew stress; Poisson's ratio must be set.
  void set_moduli(const CosseratParameters& cosserat);
};

/// The generalised elastoplastic Cosserat material (docs/theory/plasticity.md, B.9): at each point a
/// closed-form law carries the stress, and a cell that follows the point's strain tells it friction and
/// dilatancy. A cell with controlled rotations follows micro-rotation and curvature too; its limits of skew and couple
/// stress are the law's weights, and friction is read from its whole stress. The disagreement of law and cell is shown
/// as the field stress_mismatch; where it is too large a point may go over to its cell's answer (own_answer.hpp).
template <int dim>
class InformedMaterial : public fem::Material<dim>, public GrainsOfPoints {
 public:
  /// @param calls must live as long as the material
  /// @param note remarks to the user on the parameters; may be empty
  /// @param with_tangent the same cells, answering with tangents; asked only with BeyondMismatch::cell
  InformedMaterial(CellCalls<dim> calls, const InformedParameters<dim>& parameters,
                   const std::string& note = {}, CellCalls<dim> with_tangent = {});

  [[nodiscard]] double moment_length() const override { return parameters_.mean_diameter; }
  /// Every point starts from the packing at rest, which is first taken to its limits where the weights are its own; where the cell has no out-of-plane stress, from the mean of
  /// the two others.
  void allocate(std::size_t points) override;
  void evaluate(std::span<const Increment<dim>> increments, std::span<Response<dim>> responses) override;
  /// Frozen: the cells now follow the step. One that has no good answer follows it in halves, quarters, ...
  /// @throws RunError when sixteenths fail too, and where law and cell disagree by more than they may.
  void commit() override;
  void revert() override { trial_ = committed_; }
  void save(ArchiveWriter& archive) const override;
  void restore(ArchiveReader& archive) override;

  /// friction, dilatancy (M_phi, M_psi of the cone), dilatancy_limited (1: a limit acts), plastic_shear,
  /// regime, stress_mismatch, with BeyondMismatch::cell stress_of_cell (1: the point goes by its cell's own answer), and
  /// of the cell void_ratio, coordination_number, unbalanced_force_ratio,
  /// sliding_fraction, dem_steps.
  [[nodiscard]] std::vector<std::string> field_names() const override;
  void fields(std::size_t point, std::span<double> values) const override;
  [[nodiscard]] StatePointer grains_of(std::size_t point) const override {
    return committed_[point].cell.state;
  }
  /// stress_mismatch_mean, stress_mismatch_percentile_95, stress_mismatch_largest over the points of the last
  /// committed step, and dilatancy_limited: the share of them where a limit acts; with BeyondMismatch::cell
  /// stress_of_cell: the share that goes by the answers of their cells.
  [[nodiscard]] std::vector<fem::Figure> figures() const override;
  /// At how many points that go by their law it has left its cell, and by how much at the worst.
  [[nodiscard]] std::string doubt() const override;
  [[nodiscard]] std::string at_limits() const override { return at_limits_.text(); }
  /// Remarks of the engine on the packing and its script, and that a law has left its cell; once.
  [[nodiscard]] std::vector<std::string> take_notes() override { return std::exchange(notes_, {}); }

 private:
  using Vector = typename Cosserat<dim>::Vector;

  struct PointState {
    fem::ElastoplasticState<dim> law;
    fem::Mobilisation<dim> mobilisation;
    /// The law takes a change of friction up in a straight line over the plastic shear of the step before:
    /// from `held_friction` at the start of the step to that of the cone `take_up` later.
    double held_friction = 0.0;
    double take_up = 0.0;
    PointReply<dim> cell;  ///< its last answer, with its state
    OwnAnswer<dim> own;    ///< active: the law has been left, and holds the stress of the point
  };

  template <class Visitor>
  static void visit_numbers(Visitor& visit, PointState& point, int window);
  /// Elastic constants and weights of a point's law in this step.
  [[nodiscard]] fem::ElastoplasticFrame<dim> frame_of(std::size_t point) const;
  [[nodiscard]] Response<dim> integrate(std::size_t point, const Increment<dim>& increment);
  /// A step inside of the cone, or back to it, with the stiffness and contraction that the cell shows there.
  [[nodiscard]] Response<dim> integrate_unloading(const fem::ElastoplasticFrame<dim>& frame,
                                                  const fem::Mobilisation<dim>& mobilisation,
                                                  const fem::ElastoplasticState<dim>& start,
                                                  const Increment<dim>& increment,
                                                  fem::ElastoplasticState<dim>& end) const;
  /// The standard invariant leaves skew stress elastic: it returns to its limit behind the law, which goes by the same limit
  /// as the part of a cell (cosserat_part.hpp).
  void limit_skew_of_laws(std::span<Response<dim>> responses);
  /// Skew and couple stress of a point with free rotations, for its mobilisation.
  [[nodiscard]] CosseratPart<dim> cosserat_part_of(const PointState& point) const;
  [[nodiscard]] LimitsReached reached(const PointState& point) const;
  void count_limits();
  void evaluate_frozen(std::span<const Increment<dim>> increments, std::span<Response<dim>> responses);
  void evaluate_fixed_point(std::span<const Increment<dim>> increments, std::span<Response<dim>> responses);
  /// The points that go by their cells' answers.
  void evaluate_own(std::span<const Increment<dim>> increments, std::span<Response<dim>> responses);
  /// The answer of the law to the stretch of a step, and where it ends, in the axes of the start of the step.
  [[nodiscard]] Response<dim> integrate_stretch(std::size_t point, const Increment<dim>& stretch,
                                                fem::ElastoplasticState<dim>& end) const;
  /// The same with friction and dilatancy of the step itself.
  [[nodiscard]] Response<dim> integrate_updated(std::size_t point, const Increment<dim>& stretch,
                                                const fem::Mobilisation<dim>& mobilisation,
                                                fem::ElastoplasticState<dim>& end) const;
  /// The increment that the grains of a cell feel.
  [[nodiscard]] Increment<dim> felt(const Increment<dim>& increment) const;
  /// Lets the cells follow the increments of the step; puts their answers into `trial_`.
  void follow(const CellCalls<dim>& calls, std::span<const std::size_t> points);
  /// Where law and cell disagree by more than they may, the point goes by its cell from the next step on.
  void leave_laws();
  void take(const PointReply<dim>& reply, const Increment<dim>& increment, std::size_t point);
  /// Norm of the difference of the stresses of law and cell, in the plane the in-plane ones, over that of the law;
  /// controlled rotations: skew stress and couple stress over lc included.
  [[nodiscard]] double mismatch(const PointState& point) const;
  /// Tells, throws, or leaves the law, where it is leaving its cell in the step on trial.
  void watch_mismatch();
  [[nodiscard]] bool has_left_cell(const PointState& point) const;
  [[nodiscard]] std::string left_cells(const std::vector<PointState>& points) const;
  [[nodiscard]] bool controlled() const { return parameters_.mean_diameter > 0.0; }
  [[nodiscard]] bool may_change() const { return parameters_.beyond_mismatch == BeyondMismatch::cell; }
  /// The stress of a point as a law keeps it.
  [[nodiscard]] fem::ScaledVector<double, dim> scaled_stress(const Vector& stress) const;
  /// The strain that the cell feels, and its stress with the one that the law lends it (lent_stress.hpp): scaled; symmetric in the
  /// plane and without curvature and couple stress where rotations are free.
  [[nodiscard]] fem::ScaledVector<double, dim> scaled_strain(const Increment<dim>& stretch) const;
  [[nodiscard]] fem::ScaledVector<double, dim> complete_cell_stress(
      const Vector& cell, const fem::ScaledVector<double, dim>& law) const;

  CellCalls<dim> calls_;
  CellCalls<dim> with_tangent_;
  OwnAnswerRules<dim> own_rules_;
  PointsAtLimits at_limits_;
  bool told_of_mismatch_ = false;
  std::vector<std::string> notes_;
  InformedParameters<dim> parameters_;
  fem::ElastoplasticFrame<dim> frame_;
  std::vector<Increment<dim>> increments_;  ///< of the last evaluation
  std::vector<PointState> committed_;
  std::vector<PointState> trial_;
};

}  // namespace polargrain::coupler
