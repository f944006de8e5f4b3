// SPDX-License-Identifier: GPL-2.0-or-later
#include "fem/solver/nearest_states.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "common/error.hpp"

namespace polargrain::fem {

template <int dim>
void write_points(ArchiveWriter& archive, const PointsOfRun<dim>& points) {
  std::vector<double> places;
  for (const auto& place : points.places) places.insert(places.end(), place.begin(), place.end());
  const std::vector<std::int64_t> materials(points.materials.begin(), points.materials.end());
  archive.write("places", std::span<const double>(places));
  archive.write("materials_of_points", std::span<const std::int64_t>(materials));
}

template <int dim>
PointsOfRun<dim> read_points(ArchiveReader& archive) {
  const std::vector<double> places = archive.doubles("places");
  const std::vector<std::int64_t> materials = archive.integers("materials_of_points");
  if (materials.empty() || places.size() != dim * materials.size())
    throw RunError("it holds no integration points of this dimension");
  PointsOfRun<dim> points;
  for (std::size_t i = 0; i < materials.size(); ++i) {
    points.places.emplace_back(Eigen::Map<const typename Cosserat<dim>::Place>(&places[dim * i]));
    points.materials.push_back(static_cast<std::size_t>(materials[i]));
  }
  return points;
}

template <int dim>
std::vector<std::size_t> nearest_places(const std::vector<typename Cosserat<dim>::Place>& places,
                                        const std::vector<typename Cosserat<dim>::Place>& among) {
  // Sorted along the first axis: looking away from a place ends where that axis alone is farther than the nearest one found.
  std::vector<std::size_t> order(among.size());
  for (std::size_t i = 0; i < order.size(); ++i) order[i] = i;
  std::ranges::stable_sort(order, {}, [&](std::size_t i) { return among[i](0); });
  std::vector<std::size_t> nearest;
  for (const auto& place : places) {
    const auto middle =
        std::ranges::lower_bound(order, place(0), {}, [&](std::size_t i) { return among[i](0); });
    double least = HUGE_VAL;
    std::size_t found = 0;
    const auto look = [&](std::size_t i) {
      const double along = among[i](0) - place(0);
      if (along * along > least) return false;
      const double square = (among[i] - place).squaredNorm();
      if (square < least || (square == least && i < found)) least = square, found = i;
      return true;
    };
    for (auto at = middle; at != order.end() && look(*at);) ++at;
    for (auto at = middle; at != order.begin() && look(*(at - 1));) --at;
    nearest.push_back(found);
  }
  return nearest;
}

template <class Value>
std::vector<Value> GatheringReader::gathered(const std::string& name, const std::vector<Value>& all) const {
  if (count_ == 0 || all.size() % count_ != 0)
    throw RunError(fmt::format("'{}' does not hold as many values for each of {} points", name, count_));
  const auto width = static_cast<std::ptrdiff_t>(all.size() / count_);
  std::vector<Value> some;
  for (const std::size_t point : from_) {
    const auto begin = all.begin() + static_cast<std::ptrdiff_t>(point) * width;
    some.insert(some.end(), begin, begin + width);
  }
  return some;
}

std::vector<double> GatheringReader::doubles(const std::string& name) {
  return gathered(name, archive_.doubles(name));
}
std::vector<std::int64_t> GatheringReader::integers(const std::string& name) {
  return gathered(name, archive_.integers(name));
}
std::vector<StatePointer> GatheringReader::states(const std::string& name) {
  return gathered(name, archive_.states(name));
}

template void write_points<2>(ArchiveWriter&, const PointsOfRun<2>&);
template void write_points<3>(ArchiveWriter&, const PointsOfRun<3>&);
template PointsOfRun<2> read_points<2>(ArchiveReader&);
template PointsOfRun<3> read_points<3>(ArchiveReader&);
template std::vector<std::size_t> nearest_places<2>(const std::vector<Eigen::Vector2d>&,
                                                    const std::vector<Eigen::Vector2d>&);
template std::vector<std::size_t> nearest_places<3>(const std::vector<Eigen::Vector3d>&,
                                                    const std::vector<Eigen::Vector3d>&);

}  // namespace polargrain::fem
