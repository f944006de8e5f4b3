// SPDX-License-Identifier: GPL-2.0-or-later
// steps: stages: rows of steps, which may have names, and before which parts may come and go.
#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <limits>
#include <set>
#include <string_view>
#include <utility>

#include "coupler/case/parts.hpp"

namespace polargrain::coupler {
namespace {

/// Keys of a stage before which something comes, goes, begins or ends.
constexpr std::array kBuild{"place", "remove", "boundary", "body", "end"};
constexpr std::string_view kRemove = "remove";

const Entry* stages_of(const Entry& document) {
  const Entry* const steps = document.find("steps");
  return steps == nullptr ? nullptr : steps->find("stages");
}

bool builds_in(const Entry& stage) {
  return std::ranges::any_of(kBuild, [&](const char* key) { return stage.find(key) != nullptr; });
}

bool has_name(const Entry& stage) {
  return builds_in(stage) || stage.find("name") != nullptr || stage.find("reset_displacements") != nullptr;
}

std::string name_of_stage(const Entry& stage, std::size_t index) {
  const Entry* const name = stage.find("name");
  return name == nullptr ? fmt::format("stage {}", index + 1) : name->text;
}

/// Mean of a dof over the nodes of a place, less its mean over another.
fem::DisplacementMeasure read_measure(const Entry& entry, const std::string& name, CaseParts& parts) {
  Section section(entry, name + ": measure", parts.faults);
  fem::DisplacementMeasure measure;
  const std::string on = section.text("on", "the name of a boundary or node set");
  const std::string from = section.text_or("from", "");
  const std::string dof = section.choice("displacement", dof_names(parts.result.dimension()));
  section.finish();
  const auto add_mean = [&](const std::string& key, const std::string& place, double sign) {
    if (place.empty()) return;
    parts.check_places(section, key, {place});
    const bool known =
        parts.result.with_problem([&](const auto& problem) { return problem.mesh.has_nodes_on(place); });
    if (!parts.has_mesh || !known || dof.empty()) return;
    const std::vector<int> nodes =
        parts.result.with_problem([&](const auto& problem) { return problem.mesh.nodes_on(place); });
    for (const int node : nodes) {
      measure.terms.push_back({node, dof_of(dof), sign / static_cast<double>(nodes.size())});
    }
  };
  add_mean("on", on, 1.0);
  add_mean("from", from, -1.0);
  return measure;
}

/// Reads the list of stages, one after the other.
class StagesReader {
 public:
  StagesReader(const Entry& list, CaseParts& parts)
      : list_(list), parts_(parts), are_named_(std::ranges::any_of(list.items, has_name)) {}

  void read() {
    if (are_named_) {
      problem_stages() = {"start"};
      stage_starts() = {0.0};
    }
    for (std::size_t k = 0; k < list_.items.size(); ++k) read_stage(list_.items[k], k);
    place_interfaces_with_beams();
    parts_.now = {};
  }

 private:
  std::vector<std::string>& problem_stages() {
    return parts_.result.with_problem(
        [](auto& problem) -> std::vector<std::string>& { return problem.stages; });
  }

  std::vector<double>& stage_starts() {
    return parts_.result.with_problem(
        [](auto& problem) -> std::vector<double>& { return problem.stage_starts; });
  }

  void read_stage(const Entry& entry, std::size_t index) {
    // Behind a stage that jacks an anchor a stage of the problem begins in any case, so that the anchor is locked.
    const bool builds = parts_.builds && (std::exchange(jacks_, false) || builds_in(entry));
    const std::string name = fmt::format("stage {}", index + 1);
    Section stage(entry,
                  are_named_ && entry.find("name") != nullptr
                      ? fmt::format("stage '{}'", entry.find("name")->text)
                      : name,
                  parts_.faults);
    const double start = time_;
    const std::size_t before = parts_.result.plan.size();
    read_way(stage);
    const std::size_t after = parts_.result.plan.size();
    CaseStage one{stage.find("name") == nullptr ? name : stage.text("name", "a name"),
                  static_cast<int>(before) + 1, static_cast<int>(after)};
    check_name(stage, one.name);
    if (builds) {
      ++number_;
      problem_stages().push_back(one.name);
      const bool is_known =
          before == 0 || parts_.result.plan[before - 1].control == StepTarget::Control::time;
      stage_starts().push_back(is_known ? start : std::numeric_limits<double>::quiet_NaN());
      for (std::size_t k = before; k < after; ++k)
        parts_.result.plan[k].released =
            static_cast<double>(k + 1 - before) / static_cast<double>(after - before);
      const bool by_time = after > before && parts_.result.plan.back().control == StepTarget::Control::time;
      parts_.now = {number_, start, by_time ? std::optional(time_) : std::nullopt};
      read_regions(stage);
      end_items(stage);
      if (const Entry* const items = stage.find("boundary"))
        read_boundary_of_stage(*items, stage.name(), parts_);
      if (const Entry* const items = stage.find("body")) read_body_of_stage(*items, stage.name(), parts_);
    }
    one.number = number_;
    one.resets_displacements = stage.flag("reset_displacements");
    stage.finish();
    if (are_named_) parts_.result.stages.push_back(one);
  }

