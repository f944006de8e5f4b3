// SPDX-License-Identifier: GPL-2.0-or-later
#pragma once
#include <cstdint>
#include <deque>
#include <functional>
#include <unordered_map>
#include <vector>

#include "coupler/pool/task.hpp"

namespace polargrain::coupler {

/// The tasks that nobody works on yet: one queue for all, and one for each worker with those that it should
/// take because it has the states they start from. A worker without any in its own takes from the others': it never
/// waits for the sake of a transfer.
class TaskQueue {
 public:
  /// @param tasks which the numbers below count
  void begin(const std::vector<Task>& tasks);
  void clear();
  void add(std::size_t task) { put_in(common_, task, false); }
  void add_first(std::size_t task) { put_in(common_, task, true); }
  void add_for(std::uint64_t worker, std::size_t task) { put_in(own_[worker], task, false); }
  [[nodiscard]] std::size_t size() const { return size_; }

  /// The next work of this worker, as tasks that go together; empty when there is nothing it can do.
  /// @param may whether a task may go to this worker at all; others are passed over
  /// @param most how many, given the first of them; 0 when that one is not for this worker now
  std::vector<std::size_t> take(std::uint64_t worker, const std::function<bool(const Task&)>& may,
                                const std::function<std::size_t(const Task&)>& most);
  /// Takes back a task that everybody may do; nothing when it is not there.
  void remove(std::size_t task) { size_ -= std::erase(common_, task); }
  /// All that was put aside for a worker.
  std::vector<std::size_t> take_all_of(std::uint64_t worker);

 private:
  using Queue = std::deque<std::size_t>;
  void put_in(Queue& queue, std::size_t task, bool first);
  /// The longest queue of another worker whose tasks can be done by anybody.
  Queue* longest();

  const std::vector<Task>* tasks_ = nullptr;
  Queue common_;
  std::unordered_map<std::uint64_t, Queue> own_;
  std::size_t size_ = 0;
};

}  // namespace polargrain::coupler
