// SPDX-License-Identifier: GPL-2.0-or-later
#include "tests/integration/fake_engine.hpp"

#include <sys/stat.h>
#include <unistd.h>

#include <array>
#include <cmath>
#include <cstdio>
#include <cstdlib>
#include <cstring>
#include <map>
#include <sstream>
#include <thread>

#include "common/error.hpp"
#include "common/plane_in_space.hpp"
#include "grains_io/script.hpp"
#include "tests/integration/tries.hpp"

namespace polargrain::testing {
namespace {

constexpr double kRadiusOfSettled = 0.41;  // m, of the first grain of a packing that was settled
constexpr double kConfining = -100e3;
constexpr double kYoung = 100e6;
constexpr double kPoisson = 0.25;
constexpr double kCosseratShear = 10e6;  // Pa, of the packing's network
constexpr double kCoupleModulus = 32e3;  // N: an internal length of 20 mm

Matrix7 stiffness(double young) {
  const double shear = young / (2.0 * (1.0 + kPoisson));
  const double lame = 2.0 * shear * kPoisson / (1.0 - 2.0 * kPoisson);
  Matrix7 d = Matrix7::Zero();
  d.topLeftCorner<3, 3>().setConstant(lame);
  for (int i = 0; i < 3; ++i) d(i, i) += 2.0 * shear;
  for (int i : {k12, k21}) d(i, k12) = d(i, k21) = shear;
  return d;
}

[[noreturn]] void die_like_the_engine(const char* message) {
  std::printf("Some output of the engine\nERROR: %s\n", message);
  std::fflush(stdout);
  std::_Exit(1);
}

/// FAKE_ENGINE_FORGES=1: it does; a path: the first process that is asked to
/// evaluate, and so makes this directory, does, and no other.
bool this_process_forges() {
  const char* const who = std::getenv("FAKE_ENGINE_FORGES");
  if (who == nullptr) return false;
  static const bool is_first = *who != '/' || mkdir(who, 0700) == 0;
  return is_first;
}

class FakeEngine : public CellService {
 public:
  explicit FakeEngine(const CellDefinition& definition) {
    std::map<std::string, std::string> variables;
    for (const ScriptCommand& line : commands_of_script(definition.script, definition.script_file)) {
      std::string text = line.text;
      for (const auto& [name, value] : variables)
        if (const std::size_t place = text.find("${" + name + "}"); place != std::string::npos)
          text.replace(place, name.size() + 3, value);
      std::istringstream words(text);
      if (text.starts_with("variable ")) {
        std::string name;
        std::string style;
        words >> style >> name >> style;
        words >> variables[name];
        continue;
      }
      for (std::string command; words >> command;) {
        if (!fake_commands().contains(command)) {
          die_like_the_engine(("Unknown command: " + command + " (../input.cpp:209)").c_str());
        }
        words >> settings_[command];
      }
    }
    if (settings_.count("tries") != 0) try_what_no_engine_should();
    double young = settings_.count("young") != 0 ? settings_["young"] : kYoung;
    if (settings_.count("young_of_mass") != 0)
      young = settings_["young_of_mass"] * definition.packing.grains.front().mass;
    stiffness_ = stiffness(young);
    const bool is_settled = definition.packing.grains.front().radius == kRadiusOfSettled;
    if ((beyond("settle_beyond", young) && !is_settled) || beyond("restless_beyond", young))
      die_like_the_engine("the packing is not at rest");
    if (definition.control.tangent == CellTangent::cosserat) {
      for (int i : {k12, k21}) stiffness_(i, i) += kCosseratShear;
      stiffness_(k12, k21) = stiffness_(k21, k12) -= kCosseratShear;
      stiffness_(kCurvature1, kCurvature1) = stiffness_(kCurvature2, kCurvature2) = kCoupleModulus;
    }
  }

  CellReply initial() override {
    return reply({kConfining, kConfining, kConfining, 0.0, 0.0}, stiffness_, 0.0);
  }

  CellReply evaluate(const CellRequest& request) override {
    if (settings_.count("sleep_milliseconds") != 0) sleep(static_cast<int>(settings_["sleep_milliseconds"]));
    const double largest = request.increment.displacement_gradient.cwiseAbs().maxCoeff();
    if (beyond("die_beyond", largest))
      die_like_the_engine("Lost atoms: original 400 current 399 (../thermo.cpp:396)");
    if (beyond("hang_beyond", largest)) {
      for (;;) pause();
    }
    if (beyond("refuse_beyond", largest)) throw RunError("the increment is not to my liking");
    std::array<double, 6> start{kConfining, kConfining, kConfining, 0.0, 0.0, 0.0};
    if (request.state) {
      if (request.state->bytes().size() != state_bytes()) throw RunError("a state of something else");
      std::memcpy(start.data(), request.state->bytes().data(), sizeof start);
    }
    if (beyond("fail_beyond", largest)) {
      CellReply failed;
      failed.response.quality = Quality::failed;
      failed.response.message = "the box collapsed";
      failed.response.step_factor = 0.5;
      return failed;
    }
    std::array<double, 5> stress{};
    std::copy_n(start.begin(), stress.size(), stress.begin());
    // Small substeps, so that a long increment ends where the same way in short ones does.
    const Vector7 strain = in_plane(request.increment).strain();
    const int substeps =
        settings_.count("softening") == 0 ? 1 : static_cast<int>(std::ceil(strain.norm() / 1e-5));
    for (int substep = 0; substep < substeps; ++substep) {
      const Vector7 change = softened(stress[k11] - stress[k22]) * strain / substeps;
      for (int i = 0; i < 5; ++i) stress[i] += change[i];
    }
    // Another engine than the one of the run, for tests of `verify`: the last digits of its answers differ.
    if (this_process_forges()) stress[k11] *= 1.0 + 1e-15;
    return reply(stress, softened(stress[k11] - stress[k22]), start[5] + 1.0);
  }

