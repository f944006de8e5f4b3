// SPDX-License-Identifier: GPL-2.0-or-later
#include "coupler/cells/gathered_material.hpp"

#include <utility>

#include "common/error.hpp"
#include "coupler/cells/cell_increment.hpp"
#include "coupler/cells/successive.hpp"

namespace polargrain::coupler {
namespace {

/// How often a material may ask to answer better before it commits; Newton's method has some ten iterations for that.
constexpr int kMostAgain = 10;

/// In small deformation all increments are counted from the shape at the start of the run, and add up.
template <int dim>
Increment<dim> added(const Increment<dim>& way, const Increment<dim>& step) {
  if (step.configuration != Configuration::fixed) return followed_by(way, step);
  Increment<dim> sum = way;
  sum.displacement_gradient += step.displacement_gradient;
  micro_rotation(sum) += micro_rotation(step);
  sum.curvature += step.curvature;
  return sum;
}

}  // namespace

template <int dim>
GatheredMaterial<dim>::GatheredMaterial(std::shared_ptr<fem::Material<dim>> material, int steps)
    : material_(std::move(material)),
      grains_(dynamic_cast<const GrainsOfPoints*>(material_.get())),
      led_(dynamic_cast<fem::BeginsInGround<dim>*>(material_.get())),
      steps_(steps) {
  if (grains_ == nullptr) throw RunError("only steps of materials that show grains are taken together");
  if (steps < 1) throw RunError("at least one step must be taken together");
}

template <int dim>
void GatheredMaterial<dim>::allocate(std::size_t points) {
  material_->allocate(points);
  way_.assign(points, Increment<dim>{});
  trial_ = way_;
  gathered_ = 0;
}

template <int dim>
void GatheredMaterial<dim>::expect(const fem::Asking& asking) {
  if (gathered_ > 0 && !asking.once)
    throw RunError("steps that are taken together must be committed (settle) before iterations go on");
  gathers_ = asking.once;
}

template <int dim>
void GatheredMaterial<dim>::evaluate(std::span<const Increment<dim>> increments,
                                     std::span<Response<dim>> responses) {
  if (!gathers_) return material_->evaluate(increments, responses);
  for (std::size_t point = 0; point < way_.size(); ++point)
    trial_[point] = added(way_[point], increments[point]);
  material_->evaluate(trial_, responses);
  was_dropped_ = false;
}

template <int dim>
void GatheredMaterial<dim>::commit() {
  if (!gathers_) return material_->commit();
  way_ = trial_;
  if (++gathered_ == steps_) settle();
}

template <int dim>
void GatheredMaterial<dim>::revert() {
  if (!gathers_) return material_->revert();
  trial_ = way_;
  material_->revert();
  was_dropped_ = true;
}

template <int dim>
void GatheredMaterial<dim>::settle() {
  if (gathered_ == 0) return;
  std::vector<Response<dim>> answers(way_.size());
  if (was_dropped_) material_->evaluate(way_, answers);  // it evaluated another way last
  was_dropped_ = false;
  // Better answers to the same way are felt from the next step on.
  for (int again = 0; again < kMostAgain && !material_->confirm(); ++again)
    material_->evaluate(way_, answers);
  material_->commit();
  way_.assign(way_.size(), Increment<dim>{});
  trial_ = way_;
  gathered_ = 0;
}

template <int dim>
void GatheredMaterial<dim>::save(ArchiveWriter& archive) const {
  if (gathered_ > 0)
    throw RunError("steps that are taken together must be committed (settle) before they are saved");
  material_->save(archive);
}

template <int dim>
void GatheredMaterial<dim>::restore(ArchiveReader& archive) {
  material_->restore(archive);
  way_.assign(way_.size(), Increment<dim>{});
  trial_ = way_;
  gathered_ = 0;
}

template class GatheredMaterial<2>;
template class GatheredMaterial<3>;

}  // namespace polargrain::coupler