  /// It heads lines of tables.
  void check_name(Section& stage, const std::string& name) {
    if (name.empty() || name.find_first_of(",\"\n'") != std::string::npos)
      stage.fault("name", "name: a few words without commas and quotation marks");
    for (const CaseStage& other : parts_.result.stages)
      if (other.name == name)
        stage.fault("name", fmt::format("name: an earlier stage is called '{}' too", name));
  }

  /// Adds the steps of the stage to the plan.
  void read_way(Section& stage) {
    const Entry& entry = stage.entry();
    std::vector<StepTarget>& plan = parts_.result.plan;
    const int count = step_count(stage, plan.size());
    const bool until = stage.find("until") != nullptr;
    const Entry* measure = stage.find("measure");
    const bool arc = stage.find("arc_length") != nullptr;
    const bool nothing = !until && measure == nullptr && !arc;
    if (until + (measure != nullptr) + arc > 1 || (nothing && !has_name(entry))) {
      if (entry.kind == Entry::Kind::map)
        parts_.faults.push_back(
            entry.fault(stage.name() + ": expected one of until, measure (with grow) and arc_length"));
    } else if (until || nothing) {
      const double end = until ? stage.quantity("until", parts_.time(), Limit::positive) : time_ + 1.0;
      if (!until && parts_.water)
        stage.fault("until", stage.name() +
                                 ": with water the time is physical; give the time at which the stage "
                                 "ends, such as 'until: 10 d'");
      if (!plan.empty() && plan.back().control != StepTarget::Control::time) {
        stage.fault("until",
                    "until: the time is not known after a stage that follows a measure or the arc length; "
                    "put stages under time before them");
      } else if (end <= time_) {
        stage.fault("until", fmt::format("until: must be later than the end of the stage before, {}", time_));
      }
      for (const double time : times_of_steps(stage, time_, end, count, parts_))
        plan.push_back({StepTarget::Control::time, time, {}});
      time_ = end;
    } else if (measure != nullptr) {
      const fem::DisplacementMeasure of = read_measure(*measure, stage.name(), parts_);
      const double grow = stage.quantity("grow", Dimension::length, Limit::any);
      if (grow == 0.0) stage.fault("grow", "grow: must not be zero");
      for (int i = 0; i < count; ++i) plan.push_back({StepTarget::Control::measure, grow / count, of});
    } else {
      const double length = stage.quantity("arc_length", Dimension::length, Limit::positive);
      if (plan.empty()) {
        stage.fault("arc_length",
                    "arc_length: it goes on in the direction of the step before; begin with a stage 'until'");
      }
      for (int i = 0; i < count; ++i) plan.push_back({StepTarget::Control::arc_length, length / count, {}});
    }
  }

