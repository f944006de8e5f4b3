// SPDX-License-Identifier: GPL-2.0-or-later
#include "coupler/pool/state_cache.hpp"

namespace polargrain::coupler {

bool StateCache::use(const ContentName& name) {
  const auto place = places_.find(name);
  if (place == places_.end()) return false;
  if (!place->second->is_held) entries_.splice(entries_.begin(), entries_, place->second);
  return true;
}

StatePointer StateCache::find(const ContentName& name) {
  return use(name) ? places_.at(name)->state : nullptr;
}

void StateCache::forget(const ContentName& name) {
  const auto place = places_.find(name);
  if (place == places_.end()) return;
  const Entries::iterator entry = place->second;
  bytes_ -= entry->bytes;
  if (entry->is_held) held_bytes_ -= entry->bytes;
  places_.erase(place);
  (entry->is_held ? held_ : entries_).erase(entry);
}

void StateCache::keep(const ContentName& name, const StatePointer& state, std::size_t bytes) {
  if (use(name) || bytes > most_bytes_ - held_bytes_) return;
  entries_.push_front({name, state, bytes});
  places_[name] = entries_.begin();
  bytes_ += bytes;
  make_room();
}

bool StateCache::hold(const StatePointer& state) {
  const auto place = places_.find(state->name());
  if (place != places_.end() && place->second->is_held) return true;
  if (held_bytes_ + state->size() > most_bytes_ / 2) return false;
  forget(state->name());
  held_.push_front({state->name(), state, state->size(), true});
  places_[state->name()] = held_.begin();
  bytes_ += state->size();
  held_bytes_ += state->size();
  make_room();
  return true;
}

void StateCache::let_go(const ContentName& name) {
  const auto place = places_.find(name);
  if (place == places_.end() || !place->second->is_held) return;
  place->second->is_held = false;
  held_bytes_ -= place->second->bytes;
  entries_.splice(entries_.begin(), held_, place->second);
}

void StateCache::make_room() {
  while (bytes_ > most_bytes_) forget(ContentName(entries_.back().name));
}

}  // namespace polargrain::coupler
