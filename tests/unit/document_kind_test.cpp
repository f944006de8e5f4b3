// SPDX-License-Identifier: GPL-2.0-or-later
// Files of another kind than the command reads are named as what they are; files of no known kind are let through.
#include "coupler/case/document_kind.hpp"

#include <gtest/gtest.h>

#include <string>
#include <utility>
#include <vector>

namespace polargrain::coupler {
namespace {

/// The message of require_kind for a file with those keys; empty: no message.
std::string said_of(const std::vector<std::string>& keys, DocumentKind expected) {
  Entry document;
  document.kind = Entry::Kind::map;
  document.file = "FILE";
  for (const std::string& key : keys) apply_setting(document, key + "={}");
  try {
    require_kind(document, expected);
  } catch (const InputError& error) {
    return error.faults().front().message;
  }
  return {};
}

/// The message of apply_setting; empty: it is taken.
std::string said_of_setting(const std::string& of_file, const std::string& of_option) {
  Entry document;
  document.kind = Entry::Kind::map;
  apply_setting(document, "value=" + of_file);
  try {
    apply_setting(document, "value=" + of_option);
  } catch (const InputError& error) {
    return error.faults().front().message;
  }
  return {};
}

TEST(Settings, LoseNoUnit) {
  EXPECT_EQ(
      said_of_setting("5 kPa", "8"),
      "'8' has no unit and is 8 Pa, where the case has '5 kPa'; write '8 kPa', or '8 Pa' if that is meant");
  for (const auto& [of_file, of_option] :
       std::vector<std::pair<std::string, std::string>>{{"20MPa", "30"},
                                                        {"5 mm", "8"},
                                                        {"-4 mm", "6"},
                                                        {"[[0, 0], [1 d, 50 kPa]]", "[[0 d, 0], [1 d, 30]]"},
                                                        {"18 kN/m3", "20"}})
    EXPECT_NE(said_of_setting(of_file, of_option), "") << of_option;
  // Plain numbers of scripts are in SI units.
  for (const auto& [of_file, of_option] :
       std::vector<std::pair<std::string, std::string>>{{"5 kPa", "8e3"},
                                                        {"5 kPa", "8 Pa"},
                                                        {"5 kPa", "0"},
                                                        {"5 kPa", "80"},
                                                        {"5000", "8"},
                                                        {"30 deg", "0.5"},
                                                        {"5 mm", "8e-3"},
                                                        {"1e-5", "30"},
                                                        {"cell", "elastic"}})
    EXPECT_EQ(said_of_setting(of_file, of_option), "") << of_option;
}

TEST(DocumentKind, NamesWhatAFileIsAndWhoReadsIt) {
  using enum DocumentKind;
  const std::vector<std::pair<DocumentKind, std::vector<std::string>>> files{
      {problem, {"mesh", "materials"}},
      {packing, {"grains", "sizes"}},
      {element_test, {"stages"}},
      {calibration, {"parameters", "targets"}}};
  for (const auto& [kind, keys] : files) {
    for (const auto& [expected, other] : files)
      EXPECT_EQ(said_of(keys, expected).empty(), kind == expected) << keys.front();
  }
  EXPECT_EQ(
      said_of(files[1].second, problem),
      "this is the specification of a packing, and a case was expected; it is for polargrain pack FILE -o PACKING.h5");
}

TEST(DocumentKind, LetsThroughWhatItDoesNotKnowAndWhatIsHalfOfTheKindItExpects) {
  // Their keys are told one by one, as before.
  EXPECT_EQ(said_of({"mesh"}, DocumentKind::packing), "");
  EXPECT_EQ(said_of({}, DocumentKind::problem), "");
  // A case with keys of a packing stays a case.
  EXPECT_EQ(said_of({"mesh", "materials", "grains", "sizes"}, DocumentKind::problem), "");
}

}  // namespace
}  // namespace polargrain::coupler
