// SPDX-License-Identifier: GPL-2.0-or-later
#include "coupler/pool/process.hpp"

#include <fcntl.h>
#include <fmt/format.h>
#include <net/if.h>
#include <poll.h>
#include <sched.h>
#include <signal.h>
#include <sys/ioctl.h>
#include <sys/prctl.h>
#include <sys/resource.h>
#include <sys/socket.h>
#include <sys/syscall.h>
#include <sys/wait.h>
#include <unistd.h>

#include <algorithm>
#include <cerrno>
#include <cstdint>
#include <cstring>
#include <fstream>

#include "common/error.hpp"

namespace polargrain::coupler {
namespace {

std::string described(int status) {
  if (WIFSIGNALED(status)) {
    return fmt::format("killed by signal {} ({})", WTERMSIG(status), strsignal(WTERMSIG(status)));
  }
  return fmt::format("exit status {}", WEXITSTATUS(status));
}

void write_text(const char* file, const std::string& text) {
  const int descriptor = open(file, O_WRONLY | O_CLOEXEC);
  if (descriptor < 0) return;
  [[maybe_unused]] const ssize_t written = write(descriptor, text.data(), text.size());
  close(descriptor);
}

/// Lines of /proc/self/uid_map and gid_map that keep user and group what they are.
struct IdMaps {
  std::string user = fmt::format("{0} {0} 1", geteuid());
  std::string group = fmt::format("{0} {0} 1", getegid());
};

/// A network namespace with nothing in it; the user namespace around it is what lets every user make one. Where the
/// system does not allow that, the worker finds out and says so.
void leave_network(const IdMaps& maps) {
  if (unshare(CLONE_NEWUSER | CLONE_NEWNET) != 0) return;
  prctl(PR_SET_DUMPABLE, 1);  // or the files below would be root's
  write_text("/proc/self/setgroups", "deny");
  write_text("/proc/self/uid_map", maps.user);
  write_text("/proc/self/gid_map", maps.group);
  // The loopback of the namespace: Open MPI wants to see some interface.
  const int any = socket(AF_INET, SOCK_DGRAM | SOCK_CLOEXEC, 0);
  ifreq loopback{};
  strcpy(loopback.ifr_name, "lo");
  loopback.ifr_flags = IFF_UP;
  ioctl(any, SIOCSIFFLAGS, &loopback);
  close(any);
}

/// The work of the child between fork and exec; only calls that are safe there.
[[noreturn]] void become(char* const* arguments, int log, pid_t parent, const IdMaps* maps) {
  if (maps != nullptr) leave_network(*maps);  // first: it takes the signal of the parent's end away
  // A group of its own: Ctrl-C at the terminal goes to the coordinator alone, which ends its workers in
  // order.
  setpgid(0, 0);
  prctl(PR_SET_PDEATHSIG, SIGKILL);
  if (getppid() != parent) _exit(1);
  // A worker needs no rights beyond its own, and what an engine leaves when it crashes is its log, not its memory.
  prctl(PR_SET_NO_NEW_PRIVS, 1, 0, 0, 0);
  const rlimit no_core{0, 0};
  setrlimit(RLIMIT_CORE, &no_core);
  const int nothing = open("/dev/null", O_RDONLY);
  dup2(nothing, STDIN_FILENO);
  dup2(log, STDOUT_FILENO);
  dup2(log, STDERR_FILENO);
  execvp(arguments[0], arguments);
  const char* reason = strerror(errno);
  const char* parts[] = {"cannot execute ", arguments[0], ": ", reason, "\n"};
  for (const char* part : parts) {
    if (write(STDERR_FILENO, part, strlen(part)) < 0) break;
  }
  _exit(127);
}

}  // namespace

Process::Process(const std::vector<std::string>& arguments, const std::filesystem::path& log,
                 Network network) {
  const IdMaps maps;
  const int log_descriptor = open(log.c_str(), O_WRONLY | O_CREAT | O_APPEND | O_CLOEXEC, 0644);
  if (log_descriptor < 0) {
    throw RunError(
        fmt::format("cannot write the log {} of a worker: {}", log.string(), std::strerror(errno)));
  }
  std::vector<char*> raw;
  for (const std::string& argument : arguments) raw.push_back(const_cast<char*>(argument.c_str()));
  raw.push_back(nullptr);
  const pid_t parent = getpid();
  id_ = fork();
  if (id_ == 0) become(raw.data(), log_descriptor, parent, network == Network::none ? &maps : nullptr);
  const int fork_error = errno;
  close(log_descriptor);
  if (id_ < 0) throw RunError(fmt::format("cannot start a worker: {}", std::strerror(fork_error)));
  end_descriptor_ = static_cast<int>(syscall(SYS_pidfd_open, id_, 0));
  if (end_descriptor_ < 0) {
    const int error = errno;
    kill(id_, SIGKILL);
    waitpid(id_, nullptr, 0);
    throw RunError(fmt::format("cannot watch a worker (pidfd_open): {}", std::strerror(error)));
  }
  fcntl(end_descriptor_, F_SETFD, FD_CLOEXEC);
}

Process::Process(Process&& other) noexcept
    : id_(other.id_),
      end_descriptor_(other.end_descriptor_),
      end_(std::move(other.end_)),
      end_signal_(other.end_signal_) {
  other.id_ = -1;
  other.end_descriptor_ = -1;
}

Process::~Process() {
  if (id_ < 0) return;
  finish(0);
  close(end_descriptor_);
}

std::optional<std::string> Process::end() {
  int status = 0;
  if (!end_ && waitpid(id_, &status, WNOHANG) == id_) note(status);
  return end_;
}

std::chrono::nanoseconds starved_between(const ProcessorShare& before, const ProcessorShare& now,
                                         std::chrono::nanoseconds elapsed) {
  if (now.ready && now.ran == before.ran) return elapsed;  // this wait is not over, and not in `waited` yet
  return std::clamp(now.waited - before.waited, std::chrono::nanoseconds::zero(), elapsed);
}

ProcessorShare Process::processor_share() const {
  std::ifstream in(fmt::format("/proc/{}/schedstat", id_));
  std::int64_t ran = 0;
  std::int64_t waited = 0;
  if (!(in >> ran >> waited)) return {};
  return {std::chrono::nanoseconds(ran), std::chrono::nanoseconds(waited), state() == 'R'};
}

char Process::state() const {
  std::ifstream in(fmt::format("/proc/{}/stat", id_));
  std::string line;
  std::getline(in, line);
  const std::size_t name_end = line.rfind(')');  // the name may hold anything
  return name_end != std::string::npos && line.size() > name_end + 2 ? line[name_end + 2] : ' ';
}

void Process::note(int status) {
  end_ = described(status);
  if (WIFSIGNALED(status)) end_signal_ = WTERMSIG(status);
}

void Process::finish(int milliseconds) {
  if (end()) return;
  pollfd descriptor{end_descriptor_, POLLIN, 0};
  poll(&descriptor, 1, milliseconds);
  if (end()) return;
  kill(id_, SIGKILL);
  int status = 0;
  if (waitpid(id_, &status, 0) == id_) note(status);
}

}  // namespace polargrain::coupler
