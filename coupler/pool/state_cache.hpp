// SPDX-License-Identifier: GPL-2.0-or-later
#pragma once
#include <cstddef>
#include <list>
#include <unordered_map>

#include "common/state.hpp"

namespace polargrain::coupler {

/// The states used last, up to a number of bytes; the one unused longest goes first. A worker keeps states in
/// one; the coordinator keeps one of names for each worker, as its guess at what the worker still has. The
/// guess may be wrong: the worker then answers Missing and the bytes are sent.
///
/// Up to half of the bytes may be held: states that nobody else has, which do not go until they are let go.
class StateCache {
 public:
  explicit StateCache(std::size_t most_bytes) : most_bytes_(most_bytes) {}

  /// Keeps a state and counts it as used now. A state larger than the whole cache is not kept.
  void keep(const StatePointer& state) { keep(state->name(), state, state->size()); }
  /// Notes that a worker keeps a state of this name and size, without holding the bytes.
  void note(const ContentName& name, std::size_t bytes) { keep(name, nullptr, bytes); }
  /// Keeps a state until it is let go. @returns false when there is no room for that; it is then not kept
  bool hold(const StatePointer& state);
  /// The state stays only as one that was used now. Does nothing when it is not held.
  void let_go(const ContentName& name);

  /// Whether the name is here; counts it as used now.
  bool use(const ContentName& name);
  /// The state of that name, counted as used now; null when it is not here.
  StatePointer find(const ContentName& name);
  void forget(const ContentName& name);

  [[nodiscard]] std::size_t bytes() const { return bytes_; }
  [[nodiscard]] std::size_t count() const { return places_.size(); }

 private:
  struct Entry {
    ContentName name;
    StatePointer state;
    std::size_t bytes = 0;
    bool is_held = false;
  };
  using Entries = std::list<Entry>;
  void keep(const ContentName& name, const StatePointer& state, std::size_t bytes);
  void make_room();

  std::size_t most_bytes_;
  std::size_t bytes_ = 0;
  std::size_t held_bytes_ = 0;
  Entries entries_;  ///< used last in front
  Entries held_;     ///< in no order
  std::unordered_map<ContentName, Entries::iterator, ContentNameHash> places_;
};

}  // namespace polargrain::coupler
