// SPDX-License-Identifier: GPL-2.0-or-later
// Mutations of good files with a fixed seed. POLARGRAIN_FUZZ_RUNS asks for more than the few of every day;
// POLARGRAIN_FUZZ_SEEDS names a directory that gets the good files as seeds for the coverage-guided fuzzer.
#include "tests/fuzz/files.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cstdlib>
#include <iostream>
#include <random>

#include "common/packing_file.hpp"
#include "coupler/checkpoint/checkpoint.hpp"
#include "tests/integration/command.hpp"

namespace polargrain::testing {
namespace {

struct Seed {
  FileKind kind;
  std::string bytes;
};

std::string small_packing() {
  const Scratch scratch("fuzz_packing");
  PreparedPacking packing;
  packing.packing.box << 1.0, 0.0, 0.0, 1.0;
  packing.packing.thickness = 0.1;
  packing.packing.grains = {{7, {0.5, 0.5}, 0.4, 1.0, 0.08}, {9, {0.1, 0.1}, 0.1, 0.5, 0.01}};
  packing.specification = "title: two\n";
  write_packing_file(scratch.path() / "packing.h5", packing);
  return content(scratch.path() / "packing.h5");
}

std::string small_checkpoint() {
  const Scratch scratch("fuzz_checkpoint");
  coupler::Checkpoint checkpoint;
  checkpoint.program = "0";
  checkpoint.identity.values = {{"steps.count", "3"}};
  checkpoint.history = "step\n0\n";
  const std::vector<double> values{1.0, 2.0};
  const std::vector<std::int64_t> whole{3};
  const std::vector<StatePointer> states{std::make_shared<const State>(std::vector<std::byte>(40)), nullptr};
  checkpoint.state.write("a/values", std::span<const double>(values));
  checkpoint.state.write("whole", std::span<const std::int64_t>(whole));
  checkpoint.state.write("cells", std::span<const StatePointer>(states));
  coupler::write_checkpoint(scratch.path() / "checkpoint.h5", checkpoint);
  return content(scratch.path() / "checkpoint.h5");
}

std::vector<Seed> seeds() {
  const std::filesystem::path source = POLARGRAIN_SOURCE_DIRECTORY;
  std::vector<Seed> all;
  for (const auto& entry : std::filesystem::recursive_directory_iterator(source / "cases")) {
    if (entry.path().filename() == "case.yaml") all.push_back({FileKind::case_file, content(entry.path())});
  }
  std::sort(all.begin(), all.end(), [](const Seed& a, const Seed& b) { return a.bytes < b.bytes; });
  // Small ones that are accepted, with every kind of entry.
  all.push_back(
      {FileKind::case_file,
       "title: Small\nmesh: {rectangle: {size: [0.4 m, 0.8 m], elements: [2, 2]}, element: Q4}\n"
       "deformation: large\nmaterials:\n  rock: &r {model: elastic, E: 1 GPa, nu: 0.2, Gc: 1 GPa, lc: 1 mm}\n"
       "regions: {all: rock}\nboundary:\n  - {on: bottom, fix: [u1, u2]}\n"
       "  - {on: top, move: {u2: [[0, 0], [1, -4 mm]]}}\n  - {on: [left, right], pressure: 100 kPa}\n"
       "steps: {stages: [{until: 1, count: 2}, {arc_length: 1 mm, count: 2}]}\n"
       "monitors: {f: {on: top, reaction: u2}, g: -f / (0.4 m * 100 kPa)}\noutput: {every: 2, table: "
       "[g]}\n"});
  all.push_back(
      {FileKind::case_file,
       "title: Grains\nmesh: {rectangle: {size: [0.4 m, 0.8 m], elements: [1, 2]}}\n"
       "materials: {sand: {model: cell, script: fake.in, packing: grains.csv, G: 40 MPa, Gc: 10 MPa, "
       "lc: 20 mm}}\nregions: {all: sand}\nboundary:\n  - {on: bottom, fix: [u1, u2]}\n"
       "  - {on: top, move: {u2: -4 mm}}\nsteps: {count: 3, tolerance: 1e-3}\n"});
  all.push_back({FileKind::packing_csv,
                 "# cell xx=0.1 xy=0 yx=0 yy=0.1 z=0.1\nid,x,y,r,mass,Izz\n1,0.05,0.05,0.04,1.0,8e-4\n"
                 "2,0.01,0.02,0.01,0.1,1e-5\n"});
  all.push_back({FileKind::packing_hdf5, small_packing()});
  all.push_back({FileKind::path, "# two\nh22,h11,w,k1\n-1e-3,0,1e-4,0\n-1e-3,5e-4,0,2.5\n"});
  for (const auto& entry : std::filesystem::directory_iterator(source / "cases/packings")) {
    if (entry.path().extension() == ".yaml") all.push_back({FileKind::specification, content(entry.path())});
  }
  all.push_back({FileKind::checkpoint, small_checkpoint()});
  constexpr std::size_t kSeal = 32;  // bytes of the mark and the hash
  for (const auto& [kind, bytes] : {Seed{FileKind::forged_packing, small_packing()},
                                    Seed{FileKind::forged_checkpoint, small_checkpoint()}})
    all.push_back({kind, bytes.substr(0, bytes.size() - kSeal)});
  return all;
}

/// Changes some bytes, moves, repeats or drops pieces, puts in what is likely to hurt.
class Mutator {
 public:
  explicit Mutator(unsigned seed) : random_(seed) {}
  std::string operator()(std::string bytes) {
    for (std::size_t change = 1 + below(4); change > 0; --change) bytes = changed(std::move(bytes));
    return bytes;
  }

