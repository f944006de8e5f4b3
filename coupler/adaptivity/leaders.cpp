// SPDX-License-Identifier: GPL-2.0-or-later
#include "coupler/adaptivity/leaders.hpp"

#include <algorithm>

namespace polargrain::coupler {
namespace {

constexpr std::size_t kMostCandidates = 500;
constexpr std::size_t kMostDirections = 6;
constexpr double kSameDirection = 0.5;  // cosine of 60 degrees

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

template <int dim>
std::vector<std::size_t> span_directions(
    const std::vector<std::size_t>& points,
    const std::function<typename Cosserat<dim>::Vector(std::size_t)>& strain, double least) {
  using Vector = typename Cosserat<dim>::Vector;
  std::vector<std::size_t> left = points;
  std::stable_sort(left.begin(), left.end(), [&](std::size_t a, std::size_t b) {
    return strain(a).squaredNorm() > strain(b).squaredNorm();
  });
  std::vector<std::size_t> chosen;
  std::vector<Vector> directions;
  for (const std::size_t point : left) {
    const Vector own = strain(point);
    if (!chosen.empty() && (own.norm() < least || chosen.size() == kMostDirections)) break;
    const bool is_new = std::ranges::all_of(directions, [&](const Vector& direction) {
      return own.dot(direction) < kSameDirection * own.norm();
    });
    if (!is_new) continue;
    chosen.push_back(point);
    directions.push_back(own.normalized());
  }
  return chosen;
}

template std::vector<std::size_t> span_directions<2>(const std::vector<std::size_t>&,
                                                     const std::function<Vector7(std::size_t)>&, double);
template std::vector<std::size_t> span_directions<3>(const std::vector<std::size_t>&,
                                                     const std::function<Vector18(std::size_t)>&, double);

}  // namespace polargrain::coupler
