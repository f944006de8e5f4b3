// SPDX-License-Identifier: GPL-2.0-or-later
#include "app/report/grain_drawing.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>
#include <numeric>
#include <vector>

#include "app/page/page.hpp"

namespace polargrain::app {
namespace {

/// Of the box, in units of the drawing.
constexpr double kDrawingWidth = 1000.0;
constexpr double kThickestLine = 14.0;
/// A line that would be thinner does not show.
constexpr double kThinnestLine = 0.4;

/// Grey at 0, blue at -1, red at 1.
std::string colour(double share) {
  constexpr std::array<std::array<double, 3>, 3> kStops{{{49, 84, 176}, {214, 214, 214}, {190, 45, 45}}};
  const double place = std::clamp(share, -1.0, 1.0) + 1.0;
  const std::size_t below = place < 1.0 ? 0 : 1;
  std::array<int, 3> mixed{};
  for (std::size_t i = 0; i < 3; ++i)
    mixed[i] = static_cast<int>(std::lround(
        kStops[below][i] + (place - static_cast<double>(below)) * (kStops[below + 1][i] - kStops[below][i])));
  return fmt::format("#{:02x}{:02x}{:02x}", mixed[0], mixed[1], mixed[2]);
}

}  // namespace

std::string grain_figure(const GrainView& view, const std::string& name, const std::string& title) {
  // Grains without contacts spin freely: they are not to set the scale.
  std::vector<double> rotations;
  for (const GrainView::Grain& grain : view.grains) rotations.push_back(std::abs(grain.rotation.z()));
  std::ranges::sort(rotations);
  const double largest_rotation =
      rotations.empty()
          ? 0.0
          : rotations[static_cast<std::size_t>(0.95 * static_cast<double>(rotations.size() - 1))];
  double largest_force = 0.0;
  double sliding = 0.0;
  for (const GrainView::Contact& contact : view.contacts) {
    largest_force = std::max(largest_force, contact.normal_force());
    sliding += contact.sliding ? 1.0 : 0.0;
  }
  const Eigen::Vector2d first = view.box.block<2, 1>(0, 0);
  const Eigen::Vector2d second = view.box.block<2, 1>(0, 1);
  const std::array<Eigen::Vector2d, 4> corners{Eigen::Vector2d::Zero(), first, first + second, second};
  Eigen::Vector2d least = corners[0];
  Eigen::Vector2d most = corners[0];
  for (const Eigen::Vector2d& corner : corners) {
    least = least.cwiseMin(corner);
    most = most.cwiseMax(corner);
  }
  const double scale = kDrawingWidth / std::max(most.x() - least.x(), most.y() - least.y());
  const auto drawn = [&](const Eigen::Vector2d& place) {  // down is positive there
    return Eigen::Vector2d(scale * (place.x() - least.x()), scale * (most.y() - place.y()));
  };
  // Images that reach into the rectangle around the box; the drawing is cut at its sides.
  std::vector<Eigen::Vector2d> copies;
  for (int p = -1; p <= 1; ++p)
    for (int q = -1; q <= 1; ++q) copies.emplace_back(p * first + q * second);
  const auto is_near = [&](const Eigen::Vector2d& place, double reach) {
    return (place.array() > least.array() - reach).all() && (place.array() < most.array() + reach).all();
  };
  // Spheres: the nearest to the eye last.
  std::vector<std::size_t> order(view.grains.size());
  std::iota(order.begin(), order.end(), std::size_t{0});
  std::ranges::stable_sort(order, {}, [&](std::size_t k) { return view.grains[k].position.z(); });
  std::string discs;
  for (const std::size_t k : order) {
    const GrainView::Grain& grain = view.grains[k];
    const double share = largest_rotation > 0.0 ? grain.rotation.z() / largest_rotation : 0.0;
    for (const Eigen::Vector2d& copy : copies) {
      const Eigen::Vector2d place = grain.position.head<2>() + copy;
      if (!is_near(place, grain.radius)) continue;
      const Eigen::Vector2d at = drawn(place);
      discs += fmt::format("<circle cx='{:.1f}' cy='{:.1f}' r='{:.1f}' fill='{}'/>\n", at.x(), at.y(),
                           scale * grain.radius, colour(share));
    }
  }
  // In space all contacts of the box lie one behind the other: only those that carry more than the mean are shown.
  double least_force = 0.0;
  if (view.dimension == 3)
    for (const GrainView::Contact& contact : view.contacts)
      least_force += contact.normal_force() / static_cast<double>(view.contacts.size());
  std::string chains;
  for (const GrainView::Contact& contact : view.contacts) {
    const double width = largest_force > 0.0 ? kThickestLine * contact.normal_force() / largest_force : 0.0;
    if (!(width > kThinnestLine) || contact.normal_force() < least_force) continue;
    const Eigen::Vector2d from = view.grains[contact.first].position.head<2>();
    const Eigen::Vector2d branch = contact.branch.head<2>();
    for (const Eigen::Vector2d& copy : copies) {
      if (!is_near(from + copy + 0.5 * branch, 0.5 * branch.norm())) continue;
      const Eigen::Vector2d begin = drawn(from + copy);
      const Eigen::Vector2d end = drawn(from + copy + branch);
      chains += fmt::format("<path d='M{:.1f} {:.1f}L{:.1f} {:.1f}' stroke-width='{:.1f}'/>\n", begin.x(),
                            begin.y(), end.x(), end.y(), width);
    }
  }
  std::string outline;
  for (const Eigen::Vector2d& corner : corners) {
    const Eigen::Vector2d at = drawn(corner);
    outline += fmt::format("{:.1f},{:.1f} ", at.x(), at.y());
  }
  outline.pop_back();
  const std::string caption = fmt::format(
      "{}: {} grains, {} contacts, {:.0f} % of them sliding; colour: rotation, {}; lines: normal forces, the thickest "
      "{:.4g} N{}",
      title, view.grains.size(), view.contacts.size(),
      view.contacts.empty() ? 0.0 : 100.0 * sliding / static_cast<double>(view.contacts.size()),
      largest_rotation > 0.0
          ? fmt::format("full blue clockwise, full red counter-clockwise by {:.3g} degrees and more",
                        largest_rotation * 180.0 / std::numbers::pi)
          : std::string("no grain has turned yet"),
      largest_force,
      view.dimension == 3 ? " (those above their mean); seen along the normal of the plane" : "");
  return fmt::format(
      "<figure class='grains'>\n<svg viewBox='-5 -5 {:.0f} {:.0f}' xmlns='http://www.w3.org/2000/svg' role='img' aria-label='grains and force "
      "chains'>\n<clipPath id='{}'><polygon points='{}'/></clipPath>\n<g clip-path='url(#{})'>\n<rect x='-5' y='-5' width='{:.0f}' "
      "height='{:.0f}' fill='#fff'/>\n<g stroke='#888' stroke-width='.5'>\n{}</g>\n<g stroke='#111' stroke-linecap='round'>\n{}</g>\n</g>\n"
      "<polygon points='{}' fill='none' stroke='#888' stroke-width='2'/>\n</svg>\n<figcaption>{}</figcaption>\n</figure>\n",
      scale * (most.x() - least.x()) + 10.0, scale * (most.y() - least.y()) + 10.0, name, outline, name,
      scale * (most.x() - least.x()) + 10.0, scale * (most.y() - least.y()) + 10.0, discs, chains, outline,
      escaped(caption));
}

}  // namespace polargrain::app
