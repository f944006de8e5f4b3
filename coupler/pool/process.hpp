// SPDX-License-Identifier: GPL-2.0-or-later
#pragma once
#include <sys/types.h>

#include <chrono>
#include <filesystem>
#include <optional>
#include <string>
#include <vector>

namespace polargrain::coupler {

/// The processor time of the main thread of a process since its start. Zeros where the system does not tell.
struct ProcessorShare {
  std::chrono::nanoseconds ran{};
  std::chrono::nanoseconds waited{};  ///< it was ready to run, and others ran; as of when it ran last
  bool ready = false;                 ///< it is ready to run now
};

/// How long a process was ready to run and did not, between two looks at it that are `elapsed` apart.
std::chrono::nanoseconds starved_between(const ProcessorShare& before, const ProcessorShare& now,
                                         std::chrono::nanoseconds elapsed);

/// A child process whose whole output goes to a file. It ends with us, however we end: by this destructor, or
/// by the kernel when we are killed (PR_SET_PDEATHSIG).
class Process {
 public:
  /// Whether the child sees the machine's network. It always reaches sockets that are files.
  enum class Network { shared, none };
  /// @param arguments program first; @param log appended to, takes standard output and error.
  /// @param network `none` where the system allows
  /// @throws RunError when the log cannot be opened or no process made. A program that cannot be executed
  /// shows as a process that ends with status 127 and says so in its log.
  Process(const std::vector<std::string>& arguments, const std::filesystem::path& log,
          Network network = Network::shared);
  ~Process();
  Process(Process&& other) noexcept;
  Process(const Process&) = delete;
  Process& operator=(const Process&) = delete;
  Process& operator=(Process&&) = delete;

  [[nodiscard]] pid_t id() const { return id_; }
  /// A file descriptor that becomes readable when the process ends.
  [[nodiscard]] int end_descriptor() const { return end_descriptor_; }

  /// "exit status 1", "killed by signal 11 (Segmentation fault)"; nothing while it runs. Does not wait.
  std::optional<std::string> end();
  /// The signal that ended it, once end() has told; nothing when it ended by itself.
  [[nodiscard]] std::optional<int> end_signal() const { return end_signal_; }
  /// Whether a signal has stopped it (SIGSTOP), so that it cannot even be heard of.
  [[nodiscard]] bool stopped() const { return state() == 'T'; }
  [[nodiscard]] ProcessorShare processor_share() const;
  /// Waits so long for the end, then kills.
  void finish(int milliseconds);

 private:
  void note(int status);
  /// The letter that the system gives it: R runs or is ready to, T is stopped, S sleeps; a space when it is gone.
  [[nodiscard]] char state() const;

  pid_t id_ = -1;
  int end_descriptor_ = -1;
  std::optional<std::string> end_;
  std::optional<int> end_signal_;
};

}  // namespace polargrain::coupler
