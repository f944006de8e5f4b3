// SPDX-License-Identifier: GPL-2.0-or-later
#include "coupler/hosts/hosted_cells.hpp"

#include <fmt/format.h>
#include <signal.h>
#include <unistd.h>

#include <array>
#include <atomic>
#include <condition_variable>
#include <cstdlib>
#include <deque>
#include <exception>
#include <map>
#include <mutex>
#include <optional>
#include <sstream>
#include <thread>

#include "coupler/pool/private_directory.hpp"

namespace polargrain::coupler {
namespace {

constexpr std::chrono::milliseconds kLook{100};

/// States whose pointers are kept, so that the workers that made them need not be sent them when they are stepped on.
constexpr std::size_t kKeptStates = 256;

/// A library that starts with the messages puts the handlers of signals back with flags of its own, for one signal
/// only; here they keep those of the host.
class KeptSignals {
 public:
  KeptSignals() {
    for (std::size_t k = 0; k < kSignals.size(); ++k) sigaction(kSignals[k], nullptr, &actions_[k]);
  }
  ~KeptSignals() {
    for (std::size_t k = 0; k < kSignals.size(); ++k) sigaction(kSignals[k], &actions_[k], nullptr);
  }
  KeptSignals(const KeptSignals&) = delete;
  KeptSignals& operator=(const KeptSignals&) = delete;

 private:
  static constexpr std::array<int, 3> kSignals{SIGINT, SIGTERM, SIGHUP};
  std::array<struct sigaction, 3> actions_{};
};

/// One pool with its logs, which stay when it ends by an exception.
class WorkingPool {
 public:
  explicit WorkingPool(const HostedCells::Options& options) {
    const KeptSignals signals;
    logs_.keep();
    PoolOptions pool_options;
    pool_options.directory = logs_.path();
    pool_options.worker_command = options.worker_command;
    pool_options.workers = options.workers;
    pool_options.trust_scripts = options.trust_scripts;
    pool_options.tell = options.tell;
    pool_.emplace(pool_options);
  }
  Pool& pool() { return *pool_; }
  std::uint32_t number_of(const DefinitionPointer& definition) {
    const auto [place, is_new] = numbers_.try_emplace(definition, 0);
    if (is_new) place->second = pool_->define(*definition);
    return place->second;
  }
  /// With bytes, as values that belong to no pool: pointers of a pool tell it when they go, in its thread alone.
  void detach(std::vector<CellReply>& replies) {
    std::vector<StatePointer> states;
    for (const CellReply& reply : replies) states.push_back(reply.state);
    states = pool_->collect(states);
    for (std::size_t k = 0; k < replies.size(); ++k) {
      if (states[k] == nullptr) continue;
      const auto bytes = states[k]->bytes();
      replies[k].state = std::make_shared<State>(std::vector(bytes.begin(), bytes.end()));
      kept_.push_back(states[k]);
      if (kept_.size() > kKeptStates) kept_.pop_front();
    }
  }
  void done() { logs_.keep(false); }

 private:
  PrivateDirectory logs_;
  std::optional<Pool> pool_;
  std::map<DefinitionPointer, std::uint32_t> numbers_;
  std::deque<StatePointer> kept_;
};

}  // namespace

class HostedCells::Implementation {
 public:
  explicit Implementation(Options options) : options_(std::move(options)) {}

  ~Implementation() {
    if (process_ == getpid()) {
      close();
      return;
    }
    // Of a forked child: the thread is not here, and the workers are not its own.
    if (thread_.joinable()) thread_.detach();
    [[maybe_unused]] const WorkingPool* const of_the_parent = pool_.release();
  }

  /// Has the pool's thread do something, and waits.
  void call(const std::function<void(WorkingPool&)>& work, const IsWanted& is_wanted) {
    if (process_ != getpid())
      throw RunError(
          "a forked process cannot use the cells of its parent; make cells in "
          "the child, or start it anew (multiprocessing: method 'spawn')");
    const std::lock_guard one_at_a_time(callers_);
    std::unique_lock lock(mutex_);
    if (!thread_.joinable()) {
      ends_ = false;
      thread_ = std::thread([this] { serve(); });
    }
    error_ = nullptr;
    cancelled_ = false;
    work_ = &work;
    changed_.notify_all();
    while (!changed_.wait_for(lock, kLook, [this] { return work_ == nullptr; })) {
      lock.unlock();
      if (!cancelled_ && is_wanted && !is_wanted()) cancelled_ = true;
      lock.lock();
    }
    if (error_) std::rethrow_exception(error_);
  }

