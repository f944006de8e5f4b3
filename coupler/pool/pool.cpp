// SPDX-License-Identifier: GPL-2.0-or-later
#include "coupler/pool/pool.hpp"

#include <fmt/format.h>
#include <malloc.h>

#include <algorithm>
#include <limits>
#include <random>
#include <unordered_map>

#include "common/error.hpp"
#include "coupler/pool/foreman.hpp"
#include "coupler/pool/request_sharing.hpp"

namespace polargrain::coupler {
namespace {

/// States collected at a time: on their way they take memory beside their final place.
constexpr std::size_t kMostBytesOnTheWay = std::size_t{16} << 20;

/// The states of a step come while those of the step before are still there, and take the place of the ones
/// before these. Given back to the system in between, that memory would have to be taken, and cleared by the
/// system, once more in every step, which costs more than all the rest that is done with a state.
void keep_freed_memory() {
  mallopt(M_TRIM_THRESHOLD, std::numeric_limits<int>::max());
  mallopt(M_MMAP_THRESHOLD, 1 << 25);
}

using StatesByName = std::unordered_map<ContentName, StatePointer, ContentNameHash>;

bool is_elsewhere(const StatePointer& state) {
  return state && !state->is_here();
}

/// The tasks that bring the bytes of these states: each once, those of one worker next to each other.
std::vector<Task> tasks_to_bring(std::span<const StatePointer> states, const StateBook& book,
                                 StatesByName& found) {
  std::vector<std::pair<std::uint64_t, Task>> tasks;
  for (const StatePointer& state : states) {
    if (!is_elsewhere(state)) continue;
    const auto [place, is_new] = found.emplace(state->name(), book.find_here(state->name()));
    if (!is_new || place->second) continue;
    const Origin* const origin = book.origin(state->name());
    if (origin == nullptr) throw RunError("the bytes of a state are with nobody any more");
    Task task;
    task.kind = Task::Kind::fetch;
    task.definition = origin->definition;
    task.cell = origin->request;
    task.wanted = state;
    task.evidence = origin->evidence;
    tasks.emplace_back(book.home(state->name()), std::move(task));
  }
  std::stable_sort(tasks.begin(), tasks.end(),
                   [](const auto& a, const auto& b) { return a.first < b.first; });
  std::vector<Task> sorted;
  for (auto& [home, task] : tasks) sorted.push_back(std::move(task));
  return sorted;
}

}  // namespace

class Pool::Implementation {
 public:
  explicit Implementation(PoolOptions options) : foreman(std::move(options)) { keep_freed_memory(); }

  std::vector<CellReply> evaluate(std::span<const PoolRequest> requests) {
    std::vector<StatePointer> starts;
    for (const PoolRequest& request : requests) starts.push_back(request.cell.state);
    starts = collect(starts);
    const std::vector<std::size_t> first = first_alike(requests);
    std::vector<std::size_t> task_of(requests.size());
    std::vector<Task> tasks;
    for (std::size_t r = 0; r < requests.size(); ++r) {
      const PoolRequest& request = requests[r];
      static_cast<void>(foreman.definition(request.definition));
      task_of[r] = first[r] == r ? tasks.size() : task_of[first[r]];
      if (first[r] != r) continue;
      tasks.push_back({Task::Kind::evaluate,
                       request.definition,
                       {starts[r], request.cell.increment},
                       request.point,
                       nullptr});
      tasks.back().checked = is_drawn();
    }
    foreman.work(tasks);
    note_failure(tasks);
    std::vector<CellReply> replies;
    replies.reserve(requests.size());
    for (std::size_t r = 0; r < requests.size(); ++r) {
      CellReply& reply = tasks[task_of[r]].reply;
      tasks.size() == requests.size() ? replies.push_back(std::move(reply)) : replies.push_back(reply);
    }
    if (on_answers) {
      std::vector<PoolRequest> asked(requests.begin(), requests.end());
      for (std::size_t r = 0; r < asked.size(); ++r) asked[r].cell.state = starts[r];
      on_answers(asked, replies);
    }
    return replies;
  }

