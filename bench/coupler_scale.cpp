// SPDX-License-Identifier: GPL-2.0-or-later
// The cost of the coordinator with many cells and many workers: simulated workers answer with a
// state of the size asked for after they have slept for a while, so that everything measured is messages,
// states and bookkeeping. A step is as Newton's method makes it: every cell is evaluated some times, then the
// last states are collected.
//
//   coupler_scale [CELLS [STATE_BYTES [MILLISECONDS [WORKERS ...]]]]  as coordinator: starts itself as its
//   workers
//   coupler_scale lasting MINUTES CELLS STATE_BYTES MILLISECONDS WORKERS   for so long, a line a step: whether memory
//   stays and every answer is that of its question. Status 1 when one is not, or a worker was lost
//
// 200 workers that sleep for 30 ms ask a tenth of what so many engines at 3 ms do, and one machine can be all
// of them.
#include <sys/resource.h>
#include <unistd.h>

#include <chrono>
#include <cstdio>
#include <cstring>
#include <filesystem>
#include <fstream>
#include <sstream>
#include <string>
#include <thread>
#include <vector>

#include "coupler/pool/pool.hpp"

namespace {

using namespace polargrain;
using namespace polargrain::coupler;

constexpr double kEngineSeconds = 0.0029;  // an evaluation of a fast cell
constexpr int kIterations = 4;             // evaluations of each cell a step
constexpr int kFirstSteps = 2;             // not measured: from one common state, and until memory is there
constexpr int kSteps = 3;

/// Sleeps and answers: a state of the size asked for in the script, different from every other.
class SimulatedEngine : public CellService {
 public:
  /// @param script bytes of a state and milliseconds an evaluation
  explicit SimulatedEngine(const std::string& script) {
    std::istringstream(script) >> bytes_ >> milliseconds_;
  }
  CellReply initial() override { return reply(1.0); }
  CellReply evaluate(const CellRequest& request) override {
    if (milliseconds_ > 0.0) {
      std::this_thread::sleep_for(std::chrono::duration<double, std::milli>(milliseconds_));
    }
    return reply(request.increment.displacement_gradient(0, 0));
  }

 private:
  [[nodiscard]] CellReply reply(double mark) const {
    std::vector<std::byte> state(bytes_);
    for (std::size_t k = 0; k + sizeof mark <= bytes_; k += sizeof mark)
      std::memcpy(&state[k], &mark, sizeof mark);
    CellReply reply;
    reply.response.tangent.setIdentity();
    reply.state = std::make_shared<const State>(std::move(state));
    return reply;
  }
  std::size_t bytes_ = 0;
  double milliseconds_ = 0.0;
};

double seconds_of(int who) {
  rusage usage{};
  getrusage(who, &usage);
  return static_cast<double>(usage.ru_utime.tv_sec + usage.ru_stime.tv_sec) +
         1e-6 * static_cast<double>(usage.ru_utime.tv_usec + usage.ru_stime.tv_usec);
}

double resident_megabytes() {
  std::ifstream in("/proc/self/statm");
  long total = 0;
  long resident = 0;
  in >> total >> resident;
  return static_cast<double>(resident) * static_cast<double>(sysconf(_SC_PAGESIZE)) / 1e6;
}

PoolOptions options_for(int workers) {
  PoolOptions options;
  options.workers = workers;
  options.directory = std::filesystem::temp_directory_path() / ("coupler_scale_" + std::to_string(getpid()));
  options.startup_seconds = 60.0;
  options.worker_command = {std::filesystem::read_symlink("/proc/self/exe"), "worker"};
  return options;
}

CellDefinition definition_with(const std::string& script) {
  CellDefinition definition{"sand", "none", script, {}, {}};
  definition.packing.box.setIdentity();
  definition.packing.thickness = 1.0;
  definition.packing.grains = {{1, {0.5, 0.5}, 0.4, 1.0, 0.08}};
  return definition;
}

/// Cells as a material keeps them: committed and on trial.
class Cells {
 public:
  Cells(Pool& pool, std::size_t count, std::uint32_t definition)
      : pool_(pool), committed_(count, pool.initial(definition)), trial_(committed_), requests_(count) {}

  void step() {
    for (int iteration = 0; iteration < kIterations; ++iteration, mark_ += 1.0) {
      trial_.clear();
      for (std::size_t c = 0; c < requests_.size(); ++c) {
        requests_[c].cell.state = committed_[c].state;
        requests_[c].cell.increment.displacement_gradient(0, 0) = mark_of(c);
      }
      trial_ = pool_.evaluate(requests_);
    }
    requests_.assign(requests_.size(), {});
    std::vector<StatePointer> states;
    for (const CellReply& reply : trial_) states.push_back(reply.state);
    states = pool_.collect(states);
    for (std::size_t c = 0; c < states.size(); ++c) trial_[c].state = states[c];
    committed_ = trial_;
  }

