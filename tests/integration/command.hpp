// SPDX-License-Identifier: GPL-2.0-or-later
#pragma once
#include <sys/wait.h>
#include <unistd.h>

#include <array>
#include <cstdio>
#include <filesystem>
#include <fstream>
#include <sstream>
#include <string>

namespace polargrain::testing {

/// The outcome of a command.
struct Outcome {
  int status = -1;
  std::string out;
  std::string errors;
};

inline std::string content(const std::filesystem::path& file) {
  std::ifstream in(file, std::ios::binary);
  std::ostringstream text;
  text << in.rdbuf();
  return text.str();
}

inline void write(const std::filesystem::path& file, const std::string& text) {
  std::ofstream(file, std::ios::binary) << text;
}

/// A directory of a test's own, removed at its end.
class Scratch {
 public:
  explicit Scratch(const std::string& name)
      : path_(std::filesystem::temp_directory_path() /
              ("polargrain_test_" + name + std::to_string(getpid()))) {
    std::filesystem::remove_all(path_);
    std::filesystem::create_directories(path_);
  }
  ~Scratch() { std::filesystem::remove_all(path_); }
  Scratch(const Scratch&) = delete;
  Scratch& operator=(const Scratch&) = delete;
  [[nodiscard]] const std::filesystem::path& path() const { return path_; }

 private:
  std::filesystem::path path_;
};

/// Runs a shell command in a directory; its output must not be one of the directory's files.
inline Outcome run_in(const std::filesystem::path& directory, const std::string& command) {
  const std::string errors = directory.string() + ".stderr";
  std::FILE* pipe =
      popen(("cd '" + directory.string() + "' && " + command + " 2>'" + errors + "'").c_str(), "r");
  Outcome outcome;
  std::array<char, 4096> buffer{};
  for (std::size_t count = 0; (count = fread(buffer.data(), 1, buffer.size(), pipe)) > 0;) {
    outcome.out.append(buffer.data(), count);
  }
  const int status = pclose(pipe);
  outcome.status = WIFEXITED(status) ? WEXITSTATUS(status) : -1;
  outcome.errors = content(errors);
  std::filesystem::remove(errors);
  return outcome;
}

/// Commands of the shell that wait for the run whose process is $run, and set $url to where it lets workers join: it listens at a
/// port that was free.
inline std::string await_url(const std::string& result) {
  return "until url=$(sed -n 's/.*workers may join at //p' '" + result +
         "/run.log' 2>/dev/null) && [ -n \"$url\" ]; do kill -0 $run || exit 1; sleep 0.05; done; ";
}

}  // namespace polargrain::testing
