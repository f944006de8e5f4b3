// SPDX-License-Identifier: GPL-2.0-or-later
// Stages of construction: parts that come without the weight of the others, loads whose times are over.
#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "app/remarks/in_units.hpp"
#include "app/remarks/kinds.hpp"
#include "app/remarks/weights.hpp"

namespace polargrain::app {
namespace {

using coupler::Entry;

/// Weight of a region at its full value, N/m^3, in whatever stage.
double weight_in_any_stage(const Scene& scene, const SceneRegion& region) {
  return scene.the_case().with_problem(
      [&](const auto& problem) { return full_weight(problem, region.name); });
}

/// Where a case of stages writes down that a region comes.
const Entry& place_of(const Scene& scene, const std::string& region) {
  const Entry* const stages = scene.find({"steps", "stages"});
  if (stages != nullptr)
    for (const Entry& stage : stages->items) {
      const Entry* const placed = stage.find("place");
      if (placed == nullptr) continue;
      const auto is_region = [&](const Entry& word) { return word.text == region; };
      if (is_region(*placed) || std::ranges::any_of(placed->items, is_region)) return *placed;
    }
  return scene.place({"steps", "stages"});
}

/// A number, or seconds where it has a unit.
std::optional<double> time_of(const std::string& text) {
  if (const auto plain = coupler::parse_quantity(text, coupler::Dimension::number)) return plain;
  return coupler::parse_quantity(text, coupler::Dimension::duration);
}

/// The last time of a table [[time, value], ...] below an entry; nothing where no table is there.
std::optional<double> last_time_of(const Entry& entry) {
  std::optional<double> last;
  for (const Entry& item : entry.items) {
    if (entry.kind == Entry::Kind::sequence && item.kind == Entry::Kind::sequence && item.items.size() == 2)
      if (const auto time = time_of(item.items[0].text)) {
        last = std::max(last.value_or(*time), *time);
        continue;
      }
    if (const auto below = last_time_of(item)) last = std::max(last.value_or(*below), *below);
  }
  for (const Entry::Member& member : entry.members)
    if (const auto below = last_time_of(member.value)) last = std::max(last.value_or(*below), *below);
  return last;
}

/// Time at which each stage begins, in their order; empty where the time is found.
std::vector<double> begins_of(const Scene& scene) {
  std::vector<double> begins;
  if (!scene.end_time()) return begins;
  for (const coupler::CaseStage& stage : scene.the_case().stages)
    begins.push_back(stage.first_step < 2
                         ? 0.0
                         : scene.the_case().plan[static_cast<std::size_t>(stage.first_step) - 2].amount);
  return begins;
}

/// Whether one of these stages ends the item of that name, by its key `end` or by an item of the same name.
bool is_ended(const Entry& stages, std::size_t first, std::size_t last, const Entry* name) {
  for (std::size_t k = first; name != nullptr && k <= last; ++k) {
    const auto is_name = [&](const Entry& word) { return word.text == name->text; };
    if (const Entry* const end = stages.items[k].find("end");
        end != nullptr && (is_name(*end) || std::ranges::any_of(end->items, is_name)))
      return true;
    const Entry* const items = stages.items[k].find("boundary");
    if (items != nullptr && std::ranges::any_of(items->items, [&](const Entry& item) {
          const Entry* const of_item = item.find("name");
          return of_item != nullptr && is_name(*of_item);
        }))
      return true;
  }
  return false;
}

/// A pressure of a stage that comes along it: a single value, Pa.
std::optional<double> single_pressure(const Entry& item) {
  const Entry* const value = item.find("pressure");
  if (value == nullptr || value->kind != Entry::Kind::scalar) return {};
  return coupler::parse_quantity(value->text, coupler::Dimension::pressure);
}

bool are_on_one_place(const Entry& one, const Entry& other) {
  const Entry* const on = one.find("on");
  const Entry* const there = other.find("on");
  return on != nullptr && there != nullptr && !on->text.empty() && on->text == there->text;
}

}  // namespace

void weight_of_parts(const Scene& scene, Remarks& remarks) {
  double largest = 0.0;
  for (const SceneRegion& region : scene.regions())
    largest = std::max(largest, weight_in_any_stage(scene, region));
  if (largest <= 0.0) return;
  for (const SceneRegion& region : scene.regions()) {
    if (!region.comes_later || weight_in_any_stage(scene, region) > 0.0) continue;
    remarks.push_back(
        {Rank::wrong, 3.0,
         place_of(scene, region.name)
             .fault(
                 fmt::format("steps: region '{}' comes without a weight, and other ground has {:.3g} kN/m3",
                             region.name, 1e-3 * largest)),
         fmt::format("body: [..., {{unit_weight: {:.3g} kN/m3, region: {}}}], or leave the region out there",
                     1e-3 * largest, region.name)});
  }
}

void loads_of_stages(const Scene& scene, Remarks& remarks) {
  const Entry* const stages = scene.find({"steps", "stages"});
  const std::vector<double> begins = begins_of(scene);
  if (stages == nullptr || begins.size() != stages->items.size()) return;
  for (std::size_t k = 0; k < begins.size(); ++k)
    for (const char* const key : {"boundary", "body"}) {
      const Entry* const list = stages->items[k].find(key);
      if (list == nullptr || begins[k] <= 0.0) continue;
      for (const Entry& item : list->items) {
        const auto last = last_time_of(item);
        if (!last || *last > begins[k]) continue;
        remarks.push_back(
            {Rank::wrong, 2.0,
             item.fault(fmt::format(
                 "{}: the table ends at time {:g}, and stage '{}' begins at time {:g}: its last value acts all the time",
                 key, *last, scene.the_case().stages[k].name, begins[k])),
             fmt::format(
                 "times count from the start of the case: [[{:g}, FIRST], [{:g}, LAST]]; a single value comes "
                 "evenly along the stage",
                 begins[k], begins[k] + 1.0)});
      }
    }
}

namespace {

/// The loads of a stage, or of the case from its start.
struct LoadsBefore {
  const Entry* items;
  std::string of;              ///< in words
  std::size_t next;            ///< the first stage that may end them
  double most_times_as_large;  ///< a sum that is larger is meant
};

/// The pressure of a stage on a place that is loaded by less: most often the new whole is meant.
void look_at_sum(const Scene& scene, const Entry& stages, const LoadsBefore& before, std::size_t now,
                 Remarks& remarks) {
  const Entry* const later = stages.items[now].find("boundary");
  if (before.items == nullptr || later == nullptr) return;
  for (const Entry& one : before.items->items)
    for (const Entry& other : later->items) {
      const auto first = single_pressure(one);
      const auto second = single_pressure(other);
      if (!first || !second || !(*first > 0.0) || *second <= *first ||
          *second > before.most_times_as_large * *first || !are_on_one_place(one, other) ||
          is_ended(stages, before.next, now, one.find("name")))
        continue;
      remarks.push_back(
          {Rank::doubtful, 2.0,
           other.find("pressure")
               ->fault(fmt::format("boundary: stage '{}' adds {} on '{}' to the {} of {}: {} together",
                                   scene.the_case().stages[now].name, pascals(*second),
                                   other.find("on")->text, pascals(*first), before.of,
                                   pascals(*first + *second))),
           fmt::format(
               "loads of stages add up: give the increase, {}, or name the first (name: NAME) and end it "
               "(end: NAME)",
               pascals(*second - *first))});
    }
}

}  // namespace

void sums_of_stages(const Scene& scene, Remarks& remarks) {
  const Entry* const stages = scene.find({"steps", "stages"});
  if (stages == nullptr || stages->items.size() != scene.the_case().stages.size()) return;
  // A small surcharge from the start balances the stress there, and a larger load comes beside it.
  constexpr double kRaised = 1.8;
  for (std::size_t now = 0; now < stages->items.size(); ++now) {
    look_at_sum(scene, *stages, {scene.find({"boundary"}), "the case's own list", 0, kRaised}, now, remarks);
    for (std::size_t before = 0; before < now; ++before)
      look_at_sum(scene, *stages,
                  {stages->items[before].find("boundary"),
                   fmt::format("stage '{}'", scene.the_case().stages[before].name), before + 1, HUGE_VAL},
                  now, remarks);
  }
}

}  // namespace polargrain::app
