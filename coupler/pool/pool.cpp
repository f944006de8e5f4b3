// SPDX-License-Identifier: GPL-2.0-or-later
#include "coupler/pool/pool.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <deque>

#include "common/error.hpp"
#include "coupler/pool/crew.hpp"
#include "coupler/pool/request_sharing.hpp"

namespace polargrain::coupler {
namespace {

using Clock = std::chrono::steady_clock;

double seconds_since(Clock::time_point start) {
  return std::chrono::duration<double>(Clock::now() - start).count();
}

Clock::duration seconds(double value) {
  return std::chrono::duration_cast<Clock::duration>(std::chrono::duration<double>(value));
}

/// Workers that a cell may end before it is taken to be the cell's fault: by an end of the engine's own
/// making, and by one that came from outside, which the memory a cell takes may also bring about.
constexpr int kMostEndsByWork = 2;
constexpr int kMostEndsFromOutside = 10;

/// How often the clocks of the workers are looked at, at least.
constexpr std::chrono::milliseconds kLongestTick{500};
constexpr double kTicksInSilence = 20.0;

/// A request without a sign of life is sent again so many times before its worker is given up for silent.
constexpr double kResends = 10.0;
constexpr double kHeartbeatsInSilence = 30.0;

/// A request on its way: what to send, and where the reply goes.
struct Task {
  std::uint32_t definition;
  const CellRequest* cell;  ///< null: the packing at rest
  std::optional<std::size_t> point = {};
  CellReply reply = {};
  int ends_by_work = 0;
  int ends_from_outside = 0;
};

std::string own_program() {
  return std::filesystem::read_symlink("/proc/self/exe").string();
}

CrewOptions crew_options(const PoolOptions& options) {
  if (options.workers < 1 && !options.listening) throw RunError("a pool needs at least one worker");
  CrewOptions crew;
  crew.workers = options.workers;
  crew.directory = options.directory;
  crew.worker_command = options.worker_command;
  if (crew.worker_command.empty()) crew.worker_command = {own_program(), "worker"};
  crew.startup_seconds = options.startup_seconds;
  crew.cache_bytes = options.cache_bytes;
  crew.heartbeat_seconds = options.patience.silence_seconds / kHeartbeatsInSilence;
  crew.listening = options.listening;
  crew.tell = options.tell;
  return crew;
}

}  // namespace

class Pool::Implementation final : private CrewEvents {
 public:
  explicit Implementation(PoolOptions options)
      : options_(std::move(options)), crew_(crew_options(options_), *this) {
    crew_.start();
  }

  std::uint32_t define(CellDefinition definition) {
    definitions_.push_back({std::move(definition)});
    return static_cast<std::uint32_t>(definitions_.size() - 1);
  }

  void work(std::vector<Task>& tasks) {
    const Clock::time_point start = Clock::now();
    tasks_ = &tasks;
    done_ = 0;
    queue_.clear();
    for (std::size_t t = 0; t < tasks.size(); ++t) queue_.push_back(t);
    failure.reset();
    for (Member& member : crew_.members()) give_next(member);
    Clock::time_point last = start;
    while (done_ < tasks.size()) {
      crew_.listen(tick_);
      const Clock::time_point now = Clock::now();
      counts.member_seconds +=
          static_cast<double>(crew_.members().size()) * std::chrono::duration<double>(now - last).count();
      forgive(now - last - tick_);
      last = now;
      check_clocks();
      if (progress) progress(done_, tasks.size());
    }
    tasks_ = nullptr;
    counts.bytes_sent = crew_.bytes_sent();
    counts.bytes_received = crew_.bytes_received();
    counts.wall_seconds += seconds_since(start);
  }

  const CellDefinition& definition(std::uint32_t number) const {
    if (number >= definitions_.size()) throw RunError(fmt::format("no cell is defined as {}", number));
    return definitions_[number].cell;
  }

  std::function<void(std::size_t, std::size_t)> progress;
  PoolCounts counts;
  std::optional<CellFailure> failure;
  [[nodiscard]] int workers() const { return options_.workers; }
  [[nodiscard]] const Switchboard& switchboard() const { return crew_.switchboard(); }

 private:
  struct Definition {
    CellDefinition cell;
    double longest = 0.0;  ///< s, of the requests answered so far
  };

  // ---- what the crew tells

  void joined(Member& member) override {
    if (tasks_ != nullptr) give_next(member);
  }

  void said(Member& member, const Message& message) override {
    if (const auto* reply = std::get_if<Reply>(&message)) {
      if (is_at(member, reply->request)) finish(member, reply->cell);
    } else if (const auto* working = std::get_if<Working>(&message)) {
      if (!is_at(member, working->request)) return;
      member.job->heard = Clock::now();
      member.job->begun = true;
    } else if (const auto* missing = std::get_if<Missing>(&message)) {
      if (is_at(member, missing->request)) supply(member, missing->definition);
    } else if (const auto* refusal = std::get_if<Refusal>(&message)) {
      if (is_at(member, refusal->request)) refused(member, refusal->message);
    } else {
      throw ProtocolError("a message that is no answer");
    }
  }

