// SPDX-License-Identifier: GPL-2.0-or-later
#pragma once
#include <cstddef>
#include <list>
#include <map>

#include "common/state.hpp"

namespace polargrain::coupler {

/// The states used last, up to a number of bytes; the one unused longest goes first. A worker keeps states in
/// one; the coordinator keeps one of names for each worker, as its guess at what the worker still has. The
/// guess may be wrong: the worker then answers MissingState and the bytes are sent.
class StateCache {
 public:
  explicit StateCache(std::size_t most_bytes) : most_bytes_(most_bytes) {}

  /// Keeps a state and counts it as used now. A state larger than the whole cache is not kept.
  void keep(const StatePointer& state) { keep(state->name(), state, state->bytes().size()); }
  /// Notes that a worker keeps a state of this name and size, without holding the bytes.
  void note(const ContentName& name, std::size_t bytes) { keep(name, nullptr, bytes); }

  /// Whether the name is here; counts it as used now.
  bool use(const ContentName& name);
  /// The state of that name, counted as used now; null when it is not here.
  StatePointer find(const ContentName& name);
  void forget(const ContentName& name);

  [[nodiscard]] std::size_t bytes() const { return bytes_; }
  [[nodiscard]] std::size_t count() const { return entries_.size(); }

 private:
  struct Entry {
    ContentName name;
    StatePointer state;
    std::size_t bytes = 0;
  };
  void keep(const ContentName& name, const StatePointer& state, std::size_t bytes);

  std::size_t most_bytes_;
  std::size_t bytes_ = 0;
  std::list<Entry> entries_;  ///< used last in front
  std::map<ContentName, std::list<Entry>::iterator> places_;
};

}  // namespace polargrain::coupler
