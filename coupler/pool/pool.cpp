// SPDX-License-Identifier: GPL-2.0-or-later
#include "coupler/pool/pool.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cerrno>
#include <deque>
#include <optional>
#include <set>
#include <zmq.hpp>

#include "common/error.hpp"
#include "coupler/pool/log_excerpt.hpp"
#include "coupler/pool/private_directory.hpp"
#include "coupler/pool/process.hpp"
#include "coupler/pool/state_cache.hpp"
#include "coupler/protocol/messages.hpp"

namespace polargrain::coupler {
namespace {

using Clock = std::chrono::steady_clock;

double seconds_since(Clock::time_point start) {
  return std::chrono::duration<double>(Clock::now() - start).count();
}

/// How long workers may take to end by themselves after Stop; the engine has nothing left to save.
constexpr int kStopMilliseconds = 500;

struct Worker {
  int number;
  std::filesystem::path log;
  Process process;
  StateCache known;                        ///< names of the states it should still have
  std::string address = {};                ///< its routing id; empty until it has said Hello
  std::set<std::uint32_t> defined = {};    ///< definitions it was sent
  std::optional<std::uint64_t> task = {};  ///< the task it works on
  Clock::time_point sent = {};
};

/// A request on its way: what to send, and where the reply goes.
struct Task {
  std::uint32_t definition;
  const CellRequest* cell;  ///< null: the packing at rest
  CellReply reply = {};
};

std::string own_program() {
  return std::filesystem::read_symlink("/proc/self/exe").string();
}

}  // namespace

class Pool::Implementation {
 public:
  explicit Implementation(PoolOptions options) : options_(std::move(options)) {
    if (options_.workers < 1) throw RunError("a pool needs at least one worker");
    if (options_.worker_command.empty()) options_.worker_command = {own_program(), "worker"};
    const std::string url = "ipc://" + (sockets_.path() / "coordinator").string();
    router_.set(zmq::sockopt::linger, 0);
    router_.set(zmq::sockopt::maxmsgsize, static_cast<std::int64_t>(kLongestMessage));
    router_.bind(url);
    start_workers(url);
    await_hellos();
  }

  ~Implementation() {
    for (Worker& worker : workers_) {
      try {
        if (!worker.address.empty()) send(worker, Stop{});
      } catch (const std::exception&) {  // it is killed below
      }
    }
    for (Worker& worker : workers_) worker.process.finish(worker.address.empty() ? 0 : kStopMilliseconds);
  }

  std::uint32_t define(CellDefinition definition) {
    definitions_.push_back(std::move(definition));
    return static_cast<std::uint32_t>(definitions_.size() - 1);
  }

  void work(std::vector<Task>& tasks) {
    const Clock::time_point start = Clock::now();
    tasks_ = &tasks;
    next_ = done_ = 0;
    first_ = last_used_ + 1;
    last_used_ += tasks.size();
    for (Worker& worker : workers_) give_next(worker);
    while (done_ < tasks.size()) listen(std::chrono::milliseconds(-1));
    tasks_ = nullptr;
    counts.wall_seconds += seconds_since(start);
  }

  void check(std::uint32_t definition) const {
    if (definition >= definitions_.size())
      throw RunError(fmt::format("no cell is defined as {}", definition));
  }

  std::function<void(std::size_t, std::size_t)> progress;
  PoolCounts counts;
  [[nodiscard]] int workers() const { return options_.workers; }

 private:
  void start_workers(const std::string& url) {
    const std::filesystem::path logs = options_.directory / "logs";
    std::filesystem::create_directories(logs);
    std::vector<std::string> command = options_.worker_command;
    command.insert(command.end(), {"--connect", url});
    for (int k = 1; k <= options_.workers; ++k) {
      const std::filesystem::path log = logs / fmt::format("worker-{}.log", k);
      std::filesystem::remove(log);
      workers_.push_back({k, log, Process(command, log), StateCache(options_.cache_bytes)});
    }
  }

  void await_hellos() {
    const auto all_here = [&] {
      return std::all_of(workers_.begin(), workers_.end(),
                         [](const Worker& w) { return !w.address.empty(); });
    };
    const Clock::time_point start = Clock::now();
    while (!all_here()) {
      const double left = options_.startup_seconds - seconds_since(start);
      if (left <= 0.0) report_silence();
      // Rounded up, so that the last wait does not become a loop of waits of no length.
      listen(std::chrono::milliseconds(static_cast<int>(left * 1000.0) + 1));
    }
  }

