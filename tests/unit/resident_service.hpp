// SPDX-License-Identifier: GPL-2.0-or-later
#pragma once
#include <signal.h>
#include <sys/stat.h>
#include <unistd.h>

#include <array>
#include <cmath>
#include <cstdlib>
#include <cstring>
#include <limits>
#include <map>
#include <memory>
#include <sstream>
#include <string>
#include <thread>
#include <vector>

#include "common/error.hpp"
#include "common/resident_boxes.hpp"

namespace polargrain::testing {

inline constexpr double kRestStress = -100e3;  // Pa
inline constexpr double kRestCoordination = 4.0;
inline constexpr int kResidentGrains = 50;
inline constexpr double kTimeStep = 2.5e-6;  ///< s, of their DEM

/// Resident boxes with the arithmetic of a mass on a damped line: every DEM step, its order and every bit count. A
/// read-out rounds the place to single precision. Behaves as its script says, words and values:
///
///     sleep n            takes n milliseconds for a step of all its boxes, with signs of life
///     ends_in_step n     ends in the middle of step n of its boxes, once for all processes ...
///     ends_in_read_out n ... or when so many are read out; `mark` is the directory that the one makes that ends
///     exits_in_step n    every process does, by itself
///     refuses_beyond e   throws when an entry of the displacement gradient is larger
///     nan_beyond e       answers with a number that is not finite
struct ResidentScript {
  explicit ResidentScript(const std::string& script) {
    std::istringstream words(script);
    for (std::string word; words >> word;) word == "mark" ? words >> mark : words >> values[word];
  }
  [[nodiscard]] double value(const std::string& word, double otherwise) const {
    const auto found = values.find(word);
    return found == values.end() ? otherwise : found->second;
  }
  /// The first process that comes here ends as if somebody had killed it.
  void end_once() const {
    if (mkdir(mark.c_str(), 0700) == 0) kill(getpid(), SIGKILL);
  }
  std::map<std::string, double> values;
  std::string mark;
};

class LineBoxes final : public ResidentBoxes {
 public:
  LineBoxes(const ResidentScript& script, const std::function<void()>& progress)
      : script_(script), progress_(progress) {}

  void clear() override { boxes_.clear(); }

  void move_in(std::span<const ResidentStart> starts) override {
    for (const ResidentStart& start : starts) {
      Box box;
      if (start.state) {
        if (start.state->size() != sizeof box.kept) throw RunError("a state of something else");
        std::memcpy(box.kept.data(), start.state->bytes().data(), sizeof box.kept);
      }
      box.speed = start.motion.gradient(0, 1);
      boxes_.push_back(box);
    }
  }

  std::vector<ResidentAnswer> go_on(int dem_steps, std::span<const CellIncrement> increments) override {
    for (int left = static_cast<int>(script_.value("sleep", 0.0)); left > 0; left -= 5) {
      std::this_thread::sleep_for(std::chrono::milliseconds(std::min(left, 5)));
      if (progress_) progress_();
    }
    std::vector<ResidentAnswer> answers;
    for (std::size_t k = 0; k < boxes_.size(); ++k) {
      const CellIncrement& increment = increments[k];
      const double largest = increment.displacement_gradient.cwiseAbs().maxCoeff();
      if (largest > script_.value("refuses_beyond", 1e9)) throw RunError("the box has lost its volume");
      Box& box = boxes_[k];
      const double step = ++box.kept[1];
      if (k == boxes_.size() / 2) {
        if (step == script_.value("ends_in_step", -1.0)) script_.end_once();
        if (step == script_.value("exits_in_step", -1.0)) std::_Exit(3);
      }
      const double rate = (increment.displacement_gradient.sum() + increment.rotation.sum() +
                           0.01 * increment.curvature.sum()) /
                          dem_steps;
      for (int s = 0; s < dem_steps; ++s) {
        box.speed = 0.9 * box.speed + rate;
        box.kept[0] += box.speed;
      }
      ResidentAnswer answer;
      answer.stress.setIdentity();
      answer.stress *= kRestStress * (1.0 + box.kept[0]);
      answer.stress(0, 1) = 1e7 * box.speed;
      answer.unbalanced_force_ratio = std::abs(box.speed);
      answer.coordination_number = kRestCoordination / (1.0 + std::abs(box.kept[0]));
      if (largest > script_.value("nan_beyond", 1e9))
        answer.stress(2, 2) = std::numeric_limits<double>::quiet_NaN();
      answers.push_back(answer);
    }
    return answers;
  }

  std::vector<ResidentReadOut> read_out(std::size_t first, std::size_t count) override {
    std::vector<ResidentReadOut> all;
    for (std::size_t k = first; k < first + count; ++k) {
      if (static_cast<double>(++read_) == script_.value("ends_in_read_out", -1.0)) script_.end_once();
      Box& box = boxes_[k];
      box.kept[0] = static_cast<float>(box.kept[0]);
      const auto bytes = std::as_bytes(std::span(box.kept));
      ResidentReadOut out;
      out.reply.state = std::make_shared<const State>(std::vector<std::byte>(bytes.begin(), bytes.end()));
      out.reply.response.stress(0, 0) = kRestStress * (1.0 + box.kept[0]);
      out.reply.diagnostics.void_ratio = 0.2 + box.kept[0];
      out.reply.diagnostics.coordination_number = kRestCoordination / (1.0 + std::abs(box.kept[0]));
      out.reply.diagnostics.contacts =
          std::llround(0.5 * out.reply.diagnostics.coordination_number * kResidentGrains);
      out.motion.gradient(0, 1) = box.speed;
      all.push_back(out);
    }
    return all;
  }

  [[nodiscard]] std::size_t count() const override { return boxes_.size(); }
  [[nodiscard]] double time_step() const override { return kTimeStep; }

 private:
  struct Box {
    std::array<double, 2> kept{};  ///< place, steps
    double speed = 0.0;
  };
  const ResidentScript& script_;
  const std::function<void()>& progress_;
  std::vector<Box> boxes_;
  int read_ = 0;
};

class LineService final : public CellService {
 public:
  explicit LineService(const CellDefinition& definition) : script_(definition.script) {}

  CellReply initial() override {
    CellReply reply;
    reply.response.stress.setIdentity();
    reply.response.stress *= kRestStress;
    reply.response.tangent.setIdentity();
    reply.response.tangent *= 1e7;
    reply.diagnostics.coordination_number = kRestCoordination;
    reply.diagnostics.contacts = std::llround(0.5 * kRestCoordination * kResidentGrains);
    const std::array<double, 2> kept{};
    const auto bytes = std::as_bytes(std::span(kept));
    reply.state = std::make_shared<const State>(std::vector<std::byte>(bytes.begin(), bytes.end()));
    return reply;
  }
  CellReply evaluate(const CellRequest&) override { throw RunError("these boxes stay"); }
  std::unique_ptr<ResidentBoxes> residents() override {
    return std::make_unique<LineBoxes>(script_, progress);
  }

 private:
  ResidentScript script_;
};

inline CellDefinition resident_definition(const std::string& script) {
  CellDefinition cell{"sand", "line.in", script, {}, {}};
  cell.packing.box << 10.0, 0.0, 0.0, 10.0;
  cell.packing.thickness = 0.1;
  for (int k = 0; k < kResidentGrains; ++k)
    cell.packing.grains.push_back({k + 1, {0.1 * k, 0.1 * k}, 0.1, 1.0, 0.01});
  return cell;
}

}  // namespace polargrain::testing
