// SPDX-License-Identifier: GPL-2.0-or-later
// Workers that join and leave over TCP, and those that must not.
#include <arpa/inet.h>
#include <gtest/gtest.h>
#include <netinet/in.h>
#include <signal.h>
#include <sys/socket.h>
#include <sys/stat.h>
#include <sys/wait.h>
#include <unistd.h>

#include <array>
#include <atomic>
#include <cstring>
#include <deque>
#include <iostream>
#include <random>
#include <thread>
#include <zmq.hpp>

#include "common/error.hpp"
#include "coupler/pool/pool.hpp"
#include "coupler/pool/process.hpp"
#include "coupler/protocol/messages.hpp"
#include "tests/integration/command.hpp"
#include "tests/integration/fake_engine.hpp"
#include "tests/support/eventually.hpp"

namespace polargrain::coupler {
namespace {

using testing::eventually;
using testing::Scratch;

class GuestsTest : public ::testing::Test {
 protected:
  GuestsTest() : scratch_(::testing::UnitTest::GetInstance()->current_test_info()->name()) {
    make_keys(keys(), "worker");
  }

  [[nodiscard]] std::filesystem::path keys() const { return scratch_.path() / "keys"; }
  [[nodiscard]] std::filesystem::path log() const { return scratch_.path() / "guest.log"; }

  [[nodiscard]] PoolOptions options(int workers, const std::string& url = "tcp://127.0.0.1:*") {
    PoolOptions options;
    options.workers = workers;
    options.directory = scratch_.path();
    options.worker_command = {FAKE_WORKER};
    options.listening = Listening{url, read_coordinator_keys(keys())};
    options.tell = [this](const std::string& text) { told_ += text + '\n'; };
    return options;
  }

  [[nodiscard]] std::vector<std::string> guest(const std::string& url, const std::string& key,
                                               const std::string& patience = "20") const {
    return {FAKE_WORKER, "--key", key, "--patience", patience, "--connect", url};
  }
  [[nodiscard]] std::string worker_key() const { return (keys() / "worker.key").string(); }

