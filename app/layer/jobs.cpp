// SPDX-License-Identifier: GPL-2.0-or-later
#include "app/layer/jobs.hpp"

#include <fmt/format.h>

#include <cmath>

#include "app/run/interrupt.hpp"
#include "common/standard_streams.hpp"

namespace polargrain::app {

void Jobs::next(const std::string& what, bool there) {
  stop_if_interrupted();
  ++number_;
  if (there || quiet_) return;
  std::string left;
  if (made_ > 0) {
    const double minutes = seconds_since(start_) / made_ * static_cast<double>(count_ - number_ + 1) / 60.0;
    left = fmt::format(", about {:.0f} min left", std::ceil(minutes));
  }
  tell(stderr, "{} ({} of {}{})\n", what, number_, count_, left);
  ++made_;
}

}  // namespace polargrain::app
