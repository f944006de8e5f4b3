// SPDX-License-Identifier: GPL-2.0-or-later
#include "fem/solver/point_materials.hpp"

#include <fmt/format.h>

#include <algorithm>

#include "common/error.hpp"
#include "common/prefixed_archive.hpp"
#include "fem/material/begins_in_ground.hpp"
#include "fem/solver/stages.hpp"

namespace polargrain::fem {

template <int dim>
PointMaterials<dim>::PointMaterials(const Problem<dim>& problem, const Discretisation<dim>& discretisation)
    : at_(discretisation.points()) {
  std::vector<std::size_t> batch_of_element(discretisation.elements());
  for (const auto& [region, material] : problem.materials) {
    if (!material) throw RunError(fmt::format("the region '{}' has no material", region));
    auto batch = std::find_if(batches_.begin(), batches_.end(),
                              [&](const Batch& other) { return other.material == material; });
    if (batch == batches_.end()) batch = batches_.insert(batches_.end(), Batch{material, {}, {}, {}});
    for (const int e : problem.mesh.regions.at(region)) {
      batch_of_element[static_cast<std::size_t>(e)] = static_cast<std::size_t>(batch - batches_.begin());
    }
  }
  for (std::size_t point = 0; point < discretisation.points(); ++point) {
    Batch& batch =
        batches_[batch_of_element[static_cast<std::size_t>(discretisation.element_of_point(point))]];
    at_[point] = {batch.material.get(), batch.points.size()};
    batch.points.push_back(point);
  }
  for (Batch& batch : batches_) {
    batch.material->allocate(batch.points.size());
    batch.increments.resize(batch.points.size());
    batch.responses.resize(batch.points.size());
  }
  set_initial_stresses(problem, discretisation);
}

template <int dim>
void PointMaterials<dim>::set_initial_stresses(const Problem<dim>& problem,
                                               const Discretisation<dim>& discretisation) {
  // The ground of time zero: a part that a stage places has a stress where an item names its region.
  std::vector<char> at_start = elements_in_stage(problem, 0);
  if (at_start.empty()) at_start.assign(discretisation.elements(), 1);
  for (const InitialStress<dim>& item : problem.initial_stresses) {
    std::vector<char> here = at_start;
    if (!item.region.empty()) {
      here.assign(discretisation.elements(), 0);
      for (const int e : problem.mesh.regions.at(item.region)) here[static_cast<std::size_t>(e)] = 1;
    }
    for (Batch& batch : batches_) {
      for (std::size_t i = 0; i < batch.points.size(); ++i) {
        const std::size_t point = batch.points[i];
        if (here[static_cast<std::size_t>(discretisation.element_of_point(point))] == 0) continue;
        const typename Cosserat<dim>::Vector stress = item.stress(discretisation.point(point).position);
        if (auto* const led = dynamic_cast<BeginsInGround<dim>*>(batch.material.get()))
          led->set_ground_stress(i, stress);
        else
          batch.material->set_initial_stress(i, stress);
      }
    }
  }
}

template <int dim>
void PointMaterials<dim>::expect(const Asking& asking) {
  for (Batch& batch : batches_)
    if (auto* const led = dynamic_cast<BeginsInGround<dim>*>(batch.material.get())) led->begin_in_ground();
  for (Batch& batch : batches_) batch.material->expect(asking);
}

template <int dim>
void PointMaterials<dim>::evaluate(const std::vector<Increment<dim>>& increments,
                                   std::vector<Response<dim>>& responses) {
  for (Batch& batch : batches_) {
    for (std::size_t i = 0; i < batch.points.size(); ++i) batch.increments[i] = increments[batch.points[i]];
    batch.material->evaluate(batch.increments, batch.responses);
    for (std::size_t i = 0; i < batch.points.size(); ++i) responses[batch.points[i]] = batch.responses[i];
  }
}

template <int dim>
bool PointMaterials<dim>::can_turn() const {
  return std::ranges::all_of(batches_, [](const Batch& batch) { return batch.material->can_turn(); });
}

template <int dim>
double PointMaterials<dim>::moment_length(double otherwise) const {
  double least = otherwise;
  for (const Batch& batch : batches_)
    if (const double own = batch.material->moment_length(); own > 0.0) least = std::min(least, own);
  return least;
}

template <int dim>
bool PointMaterials<dim>::confirm() {
  bool all = true;
  for (Batch& batch : batches_) all = batch.material->confirm() && all;
  return all;
}

template <int dim>
void PointMaterials<dim>::settle() {
  for (Batch& batch : batches_) batch.material->settle();
}

template <int dim>
Unrest PointMaterials<dim>::unrest() const {
  Unrest all;
  for (const Batch& batch : batches_) {
    const Unrest one = batch.material->unrest();
    all.sum += one.sum;
    all.points += one.points;
    all.hot += one.hot;
  }
  return all;
}

template <int dim>
void PointMaterials<dim>::commit() {
  for (Batch& batch : batches_) batch.material->commit();
}

template <int dim>
void PointMaterials<dim>::revert() {
  for (Batch& batch : batches_) batch.material->revert();
}

template <int dim>
void PointMaterials<dim>::save(ArchiveWriter& archive) const {
  for (std::size_t b = 0; b < batches_.size(); ++b) {
    PrefixedWriter own(archive, fmt::format("{}/", b));
    batches_[b].material->save(own);
  }
}

template <int dim>
void PointMaterials<dim>::restore(ArchiveReader& archive) {
  for (std::size_t b = 0; b < batches_.size(); ++b) {
    PrefixedReader own(archive, fmt::format("{}/", b));
    batches_[b].material->restore(own);
  }
}

template <int dim>
std::size_t PointMaterials<dim>::number_of(const std::shared_ptr<Material<dim>>& material) const {
  const auto batch = std::ranges::find(batches_, material, &Batch::material);
  return static_cast<std::size_t>(batch - batches_.begin());
}

template <int dim>
TakenOver PointMaterials<dim>::take_over(ArchiveReader& archive, std::size_t from, std::size_t count,
                                         std::size_t material, std::span<const PointMean> means) {
  PrefixedReader own(archive, fmt::format("{}/", from));
  return batches_[material].material->take_over(own, count, means);
}

template class PointMaterials<2>;
template class PointMaterials<3>;

}  // namespace polargrain::fem
