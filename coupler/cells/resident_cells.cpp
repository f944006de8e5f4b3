// SPDX-License-Identifier: GPL-2.0-or-later
#include "coupler/cells/resident_cells.hpp"

#include <fmt/format.h>

#include <string>
#include <utility>

namespace polargrain::coupler {
namespace {

/// Losses in one call after which the boxes themselves are taken to end their workers.
constexpr int kMostLosses = 10;

/// Steps that may be repeated for the sake of workers that have joined: those behind the start, or a read-out.
constexpr std::size_t kFewSteps = 10;

std::string repeated(std::size_t steps) {
  return steps == 1 ? "1 step is repeated" : fmt::format("{} steps are repeated", steps);
}

}  // namespace

ResidentCells::ResidentCells(Pool& pool, std::uint32_t definition, std::size_t most_recorded)
    : pool_(pool), team_(pool, definition), most_recorded_(most_recorded) {}

void ResidentCells::start(std::span<const ResidentStart> starts) {
  starts_.assign(starts.begin(), starts.end());
  record_.clear();
  are_there_ = false;
}

template <class Call>
auto ResidentCells::with_all_there(const Call& call) {
  for (int losses = 1;; ++losses) {
    try {
      if (!are_there_) {
        team_.move_in(starts_);
        for (std::size_t step = 0; step < record_.count(); ++step)
          team_.go_on(record_.dem_steps(step), record_.increments(step));
        are_there_ = true;
      }
      return call();
    } catch (const ResidentsLost& lost) {
      are_there_ = false;
      if (losses == kMostLosses) throw;
      const std::string text = lost.what();
      pool_.tell(fmt::format("{}{}all boxes go back to where they were read out last, and {}", text,
                             text.ends_with('\n') ? "" : "; ", repeated(record_.count())));
    }
  }
}

std::vector<ResidentAnswer> ResidentCells::go_on(int dem_steps, std::span<const CellIncrement> increments) {
  if (record_.count() <= kFewSteps && team_.could_spread()) are_there_ = false;
  std::vector<ResidentAnswer> answers = with_all_there([&] { return team_.go_on(dem_steps, increments); });
  record_.add(dem_steps, increments);
  // By the steps alone, whoever has the boxes: a read-out has a part in their bits.
  if (record_.bytes() > most_recorded_) read_out();
  return answers;
}

std::vector<ResidentReadOut> ResidentCells::read_out() {
  std::vector<ResidentReadOut> boxes = with_all_there([&] { return team_.read_out(); });
  for (std::size_t box = 0; box < boxes.size(); ++box)
    starts_[box] = {boxes[box].reply.state, boxes[box].motion};
  record_.clear();
  return boxes;
}

double ResidentCells::time_step() {
  return with_all_there([&] { return team_.time_step(); });
}

}  // namespace polargrain::coupler