  std::vector<StatePointer> collect(std::span<const StatePointer> states) {
    StatesByName found;
    std::vector<Task> tasks = tasks_to_bring(states, foreman.book(), found);
    for (auto next = tasks.begin(); next != tasks.end();) {
      std::vector<Task> some;
      for (std::size_t bytes = 0; next != tasks.end() && bytes < kMostBytesOnTheWay; ++next) {
        bytes += next->wanted->size();
        some.push_back(std::move(*next));
      }
      foreman.work(some);
      for (const Task& task : some) found[task.wanted->name()] = task.reply.state;
    }
    std::vector<StatePointer> here;
    here.reserve(states.size());
    for (const StatePointer& state : states)
      here.push_back(is_elsewhere(state) ? found[state->name()] : state);
    return here;
  }

  CellReply initial(std::uint32_t definition) {
    static_cast<void>(foreman.definition(definition));
    std::vector<Task> tasks{{Task::Kind::rest, definition}};
    tasks.front().checked = foreman.check_share() > 0.0;  // all that follows starts from it
    foreman.work(tasks);
    return std::move(tasks.front().reply);
  }

  void serve(std::uint32_t definition, std::vector<ResidentWork>& works) {
    std::vector<Task> tasks(works.size());
    for (std::size_t k = 0; k < works.size(); ++k) {
      tasks[k].kind = Task::Kind::resident;
      tasks[k].definition = definition;
      tasks[k].alone = true;
      tasks[k].residents = std::move(works[k]);
    }
    foreman.work(tasks);
    for (std::size_t k = 0; k < works.size(); ++k) works[k] = std::move(*tasks[k].residents);
  }

  Foreman foreman;
  std::optional<CellFailure> failure;
  std::function<void(std::span<const PoolRequest>, std::span<const CellReply>)> on_answers;

 private:
  /// Whether the next evaluation is checked: by its place in the order of all, whoever takes it and when.
  bool is_drawn() { return static_cast<double>(draws_() >> 11) * 0x1p-53 < foreman.check_share(); }

  /// The first in the order of the requests, whoever was faster.
  void note_failure(const std::vector<Task>& tasks) {
    failure.reset();
    const auto failed = std::find_if(tasks.begin(), tasks.end(), [](const Task& task) {
      return task.reply.response.quality == Quality::failed;
    });
    if (failed == tasks.end()) return;
    failure = CellFailure{failed->definition, failed->cell, failed->point, failed->reply.response.message};
  }

  std::mt19937_64 draws_{20261122};
};

Pool::Pool(PoolOptions options) : implementation_(std::make_unique<Implementation>(std::move(options))) {}
Pool::~Pool() = default;

std::uint32_t Pool::define(CellDefinition definition) {
  return implementation_->foreman.define(std::move(definition));
}
const CellDefinition& Pool::definition(std::uint32_t number) const {
  return implementation_->foreman.definition(number);
}
CellReply Pool::initial(std::uint32_t definition) {
  return implementation_->initial(definition);
}
std::vector<CellReply> Pool::evaluate(std::span<const PoolRequest> requests) {
  return implementation_->evaluate(requests);
}
std::vector<StatePointer> Pool::collect(std::span<const StatePointer> states) {
  return implementation_->collect(states);
}
const std::optional<CellFailure>& Pool::last_failure() const {
  return implementation_->failure;
}
void Pool::on_progress(std::function<void(std::size_t, std::size_t)> call) {
  implementation_->foreman.progress = std::move(call);
}
void Pool::on_answers(std::function<void(std::span<const PoolRequest>, std::span<const CellReply>)> call) {
  implementation_->on_answers = std::move(call);
}
const std::map<std::string, WorkerRecord>& Pool::worker_records() const {
  return implementation_->foreman.records;
}
const PoolCounts& Pool::counts() const {
  return implementation_->foreman.counts;
}
std::string Pool::listening_url() const {
  return implementation_->foreman.switchboard().remote_url();
}
std::size_t Pool::refused() const {
  return implementation_->foreman.switchboard().refused();
}
int Pool::workers() const {
  return implementation_->foreman.workers();
}
void Pool::tell(const std::string& text) const {
  implementation_->foreman.tell(text);
}
std::vector<std::uint64_t> Pool::gather() {
  return implementation_->foreman.gather();
}
std::size_t Pool::present_count() const {
  return implementation_->foreman.present_count();
}
void Pool::serve(std::uint32_t definition, std::vector<ResidentWork>& works) {
  implementation_->serve(definition, works);
}

}  // namespace polargrain::coupler
