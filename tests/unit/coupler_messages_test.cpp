// SPDX-License-Identifier: GPL-2.0-or-later
#include <gtest/gtest.h>

#include <bit>
#include <cmath>
#include <cstring>
#include <limits>
#include <random>

#include "common/record_table.hpp"
#include "coupler/protocol/messages.hpp"

namespace polargrain::coupler {
namespace {

std::span<const std::byte> view(const std::string& bytes) {
  return std::as_bytes(std::span(bytes));
}

template <class T>
T round_trip(const T& message) {
  const std::string bytes = encode(message);
  return std::get<T>(decode(view(bytes)).message);
}

StatePointer some_state(std::size_t size) {
  std::vector<std::byte> bytes(size);
  for (std::size_t i = 0; i < size; ++i) bytes[i] = static_cast<std::byte>(i * 7);
  return std::make_shared<const State>(std::move(bytes));
}

/// Any finite double, of all magnitudes and both signs of zero.
double any_finite(std::mt19937_64& generator) {
  for (;;) {
    const auto value = std::bit_cast<double>(generator());
    if (std::isfinite(value)) return value;
  }
}

CellDefinition some_definition() {
  CellDefinition cell{"sand", "cell.in", "pair_style gran\n", {}, {}};
  cell.packing.box << 0.2, 0.01, 0.0, 0.19;
  cell.packing.thickness = 0.1;
  cell.packing.grains = {{0, {0.1, 0.1}, 0.007, 0.04, 1e-6}, {-5, {0.0, 0.15}, 0.006, 0.03, 9e-7}};
  cell.control.damping = 0.1;
  cell.control.least_steps = 33;
  cell.control.rotations = CellRotations::controlled;
  return cell;
}

EvaluateRequest request_with(const ContentName& base, const StatePointer& state) {
  return {1, 0, 0, false, {}, {{false, base, state, {}}}};
}

std::string error_of(const std::string& bytes);

Reply some_reply(KnownComponents known = KnownComponents::all) {
  CellReply cell;
  cell.response.known = known;
  cell.response.stress.setConstant(-1e5);
  cell.response.tangent.setIdentity();
  cell.state = some_state(100);
  return {12, {cell, cell}};
}

TEST(Messages, DoublesKeepTheirBits) {
  std::mt19937_64 generator(1);
  for (int repeat = 0; repeat < 2000; ++repeat) {
    Reply reply = some_reply();
    CellResponse& sent = reply.cells[1].response;
    for (double& value : sent.stress.reshaped()) value = any_finite(generator);
    for (double& value : sent.couple_stress.reshaped()) value = any_finite(generator);
    for (double& value : sent.tangent.reshaped()) value = any_finite(generator);
    sent.stress(0, 0) = -0.0;
    sent.stress(0, 1) = std::numeric_limits<double>::denorm_min();
    sent.stress(0, 2) = -3.0;
    const CellResponse back = round_trip(reply).cells[1].response;
    ASSERT_EQ(std::memcmp(back.stress.data(), sent.stress.data(), sizeof sent.stress), 0);
    ASSERT_EQ(std::memcmp(back.couple_stress.data(), sent.couple_stress.data(), sizeof sent.couple_stress),
              0);
    ASSERT_EQ(std::memcmp(back.tangent.data(), sent.tangent.data(), sizeof sent.tangent), 0);
  }
}

/// Components that discs cannot tell are not sent, and come back as zero.
TEST(Messages, OnlyKnownComponentsTravel) {
  const auto filled = [](KnownComponents known) {
    Reply reply = some_reply(known);
    reply.cells[0].response.tangent.setConstant(3.0);
    reply.cells[0].response.couple_stress.setConstant(2.0);
    reply.cells.resize(1);
    return reply;
  };
  const CellResponse plane = round_trip(filled(KnownComponents::plane)).cells[0].response;
  EXPECT_EQ(plane.known, KnownComponents::plane);
  Eigen::Matrix3d stress;
  stress << -1e5, -1e5, 0.0, -1e5, -1e5, 0.0, 0.0, 0.0, 0.0;
  EXPECT_EQ(plane.stress, stress);
  EXPECT_EQ(plane.couple_stress(0, 2), 2.0);
  EXPECT_EQ(plane.couple_stress(1, 2), 2.0);
  EXPECT_EQ(plane.couple_stress.sum(), 4.0);
  EXPECT_EQ(plane.tangent(14, 3), 3.0);
  EXPECT_EQ(plane.tangent.sum(), 36.0 * 3.0);
  const std::size_t few = encode(filled(KnownComponents::plane)).size();
  const std::size_t many = encode(filled(KnownComponents::all)).size();
  std::cout << "[figure] bytes of an answer, its state apart: " << few - 100 << " of discs, " << many - 100
            << " of grains in space\n";
  EXPECT_EQ(many - few, sizeof(double) * (18 + 18 * 18 - 6 - 6 * 6));
}

/// Every field of the description, whatever fields it has.
TEST(Messages, DiagnosticsKeepTheirPlaces) {
  Reply reply = some_reply();
  double next = 1.0;
  describe(reply.cells[1].diagnostics, [&next](const FieldNotes&, auto& member) {
    if constexpr (std::is_arithmetic_v<std::remove_reference_t<decltype(member)>>) {
      member = static_cast<std::remove_reference_t<decltype(member)>>(next++);
    } else {
      for (double& value : member) value = next++;
    }
  });
  const CellDiagnostics back = round_trip(reply).cells.at(1).diagnostics;
  EXPECT_EQ(values_of(back), values_of(reply.cells[1].diagnostics));
  EXPECT_EQ(back.engine_seconds, reply.cells[1].diagnostics.engine_seconds);
  EXPECT_GT(next, 16.0);
}

/// Once lost on the way: the noise of a stress, the heights of grains and the dimension of a packing.
TEST(Messages, NothingOfAnAnswerOrAPackingIsLost) {
  Reply reply = some_reply();
  reply.cells[0].response.noise = {1.0, 2.0, 3.0};
  EXPECT_EQ(round_trip(reply).cells[0].response.noise.couple, 3.0);
  Define define{3, some_definition()};
  define.cell.packing.dimension = 3;
  define.cell.packing.grains[1].height = 0.25;
  define.cell.packing.pressure = 7e4;
  const Packing packing = round_trip(define).cell.packing;
  EXPECT_EQ(packing.dimension, 3);
  EXPECT_EQ(packing.grains[1].height, 0.25);
  EXPECT_EQ(packing.pressure, 7e4);
}

/// A number of the diagnostics that is not finite would come out in the tables of a run.
TEST(Messages, DiagnosticsMustBeFinite) {
  Reply reply = some_reply();
  reply.cells[0].diagnostics.fabric[1] = std::numeric_limits<double>::quiet_NaN();
  EXPECT_NE(error_of(encode(reply)).find("diagnostics"), std::string::npos);
}

TEST(Messages, AnIncrementKeepsItsComponents) {
  EvaluateRequest request{7, 3, 6, true, {some_state(11)->name(), some_state(12)->name()}, {}};
  request.cells = {{true, {}, nullptr, {}}, {false, some_state(10)->name(), nullptr, {}}};
  CellIncrement& increment = request.cells[1].increment;
  increment.displacement_gradient << 1.0, 2.0, 3.0, 4.0, 5.0, 6.0, 7.0, 8.0, 9.0;
  increment.rotation << 10.0, 11.0, 12.0;
  increment.curvature << 13.0, 14.0, 15.0, 16.0, 17.0, 18.0, 19.0, 20.0, 21.0;
  const EvaluateRequest back = round_trip(request);
  ASSERT_EQ(back.cells.size(), 2u);
  EXPECT_EQ(back.cells[1].increment.displacement_gradient, increment.displacement_gradient);
  EXPECT_EQ(back.cells[1].increment.rotation, increment.rotation);
  EXPECT_EQ(back.cells[1].increment.curvature, increment.curvature);
  EXPECT_EQ(back.request, 7u);
  EXPECT_EQ(back.definition, 3u);
  EXPECT_EQ(back.settled, 6u);
  EXPECT_TRUE(back.bring);
  EXPECT_EQ(back.released, request.released);
  EXPECT_TRUE(back.cells[0].from_packing);
  EXPECT_EQ(back.cells[1].base, request.cells[1].base);
  EXPECT_EQ(back.cells[1].state, nullptr);
}

TEST(Messages, AStateTravelsWhole) {
  const StatePointer state = some_state(160000);
  const EvaluateRequest back = round_trip(request_with(state->name(), state));
  ASSERT_NE(back.cells[0].state, nullptr);
  EXPECT_EQ(back.cells[0].state->name(), state->name());
  EXPECT_EQ(back.cells[0].state->bytes().size(), 160000u);
  const States states = round_trip(States{3, {nullptr, state}});
  ASSERT_EQ(states.states.size(), 2u);
  EXPECT_EQ(states.states[0], nullptr);
  EXPECT_EQ(states.states[1]->name(), state->name());
}

TEST(Messages, AReplyMayNameItsState) {
  const StatePointer state = some_state(160000);
  Reply reply = some_reply(KnownComponents::plane);
  reply.cells[1].state = std::make_shared<const State>(state->name(), state->size());
  EXPECT_LT(encode(reply).size(), 1700u);
  const StatePointer back = round_trip(reply).cells[1].state;
  EXPECT_FALSE(back->is_here());
  EXPECT_EQ(back->name(), state->name());
  EXPECT_EQ(back->size(), 160000u);
  reply.cells[1].state = std::make_shared<const State>(state->name(), kLongestMessage + 1);
  EXPECT_EQ(error_of(encode(reply)), "a state is larger than any message");
  // Only a reply may: what is fetched or sent to start from is there.
  EXPECT_EQ(error_of(encode(States{3, {back}})), "member 1 of a list of states is not a block of bytes");
  EXPECT_EQ(error_of(encode(request_with(state->name(), back))),
            "member 4 of a cell to evaluate is not a block of bytes");
}

TEST(Messages, ADefinitionTravelsWhole) {
  const CellDefinition cell = some_definition();
  const CellDefinition back = round_trip(Define{4, cell}).cell;
  EXPECT_EQ(back.name, cell.name);
  EXPECT_EQ(back.script_file, cell.script_file);
  EXPECT_EQ(back.script, cell.script);
  EXPECT_EQ(back.packing.box, cell.packing.box);
  EXPECT_EQ(back.packing.thickness, cell.packing.thickness);
  ASSERT_EQ(back.packing.grains.size(), 2u);
  EXPECT_EQ(back.packing.grains[1].id, -5);
  EXPECT_EQ(back.packing.grains[1].position, cell.packing.grains[1].position);
  EXPECT_EQ(back.packing.grains[1].moment_of_inertia, 9e-7);
  EXPECT_EQ(back.control.damping, 0.1);
  EXPECT_EQ(back.control.least_steps, 33);
  EXPECT_EQ(back.control.tangent, CellTangent::condensed);
  EXPECT_EQ(back.control.rotations, CellRotations::controlled);
}

TEST(Messages, TheSmallOnesTravelToo) {
  EXPECT_EQ(round_trip(Hello{kProtocolVersion, 4711}).process, 4711);
  EXPECT_EQ(round_trip(Hello{kProtocolVersion, 1, "node7", "a\x1b kind", "x"}).processor, "a? kind");
  EXPECT_EQ(round_trip(Hello{kProtocolVersion, 1, "node7", "", "no filter"}).unconfined, "no filter");
  EXPECT_EQ(round_trip(InitialRequest{9, 2}).definition, 2u);
  EXPECT_EQ(round_trip(Missing{9, true, {}}).definition, true);
  EXPECT_EQ(round_trip(Missing{9, false, {some_state(3)->name()}}).bases.at(0), some_state(3)->name());
  EXPECT_EQ(round_trip(Refusal{9, 4, "no"}).message, "no");
  EXPECT_EQ(round_trip(Refusal{9, 4, "no"}).place, 4u);
  EXPECT_EQ(round_trip(FetchRequest{9, {some_state(3)->name()}}).names.at(0), some_state(3)->name());
  round_trip(Stop{});
}

TEST(Messages, TheSessionTravels) {
  EXPECT_EQ(decode(view(encode(Working{3}, 77))).session, 77u);
}

TEST(Messages, OfAnotherVersionsHelloOnlyTheVersionIsRead) {
  // Version 2 said [0, version, process]; whatever follows the version may change.
  const Envelope old = decode(view(std::string("\x93\x00\x02\xcd\x12\x67", 6)));
  EXPECT_EQ(std::get<Hello>(old.message).version, 2u);
  EXPECT_EQ(error_of(encode(Hello{kProtocolVersion, 1, "a b"})),
            "the name of a host has characters that no host name has");
}

std::string error_of(const std::string& bytes) {
  try {
    decode(view(bytes));
  } catch (const ProtocolError& error) {
    return error.what();
  }
  return "accepted";
}

TEST(Messages, RefusesWhatIsNotFinite) {
  EvaluateRequest request = request_with({}, nullptr);
  request.cells[0].increment.rotation(1) = std::numeric_limits<double>::quiet_NaN();
  EXPECT_EQ(error_of(encode(request)), "an increment holds a number that is not finite");
  Reply reply = some_reply();
  reply.cells[1].response.stress(1, 0) = std::numeric_limits<double>::infinity();
  EXPECT_EQ(error_of(encode(reply)), "a stress holds a number that is not finite");
  reply.cells[1].response.quality = Quality::failed;
  EXPECT_EQ(error_of(encode(reply)), "accepted");
}

/// Whether the sender of these bytes is at fault, and not the line.
bool is_false(const std::string& bytes) {
  try {
    decode(view(bytes));
  } catch (const FalseMessage&) {
    return true;
  } catch (const ProtocolError&) {
  }
  return false;
}

TEST(Messages, BlameTheSenderForNumbersThatNoCellHas) {
  const auto with = [](const auto& change) {
    Reply reply = some_reply();
    change(reply.cells[1].diagnostics);
    return encode(reply);
  };
  EXPECT_FALSE(is_false(with([](CellDiagnostics&) {})));
  EXPECT_FALSE(is_false("\x93garbage"));
  EXPECT_TRUE(is_false(with([](CellDiagnostics& d) { d.void_ratio = std::nan(""); })));
  EXPECT_TRUE(is_false(with([](CellDiagnostics& d) { d.fabric[2] = INFINITY; })));
  EXPECT_TRUE(is_false(with([](CellDiagnostics& d) { d.engine_seconds = INFINITY; })));
  EXPECT_TRUE(is_false(with([](CellDiagnostics& d) { d.engine_seconds = -1.0; })));
  EXPECT_TRUE(is_false(with([](CellDiagnostics& d) { d.dem_steps = INT64_MAX; })));
  EXPECT_TRUE(is_false(with([](CellDiagnostics& d) { d.contacts = -1; })));
  Reply reply = some_reply();
  reply.cells[1].response.tangent(2, 2) = std::nan("");
  EXPECT_TRUE(is_false(encode(reply)));
  for (const double factor : {0.0, -1.0, 1.5, std::nan("")}) {
    reply = some_reply();
    reply.cells[1].response.step_factor = factor;
    EXPECT_TRUE(is_false(encode(reply))) << factor;
  }
}

TEST(Messages, WordsForTheUserArePlainAndShort) {
  const std::string words = "\x1b[2J" + std::string(5'000'000, 'a');
  const auto cleaned = [](const std::string& text) {
    EXPECT_EQ(text.substr(0, 6), "?[2Jaa");
    EXPECT_EQ(text.size(), 1000u);
  };
  cleaned(round_trip(Refusal{1, 0, words}).message);
  cleaned(round_trip(Stop{words}).reason);
  Reply reply = some_reply();
  reply.cells[1].response.message = words;
  cleaned(round_trip(reply).cells[1].response.message);
}

TEST(Messages, RefusesAStateThatIsNotWhatItsNameSays) {
  EXPECT_EQ(error_of(encode(request_with(some_state(9)->name(), some_state(10)))),
            "the bytes of a state do not have its name");
}

ResidentMotion some_motion() {
  ResidentMotion motion;
  motion.gradient << 1.0, 2.0, 3.0, 4.0, 5.0, 6.0, 7.0, 8.0, -0.0;
  motion.spin << 10.0, 11.0, 12.0;
  return motion;
}

MoveIn some_move_in() {
  return {21, 3, 20, 16, {{nullptr, {}}, {some_state(33), some_motion()}}};
}

GoOn some_go_on(std::size_t boxes) {
  GoOn m{22, 3, 21, 40, std::vector<CellIncrement>(boxes)};
  CellIncrement& last = m.increments.back();
  last.displacement_gradient << 1.0, 2.0, 3.0, 4.0, 5.0, 6.0, 7.0, 8.0, 9.0;
  last.rotation << 10.0, 11.0, 12.0;
  last.curvature << 13.0, 14.0, 15.0, 16.0, 17.0, 18.0, 19.0, 20.0, 21.0;
  return m;
}

ResidentReply some_answers(std::size_t boxes) {
  ResidentReply m{23, 0.5, 2e-6, std::vector<ResidentAnswer>(boxes), {}};
  ResidentAnswer& last = m.answers.back();
  last.stress << -1.0, 2.0, 3.0, 4.0, 5.0, 6.0, 7.0, 8.0, 9.0;
  last.couple_stress << 10.0, 11.0, 12.0, 13.0, 14.0, 15.0, 16.0, 17.0, 18.0;
  last.unbalanced_force_ratio = 19.0;
  last.coordination_number = 20.0;
  return m;
}

ResidentReply some_read_outs() {
  const CellReply reply = some_reply().cells[0];
  return {24, 0.25, 0.0, {}, {{reply, {}}, {reply, some_motion()}}};
}

TEST(Messages, ResidentBoxesMoveIn) {
  const MoveIn back = round_trip(some_move_in());
  EXPECT_EQ(back.request, 21u);
  EXPECT_EQ(back.definition, 3u);
  EXPECT_EQ(back.settled, 20u);
  EXPECT_EQ(back.first, 16u);
  ASSERT_EQ(back.starts.size(), 2u);
  EXPECT_EQ(back.starts[0].state, nullptr);
  EXPECT_EQ(back.starts[1].state->name(), some_state(33)->name());
  EXPECT_EQ(back.starts[1].motion.gradient, some_motion().gradient);
  EXPECT_TRUE(std::signbit(back.starts[1].motion.gradient(2, 2)));
  EXPECT_EQ(back.starts[1].motion.spin, some_motion().spin);
}

/// More boxes than a message has members, and few bytes for each.
TEST(Messages, ResidentBoxesGoOn) {
  const GoOn sent = some_go_on(1000);
  EXPECT_LT(encode(sent).size(), 1000 * 168 + 100u);
  const GoOn back = round_trip(sent);
  EXPECT_EQ(back.request, 22u);
  EXPECT_EQ(back.settled, 21u);
  EXPECT_EQ(back.dem_steps, 40);
  ASSERT_EQ(back.increments.size(), 1000u);
  EXPECT_EQ(back.increments[999].displacement_gradient, sent.increments[999].displacement_gradient);
  EXPECT_EQ(back.increments[999].rotation, sent.increments[999].rotation);
  EXPECT_EQ(back.increments[999].curvature, sent.increments[999].curvature);
  const ResidentReply answers = round_trip(some_answers(1000));
  EXPECT_LT(encode(answers).size(), 1000 * 160 + 100u);
  EXPECT_EQ(answers.request, 23u);
  EXPECT_EQ(answers.seconds, 0.5);
  EXPECT_EQ(answers.time_step, 2e-6);
  ASSERT_EQ(answers.answers.size(), 1000u);
  EXPECT_EQ(answers.answers[999].stress, some_answers(1).answers[0].stress);
  EXPECT_EQ(answers.answers[999].couple_stress, some_answers(1).answers[0].couple_stress);
  EXPECT_EQ(answers.answers[999].unbalanced_force_ratio, 19.0);
  EXPECT_EQ(answers.answers[999].coordination_number, 20.0);
}

TEST(Messages, ResidentBoxesAreReadOut) {
  const ReadOut back = round_trip(ReadOut{24, 3, 23, 32, 16});
  EXPECT_EQ(back.definition, 3u);
  EXPECT_EQ(back.settled, 23u);
  EXPECT_EQ(back.first, 32u);
  EXPECT_EQ(back.count, 16u);
  const ResidentReply reply = round_trip(some_read_outs());
  ASSERT_EQ(reply.read_outs.size(), 2u);
  EXPECT_EQ(reply.read_outs[1].motion.gradient, some_motion().gradient);
  EXPECT_EQ(reply.read_outs[1].reply.state->name(), some_state(100)->name());
  EXPECT_TRUE(reply.answers.empty());
}

TEST(Messages, RefusesWhatResidentBoxesCannotSay) {
  const double none = std::numeric_limits<double>::quiet_NaN();
  MoveIn move_in = some_move_in();
  move_in.starts[1].motion.spin(1) = none;
  EXPECT_EQ(error_of(encode(move_in)), "the motion of a box holds a number that is not finite");
  GoOn go_on = some_go_on(3);
  go_on.increments[1].rotation(0) = none;
  EXPECT_EQ(error_of(encode(go_on)), "a list of increments holds a number that is not finite");
  go_on = some_go_on(3);
  go_on.dem_steps = 0;
  EXPECT_EQ(error_of(encode(go_on)), "a count of DEM steps is out of range");
  go_on.dem_steps = -1;
  EXPECT_EQ(error_of(encode(go_on)), "a count of DEM steps is out of range");
  EXPECT_EQ(error_of(encode(ReadOut{1, 0, 0, 0, 0})), "a count of boxes to read out is out of range");
  EXPECT_EQ(error_of(encode(ReadOut{1, 0, 0, 0, 17})), "a count of boxes to read out is out of range");
  ResidentReply answers = some_answers(2);
  answers.answers[0].couple_stress(1, 1) = none;
  EXPECT_EQ(error_of(encode(answers)), "a list of answers of boxes holds a number that is not finite");
  answers = some_answers(2);
  answers.answers[0].coordination_number = -1.0;
  EXPECT_EQ(error_of(encode(answers)), "the answer of a box holds an impossible number");
  answers = some_answers(2);
  answers.seconds = -1.0;
  EXPECT_EQ(error_of(encode(answers)), "a reply took an impossible time");
  ResidentReply boxes = some_read_outs();
  boxes.read_outs[0].reply.state = nullptr;
  EXPECT_EQ(error_of(encode(boxes)), "a reply that did not fail has no state");
  boxes.read_outs[0].reply.response.quality = Quality::failed;
  EXPECT_EQ(error_of(encode(boxes)), "the read-out of a box has no state");
  boxes = some_read_outs();
  boxes.read_outs[0].reply.state = std::make_shared<const State>(some_state(9)->name(), 9);
  EXPECT_EQ(error_of(encode(boxes)), "the read-out of a box has no state");
  boxes = some_read_outs();
  boxes.read_outs[1].motion.gradient(0, 0) = none;
  EXPECT_EQ(error_of(encode(boxes)), "the motion of a box holds a number that is not finite");
}

TEST(Messages, RefusesABrokenPacking) {
  Define define{0, some_definition()};
  define.cell.packing.grains[1].id = 0;
  EXPECT_EQ(error_of(encode(define)), "two grains of a packing have one id");
  define.cell.packing.grains.clear();
  EXPECT_EQ(error_of(encode(define)), "a packing has no grains");
  define = {0, some_definition()};
  define.cell.packing.grains[0].radius = 0.0;
  EXPECT_EQ(error_of(encode(define)), "a grain has no size or no mass");
  define = {0, some_definition()};
  define.cell.packing.box.setZero();
  EXPECT_EQ(error_of(encode(define)), "a packing has no volume");
}

TEST(Messages, RefusesWrongShapes) {
  EXPECT_EQ(error_of("\x05"), "a message is not an array");
  EXPECT_EQ(error_of("\x91\x63"), "no such kind of message");
  EXPECT_EQ(error_of(encode(Stop{}) + "x"), "bytes follow the end of a message");
  EXPECT_EQ(error_of(std::string("\x94\x08\x01\x00\x00", 5)), "a message has 4 members, 3 expected");
  EXPECT_EQ(error_of(std::string("\x92\x08\x01", 3)), "a message ends after 2 members");
  std::vector<CellToEvaluate> many(kMostInRequest + 1);
  EXPECT_NE(error_of(encode(EvaluateRequest{1, 0, 0, false, {}, many})).find("not a message"),
            std::string::npos);
  // An array that claims 2^32-1 members: refused for its claim, without reserving memory.
  EXPECT_NE(error_of("\xdd\xff\xff\xff\xff").find("not a message"), std::string::npos);
}

TEST(Messages, SurvivesEveryCutAndManyFlippedBits) {
  Reply reply = some_reply();
  const std::vector<std::string> originals{encode(reply),
                                           encode(Define{1, some_definition()}),
                                           encode(request_with(some_state(10)->name(), some_state(10))),
                                           encode(States{2, {some_state(20), nullptr}}),
                                           encode(FetchRequest{2, {some_state(20)->name()}}),
                                           encode(some_move_in()),
                                           encode(some_go_on(3)),
                                           encode(ReadOut{24, 3, 23, 32, 16}),
                                           encode(some_answers(3)),
                                           encode(some_read_outs())};
  std::mt19937_64 generator(2);
  int refused = 0;
  for (const std::string& original : originals) {
    for (std::size_t length = 0; length < original.size(); ++length) {
      EXPECT_NE(error_of(original.substr(0, length)), "accepted") << length;
    }
    for (int repeat = 0; repeat < 20000; ++repeat) {
      std::string broken = original;
      broken[generator() % broken.size()] ^= static_cast<char>(1 << (generator() % 8));
      refused += error_of(broken) != "accepted";
    }
  }
  std::cout << "[figure] messages with one flipped bit refused: " << refused << " of "
            << 20000 * originals.size() << '\n';
  EXPECT_GT(refused, 0);
}

}  // namespace
}  // namespace polargrain::coupler
