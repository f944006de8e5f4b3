// SPDX-License-Identifier: GPL-2.0-or-later
#pragma once
#include <string>
#include <vector>

#include "fem/material/elastoplastic.hpp"
#include "fem/material/material.hpp"
#include "fem/material/slip_driven.hpp"

namespace polargrain::fem {

/// Faults of the parameters beyond those of the law itself: only the default weights have a return in closed form.
template <int dim>
std::vector<std::string> slip_faults(const ElastoplasticParameters<dim>& parameters);

/// The cone of ElastoplasticLaw, whose plastic multiplier is given from outside: backward Euler in closed form,
///
///     q = q_trial - 3 G dg,   p = p_trial - K M_psi dg,   drive F = q + M_phi p - k   (docs/theory/plasticity.md, B.4).
///
/// Where neighbours bring more slip than the deviator can take, q is 0; the tangent then has the share of the elastic stiffness that
/// an apex has. The cone has no apex under tension. Small deformation.
template <int dim>
class SlipDrivenCone final : public Material<dim>, public SlipDriven<dim> {
 public:
  using Vector = typename Cosserat<dim>::Vector;

  /// @throws RunError with all faults of the parameters
  explicit SlipDrivenCone(const ElastoplasticParameters<dim>& parameters);

  void allocate(std::size_t points) override;
  void set_initial_stress(std::size_t point, const Vector& stress) override;
  [[nodiscard]] bool can_turn() const override { return true; }
  /// In explicit steps its stress has some damping (kDampingOfSteps).
  void expect(const Asking& asking) override { is_explicit_ = asking.once; }
  void evaluate(std::span<const Increment<dim>> increments, std::span<Response<dim>> responses) override;
  void commit() override;
  void revert() override;
  void save(ArchiveWriter& archive) const override;
  void restore(ArchiveReader& archive) override;
  /// plastic_shear: the slip; drive: F over the sum of its absolute terms, from -1 to about 0
  [[nodiscard]] std::vector<std::string> field_names() const override { return {"plastic_shear", "drive"}; }
  void fields(std::size_t point, std::span<double> values) const override;

  void set_slips(std::span<const double> increments) override;
  [[nodiscard]] std::span<const SlipAnswer<dim>> slip_answers() const override { return trial_answers_; }
  [[nodiscard]] bool is_explicit() const override { return is_explicit_; }
  [[nodiscard]] double slip_stiffness() const override { return 3.0 * frame_.moduli.shear(); }

 private:
  bool is_explicit_ = false;  ///< the steps are explicit
  struct State {
    ScaledVector<double, dim> stress;  ///< scaled, Pa
    double slip;                       ///< gamma_p
  };
  [[nodiscard]] State state_of(const Vector& stress) const;
  void answer(const State& start, const Vector& strain, double slip, State& end, Response<dim>& response,
              SlipAnswer<dim>& answer) const;

  ElastoplasticFrame<dim> frame_;
  HardeningCone cone_;
  Vector scale_;  ///< scaled strain over strain, and stress over scaled stress
  Vector initial_stress_;
  std::vector<State> committed_, trial_;
  std::vector<SlipAnswer<dim>> answers_, trial_answers_;
  std::vector<double> slips_;  ///< growth over the step
};

}  // namespace polargrain::fem
