// SPDX-License-Identifier: GPL-2.0-or-later
#include "app/picture/packing_picture.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <numeric>
#include <vector>

#include "app/page/page.hpp"

namespace polargrain::app {
namespace {

/// Of the box, in units of the drawing.
constexpr double kWidth = 600.0;

}  // namespace

std::string packing_figure(const Packing& packing, const std::string& name, const std::string& title) {
  const Eigen::Vector2d first = packing.box.col(0);
  const Eigen::Vector2d second = packing.box.col(1);
  const std::array<Eigen::Vector2d, 4> corners{Eigen::Vector2d::Zero(), first, first + second, second};
  // A periodic box may begin anywhere: here around the middle of its grains.
  Eigen::Vector2d centre = Eigen::Vector2d::Zero();
  for (const Grain& grain : packing.grains) centre += grain.position;
  if (!packing.grains.empty()) centre /= static_cast<double>(packing.grains.size());
  const Eigen::Vector2d origin = centre - 0.5 * (first + second);
  Eigen::Vector2d least = corners[0];
  Eigen::Vector2d most = corners[0];
  for (const Eigen::Vector2d& corner : corners) {
    least = least.cwiseMin(corner);
    most = most.cwiseMax(corner);
  }
  const Eigen::Vector2d size = most - least;
  const double scale = kWidth / size.maxCoeff();
  std::vector<std::size_t> order(packing.grains.size());
  std::iota(order.begin(), order.end(), std::size_t{0});
  std::ranges::stable_sort(order, {}, [&](std::size_t k) { return packing.grains[k].height; });
  std::string discs;
  for (const std::size_t k : order) {
    const Grain& grain = packing.grains[k];
    for (int p = -1; p <= 1; ++p)
      for (int q = -1; q <= 1; ++q) {
        const Eigen::Vector2d place = grain.position - origin + p * first + q * second;
        if ((place.array() < least.array() - grain.radius).any() ||
            (place.array() > most.array() + grain.radius).any())
          continue;
        discs +=
            fmt::format("<circle cx='{:.1f}' cy='{:.1f}' r='{:.1f}'/>\n", scale * (place.x() - least.x()),
                        scale * (most.y() - place.y()), scale * grain.radius);
      }
  }
  std::string outline;
  for (const Eigen::Vector2d& corner : corners)
    outline +=
        fmt::format("{:.1f},{:.1f} ", scale * (corner.x() - least.x()), scale * (most.y() - corner.y()));
  outline.pop_back();
  return fmt::format(
      "<figure class='grains'>\n<svg viewBox='-2 -2 {0:.0f} {1:.0f}' role='img' aria-label='grains of a packing'>\n"
      "<clipPath id='{2}'><polygon points='{3}'/></clipPath>\n<g clip-path='url(#{2})' fill='#d9c9a3' stroke='#7a6a45' "
      "stroke-width='.7'>\n{4}</g>\n<polygon points='{3}' fill='none' stroke='currentColor' stroke-width='1.5'/>\n</svg>\n"
      "<figcaption>{5}</figcaption>\n</figure>\n",
      scale * size.x() + 4.0, scale * size.y() + 4.0, name, outline, discs, escaped(title));
}

}  // namespace polargrain::app
