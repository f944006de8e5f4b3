// SPDX-License-Identifier: GPL-2.0-or-later
#include "coupler/pool/state_cache.hpp"

namespace polargrain::coupler {

bool StateCache::use(const ContentName& name) {
  const auto place = places_.find(name);
  if (place == places_.end()) return false;
  entries_.splice(entries_.begin(), entries_, place->second);
  return true;
}

StatePointer StateCache::find(const ContentName& name) {
  return use(name) ? entries_.front().state : nullptr;
}

void StateCache::forget(const ContentName& name) {
  const auto place = places_.find(name);
  if (place == places_.end()) return;
  bytes_ -= place->second->bytes;
  entries_.erase(place->second);
  places_.erase(place);
}

void StateCache::keep(const ContentName& name, const StatePointer& state, std::size_t bytes) {
  if (use(name) || bytes > most_bytes_) return;
  entries_.push_front({name, state, bytes});
  places_[name] = entries_.begin();
  bytes_ += bytes;
  while (bytes_ > most_bytes_) forget(ContentName(entries_.back().name));
}

}  // namespace polargrain::coupler
