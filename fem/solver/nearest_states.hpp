// SPDX-License-Identifier: GPL-2.0-or-later
#pragma once
#include <vector>

#include "common/archive.hpp"
#include "common/cosserat.hpp"

namespace polargrain::fem {

/// The integration points of a run, for another run that starts from its end.
template <int dim>
struct PointsOfRun {
  std::vector<typename Cosserat<dim>::Place> places;
  std::vector<std::size_t> materials;  ///< number of the material of each point, in the order of the regions
};

template <int dim>
void write_points(ArchiveWriter& archive, const PointsOfRun<dim>& points);
/// @throws RunError where the archive holds none, or those of another dimension
template <int dim>
PointsOfRun<dim> read_points(ArchiveReader& archive);

/// For each place the number of the nearest one of `among`; of two as near, the first.
template <int dim>
std::vector<std::size_t> nearest_places(const std::vector<typename Cosserat<dim>::Place>& places,
                                        const std::vector<typename Cosserat<dim>::Place>& among);

/// Reads arrays that hold as many values for each of `count` points, and gives those of the points `from` in their order.
class GatheringReader : public ArchiveReader {
 public:
  /// All must outlive this object.
  GatheringReader(ArchiveReader& archive, std::size_t count, const std::vector<std::size_t>& from)
      : archive_(archive), count_(count), from_(from) {}
  /// @throws RunError where the array is of another length
  [[nodiscard]] std::vector<double> doubles(const std::string& name) override;
  [[nodiscard]] std::vector<std::int64_t> integers(const std::string& name) override;
  [[nodiscard]] std::vector<StatePointer> states(const std::string& name) override;

 private:
  template <class Value>
  std::vector<Value> gathered(const std::string& name, const std::vector<Value>& all) const;

  ArchiveReader& archive_;
  std::size_t count_;
  const std::vector<std::size_t>& from_;
};

}  // namespace polargrain::fem
