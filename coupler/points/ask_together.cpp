// SPDX-License-Identifier: GPL-2.0-or-later
#include <condition_variable>
#include <exception>
#include <mutex>
#include <optional>
#include <thread>

#include "common/error.hpp"
#include "coupler/points/cell_point.hpp"

namespace polargrain::coupler {
namespace {

/// The request that one test waits for, and its answer.
struct AnswersOfPoints {
  std::optional<CellRequest> request;
  std::optional<CellReply> reply;
};

/// Tests put their requests down here; when all that still run have, they are answered. One thread at a time is at work,
/// a test or the pool, and holds the floor: pointers to states tell the pool when they go, wherever that is.
class Office {
 public:
  using Floor = std::unique_lock<std::mutex>;

  explicit Office(std::size_t tests) : desks_(tests), running_(tests) {}

  [[nodiscard]] Floor take_floor() { return Floor(mutex_); }

  CellReply ask(Floor& floor, std::size_t test, const CellRequest& request) {
    desks_[test].request = request;
    ++waiting_;
    changed_.notify_all();
    changed_.wait(floor, [&] { return closed_ || desks_[test].reply.has_value(); });
    if (closed_) throw RunError("the test was ended by the failure of another");
    CellReply reply = std::move(*desks_[test].reply);
    desks_[test].reply.reset();
    return reply;
  }

  /// By who holds the floor.
  void leave() {
    --running_;
    changed_.notify_all();
  }

  /// Answers until all have left.
  void serve(Pool& pool, const std::vector<std::uint32_t>& definitions) {
    Floor floor = take_floor();
    for (;;) {
      changed_.wait(floor, [&] { return waiting_ == running_; });
      if (running_ == 0) return;
      std::vector<PoolRequest> requests;
      std::vector<std::size_t> askers;
      for (std::size_t test = 0; test < desks_.size(); ++test) {
        if (!desks_[test].request) continue;
        requests.push_back({definitions[test], std::move(*desks_[test].request), test});
        desks_[test].request.reset();
        askers.push_back(test);
      }
      std::vector<CellReply> replies = pool.evaluate(requests);
      for (std::size_t k = 0; k < askers.size(); ++k) desks_[askers[k]].reply = std::move(replies[k]);
      waiting_ = 0;
      changed_.notify_all();
    }
  }

  void close() {
    const Floor floor = take_floor();
    closed_ = true;
    changed_.notify_all();
  }

 private:
  std::mutex mutex_;  ///< the floor
  std::condition_variable changed_;
  std::vector<AnswersOfPoints> desks_;
  std::size_t running_;
  std::size_t waiting_ = 0;
  bool closed_ = false;
};

}  // namespace

void ask_together(Pool& pool, const std::vector<std::uint32_t>& definitions,
                  const std::function<void(std::size_t, const AskCell&)>& run) {
  Office office(definitions.size());
  std::vector<std::exception_ptr> errors(definitions.size());
  std::vector<std::thread> threads;
  for (std::size_t test = 0; test < definitions.size(); ++test) {
    threads.emplace_back([&, test] {
      Office::Floor floor = office.take_floor();
      try {
        run(test, [&](const CellRequest& request) { return office.ask(floor, test, request); });
      } catch (...) {
        errors[test] = std::current_exception();
      }
      office.leave();
    });
  }
  std::exception_ptr of_pool;
  try {
    office.serve(pool, definitions);
  } catch (...) {
    of_pool = std::current_exception();
    office.close();
  }
  for (std::thread& thread : threads) thread.join();
  if (of_pool) std::rethrow_exception(of_pool);
  for (const std::exception_ptr& error : errors)
    if (error) std::rethrow_exception(error);
}

}  // namespace polargrain::coupler
