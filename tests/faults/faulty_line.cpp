// SPDX-License-Identifier: GPL-2.0-or-later
// A worker behind a bad line:   faulty_line SEED PERCENT WORKER --connect URL
// Becomes the worker; a child process passes its messages on, and of every hundred in each direction loses,
// doubles, delays behind the next and cuts short PERCENT each.
#include <signal.h>
#include <stdlib.h>
#include <sys/prctl.h>
#include <unistd.h>

#include <array>
#include <cstdio>
#include <random>
#include <string>
#include <zmq.hpp>

namespace {

class Direction {
 public:
  Direction(zmq::socket_t& from, zmq::socket_t& to, std::mt19937_64& generator, int percent)
      : from_(from), to_(to), generator_(generator), percent_(static_cast<std::uint64_t>(percent)) {}

  void pass_on() {
    for (zmq::message_t message; from_.recv(message, zmq::recv_flags::dontwait);) {
      std::string bytes = message.to_string();
      const std::uint64_t fate = generator_() % 100 / percent_;
      if (fate == 0) continue;
      if (fate == 1) send(bytes);
      if (fate == 2 && held_.empty()) {
        held_ = bytes;
        continue;
      }
      if (fate == 3) bytes.resize(generator_() % (bytes.size() + 1));
      send(bytes);
      if (!held_.empty()) send(held_);
      held_.clear();
    }
  }

 private:
  void send(const std::string& bytes) { to_.send(zmq::buffer(bytes), zmq::send_flags::dontwait); }

  zmq::socket_t& from_;
  zmq::socket_t& to_;
  std::mt19937_64& generator_;
  std::uint64_t percent_;
  std::string held_;
};

[[noreturn]] void be_the_line(const std::string& upstream, const std::string& downstream, std::uint64_t seed,
                              int percent) {
  prctl(PR_SET_PDEATHSIG, SIGKILL);
  zmq::context_t context;
  zmq::socket_t coordinator(context, zmq::socket_type::dealer);
  zmq::socket_t worker(context, zmq::socket_type::dealer);
  coordinator.connect(upstream);
  worker.bind(downstream);
  std::mt19937_64 generator(seed);
  Direction up(worker, coordinator, generator, percent);
  Direction down(coordinator, worker, generator, percent);
  std::array<zmq::pollitem_t, 2> items{
      {{worker.handle(), 0, ZMQ_POLLIN, 0}, {coordinator.handle(), 0, ZMQ_POLLIN, 0}}};
  for (;;) {
    zmq::poll(items, std::chrono::milliseconds(-1));
    up.pass_on();
    down.pass_on();
  }
}

}  // namespace

int main(int count, char** arguments) {
  if (count != 6) return 2;
  std::array<char, 32> directory{"/tmp/faulty_line_XXXXXX"};
  if (mkdtemp(directory.data()) == nullptr) return 1;
  const std::string url = "ipc://" + std::string(directory.data()) + "/line";
  // Each worker a line of its own: the seed is mixed with the process, the statistics stay.
  const auto seed = std::stoull(arguments[1]) + static_cast<std::uint64_t>(getpid());
  if (fork() == 0) be_the_line(arguments[5], url, seed, std::stoi(arguments[2]));
  execl(arguments[3], arguments[3], "--connect", url.c_str(), nullptr);
  std::perror("faulty_line");
  return 127;
}
