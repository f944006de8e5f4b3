// SPDX-License-Identifier: GPL-2.0-or-later
// Boxes that stay with their workers: the same bits for any number of workers, and whoever is lost.
#include <signal.h>

#include <atomic>
#include <bit>
#include <iostream>
#include <random>
#include <thread>

#include "coupler/cells/resident_cells.hpp"
#include "coupler/pool/keys.hpp"
#include "coupler/pool/process.hpp"
#include "tests/support/eventually.hpp"
#include "tests/support/processes.hpp"
#include "tests/unit/resident_fixture.hpp"

namespace polargrain::coupler {
namespace {

constexpr std::size_t kBoxes = 83;
constexpr int kSteps = 12;
constexpr int kDemSteps = 7;

CellIncrement some_increment(std::size_t box, int step) {
  CellIncrement increment;
  increment.displacement_gradient(0, 0) = 1e-3 * std::sin(0.3 * static_cast<double>(box) + step);
  increment.displacement_gradient(1, 0) = -2e-4 * std::cos(0.1 * step);
  increment.rotation(2) = 1e-5 * static_cast<double>(box);
  return increment;
}

std::vector<CellIncrement> some_increments(std::size_t boxes, int step) {
  std::vector<CellIncrement> increments;
  for (std::size_t box = 0; box < boxes; ++box) increments.push_back(some_increment(box, step));
  return increments;
}

/// All bits that a run gives.
struct Course {
  std::vector<double> numbers;
  std::vector<ContentName> states;
  bool operator==(const Course& other) const {
    return numbers.size() == other.numbers.size() && states == other.states &&
           (numbers.empty() ||
            std::memcmp(numbers.data(), other.numbers.data(), numbers.size() * sizeof(double)) == 0);
  }
};

void append(Course& course, const std::vector<ResidentAnswer>& answers) {
  for (const ResidentAnswer& answer : answers) {
    course.numbers.insert(course.numbers.end(), answer.stress.data(), answer.stress.data() + 9);
    course.numbers.push_back(answer.unbalanced_force_ratio);
    course.numbers.push_back(answer.coordination_number);
  }
}

void append(Course& course, const std::vector<ResidentReadOut>& boxes) {
  for (const ResidentReadOut& box : boxes) {
    course.states.push_back(box.reply.state->name());
    course.numbers.push_back(box.motion.gradient(0, 1));
  }
}

/// Twelve steps, with read-outs behind the fifth and the tenth.
Course course_of(ResidentCells& cells, std::size_t boxes, const std::function<void(int)>& before_step = {}) {
  cells.start(std::vector<ResidentStart>(boxes));
  Course course;
  for (int step = 0; step < kSteps; ++step) {
    if (before_step) before_step(step);
    append(course, cells.go_on(kDemSteps, some_increments(boxes, step)));
    if (step == 4 || step == 9) append(course, cells.read_out());
  }
  return course;
}

/// The same without a pool.
Course expected_course(std::size_t boxes) {
  testing::LineService service(testing::resident_definition(""));
  const std::unique_ptr<ResidentBoxes> line = service.residents();
  line->move_in(std::vector<ResidentStart>(boxes));
  Course course;
  for (int step = 0; step < kSteps; ++step) {
    append(course, line->go_on(kDemSteps, some_increments(boxes, step)));
    if (step == 4 || step == 9) append(course, line->read_out(0, boxes));
  }
  return course;
}

std::string message_of(const std::function<void()>& call) {
  try {
    call();
  } catch (const RunError& error) {
    return error.what();
  }
  return "nothing was thrown";
}

TEST_F(ResidentTest, AnyNumberOfWorkersGivesTheSameBits) {
  const Course expected = expected_course(kBoxes);
  for (const int workers : {1, 2, 3}) {
    Pool pool(options(workers));
    ResidentCells cells(pool, pool.define(testing::resident_definition("")));
    EXPECT_EQ(course_of(cells, kBoxes), expected) << workers;
    EXPECT_EQ(pool.counts().evaluations, static_cast<std::int64_t>(kSteps * kBoxes));
    EXPECT_EQ(pool.counts().dem_steps, static_cast<std::int64_t>(kSteps * kBoxes * kDemSteps));
    EXPECT_EQ(pool.counts().states_fetched, static_cast<std::int64_t>(2 * kBoxes));
    EXPECT_EQ(pool.worker_records().size(), static_cast<std::size_t>(workers));
  }
  EXPECT_TRUE(told_.empty());
}

TEST_F(ResidentTest, FewerBoxesThanWorkers) {
  Pool pool(options(3));
  ResidentCells two(pool, pool.define(testing::resident_definition("")));
  EXPECT_EQ(course_of(two, 2), expected_course(2));
  ResidentCells none(pool, pool.define(testing::resident_definition("")));
  EXPECT_EQ(course_of(none, 0), Course{});
}

/// One message to each worker and step, and one back.
TEST_F(ResidentTest, AStepTakesOneMessageAWorker) {
  Pool pool(options(2));
  ResidentTeam team(pool, pool.define(testing::resident_definition("")));
  team.move_in(std::vector<ResidentStart>(kBoxes));
  team.go_on(kDemSteps, some_increments(kBoxes, 0));
  const PoolCounts before = pool.counts();
  team.go_on(kDemSteps, some_increments(kBoxes, 1));
  const std::int64_t sent = pool.counts().bytes_sent - before.bytes_sent;
  const std::int64_t received = pool.counts().bytes_received - before.bytes_received;
  std::cout << "[figure] bytes a box and step: " << static_cast<double>(sent) / kBoxes << " sent, "
            << static_cast<double>(received) / kBoxes << " received\n";
  EXPECT_LT(sent, static_cast<std::int64_t>(kBoxes * 168 + 2 * 100));
  EXPECT_LT(received, static_cast<std::int64_t>(kBoxes * 160 + 2 * 100));
  EXPECT_EQ(team.time_step(), testing::kTimeStep);
}

TEST_F(ResidentTest, TwoDefinitionsKeepTheirBoxesApart) {
  Pool pool(options(2));
  ResidentCells a(pool, pool.define(testing::resident_definition("")));
  ResidentCells b(pool, pool.define(testing::resident_definition("")));
  a.start(std::vector<ResidentStart>(kBoxes));
  Course course;
  b.start(std::vector<ResidentStart>(5));
  for (int step = 0; step < kSteps; ++step) {
    append(course, a.go_on(kDemSteps, some_increments(kBoxes, step)));
    b.go_on(3, some_increments(5, step + 1));
    if (step == 4 || step == 9) append(course, a.read_out());
  }
  EXPECT_EQ(course, expected_course(kBoxes));
}

TEST_F(ResidentTest, AWorkerKilledBetweenStepsCostsAReplay) {
  Pool pool(options(3));
  ResidentCells cells(pool, pool.define(testing::resident_definition("")));
  const Course course = course_of(cells, kBoxes, [](int step) {
    if (step == 3 || step == 8) kill(testing::children_of(getpid()).at(1), SIGKILL);
  });
  EXPECT_EQ(course, expected_course(kBoxes));
  EXPECT_EQ(pool.counts().workers_lost, 2);
  ASSERT_FALSE(told_.empty());
  EXPECT_NE(told_[0].find("killed by signal 9"), std::string::npos) << told_[0];
  EXPECT_NE((told_[0] + told_[1]).find("and 3 steps are repeated"), std::string::npos)
      << told_[0] << told_[1];
}

TEST_F(ResidentTest, AHungWorkerCostsAReplay) {
  PoolOptions impatient = options(2);
  impatient.patience.silence_seconds = 1.0;
  Pool pool(impatient);
  ResidentCells cells(pool, pool.define(testing::resident_definition("")));
  const Course course = course_of(cells, kBoxes, [](int step) {
    if (step == 6) kill(testing::children_of(getpid()).at(0), SIGSTOP);
  });
  EXPECT_EQ(course, expected_course(kBoxes));
  ASSERT_EQ(told_.size(), 1u);
  EXPECT_NE(told_[0].find("it hangs: no sign of life for 1 s"), std::string::npos) << told_[0];
  EXPECT_NE(told_[0].find("; all boxes go back to where they were read out last, and 1 step is repeated"),
            std::string::npos)
      << told_[0];
}

TEST_F(ResidentTest, AWorkerThatEndsInAStepCostsAReplay) {
  for (const int workers : {1, 2, 3}) {
    for (const int step : {1, 3, 6, 12}) {
      Pool pool(options(workers));
      const std::string script = ends_once("sleep 10 ends_in_step " + std::to_string(step));
      ResidentCells cells(pool, pool.define(testing::resident_definition(script)));
      EXPECT_EQ(course_of(cells, kBoxes), expected_course(kBoxes)) << workers << ' ' << step;
      EXPECT_EQ(pool.counts().workers_lost, 1);
      ASSERT_EQ(told_.size(), 1u);
      EXPECT_NE(told_[0].find("died at work on points"), std::string::npos) << told_[0];
      EXPECT_NE(told_[0].find("of material 'sand' (line.in)"), std::string::npos) << told_[0];
      const int since = step > 10 ? step - 11 : step > 5 ? step - 6 : step - 1;
      const std::string repeated =
          since == 1 ? "and 1 step is" : "and " + std::to_string(since) + " steps are";
      EXPECT_NE(told_[0].find(repeated + " repeated"), std::string::npos) << told_[0];
      told_.clear();
    }
  }
}

TEST_F(ResidentTest, AWorkerThatEndsInAReadOutCostsAReplay) {
  for (const int workers : {1, 2}) {
    for (const int box : {1, 20, 41}) {
      Pool pool(options(workers));
      const std::string script = ends_once("ends_in_read_out " + std::to_string(box));
      ResidentCells cells(pool, pool.define(testing::resident_definition(script)));
      EXPECT_EQ(course_of(cells, kBoxes), expected_course(kBoxes)) << workers << ' ' << box;
      EXPECT_EQ(pool.counts().workers_lost, 1);
    }
  }
}

TEST_F(ResidentTest, KillsAtAnyMomentChangeNothing) {
  Pool pool(options(2));
  ResidentCells cells(pool, pool.define(testing::resident_definition("sleep 5")));
  std::atomic<bool> done = false;
  int kills = 0;
  std::thread killer([&] {
    std::mt19937_64 generator(5);
    while (!done) {
      std::this_thread::sleep_for(std::chrono::milliseconds(200 + generator() % 400));
      const std::vector<pid_t> children = testing::children_of(getpid());
      if (done || children.empty() || kills == 20) continue;
      kill(children[generator() % children.size()], SIGKILL);
      ++kills;
    }
  });
  const Course expected = expected_course(kBoxes);
  for (int repeat = 0; repeat < 20; ++repeat) EXPECT_EQ(course_of(cells, kBoxes), expected) << repeat;
  done = true;
  killer.join();
  std::cout << "[figure] workers killed at any moment: " << kills << '\n';
}

/// A record that grows too long is begun anew, by the number of steps alone.
TEST_F(ResidentTest, ALongRecordIsBegunAnewForAnyNumberOfWorkers) {
  const auto course = [&](int workers, const std::string& script) {
    Pool pool(options(workers));
    ResidentCells cells(pool, pool.define(testing::resident_definition(script)),
                        3 * kBoxes * 3 * sizeof(double));
    return course_of(cells, kBoxes);
  };
  const Course one = course(1, "");
  EXPECT_EQ(course(2, ""), one);
  EXPECT_EQ(course(3, ends_once("ends_in_step 9")), one);
  EXPECT_FALSE(one == expected_course(kBoxes));
}

TEST_F(ResidentTest, ARefusalNamesThePointsAndTheMaterial) {
  Pool pool(options(2));
  ResidentCells cells(pool, pool.define(testing::resident_definition("refuses_beyond 0.1")));
  cells.start(std::vector<ResidentStart>(10));
  std::vector<CellIncrement> increments = some_increments(10, 0);
  increments[7].displacement_gradient(0, 0) = 0.2;
  const std::string message = message_of([&] { cells.go_on(kDemSteps, increments); });
  EXPECT_NE(message.find(" refuses points 5 to 9 of material 'sand' (line.in): the box has lost its volume"),
            std::string::npos)
      << message;
}

TEST_F(ResidentTest, AnAnswerThatIsNotFiniteIsRefused) {
  Pool pool(options(2));
  ResidentCells cells(pool, pool.define(testing::resident_definition("nan_beyond 0.1")));
  cells.start(std::vector<ResidentStart>(10));
  std::vector<CellIncrement> increments = some_increments(10, 0);
  increments[7].displacement_gradient(0, 0) = 0.2;
  const std::string message = message_of([&] { cells.go_on(kDemSteps, increments); });
  EXPECT_NE(message.find(" refuses point 7 of material 'sand' (line.in): the answer of the box holds numbers "
                         "that are not finite"),
            std::string::npos)
      << message;
}

TEST_F(ResidentTest, BoxesThatEndEveryWorkerEndTheRun) {
  Pool pool(options(2));
  ResidentCells cells(pool, pool.define(testing::resident_definition("exits_in_step 3")));
  const std::string message = message_of([&] { course_of(cells, kBoxes); });
  EXPECT_NE(message.find("exit status 3"), std::string::npos) << message;
  EXPECT_EQ(told_.size() >= 9u, true) << told_.size();
}

/// A pool whose team has lost a worker goes on with everything else.
TEST_F(ResidentTest, ALossEndsNothingElse) {
  Pool pool(options(2));
  const std::uint32_t sand = pool.define(testing::resident_definition(ends_once("ends_in_step 2")));
  ResidentTeam team(pool, sand);
  team.move_in(std::vector<ResidentStart>(kBoxes));
  team.go_on(kDemSteps, some_increments(kBoxes, 0));
  EXPECT_THROW(team.go_on(kDemSteps, some_increments(kBoxes, 1)), ResidentsLost);
  EXPECT_EQ(team.count(), 0u);
  EXPECT_EQ(pool.initial(sand).response.stress(0, 0), testing::kRestStress);
  team.move_in(std::vector<ResidentStart>(kBoxes));
  team.go_on(kDemSteps, some_increments(kBoxes, 0));
  EXPECT_EQ(team.count(), kBoxes);
}

/// Boxes move to a worker that joins, with the same bits.
TEST_F(ResidentTest, AGuestGetsItsShare) {
  make_keys(directory_ / "keys", "worker");
  PoolOptions open = options(1);
  open.listening = Listening{"tcp://127.0.0.1:*", read_coordinator_keys(directory_ / "keys")};
  Pool pool(open);
  ResidentCells cells(pool, pool.define(testing::resident_definition("sleep 5")));
  const Course expected = expected_course(kBoxes);
  EXPECT_EQ(course_of(cells, kBoxes), expected);
  EXPECT_EQ(pool.worker_records().size(), 1u);
  const Process guest({RESIDENT_WORKER, "--key", (directory_ / "keys" / "worker.key").string(), "--connect",
                       pool.listening_url()},
                      directory_ / "guest.log", Process::Network::shared);
  EXPECT_TRUE(testing::eventually([&] { return pool.worker_records().size() == 2; },
                                  [&] { EXPECT_EQ(course_of(cells, kBoxes), expected); }));
  EXPECT_EQ(course_of(cells, kBoxes), expected);
  EXPECT_TRUE(told_.empty());
}

#ifdef FAULTY_LINE
TEST_F(ResidentTest, LostDoubledDelayedAndCutMessagesChangeNothing) {
  PoolOptions bad = options(3);
  bad.worker_command = {FAULTY_LINE, "11", "4", RESIDENT_WORKER};
  bad.patience.silence_seconds = 4.0;
  Pool pool(bad);
  ResidentCells cells(pool, pool.define(testing::resident_definition("")));
  const Course expected = expected_course(kBoxes);
  for (int repeat = 0; repeat < 3; ++repeat) EXPECT_EQ(course_of(cells, kBoxes), expected);
  std::cout << "[figure] workers given up over lines that spoil 16 % of all messages: "
            << pool.counts().workers_lost << '\n';
}
#endif

TEST(ResidentRecord, KeepsTheBits) {
  std::vector<CellIncrement> increments = some_increments(4, 3);
  increments[2].curvature(1, 2) = -0.0;
  increments[3].curvature(0, 2) = 1e-300;
  ResidentRecord record;
  record.add(5, increments);
  record.add(6, std::vector<CellIncrement>(4));
  ASSERT_EQ(record.count(), 2u);
  EXPECT_EQ(record.dem_steps(1), 6);
  const std::vector<CellIncrement> back = record.increments(0);
  for (std::size_t box = 0; box < 4; ++box)
    EXPECT_EQ(std::memcmp(&back[box], &increments[box], sizeof(CellIncrement)), 0);
  EXPECT_LT(record.bytes(), 4 * 5 * sizeof(double) + 2 * 100);
  EXPECT_EQ(record.increments(1)[3].displacement_gradient(0, 0), 0.0);
  record.clear();
  EXPECT_EQ(record.bytes(), 0u);
}

}  // namespace
}  // namespace polargrain::coupler