  [[noreturn]] void report_silence() const {
    const auto silent =
        std::find_if(workers_.begin(), workers_.end(), [](const Worker& w) { return w.address.empty(); });
    throw RunError(fmt::format("worker {} did not report within {} s of its start; its log {} ends with:\n{}",
                               silent->number, options_.startup_seconds, silent->log.string(),
                               log_excerpt(silent->log)));
  }

  /// Waits for messages and deaths and handles what there is. Messages first: the last words of a worker
  /// count.
  void listen(std::chrono::milliseconds timeout) {
    std::vector<zmq::pollitem_t> items{{router_.handle(), 0, ZMQ_POLLIN, 0}};
    for (const Worker& worker : workers_) {
      items.push_back({nullptr, worker.process.end_descriptor(), ZMQ_POLLIN, 0});
    }
    try {
      zmq::poll(items, timeout);
    } catch (const zmq::error_t& error) {
      if (error.num() == EINTR) return;
      throw RunError(fmt::format("waiting for the workers failed: {}", error.what()));
    }
    receive_all();
    for (std::size_t w = 0; w < workers_.size(); ++w) {
      if (items[w + 1].revents != 0) report_death(workers_[w]);
    }
  }

  [[noreturn]] void report_death(Worker& worker) {
    const std::string end = worker.process.end().value_or("unknown end");
    std::string doing = worker.address.empty() ? " before it reported" : "";
    if (worker.task) {
      const std::uint32_t definition = (*tasks_)[*worker.task - first_].definition;
      doing = fmt::format(" at work on a cell of material '{}' ({})", definitions_[definition].name,
                          definitions_[definition].script_file);
    }
    throw RunError(fmt::format("worker {} died{}: {}; its log {} says:\n{}", worker.number, doing, end,
                               worker.log.string(), log_excerpt(worker.log)));
  }

  void receive_all() {
    for (;;) {
      zmq::message_t address;
      zmq::message_t bytes;
      if (!router_.recv(address, zmq::recv_flags::dontwait)) return;
      bool more = address.more();
      if (more && router_.recv(bytes)) more = bytes.more();
      while (more) {  // no worker of ours sends a third part; read it away to stay in step
        zmq::message_t rest;
        if (!router_.recv(rest)) break;
        more = rest.more();
      }
      counts.bytes_received += static_cast<std::int64_t>(bytes.size());
      receive(address.to_string(), {static_cast<const std::byte*>(bytes.data()), bytes.size()});
    }
  }

  void receive(const std::string& address, std::span<const std::byte> bytes) {
    const auto sender =
        std::find_if(workers_.begin(), workers_.end(), [&](const Worker& w) { return w.address == address; });
    try {
      const Message message = decode(bytes);
      if (sender == workers_.end()) {
        greet(address, message);
      } else {
        answer(*sender, message);
      }
    } catch (const ProtocolError& error) {
      const std::string who =
          sender == workers_.end() ? "a process" : fmt::format("worker {}", sender->number);
      throw RunError(fmt::format("{} sent what cannot be used: {}", who, error.what()));
    }
  }

  void greet(const std::string& address, const Message& message) {
    const auto* hello = std::get_if<Hello>(&message);
    if (hello == nullptr) throw ProtocolError("its first message is not a hello");
    const auto worker = std::find_if(workers_.begin(), workers_.end(),
                                     [&](const Worker& w) { return w.process.id() == hello->process; });
    if (worker == workers_.end()) throw ProtocolError("it is none of the workers that were started");
    if (hello->version != kProtocolVersion) {
      throw ProtocolError(
          fmt::format("version {} of the messages instead of {}; is the program being replaced?",
                      hello->version, kProtocolVersion));
    }
    worker->address = address;
    if (tasks_ != nullptr) give_next(*worker);
  }

  void answer(Worker& worker, const Message& message) {
    if (const auto* reply = std::get_if<Reply>(&message)) {
      finish(worker, reply->request, reply->cell);
    } else if (const auto* missing = std::get_if<MissingState>(&message)) {
      const Task& task = current(worker, missing->request);
      if (task.cell == nullptr || !task.cell->state)
        throw ProtocolError("it misses a state that was not named");
      worker.known.forget(task.cell->state->name());
      give(worker, *worker.task);
    } else if (const auto* refusal = std::get_if<Refusal>(&message)) {
      const Task& task = current(worker, refusal->request);
      throw RunError(fmt::format("worker {} refuses a cell of material '{}': {} (log: {})", worker.number,
                                 definitions_[task.definition].name, refusal->message, worker.log.string()));
    } else {
      throw ProtocolError("a message that is no answer");
    }
  }

