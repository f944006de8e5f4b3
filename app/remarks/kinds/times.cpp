// SPDX-License-Identifier: GPL-2.0-or-later
// Times of loads against the times of the steps.
#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <tuple>
#include <utility>
#include <vector>

#include "app/remarks/kinds.hpp"
#include "fem/solver/tables_of.hpp"

namespace polargrain::app {
namespace {

std::vector<const fem::TimeTable*> tables_of(const Scene& scene) {
  std::vector<const fem::TimeTable*> tables;
  scene.with_problem([&](const auto& problem) { tables = fem::tables_of(problem); });
  return tables;
}

bool changes(const Scene& scene, double from, double to) {
  for (const fem::TimeTable* const table : tables_of(scene))
    for (int k = 1; k <= 8; ++k)
      if (table->at(from + (to - from) * k / 8.0) != table->at(from)) return true;
  return false;
}

/// The last time at which a table of the case has a point, as it is written.
void last_point(const coupler::Entry& entry, double& last, const coupler::Entry*& at) {
  if (entry.kind == coupler::Entry::Kind::sequence && entry.items.size() > 1) {
    const coupler::Entry& point = entry.items.back();
    if (point.kind == coupler::Entry::Kind::sequence && point.items.size() == 2) {
      auto time = coupler::parse_quantity(point.items[0].text, coupler::Dimension::number);
      if (!time) time = coupler::parse_quantity(point.items[0].text, coupler::Dimension::duration);
      const bool stays = entry.items[entry.items.size() - 2].items.size() == 2 &&
                         entry.items[entry.items.size() - 2].items[1].text == point.items[1].text;
      if (time && !stays && *time > last) {
        last = *time;
        at = &point;
      }
      return;
    }
  }
  for (const coupler::Entry& item : entry.items) last_point(item, last, at);
  for (const coupler::Entry::Member& member : entry.members) last_point(member.value, last, at);
}

/// The first single value of a movement that is not zero: it is reached at time 1.
const coupler::Entry* single_movement(const Scene& scene) {
  const coupler::Entry* const boundary = scene.find({"boundary"});
  if (boundary == nullptr) return nullptr;
  for (const coupler::Entry& item : boundary->items)
    if (const coupler::Entry* const moved = item.find("move"))
      for (const coupler::Entry::Member& member : moved->members)
        if (member.value.kind == coupler::Entry::Kind::scalar &&
            std::strtod(member.value.text.c_str(), nullptr) != 0.0)
          return &member.value;
  return nullptr;
}

/// Ways of a load there and back, in its unit: as it is given, and as the ends of steps see it.
struct Ways {
  double given = 0.0;
  double seen = 0.0;
};

Ways ways_of(const fem::TimeTable& table, const std::vector<coupler::StepTarget>& plan) {
  const auto parts = static_cast<int>(std::clamp<std::size_t>(20000 / plan.size(), 2, 64));
  Ways ways;
  double from = 0.0;
  for (const coupler::StepTarget& target : plan) {
    ways.seen += std::abs(table.at(target.amount) - table.at(from));
    for (int k = 0; k < parts; ++k)
      ways.given += std::abs(table.at(from + (target.amount - from) * (k + 1) / parts) -
                             table.at(from + (target.amount - from) * k / parts));
    from = target.amount;
  }
  return ways;
}

}  // namespace

void missed_turns(const Scene& scene, Remarks& remarks) {
  constexpr double kLost = 0.02;  // of the way
  constexpr double kLostLargely = 0.25;
  const std::vector<coupler::StepTarget>& plan = scene.the_case().plan;
  // In real time it is the explicit steps that see the loads; their run tells (app/run/missed_pulses.hpp).
  if (!scene.end_time() || plan.empty() || scene.the_case().real_time) return;
  double lost = 0.0;
  for (const fem::TimeTable* const table : tables_of(scene)) {
    const Ways ways = ways_of(*table, plan);
    if (ways.given > 0.0) lost = std::max(lost, 1.0 - ways.seen / ways.given);
  }
  if (lost <= kLost) return;
  remarks.push_back(
      {lost > kLostLargely ? Rank::wrong : Rank::doubtful, lost / kLost,
       scene.place({"steps"}).fault(fmt::format(
           "steps: a load turns between the ends of {} steps, which see {:.2g} % of its way there and back",
           plan.size(), 100.0 * (1.0 - lost))),
       "let steps end where loads turn: stages: [{until: TIME OF THE TURN, count: ...}, ...], or more steps"});
}

namespace {

/// The time at which the case ends, as it is written; null where it is not.
const coupler::Entry* written_end(const Scene& scene) {
  if (const coupler::Entry* const duration = scene.find({"steps", "duration"})) return duration;
  const coupler::Entry* const stages = scene.find({"steps", "stages"});
  return stages == nullptr || stages->items.empty() ? nullptr : stages->items.back().find("until");
}

/// The last time of each table whose unit is not written.
void plain_times(const coupler::Entry& entry, std::vector<const coupler::Entry*>& times) {
  const coupler::Entry* const point = entry.items.empty() ? nullptr : &entry.items.back();
  if (entry.items.size() > 1 && point->items.size() == 2 &&
      coupler::parse_quantity(point->items[0].text, coupler::Dimension::number))
    times.push_back(&point->items[0]);
  for (const coupler::Entry& item : entry.items) plain_times(item, times);
  for (const coupler::Entry::Member& member : entry.members) plain_times(member.value, times);
}

/// A time without a unit is in seconds, beside times in days.
void look_at_plain_times(const Scene& scene, double end, Remarks& remarks) {
  constexpr double kSudden = 0.01;  // of the run
  const coupler::Entry* const written = written_end(scene);
  if (written == nullptr || scene.the_case().real_time ||
      !coupler::parse_quantity(written->text, coupler::Dimension::duration) ||
      coupler::is_plain_number(written->text) || written->text.ends_with('s'))
    return;
  std::vector<const coupler::Entry*> times;
  for (const Scene::Path& path :
       {Scene::Path{"boundary"}, Scene::Path{"body"}, Scene::Path{"steps", "stages"}})
    if (const coupler::Entry* const entry = scene.find(path)) plain_times(*entry, times);
  for (const coupler::Entry* const time : times) {
    const double last = *coupler::parse_quantity(time->text, coupler::Dimension::number);
    if (last <= 0.0 || last >= kSudden * end) continue;
    remarks.push_back(
        {Rank::doubtful, kSudden * end / last,
         time->fault(fmt::format(
             "a load reaches its last value at time '{0}', which has no unit and is {0} s; the run takes {1}",
             time->text, written->text)),
         fmt::format("write the unit, as in '{0} d'; or '{0} s' for a load that comes at once", time->text)});
    return;
  }
}

}  // namespace

void times_of_loads(const Scene& scene, Remarks& remarks) {
  const auto end = scene.end_time();
  if (!end) return;
  look_at_plain_times(scene, *end, remarks);
  double last = 0.0;
  const coupler::Entry* at = nullptr;
  for (const char* const key : {"boundary", "body"})
    if (const coupler::Entry* const entry = scene.find({key})) last_point(*entry, last, at);
  if (const coupler::Entry* const single = single_movement(scene); single != nullptr && last < 1.0)
    std::tie(last, at) = std::pair(1.0, single);
  if (at != nullptr && last > *end * (1.0 + 1e-9))
    remarks.push_back(
        {Rank::doubtful, last / std::max(*end, 1e-9),
         at->fault(fmt::format(
             "a load reaches its last value at time {:g}, and the steps end at time {:g}: it is never reached",
             last, *end)),
         fmt::format("steps: {{stages: [..., {{until: {:g}, count: ...}}]}}, or give the load by time {:g}",
                     last, *end)});
}

namespace {

/// In real time a body goes on by itself. But a single value of a movement is reached at 1 s, however long the run.
void look_at_single_movement(const Scene& scene, Remarks& remarks) {
  const coupler::Entry* const single = single_movement(scene);
  const auto end = scene.end_time();
  if (single == nullptr || !end || *end <= 1.0 + 1e-9) return;
  remarks.push_back(
      {Rank::doubtful, std::max(*end, 1.0),
       single->fault(fmt::format(
           "boundary: the movement of '{}' is over at 1 s, as that of each single value, and the run ends at {:g} s",
           single->text, *end)),
       fmt::format("give its times: [[0, 0], [{:g}, {}]]", *end, single->text)});
}

}  // namespace

void idle_steps(const Scene& scene, Remarks& remarks) {
  if (scene.the_case().real_time) return look_at_single_movement(scene, remarks);
  const auto end = scene.end_time();
  // Where parts come or go, and where water flows, that is what changes.
  if (!end || scene.the_case().with_problem([](const auto& problem) { return problem.stages.size(); }) > 1 ||
      scene.find({"water"}) != nullptr)
    return;
  // Step by step: whole cycles of a load end where they began. A pause before a further change is meant.
  double from = 0.0;
  int idle = 0;  // since the last change
  for (const coupler::StepTarget& target : scene.the_case().plan) {
    idle = changes(scene, from, target.amount) ? 0 : idle + 1;
    from = target.amount;
  }
  if (idle == scene.the_case().steps()) {
    remarks.push_back(
        {Rank::wrong, 10.0,
         scene.place({"steps"}).fault(
             "steps: no load and no movement changes from time 0 to the end: all steps repeat step 0"),
         "give a boundary 'move', or a load a table of times: [[0, FIRST], [1, LAST]]"});
    return;
  }
  if (idle > 0)
    remarks.push_back(
        {Rank::doubtful, 1.0 + static_cast<double>(idle) / scene.the_case().steps(),
         scene.place({"steps"}).fault(fmt::format(
             "steps: in the last {} of {} steps no load and no movement changes (a single value of 'move' is "
             "reached at time 1)",
             idle, scene.the_case().steps())),
         "let the steps end where the loads do, or give the loads times up to the end: [[0, 0], [END, VALUE]]"});
}

}  // namespace polargrain::app
