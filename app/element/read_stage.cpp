// SPDX-License-Identifier: GPL-2.0-or-later
#include "app/element/read_stage.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <numbers>

#include "coupler/case/quantity.hpp"
#include "element/named_tests.hpp"

namespace polargrain::app {
namespace {

using coupler::Dimension;
using coupler::Entry;
using coupler::Limit;
using coupler::Section;
using element::Constraint;
using Way = Constraint::Way;

constexpr int kRows = 100;
constexpr int kRowsOfCycle = 40;
constexpr double kStrain = 0.1;  ///< where nothing else is said
/// A larger value given as a strain was meant to be a stress.
constexpr double kLargestStrain = 1.0;

bool is_word(const Entry* entry, const char* word) {
  return entry != nullptr && entry->kind == Entry::Kind::scalar && entry->text == word;
}

/// @returns whether exactly one of two keys is there; a fault when both are
bool first_of(Section& section, const std::string& first, const std::string& second) {
  const bool has_first = section.find(first) != nullptr;
  if (has_first && section.find(second) != nullptr)
    section.fault(second,
                  fmt::format("{}: {} drives the test already; leave one of them out", second, first));
  return has_first;
}

double read_strain(Section& section, const std::string& key) {
  const double strain = section.quantity(key, Dimension::number, Limit::any);
  if (std::abs(strain) > kLargestStrain)
    section.fault(
        key,
        fmt::format("{}: is a strain of {:.6g} %; a stress needs its unit, a strain in per cent the sign %",
                    key, 100.0 * strain));
  return strain;
}

/// A change of a length over it. A plain 0.5 was rather meant as half a per cent.
/// @param shortening its sign where the length becomes shorter
double read_change_of_length(Section& section, const std::string& key, double shortening) {
  constexpr double kPlainStrain = 0.5;
  const double strain = read_strain(section, key);
  const Entry* const entry = section.find(key);
  if (entry == nullptr || !coupler::parse_quantity(entry->text, Dimension::number)) return strain;
  if (std::abs(strain) > kLargestStrain) return strain;  // told
  if (std::abs(strain) >= kPlainStrain && coupler::is_plain_number(entry->text))
    section.fault(key, fmt::format("{}: {} is {:.6g} %? Write '{} %', or '{:.6g} %' if that is meant", key,
                                   entry->text, 100.0 * strain, entry->text, 100.0 * strain));
  else if (shortening * strain >= 1.0)
    section.fault(key, fmt::format("{}: {} leaves nothing of the length", key, entry->text));
  return strain;
}

/// The drive of a test along an axis. @param strain, stress the names of its keys
element::Drive read_drive(Section& section, const std::string& strain, const std::string& stress) {
  element::Drive drive;
  const auto read_amount = [&](const std::string& key) {
    return strain == "axial_strain" ? read_change_of_length(section, key, 1.0) : read_strain(section, key);
  };
  if (section.find("cycles") != nullptr) {
    drive.cycles = section.whole("cycles", 1);
    const Entry* const amplitude = section.require("amplitude", "a strain (0.1 %) or a stress (20 kPa)");
    if (amplitude == nullptr) return drive;
    drive.is_stress = !coupler::parse_quantity(amplitude->text, Dimension::number).has_value();
    drive.amount =
        drive.is_stress ? read_pressure(section, "amplitude", Limit::positive) : read_amount("amplitude");
    return drive;
  }
  drive.is_stress = first_of(section, stress, strain);
  if (drive.is_stress)
    drive.amount = read_pressure(section, stress, Limit::any);
  else
    drive.amount = section.find(strain) != nullptr ? read_amount(strain) : kStrain;
  return drive;
}

/// b, or the angle of Lode it stands for.
double read_ratio(Section& section) {
  if (first_of(section, "lode", "b")) {
    const double angle = section.quantity("lode", Dimension::angle, Limit::not_negative);
    if (angle > std::numbers::pi / 3.0 * (1.0 + 1e-12))
      section.fault("lode", "lode: runs from 0 (compression) to 60 deg (extension)");
    return element::ratio_of_lode_angle(angle);
  }
  const double ratio = section.quantity("b", Dimension::number, Limit::not_negative);
  if (ratio > 1.0) section.fault("b", "b: (s2 - s3) / (s1 - s3) runs from 0 to 1");
  return ratio;
}

element::Stage read_named(Section& section, element::Room room) {
  std::vector<std::string> names;
  for (const element::TestKind& kind : element::test_kinds()) names.push_back(kind.name);
  element::NamedTest test;
  test.name = section.choice("test", names);
  if (test.name.empty()) return {};
  const element::TestKind kind =
      *std::ranges::find(element::test_kinds(), test.name, &element::TestKind::name);
  switch (kind.driven) {
    case element::Driven::axial:
      test.drive = test.name == "oedometer" ? read_drive(section, "axial_strain", "axial_stress")
                                            : read_drive(section, "axial_strain", "deviator");
      break;
    case element::Driven::shear:
      test.drive = read_drive(section, "shear_strain", "shear_stress");
      break;
    case element::Driven::pressure:
      test.pressure = read_pressure(section, "to", Limit::positive);
      break;
    case element::Driven::share:
      test.share = section.quantity("to", Dimension::number, Limit::positive);
      break;
  }
  if (kind.can_be_undrained)
    test.undrained = section.choice_or("drainage", {"drained", "undrained"}, "drained") == "undrained";
  if (test.name == "true_triaxial") {
    test.ratio = read_ratio(section);
    if (test.drive.cycles > 0 && std::abs(test.ratio - 0.5) > 1e-9)
      section.fault(
          section.find("lode") != nullptr ? "lode" : "b",
          "true_triaxial: the axial stress of a cycle is the largest, then the least, and b would turn into "
          "1 - b; cycles need b: 0.5 (lode: 30 deg)");
  }
  test.rows = section.whole_or("rows", 1, test.drive.cycles > 0 ? kRowsOfCycle * test.drive.cycles : kRows);
  if (test.drive.cycles > 0 && test.rows % (4 * test.drive.cycles) != 0)
    section.fault("rows",
                  fmt::format("rows: {} rows for {} cycles miss their turning points; give a multiple of {}",
                              test.rows, test.drive.cycles, 4 * test.drive.cycles));
  if (const auto refused = element::refusal(test.name, room)) {
    section.fault("test", *refused);
    return {};
  }
  return element::stage_of(test, room);
}

/// `hold`, or where a quantity goes.
Constraint aimed(Section& section, const std::string& key, Constraint made, double sign) {
  if (is_word(section.find(key), "hold")) return made;
  made.way = Way::reach;
  if (made.kind == Constraint::Kind::stress)
    made.amount = sign * read_pressure(section, key, Limit::any);
  else
    made.amount = sign * (made.place <= element::k33 ? read_change_of_length(section, key, -1.0)
                                                     : read_strain(section, key));
  return made;
}

/// s22 - s11 as a share of sqrt(3 J2), where the intermediate stress is at b.
double range_of_deviator(double b) {
  return std::sqrt(1.0 - b + b * b);
}

void read_sums(Section& section, element::Room room, bool extended, element::Stage& stage) {
  std::vector<Constraint>& all = stage.constraints;
  if (section.find("volume") != nullptr) {
    if (!is_word(section.find("volume"), "hold"))
      section.fault("volume", "volume: it can be held ('hold'); for a change of it prescribe the strains");
    all.push_back(element::constant_volume());
    stage.pore = element::k11;
  }
  if (section.find("p") != nullptr)
    all.push_back(aimed(section, "p",
                        element::sum_of_stresses("p", element::weights_of_pressure(room), Way::hold), 1.0));
  const auto place_of_ratio = static_cast<std::ptrdiff_t>(all.size());
  if (section.find("q") != nullptr)
    all.push_back(aimed(section, "q",
                        element::sum_of_stresses("q", element::weights_of_deviator(room), Way::hold), 1.0));
  if (section.find("b") != nullptr || section.find("lode") != nullptr) {
    const double b = read_ratio(section);
    element::Vector6 weights = element::Vector6::Zero();
    const double place = element::extends(stage, extended) ? 1.0 - b : b;  // of s33 between s11 and s22
    weights.head<3>() << place - 1.0, -place, 1.0;
    if (section.find("q") != nullptr)
      all.back().weights.head<3>() << range_of_deviator(b), -range_of_deviator(b), 0.0;
    all.insert(all.begin() + place_of_ratio,
               element::sum_of_stresses(section.find("b") != nullptr ? "b" : "lode", weights, Way::reach));
  }
}

element::Stage read_components(Section& section, element::Room room, bool extended) {
  element::Stage stage;
  stage.name = section.text_or("name", "components");
  for (int place = 0; place < 6; ++place) {
    const std::string index = element::kPlaceNames[static_cast<std::size_t>(place)];
    for (const auto& [letter, kind] :
         {std::pair{"e", Constraint::Kind::strain}, {"s", Constraint::Kind::stress}}) {
      const std::string key = letter + index;
      if (section.find(key) == nullptr) continue;
      stage.constraints.push_back(aimed(section, key, element::component(kind, place, Way::hold), 1.0));
    }
  }
  read_sums(section, room, extended, stage);
  stage.rows = section.whole_or("rows", 1, kRows);
  if (stage.constraints.empty())
    section.fault(
        "test",
        "a stage is a named test (test: biaxial) or components (e22: -5 %, s11: hold, p, q, b, volume)");
  for (const std::string& fault : element::faults(stage, room))
    section.fault(fault.substr(0, fault.find(':')), fault);
  return stage;
}

}  // namespace

double read_pressure(Section& section, const std::string& key, Limit limit) {
  const Entry* const entry = section.find(key);
  if (entry != nullptr && entry->kind == Entry::Kind::scalar &&
      coupler::parse_quantity(entry->text, Dimension::number)) {
    section.fault(key, fmt::format("{}: '{}' has no unit; write {} kPa, or Pa, MPa, GPa", key, entry->text,
                                   entry->text));
    return 1.0;
  }
  return section.quantity(key, Dimension::pressure, limit);
}

element::Stage read_stage(Section& section, element::Room room, bool extended) {
  element::Stage stage =
      section.find("test") != nullptr ? read_named(section, room) : read_components(section, room, extended);
  stage.zero = section.flag("zero");
  return stage;
}

}  // namespace polargrain::app
