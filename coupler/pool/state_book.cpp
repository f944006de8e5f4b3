// SPDX-License-Identifier: GPL-2.0-or-later
#include "coupler/pool/state_book.hpp"

#include <utility>

namespace polargrain::coupler {

void StateBook::Pages::remove(const ContentName& name, const State* place) {
  const auto found = entries.find(name);
  if (found == entries.end()) return;
  Entry& entry = found->second;
  if (entry.without.place == place) {
    entry.without = {};
    const StatePointer done = std::move(entry.bytes);  // ends behind the last use of the entry
    return;
  }
  if (entry.given.place != place) return;
  // The entry may hold the last pointer to another state, whose entry then goes too: that must not
  // happen while the table is at work on this one.
  const auto removed = entries.extract(found);
  release(name, removed.mapped().home);
}

void StateBook::Pages::release(const ContentName& name, std::uint64_t worker) {
  if (worker != 0) released[worker].push_back(name);
}

StatePointer StateBook::watched(const StatePointer& state) const {
  const std::weak_ptr<Pages> pages = pages_;
  return {state.get(), [state, pages](const State* place) {
            if (const auto still = pages.lock()) still->remove(place->name(), place);
          }};
}

StatePointer StateBook::enter(const StatePointer& state, std::uint64_t worker, const Origin& origin) {
  Entry& entry = pages_->entries[state->name()];
  if (StatePointer known = entry.given.state.lock()) {
    if (state->is_here()) return known->is_here() ? known : arrived(state, worker);
    // Made twice: one worker that keeps it is enough, and no worker need keep it when it is here.
    if (known->is_here()) {
      pages_->release(state->name(), worker);
      if (entry.home == worker) entry.home = 0;
    } else if (entry.home != worker) {
      pages_->release(state->name(), std::exchange(entry.home, worker));
    }
    return known;
  }
  const StatePointer pointer = watched(state);
  entry.given = {pointer, pointer.get()};
  entry.home = worker;
  if (!state->is_here()) entry.origin = origin;
  return pointer;
}

StatePointer StateBook::arrived(const StatePointer& state, std::uint64_t worker) {
  const StatePointer pointer = watched(state);
  Entry& entry = pages_->entries[state->name()];
  const StatePointer before = entry.given.state.lock();
  if (before && !before->is_here()) {
    entry.without = entry.given;
    entry.bytes = pointer;
  }
  entry.given = {pointer, pointer.get()};
  if (entry.home != worker) pages_->release(state->name(), std::exchange(entry.home, worker));
  const std::optional<Origin> done = std::move(entry.origin);  // ends behind the last use of the entry
  entry.origin.reset();
  return pointer;
}

StatePointer StateBook::find_here(const ContentName& name) const {
  const auto found = pages_->entries.find(name);
  StatePointer state = found == pages_->entries.end() ? nullptr : found->second.given.state.lock();
  return state && state->is_here() ? state : nullptr;
}

const Origin* StateBook::origin(const ContentName& name) const {
  const auto found = pages_->entries.find(name);
  return found == pages_->entries.end() || !found->second.origin ? nullptr : &*found->second.origin;
}

std::uint64_t StateBook::home(const ContentName& name) const {
  const auto found = pages_->entries.find(name);
  return found == pages_->entries.end() ? 0 : found->second.home;
}

void StateBook::move_home(const ContentName& name, std::uint64_t worker) {
  const auto found = pages_->entries.find(name);
  if (found != pages_->entries.end()) found->second.home = worker;
}

std::vector<ContentName> StateBook::take_released(std::uint64_t worker) {
  const auto found = pages_->released.find(worker);
  if (found == pages_->released.end()) return {};
  std::vector<ContentName> names = std::move(found->second);
  pages_->released.erase(found);
  return names;
}

void StateBook::forget_worker(std::uint64_t worker) {
  pages_->released.erase(worker);
}

}  // namespace polargrain::coupler
