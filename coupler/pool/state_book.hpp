// SPDX-License-Identifier: GPL-2.0-or-later
#pragma once
#include <cstdint>
#include <memory>
#include <optional>
#include <unordered_map>
#include <vector>

#include "common/cell.hpp"
#include "coupler/pool/evidence.hpp"

namespace polargrain::coupler {

/// How a state came about: enough to make it again, to the bit.
struct Origin {
  std::uint32_t definition = 0;
  CellRequest request;  ///< its state is here, or null
  Evidence evidence = {};
};

/// The coordinator's record of the states it has given out: which worker has the bytes, and, of those whose
/// bytes are with that worker alone (states on trial), how to make them again. An entry lives as long as
/// somebody has a pointer to its state: who lets go of the last one needs to tell nobody.
///
/// Workers go by the numbers of their Member; one that is lost may stay in the book.
class StateBook {
 public:
  /// Enters the state of a reply. @returns the pointer to hand out; there is one for every name
  StatePointer enter(const StatePointer& state, std::uint64_t worker, const Origin& origin);
  /// The bytes of a state that was on trial. @param worker who brought them, and keeps a copy for now
  /// @returns the pointer to hand out from now on
  StatePointer arrived(const StatePointer& state, std::uint64_t worker);
  /// The state of that name with its bytes, when somebody still has it; else null.
  [[nodiscard]] StatePointer find_here(const ContentName& name) const;
  /// @returns null when nothing is known of it, or its bytes are here
  [[nodiscard]] const Origin* origin(const ContentName& name) const;

  /// The worker that should have the bytes, as far as is known; 0 when nothing is.
  [[nodiscard]] std::uint64_t home(const ContentName& name) const;
  /// Another worker was sent the bytes; the last one counts.
  void move_home(const ContentName& name, std::uint64_t worker);

  /// States that a worker need not keep any longer, because nobody can name them any more; told once.
  std::vector<ContentName> take_released(std::uint64_t worker);
  /// Nothing is told to a worker that is lost.
  void forget_worker(std::uint64_t worker);

 private:
  /// A state, and its place, to know it by when it goes.
  struct Watched {
    std::weak_ptr<const State> state;
    const State* place = nullptr;
  };
  struct Entry {
    Watched given;       ///< the state that is handed out
    Watched without;     ///< the same without its bytes: somebody has held it since before they came
    StatePointer bytes;  ///< keeps them for those holders, who may ask for them
    std::uint64_t home = 0;
    std::optional<Origin> origin;  ///< of a state on trial
  };
  struct Pages {
    std::unordered_map<ContentName, Entry, ContentNameHash> entries;
    std::unordered_map<std::uint64_t, std::vector<ContentName>> released;
    void remove(const ContentName& name, const State* place);
    void release(const ContentName& name, std::uint64_t worker);
  };
  /// Points to `state`; the last copy to go removes the entry.
  [[nodiscard]] StatePointer watched(const StatePointer& state) const;

  std::shared_ptr<Pages> pages_ = std::make_shared<Pages>();
};

}  // namespace polargrain::coupler
