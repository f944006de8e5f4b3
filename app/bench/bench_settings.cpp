// SPDX-License-Identifier: GPL-2.0-or-later
#include "app/bench/bench_settings.hpp"

#include <fmt/format.h>

#include <algorithm>

#include "coupler/case/document.hpp"
#include "coupler/case/section.hpp"

namespace polargrain::app {
namespace {

coupler::Entry document_of(const BenchOptions& options) {
  coupler::Entry document = coupler::load_document(options.cases.front());
  for (const std::string& setting : options.settings) apply_setting(document, setting);
  return document;
}

/// The number of steps, 0 where the case has stages instead.
int steps_of(const coupler::Entry& document) {
  const coupler::Entry* steps = document.find("steps");
  const coupler::Entry* count = steps == nullptr ? nullptr : steps->find("count");
  return count == nullptr ? 0 : std::atoi(count->text.c_str());
}

class Grid {
 public:
  explicit Grid(const BenchOptions& options)
      : options_(options), materials_(materials_with_cells(options)), steps_(steps_of(document_of(options))) {
    if (!options.band.empty()) common_.emplace_back("output.every=1");
  }

  std::vector<BenchSetting> settings(const std::vector<BenchPacking>& packings) {
    add_reference();
    add("as given", "", {});
    add_further_cases();
    if (!materials_.empty()) {
      add_equilibrium();
      add_rates();
      add_adaptivity();
      if (!options_.quick) add_tangent();
    }
    add_step_sizes();
    for (const std::string& packing : options_.packings) add("packing", packing, for_all("packing", packing));
    for (const std::string& vary : options_.vary) add_varied(vary);
    for (const BenchPacking& packing : packings) add_packing(packing);
    return std::move(runs_);
  }

 private:
  void add(const std::string& group, const std::string& label, const std::vector<std::string>& overrides) {
    BenchSetting run{options_.cases.front(), group, label, options_.settings};
    run.overrides.insert(run.overrides.end(), common_.begin(), common_.end());
    run.overrides.insert(run.overrides.end(), overrides.begin(), overrides.end());
    runs_.push_back(std::move(run));
  }

  [[nodiscard]] std::vector<std::string> for_all(const std::string& key, const std::string& value) const {
    std::vector<std::string> overrides;
    for (const auto& material : materials_) {
      overrides.push_back(fmt::format("materials.{}.{}={}", material.name, key, value));
    }
    return overrides;
  }

  [[nodiscard]] std::vector<std::string> equilibrium(const std::string& value) const {
    std::vector<std::string> overrides = for_all("unbalanced_force_ratio", value);
    const std::vector<std::string> moments = for_all("unbalanced_moment_ratio", value);
    overrides.insert(overrides.end(), moments.begin(), moments.end());
    return overrides;
  }

  /// As they are: the steps that suit one scheme do not suit another.
  void add_further_cases() {
    for (std::size_t k = 1; k < options_.cases.size(); ++k) {
      runs_.push_back({options_.cases[k], "scheme", options_.cases[k].string(), options_.settings});
      if (!options_.band.empty()) runs_.back().overrides.emplace_back("output.every=1");
    }
  }

  void add_packing(const BenchPacking& packing) {
    std::string quoted = "'";  // as YAML takes any path
    for (const char c : packing.file.string()) quoted += c == '\'' ? std::string("''") : std::string(1, c);
    add(options_.grains.size() > 1 ? "cell size" : "packing",
        fmt::format("{} grains, seed {}", packing.grains, packing.seed), for_all("packing", quoted + "'"));
    runs_.back().grains = packing.grains;
  }

  void add_reference() {
    std::vector<std::string> overrides;
    std::string label = "the case as given";
    if (!materials_.empty()) {
      const char* ratio = options_.quick ? "1e-3" : "5e-4";
      const char* rate = options_.quick ? "1e-4" : "5e-5";
      overrides = equilibrium(ratio);
      const std::vector<std::string> rates = for_all("inertial_number", rate);
      overrides.insert(overrides.end(), rates.begin(), rates.end());
      for (const auto& material : materials_) {
        if (material.model != "adaptive") continue;
        overrides.push_back(fmt::format("materials.{}.adaptive.tolerance=0", material.name));
        overrides.push_back(fmt::format("materials.{}.adaptive.audit=0", material.name));
      }
      label = fmt::format("unbalanced ratio {}, inertial number {}, a cell a point", ratio, rate);
    }
    if (!options_.quick && steps_ > 0) {
      overrides.push_back(fmt::format("steps.count={}", 2 * steps_));
      label += fmt::format(", {} steps", 2 * steps_);
    }
    add("reference", label, overrides);
  }