  Scratch scratch_;
  std::string told_;
};

std::vector<PoolRequest> requests_of(std::size_t count) {
  std::mt19937_64 generator(3);
  std::uniform_real_distribution<double> entry(-1e-3, 1e-3);
  std::vector<PoolRequest> requests(count);
  for (PoolRequest& request : requests) {
    for (double& value : request.cell.increment.displacement_gradient.reshaped()) value = entry(generator);
  }
  return requests;
}

void expect_exact(const std::vector<CellReply>& replies, const std::vector<PoolRequest>& requests) {
  for (std::size_t r = 0; r < replies.size(); ++r) {
    ASSERT_EQ(replies[r].response.quality, Quality::good) << replies[r].response.message;
    EXPECT_EQ(replies[r].response.stress, testing::fake_stress(requests[r].cell.increment)) << r;
  }
}

/// Evaluates requests once and until something has happened; the answers are exact all the while.
template <class Happened>
void evaluate_until(Pool& pool, std::size_t cells, Happened happened) {
  const std::vector<PoolRequest> requests = requests_of(cells);
  const auto evaluate = [&] { expect_exact(pool.evaluate(requests), requests); };
  evaluate();
  EXPECT_TRUE(eventually(happened, evaluate));
}

/// Waits until the process ends. @returns how
std::string end_of(Process& process) {
  EXPECT_TRUE(eventually([&] { return process.end().has_value(); }));
  return process.end().value_or("still running");
}

/// Whether the worker whose name begins so has answered.
bool has_answered(const Pool& pool, const std::string& name) {
  const auto found = pool.worker_records().lower_bound(name);
  return found != pool.worker_records().end() && found->first.starts_with(name);
}

TEST_F(GuestsTest, KeysAreSecretFilesAndNothingIsOverwritten) {
  for (const char* name : {"coordinator.key", "worker.key", "workers.allowed"}) {
    struct stat status {};
    ASSERT_EQ(stat((keys() / name).c_str(), &status), 0) << name;
    EXPECT_EQ(status.st_mode & 0777, 0600u) << name;
  }
  EXPECT_EQ(std::filesystem::status(keys()).permissions(), std::filesystem::perms::owner_all);
  EXPECT_THROW(make_keys(keys(), "worker"), InputError);
  EXPECT_THROW(make_keys(keys(), "../elsewhere"), InputError);
  make_keys(keys(), "node7");
  EXPECT_EQ(read_coordinator_keys(keys()).allowed.size(), 2u);
  EXPECT_EQ(read_worker_key(keys() / "node7.key").coordinator_key, read_coordinator_keys(keys()).public_key);
  chmod((keys() / "worker.key").c_str(), 0640);
  EXPECT_THROW(read_worker_key(keys() / "worker.key"), InputError);
}

TEST_F(GuestsTest, TheyJoinDuringARunAndLeaveIt) {
  Pool pool(options(1));
  pool.define(testing::fake_definition("sleep_milliseconds 10"));
  Process first(guest(pool.listening_url(), worker_key()), log());
  evaluate_until(pool, 20, [&] { return has_answered(pool, "guest 1 on "); });
  Process second(guest(pool.listening_url(), worker_key()), log());
  evaluate_until(pool, 20, [&] { return has_answered(pool, "guest 2 on "); });
  // In the middle of a cell: everybody has two at hand while there are more for all.
  pool.on_progress([&](std::size_t done, std::size_t) {
    if (done >= 10) kill(first.id(), SIGKILL);
  });
  evaluate_until(pool, 100, [&] { return told_.find("its connection is closed") != std::string::npos; });
  EXPECT_NE(told_.find("guest 1 on "), std::string::npos) << told_;
  EXPECT_EQ(pool.counts().workers_lost, 1);
  const double members = pool.counts().member_seconds / pool.counts().wall_seconds;
  std::cout << "[figure] workers in the mean " << members << '\n';
  EXPECT_GT(members, 1.0);
  EXPECT_LT(members, 3.0);
}

TEST_F(GuestsTest, ARunMayLiveOnGuestsAlone) {
  Pool pool(options(0));
  const std::uint32_t sand = pool.define(testing::fake_definition(""));
  Process one(guest(pool.listening_url(), worker_key()), log());
  EXPECT_EQ(pool.initial(sand).response.stress(0, 0), -100e3);
  const std::vector<PoolRequest> requests = requests_of(20);
  expect_exact(pool.evaluate(requests), requests);
}

TEST_F(GuestsTest, GuestsAreToldWhenTheRunIsOver) {
  std::optional<Pool> pool(options(0));
  const std::uint32_t sand = pool->define(testing::fake_definition(""));
  Process one(guest(pool->listening_url(), worker_key()), log());
  pool->initial(sand);
  pool.reset();
  EXPECT_EQ(end_of(one), "exit status 0") << testing::content(log());
}

TEST_F(GuestsTest, AGuestFindsTheNextCoordinatorAtTheSameUrl) {
  // The first coordinator lives in a process of its own, so that it can be killed without a word.
  std::array<int, 2> line{};
  ASSERT_EQ(pipe(line.data()), 0);
  const pid_t first = fork();
  if (first == 0) {
    Pool pool(options(0));
    const std::string url = pool.listening_url();
    if (write(line[1], url.data(), url.size()) < 0) _exit(1);
    pool.initial(pool.define(testing::fake_definition("")));
    if (write(line[1], "!", 1) < 0) _exit(1);
    for (;;) pause();
  }
  std::array<char, 256> text{};
  ASSERT_GT(read(line[0], text.data(), text.size() - 1), 0);
  const std::string url = text.data();
  Process guest_process(guest(url, worker_key()), log());
  ASSERT_GT(read(line[0], text.data(), 1), 0);  // it has worked for the first
  kill(first, SIGKILL);
  waitpid(first, nullptr, 0);
  Pool second(options(0, url));
  EXPECT_EQ(second.initial(second.define(testing::fake_definition("young 1e6"))).response.tangent(1, 1),
            0.4e6);
  EXPECT_FALSE(guest_process.end());
}

TEST_F(GuestsTest, AKeyThatIsNotOnTheListIsRefused) {
  Pool pool(options(1));
  pool.define(testing::fake_definition("sleep_milliseconds 10"));
  make_keys(scratch_.path() / "others", "stranger");
  // The stranger knows the coordinator's public key, but the coordinator does not know the stranger's.
  const WorkerKey stranger = read_worker_key(scratch_.path() / "others" / "stranger.key");
  const auto file = scratch_.path() / "stranger.key";
  testing::write(file, "public " + stranger.public_key + "\nsecret " + stranger.secret_key +
                           "\ncoordinator " + read_coordinator_keys(keys()).public_key + "\n");
  chmod(file.c_str(), 0600);
  Process unwelcome(guest(pool.listening_url(), file.string()), log());
  evaluate_until(pool, 20, [&] { return unwelcome.end().has_value(); });
  EXPECT_EQ(end_of(unwelcome), "exit status 1");
  EXPECT_NE(testing::content(log()).find("refuses this worker's key; add it to workers.allowed"),
            std::string::npos)
      << testing::content(log());
  EXPECT_NE(
      told_.find("was refused: 127.0.0.1: its key " + stranger.public_key + " is not in workers.allowed"),
      std::string::npos)
      << told_;
  EXPECT_GE(pool.refused(), 1u);
  EXPECT_EQ(pool.counts().workers_lost, 0);
}

TEST_F(GuestsTest, AWorkerTakesNothingFromACoordinatorThatIsNotItsOwn) {
  // The worker's file names another coordinator: this one cannot prove to be it, and no script gets through.
  make_keys(scratch_.path() / "others", "worker");
  Pool pool(options(1));
  pool.define(testing::fake_definition("sleep_milliseconds 10"));
  Process suspicious(guest(pool.listening_url(), (scratch_.path() / "others" / "worker.key").string(), "1"),
                     log());
  evaluate_until(pool, 20, [&] { return suspicious.end().has_value(); });
  EXPECT_EQ(end_of(suspicious), "exit status 1");
  EXPECT_NE(testing::content(log()).find("no coordinator at "), std::string::npos) << testing::content(log());
  EXPECT_NE(told_.find("it does not prove a key as this coordinator asks"), std::string::npos) << told_;
  EXPECT_EQ(pool.counts().member_seconds, pool.counts().wall_seconds);  // never more than the local one
  EXPECT_EQ(pool.worker_records().size(), 1U);
}

TEST_F(GuestsTest, WithoutAKeyNobodyEntersAndNoWorkerStarts) {
  Pool pool(options(1));
  pool.define(testing::fake_definition("sleep_milliseconds 10"));
  zmq::context_t context;
  zmq::socket_t plain(context, zmq::socket_type::dealer);
  plain.set(zmq::sockopt::linger, 0);
  plain.connect(pool.listening_url());
  plain.send(zmq::buffer(encode(Hello{kProtocolVersion, 1, "plain"})), zmq::send_flags::dontwait);
  Process bare({FAKE_WORKER, "--connect", pool.listening_url()}, log());
  evaluate_until(pool, 20, [&] { return pool.refused() >= 1; });
  zmq::message_t answer;
  EXPECT_FALSE(plain.recv(answer, zmq::recv_flags::dontwait));
  EXPECT_EQ(end_of(bare), "exit status 1");
  EXPECT_NE(testing::content(log()).find("needs --key FILE"), std::string::npos) << testing::content(log());
}

TEST_F(GuestsTest, TwoCoordinatorsOnOneEndpoint) {
  const Pool first(options(1));
  try {
    const Pool second(options(1, first.listening_url()));
    FAIL() << "both listen at " << first.listening_url();
  } catch (const RunError& error) {
    EXPECT_NE(std::string(error.what()).find("another coordinator or program holds this port"),
              std::string::npos)
        << error.what();
  }
}

/// A TCP connection that the test itself speaks.
class Raw {
 public:
  explicit Raw(int port) : descriptor_(socket(AF_INET, SOCK_STREAM, 0)) {
    sockaddr_in address{};
    address.sin_family = AF_INET;
    address.sin_port = htons(static_cast<std::uint16_t>(port));
    address.sin_addr.s_addr = htonl(INADDR_LOOPBACK);
    connected_ = connect(descriptor_, reinterpret_cast<sockaddr*>(&address), sizeof address) == 0;
  }
  explicit Raw(int descriptor, bool) : descriptor_(descriptor), connected_(true) {}
  ~Raw() { close(descriptor_); }
  Raw(const Raw&) = delete;
  Raw& operator=(const Raw&) = delete;
  [[nodiscard]] bool connected() const { return connected_; }
  void send(const std::string& bytes) const { ::send(descriptor_, bytes.data(), bytes.size(), MSG_NOSIGNAL); }
  [[nodiscard]] std::string receive() const {
    std::array<char, 4096> bytes{};
    const ssize_t count = recv(descriptor_, bytes.data(), bytes.size(), MSG_DONTWAIT);
    return count > 0 ? std::string(bytes.data(), static_cast<std::size_t>(count)) : std::string();
  }