 private:
  std::size_t below(std::size_t end) { return end == 0 ? 0 : random_() % end; }

  std::string changed(std::string bytes) {
    static const std::vector<std::string> kWords{"nan",
                                                 "-1",
                                                 "1e999",
                                                 "0",
                                                 "99999999999999999999",
                                                 "{",
                                                 "}",
                                                 "[",
                                                 "]",
                                                 ":",
                                                 "\n",
                                                 ",",
                                                 "- ",
                                                 "&a ",
                                                 "*a",
                                                 "!!",
                                                 "\t",
                                                 "''",
                                                 "\"",
                                                 "#",
                                                 "%",
                                                 "model",
                                                 "cell",
                                                 "elastic",
                                                 "1e-320",
                                                 "NaN",
                                                 std::string(1, '\0'),
                                                 std::string(300, '['),
                                                 std::string(8, '\xff'),
                                                 "\xef\xbb\xbf",
                                                 "../..",
                                                 "/dev/zero",
                                                 "all",
                                                 "top"};
    const std::size_t place = below(bytes.size() + 1);
    const std::size_t length = std::min(bytes.size() - place, 1 + below(1 + below(64)));
    switch (below(6)) {
      case 0:
        if (place < bytes.size()) bytes[place] = static_cast<char>(random_());
        return bytes;
      case 1:
        if (place < bytes.size()) bytes[place] = static_cast<char>(bytes[place] ^ (1 << below(8)));
        return bytes;
      case 2:
        return bytes.erase(place, length);
      case 3:
        return bytes.insert(below(bytes.size() + 1), bytes.substr(place, length));
      case 4:
        return bytes.insert(place, kWords[below(kWords.size())]);
      default:
        return bytes.replace(place, length, kWords[below(kWords.size())]);
    }
  }

  std::mt19937 random_;
};

TEST(FuzzedFiles, AreAcceptedOrRefusedInWords) {
  const char* asked = std::getenv("POLARGRAIN_FUZZ_RUNS");
  const long runs = asked != nullptr ? std::atol(asked) : 1500;
  const std::vector<Seed> good = seeds();
  if (const char* directory = std::getenv("POLARGRAIN_FUZZ_SEEDS")) {
    std::filesystem::create_directories(directory);
    for (std::size_t i = 0; i < good.size(); ++i) {
      write(std::filesystem::path(directory) / ("seed" + std::to_string(i)),
            static_cast<char>(good[i].kind) + good[i].bytes);
    }
  }
  std::array<long, kFileKinds> accepted{};
  std::array<long, kFileKinds> read{};
  Mutator mutate(20260103);
  for (long run = 0; run < runs; ++run) {
    const Seed& seed = good[static_cast<std::size_t>(run) % good.size()];
    const auto kind = static_cast<std::size_t>(seed.kind);
    ++read[kind];
    const std::string bytes = mutate(seed.bytes);
    try {
      accepted[kind] += read_as(seed.kind, bytes) ? 1 : 0;
    } catch (const std::exception& error) {
      write(std::filesystem::temp_directory_path() / "polargrain_fuzz_failure", bytes);
      FAIL() << "kind " << kind << ", run " << run << " (kept in polargrain_fuzz_failure): " << error.what();
    }
  }
  std::cout << "[figure] " << runs << " files";
  for (std::size_t kind = 0; kind < kFileKinds; ++kind)
    std::cout << "; kind " << kind << ": " << accepted[kind] << " of " << read[kind] << " accepted";
  std::cout << '\n';
}

TEST(FuzzedFiles, StartFromFilesThatAreAccepted) {
  for (const Seed& seed : seeds()) {
    // Cases of the project with meshes or packings beside them are refused: those are not here.
    const auto names = [&](const char* file) { return seed.bytes.find(file) != std::string::npos; };
    if (names(".msh") || names("packing400") || names("packing1000") || names("sand.h5")) continue;
    EXPECT_TRUE(read_as(seed.kind, seed.bytes))
        << static_cast<int>(seed.kind) << ": " << seed.bytes.substr(0, 60);
  }
}

}  // namespace
}  // namespace polargrain::testing