  void add_equilibrium() {
    for (const char* ratio : {"2e-2", "1e-2", "5e-3", "1e-3"}) {
      if (options_.quick && ratio[0] != '2') continue;
      add("equilibrium", fmt::format("unbalanced ratio {}", ratio), equilibrium(ratio));
    }
  }

  void add_rates() {
    for (const char* rate : {"1e-3", "4e-4", "1e-4"}) {
      if (options_.quick && std::string(rate) != "1e-3") continue;
      add("loading rate", fmt::format("inertial number {}", rate), for_all("inertial_number", rate));
    }
  }

  void add_adaptivity() {
    for (const char* tolerance : {"10 %", "5 %", "2 %", "0.5 %"}) {
      if (options_.quick && (tolerance[0] == '0')) continue;
      std::vector<std::string> overrides;
      for (const auto& material : materials_) {
        if (material.model != "cell" && material.model != "adaptive") continue;
        overrides.push_back(fmt::format("materials.{}.model=adaptive", material.name));
        overrides.push_back(fmt::format("materials.{}.adaptive.tolerance={}", material.name, tolerance));
      }
      if (!overrides.empty()) add("adaptivity", fmt::format("tolerance {}", tolerance), overrides);
    }
  }

  void add_tangent() {
    for (const char* const tangent : {"voigt", "secant"}) {
      std::vector<std::string> overrides;
      for (const auto& material : materials_) {
        if (material.model == "cell")
          overrides.push_back(fmt::format("materials.{}.tangent={}", material.name, tangent));
      }
      if (!overrides.empty()) add("tangent", tangent, overrides);
    }
  }

  void add_step_sizes() {
    if (steps_ < 2) return;
    const int half = (steps_ + 1) / 2;
    add("step size", half == 1 ? "1 step" : fmt::format("{} steps", half),
        {fmt::format("steps.count={}", half)});
    if (!options_.quick)
      add("step size", fmt::format("{} steps", 2 * steps_), {fmt::format("steps.count={}", 2 * steps_)});
  }

  void add_varied(const std::string& vary) {
    const std::size_t equals = vary.find('=');
    if (equals == std::string::npos || equals == 0 || equals + 1 == vary.size()) {
      throw InputError({"--vary", 0, fmt::format("expected KEY=VALUE,VALUE,..., found '{}'", vary)});
    }
    const std::string key = vary.substr(0, equals);
    for (std::size_t begin = equals + 1; begin <= vary.size();) {
      const std::size_t end = std::min(vary.find(',', begin), vary.size());
      const std::string value = vary.substr(begin, end - begin);
      add(key, value, {key + "=" + value});
      begin = end + 1;
    }
  }

  const BenchOptions& options_;
  std::vector<MaterialWithCells> materials_;
  int steps_;
  std::vector<std::string> common_;
  std::vector<BenchSetting> runs_;
};

}  // namespace

std::vector<MaterialWithCells> materials_with_cells(const BenchOptions& options) {
  const coupler::Entry document = document_of(options);
  std::vector<MaterialWithCells> found;
  const coupler::Entry* materials = document.find("materials");
  if (materials == nullptr) return found;
  for (const coupler::Entry::Member& member : materials->members) {
    const coupler::Entry* model = member.value.find("model");
    const auto text_of = [&member](const char* key) {
      const coupler::Entry* entry = member.value.find(key);
      return entry == nullptr ? std::string() : entry->text;
    };
    if (model != nullptr && member.value.find("packing") != nullptr)
      found.push_back({member.key, model->text, text_of("script"), text_of("contact_library")});
  }
  return found;
}

std::vector<BenchSetting> bench_settings(const BenchOptions& options,
                                         const std::vector<BenchPacking>& packings) {
  return Grid(options).settings(packings);
}

}  // namespace polargrain::app