 private:
  int descriptor_;
  bool connected_ = false;
};

int port_of(const std::string& url) {
  return std::stoi(url.substr(url.rfind(':') + 1));
}

/// Passes a worker's connection on, and remembers what the worker said in its handshake.
class Eavesdropper {
 public:
  explicit Eavesdropper(int port) : listener_(socket(AF_INET, SOCK_STREAM, 0)) {
    sockaddr_in address{};
    address.sin_family = AF_INET;
    address.sin_addr.s_addr = htonl(INADDR_LOOPBACK);
    socklen_t size = sizeof address;
    bind(listener_, reinterpret_cast<sockaddr*>(&address), size);
    listen(listener_, 1);
    getsockname(listener_, reinterpret_cast<sockaddr*>(&address), &size);
    port_ = ntohs(address.sin_port);
    thread_ = std::thread([this, port] {
      const Raw worker(accept(listener_, nullptr, nullptr), true);
      const Raw coordinator(port);
      while (!stop_) {
        const std::string up = worker.receive();
        heard_.push_back(up);
        coordinator.send(up);
        worker.send(coordinator.receive());
        usleep(500);
      }
    });
  }
  [[nodiscard]] int port() const { return port_; }
  std::vector<std::string> stop() {
    stop_ = true;
    thread_.join();
    close(listener_);
    return heard_;
  }

