// SPDX-License-Identifier: GPL-2.0-or-later
#pragma once
#include <string>
#include <vector>

#include "common/error.hpp"

namespace polargrain::app {

/// How wrong a result would be, worst first.
enum class Rank {
  wrong,     ///< its figures are of another scene than the one that was meant
  doubtful,  ///< its figures may be off by more than a user would accept
  costly     ///< its figures stand, and time or output is lost
};

/// Something in a case that runs, and that an experienced colleague would ask about. A case that cannot be right at all
/// has a fault instead (coupler/case).
struct Remark {
  Rank rank = Rank::doubtful;
  /// Within the rank: how many times a figure is off, or beyond its bound; at least 1.
  double weight = 1.0;
  Fault at;            ///< file, line, and the finding there, with its number
  std::string remedy;  ///< the action advised
};

using Remarks = std::vector<Remark>;

}  // namespace polargrain::app
