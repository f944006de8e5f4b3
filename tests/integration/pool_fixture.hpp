// SPDX-License-Identifier: GPL-2.0-or-later
#pragma once
#include <gtest/gtest.h>
#include <unistd.h>

#include <cstring>
#include <filesystem>
#include <functional>
#include <string>
#include <vector>

#include "common/error.hpp"
#include "coupler/pool/pool.hpp"

namespace polargrain::coupler {

/// A pool whose workers are simulated.
class PoolTest : public ::testing::Test {
 protected:
  void SetUp() override {
    directory_ = std::filesystem::temp_directory_path() /
                 (std::string("polargrain_") +
                  ::testing::UnitTest::GetInstance()->current_test_info()->name() + std::to_string(getpid()));
    std::filesystem::create_directories(directory_);
  }
  void TearDown() override { std::filesystem::remove_all(directory_); }

  [[nodiscard]] PoolOptions options(int workers, std::vector<std::string> more = {}) const {
    PoolOptions options;
    options.workers = workers;
    options.directory = directory_;
    options.worker_command = {FAKE_WORKER};
    options.worker_command.insert(options.worker_command.end(), more.begin(), more.end());
    return options;
  }

  [[nodiscard]] std::string log(int worker) const {
    return (directory_ / "logs" / ("worker-" + std::to_string(worker) + ".log")).string();
  }

  std::filesystem::path directory_;
};

inline bool same_bits(const CellReply& a, const CellReply& b) {
  return std::memcmp(a.response.stress.data(), b.response.stress.data(), sizeof(Eigen::Matrix3d)) == 0 &&
         std::memcmp(a.response.tangent.data(), b.response.tangent.data(), sizeof(Matrix18)) == 0 &&
         a.state->name() == b.state->name();
}

/// The replies with the bytes of their states, as a material has them after a commit.
inline std::vector<CellReply> collected(Pool& pool, std::vector<CellReply> replies) {
  std::vector<StatePointer> states;
  for (const CellReply& reply : replies) states.push_back(reply.state);
  states = pool.collect(states);
  for (std::size_t r = 0; r < replies.size(); ++r) replies[r].state = states[r];
  return replies;
}

inline std::string message_of(const std::function<void()>& call) {
  try {
    call();
  } catch (const RunError& error) {
    return error.what();
  }
  return "nothing was thrown";
}

}  // namespace polargrain::coupler
