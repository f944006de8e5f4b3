// SPDX-License-Identifier: GPL-2.0-or-later
#include "coupler/pool/opinions.hpp"

#include <algorithm>

namespace polargrain::coupler {

void Opinions::remove(const std::string& standing) {
  std::erase_if(list_, [&](const Opinion& each) { return each.standing == standing; });
}

std::vector<Candidate> Opinions::others(const std::vector<Candidate>& present) const {
  std::vector<Candidate> others;
  for (const Candidate& worker : present) {
    const auto is_same = [&](const Opinion& each) {
      return each.worker.worker == worker.worker || each.who == worker.name;
    };
    if (std::none_of(list_.begin(), list_.end(), is_same)) others.push_back(worker);
  }
  return others;
}

int Opinions::news_of(const Candidate& worker) const {
  if (list_.size() > 1 && worker.party.empty()) return 2;
  const bool is_same_party = std::any_of(
      list_.begin(), list_.end(), [&](const Opinion& each) { return each.worker.party == worker.party; });
  if (is_same_party) return 0;
  return worker.party.empty() ? 2 : 1;
}

bool Opinions::may_answer(const Candidate& worker, const std::vector<Candidate>& others) const {
  if (list_.empty()) return true;
  bool is_other = false;
  for (const Candidate& other : others) {
    is_other = is_other || other.worker == worker.worker;
    if (news_of(other) > news_of(worker)) return false;
  }
  return is_other;
}

bool Opinions::same(std::size_t a, std::size_t b) const {
  const CellReply& first = list_[a].reply;
  const CellReply& second = list_[b].reply;
  if (list_[a].numbers != list_[b].numbers || !first.state != !second.state) return false;
  return !first.state || first.state->name() == second.state->name();
}

std::optional<std::size_t> Opinions::agreed() const {
  const bool guests_alone =
      std::none_of(list_.begin(), list_.end(), [](const Opinion& each) { return each.is_ours(); });
  for (std::size_t a = 0; a < list_.size(); ++a)
    for (std::size_t b = a + 1; b < list_.size(); ++b)
      if (same(a, b) && (guests_alone || list_[a].is_ours() || list_[b].is_ours())) return a;
  return std::nullopt;
}

}  // namespace polargrain::coupler
