// SPDX-License-Identifier: GPL-2.0-or-later
#include "app/layer/shearing.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

#include "app/layer/ruler.hpp"
#include "common/error.hpp"

namespace polargrain::app {
namespace {

/// Mean of the ratios within so much on either side of a displacement, m; where a jump passed it by, between its ends;
/// not-a-number beyond the curve.
double ratio_about(const Shearing& shearing, double displacement, double reach) {
  double sum = 0.0;
  int count = 0;
  for (std::size_t k = 0; k < shearing.displacements.size(); ++k) {
    if (std::abs(shearing.displacements[k] - displacement) > reach) continue;
    sum += shearing.ratios[k];
    ++count;
  }
  if (count > 0) return sum / count;
  for (std::size_t k = 0; k + 1 < shearing.displacements.size(); ++k) {
    const double before = shearing.displacements[k], after = shearing.displacements[k + 1];
    if ((before - displacement) * (after - displacement) > 0.0) continue;
    return std::lerp(shearing.ratios[k], shearing.ratios[k + 1], (displacement - before) / (after - before));
  }
  return std::numeric_limits<double>::quiet_NaN();
}

/// The frame nearest to a displacement.
std::size_t nearest(const Shearing& shearing, double displacement) {
  std::size_t best = 0;
  for (std::size_t k = 1; k < shearing.frames.size(); ++k)
    if (std::abs(shearing.frames[k].displacement - displacement) <
        std::abs(shearing.frames[best].displacement - displacement))
      best = k;
  return best;
}

}  // namespace

std::vector<std::pair<std::string, double>> LayerFigures::values() const {
  return {{"peak", peak},           {"peak_at", peak_at}, {"halfway", halfway}, {"end", end},
          {"thickness", thickness}, {"growth", growth},   {"turning", turning}};
}

LayerFigures figures_of(const Shearing& shearing, double diameter, double way) {
  if (shearing.displacements.empty() || shearing.frames.size() < 2 ||
      shearing.displacements.back() < diameter)
    throw RunError("the layer was sheared by less than a mean diameter");
  LayerFigures figures;
  const double reach = 0.25 * diameter;
  double peak_at = 0.0;
  for (const double at : shearing.displacements) {
    const double ratio = ratio_about(shearing, at, reach);
    if (ratio <= figures.peak) continue;
    figures.peak = ratio;
    peak_at = at;
  }
  figures.peak_at = peak_at / diameter;
  const double last = shearing.displacements.back();
  figures.complete = last >= peak_at + (way - 0.25) * diameter;
  const double end = std::min(peak_at + way * diameter, last - reach);
  const double halfway = peak_at + 0.5 * (end - peak_at);
  figures.halfway = ratio_about(shearing, halfway, reach) / figures.peak;
  figures.end = ratio_about(shearing, end, reach) / figures.peak;

  // Windows of a diameter of displacement, half a diameter apart.
  double sum = 0.0;
  double turning = 0.0;
  int count = 0;
  int turned_count = 0;
  double first = 0.0;
  double one = 0.0;
  const auto look_at = [&](const Shearing::Frame& from, const Shearing::Frame& to) {
    if (!(to.displacement > from.displacement)) return;
    const Eigen::VectorXd heights = 0.5 * (from.heights + to.heights);
    const Band band = band_of(heights, to.along - from.along);
    one = band.thickness / diameter;
    if (count == 0) first = one;
    sum += std::log(one);
    const double turned = rotation_in(band, heights, to.rotations - from.rotations);
    if (std::isfinite(turned)) {  // a band between two rows of places holds no place
      turning += turned * band.thickness / (to.displacement - from.displacement);
      ++turned_count;
    }
    ++count;
  };
  // One at least: a layer whose peak is at its end is not complete, and no reason to end all others' figures.
  for (double middle = std::min(halfway, end); middle <= end + 0.01 * diameter; middle += 0.5 * diameter)
    look_at(shearing.frames[nearest(shearing, middle - 0.5 * diameter)],
            shearing.frames[nearest(shearing, middle + 0.5 * diameter)]);
  // Nor is one that broke off behind a jump.
  if (count == 0) look_at(shearing.frames[shearing.frames.size() - 2], shearing.frames.back());
  if (count == 0) throw RunError("the layer has no frames at different displacements");
  figures.thickness = std::exp(sum / count);
  figures.growth = one / first;
  figures.turning = turned_count > 0 ? turning / turned_count : std::numeric_limits<double>::quiet_NaN();
  return figures;
}

}  // namespace polargrain::app