 private:
  /// As an engine at work: it shows now and then that it lives.
  void sleep(int milliseconds) const {
    for (; milliseconds > 0; milliseconds -= 10) {
      std::this_thread::sleep_for(std::chrono::milliseconds(std::min(milliseconds, 10)));
      if (progress) progress();
    }
  }

  [[nodiscard]] std::size_t state_bytes() const {
    const auto bytes = settings_.find("state_bytes");
    return bytes == settings_.end() ? 6 * sizeof(double) : static_cast<std::size_t>(bytes->second);
  }

  [[nodiscard]] bool beyond(const std::string& setting, double value) const {
    const auto limit = settings_.find(setting);
    return limit != settings_.end() && value > limit->second;
  }

  /// The stiffness from a state on: it falls with the stress difference and is constant over an increment.
  [[nodiscard]] Matrix7 softened(double stress_difference) const {
    const auto share = settings_.find("softening");
    if (share == settings_.end()) return stiffness_;
    return stiffness_ / (1.0 + share->second * std::abs(stress_difference / kConfining));
  }

  [[nodiscard]] CellReply reply(const std::array<double, 5>& stress, const Matrix7& tangent,
                                double evaluations) const {
    std::array<double, 6> values{};
    std::copy(stress.begin(), stress.end(), values.begin());
    values[5] = evaluations;
    Response<2> response;
    for (int i = 0; i < 5; ++i) response.stress[i] = stress[i];
    response.tangent = tangent;
    CellReply reply;
    reply.response = in_space(response, KnownComponents::all);
    reply.diagnostics.void_ratio = 0.2;
    reply.diagnostics.coordination_number = 4.0 + evaluations;
    reply.diagnostics.dem_steps = 10;
    reply.diagnostics.engine_seconds = 1e-6;
    const auto bytes = std::as_bytes(std::span(values));
    std::vector<std::byte> content(bytes.begin(), bytes.end());
    content.resize(state_bytes());
    reply.state = std::make_shared<const State>(std::move(content));
    return reply;
  }

  std::map<std::string, double> settings_;
  Matrix7 stiffness_;
};

}  // namespace

const std::set<std::string>& fake_commands() {
  static const std::set<std::string> commands{
      "young",         "softening",   "fail_beyond",        "die_beyond",    "refuse_beyond",   "hang_beyond",
      "young_of_mass", "state_bytes", "sleep_milliseconds", "settle_beyond", "restless_beyond", "tries"};
  return commands;
}

std::unique_ptr<CellService> make_fake_engine(const CellDefinition& definition) {
  return std::make_unique<FakeEngine>(definition);
}

std::string fake_state_fault(const CellDefinition& definition, const State& state) {
  std::istringstream script(definition.script);
  std::size_t expected = 6 * sizeof(double);
  for (std::string word; script >> word;)
    if (word == "state_bytes") script >> expected;
  if (state.size() != expected)
    return "a state has " + std::to_string(state.size()) + " bytes instead of " + std::to_string(expected);
  if (!state.is_here()) return {};
  std::array<double, 6> values{};
  std::memcpy(values.data(), state.bytes().data(), sizeof values);
  for (const double value : values)
    if (!std::isfinite(value)) return "a state holds a number that is not finite";
  return {};
}

Eigen::Matrix3d fake_stress(const CellIncrement& increment) {
  Response<2> response;
  response.stress = fake_stress(in_plane(increment));
  return in_space(response, KnownComponents::all).stress;
}

Vector7 fake_stress(const Increment<2>& increment) {
  Vector7 stress = stiffness(kYoung) * increment.strain();
  for (int i : {k11, k22, k33}) stress[i] += kConfining;
  return stress;
}

Packing fake_packing() {
  Packing packing;
  packing.box << 1.0, 0.0, 0.0, 1.0;
  packing.thickness = 0.1;
  packing.grains = {{7, {0.5, 0.5}, 0.4, 1.0, 0.08}};
  return packing;
}

namespace {
double fake_void_ratio(double friction) {
  return 0.5 + 0.4 * friction;
}
}  // namespace

PreparedPacking make_fake_packing(const PackingSpecification& specification) {
  PreparedPacking made;
  const int rows = static_cast<int>(std::ceil(std::sqrt(specification.grains)));
  made.packing.box << rows, 0.0, 0.0, rows;
  made.packing.thickness = specification.thickness;
  const double mass =
      1.0 + 0.01 * (static_cast<double>(specification.seed) - 2.0) + 1.0 / specification.grains;
  for (int k = 0; k < specification.grains; ++k)
    made.packing.grains.push_back({k + 1, {k % rows + 0.5, k / rows + 0.5}, 0.4, mass, 0.08 * mass});
  made.specification = specification.text;
  made.reached.void_ratio = fake_void_ratio(specification.friction);
  return made;
}

PreparedPacking settle_fake_packing(const PackingSpecification& specification,
                                    const PreparedPacking& packing) {
  PreparedPacking settled = packing;
  settled.packing.grains.front().radius = kRadiusOfSettled;
  const std::string line = "variable friction index ";
  if (const std::size_t place = specification.script.find(line); place != std::string::npos)
    settled.reached.void_ratio = fake_void_ratio(std::stod(specification.script.substr(place + line.size())));
  settled.reached.pressure = specification.pressure;
  return settled;
}

CellDefinition fake_definition(const std::string& script) {
  return {"sand", "fake.in", script, fake_packing(), CellControl{}};
}

}  // namespace polargrain::testing