  void lost(Member& member, const Loss& loss) override {
    ++counts.workers_lost;
    std::string text = member.name + ' ' + loss.how;
    if (member.job) text += " at work on " + place_of((*tasks_)[member.job->task]);
    text += ": " + loss.cause + loss.details;
    if (!member.job) {
      tell(text);
      return;
    }
    const std::size_t task = member.job->task;
    // A connection that closes before the work began says nothing about the cell.
    const bool counts_for_cell = !loss.from_outside || !member.address.remote || member.job->begun;
    member.job.reset();
    if (counts_for_cell) {
      end_attempt(task, text, loss.from_outside);
    } else {
      again(task, text);
    }
  }

  // ---- requests

  /// Whether an answer is to what the member works on; others are late or doubled, and of no use.
  static bool is_at(const Member& member, std::uint64_t request) {
    return member.job && member.job->request == request;
  }

  std::string place_of(const Task& task) const {
    const CellDefinition& cell = definitions_[task.definition].cell;
    const std::string what = task.point ? fmt::format("point {}", *task.point) : "a cell";
    return fmt::format("{} of material '{}' ({})", what, cell.name, cell.script_file);
  }

  void give_next(Member& member) {
    if (queue_.empty() || member.job) return;
    const std::size_t task = queue_.front();
    queue_.pop_front();
    const Clock::time_point now = Clock::now();
    member.job = Job{task, ++last_request_, now, now, now};
    send_request(member);
  }

  /// With the definition and the bytes of the state where the worker is not known to have them.
  void send_request(Member& member) {
    const Task& task = (*tasks_)[member.job->task];
    if (member.defined.insert(task.definition).second) {
      crew_.send(member, Define{task.definition, definitions_[task.definition].cell});
    }
    if (task.cell == nullptr) {
      crew_.send(member, InitialRequest{member.job->request, task.definition});
      return;
    }
    EvaluateRequest message{member.job->request, task.definition, task.cell->state == nullptr, {}, nullptr,
                            task.cell->increment};
    if (const StatePointer& state = task.cell->state) {
      message.base = state->name();
      if (!member.known.use(message.base)) {
        message.state = state;
        member.known.note(message.base, state->bytes().size());
        ++counts.states_sent;
      }
    }
    crew_.send(member, message);
  }

  void supply(Member& member, bool definition) {
    const Task& task = (*tasks_)[member.job->task];
    member.job->resent = member.job->heard = Clock::now();
    if (definition) {
      member.defined.erase(task.definition);
    } else if (task.cell != nullptr && task.cell->state) {
      member.known.forget(task.cell->state->name());
    } else {
      throw ProtocolError("it misses a state that was not named");
    }
    send_request(member);
  }

  void finish(Member& member, const CellReply& reply) {
    Task& task = (*tasks_)[member.job->task];
    const double busy = seconds_since(member.job->sent);
    task.reply = reply;
    member.job.reset();
    crew_.praise(member);
    counts.evaluations += 1;
    counts.dem_steps += reply.diagnostics.dem_steps;
    counts.engine_seconds += reply.diagnostics.engine_seconds;
    counts.busy_seconds += busy;
    double& longest = definitions_[task.definition].longest;
    longest = std::max(longest, busy);
    if (reply.state) member.known.note(reply.state->name(), reply.state->bytes().size());
    complete(task);
    // The next request goes out before anything else is done: a worker should not wait for the coordinator.
    give_next(member);
  }

  void complete(const Task& task) {
    ++done_;
    if (task.reply.response.quality != Quality::failed || task.cell == nullptr) return;
    const auto place = static_cast<std::size_t>(&task - tasks_->data());
    if (failure && place > failed_task_)
      return;  // the first in the order of the requests, whoever was faster
    failed_task_ = place;
    failure = CellFailure{task.definition, *task.cell, task.point, task.reply.response.message};
  }

  void refused(Member& member, const std::string& reason) {
    const std::size_t task = member.job->task;
    member.job.reset();
    end_attempt(task, fmt::format("{} refuses {}: {}", member.name, place_of((*tasks_)[task]), reason),
                false);
    give_next(member);
  }

  /// Somebody could not carry a task to its end.
  void end_attempt(std::size_t number, const std::string& text, bool from_outside) {
    Task& task = (*tasks_)[number];
    ++(from_outside ? task.ends_from_outside : task.ends_by_work);
    if (task.ends_by_work < kMostEndsByWork && task.ends_from_outside < kMostEndsFromOutside) {
      again(number, text);
      return;
    }
    if (task.cell == nullptr) throw RunError(text);
    tell(text + "\nno worker can answer it: the cell counts as failed");
    task.reply.response.quality = Quality::failed;
    task.reply.response.step_factor = 0.5;
    task.reply.response.message = text;
    complete(task);
  }

