// SPDX-License-Identifier: GPL-2.0-or-later
// Regions of a rectangle that end within elements: these have the region of their centre, so that a layer becomes thicker or thinner.
#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <set>
#include <utility>
#include <vector>

#include "app/remarks/kinds.hpp"
#include "fem/mesh/rectangle.hpp"

namespace polargrain::app {
namespace {

/// Whether a place along a rectangle is a side of its elements, or outside.
bool is_side(double place, double size, int elements) {
  constexpr double kRounding = 0.01;  // of an element, as of a patch: 66.7 mm are two thirds of 100 mm
  const double fits = place * elements / size;
  return fits <= kRounding || fits >= elements - kRounding || std::abs(fits - std::round(fits)) <= kRounding;
}

/// The first few elements more with which all places are sides; 0: there is no such number.
int elements_that_fit(const std::vector<double>& places, double size, int elements) {
  constexpr int kMostTimes = 4;
  for (int more = elements + 1; more <= kMostTimes * elements; ++more)
    if (std::ranges::all_of(places, [&](double place) { return is_side(place, size, more); })) return more;
  return 0;
}

struct Extent {
  const coupler::Entry::Member* region;
  Eigen::Vector2d low, high;
};

/// Of the rectangle of a case; empty without regions.
std::vector<Extent> extents_of(const Scene& scene) {
  std::vector<Extent> extents;
  const coupler::Entry* const regions = scene.find({"mesh", "rectangle", "regions"});
  if (regions == nullptr) return extents;
  for (const coupler::Entry::Member& member : regions->members) {
    Extent& extent = extents.emplace_back(Extent{&member, {}, {}});
    for (const int i : {0, 1}) {
      const auto end = [&](int number) {
        return *coupler::parse_quantity(member.value.items[static_cast<std::size_t>(number)].text,
                                        coupler::Dimension::length);
      };
      extent.low(i) = end(i);
      extent.high(i) = end(2 + i);
    }
  }
  return extents;
}

fem::RectangleSpecification rectangle_of(const Scene& scene) {
  const coupler::Entry& rectangle = *scene.find({"mesh", "rectangle"});
  fem::RectangleSpecification found{};
  for (const std::size_t i : {0U, 1U}) {
    found.size[i] =
        *coupler::parse_quantity(rectangle.find("size")->items[i].text, coupler::Dimension::length);
    found.elements[i] = static_cast<int>(
        *coupler::parse_quantity(rectangle.find("elements")->items[i].text, coupler::Dimension::number));
  }
  return found;
}

}  // namespace

void ends_of_regions(const Scene& scene, Remarks& remarks) {
  const std::vector<Extent> extents = extents_of(scene);
  if (extents.empty()) return;
  const fem::RectangleSpecification body = rectangle_of(scene);
  // Made again: of what is void the mesh of the case has no elements.
  const fem::Mesh<2> mesh = fem::rectangle(body, scene.mesh().elements.front().type->name);
  for (const int axis : {0, 1}) {
    const double size = body.size[static_cast<std::size_t>(axis)];
    const int elements = body.elements[static_cast<std::size_t>(axis)];
    const double edge = size / elements;
    std::vector<double> places;
    for (const Extent& extent : extents) places.insert(places.end(), {extent.low(axis), extent.high(axis)});
    const int fitting = elements_that_fit(places, size, elements);
    std::set<double> told;  // regions that meet have one remark
    for (const Extent& extent : extents) {
      double within = -1.0;
      for (const double end : {extent.low(axis), extent.high(axis)})
        if (!is_side(end, size, elements) && told.insert(end).second) within = end;
      if (within < 0.0) continue;
      const double low = std::max(extent.low(axis), 0.0);
      const double high = std::min(extent.high(axis), size);
      double least = size;
      double largest = 0.0;
      for (const int e : fem::elements_between(mesh, extent.low, extent.high)) {
        least = std::min(least, mesh.element_positions(e).col(axis).minCoeff());
        largest = std::max(largest, mesh.element_positions(e).col(axis).maxCoeff());
      }
      const double asked = high - low;
      const double taken = largest - least;
      remarks.push_back(
          {Rank::doubtful, std::max(asked / taken, taken / asked),
           extent.region->value.fault(fmt::format(
               "mesh: region '{}' is to measure {:.4g} m along {}, from {:.4g} m to {:.4g} m; of whole elements it "
               "measures {:.4g} m, from {:.4g} m to {:.4g} m",
               extent.region->key, asked, axis + 1, low, high, taken, least, largest)),
           fmt::format("end it at {:.4g} m or {:.4g} m{}, or make the mesh with Gmsh",
                       edge * std::floor(within / edge), edge * std::ceil(within / edge),
                       fitting > 0 ? fmt::format(", give {} elements along {}", fitting, axis + 1) : "")});
    }
  }
}

}  // namespace polargrain::app
