// SPDX-License-Identifier: GPL-2.0-or-later
// The cost of a checkpoint: seconds and bytes for many cells, and the memory of the coordinator for each.
//
//     checkpoint_bench [CELLS [BYTES_OF_A_STATE [DIRECTORY]]]      512 cells of 104064 bytes (400 discs)
#include <fmt/format.h>

#include <chrono>
#include <cstdlib>
#include <fstream>
#include <random>

#include "common/cell.hpp"
#include "common/record_archive.hpp"
#include "coupler/checkpoint/checkpoint.hpp"

namespace {

using namespace polargrain;
using Clock = std::chrono::steady_clock;

/// Resident memory of this process, bytes.
double resident() {
  std::ifstream in("/proc/self/statm");
  double all = 0.0;
  double pages = 0.0;
  in >> all >> pages;
  return 4096.0 * pages;
}

/// Bytes that no compression shortens, as those of grains.
StatePointer state_of(std::size_t bytes, std::mt19937_64& random) {
  std::vector<std::byte> content(bytes);
  for (std::byte& byte : content) byte = static_cast<std::byte>(random());
  return std::make_shared<const State>(std::move(content));
}

template <class Action>
double seconds_of(Action action) {
  const Clock::time_point begin = Clock::now();
  action();
  return std::chrono::duration<double>(Clock::now() - begin).count();
}

}  // namespace

int main(int count, char** arguments) {
  const std::size_t cells = count > 1 ? std::strtoul(arguments[1], nullptr, 10) : 512;
  const std::size_t bytes = count > 2 ? std::strtoul(arguments[2], nullptr, 10) : 104064;
  const std::filesystem::path directory = count > 3 ? arguments[3] : ".";
  std::mt19937_64 random(1);
  const double before = resident();
  // Committed and trial answers, as coupler/cell_material keeps them between evaluation and commit.
  std::vector<CellReply> committed(cells);
  std::vector<CellReply> trial(cells);
  for (std::size_t i = 0; i < cells; ++i) {
    committed[i].state = state_of(bytes, random);
    trial[i].state = state_of(bytes, random);
  }
  const double memory = resident() - before;
  fmt::print("coordinator: {:.0f} bytes a cell with two states of {} bytes\n",
             memory / static_cast<double>(cells), bytes);

  const std::filesystem::path file = directory / "checkpoint_bench.h5";
  coupler::Checkpoint checkpoint;
  const double keeping =
      seconds_of([&] { write_records(checkpoint.state, "cells", std::span<const CellReply>(committed)); });
  const double writing = seconds_of([&] { coupler::write_checkpoint(file, checkpoint); });
  const auto size = static_cast<double>(std::filesystem::file_size(file));
  std::vector<CellReply> read;
  const double reading = seconds_of([&] {
    coupler::Checkpoint again = coupler::read_checkpoint(file);
    read = read_records<CellReply>(again.state, "cells", cells);
  });
  for (std::size_t i = 0; i < cells; ++i) {
    if (read[i].state->name() != committed[i].state->name()) return 1;
  }
  fmt::print(
      "{} cells: {:.4f} s to keep a step in memory, {:.3f} s to write, {:.3f} s to read, {:.1f} MB, "
      "{:.0f} bytes a cell beside its state\n",
      cells, keeping, writing, reading, 1e-6 * size,
      size / static_cast<double>(cells) - static_cast<double>(bytes));
  std::filesystem::remove(file);
}