  void read_regions(Section& stage) {
    parts_.result.with_problem([&](auto& problem) {
      const auto for_each_part = [&](std::string_view name, auto visit) {
        const std::string key(name);
        if (stage.find(key) == nullptr) return;
        for (const std::string& part :
             stage.words(key, "the name of a region, beam, interface or anchor, or a list of them")) {
          if (const auto structure = parts_.structures.find(part); structure != parts_.structures.end()) {
            named_.insert(part);
            if (structure->second.kind == CaseParts::Structure::Kind::interface && key == kRemove) {
              stage.fault(
                  key, fmt::format("{}: '{}' is an interface, which goes with the ground beside it; leave it "
                                   "out",
                                   key, part));
              continue;
            }
            fem::Lifetime life = life_of(problem, structure->second);
            visit(part, life);
            jacks_ =
                jacks_ || (structure->second.kind == CaseParts::Structure::Kind::anchor && key != kRemove);
            for (const std::size_t number : structure->second.contributions)
              problem.contributions[number]->life = life;
            continue;
          }
          if (parts_.has_mesh && !problem.mesh.regions.contains(part)) {
            stage.fault(key,
                        fmt::format("{}: the mesh has no region '{}'; it has {}{}", key, part,
                                    CaseParts::names_of(problem.mesh.regions),
                                    parts_.structures.empty() ? ""
                                                              : "; beams, interfaces and anchors are " +
                                                                    CaseParts::names_of(parts_.structures)));
            continue;
          }
          visit(part, problem.lifetimes[part]);
        }
      };
      for_each_part("place", [&](const std::string& region, fem::Lifetime& life) {
        if (life.end <= number_) {
          stage.fault(
              "place",
              fmt::format("place: '{}' was removed in an earlier stage and does not come back; give the "
                          "fill elements and a region of its own",
                          region));
        } else if (life.begin > 0) {
          stage.fault("place", fmt::format("place: '{}' has been placed in an earlier stage", region));
        }
        life.begin = number_;
      });
      for_each_part(kRemove, [&](const std::string& region, fem::Lifetime& life) {
        if (life.end <= number_)
          stage.fault("remove",
                      fmt::format("remove: '{}' was removed in an earlier stage, or in this one", region));
        else if (life.begin == number_)
          stage.fault("remove", fmt::format("remove: '{}' is placed in this stage", region));
        life.end = number_;
      });
    });
  }

  template <class Problem>
  static fem::Lifetime life_of(const Problem& problem, const CaseParts::Structure& structure) {
    return problem.contributions[structure.contributions.front()]->life;
  }

  /// An interface along a beam comes with it where no stage says otherwise.
  void place_interfaces_with_beams() {
    parts_.result.with_problem([&](auto& problem) {
      for (const auto& [name, structure] : parts_.structures) {
        if (structure.along.empty() || named_.contains(name)) continue;
        const fem::Lifetime beam = life_of(problem, parts_.structures.at(structure.along));
        for (const std::size_t number : structure.contributions)
          problem.contributions[number]->life.begin = beam.begin;
      }
    });
  }

  /// Items of boundary and body that end with the beginning of this stage.
  void end_items(Section& stage) {
    if (stage.find("end") == nullptr) return;
    for (const std::string& name : stage.words("end", "the name of a support or load, or a list of them")) {
      const auto made = parts_.named.find(name);
      if (made == parts_.named.end()) {
        stage.fault(
            "end",
            fmt::format("end: no item of 'boundary' or 'body' that has begun has the name '{}'; {}", name,
                        parts_.named.empty() ? "give the item that is to end a 'name'"
                                             : "there are " + CaseParts::names_of(parts_.named)));
        continue;
      }
      parts_.for_each(made->second, [&](auto& item) { item.life.end = number_; });
      parts_.named.erase(made);
    }
  }

  const Entry& list_;
  CaseParts& parts_;
  bool are_named_;
  double time_ = 0.0;
  int number_ = 0;               ///< of the problem's stage
  bool jacks_ = false;           ///< the stage before places an anchor
  std::set<std::string> named_;  ///< structures that a stage places or removes
};

}  // namespace

bool builds_in_stages(const Entry& document) {
  const Entry* const stages = stages_of(document);
  return stages != nullptr && std::ranges::any_of(stages->items, builds_in);
}

const Entry* stage_in(const Entry& document, const std::string& message) {
  const Entry* const stages = stages_of(document);
  if (stages == nullptr) return nullptr;
  for (std::size_t k = 0; k < stages->items.size(); ++k)
    if (message.starts_with(fmt::format("stage '{}': ", name_of_stage(stages->items[k], k))))
      return &stages->items[k];
  return nullptr;
}

void read_stages(const Entry& entry, CaseParts& parts) {
  if (entry.kind != Entry::Kind::sequence || entry.items.empty()) {
    parts.faults.push_back(
        entry.fault("steps: stages: expected a list, each item a map such as {until: 1, count: 10}"));
    return;
  }
  StagesReader(entry, parts).read();
}

}  // namespace polargrain::coupler
