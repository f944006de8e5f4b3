// SPDX-License-Identifier: GPL-2.0-or-later
#include "app/bench/bench_results.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <utility>

namespace polargrain::app {
namespace {

constexpr double kFoundAgain = 1e-9;  // of the range of y: rounding of an interpolation is far less

}  // namespace

double BenchCurve::at(double place) const {
  for (std::size_t k = 0; k + 1 < x.size(); ++k) {
    const double low = std::min(x[k], x[k + 1]);
    const double high = std::max(x[k], x[k + 1]);
    if (place < low || place > high || low == high) continue;
    return y[k] + (y[k + 1] - y[k]) * (place - x[k]) / (x[k + 1] - x[k]);
  }
  return std::abs(place - x.front()) < std::abs(place - x.back()) ? y.front() : y.back();
}

BenchCurve comparable(const BenchCurve& curve, const BenchCurve& reference) {
  if (curve.time.empty() || reference.time.empty() || reference.x.empty()) return curve;
  const auto [least, most] = std::ranges::minmax(reference.y);
  for (std::size_t k = 0; k < reference.x.size(); ++k)
    if (std::abs(reference.at(reference.x[k]) - reference.y[k]) > kFoundAgain * (most - least))
      return {curve.time, curve.y, curve.time};
  return curve;
}

double peak_of(const BenchCurve& curve) {
  return *std::max_element(curve.y.begin(), curve.y.end(),
                           [](double a, double b) { return std::abs(a) < std::abs(b); });
}

double peak_like(const BenchCurve& curve, double peak) {
  const auto [least, most] = std::minmax_element(curve.y.begin(), curve.y.end());
  return peak < 0.0 ? *least : *most;
}

namespace {

/// A curve and its reference, made comparable.
struct CurveAndReference {
  BenchCurve part;  ///< of the curve within the range of x of the reference, up to the edge itself
  BenchCurve reference;
};

BenchCurve part_within(const BenchCurve& curve, const std::vector<double>& places) {
  const auto [first, last] = std::minmax_element(places.begin(), places.end());
  const double way = 1e-9 * (*last - *first);
  const double least = *first - way;
  const double most = *last + way;
  const auto inside = [&](double place) { return place >= least && place <= most; };
  BenchCurve part;
  for (std::size_t k = 0; k < curve.x.size(); ++k) {
    // Where it leaves or enters the range, the place on the way counts too.
    if (k > 0 && inside(curve.x[k]) != inside(curve.x[k - 1])) {
      const double outside = inside(curve.x[k]) ? curve.x[k - 1] : curve.x[k];
      const double edge = outside > most ? *last : *first;
      const double share = (edge - curve.x[k - 1]) / (curve.x[k] - curve.x[k - 1]);
      part.x.push_back(edge);
      part.y.push_back(curve.y[k - 1] + share * (curve.y[k] - curve.y[k - 1]));
    }
    if (!inside(curve.x[k])) continue;
    part.x.push_back(curve.x[k]);
    part.y.push_back(curve.y[k]);
  }
  return part;
}

CurveAndReference side_by_side(const BenchCurve& curve, const BenchCurve& reference) {
  BenchCurve along = comparable(reference, reference);
  return {part_within(comparable(curve, reference), along.x), std::move(along)};
}

BenchError error_of(const CurveAndReference& both) {
  const auto& [part, reference] = both;
  BenchError error;
  if (part.x.empty()) return error;
  const auto [least, most] = std::minmax_element(reference.y.begin(), reference.y.end());
  const double range = *most - *least;
  BenchCurve expected{part.x, {}};
  for (std::size_t k = 0; k < part.x.size(); ++k) {
    expected.y.push_back(reference.at(part.x[k]));
    error.largest = std::max(error.largest, std::abs(part.y[k] - expected.y[k]) / range);
  }
  const double reference_peak = peak_of(expected);
  if (reference_peak != 0.0)
    error.peak = std::abs(peak_like(part, reference_peak) - reference_peak) / std::abs(reference_peak);
  return error;
}

}  // namespace

BenchError error_of(const BenchCurve& curve, const BenchCurve& reference) {
  return error_of(side_by_side(curve, reference));
}

void compare(std::vector<BenchResult>& results) {
  const BenchResult reference = results.front();
  for (BenchResult& result : results) {
    if (result.has_own_packing()) continue;
    result.errors.clear();
    result.peaks.clear();
    for (std::size_t k = 0; k < result.curves.size(); ++k) {
      if (result.curves[k].x.empty() || reference.curves[k].x.empty()) continue;  // stopped before its start
      const CurveAndReference both = side_by_side(result.curves[k], reference.curves[k]);
      result.errors.push_back(error_of(both));
      result.peaks.push_back(peak_like(both.part, peak_of(both.reference)));
    }
  }
}

void mark_front(std::vector<BenchResult>& results) {
  const auto counts = [&](const BenchResult& r) {
    return &r != &results.front() && r.done() && !r.has_own_packing() && !r.errors.empty();
  };
  for (BenchResult& result : results) {
    result.on_front =
        counts(result) && std::none_of(results.begin(), results.end(), [&](const BenchResult& other) {
          return counts(other) && other.seconds < result.seconds &&
                 other.errors.front().largest < result.errors.front().largest;
        });
  }
}

}  // namespace polargrain::app
