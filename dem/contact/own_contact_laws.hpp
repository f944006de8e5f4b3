// SPDX-License-Identifier: GPL-2.0-or-later
#pragma once
// The source that polargrain_contact_laws() of the CMake package compiles into a library of contact laws. Beside it that function
// writes own_*_model.h, lists of the headers given to it, and the engine's lists style_*_model.h, in which they follow
// the models of this project.
#include <algorithm>
#include <iterator>
#include <string>
#include <vector>

#include "dem/contact/combinations.hpp"
#include "dem/contact/contact_library.hpp"

namespace polargrain::dem::own {

/// Numbers below belong to the engine and to this project.
inline constexpr int kLeastNumber = 40;

// clang-format off
#define NORMAL_MODEL(identifier, name, number) number,
#define TANGENTIAL_MODEL(identifier, name, number) number,
#define COHESION_MODEL(identifier, name, number) number,
#define ROLLING_MODEL(identifier, name, number) number,
inline constexpr int kEnd = kModelNumbers;  // closes the lists, which may be empty
inline constexpr int kNormal[] = {
#include "own_normal_model.h"
    kEnd};
inline constexpr int kTangential[] = {
#include "own_tangential_model.h"
    kEnd};
inline constexpr int kCohesion[] = {
#include "own_cohesion_model.h"
    kEnd};
inline constexpr int kRolling[] = {
#include "own_rolling_model.h"
    kEnd};
#undef NORMAL_MODEL
#undef TANGENTIAL_MODEL
#undef COHESION_MODEL
#undef ROLLING_MODEL
// clang-format on

template <std::size_t Count>
constexpr bool numbers_allowed(const int (&numbers)[Count]) {
  return std::all_of(std::begin(numbers), std::end(numbers),
                     [](int number) { return number >= kLeastNumber && number <= kEnd; });
}
static_assert(
    numbers_allowed(kNormal) && numbers_allowed(kTangential) && numbers_allowed(kCohesion) &&
        numbers_allowed(kRolling),
    "the number of a contact law of your own (third in NORMAL_MODEL(...) and the like) must be 40 to 63");

template <std::size_t Count>
bool among(int number, const int (&numbers)[Count]) {
  return std::find(std::begin(numbers), std::end(numbers), number) != std::end(numbers);
}

/// Makes the laws of the library known by their names. @returns the name that another law has already, or nothing
inline std::string add_names() {
  using LIGGGHTS::ContactModels::Factory;
  using Identifier = int (Factory::*)(const std::string&);
  using Add = void (Factory::*)(const std::string&, int);
  std::string taken;
  const auto add = [&taken](Identifier identifier, Add add_model, const std::string& name, int number) {
    Factory& factory = Factory::instance();
    const int known = (factory.*identifier)(name);  // 0: not found, and the number of `off`
    if (name == "off" || (known != 0 && known != number)) taken = name;
    if (taken.empty()) (factory.*add_model)(name, number);
  };
#define NORMAL_MODEL(identifier, name, number) \
  add(&Factory::getNormalModelId, &Factory::addNormalModel, model_name(#name), number);
#include "own_normal_model.h"
#undef NORMAL_MODEL
#define TANGENTIAL_MODEL(identifier, name, number) \
  add(&Factory::getTangentialModelId, &Factory::addTangentialModel, model_name(#name), number);
#include "own_tangential_model.h"
#undef TANGENTIAL_MODEL
#define COHESION_MODEL(identifier, name, number) \
  add(&Factory::getCohesionModelId, &Factory::addCohesionModel, model_name(#name), number);
#include "own_cohesion_model.h"
#undef COHESION_MODEL
#define ROLLING_MODEL(identifier, name, number) \
  add(&Factory::getRollingModelId, &Factory::addRollingModel, model_name(#name), number);
#include "own_rolling_model.h"
#undef ROLLING_MODEL
  return taken;
}

/// Combinations that are compiled as one.
inline std::vector<void (*)()>& compiled() {
  static std::vector<void (*)()> made;
  return made;
}

inline std::string add_models() {
  if (const std::string taken = add_names(); !taken.empty())
    return "another law is called " + taken + " already; give yours another name";
  add_combinations(
      [](int normal, int tangential, int cohesion, int rolling) {
        return among(normal, kNormal) || among(tangential, kTangential) || among(cohesion, kCohesion) ||
               among(rolling, kRolling);
      },
      true);
  for (const auto& add : compiled()) add();
  return {};
}

}  // namespace polargrain::dem::own

#define POLARGRAIN_JOINED(a, b) a##b
#define POLARGRAIN_NAMED(line) POLARGRAIN_JOINED(compiled_combination_, line)
/// A line of the library's source: a combination that is compiled as one, by the identifiers of its four models.
#define POLARGRAIN_COMPILED(...)                                                             \
  namespace LIGGGHTS::ContactModels {                                                        \
  static const bool POLARGRAIN_NAMED(__LINE__) = [] {                                        \
    polargrain::dem::own::compiled().push_back(&polargrain::dem::add_compiled<__VA_ARGS__>); \
    return true;                                                                             \
  }();                                                                                       \
  }

extern "C" __attribute__((visibility("default")))
const polargrain::dem::ContactLibrary polargrain_contact_library{
    POLARGRAIN_VERSION, sizeof(polargrain::dem::Contact), &polargrain::dem::own::add_models};
