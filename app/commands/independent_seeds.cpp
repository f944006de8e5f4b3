// SPDX-License-Identifier: GPL-2.0-or-later
#include "app/commands/independent_seeds.hpp"

#include <fmt/format.h>

#include <algorithm>

#include "common/error.hpp"

namespace polargrain::app {

void check_independent_seeds(std::vector<int> seeds, const std::string& option) {
  std::ranges::sort(seeds);
  const auto twice = std::ranges::adjacent_find(seeds);
  if (twice == seeds.end()) return;
  throw InputError(
      {option, 0,
       fmt::format("seed {} stands twice; it makes the same grains again, and they are no independent "
                   "samples. Give each seed once",
                   *twice)});
}

}  // namespace polargrain::app
