// SPDX-License-Identifier: GPL-2.0-or-later
#include "app/bench/bench_band.hpp"

#include <fmt/format.h>

#include <cmath>
#include <numbers>
#include <stdexcept>

#include "app/commands/band.hpp"
#include "common/error.hpp"

namespace polargrain::app {
namespace {

/// Increments that begin or end farther off, as a share of the increment asked for, are not compared.
constexpr double kFarthest = 0.25;

}  // namespace

BenchBand bench_band(const std::filesystem::path& directory, const std::string& strain, double from,
                     double to) {
  BandCommandOptions options;
  options.places = {directory};
  options.strain_column = strain;
  options.from = from;
  options.to = to;
  BenchBand band;
  try {
    const BandMeasurement measured = measure_band(options);
    const double farthest = kFarthest * (to - from);
    if (std::abs(*measured.begin - from) > farthest || std::abs(*measured.end - to) > farthest) {
      band.none = fmt::format("the fields nearest to {:g} and {:g} are of {:.4g} and {:.4g}", from, to,
                              *measured.begin + 0.0, *measured.end);  // no -0
    } else if (!measured.search.band) {
      band.none = measured.search.reason;
    } else {
      band.inclination = std::abs(measured.search.band->inclination) * 180.0 / std::numbers::pi;
      band.thickness = measured.search.band->thickness;
      band.onset = measured.onset;
    }
  } catch (const InputError& error) {
    band.none = error.what();
  } catch (const std::invalid_argument& error) {
    band.none = error.what();  // no place left beside the band
  }
  return band;
}

}  // namespace polargrain::app
