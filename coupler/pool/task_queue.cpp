// SPDX-License-Identifier: GPL-2.0-or-later
#include "coupler/pool/task_queue.hpp"

#include <utility>

namespace polargrain::coupler {

void TaskQueue::begin(const std::vector<Task>& tasks) {
  clear();
  tasks_ = &tasks;
}

void TaskQueue::clear() {
  common_.clear();
  own_.clear();
  size_ = 0;
}

void TaskQueue::put_in(Queue& queue, std::size_t task, bool first) {
  first ? queue.push_front(task) : queue.push_back(task);
  ++size_;
}

std::vector<std::size_t> TaskQueue::take(std::uint64_t worker, const std::function<bool(const Task&)>& may,
                                         const std::function<std::size_t(const Task&)>& most) {
  const auto own = own_.find(worker);
  Queue* queue = own != own_.end() && !own->second.empty() ? &own->second : nullptr;
  std::size_t passed = 0;
  if (queue == nullptr) {
    // A task that somebody has tried in vain is always in this queue, and may be for others only.
    while (passed < common_.size() && !may((*tasks_)[common_[passed]])) ++passed;
    queue = passed < common_.size() ? &common_ : longest();
  }
  if (queue == nullptr) return {};
  if (queue != &common_) passed = 0;
  // From another's queue what its owner would come to last.
  const bool from_back = queue != &common_ && (own == own_.end() || queue != &own->second);
  const auto next = [&] { return from_back ? queue->back() : (*queue)[passed]; };
  const Task& first = (*tasks_)[next()];
  const std::size_t limit = most(first);
  if (limit == 0) return {};
  std::vector<std::size_t> taken;
  do {
    taken.push_back(next());
    from_back ? queue->pop_back() : void(queue->erase(queue->begin() + static_cast<std::ptrdiff_t>(passed)));
  } while (taken.size() < limit && passed < queue->size() && go_together(first, (*tasks_)[next()]));
  size_ -= taken.size();
  return taken;
}

std::vector<std::size_t> TaskQueue::take_all_of(std::uint64_t worker) {
  const auto own = own_.find(worker);
  if (own == own_.end()) return {};
  const Queue queue = std::exchange(own->second, {});
  size_ -= queue.size();
  return {queue.begin(), queue.end()};
}

TaskQueue::Queue* TaskQueue::longest() {
  Queue* longest = nullptr;
  for (auto& [worker, queue] : own_) {
    if (queue.empty()) continue;
    const Task::Kind kind = (*tasks_)[queue.back()].kind;
    if (kind == Task::Kind::fetch || kind == Task::Kind::resident) continue;
    if (longest == nullptr || queue.size() > longest->size()) longest = &queue;
  }
  return longest;
}

}  // namespace polargrain::coupler