  void again(std::size_t task, const std::string& text) {
    tell(text + (text.ends_with('\n') ? "" : "; ") + "its cell goes to another worker");
    queue_.push_front(task);
    for (Member& member : crew_.members()) give_next(member);
  }

  // ---- clocks

  /// Time in which this process itself did not run (stopped, the machine asleep or overloaded) is nobody's
  /// silence.
  void forgive(Clock::duration excess) {
    if (excess < std::chrono::seconds(1)) return;
    for (Member& member : crew_.members()) {
      if (!member.job) continue;
      member.job->sent += excess;
      member.job->heard += excess;
      member.job->resent += excess;
    }
  }

  void check_clocks() {
    const PatienceLimits& patience = options_.patience;
    std::vector<std::pair<Member*, std::string>> hung;
    for (Member& member : crew_.members()) {
      if (!member.job) continue;
      const double silence = seconds_since(member.job->heard);
      const double longest = definitions_[(*tasks_)[member.job->task].definition].longest;
      const double limit = std::max(patience.cell_seconds, patience.times_longest * longest);
      if (silence > patience.silence_seconds) {
        hung.emplace_back(&member,
                          fmt::format("it hangs: no sign of life for {:.3g} s", patience.silence_seconds));
      } else if (seconds_since(member.job->sent) > limit) {
        hung.emplace_back(&member,
                          fmt::format("the cell takes longer than {:.3g} s; the longest before took {:.3g} s",
                                      limit, longest));
      } else if (silence > patience.silence_seconds / kResends &&
                 Clock::now() - member.job->resent > seconds(patience.silence_seconds / kResends)) {
        // Lost on its way, perhaps. A worker that has it already, or has answered it, knows the number.
        member.job->resent = Clock::now();
        send_request(member);
      }
    }
    for (const auto& [member, cause] : hung) crew_.give_up(*member, cause);
  }

  void tell(const std::string& text) const {
    if (options_.tell) options_.tell(text);
  }

  PoolOptions options_;
  std::chrono::milliseconds tick_{std::clamp<std::int64_t>(
      static_cast<std::int64_t>(1e3 * options_.patience.silence_seconds / kTicksInSilence), 1,
      kLongestTick.count())};
  std::vector<Definition> definitions_;
  Crew crew_;

  // The batch at work. Request numbers run on from batch to batch, so that no late answer fits a new request.
  std::vector<Task>* tasks_ = nullptr;
  std::deque<std::size_t> queue_;
  std::uint64_t last_request_ = 0;
  std::size_t done_ = 0;
  std::size_t failed_task_ = 0;
};

Pool::Pool(PoolOptions options) : implementation_(std::make_unique<Implementation>(std::move(options))) {}
Pool::~Pool() = default;

std::uint32_t Pool::define(CellDefinition definition) {
  return implementation_->define(std::move(definition));
}
const CellDefinition& Pool::definition(std::uint32_t number) const {
  return implementation_->definition(number);
}

CellReply Pool::initial(std::uint32_t definition) {
  static_cast<void>(implementation_->definition(definition));
  std::vector<Task> tasks{{definition, nullptr}};
  implementation_->work(tasks);
  return std::move(tasks.front().reply);
}

std::vector<CellReply> Pool::evaluate(std::span<const PoolRequest> requests) {
  const std::vector<std::size_t> first = first_alike(requests);
  std::vector<std::size_t> task_of(requests.size());
  std::vector<Task> tasks;
  tasks.reserve(requests.size());
  for (std::size_t r = 0; r < requests.size(); ++r) {
    const PoolRequest& request = requests[r];
    static_cast<void>(implementation_->definition(request.definition));
    task_of[r] = first[r] == r ? tasks.size() : task_of[first[r]];
    if (first[r] == r) tasks.push_back({request.definition, &request.cell, request.point});
  }
  implementation_->work(tasks);
  std::vector<CellReply> replies;
  replies.reserve(requests.size());
  for (const std::size_t task : task_of) replies.push_back(tasks[task].reply);
  return replies;
}

const std::optional<CellFailure>& Pool::last_failure() const {
  return implementation_->failure;
}

void Pool::on_progress(std::function<void(std::size_t, std::size_t)> call) {
  implementation_->progress = std::move(call);
}

const PoolCounts& Pool::counts() const {
  return implementation_->counts;
}
std::string Pool::listening_url() const {
  return implementation_->switchboard().remote_url();
}
std::size_t Pool::refused() const {
  return implementation_->switchboard().refused();
}
int Pool::workers() const {
  return implementation_->workers();
}

}  // namespace polargrain::coupler
