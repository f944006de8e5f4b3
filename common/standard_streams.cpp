// SPDX-License-Identifier: GPL-2.0-or-later
#include "common/standard_streams.hpp"

#include <fcntl.h>
#include <signal.h>
#include <unistd.h>

#include "common/plain_text.hpp"

namespace polargrain {

void open_standard_streams() {
  for (const int descriptor : {STDIN_FILENO, STDOUT_FILENO, STDERR_FILENO}) {
    if (fcntl(descriptor, F_GETFD) >= 0) continue;
    // The lowest free number is the one: those below are open.
    if (open("/dev/null", O_RDWR) != descriptor) _exit(1);
  }
}

void make_signals_of_writes_errors() {
  for (const int signal_of_write : {SIGPIPE, SIGXFSZ}) signal(signal_of_write, SIG_IGN);
}

bool tell_text(std::FILE* stream, const std::string& said) {
  const std::string text = without_control_characters(said);
  return std::fwrite(text.data(), 1, text.size(), stream) == text.size() && std::fflush(stream) == 0;
}

}  // namespace polargrain