  /// How many of the committed states are not those of the last questions.
  [[nodiscard]] std::size_t wrong() const {
    std::size_t count = 0;
    for (std::size_t c = 0; c < committed_.size(); ++c) {
      double mark = 0.0;
      const auto bytes = committed_[c].state->bytes();
      if (bytes.size() >= sizeof mark) std::memcpy(&mark, bytes.data(), sizeof mark);
      count += mark == mark_of(c) - 1.0 ? 0 : 1;
    }
    return count;
  }

 private:
  /// Whole numbers: one less is exact.
  [[nodiscard]] double mark_of(std::size_t cell) const { return mark_ + 1e6 * static_cast<double>(cell + 1); }

  Pool& pool_;
  std::vector<CellReply> committed_;
  std::vector<CellReply> trial_;
  std::vector<PoolRequest> requests_;
  double mark_ = 1.0;
};

void measure(int workers, std::size_t count, const std::string& script) {
  Pool pool(options_for(workers));
  const std::uint32_t sand = pool.define(definition_with(script));
  const double resident_before = resident_megabytes();
  Cells cells(pool, count, sand);
  for (int step = 0; step < kFirstSteps; ++step) cells.step();
  const PoolCounts before = pool.counts();
  const double own_before = seconds_of(RUSAGE_SELF);
  for (int step = 0; step < kSteps; ++step) cells.step();
  const double evaluations = static_cast<double>(kSteps * kIterations) * static_cast<double>(count);
  const double own = (seconds_of(RUSAGE_SELF) - own_before) / evaluations;
  const PoolCounts& after = pool.counts();
  const auto each = [&](auto member) {
    return static_cast<double>(after.*member - before.*member) / evaluations;
  };
  // Later pools reuse the memory of the first: only there it says what a cell takes.
  static const double per_cell = 1e3 * (resident_megabytes() - resident_before) / static_cast<double>(count);
  std::printf("%8d %9.1f %9.1f %12.1f %12.3f %12.3f %11.1f %12.0f\n", workers, 1e6 * own,
              1e6 * each(&PoolCounts::wall_seconds),
              1e-3 * (each(&PoolCounts::bytes_sent) + each(&PoolCounts::bytes_received)),
              each(&PoolCounts::states_sent), each(&PoolCounts::states_fetched), per_cell,
              kEngineSeconds / own);
  std::fflush(stdout);
  std::filesystem::remove_all(options_for(workers).directory);
}

/// Steps for so many minutes. @returns whether everything was answered rightly, by workers that stayed
bool last(double minutes, std::size_t count, const std::string& script, int workers) {
  using Clock = std::chrono::steady_clock;
  Pool pool(options_for(workers));
  const std::uint32_t sand = pool.define(definition_with(script));
  Cells cells(pool, count, sand);
  const Clock::time_point begin = Clock::now();
  const auto seconds = [&begin] { return std::chrono::duration<double>(Clock::now() - begin).count(); };
  std::printf("%9s %9s %13s %16s %13s %6s %6s\n", "step", "s", "evaluations", "us an evaluation",
              "MB of memory", "wrong", "lost");
  std::size_t wrong = 0;
  for (int step = 1; seconds() < 60.0 * minutes; ++step) {
    const double before = seconds();
    cells.step();
    wrong += cells.wrong();
    const double evaluations = static_cast<double>(kIterations) * static_cast<double>(count);
    std::printf("%9d %9.1f %13.0f %16.1f %13.1f %6zu %6d\n", step, seconds(), step * evaluations,
                1e6 * (seconds() - before) / evaluations, resident_megabytes(), wrong,
                static_cast<int>(pool.counts().workers_lost));
    std::fflush(stdout);
  }
  std::filesystem::remove_all(options_for(workers).directory);
  return wrong == 0 && pool.counts().workers_lost == 0;
}

}  // namespace

int main(int count, char** arguments) {
  if (count == 4 && std::string(arguments[1]) == "worker") {
    serve(arguments[3], [](const CellDefinition& definition) -> std::unique_ptr<CellService> {
      return std::make_unique<SimulatedEngine>(definition.script);
    });
    return 0;
  }
  if (count == 7 && std::string(arguments[1]) == "lasting") {
    const std::string script = std::string(arguments[4]) + ' ' + arguments[5];
    return last(std::stod(arguments[2]), std::stoul(arguments[3]), script, std::stoi(arguments[6])) ? 0 : 1;
  }
  const std::size_t cells = count > 1 ? std::stoul(arguments[1]) : 10000;
  const std::string bytes = count > 2 ? arguments[2] : "55000";
  const std::string milliseconds = count > 3 ? arguments[3] : "0";
  std::vector<int> workers;
  for (int k = 4; k < count; ++k) workers.push_back(std::stoi(arguments[k]));
  if (workers.empty()) workers = {2, 8, 32, 200};
  std::printf(
      "%zu cells, states of %s bytes, %d evaluations a step of %s ms; saturation for engines of %.4f s\n",
      cells, bytes.c_str(), kIterations, milliseconds.c_str(), kEngineSeconds);
  std::printf("%8s %9s %9s %12s %12s %12s %11s %12s\n", "workers", "us, own", "us, wall", "kB an eval.",
              "states sent", "fetched", "kB a cell", "saturates at");
  for (const int w : workers) measure(w, cells, bytes + " " + milliseconds);
}
