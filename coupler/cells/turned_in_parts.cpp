// SPDX-License-Identifier: GPL-2.0-or-later
#include "coupler/cells/turned_in_parts.hpp"

#include <algorithm>
#include <cmath>

#include "coupler/cells/successive.hpp"

namespace polargrain::coupler {
namespace {

template <int dim>
int parts_of(const Increment<dim>& increment) {
  if (increment.configuration == Configuration::fixed) return 1;
  return std::max(1, static_cast<int>(std::ceil(turn_of(increment) / kTurnAskedAtOnce)));
}

}  // namespace

template <int dim>
std::vector<PointReply<dim>> evaluate_in_parts(
    const CellCalls<dim>& calls, std::type_identity_t<std::span<const PointRequest<dim>>> requests,
    std::span<const std::size_t> points) {
  int most = 1;
  for (const PointRequest<dim>& request : requests) most = std::max(most, parts_of(request.increment));
  if (most == 1) return calls.evaluate(requests, points);
  std::vector<PointReply<dim>> replies(requests.size());
  for (int part = 0; part < most; ++part) {
    std::vector<PointRequest<dim>> asked;
    std::vector<std::size_t> of_points;
    std::vector<std::size_t> places;
    for (std::size_t k = 0; k < requests.size(); ++k) {
      const Increment<dim>& whole = requests[k].increment;
      const int parts = parts_of(whole);
      if (part >= parts || (part > 0 && replies[k].response.quality == Quality::failed)) continue;
      PointRequest<dim> request = requests[k];
      if (part > 0) request.state = replies[k].state;
      if (part > 0 && request.start != nullptr) request.start = &replies[k].response;
      if (parts > 1)
        request.increment = offset_between(share_of(whole, static_cast<double>(part) / parts),
                                           share_of(whole, static_cast<double>(part + 1) / parts));
      asked.push_back(std::move(request));
      of_points.push_back(points[k]);
      places.push_back(k);
    }
    std::vector<PointReply<dim>> answers = calls.evaluate(asked, of_points);
    for (std::size_t a = 0; a < answers.size(); ++a) {
      answers[a].diagnostics.dem_steps += replies[places[a]].diagnostics.dem_steps;
      replies[places[a]] = std::move(answers[a]);
    }
  }
  return replies;
}

template std::vector<PointReply<2>> evaluate_in_parts(const CellCalls<2>&, std::span<const PointRequest<2>>,
                                                      std::span<const std::size_t>);
template std::vector<PointReply<3>> evaluate_in_parts(const CellCalls<3>&, std::span<const PointRequest<3>>,
                                                      std::span<const std::size_t>);

}  // namespace polargrain::coupler