  [[nodiscard]] PoolCounts counts() const {
    const std::lock_guard lock(mutex_);
    return counts_;
  }

  void close() {
    const std::lock_guard one_at_a_time(callers_);
    {
      const std::lock_guard lock(mutex_);
      ends_ = true;
      changed_.notify_all();
    }
    if (thread_.joinable()) thread_.join();
    thread_ = {};
  }

 private:
  void serve() {
    std::unique_lock lock(mutex_);
    for (;;) {
      changed_.wait(lock, [this] { return work_ != nullptr || ends_; });
      if (work_ == nullptr) break;
      lock.unlock();
      std::exception_ptr error;
      try {
        do_it(*work_);
      } catch (...) {
        error = std::current_exception();
        pool_.reset();
      }
      lock.lock();
      if (pool_) counts_ = pool_->pool().counts();
      error_ = error;
      work_ = nullptr;
      changed_.notify_all();
    }
    if (pool_) pool_->done();
    pool_.reset();
  }

  void do_it(const std::function<void(WorkingPool&)>& work) {
    if (!pool_) {
      pool_ = std::make_unique<WorkingPool>(options_);
      pool_->pool().on_progress([this](std::size_t, std::size_t) {
        if (cancelled_) throw Cancelled("the evaluation of cells was stopped");
      });
    }
    work(*pool_);
  }

  Options options_;
  pid_t process_ = getpid();
  std::mutex callers_;  ///< held by who is served
  mutable std::mutex mutex_;
  std::condition_variable changed_;
  const std::function<void(WorkingPool&)>* work_ = nullptr;
  std::exception_ptr error_;
  PoolCounts counts_;
  std::atomic<bool> cancelled_ = false;
  bool ends_ = false;
  std::unique_ptr<WorkingPool> pool_;  ///< of the thread
  std::thread thread_;
};

HostedCells::HostedCells(Options options)
    : implementation_(std::make_unique<Implementation>(std::move(options))) {}

HostedCells::~HostedCells() = default;

CellReply HostedCells::initial(const DefinitionPointer& definition, const IsWanted& is_wanted) {
  std::vector<CellReply> replies(1);
  implementation_->call(
      [&](WorkingPool& working) {
        replies.front() = working.pool().initial(working.number_of(definition));
        working.detach(replies);
      },
      is_wanted);
  return replies.front();
}

std::vector<CellReply> HostedCells::evaluate(const std::vector<HostedRequest>& requests,
                                             const IsWanted& is_wanted) {
  std::vector<CellReply> replies;
  implementation_->call(
      [&](WorkingPool& working) {
        std::vector<PoolRequest> of_pool;
        for (const HostedRequest& request : requests)
          of_pool.push_back({working.number_of(request.definition), request.cell});
        replies = working.pool().evaluate(of_pool);
        working.detach(replies);
      },
      is_wanted);
  return replies;
}

PoolCounts HostedCells::counts() const {
  return implementation_->counts();
}

void HostedCells::close() {
  implementation_->close();
}

std::string program_for_workers(const std::vector<std::filesystem::path>& places) {
  const auto runs = [](const std::filesystem::path& file) {
    std::error_code error;
    return std::filesystem::is_regular_file(file, error) && access(file.c_str(), X_OK) == 0;
  };
  if (const char* const named = std::getenv("POLARGRAIN_PROGRAM"); named != nullptr && *named != '\0') {
    if (runs(named)) return named;
    throw InputError({"", 0, fmt::format("POLARGRAIN_PROGRAM: there is no program {}", named)});
  }
  for (const std::filesystem::path& place : places)
    if (runs(place)) return place.string();
  if (const char* const path = std::getenv("PATH"); path != nullptr) {
    std::istringstream folders(path);
    for (std::string folder; std::getline(folders, folder, ':');)
      if (!folder.empty() && runs(std::filesystem::path(folder) / "polargrain"))
        return (std::filesystem::path(folder) / "polargrain").string();
  }
  throw InputError(
      {"", 0,
       "there is no program polargrain, whose workers hold the grains; install it, put its folder into "
       "PATH, or name it in the environment as POLARGRAIN_PROGRAM"});
}

}  // namespace polargrain::coupler
