// SPDX-License-Identifier: GPL-2.0-or-later
#include "coupler/case/models/cone_match.hpp"

#include <algorithm>

namespace polargrain::coupler {
namespace {

/// The words of `match`, in the order of fem::ConeMatch.
const std::vector<std::string> kMatches{"triaxial_compression", "triaxial_extension", "plane_strain",
                                        "inner"};

}  // namespace

fem::ConeMatch read_match(Section& section, int dimension) {
  const std::string word =
      section.choice_or("match", kMatches, dimension == 2 ? "plane_strain" : "triaxial_compression");
  return static_cast<fem::ConeMatch>(std::ranges::find(kMatches, word) - kMatches.begin());
}

}  // namespace polargrain::coupler
