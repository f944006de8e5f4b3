// SPDX-License-Identifier: GPL-2.0-or-later
#include "coupler/cells/turned_in_parts.hpp"

#include <algorithm>
#include <cmath>

#include "coupler/cells/successive.hpp"
#include "fem/material/rotation.hpp"

namespace polargrain::coupler {
namespace {

int parts_of(const Increment<2>& increment) {
  if (increment.configuration == Configuration::fixed) return 1;
  return std::max(1,
                  static_cast<int>(std::ceil(std::abs(fem::rotation_angle(increment)) / kTurnAskedAtOnce)));
}

}  // namespace

std::vector<PlaneReply> evaluate_in_parts(const CellCalls& calls, std::span<const PlaneRequest> requests,
                                          std::span<const std::size_t> points) {
  int most = 1;
  for (const PlaneRequest& request : requests) most = std::max(most, parts_of(request.increment));
  if (most == 1) return calls.evaluate(requests, points);
  std::vector<PlaneReply> replies(requests.size());
  for (int part = 0; part < most; ++part) {
    std::vector<PlaneRequest> asked;
    std::vector<std::size_t> of_points;
    std::vector<std::size_t> places;
    for (std::size_t k = 0; k < requests.size(); ++k) {
      const Increment<2>& whole = requests[k].increment;
      const int parts = parts_of(whole);
      if (part >= parts || (part > 0 && replies[k].response.quality == Quality::failed)) continue;
      PlaneRequest request = requests[k];
      if (part > 0) request.state = replies[k].state;
      if (parts > 1)
        request.increment = offset_between(share_of(whole, static_cast<double>(part) / parts),
                                           share_of(whole, static_cast<double>(part + 1) / parts));
      asked.push_back(std::move(request));
      of_points.push_back(points[k]);
      places.push_back(k);
    }
    std::vector<PlaneReply> answers = calls.evaluate(asked, of_points);
    for (std::size_t a = 0; a < answers.size(); ++a) {
      answers[a].diagnostics.dem_steps += replies[places[a]].diagnostics.dem_steps;
      replies[places[a]] = std::move(answers[a]);
    }
  }
  return replies;
}

}  // namespace polargrain::coupler
