// SPDX-License-Identifier: GPL-2.0-or-later
#include "coupler/pool/foreman.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <utility>

#include "common/error.hpp"

namespace polargrain::coupler {
namespace {

/// How often the clocks of the workers are looked at, at least.
constexpr std::chrono::milliseconds kLongestTick{500};
constexpr double kTicksInSilence = 20.0;

/// A request without a sign of life is sent again so many times before its worker is given up for silent.
constexpr double kResends = 10.0;
constexpr double kHeartbeatsInSilence = 30.0;

/// A message brings work for about so long: enough that it costs next to nothing, not so much that others
/// wait for the last one.
constexpr double kSecondsInRequest = 0.05;
constexpr std::size_t kMostCells = 16;
static_assert(kMostCells <= kMostInRequest);

/// States fetched with one message.
constexpr std::size_t kMostStates = 16;
constexpr std::size_t kMostStateBytes = std::size_t{1} << 20;

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
  if (options.trust_scripts) crew.worker_command.emplace_back("--trust-scripts");
  crew.network = options.trust_scripts ? Process::Network::shared : Process::Network::none;
  crew.startup_seconds = options.startup_seconds;
  crew.cache_bytes = options.cache_bytes;
  crew.heartbeat_seconds = options.patience.silence_seconds / kHeartbeatsInSilence;
  crew.listening = options.listening;
  crew.tell = options.tell;
  crew.heed = options.heed;
  return crew;
}

}  // namespace

Foreman::Foreman(PoolOptions options)
    : options_(std::move(options)),
      tick_(std::clamp<std::int64_t>(
          static_cast<std::int64_t>(1e3 * options_.patience.silence_seconds / kTicksInSilence), 1,
          kLongestTick.count())),
      crew_(crew_options(options_), *this) {
  crew_.start();
}

std::uint32_t Foreman::define(CellDefinition definition) {
  definitions_.push_back({std::move(definition)});
  return static_cast<std::uint32_t>(definitions_.size() - 1);
}

const CellDefinition& Foreman::definition(std::uint32_t number) const {
  if (number >= definitions_.size()) throw RunError(fmt::format("no cell is defined as {}", number));
  return definitions_[number].cell;
}

void Foreman::work(std::vector<Task>& tasks) {
  const Clock::time_point start = Clock::now();
  tasks_ = &tasks;
  done_ = 0;
  residents_lost_.clear();
  waiting_.clear();
  queue_.begin(tasks);
  for (std::size_t number = 0; number < tasks.size(); ++number) enqueue(number);
  if (residents_lost_.empty()) give_all();
  checked_ = start;
  Clock::time_point last = start;
  while (done_ < tasks.size() && residents_lost_.empty()) {
    crew_.listen(tick_);
    const Clock::time_point now = Clock::now();
    count_seconds(now - last);
    const Clock::duration excess = now - last - tick_;
    if (excess > Clock::duration::zero()) excuse_all(excess);
    last = now;
    if (now - checked_ >= tick_ / 2) check_clocks();
    settle_what_waits();
    if (progress && tasks.front().kind == Task::Kind::evaluate) progress(done_, tasks.size());
  }
  note_returned();
  if (!residents_lost_.empty()) drop_jobs();
  tasks_ = nullptr;
  counts.bytes_sent = crew_.bytes_sent();
  counts.bytes_received = crew_.bytes_received();
  count_seconds(Clock::now() - last);
  if (!residents_lost_.empty()) throw ResidentsLost(residents_lost_);
}

std::vector<std::uint64_t> Foreman::gather() {
  Clock::time_point last = Clock::now();
  while (crew_.members().empty() || crew_.is_filling()) {
    crew_.listen(tick_);
    const Clock::time_point now = Clock::now();
    count_seconds(now - std::exchange(last, now));
  }
  std::vector<std::uint64_t> numbers;
  for (const Member& member : crew_.members()) numbers.push_back(member.number);
  return numbers;
}

void Foreman::count_seconds(Clock::duration passed) {
  counts.wall_seconds += seconds_of(passed);
  counts.member_seconds += static_cast<double>(crew_.members().size()) * seconds_of(passed);
}

// ---- what the crew tells

void Foreman::joined(Member& member) {
  present_.insert(member.number);
  if (tasks_ != nullptr) give_next(member, kJobsAtHand);
}

