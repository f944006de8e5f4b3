// SPDX-License-Identifier: GPL-2.0-or-later
#pragma once
#include <array>
#include <cmath>
#include <cstdio>
#include <filesystem>
#include <fstream>
#include <numbers>
#include <string>

namespace polargrain::testing {

/// A specimen whose numbers are known: rows of equal discs, each row in the gaps of the one below.
inline constexpr double kRadius = 0.005;
inline constexpr double kPressure = 1e4;  // contact stiffness over pressure and thickness: 3000
inline constexpr int kColumns = 8;
inline constexpr int kRows = 15;

inline void write_lattice(const std::filesystem::path& file) {
  std::ofstream out(file);
  out.precision(17);
  const int count = (kRows / 2 + 1) * kColumns + kRows / 2 * (kColumns - 1);
  // The engine's discs have unit thickness; those of the lattice are 0.1 m thick.
  const double density = 2650.0 * 0.1;
  out << "lattice\n\n"
      << count
      << " atoms\n1 atom types\n\n-0.1 0.3 xlo xhi\n-0.1 0.4 ylo yhi\n-0.05 0.05 zlo zhi\n\nAtoms\n\n";
  int id = 0;
  for (int row = 0; row < kRows; ++row)
    for (int column = 0; column < kColumns - row % 2; ++column)
      out << ++id << " 1 " << 2.0 * kRadius << " " << density << " " << kRadius * (2 * column + 1 + row % 2)
          << " " << kRadius * (1.0 + std::sqrt(3.0) * row) << " 0\n";
}

/// Output of `polargrain-liggghts` on a script in a folder, and its exit status.
struct ScriptRun {
  std::string text;
  int status = 0;
};

inline ScriptRun run_liggghts_script(const std::filesystem::path& folder, const std::string& script,
                                     const std::string& variables) {
  const std::string command = "cd " + folder.string() + " && " + POLARGRAIN_LIGGGHTS + " -in " + script +
                              " -log none " + variables + " 2>&1";
  FILE* const pipe = popen(command.c_str(), "r");
  ScriptRun run;
  std::array<char, 4096> block{};
  while (const std::size_t got = fread(block.data(), 1, block.size(), pipe))
    run.text.append(block.data(), got);
  run.status = pclose(pipe);
  return run;
}

}  // namespace polargrain::testing
