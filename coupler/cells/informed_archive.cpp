// SPDX-License-Identifier: GPL-2.0-or-later
// What an informed material leaves behind: the numbers of its laws and the states of its cells in a checkpoint, and figures.
#include <algorithm>
#include <cmath>

#include "common/packed_values.hpp"
#include "common/record_archive.hpp"
#include "coupler/cells/informed_material.hpp"

namespace polargrain::coupler {
namespace {

/// Walks over the numbers of a point, writing or reading them.
struct Packer {
  std::vector<double>& values;
  void operator()(double& value) const { values.push_back(value); }
};
struct Unpacker {
  std::span<const double> values;
  std::size_t next = 0;
  void operator()(double& value) { value = values[next++]; }
};

/// Through a double: exact for flags, and for counts below 2^53.
template <class Visitor, class Whole>
void visit_whole(Visitor& visit, Whole& whole) {
  auto value = static_cast<double>(whole);
  visit(value);
  whole = static_cast<Whole>(value);
}

template <class Visitor, class Vector>
void visit_vector(Visitor& visit, Vector& vector) {
  for (Eigen::Index i = 0; i < vector.size(); ++i) visit(vector(i));
}

template <class Visitor, class Sample>
void visit_samples(Visitor& visit, std::vector<Sample>& samples, int window) {
  std::size_t count = samples.size();
  visit_whole(visit, count);
  samples.resize(static_cast<std::size_t>(window) + 1);  // always as many values a point
  for (Sample& sample : samples) {
    visit(sample.deformation);
    visit_vector(visit, sample.plastic_strain);
  }
  samples.resize(count);
}

}  // namespace

/// All numbers of law and mobilisation, always in the same order and as many.
template <int dim>
template <class Visitor>
void InformedMaterial<dim>::visit_numbers(Visitor& visit, PointState& point, int window) {
  visit_vector(visit, point.law.scaled_stress);
  visit(point.law.gamma_p);
  visit(point.held_friction);
  visit(point.take_up);
  visit_whole(visit, point.law.regime);
  fem::Mobilisation<dim>& m = point.mobilisation;
  for (double* value : {&m.cone.friction, &m.cone.dilatancy, &m.cone.cohesion, &m.micro_friction})
    visit(*value);
  visit_whole(visit, m.limited);
  visit_samples(visit, m.samples, window);
  bool unloaded = m.unloading.has_value();
  fem::UnloadingMode unloading = m.unloading.value_or(fem::UnloadingMode{});
  visit_whole(visit, unloaded);
  visit(unloading.stiffness);
  visit(unloading.contraction);
  m.unloading = unloaded ? std::optional(unloading) : std::nullopt;
}

template <int dim>
void InformedMaterial<dim>::save(ArchiveWriter& archive) const {
  std::vector<double> values;
  std::vector<PointReply<dim>> cells;
  std::vector<OwnAnswer<dim>> own;
  for (PointState point : committed_) {
    Packer pack{values};
    visit_numbers(pack, point, parameters_.mobilisation.window);
    cells.push_back(point.cell);
    own.push_back(point.own);
  }
  archive.write("laws", std::span<const double>(values));
  if (may_change()) write_records(archive, "own", std::span<const OwnAnswer<dim>>(own));
  write_records(archive, "cells", std::span<const PointReply<dim>>(cells));
  at_limits_.save(archive);
}

template <int dim>
void InformedMaterial<dim>::restore(ArchiveReader& archive) {
  std::vector<double> one;
  Packer pack{one};
  PointState any;
  visit_numbers(pack, any, parameters_.mobilisation.window);
  const std::size_t length = one.size();
  const std::vector<double> values = read_lists(archive, "laws", committed_.size(), length);
  std::vector<PointReply<dim>> cells = read_records<PointReply<dim>>(archive, "cells", committed_.size());
  for (std::size_t point = 0; point < committed_.size(); ++point) {
    Unpacker unpack{std::span(values).subspan(point * length, length)};
    visit_numbers(unpack, committed_[point], parameters_.mobilisation.window);
    committed_[point].cell = std::move(cells[point]);
  }
  if (may_change()) {
    const std::vector<OwnAnswer<dim>> own = read_records<OwnAnswer<dim>>(archive, "own", committed_.size());
    for (std::size_t point = 0; point < committed_.size(); ++point) committed_[point].own = own[point];
  }
  trial_ = committed_;
  at_limits_.restore(archive);
}

template <int dim>
std::vector<fem::Figure> InformedMaterial<dim>::figures() const {
  if (committed_.empty()) return {};
  std::vector<double> mismatches;
  double sum = 0.0;
  double limited = 0.0;
  double by_cell = 0.0;
  for (const PointState& point : committed_) {
    mismatches.push_back(mismatch(point));
    sum += mismatches.back();
    if (point.mobilisation.limited) limited += 1.0;
    if (point.own.active) by_cell += 1.0;
  }
  std::sort(mismatches.begin(), mismatches.end());
  const auto count = static_cast<double>(mismatches.size());
  const auto rank = static_cast<std::size_t>(std::ceil(0.95 * count)) - 1;
  std::vector<fem::Figure> figures{{"stress_mismatch_mean", sum / count},
                                   {"stress_mismatch_percentile_95", mismatches[rank]},
                                   {"stress_mismatch_largest", mismatches.back()},
                                   {"dilatancy_limited", limited / count}};
  if (may_change()) figures.push_back({"stress_of_cell", by_cell / count});
  const std::vector<fem::Figure> at_limits = at_limits_.figures();
  figures.insert(figures.end(), at_limits.begin(), at_limits.end());
  return figures;
}

template class InformedMaterial<2>;
template class InformedMaterial<3>;

}  // namespace polargrain::coupler