void Foreman::said(Member& member, const Message& message) {
  // Whoever says anything lives, whichever of its jobs it is about.
  if (!member.jobs.empty()) member.jobs.front().heard = Clock::now();
  if (const auto* reply = std::get_if<Reply>(&message)) {
    take_replies(member, *reply);
  } else if (const auto* states = std::get_if<States>(&message)) {
    take_states(member, *states);
  } else if (const auto* residents = std::get_if<ResidentReply>(&message)) {
    take_resident_reply(member, *residents);
  } else if (const auto* working = std::get_if<Working>(&message)) {
    for (Job& job : member.jobs) job.begun = job.begun || job.request == working->request;
  } else if (const auto* missing = std::get_if<Missing>(&message)) {
    supply(member, *missing);
  } else if (const auto* refusal = std::get_if<Refusal>(&message)) {
    take_refusal(member, *refusal);
  } else {
    throw FalseMessage("a message that is no answer");
  }
  send_away_the_blamed();
}

void Foreman::lost(Member& member, const Loss& loss) {
  ++counts.workers_lost;
  present_.erase(member.number);
  book_.forget_worker(member.number);
  for (const std::size_t number : queue_.take_all_of(member.number)) enqueue(number);
  // Its last answers may be lost with it, so any of its jobs may have been at work.
  Job had;
  for (const Job& job : member.jobs) {
    had.tasks.insert(had.tasks.end(), job.tasks.begin(), job.tasks.end());
    had.begun = had.begun || job.begun;
  }
  member.jobs.clear();
  std::string text = member.name + ' ' + loss.how;
  if (!had.tasks.empty()) text += " at work on " + place_of(had);
  text += ": " + loss.cause + loss.details;
  if (had.tasks.empty()) {
    tell(text);
    return;
  }
  Task& first = first_of(had);
  if (first.kind == Task::Kind::resident) {
    residents_lost_ = text;
    return;
  }
  // A connection that closes before the work began says nothing about the cell.
  const bool counts_for_cell = !loss.from_outside || !member.address.remote || had.begun;
  if (had.tasks.size() == 1 && first.kind != Task::Kind::fetch && counts_for_cell) {
    end_attempt(first, {loss.from_outside ? Attempt::End::from_outside : Attempt::End::by_work, member.number,
                        member.party, text});
  } else {
    // Which of several cells it was shows when each is alone with a worker.
    for (const std::size_t number : had.tasks) task(number).alone = had.tasks.size() > 1;
    put_back(had);
    say_again(text, had.tasks.size());
  }
  give_all();
}

// ---- giving tasks to workers

void Foreman::enqueue(std::size_t number) {
  Task& next = task(number);
  if (next.kind == Task::Kind::resident) {
    if (present_.contains(next.residents->worker)) return queue_.add_for(next.residents->worker, number);
    residents_lost_ = "the worker with the boxes of " + place_of(next) + " is gone";
    return;
  }
  if (next.kind == Task::Kind::fetch) {
    const std::uint64_t keeper = book_.home(next.wanted->name());
    if (present_.contains(keeper)) return queue_.add_for(keeper, number);
    next.kind = Task::Kind::again;
  }
  next.home = next.cell.state ? book_.home(next.cell.state->name()) : 0;
  present_.contains(next.home) ? queue_.add_for(next.home, number) : queue_.add(number);
}

void Foreman::give_all() {
  // Everybody gets something to do before anybody gets something to have at hand.
  for (std::size_t jobs = 1; jobs <= kJobsAtHand; ++jobs) {
    for (Member& member : crew_.members()) give_next(member, jobs);
  }
}

void Foreman::give_next(Member& member, std::size_t jobs) {
  while (member.jobs.size() < jobs && !blamed_.contains(member.number)) {
    const bool is_free = member.jobs.empty();
    // The last ones go to whoever is free first.
    if (!is_free && (queue_.size() <= crew_.members().size() || first_of(member.jobs.front()).alone)) return;
    std::vector<std::size_t> tasks = queue_.take(
        member.number, [&](const Task& first) { return may_take(member, first); },
        [&](const Task& first) { return first.alone && !is_free ? 0 : most_at_once(first); });
    if (tasks.empty()) return;
    const Clock::time_point now = Clock::now();
    member.jobs.push_back({std::move(tasks), ++last_request_, now, now, now});
    send(member, member.jobs.back());
  }
}

