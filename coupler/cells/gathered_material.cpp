// SPDX-License-Identifier: GPL-2.0-or-later
#include "coupler/cells/gathered_material.hpp"

#include <utility>

#include "common/error.hpp"
#include "coupler/cells/successive.hpp"

namespace polargrain::coupler {
namespace {

/// How often a material may ask to answer better before it commits; Newton's method has some ten iterations for that.
constexpr int kMostAgain = 10;

/// In small deformation all increments are counted from the shape at the start of the run, and add up.
Increment<2> added(const Increment<2>& way, const Increment<2>& step) {
  if (step.configuration != Configuration::fixed) return followed_by(way, step);
  Increment<2> sum = way;
  sum.displacement_gradient += step.displacement_gradient;
  sum.micro_rotation += step.micro_rotation;
  sum.curvature += step.curvature;
  return sum;
}

}  // namespace

GatheredMaterial::GatheredMaterial(std::shared_ptr<fem::Material<2>> material, int steps)
    : material_(std::move(material)),
      grains_(dynamic_cast<const GrainsOfPoints*>(material_.get())),
      steps_(steps) {
  if (grains_ == nullptr) throw RunError("only steps of materials that show grains are taken together");
  if (steps < 1) throw RunError("at least one step must be taken together");
}

void GatheredMaterial::allocate(std::size_t points) {
  material_->allocate(points);
  way_.assign(points, Increment<2>{});
  trial_ = way_;
  gathered_ = 0;
}

void GatheredMaterial::expect(const fem::Asking& asking) {
  if (gathered_ > 0 && !asking.once)
    throw RunError("steps that are taken together must be committed (settle) before iterations go on");
  gathers_ = asking.once;
}

void GatheredMaterial::evaluate(std::span<const Increment<2>> increments, std::span<Response<2>> responses) {
  if (!gathers_) return material_->evaluate(increments, responses);
  for (std::size_t point = 0; point < way_.size(); ++point)
    trial_[point] = added(way_[point], increments[point]);
  material_->evaluate(trial_, responses);
  was_dropped_ = false;
}

void GatheredMaterial::commit() {
  if (!gathers_) return material_->commit();
  way_ = trial_;
  if (++gathered_ == steps_) settle();
}

void GatheredMaterial::revert() {
  if (!gathers_) return material_->revert();
  trial_ = way_;
  material_->revert();
  was_dropped_ = true;
}

void GatheredMaterial::settle() {
  if (gathered_ == 0) return;
  std::vector<Response<2>> answers(way_.size());
  if (was_dropped_) material_->evaluate(way_, answers);  // it evaluated another way last
  was_dropped_ = false;
  // Better answers to the same way are felt from the next step on.
  for (int again = 0; again < kMostAgain && !material_->confirm(); ++again)
    material_->evaluate(way_, answers);
  material_->commit();
  way_.assign(way_.size(), Increment<2>{});
  trial_ = way_;
  gathered_ = 0;
}

void GatheredMaterial::save(ArchiveWriter& archive) const {
  if (gathered_ > 0)
    throw RunError("steps that are taken together must be committed (settle) before they are saved");
  material_->save(archive);
}

void GatheredMaterial::restore(ArchiveReader& archive) {
  material_->restore(archive);
  way_.assign(way_.size(), Increment<2>{});
  trial_ = way_;
  gathered_ = 0;
}

}  // namespace polargrain::coupler
