// SPDX-License-Identifier: GPL-2.0-or-later
#include "app/layer/wall_shearing.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>

#include "app/layer/grain_layer.hpp"
#include "common/csv_table.hpp"
#include "common/error.hpp"

namespace polargrain::app {
namespace {

constexpr double kAtWall = 1.0;      ///< grains whose centres lie so near turn at the wall, d
constexpr double kBandAtWall = 5.0;  ///< thickness of a band of grains, d

/// The mean of values whose places lie in [from, to]; not-a-number for a wall without any.
double mean_between(const std::vector<double>& places, const std::vector<double>& values, double from,
                    double to) {
  double sum = 0.0;
  int count = 0;
  for (std::size_t k = 0; k < places.size(); ++k) {
    if (places[k] < from || places[k] > to) continue;
    sum += values[k];
    ++count;
  }
  return count > 0 ? sum / count : std::numeric_limits<double>::quiet_NaN();
}

/// The mean growth of a value between two frames, of the places whose height above the wall was in [from, to].
double growth_between(const Shearing::Frame& first, const Shearing::Frame& second,
                      const Eigen::VectorXd Shearing::Frame::*value, double wall, double from, double to) {
  double sum = 0.0;
  int count = 0;
  for (Eigen::Index k = 0; k < first.heights.size(); ++k) {
    const double above = first.heights[k] - wall;
    if (above < from || above > to) continue;
    sum += (second.*value)[k] - (first.*value)[k];
    ++count;
  }
  return count > 0 ? sum / count : 0.0;
}

}  // namespace

WallShearing read_wall_shearing(const std::filesystem::path& folder, double pressure, double surface) {
  WallShearing read;
  read.layer = read_layer(folder, pressure);
  const CsvTable history(folder / "history.csv");
  read.rises = history.numbers("rise");
  read.unbalanced = history.numbers("unbalanced_ratio");
  const std::vector<double> normal = history.numbers("normal_stress_ratio");
  for (std::size_t k = 0; k < normal.size(); ++k) read.layer.ratios[k] /= normal[k];
  read.wall = surface;
  return read;
}

std::vector<std::pair<std::string, double>> WallFigures::values() const {
  return {{"peak", peak}, {"peak_at", peak_at}, {"end", end},
          {"rise", rise}, {"turning", turning}, {"share", share}};
}

std::vector<double> slips_of_curve(double way) {
  std::vector<double> slips;
  for (const double slip : {0.0, 0.05, 0.1, 0.2, 0.3, 0.5, 0.75, 1.0, 1.25})
    if (slip < way) slips.push_back(slip);
  for (double slip = 1.5; slip < way - 0.25; slip += 0.5) slips.push_back(slip);
  slips.push_back(way);
  return slips;
}

WallFigures wall_figures(const WallShearing& shearing, double diameter, double way) {
  const std::vector<double>& at = shearing.layer.displacements;
  // Rows end a step or two before a round slip.
  if (at.empty() || at.back() < (way - 0.1) * diameter)
    throw RunError(fmt::format("the box was sheared by {:.3g} of {:.3g} diameters",
                               at.empty() ? 0.0 : at.back() / diameter, way));
  WallFigures figures;
  const double reach = 0.25 * diameter;
  const double last = std::min(at.back(), way * diameter);
  double peak_at = 0.0;
  for (const double slip : at) {
    // The mean of half a diameter, within start and end.
    if (slip < reach || slip > last - reach) continue;
    const double ratio = mean_between(at, shearing.layer.ratios, slip - reach, slip + reach);
    if (ratio <= figures.peak) continue;
    figures.peak = ratio;
    peak_at = slip;
  }
  figures.peak_at = peak_at / diameter;
  figures.end = mean_between(at, shearing.layer.ratios, last - diameter, last);
  figures.rise = mean_between(at, shearing.rises, last - reach, last) / diameter;
  figures.unbalanced = mean_between(at, shearing.unbalanced, 0.0, last);

  const std::vector<double> slips = slips_of_curve(way);
  for (std::size_t k = 0; k < slips.size(); ++k) {
    const double from = k == 0 ? 0.0 : 0.5 * (slips[k - 1] + slips[k]);
    const double to = k + 1 == slips.size() ? slips[k] : 0.5 * (slips[k] + slips[k + 1]);
    fem::FrictionCurve::Measured& point = figures.curve.emplace_back();
    point.slip = slips[k] * diameter;
    point.friction = std::max(
        0.0, mean_between(at, shearing.layer.ratios, from * diameter, std::max(to * diameter, at.front())));
    // The mean over half of an end is that of its middle; a rise begins at zero.
    point.opening =
        k == 0 ? 0.0 : mean_between(at, shearing.rises, from * diameter, std::max(to * diameter, at.front()));
  }

  double turned = 0.0;
  double passed = 0.0;
  double slipped = 0.0;
  const auto& frames = shearing.layer.frames;
  for (std::size_t k = 0; k + 1 < frames.size(); ++k) {
    if (frames[k].displacement < peak_at) continue;
    slipped += frames[k + 1].displacement - frames[k].displacement;
    turned -= growth_between(frames[k], frames[k + 1], &Shearing::Frame::rotations, shearing.wall, 0.0,
                             kAtWall * diameter);
    // At the upper end of the band that a wall has: a quarter of it as a strip to average over.
    passed += growth_between(frames[k], frames[k + 1], &Shearing::Frame::along, shearing.wall,
                             (kBandAtWall - 0.5) * diameter, (kBandAtWall + 0.5) * diameter);
  }
  if (slipped > 0.0) {
    figures.turning = turned / slipped * diameter;
    figures.share = passed / slipped;
  }
  return figures;
}

std::vector<fem::FrictionCurve::Measured> mean_curve(const std::vector<WallFigures>& boxes) {
  std::vector<fem::FrictionCurve::Measured> mean = boxes.front().curve;
  const auto count = static_cast<double>(boxes.size());
  for (std::size_t k = 0; k < mean.size(); ++k) {
    mean[k].friction = mean[k].opening = 0.0;
    for (const WallFigures& box : boxes) {
      mean[k].friction += box.curve[k].friction / count;
      mean[k].opening += box.curve[k].opening / count;
    }
  }
  return mean;
}

}  // namespace polargrain::app
