// SPDX-License-Identifier: GPL-2.0-or-later
#include "coupler/pool/keys.hpp"

#include <fcntl.h>
#include <fmt/format.h>
#include <sys/stat.h>
#include <unistd.h>
#include <zmq.h>

#include <array>
#include <cerrno>
#include <cstring>
#include <fstream>
#include <sstream>

#include "common/error.hpp"
#include "common/regular_file.hpp"

namespace polargrain::coupler {
namespace {

constexpr std::size_t kKeyLength = 40;
constexpr const char* kCoordinatorFile = "coordinator.key";
constexpr const char* kAllowedFile = "workers.allowed";

struct Pair {
  std::string public_key;
  std::string secret_key;
};

Pair new_pair() {
  std::array<char, kKeyLength + 1> open{};
  std::array<char, kKeyLength + 1> secret{};
  if (zmq_curve_keypair(open.data(), secret.data()) != 0) {
    throw RunError("keys cannot be made: this ZeroMQ was built without CURVE");
  }
  return {open.data(), secret.data()};
}

/// Writes a file that nobody but the user can read; with O_EXCL it must be new.
void write_private(const std::filesystem::path& file, const std::string& text, int flags) {
  const int descriptor = open(file.c_str(), O_WRONLY | O_CREAT | O_CLOEXEC | O_NOFOLLOW | flags, 0600);
  const bool written =
      descriptor >= 0 && write(descriptor, text.data(), text.size()) == static_cast<ssize_t>(text.size());
  const int error = errno;
  if (descriptor >= 0) close(descriptor);
  if (!written) throw RunError(fmt::format("{} cannot be written: {}", file.string(), std::strerror(error)));
}

[[noreturn]] void refuse(const std::filesystem::path& file, int line, const std::string& message) {
  throw InputError({file.string(), line, message});
}

/// The lines of a file of keys, first words and second words; comments and blank lines are left out.
struct Line {
  int number;
  std::string first;
  std::string second;
};

std::vector<Line> read_private(const std::filesystem::path& file) {
  if (const std::string reason = why_no_input(file); !reason.empty())
    refuse(file, 0, reason + "; 'polargrain keys DIR' makes the files of keys");
  struct stat status {};
  std::ifstream in(file);
  if (!in || stat(file.c_str(), &status) != 0) refuse(file, 0, "cannot be read");
  if ((status.st_mode & 077) != 0) {
    refuse(file, 0,
           fmt::format("other users may read or change this file; say: chmod 600 {}", file.string()));
  }
  std::vector<Line> lines;
  std::string text;
  for (int number = 1; std::getline(in, text); ++number) {
    std::istringstream words(text);
    Line line{number, {}, {}};
    if (words >> line.first && line.first.front() != '#') {
      words >> line.second;
      lines.push_back(line);
    }
  }
  return lines;
}

bool is_key(const std::string& text) {
  std::array<std::uint8_t, 32> bytes{};
  return text.size() == kKeyLength && zmq_z85_decode(bytes.data(), text.c_str()) != nullptr;
}

std::string key_named(const std::string& name, const std::vector<Line>& lines,
                      const std::filesystem::path& file) {
  for (const Line& line : lines) {
    if (line.first != name) continue;
    if (!is_key(line.second)) refuse(file, line.number, fmt::format("'{}' is not followed by a key", name));
    return line.second;
  }
  refuse(file, 0, fmt::format("there is no line '{} KEY'; make the file anew with 'polargrain keys'", name));
}

}  // namespace

void make_keys(const std::filesystem::path& directory, const std::string& worker_name) {
  const bool plain = !worker_name.empty() && worker_name != "coordinator" &&
                     worker_name.find_first_not_of(
                         "abcdefghijklmnopqrstuvwxyzABCDEFGHIJKLMNOPQRSTUVWXYZ0123456789"
                         "._-") == std::string::npos &&
                     worker_name.front() != '.';
  if (!plain) {
    throw InputError(
        {"", 0,
         fmt::format("'{}' cannot be the name of a worker's key; use letters, digits, - and _ (not "
                     "'coordinator')",
                     worker_name)});
  }
  const std::filesystem::path worker_file = directory / (worker_name + ".key");
  if (std::filesystem::exists(worker_file)) {
    refuse(worker_file, 0,
           "exists already; choose another name with --worker, or remove it and its line in " +
               std::string(kAllowedFile));
  }
  if (!directory.parent_path().empty()) std::filesystem::create_directories(directory.parent_path());
  if (mkdir(directory.c_str(), 0700) != 0 && errno != EEXIST) {
    throw RunError(fmt::format("{} cannot be made: {}", directory.string(), std::strerror(errno)));
  }
  if (!std::filesystem::exists(directory / kCoordinatorFile)) {
    const Pair pair = new_pair();
    write_private(
        directory / kCoordinatorFile,
        fmt::format("# Secret key of a coordinator of polargrain. Keep it to yourself.\npublic {}\nsecret "
                    "{}\n",
                    pair.public_key, pair.secret_key),
        O_EXCL);
    write_private(directory / kAllowedFile, "# Who may work for this coordinator: public key, name.\n",
                  O_EXCL);
  }
  const std::string coordinator_key =
      key_named("public", read_private(directory / kCoordinatorFile), directory / kCoordinatorFile);
  const Pair pair = new_pair();
  write_private(
      worker_file,
      fmt::format("# Secret key of a worker of polargrain, and the public key of its coordinator. Copy it "
                  "to where\n# the worker runs, and to nowhere else.\npublic {}\nsecret {}\ncoordinator "
                  "{}\n",
                  pair.public_key, pair.secret_key, coordinator_key),
      O_EXCL);
  write_private(directory / kAllowedFile, fmt::format("{} {}\n", pair.public_key, worker_name), O_APPEND);
}

CoordinatorKeys read_coordinator_keys(const std::filesystem::path& directory) {
  const std::vector<Line> lines = read_private(directory / kCoordinatorFile);
  CoordinatorKeys keys{key_named("public", lines, directory / kCoordinatorFile),
                       key_named("secret", lines, directory / kCoordinatorFile),
                       {}};
  for (const Line& line : read_private(directory / kAllowedFile)) {
    if (!is_key(line.first)) {
      refuse(directory / kAllowedFile, line.number, fmt::format("'{}' is not a public key", line.first));
    }
    keys.allowed[line.first] = line.second;
  }
  return keys;
}

WorkerKey read_worker_key(const std::filesystem::path& file) {
  const std::vector<Line> lines = read_private(file);
  return {key_named("public", lines, file), key_named("secret", lines, file),
          key_named("coordinator", lines, file)};
}

}  // namespace polargrain::coupler
