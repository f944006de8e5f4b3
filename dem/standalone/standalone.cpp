// SPDX-License-Identifier: GPL-2.0-or-later
#include "dem/standalone/standalone.hpp"

#include <unistd.h>

#include <algorithm>
#include <array>
#include <cstdio>
#include <cstdlib>
#include <string>
#include <string_view>
#include <vector>

#include "common/contact_library_file.hpp"
#include "common/error.hpp"
#include "dem/contact/contact_library.hpp"
#include "dem/engine/engine.hpp"
#include "dem/engine/liggghts.hpp"
#include "dem/sphere_loop/engine_pass.hpp"

namespace polargrain::dem {

namespace {

LAMMPS_NS::LAMMPS* running_engine = nullptr;

/// The script being read and the text of its last command: members that the engine keeps for its heirs.
struct ScriptPosition : LAMMPS_NS::Input {
  static FILE* file(LAMMPS_NS::Input& input) {
    return (input.*(&ScriptPosition::nfile)) > 0
               ? (input.*(&ScriptPosition::infiles))[input.*(&ScriptPosition::nfile) - 1]
               : nullptr;
  }
  static const char* text(LAMMPS_NS::Input& input) { return input.*(&ScriptPosition::line); }
};

std::string name_of(int descriptor) {
  std::array<char, 4096> name{};
  const std::string link = "/proc/self/fd/" + std::to_string(descriptor);
  const ssize_t length = readlink(link.c_str(), name.data(), name.size());
  return length > 0 ? std::string(name.data(), static_cast<std::size_t>(length)) : "script";
}

/// Number of lines the engine has read of the file.
long lines_read(FILE* file) {
  const long end = std::ftell(file);
  std::array<char, 4096> block{};
  long lines = 0;
  for (long at = 0; at < end;) {
    const long wanted = std::min(end - at, static_cast<long>(block.size()));
    const ssize_t got = pread(fileno(file), block.data(), static_cast<std::size_t>(wanted), at);
    if (got <= 0) break;
    lines += std::count(block.begin(), block.begin() + got, '\n');
    at += got;
  }
  return lines;
}

void tell_position() {
  if (!running_engine || !running_engine->input) return;
  FILE* const file = ScriptPosition::file(*running_engine->input);
  const char* const text = ScriptPosition::text(*running_engine->input);
  if (!file || !text || std::ftell(file) < 0) return;
  std::string command(text);
  command.erase(command.find_last_not_of(" \t\r\n") + 1);
  std::fprintf(stderr, "polargrain-liggghts: stopped at %s:%ld: %s\n", name_of(fileno(file)).c_str(),
               lines_read(file), command.c_str());
}

/// Takes `-contact FILE` out of the words of the command line, which the engine does not know. @returns the files
std::vector<std::string> take_contact_libraries(std::vector<char*>& words) {
  std::vector<std::string> files;
  for (std::size_t k = 1; k < words.size();) {
    if (std::string_view(words[k]) != "-contact") {
      ++k;
      continue;
    }
    if (k + 1 == words.size()) throw RunError("-contact: the name of a library of contact laws must follow");
    files.emplace_back(words[k + 1]);
    words.erase(words.begin() + static_cast<std::ptrdiff_t>(k),
                words.begin() + static_cast<std::ptrdiff_t>(k + 2));
  }
  return files;
}

void run_script(std::vector<char*> words, const std::function<void()>& add_models) {
  const std::vector<std::string> libraries = take_contact_libraries(words);
  Engine engine(static_cast<int>(words.size()), words.data());
  offer_fast_pass(engine.lammps());
  if (add_models) add_models();
  for (const std::string& library : libraries) add_contact_library({library, {}});
  running_engine = &engine.lammps();
  // Errors that all processes see end in exit(), others in MPI_Abort().
  on_exit(
      [](int status, void*) {
        if (status != 0) tell_position();
      },
      nullptr);
  engine.lammps().input->file();
  running_engine = nullptr;
}

}  // namespace

int run_liggghts(int argc, char** argv, const std::function<void()>& add_models) {
  constexpr int kInputWrong = 2;
  start_standalone_process(argc, argv);
  int status = 0;
  try {
    run_script({argv, argv + argc}, add_models);
  } catch (const RunError& error) {
    std::fprintf(stderr, "polargrain-liggghts: %s\n", error.what());
    status = kInputWrong;
  }
  MPI_Finalize();
  return status;
}

}  // namespace polargrain::dem

// The engine ends the process by this call on every error, and nothing else of it tells where the script
// stood. The profiling interface of MPI is made for standing in between.
extern "C" int MPI_Abort(MPI_Comm communicator, int code) {
  std::fflush(stdout);
  polargrain::dem::tell_position();
  std::fflush(stderr);
  return PMPI_Abort(communicator, code);
}
