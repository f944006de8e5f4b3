// SPDX-License-Identifier: GPL-2.0-or-later
#include "coupler/adaptivity/leaders.hpp"

#include <algorithm>

namespace polargrain::coupler {
namespace {

constexpr std::size_t kMostCandidates = 500;

/// Which of the points left a candidate covers.
struct Candidate {
  std::size_t place;  ///< among the points left
  std::vector<std::size_t> covered;
};

std::vector<Candidate> candidates_of(const std::vector<std::size_t>& left,
                                     const std::function<bool(std::size_t, std::size_t)>& covers) {
  const std::size_t stride = (left.size() + kMostCandidates - 1) / kMostCandidates;
  std::vector<Candidate> candidates;
  for (std::size_t place = 0; place < left.size(); place += stride) {
    Candidate candidate{place, {}};
    for (std::size_t other = 0; other < left.size(); ++other) {
      if (other == place || covers(left[place], left[other])) candidate.covered.push_back(other);
    }
    candidates.push_back(std::move(candidate));
  }
  return candidates;
}

}  // namespace

std::vector<std::size_t> choose_leaders(const std::vector<std::size_t>& points,
                                        const std::function<bool(std::size_t, std::size_t)>& covers) {
  std::vector<std::size_t> leaders;
  std::vector<std::size_t> left = points;
  while (!left.empty()) {
    const std::vector<Candidate> candidates = candidates_of(left, covers);
    std::vector<char> done(left.size(), 0);
    for (;;) {
      const Candidate* best = nullptr;
      std::ptrdiff_t most = 0;
      for (const Candidate& candidate : candidates) {
        if (done[candidate.place] != 0) continue;
        const auto fresh = std::count_if(candidate.covered.begin(), candidate.covered.end(),
                                         [&](std::size_t other) { return done[other] == 0; });
        if (fresh > most) {
          most = fresh;
          best = &candidate;
        }
      }
      if (best == nullptr) break;
      leaders.push_back(left[best->place]);
      for (const std::size_t other : best->covered) done[other] = 1;
    }
    std::vector<std::size_t> rest;
    for (std::size_t place = 0; place < left.size(); ++place) {
      if (done[place] == 0) rest.push_back(left[place]);
    }
    left = std::move(rest);
  }
  return leaders;
}

}  // namespace polargrain::coupler
