// SPDX-License-Identifier: GPL-2.0-or-later
#include "app/pack/read_specification.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>
#include <numeric>

#include "common/error.hpp"
#include "coupler/case/cell_script.hpp"
#include "coupler/case/contact_library.hpp"
#include "coupler/case/data_files.hpp"
#include "coupler/case/document.hpp"
#include "coupler/case/document_kind.hpp"
#include "coupler/case/script_scene.hpp"
#include "coupler/case/section.hpp"

namespace polargrain::app {
namespace {

/// Placing the grains takes the square of their number; the engine's share grows with the number alone.
constexpr int kMostGrains = 50000;

/// How many items the list of a key has; at least one, so that its length can be asked for.
std::size_t length_of(coupler::Section& section, const std::string& key) {
  const coupler::Entry* entry = section.find(key);
  return entry != nullptr && entry->kind == coupler::Entry::Kind::sequence
             ? std::max<std::size_t>(1, entry->items.size())
             : 1;
}

void require_ascending(coupler::Section& section, const std::string& key, const std::vector<double>& values) {
  if (!std::is_sorted(values.begin(), values.end(), std::less_equal<>()))
    section.fault(key, fmt::format("{}: each value must be greater than the one before", key));
}

SizeLaw read_sizes(const coupler::Entry& entry, coupler::Faults& faults) {
  coupler::Section section(entry, "sizes", faults);
  SizeLaw law;
  const std::string name = section.choice("law", {"uniform", "lognormal", "list", "sieve"});
  const auto radii = [&](const std::string& key, std::size_t count) {
    law.radii = section.quantities(key, count, coupler::Dimension::length, coupler::Limit::positive);
  };
  if (name == "uniform") {
    radii("radius", 2);
    if (law.radii[0] > law.radii[1]) section.fault("radius", "radius: the first must be the smaller one");
  } else if (name == "lognormal") {
    law.kind = SizeLaw::Kind::lognormal;
    radii("radius", 3);
    law.deviation = section.quantity("deviation", coupler::Dimension::number, coupler::Limit::positive);
    require_ascending(section, "radius", law.radii);
  } else if (name == "list") {
    law.kind = SizeLaw::Kind::list;
    radii("radius", length_of(section, "radius"));
    law.shares =
        section.quantities("share", law.radii.size(), coupler::Dimension::number, coupler::Limit::positive);
  } else if (name == "sieve") {
    law.kind = SizeLaw::Kind::sieve;
    radii("diameter", std::max<std::size_t>(2, length_of(section, "diameter")));
    for (double& size : law.radii) size *= 0.5;
    law.shares = section.quantities("passing", law.radii.size(), coupler::Dimension::number,
                                    coupler::Limit::not_negative);
    require_ascending(section, "diameter", law.radii);
    const bool is_whole = length_of(section, "passing") == law.shares.size();
    if (is_whole &&
        (law.shares.front() != 0.0 || law.shares.back() != 1.0 || !std::ranges::is_sorted(law.shares)))
      section.fault(
          "passing",
          fmt::format("passing: must rise from 0 to 100 % (parts of the mass that pass each sieve){}",
                      law.shares.back() == 100.0 ? "; '100' is 10000 %, write '100 %'" : ""));
  }
  section.finish();
  return law;
}

/// Discs in a plane unless asked otherwise.
void read_shape(coupler::Section& top, PackingSpecification& specification) {
  specification.dimension = top.choice_or("dimension", {"2", "3"}, "2") == "3" ? 3 : 2;
  const std::string natural = specification.dimension == 3 ? "spheres" : "discs";
  specification.spheres = top.choice_or("shape", {"discs", "spheres"}, natural) == "spheres";
  if (specification.dimension == 2) {
    specification.thickness = top.quantity("thickness", coupler::Dimension::length, coupler::Limit::positive);
    return;
  }
  if (!specification.spheres) top.fault("shape", "shape: in dimension 3 grains are spheres");
  if (top.find("thickness") != nullptr)
    top.fault("thickness",
              "thickness: leave it out in dimension 3, where the box is compressed in all directions");
}

/// A pressure, or the normal stress of each axis.
void read_pressure(coupler::Section& top, PackingSpecification& specification) {
  const coupler::Entry* entry = top.find("pressure");
  if (entry == nullptr || entry->kind != coupler::Entry::Kind::sequence) {
    specification.pressure = top.quantity("pressure", coupler::Dimension::pressure, coupler::Limit::positive);
    return;
  }
  const auto axes = static_cast<std::size_t>(specification.dimension);
  const std::vector<double> stresses =
      top.quantities("pressure", axes, coupler::Dimension::pressure, coupler::Limit::positive);
  specification.pressure = std::accumulate(stresses.begin(), stresses.end(), 0.0) / static_cast<double>(axes);
  for (std::size_t axis = 0; axis < stresses.size(); ++axis)
    specification.share_of_axis[axis] = stresses[axis] / specification.pressure;
}

/// One-dimensional compression from an isotropic pressure, where asked.
void read_one_dimensional(coupler::Section& top, PackingSpecification& specification) {
  if (top.find("one_dimensional_from") == nullptr) return;
  const double from =
      top.quantity("one_dimensional_from", coupler::Dimension::pressure, coupler::Limit::positive);
  specification.one_dimensional_from = from;
  if (specification.pressure > 0.0 && from >= specification.pressure)
    top.fault("one_dimensional_from", "one_dimensional_from: must be less than the pressure");
  if (specification.share_of_axis != std::array{1.0, 1.0, 1.0})
    top.fault(
        "one_dimensional_from",
        "one_dimensional_from: the lateral stresses follow from it; give one pressure, for the last axis");
}

/// Grains that fall, where asked.
void read_deposition(coupler::Section& top, PackingSpecification& specification, coupler::Faults& faults) {
  const coupler::Entry* const entry = top.find("deposition");
  if (entry == nullptr) return;
  coupler::Section section(*entry, "deposition", faults);
  Deposition deposition;
  deposition.bedding_angle =
      section.quantity_or("bedding_angle", coupler::Dimension::angle, coupler::Limit::any, 0.0);
  deposition.keeps_width = section.choice_or("sides", {"pressed", "kept"}, "pressed") == "kept";
  section.finish();
  specification.deposition = deposition;
  if (specification.one_dimensional_from)
    top.fault(
        "one_dimensional_from",
        "one_dimensional_from: grains that fall are compressed along their fall first of all; for the stresses at "
        "rest (K0) give 'sides: kept' below deposition in its place");
  if (deposition.keeps_width && specification.share_of_axis != std::array{1.0, 1.0, 1.0})
    top.fault(
        "pressure",
        "pressure: with 'sides: kept' the lateral stresses follow from the compression along the fall; give one "
        "pressure, along the fall");
}

/// How it is compressed and when it counts as at rest.
void read_control(coupler::Section& top, PackingSpecification& specification) {
  const auto positive = [&top](const char* key, double& value) {
    value = top.quantity_or(key, coupler::Dimension::number, coupler::Limit::positive, value);
  };
  positive("pressure_tolerance", specification.pressure_tolerance);
  positive("unbalanced_force_ratio", specification.unbalanced_force_ratio);
  positive("inertial_number", specification.inertial_number);
  specification.damping = specification.dimension == 3 ? kDampingInSpace : kDampingInPlane;
  positive("damping", specification.damping);
  if (specification.damping >= 1.0) top.fault("damping", "damping: must be less than 1");
  specification.most_steps = top.whole_or("most_steps", 1, static_cast<int>(specification.most_steps));
  const std::string loop = top.choice_or("loop", {"automatic", "engine"}, "automatic");
  specification.loop = loop == "engine" ? CellLoop::engine : CellLoop::automatic;
}

void require_scene(const PackingSpecification& specification, coupler::Faults& faults) {
  const std::vector<Fault> other =
      coupler::scene_faults(specification.script, specification.script_file, specification.dimension);
  faults.insert(faults.end(), other.begin(), other.end());
}

/// Grains of metres, and a density of less than cork's or more than any element's, are numbers in other units.
constexpr double kLargestPlainRadius = 0.25;  // m
constexpr double kLeastDensity = 100.0;       // kg/m^3, as of cork
constexpr double kMostDensity = 25e3;         // kg/m^3

/// A plain number that can hardly be meant in SI units. @param unit that was most likely meant
void doubt_plain_number(const coupler::Entry& entry, const std::string& key, bool doubtful,
                        const std::string& as_read, const std::string& unit, coupler::Faults& faults) {
  if (!doubtful || !coupler::is_plain_number(entry.text)) return;
  faults.push_back(entry.fault(
      fmt::format("{0}: '{1}' without a unit is {2}; write '{1} {3}', or with the unit that is meant", key,
                  entry.text, as_read, unit)));
}

void doubt_sizes(const coupler::Entry& sizes, coupler::Faults& faults) {
  for (const coupler::Entry::Member& member : sizes.members) {
    const bool diameter = member.key == "diameter";
    if (!diameter && member.key != "radius") continue;
    for (const coupler::Entry& item : member.value.items) {
      const auto value = coupler::parse_quantity(item.text, coupler::Dimension::length);
      if (!value) continue;
      doubt_plain_number(item, "sizes: " + member.key, *value > kLargestPlainRadius * (diameter ? 2.0 : 1.0),
                         fmt::format("{:g} m", *value), "mm", faults);
    }
  }
}

void doubt_pressure(const coupler::Entry& pressure, coupler::Faults& faults) {
  const auto value = coupler::parse_quantity(pressure.text, coupler::Dimension::pressure);
  if (!value || *value <= 0.0) return;
  doubt_plain_number(pressure, "pressure", *value < coupler::kLeastPlainPressure,
                     fmt::format("{:g} Pa, the weight of {:.2g} mm of soil", *value, *value / 18.0), "kPa",
                     faults);
}

/// Of one pressure, or of one an axis.
void doubt_pressures(const coupler::Entry& pressures, coupler::Faults& faults) {
  doubt_pressure(pressures, faults);
  for (const coupler::Entry& pressure : pressures.items) doubt_pressure(pressure, faults);
}

void doubt_numbers(const coupler::Entry& document, const PackingSpecification& specification,
                   coupler::Faults& faults) {
  if (const coupler::Entry* const sizes = document.find("sizes")) doubt_sizes(*sizes, faults);
  if (const coupler::Entry* const pressure = document.find("pressure")) doubt_pressures(*pressure, faults);
  if (const coupler::Entry* const density = document.find("density")) {
    if (!coupler::is_plain_number(density->text))
      faults.push_back(density->fault("density: give the number of kg/m3 alone, such as 2650"));
    else if (specification.density < kLeastDensity)
      faults.push_back(density->fault(fmt::format(
          "density: {:g} kg/m3 is lighter than any grain (quartz 2650); write {:g} if it was in g/cm3",
          specification.density, 1e3 * specification.density)));
    else if (specification.density > kMostDensity)
      faults.push_back(density->fault(fmt::format(
          "density: {:g} kg/m3 is heavier than any grain (quartz 2650); write {:g} if it was in g/m3",
          specification.density, 1e-3 * specification.density)));
  }
}

}  // namespace

PackingSpecification read_packing_specification(const std::filesystem::path& file,
                                                const std::vector<std::string>& settings,
                                                const ScriptRules& scripts) {
  const coupler::Entry document = coupler::load_document_of(coupler::DocumentKind::packing, file, settings);
  coupler::Faults faults;
  PackingSpecification specification;
  specification.text = coupler::content_of(file);
  for (const std::string& setting : settings) specification.text += fmt::format("# --set {}\n", setting);
  coupler::Section top(document, "packing", faults);
  top.text_or("title", "");
  specification.grains = top.whole("grains", 4);
  if (specification.grains > kMostGrains) top.fault("grains", fmt::format("grains: at most {}", kMostGrains));
  if (const coupler::Entry* entry = top.require("sizes", "a map with the size law"))
    specification.sizes = read_sizes(*entry, faults);
  specification.density = top.quantity("density", coupler::Dimension::number, coupler::Limit::positive);
  read_shape(top, specification);
  read_pressure(top, specification);
  read_one_dimensional(top, specification);
  read_deposition(top, specification, faults);
  specification.friction = top.quantity("friction", coupler::Dimension::number, coupler::Limit::not_negative);
  constexpr double kMostFriction = 5.0;  // of 79 degrees
  if (specification.friction > kMostFriction)
    top.fault("friction",
              fmt::format(
                  "friction: a coefficient of {0:g} is of an angle of {1:.0f} degrees; for an angle of {0:g} "
                  "degrees write {2:.3f}",
                  specification.friction, std::atan(specification.friction) * 180.0 / std::numbers::pi,
                  std::tan(specification.friction * std::numbers::pi / 180.0)));
  if (top.find("rolling_friction") != nullptr)
    specification.rolling_friction =
        top.quantity("rolling_friction", coupler::Dimension::number, coupler::Limit::not_negative);
  if (top.find("void_ratio") != nullptr)
    specification.void_ratio =
        top.quantity("void_ratio", coupler::Dimension::number, coupler::Limit::positive);
  specification.seed = static_cast<std::uint64_t>(top.whole("seed", 0));
  specification.void_ratio_tolerance =
      top.quantity_or("void_ratio_tolerance", coupler::Dimension::number, coupler::Limit::positive,
                      specification.void_ratio_tolerance);
  read_control(top, specification);
  const coupler::CaseFiles files{file.parent_path(), scripts};
  coupler::CellScript script = read_cell_script("script", top, faults, files);
  specification.script_file = std::move(script.file);
  specification.script = std::move(script.text);
  require_scene(specification, faults);
  specification.contact_library = coupler::read_contact_library(top, files);
  top.finish();
  doubt_numbers(document, specification, faults);
  if (!faults.empty()) throw InputError(faults);
  return specification;
}

PackingSpecification read_settling(const std::filesystem::path& packing, const std::filesystem::path& script,
                                   int dimension, double pressure, const std::string& text,
                                   const std::vector<std::string>& settings, const ScriptRules& scripts) {
  coupler::Entry document;
  document.kind = coupler::Entry::Kind::map;
  document.file = packing.string();
  for (const std::string& setting : settings) apply_setting(document, setting);
  coupler::Faults faults;
  PackingSpecification specification;
  coupler::Section top(document, "settling", faults);
  specification.dimension = dimension;
  if (pressure > 0.0 && top.find("pressure") == nullptr) {
    specification.pressure = pressure;
    specification.keeps_stresses = true;
  } else {
    read_pressure(top, specification);
  }
  read_control(top, specification);
  specification.contact_library =
      coupler::read_contact_library(top, {std::filesystem::current_path(), scripts});
  top.finish();
  if (const coupler::Entry* const given = document.find("pressure")) doubt_pressures(*given, faults);
  const auto file = coupler::find_data_file(script.string(), std::filesystem::current_path());
  if (!file)
    faults.push_back(
        {packing.string(), 0, fmt::format("there is no script '{}' to settle it under", script.string())});
  if (!faults.empty()) throw InputError(faults);
  specification.script_file = file->lexically_normal().string();
  specification.script = coupler::text_of_script(*file);
  const std::vector<Fault> wrong = script_faults(specification.script, specification.script_file, scripts);
  faults.insert(faults.end(), wrong.begin(), wrong.end());
  require_scene(specification, faults);
  if (!faults.empty()) throw InputError(faults);
  specification.text =
      text + fmt::format("# settled under {} at {:.6g} Pa\n", script.string(), specification.pressure);
  return specification;
}

}  // namespace polargrain::app
