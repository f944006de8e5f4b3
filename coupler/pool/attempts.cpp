// SPDX-License-Identifier: GPL-2.0-or-later
#include "coupler/pool/attempts.hpp"

#include <algorithm>
#include <set>

namespace polargrain::coupler {

int Attempts::news_of(const Candidate& worker) const {
  int news = worker.party.empty() ? 3 : 2;
  for (const Attempt& attempt : list_) {
    if (attempt.worker == worker.worker) return 0;
    // Who was killed by somebody else has said nothing for its party.
    if (attempt.party == worker.party && attempt.end != Attempt::End::from_outside) news = 1;
  }
  return news;
}

bool Attempts::may_try(const Candidate& worker, const std::vector<Candidate>& present) const {
  if (list_.empty()) return true;
  const int news = news_of(worker);
  return std::none_of(present.begin(), present.end(),
                      [&](const Candidate& other) { return news_of(other) > news; });
}

bool Attempts::are_enough(const std::vector<Candidate>& present) const {
  std::set<std::uint64_t> workers;
  std::set<std::string> parties;
  int by_work = 0;
  int from_outside = 0;
  for (const Attempt& attempt : list_) {
    if (attempt.end == Attempt::End::from_outside) {
      ++from_outside;
      continue;
    }
    ++by_work;
    workers.insert(attempt.worker);
    parties.insert(attempt.party);
  }
  if (from_outside >= kMostFromOutside) return true;
  if (by_work < kMostByWork) return false;
  int most_news = 0;
  for (const Candidate& worker : present) most_news = std::max(most_news, news_of(worker));
  if (most_news == 3 || (most_news == 2 && parties.size() < 2)) return false;
  return most_news == 0 || workers.size() >= 2;
}

}  // namespace polargrain::coupler
