// SPDX-License-Identifier: GPL-2.0-or-later
#pragma once
#include <algorithm>
#include <string>

#include "tests/support/careless_scenes.hpp"

namespace polargrain::testing {

inline bool is_told_of_features(const app::Remarks& remarks, const std::string& message, app::Rank rank) {
  return std::ranges::any_of(remarks, [&](const app::Remark& remark) {
    return remark.rank == rank && remark.at.line > 0 && !remark.remedy.empty() &&
           remark.at.message.find(message) != std::string::npos;
  });
}

/// One thing is wrong and told, nothing else.
class CarelessFeatures : public ::testing::TestWithParam<Careless> {};

/// Odd and right.
class OddFeatures : public ::testing::TestWithParam<Careless> {};

}  // namespace polargrain::testing
