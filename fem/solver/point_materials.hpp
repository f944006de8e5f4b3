// SPDX-License-Identifier: GPL-2.0-or-later
#pragma once
#include <memory>
#include <span>
#include <string>
#include <utility>
#include <vector>

#include "fem/solver/discretisation.hpp"
#include "fem/solver/problem.hpp"

namespace polargrain::fem {

/// The materials of a problem, each with the points that are made of it.
template <int dim>
class PointMaterials {
 public:
  /// Allocates the states and sets initial stresses.
  /// @throws RunError when a material is null or takes no initial stress where one is given.
  PointMaterials(const Problem<dim>& problem, const Discretisation<dim>& discretisation);

  /// See Material::expect.
  void expect(const Asking& asking);
  /// One response a point, in the order of the discretisation.
  void evaluate(const std::vector<Increment<dim>>& increments, std::vector<Response<dim>>& responses);
  [[nodiscard]] bool can_turn() const;
  /// The least length of the materials (Material::moment_length); `otherwise` where no material has one.
  [[nodiscard]] double moment_length(double otherwise) const;
  /// Whether all materials stand by their answers (Material::confirm).
  [[nodiscard]] bool confirm();
  void settle();
  /// Sums over the materials.
  [[nodiscard]] Unrest unrest() const;
  void commit();
  void revert();
  /// The committed states of all materials, each under a number of its own.
  void save(ArchiveWriter& archive) const;
  void restore(ArchiveReader& archive);
  /// Number of a material, in the order of the regions that come first.
  [[nodiscard]] std::size_t number_of(const std::shared_ptr<Material<dim>>& material) const;
  [[nodiscard]] std::size_t count() const { return batches_.size(); }
  /// Numbers of the points of a material, in the order of its states.
  [[nodiscard]] const std::vector<std::size_t>& points_of(std::size_t material) const {
    return batches_[material].points;
  }
  /// See Material::take_over. @param archive of save, of all materials of the other run; `from` is the number there
  TakenOver take_over(ArchiveReader& archive, std::size_t from, std::size_t count, std::size_t material,
                      std::span<const PointMean> means);

  [[nodiscard]] std::pair<const Material<dim>*, std::size_t> at(std::size_t point) const {
    return at_[point];
  }

 private:
  /// One batch a material, not one a region, so that a material sees all its points at once.
  struct Batch {
    std::shared_ptr<Material<dim>> material;
    std::vector<std::size_t> points;
    std::vector<Increment<dim>> increments;
    std::vector<Response<dim>> responses;
  };
  void set_initial_stresses(const Problem<dim>& problem, const Discretisation<dim>& discretisation);

  std::vector<Batch> batches_;
  std::vector<std::pair<const Material<dim>*, std::size_t>> at_;
};

}  // namespace polargrain::fem
