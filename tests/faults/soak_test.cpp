// SPDX-License-Identifier: GPL-2.0-or-later
// A long run among faults drawn at random from a fixed seed: workers and coordinators killed, guests with a valid key that
// send garbage, refuse, misname states, forge. POLARGRAIN_SOAK_STEPS steps of about 64 evaluations [1600]; the history
// is that of the undisturbed run, to the byte, and the coordinator does not grow.
#include <algorithm>
#include <array>
#include <cstdlib>
#include <fstream>
#include <iostream>
#include <map>
#include <memory>
#include <regex>

#include "tests/faults/fake_case.hpp"
#include "tests/faults/killer.hpp"
#include "tests/support/free_port.hpp"

namespace polargrain::testing {
namespace {

class SoakTest : public FakeCaseTest {
 protected:
  const int port_ = free_port();
  /// A key for every few guests: one that is shut out ends nothing but its own.
  static constexpr int kKeys = 60;
  [[nodiscard]] std::string guest(const std::string& program, const std::string& way,
                                  std::uint64_t which) const {
    const std::string key = 'g' + std::to_string(which / 64 % kKeys) + ".key";
    const std::string log = (scratch_.path() / "guests.log").string();
    return program + ' ' + way + " --key '" + (scratch_.path() / "keys" / key).string() +
           "' --connect tcp://127.0.0.1:" + std::to_string(port_) + " >> '" + log + "' 2>&1";
  }
};

/// Memory in use, MB; 0 when the process is gone.
double megabytes_of(pid_t process) {
  std::ifstream in("/proc/" + std::to_string(process) + "/status");
  for (std::string line; std::getline(in, line);)
    if (line.rfind("VmRSS:", 0) == 0) return std::atof(line.c_str() + 6) / 1024.0;
  return 0.0;
}

double mean(const std::vector<double>& values, std::size_t from, std::size_t to) {
  double sum = 0.0;
  for (std::size_t k = from; k < to; ++k) sum += values[k];
  return to > from ? sum / static_cast<double>(to - from) : 0.0;
}

int whole_after(const std::string& text, const std::string& key) {
  std::smatch found;
  return std::regex_search(text, found, std::regex("\"" + key + "\": ([0-9]+)")) ? std::stoi(found[1]) : -1;
}

TEST_F(SoakTest, FaultsAtRandomChangeNoByteAndTakeNoMemory) {
  const char* const asked = std::getenv("POLARGRAIN_SOAK_STEPS");
  const std::string settings =
      " --set output.every=1000000 --set workers.check=1 --set workers.silence='1 s'";
  const int steps = asked != nullptr ? std::atoi(asked) : 1600;
  const Outcome quiet = run_in(scratch_.path(), command(steps, settings) + " -o quiet -w 1");
  ASSERT_EQ(quiet.status, 0) << quiet.errors;
  write(scratch_.path() / "fake.in", "sleep_milliseconds 1\n");
  for (int k = 0; k < kKeys; ++k)
    ASSERT_EQ(run_in(scratch_.path(), FAKE_POLARGRAIN " keys keys --worker g" + std::to_string(k)).status, 0);
  const std::string start =
      "env -C '" + scratch_.path().string() + "' " + command(steps, settings) +
      " -o soak -w 3 --checkpoint-minutes 0.01 --keys keys --listen tcp://127.0.0.1:" + std::to_string(port_);

  std::mt19937_64 random(20261122);
  std::map<std::string, int> faults;
  std::vector<double> megabytes;  ///< of the coordinator, a list for every one that lived long enough
  std::vector<double> first_and_last;
  std::vector<std::unique_ptr<Beside>> guests;
  auto run = std::make_unique<Beside>(start);
  const auto end_of_life = [&] {
    if (megabytes.size() >= 30) {
      const std::size_t third = megabytes.size() / 3;
      first_and_last = {mean(megabytes, third, 2 * third), mean(megabytes, 2 * third, megabytes.size())};
    }
    megabytes.clear();
  };
  int held = 0;
  for (int status = -1; status != 0;) {
    std::this_thread::sleep_for(std::chrono::milliseconds(20 + random() % 300));
    const std::uint64_t fault = random() % 40;
    const std::uint64_t which = random();
    if (!run->running()) {
      status = run->wait();
      // 2: a child that the killed one had just forked still held the lock of the directory for a moment.
      held = status == 2 ? held + 1 : 0;
      ASSERT_TRUE(status == 0 || status == -1 || (status == 2 && held < 100)) << status;
      if (status == 0) break;
      end_of_life();
      const bool has_checkpoint = std::filesystem::exists(scratch_.path() / "soak" / "checkpoint.h5");
      run = std::make_unique<Beside>(start + (has_checkpoint ? " --resume" : ""));
      continue;
    }
    if (const double now = megabytes_of(run->id()); now > 0.0) megabytes.push_back(now);
    if (fault == 0) {
      ++faults["coordinators killed"];
      kill(run->id(), SIGKILL);
    } else if (fault < 15) {
      const std::vector<pid_t> workers = children_of(run->id());
      if (workers.empty()) continue;
      ++faults[fault < 12 ? "workers killed" : "workers stopped"];
      kill(workers[which % workers.size()], fault < 12 ? SIGKILL : SIGSTOP);
    } else if (fault < 30) {
      static constexpr std::array kWays{"garbage", "refuses", "misnames", "falsifies",
                                        "nan",     "misses",  "nothing"};
      const std::string way = kWays[which % kWays.size()];
      ++faults["guests: " + way];
      guests.push_back(std::make_unique<Beside>(guest(STRANGE_WORKER, way, which)));
    } else if (fault < 34) {
      ++faults["guests that forge"];
      guests.push_back(
          std::make_unique<Beside>(guest("env FAKE_ENGINE_FORGES=1 " FAKE_POLARGRAIN, "worker", which)));
    } else {
      ++faults["guests that are honest"];
      guests.push_back(std::make_unique<Beside>(guest(FAKE_POLARGRAIN, "worker", which)));
    }
    if (guests.size() > 8) guests.erase(guests.begin());  // somebody who goes without a word
  }
  end_of_life();
  for (const auto& [fault, count] : faults) std::cout << "[figure] " << count << ' ' << fault << '\n';
  const std::string summary = result("soak/summary.json");
  std::cout << "[figure] " << whole_after(summary, "evaluations") << " evaluations, "
            << whole_after(summary, "evaluations_checked") << " answers of two workers\n";
  EXPECT_EQ(result("soak/history.csv"), result("quiet/history.csv"));
  if (first_and_last.empty()) return;
  std::cout << "[figure] memory of the last coordinator that lived long: " << first_and_last[0]
            << " MB in the second third of its life, " << first_and_last[1] << " MB in the last\n";
  // Its record for the summary grows by some hundred bytes a step.
  EXPECT_LT(first_and_last[1], 1.1 * first_and_last[0] + 2.0);
}

}  // namespace
}  // namespace polargrain::testing
