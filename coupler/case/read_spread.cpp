// SPDX-License-Identifier: GPL-2.0-or-later
#include "coupler/case/read_spread.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <functional>

#include "common/packing_file.hpp"
#include "coupler/case/cell_script.hpp"
#include "coupler/case/data_files.hpp"
#include "coupler/case/measured_length.hpp"

namespace polargrain::coupler {
namespace {

constexpr const char* kMeasured = "measured";
constexpr std::string_view kMedian = "d50";
/// Packings of one specification differ by less, relative.
constexpr double kSameSpread = 0.05;
constexpr double kSomeLength = 1.0;  // m, to read on with

struct MaterialOfGrains {
  std::string packing_name, script_name;
  std::filesystem::path packing_file, script_file;
};

struct FoundSpread {
  std::string packing;
  double length = 0.0;  ///< m
};

/// Half of the mass of the grains is of smaller ones, m.
double median_diameter(const Packing& packing) {
  std::vector<double> radii;
  for (const Grain& grain : packing.grains) radii.push_back(grain.radius);
  std::ranges::sort(radii);
  double whole = 0.0;
  for (const double radius : radii) whole += std::pow(radius, packing.dimension);
  double below = 0.0;
  for (const double radius : radii) {
    below += std::pow(radius, packing.dimension);
    if (below >= 0.5 * whole) return 2.0 * radius;
  }
  return 0.0;
}

/// @returns nothing where a file is not there, which is a fault of its material
std::optional<std::vector<MaterialOfGrains>> materials_of_grains(const Entry& document,
                                                                 const std::filesystem::path& directory) {
  std::vector<MaterialOfGrains> all;
  const Entry* const materials = document.find("materials");
  if (materials == nullptr) return all;
  for (const Entry::Member& material : materials->members) {
    const Entry* const packing = material.value.find("packing");
    const Entry* const script = material.value.find("script");
    if (packing == nullptr || script == nullptr) continue;
    const auto packing_file = find_data_file(packing->text, directory);
    const auto script_file = find_data_file(script->text, directory);
    if (!packing_file || !script_file) return std::nullopt;
    all.push_back({packing->text, script->text, *packing_file, *script_file});
  }
  return all;
}

/// The length that polargrain layer has written beside a packing. @returns nothing where `fault` is told why not
std::optional<double> measured_spread(const MaterialOfGrains& material, const Packing& packing,
                                      const std::function<void(const std::string&)>& fault) {
  const auto measured =
      length_beside({material.packing_file, material.packing_name, 2.0 * packing.mean_radius(),
                     text_of_script(material.script_file), material.script_name},
                    fault);
  if (!measured) return std::nullopt;
  if (!measured->spread)
    fault(fmt::format(
        "{} holds no spread; 'polargrain layer' without --no-spread measures it, or give a length",
        length_file_of(material.packing_file).filename().string()));
  return measured->spread;
}

}  // namespace

bool spread_is_of_grains(const Entry& spread) {
  if (spread.text == kMeasured || spread.text.ends_with(kMedian)) return true;
  // 'd5' is meant for d50, and is told so.
  const std::size_t unit = spread.text.find_first_not_of("0123456789.+- ");
  return unit != std::string::npos && spread.text[unit] == 'd' &&
         !parse_quantity(spread.text, Dimension::length);
}

double spread_of_grains(const Entry& spread, const Entry& document, CaseParts& parts) {
  const auto fault = [&](const std::string& text) {
    parts.faults.push_back(spread.fault(fmt::format("continuum: spread: {}: {}", spread.text, text)));
  };
  std::optional<double> medians;
  if (spread.text != kMeasured) {
    if (spread.text.ends_with(kMedian))
      medians = parse_quantity(spread.text.substr(0, spread.text.size() - kMedian.size()), Dimension::number);
    if (!medians || *medians <= 0.0) {
      fault("expected a length, 'measured', or so many median diameters of the grains, such as '5 d50'");
      return kSomeLength;
    }
  }
  const auto materials = materials_of_grains(document, parts.directory);
  if (!materials) return kSomeLength;
  if (materials->empty()) {
    fault("no material has grains; give a length, such as '5 mm'");
    return kSomeLength;
  }
  std::vector<FoundSpread> found;
  for (const MaterialOfGrains& material : *materials) {
    try {
      const Packing packing = read_packing(material.packing_file);
      const auto length =
          medians ? *medians * median_diameter(packing) : measured_spread(material, packing, fault);
      if (!length) return kSomeLength;
      found.push_back({material.packing_name, *length});
    } catch (const InputError&) {
      return kSomeLength;  // is a fault of the material
    }
  }
  const FoundSpread& first = found.front();
  for (const FoundSpread& other : found) {
    if (std::abs(other.length - first.length) <= kSameSpread * first.length) continue;
    fault(fmt::format(
        "there is one spread of the whole body: '{}' has {:.4g} mm, '{}' has {:.4g} mm; give a length",
        first.packing, 1e3 * first.length, other.packing, 1e3 * other.length));
    break;
  }
  return first.length;
}

}  // namespace polargrain::coupler
