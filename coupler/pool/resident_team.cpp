// SPDX-License-Identifier: GPL-2.0-or-later
#include "coupler/pool/resident_team.hpp"

#include <algorithm>
#include <utility>

#include "common/error.hpp"

namespace polargrain::coupler {

template <class Request>
ResidentWork ResidentTeam::work_for(const Share& share, std::size_t first, std::size_t count,
                                    Request request) const {
  request.definition = definition_;
  return {share.worker, share.first + first, count, std::move(request)};
}

void ResidentTeam::serve(std::vector<ResidentWork>& works) try {
  pool_.serve(definition_, works);
} catch (const RunError&) {
  shares_.clear();
  throw;
}

void ResidentTeam::move_in(std::span<const ResidentStart> starts) {
  const std::vector<std::uint64_t> workers = pool_.gather();
  workers_ = workers.size();
  const std::size_t shares = std::min(workers.size(), starts.size());
  shares_.clear();
  for (std::size_t k = 0; k < shares; ++k) {
    const std::size_t first = starts.size() * k / shares;
    shares_.push_back({workers[k], first, starts.size() * (k + 1) / shares - first});
  }
  std::vector<ResidentWork> works;
  for (const Share& share : shares_) {
    for (std::size_t first = 0; first < share.count; first += kMostStatesOfBoxes) {
      const std::size_t count = std::min(kMostStatesOfBoxes, share.count - first);
      const auto some = starts.subspan(share.first + first, count);
      MoveIn request;
      request.first = static_cast<std::uint32_t>(first);
      request.starts.assign(some.begin(), some.end());
      works.push_back(work_for(share, first, count, std::move(request)));
    }
  }
  serve(works);
  if (!works.empty()) time_step_ = works.front().reply.time_step;
}

std::vector<ResidentAnswer> ResidentTeam::go_on(int dem_steps, std::span<const CellIncrement> increments) {
  if (increments.size() != count())
    throw RunError("a step of resident boxes needs an increment for each of them");
  std::vector<ResidentWork> works;
  for (const Share& share : shares_) {
    const auto some = increments.subspan(share.first, share.count);
    GoOn request;
    request.dem_steps = dem_steps;
    request.increments.assign(some.begin(), some.end());
    works.push_back(work_for(share, 0, share.count, std::move(request)));
  }
  serve(works);
  std::vector<ResidentAnswer> answers;
  answers.reserve(increments.size());
  for (const ResidentWork& work : works)
    answers.insert(answers.end(), work.reply.answers.begin(), work.reply.answers.end());
  return answers;
}

std::vector<ResidentReadOut> ResidentTeam::read_out() {
  std::vector<ResidentWork> works;
  for (const Share& share : shares_) {
    for (std::size_t first = 0; first < share.count; first += kMostStatesOfBoxes) {
      ReadOut request;
      request.first = static_cast<std::uint32_t>(first);
      request.count = static_cast<std::uint32_t>(std::min(kMostStatesOfBoxes, share.count - first));
      works.push_back(work_for(share, first, request.count, request));
    }
  }
  serve(works);
  std::vector<ResidentReadOut> boxes;
  boxes.reserve(count());
  for (ResidentWork& work : works) std::ranges::move(work.reply.read_outs, std::back_inserter(boxes));
  return boxes;
}

bool ResidentTeam::could_spread() const {
  return pool_.present_count() > workers_ && count() > workers_;
}

std::size_t ResidentTeam::count() const {
  return shares_.empty() ? 0 : shares_.back().first + shares_.back().count;
}

}  // namespace polargrain::coupler
