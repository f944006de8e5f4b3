// SPDX-License-Identifier: GPL-2.0-or-later
#include "app/picture/symbols.hpp"

#include <fmt/format.h>

#include <cmath>

#include "app/remarks/in_units.hpp"

namespace polargrain::app {

std::string point(const Eigen::Vector2d& p) {
  return fmt::format("{:.1f},{:.1f}", p.x(), p.y());
}

std::string arrow(const Eigen::Vector2d& from, const Eigen::Vector2d& to, const char* colour) {
  const Eigen::Vector2d along = (to - from).normalized();
  const Eigen::Vector2d across(-along.y(), along.x());
  const Eigen::Vector2d neck = to - 9.0 * along;
  return fmt::format(
      "<path d='M{}L{}' stroke='{}' stroke-width='2'/><polygon points='{} {} {}' fill='{}'/>\n", point(from),
      point(neck), colour, point(to), point(neck + 4.0 * across), point(neck - 4.0 * across), colour);
}

std::string support(const Eigen::Vector2d& tip, const Eigen::Vector2d& outward, bool is_filled) {
  const Eigen::Vector2d across(-outward.y(), outward.x());
  const Eigen::Vector2d foot = tip + kSymbol * outward;
  const Eigen::Vector2d ground = foot + 3.0 * outward;
  return fmt::format(
      "<polygon points='{} {} {}' fill='{}' stroke='{}' stroke-width='1.5'/><path d='M{}L{}' stroke='{}' "
      "stroke-width='1.5'/>\n",
      point(tip), point(foot + 0.6 * kSymbol * across), point(foot - 0.6 * kSymbol * across),
      is_filled ? kSupport : "none", kSupport, point(ground + 0.8 * kSymbol * across),
      point(ground - 0.8 * kSymbol * across), kSupport);
}

std::string water_surface(const Eigen::Vector2d& from, const Eigen::Vector2d& to) {
  const Eigen::Vector2d tip(0.5 * (from + to));
  constexpr double kSize = 8.0;
  return fmt::format(
             "<line x1='{:.1f}' y1='{:.1f}' x2='{:.1f}' y2='{:.1f}' stroke='{}' stroke-width='1.6'/>\n",
             from.x(), from.y(), to.x(), to.y(), kWater) +
         fmt::format("<polygon points='{} {} {}' fill='none' stroke='{}' stroke-width='1.4'/>\n", point(tip),
                     point(tip + Eigen::Vector2d(-0.6 * kSize, -kSize)),
                     point(tip + Eigen::Vector2d(0.6 * kSize, -kSize)), kWater);
}

std::string square(const Eigen::Vector2d& at) {
  return fmt::format("<rect x='{:.1f}' y='{:.1f}' width='7' height='7' fill='{}'/>\n", at.x() - 3.5,
                     at.y() - 3.5, kSupport);
}

std::string scale_bar(double extent, double scale, double height) {
  const double wanted = 0.2 * extent;
  const double power = std::pow(10.0, std::floor(std::log10(wanted)));
  const double length = (wanted >= 5.0 * power ? 5.0 : wanted >= 2.0 * power ? 2.0 : 1.0) * power;
  const double y = height - 14.0;
  return fmt::format(
      "<path d='M{0:.1f} {1:.1f}h{2:.1f}M{0:.1f} {3:.1f}v8M{4:.1f} {3:.1f}v8' stroke='#222' "
      "stroke-width='2'/><text x='{5:.1f}' y='{6:.1f}'>{7}</text>\n",
      8.0, y, scale * length, y - 4.0, 8.0 + scale * length, 16.0 + scale * length, y + 5.0, metres(length));
}

}  // namespace polargrain::app
