// SPDX-License-Identifier: GPL-2.0-or-later
#pragma once
#include <memory>
#include <string>
#include <vector>

#include "fem/material/material.hpp"
#include "fem/material/slip_driven.hpp"

namespace polargrain::fem {

/// Any material, whose slip is given from outside, although it is known by its answers alone (docs/theory/spread.md).
/// It feels the whole strain and answers with a stress s. Along a direction n of shear the body bears another shear stress, which
/// is elastic but for the slip g:
///
///     T = s + 2 F n,   dF = G (2 n:d eps - sqrt(3) dg) - n:ds,   n:n = 1/2,
///
/// with G of the first tangent, that at rest. sqrt(3) F is the drive (q and its slip, as of a cone): where it vanishes T is s. All
/// other parts of T are those of s, so that dilation comes with the strain. n is the deviator (in the plane that of the plane) of the strain since the start, so that
/// no shear of a band is left to s alone; or that of s, where the two are far apart (n:n' of less than 0.35). Where the deviator
/// of s is below a tenth of the mean stress n is not known, and F is 0. In large deformation all of it turns with the material.
template <int dim>
class SlipDrivenMaterial : public Material<dim>, public SlipDriven<dim> {
 public:
  using Vector = typename Cosserat<dim>::Vector;

  /// @param material not null
  explicit SlipDrivenMaterial(std::shared_ptr<Material<dim>> material);

  void allocate(std::size_t points) override;
  void set_initial_stress(std::size_t point, const Vector& stress) override;
  [[nodiscard]] bool can_turn() const override { return material_->can_turn(); }
  [[nodiscard]] double moment_length() const override { return material_->moment_length(); }
  void expect(const Asking& asking) override {
    is_explicit_ = asking.once;
    material_->expect(asking);
  }
  /// In explicit steps the material is asked the first time alone.
  void evaluate(std::span<const Increment<dim>> increments, std::span<Response<dim>> responses) override;
  [[nodiscard]] bool confirm() override { return material_->confirm(); }
  void settle() override { material_->settle(); }
  [[nodiscard]] Unrest unrest() const override { return material_->unrest(); }
  void commit() override;
  void revert() override;
  void save(ArchiveWriter& archive) const override;
  void restore(ArchiveReader& archive) override;
  /// The names of the material end with given_slip (g) and drive, which is over the sum of its absolute terms: from -1 to about 0.
  [[nodiscard]] std::vector<std::string> field_names() const override;
  void fields(std::size_t point, std::span<double> values) const override;
  [[nodiscard]] std::vector<Figure> figures() const override { return material_->figures(); }
  [[nodiscard]] std::string doubt() const override { return material_->doubt(); }
  [[nodiscard]] std::vector<std::string> take_notes() override { return material_->take_notes(); }

  void set_slips(std::span<const double> increments) override;
  [[nodiscard]] std::span<const SlipAnswer<dim>> slip_answers() const override { return trial_answers_; }
  [[nodiscard]] bool is_explicit() const override { return is_explicit_; }
  /// 3 G at rest; 0 before the first evaluation.
  [[nodiscard]] double slip_stiffness() const override;

 private:
  struct State {
    Vector stress = Vector::Zero();  ///< s, Pa
    Vector strain = Vector::Zero();  ///< since the start
    double overstress = 0.0;         ///< F, Pa
    double slip = 0.0;               ///< g
    double stiffness = 0.0;          ///< G, Pa
  };
  /// @param start the committed state in the axes of the end of the step, in which the strain is too
  void answer(std::size_t point, const State& start, const Vector& strain, Response<dim>& response);

  std::shared_ptr<Material<dim>> material_;
  bool is_at_rest_ = true;    ///< nothing was evaluated yet
  bool is_explicit_ = false;  ///< the steps are explicit
  std::vector<Response<dim>>
      asked_;  ///< then: answers of the material in this step; empty: it was not asked yet
  std::vector<State> committed_, trial_;
  std::vector<SlipAnswer<dim>> answers_, trial_answers_;
  std::vector<double> slips_;  ///< growth over the step
};

}  // namespace polargrain::fem