 private:
  int listener_;
  int port_ = 0;
  std::atomic<bool> stop_ = false;
  std::vector<std::string> heard_;
  std::thread thread_;
};

TEST_F(GuestsTest, AReplayedHandshakeIsRefused) {
  Pool pool(options(0));
  const std::uint32_t sand = pool.define(testing::fake_definition("sleep_milliseconds 10"));
  Eavesdropper ear(port_of(pool.listening_url()));
  std::optional<Process> honest;
  honest.emplace(guest("tcp://127.0.0.1:" + std::to_string(ear.port()), worker_key()), log());
  pool.initial(sand);  // the handshake went through, the worker was welcomed
  const std::vector<std::string> heard = ear.stop();
  honest.reset();
  // The same bytes once more, as they came.
  Process local_help(guest(pool.listening_url(), worker_key()), log());
  const std::size_t before = pool.refused();
  const Raw replay(port_of(pool.listening_url()));
  ASSERT_TRUE(replay.connected());
  std::thread player([&] {
    for (const std::string& bytes : heard) {
      if (bytes.empty()) continue;
      replay.send(bytes);
      usleep(30000);
    }
  });
  evaluate_until(pool, 20, [&] { return pool.refused() > before; });
  player.join();
  evaluate_until(pool, 20, [] { return true; });
  EXPECT_EQ(told_.find("guest 3"), std::string::npos) << told_;
}

TEST_F(GuestsTest, AThousandComersAndGoersDoNotDisturbARun) {
  constexpr int kComers = 1000;
  constexpr std::size_t kAtATime = 50;
  PoolOptions patient = options(2);
  patient.patience.silence_seconds = 600.0;  // they go before they are found to be silent
  Pool pool(patient);
  pool.define(testing::fake_definition("sleep_milliseconds 4"));
  const WorkerKey key = read_worker_key(worker_key());
  std::atomic<int> gone = 0;
  std::atomic<int> welcomed = 0;
  std::thread crowd([&, url = pool.listening_url()] {
    zmq::context_t context;
    context.set(zmq::ctxopt::max_sockets, 4096);
    std::deque<zmq::socket_t> present;
    for (int k = 0; k < kComers || !present.empty(); ++k) {
      if (k < kComers) {
        zmq::socket_t& socket = present.emplace_back(context, zmq::socket_type::dealer);
        socket.set(zmq::sockopt::linger, 0);
        socket.set(zmq::sockopt::rcvtimeo, 300'000);
        socket.set(zmq::sockopt::curve_publickey, key.public_key);
        socket.set(zmq::sockopt::curve_secretkey, key.secret_key);
        socket.set(zmq::sockopt::curve_serverkey, key.coordinator_key);
        socket.connect(url);
        socket.send(zmq::buffer(encode(Hello{kProtocolVersion, k, "crowd"})));
        if (present.size() <= kAtATime) continue;
      }
      // The first of them goes when it has been welcomed, and takes work with it, whatever it was given.
      zmq::message_t welcome;
      if (present.front().recv(welcome)) ++welcomed;
      present.pop_front();
      ++gone;
    }
  });
  // One that goes while there is no work is noticed within the second, by what is sent to all.
  evaluate_until(pool, 200, [&] { return gone == kComers && pool.counts().workers_lost >= welcomed; });
  crowd.join();
  std::cout << "[figure] comers and goers " << kComers << ", of which were welcomed " << welcomed << ", lost "
            << pool.counts().workers_lost << "; evaluations meanwhile " << pool.counts().evaluations << '\n';
  EXPECT_EQ(welcomed, kComers);
  EXPECT_EQ(pool.counts().workers_lost, kComers);
}

}  // namespace
}  // namespace polargrain::coupler