  Task& current(const Worker& worker, std::uint64_t request) {
    if (!worker.task || *worker.task != request)
      throw ProtocolError("an answer to something it was not asked");
    return (*tasks_)[request - first_];
  }

  void finish(Worker& worker, std::uint64_t request, const CellReply& reply) {
    current(worker, request).reply = reply;
    worker.task.reset();
    counts.evaluations += 1;
    counts.dem_steps += reply.diagnostics.dem_steps;
    counts.engine_seconds += reply.diagnostics.engine_seconds;
    counts.busy_seconds += seconds_since(worker.sent);
    if (reply.state) worker.known.note(reply.state->name(), reply.state->bytes().size());
    ++done_;
    // The next request goes out before anything else is done: a worker should not wait for the coordinator.
    give_next(worker);
    if (progress) progress(done_, tasks_->size());
  }

  void give_next(Worker& worker) {
    if (!worker.address.empty() && next_ < tasks_->size()) give(worker, first_ + next_++);
  }

  void give(Worker& worker, std::uint64_t request) {
    const Task& task = (*tasks_)[request - first_];
    worker.task = request;
    worker.sent = Clock::now();
    if (worker.defined.insert(task.definition).second) {
      send(worker, Define{task.definition, definitions_[task.definition]});
    }
    if (task.cell == nullptr) {
      send(worker, InitialRequest{request, task.definition});
      return;
    }
    EvaluateRequest message{request, task.definition, task.cell->state == nullptr,
                            {},      nullptr,         task.cell->increment};
    if (const StatePointer& state = task.cell->state) {
      message.base = state->name();
      if (!worker.known.use(message.base)) {
        message.state = state;
        worker.known.note(message.base, state->bytes().size());
        ++counts.states_sent;
      }
    }
    send(worker, message);
  }

  void send(const Worker& worker, const Message& message) {
    const std::string bytes = encode(message);
    router_.send(zmq::buffer(worker.address), zmq::send_flags::sndmore);
    router_.send(zmq::buffer(bytes), zmq::send_flags::none);
    counts.bytes_sent += static_cast<std::int64_t>(bytes.size());
  }

  PoolOptions options_;
  PrivateDirectory sockets_;
  zmq::context_t context_;
  zmq::socket_t router_{context_, zmq::socket_type::router};
  std::deque<Worker> workers_;
  std::vector<CellDefinition> definitions_;

  // The batch at work. Request numbers run on from batch to batch, so that no late answer fits a new request.
  std::vector<Task>* tasks_ = nullptr;
  std::uint64_t first_ = 1;
  std::uint64_t last_used_ = 0;
  std::size_t next_ = 0;
  std::size_t done_ = 0;
};

Pool::Pool(PoolOptions options) : implementation_(std::make_unique<Implementation>(std::move(options))) {}
Pool::~Pool() = default;

std::uint32_t Pool::define(CellDefinition definition) {
  return implementation_->define(std::move(definition));
}

CellReply Pool::initial(std::uint32_t definition) {
  implementation_->check(definition);
  std::vector<Task> tasks{{definition, nullptr}};
  implementation_->work(tasks);
  return std::move(tasks.front().reply);
}

std::vector<CellReply> Pool::evaluate(std::span<const PoolRequest> requests) {
  std::vector<Task> tasks;
  tasks.reserve(requests.size());
  for (const PoolRequest& request : requests) {
    implementation_->check(request.definition);
    tasks.push_back({request.definition, &request.cell});
  }
  implementation_->work(tasks);
  std::vector<CellReply> replies;
  replies.reserve(tasks.size());
  for (Task& task : tasks) replies.push_back(std::move(task.reply));
  return replies;
}

void Pool::on_progress(std::function<void(std::size_t, std::size_t)> call) {
  implementation_->progress = std::move(call);
}

const PoolCounts& Pool::counts() const {
  return implementation_->counts;
}
int Pool::workers() const {
  return implementation_->workers();
}

}  // namespace polargrain::coupler