std::size_t Foreman::most_at_once(const Task& first) {
  if (first.kind == Task::Kind::fetch) {
    return std::clamp<std::size_t>(kMostStateBytes / (first.wanted->size() + 1), 1, kMostStates);
  }
  const Definition& definition = definitions_[first.definition];
  if (first.alone || !first.attempts.empty() || !first.opinions.empty() || definition.answers == 0) return 1;
  const double mean = definition.seconds / static_cast<double>(definition.answers);
  const double in_time = std::min(kSecondsInRequest / mean, static_cast<double>(kMostCells));
  const std::size_t share = queue_.size() / (2 * crew_.members().size());
  return std::max<std::size_t>(std::min(static_cast<std::size_t>(in_time), share), 1);
}

void Foreman::send(Member& member, const Job& job) {
  const Task& first = first_of(job);
  if (first.kind == Task::Kind::fetch) {
    FetchRequest message{job.request, {}};
    for (const std::size_t number : job.tasks) message.names.push_back(task(number).wanted->name());
    crew_.send(member, std::move(message));
    return;
  }
  if (member.defined.insert(first.definition).second) {
    crew_.send(member, Define{first.definition, definitions_[first.definition].cell});
  }
  if (first.kind == Task::Kind::resident) {
    std::visit(
        [&](auto message) {
          message.request = job.request;
          message.settled = job.request - 1;  // it is alone with its worker
          crew_.send(member, std::move(message));
        },
        first.residents->message);
    return;
  }
  if (first.kind == Task::Kind::rest) {
    crew_.send(member, InitialRequest{job.request, first.definition});
  } else {
    crew_.send(member, request_for(member, job));
  }
}

/// With the bytes of the states that the worker is not known to have.
EvaluateRequest Foreman::request_for(Member& member, const Job& job) {
  const Task& first = first_of(job);
  EvaluateRequest message;
  message.request = job.request;
  message.definition = first.definition;
  message.settled = member.jobs.front().request - 1;
  message.bring = first.kind == Task::Kind::again;
  message.released = book_.take_released(member.number);
  for (const std::size_t number : job.tasks) {
    const CellRequest& request = task(number).cell;
    CellToEvaluate& cell =
        message.cells.emplace_back(CellToEvaluate{!request.state, {}, nullptr, request.increment});
    if (!request.state) continue;
    cell.base = request.state->name();
    if (task(number).home == member.number || member.known.use(cell.base)) continue;
    cell.state = request.state;
    member.known.note(cell.base, request.state->size());
    book_.move_home(cell.base, member.number);
    ++counts.states_sent;
  }
  return message;
}

// ---- clocks

void Foreman::excuse(Member& member, Clock::duration time) {
  for (Job& job : member.jobs) {
    job.heard += time;
    job.resent += time;
    job.excused += time;
  }
}

/// Time in which this process itself did not run (stopped, the machine asleep or overloaded) is nobody's
/// silence.
void Foreman::excuse_all(Clock::duration time) {
  for (Member& member : crew_.members()) excuse(member, time);
}

/// Nor is time in which a worker was ready to run and others had the processors: no verdict may depend on what else the
/// machine does.
void Foreman::check_clocks() {
  const PatienceLimits& patience = options_.patience;
  const Clock::time_point now = Clock::now();
  const Clock::duration elapsed = now - checked_;
  checked_ = now;
  for (Member& member : crew_.members()) excuse(member, crew_.starved(member, elapsed));
  std::vector<std::pair<Member*, std::string>> hung;
  for (Member& member : crew_.members()) {
    if (member.jobs.empty()) continue;
    Job& job = member.jobs.front();
    const double silence = seconds_of(now - job.heard);
    const Task& first = first_of(job);
    const double longest = definitions_[first.definition].longest;
    const std::size_t cells = first.residents ? first.residents->boxes : job.tasks.size();
    const double limit =
        static_cast<double>(cells) * std::max(patience.cell_seconds, patience.times_longest * longest);
    if (silence > patience.silence_seconds) {
      hung.emplace_back(&member,
                        fmt::format("it hangs: no sign of life for {:.3g} s", patience.silence_seconds));
    } else if (seconds_of(now - job.sent - job.excused) > limit) {
      hung.emplace_back(
          &member, fmt::format("the cell takes longer than {:.3g} s; the longest before took {:.3g} s", limit,
                               longest));
    } else if (silence > patience.silence_seconds / kResends &&
               seconds_of(now - job.resent) > patience.silence_seconds / kResends) {
      // Lost on its way, perhaps. A worker that has it already, or has answered it, knows the number.
      job.resent = now;
      send(member, job);
    }
  }
  for (const auto& [member, cause] : hung) crew_.give_up(*member, cause);
}

void Foreman::tell(const std::string& text) const {
  if (options_.tell) options_.tell(text);
}

}  // namespace polargrain::coupler
