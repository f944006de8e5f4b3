// SPDX-License-Identifier: GPL-2.0-or-later
// The cost of the coordinator with many resident boxes: simulated boxes answer at once, so that everything measured is messages
// and bookkeeping. With so many workers the coordinator saturates when a box and step costs a worker less than `workers` times its
// own time for it.
//
//   resident_scale [WORKERS [BOXES ...]]   starts itself as its workers
#include <sys/resource.h>
#include <unistd.h>

#include <chrono>
#include <cstdio>
#include <filesystem>
#include <memory>
#include <string>
#include <vector>

#include "common/resident_boxes.hpp"
#include "coupler/cells/resident_material.hpp"
#include "coupler/pool/pool.hpp"
#include "coupler/pool/worker.hpp"

namespace {

using namespace polargrain;
using namespace polargrain::coupler;

constexpr double kStress = -100e3;  // Pa
constexpr int kSteps = 40;
constexpr int kFirstSteps = 5;  // not measured: boxes move in, and memory is taken

/// Boxes without grains.
class NoBoxes final : public ResidentBoxes {
 public:
  void clear() override { count_ = 0; }
  void move_in(std::span<const ResidentStart> starts) override { count_ += starts.size(); }
  std::vector<ResidentAnswer> go_on(int, std::span<const CellIncrement> increments) override {
    std::vector<ResidentAnswer> answers(increments.size());
    for (std::size_t k = 0; k < answers.size(); ++k) {
      answers[k].stress = kStress * (Eigen::Matrix3d::Identity() + increments[k].displacement_gradient);
      answers[k].coordination_number = 4.0;
    }
    return answers;
  }
  std::vector<ResidentReadOut> read_out(std::size_t, std::size_t) override {
    throw RunError("these boxes hold nothing");
  }
  [[nodiscard]] std::size_t count() const override { return count_; }
  [[nodiscard]] double time_step() const override { return 1e-6; }

 private:
  std::size_t count_ = 0;
};

class NoGrains final : public CellService {
 public:
  CellReply initial() override {
    CellReply reply;
    reply.response.stress = kStress * Eigen::Matrix3d::Identity();
    reply.response.tangent.setIdentity();
    reply.diagnostics.contacts = 2;
    reply.diagnostics.coordination_number = 4.0;
    reply.state = std::make_shared<const State>(std::vector<std::byte>(8));
    return reply;
  }
  CellReply evaluate(const CellRequest&) override { return initial(); }
  std::unique_ptr<ResidentBoxes> residents() override { return std::make_unique<NoBoxes>(); }
};

double own_seconds() {
  rusage usage{};
  getrusage(RUSAGE_SELF, &usage);
  return static_cast<double>(usage.ru_utime.tv_sec + usage.ru_stime.tv_sec) +
         1e-6 * static_cast<double>(usage.ru_utime.tv_usec + usage.ru_stime.tv_usec);
}

PoolOptions options_for(int workers) {
  PoolOptions options;
  options.workers = workers;
  options.directory = std::filesystem::temp_directory_path() / ("resident_scale_" + std::to_string(getpid()));
  options.startup_seconds = 60.0;
  options.worker_command = {std::filesystem::read_symlink("/proc/self/exe"), "worker"};
  return options;
}

void measure(int workers, std::size_t boxes) {
  const PoolOptions options = options_for(workers);
  {
    Pool pool(options);
    CellDefinition definition{"sand", "none", "", {}, {}};
    definition.packing.box.setIdentity();
    definition.packing.thickness = 1.0;
    definition.packing.grains = {{1, {0.5, 0.5}, 0.4, 1.0, 0.08}};
    ResidentMaterial<2> sand(pool, pool.define(definition), CosseratParameters{40e6, 10e6, 0.02}, 5);
    sand.allocate(boxes);
    std::vector<Increment<2>> increments(boxes);
    for (std::size_t k = 0; k < boxes; ++k)
      increments[k].displacement_gradient(1, 1) = -1e-6 * (1.0 + 1e-3 * static_cast<double>(k));
    std::vector<Response<2>> responses(boxes);
    double own = 0.0;
    std::chrono::steady_clock::time_point start;
    PoolCounts before;
    for (int step = 0; step < kFirstSteps + kSteps; ++step) {
      if (step == kFirstSteps) {
        own = own_seconds();
        start = std::chrono::steady_clock::now();
        before = pool.counts();
      }
      sand.evaluate(increments, responses);
      sand.commit();
    }
    const double each = 1.0 / (static_cast<double>(kSteps) * static_cast<double>(boxes));
    own = (own_seconds() - own) * each;
    const double wall =
        std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count() * each;
    const auto bytes = static_cast<double>(pool.counts().bytes_sent - before.bytes_sent +
                                           pool.counts().bytes_received - before.bytes_received);
    std::printf("%8d %9zu %9.3f %9.3f %9.0f %12.1f\n", workers, boxes, 1e6 * own, 1e6 * wall, bytes * each,
                1e6 * own * workers);
    std::fflush(stdout);
  }
  std::filesystem::remove_all(options.directory);
}

}  // namespace

int main(int count, char** arguments) {
  if (count == 4 && std::string(arguments[1]) == "worker") {
    serve(arguments[3],
          [](const CellDefinition&) -> std::unique_ptr<CellService> { return std::make_unique<NoGrains>(); });
    return 0;
  }
  const int workers = count > 1 ? std::stoi(arguments[1]) : 2;
  std::vector<std::size_t> boxes;
  for (int k = 2; k < count; ++k) boxes.push_back(std::stoul(arguments[k]));
  if (boxes.empty()) boxes = {1000, 10000, 100000};
  std::printf("%8s %9s %9s %9s %9s %12s\n", "workers", "boxes", "us, own", "us, wall", "bytes",
              "saturates, us");
  for (const std::size_t b : boxes) measure(workers, b);
}
