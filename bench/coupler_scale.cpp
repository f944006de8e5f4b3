// SPDX-License-Identifier: GPL-2.0-or-later
// What the coordinator costs when there are many cells and many workers: simulated workers answer at once
// with a recorded-size reply, so that everything measured is messages, states and bookkeeping.
//
//   coupler_scale [CELLS [STATE_BYTES]]          as coordinator: starts itself as its workers
#include <sys/resource.h>
#include <unistd.h>

#include <cstdio>
#include <cstring>
#include <filesystem>
#include <fstream>
#include <string>

#include "coupler/pool/pool.hpp"

namespace {

using namespace polargrain;
using namespace polargrain::coupler;

constexpr double kEngineSeconds = 0.0285;  // one evaluation of the demo's cell, docs/performance.md

/// Answers at once: a state of the size asked for in the script, different from every other.
class SimulatedEngine : public CellService {
 public:
  explicit SimulatedEngine(std::size_t bytes) : bytes_(bytes) {}
  CellReply initial() override { return reply(1.0); }
  CellReply evaluate(const CellRequest& request) override {
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
  std::size_t bytes_;
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

void measure(int workers, std::size_t cells, std::size_t bytes) {
  PoolOptions options;
  options.workers = workers;
  options.directory = std::filesystem::temp_directory_path() / ("coupler_scale_" + std::to_string(getpid()));
  options.startup_seconds = 60.0;
  options.worker_command = {std::filesystem::read_symlink("/proc/self/exe"), "worker"};
  Pool pool(options);
  CellDefinition definition{"sand", "none", std::to_string(bytes), {}, {}};
  definition.packing.box.setIdentity();
  definition.packing.thickness = 1.0;
  definition.packing.grains = {{1, {0.5, 0.5}, 0.4, 1.0, 0.08}};
  const std::uint32_t sand = pool.define(definition);
  pool.initial(sand);
  const double before = resident_megabytes();
  std::vector<CellReply> committed;
  std::vector<PoolRequest> requests(cells);
  double own = 0.0;
  double wall = 0.0;
  for (int iteration = 0; iteration < 2; ++iteration) {  // from the packing, then from states of one's own
    for (std::size_t c = 0; c < cells; ++c) {
      requests[c].cell.increment.displacement_gradient(0, 0) = 1e-6 * static_cast<double>(c + 1) + iteration;
      if (iteration > 0) requests[c].cell.state = committed[c].state;
    }
    const double own_before = seconds_of(RUSAGE_SELF);
    const double wall_before = pool.counts().wall_seconds;
    committed = pool.evaluate(requests);
    own = seconds_of(RUSAGE_SELF) - own_before;
    wall = pool.counts().wall_seconds - wall_before;
  }
  // Later pools reuse the memory of the first: only there it says what a cell takes.
  static const double per_cell = 1e3 * (resident_megabytes() - before) / static_cast<double>(cells);
  const double each = own / static_cast<double>(cells);
  std::printf("%8d %10.0f %12.0f %12.0f %14.1f %12.0f\n", workers, 1e6 * each,
              1e6 * wall / static_cast<double>(cells),
              static_cast<double>(pool.counts().bytes_sent + pool.counts().bytes_received) / 2.0 /
                  static_cast<double>(cells),
              per_cell, kEngineSeconds / each);
  std::fflush(stdout);
  std::filesystem::remove_all(options.directory);
}

}  // namespace

int main(int count, char** arguments) {
  if (count == 4 && std::string(arguments[1]) == "worker") {
    serve(arguments[3], [](const CellDefinition& definition) -> std::unique_ptr<CellService> {
      return std::make_unique<SimulatedEngine>(std::stoul(definition.script));
    });
    return 0;
  }
  const std::size_t cells = count > 1 ? std::stoul(arguments[1]) : 10000;
  const std::size_t bytes = count > 2 ? std::stoul(arguments[2]) : 110000;
  std::printf("%zu cells, states of %zu bytes; an engine is taken to need %.3f s an evaluation\n", cells,
              bytes, kEngineSeconds);
  std::printf("%8s %10s %12s %12s %14s %12s\n", "workers", "us, own", "us, wall", "bytes", "kB a cell",
              "saturates at");
  for (const int workers : {1, 2, 8, 32}) measure(workers, cells, bytes);
}
