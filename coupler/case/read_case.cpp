// SPDX-License-Identifier: GPL-2.0-or-later
#include <fmt/format.h>

#include <algorithm>
#include <charconv>
#include <set>

#include "common/plain_text.hpp"
#include "coupler/case/case.hpp"
#include "coupler/case/columns_of_steps.hpp"
#include "coupler/case/document.hpp"
#include "coupler/case/document_kind.hpp"
#include "coupler/case/parts.hpp"
#include "coupler/case/read_continuum.hpp"
#include "coupler/case/workers_keys.hpp"
#include "fem/water/pore_water.hpp"

namespace polargrain::coupler {
namespace {

/// Reads one case; each function one section of it.
class CaseReader {
 public:
  CaseReader(const std::filesystem::path& file, const Entry& document, const ScriptRules& scripts,
             Faults& faults)
      : document_(document),
        faults_(faults),
        scripts_(scripts),
        parts_{file.parent_path(), {}, false, faults} {
    case_.file = file;
  }

  Case read() {
    Section top(document_, "case", faults_);
    case_.title = top.text("title", "a line that names the case");
    while (case_.title.ends_with('\n')) case_.title.pop_back();  // of a text in lines of its own
    if (!control_character_in(case_.title).empty())
      top.fault("title", "title: must be one line without control characters; write the rest as comments");
    const Entry* const continuum = top.find("continuum");
    const bool large = top.choice_or("deformation", {"small", "large"}, "small") == "large";
    if (const Entry* entry = top.require("mesh", "a map with the mesh")) read_mesh(*entry, parts_);
    parts_.builds = builds_in_stages(document_);
    parts_.in_real_time = is_real_time(document_);
    case_.with_problem([&](auto& problem) {
      problem.deformation = large ? fem::Deformation::large : fem::Deformation::small;
    });
    read_continuum(continuum, document_, parts_);
    parts_.materials = document_.find("materials");
    read_structures(top.find("interfaces"), top.find("beams"), top.find("anchors"), parts_);
    if (const Entry* entry = top.require("materials", "a map of materials by name")) read_materials(*entry);
    if (case_.spread > 0.0) check_spread_slips(*continuum, parts_);
    if (const Entry* entry = top.require("regions", "a map from region to material")) read_regions(*entry);
    if (const Entry* entry = top.find("water")) read_water(*entry, parts_);
    boundary_ = top.require("boundary", "a list of supports and loads");
    if (boundary_ != nullptr) read_boundary(*boundary_, parts_);
    finish_structures(parts_);
    add_water(parts_);
    if (const Entry* entry = top.find("body")) read_body_loads(*entry, parts_);
    if (const Entry* entry = top.find("initial_stress")) {
      read_initial_stress(*entry, parts_);
      for (const Entry& item : entry->items) check_initial_stress(item);
    }
    if (const Entry* entry = top.require("steps", "a map with at least 'count'")) read_steps(*entry, parts_);
    give_densities();
    if (top.find("start_from") != nullptr) read_start(top, parts_);
    if (const Entry* entry = top.find("monitors")) read_monitors(*entry);
    if (const Entry* entry = top.find("profiles")) read_profiles(*entry, parts_);
    if (const Entry* entry = top.find("output")) read_output(*entry);
    if (const Entry* entry = top.find("workers")) read_workers(*entry);
    top.finish();
    if (faults_.empty()) check_micro_rotations();
    if (faults_.empty()) check_whole();
    return std::move(case_);
  }

 private:
  void read_materials(const Entry& entry) {
    Section materials(entry, "materials", faults_);
    std::vector<std::string> models;
    for (const MaterialModel& model : material_models()) models.push_back(model.name);
    const bool one_point = case_.with_problem([](const auto& problem) {
      return std::ranges::any_of(problem.mesh.elements,
                                 [](const auto& element) { return !element.type->averaged.empty(); });
    });
    for (const Entry::Member& member : entry.members) {
      materials.find(member.key);
      Section section(member.value, fmt::format("material '{}'", member.key), faults_);
      const std::string name = section.choice("model", models);
      material_lines_[member.key] = &member;
      for (const MaterialModel& model : material_models()) {
        if (model.name != name) continue;
        std::unique_ptr<MaterialRecipe> recipe =
            model.read(member.key, section, faults_,
                       CaseFiles{parts_.directory, scripts_, dem_steps_of(document_), iterates(document_),
                                 ask_every_of(document_), case_.dimension(), !is_classical(),
                                 case_.spread > 0.0, one_point});
        const double density =
            section.quantity_if("density", Dimension::density, Limit::positive).value_or(0.0);
        if (recipe) recipe->given_density = density;
        case_.materials[member.key] = std::move(recipe);
        section.finish();
      }
    }
    materials.finish();
    if (entry.kind == Entry::Kind::map && entry.members.empty()) {
      faults_.push_back(entry.fault("materials: expected at least one material"));
    }
  }

  /// Of each region, for steps in real time.
  void give_densities() {
    if (!case_.real_time) {
      case_.with_problem([&](const auto& problem) {
        if (boundary_ != nullptr && !problem.quiet.empty())
          faults_.push_back(boundary_->fault(
              "boundary: quiet boundaries let waves out, which there are in real time alone; write 'time: real' below "
              "'steps', or leave quiet out"));
      });
      return;
    }
    for (const auto& [region, material] : case_.regions) {
      const auto recipe = case_.materials.find(material);
      if (recipe == case_.materials.end() || !recipe->second) continue;
      const double density = recipe->second->density();
      if (density <= 0.0)
        faults_.push_back({material_lines_[material]->value.file, material_lines_[material]->line,
                           fmt::format("material '{}': real time needs its density, such as "
                                       "'density: 1900 kg/m3'",
                                       material)});
      const bool is_wet = parts_.water && parts_.water->regions.contains(region);
      if (is_wet && density > 0.0 && recipe->second->given_density == 0.0)
        faults_.push_back(
            {material_lines_[material]->value.file, material_lines_[material]->line,
             fmt::format("material '{}': its packing has {:.0f} kg/m3 without water, and region '{}' is "
                         "full of it; give the saturated 'density', such as 'density: 2000 kg/m3'",
                         material, density, region)});
      case_.with_problem([&](auto& problem) { problem.densities[region] = density; });
    }
  }

  [[nodiscard]] bool is_classical() const {
    return case_.with_problem(
        [](const auto& problem) { return problem.continuum == fem::Continuum::cauchy; });
  }

  [[nodiscard]] std::map<std::string, std::vector<int>> regions_of_mesh() const {
    return case_.with_problem([](const auto& problem) { return problem.mesh.regions; });
  }

  void read_regions(const Entry& entry) {
    const std::map<std::string, std::vector<int>> known = regions_of_mesh();
    Section regions(entry, "regions", faults_);
    std::set<std::string> used;
    for (const Entry::Member& member : entry.members) {
      const std::string material = regions.text(member.key, "the name of a material");
      if (parts_.has_mesh && !known.contains(member.key)) {
        faults_.push_back(member.value.fault(fmt::format("regions: the mesh has no region '{}'; it has {}",
                                                         member.key, CaseParts::names_of(known))));
      }
      if (!material.empty() && !material_lines_.contains(material)) {
        const std::string guess = nearest(material, keys_of(material_lines_));
        regions.fault(member.key, fmt::format("{}: there is no material '{}'; {}", member.key, material,
                                              guess.empty() ? "give it below 'materials'"
                                                            : "did you mean '" + guess + "'?"));
      }
      case_.regions[member.key] = material;
      case_.with_problem([&](auto& problem) { problem.materials[member.key] = nullptr; });
      used.insert(material);
    }
    regions.finish();
    for (const auto& [name, member] : material_lines_) {
      if (used.contains(name)) continue;
      faults_.push_back(
          {member->value.file, member->line,
           fmt::format("material '{}': no region is made of it; remove it or name it below 'regions'",
                       name)});
    }
  }

  /// An item against the materials of its region.
  void check_initial_stress(const Entry& item) {
    const bool is_ground = item.find("surface") != nullptr;
    const Entry* const ratio = item.find("K0");
    const bool is_measured = ratio != nullptr && ratio->text == "measured";
    const Entry* const of_region = item.find("region");
    for (const auto& [region, material] : case_.regions) {
      if (of_region != nullptr && of_region->text != region) continue;
      const auto recipe = case_.materials.find(material);
      if (recipe == case_.materials.end() || !recipe->second) continue;
      const auto fault = [&, &name = region](const std::string& text) {
        faults_.push_back(item.fault(fmt::format("initial_stress: region '{}' is made of {}", name, text)));
      };
      if (!recipe->second->needs_workers()) {
        if (is_measured) fault("a law, which has no K0 of its own; give a number");
      } else if (material_lines_[material]->value.find("model")->text == "informed") {
        fault(
            "'informed', whose law begins at the stress of the packing; take 'cell' or 'adaptive', or name another region");
      } else if (!is_ground) {
        fault(
            "cells, which are led to the stress of level ground alone; give surface, unit_weight and K0, or name another "
            "region");
      }
    }
  }

  void read_monitors(const Entry& entry) {
    Section monitors(entry, "monitors", faults_);
    for (const Entry::Member& member : entry.members) {
      monitors.find(member.key);
      const auto is_among = [&](const std::vector<std::string>& names) {
        return std::find(names.begin(), names.end(), member.key) != names.end();
      };
      if (is_among(built_in_values()) || is_among(columns_of_steps()) ||
          (case_.is_explicit() && is_among(columns_of_explicit_steps())) ||
          (!case_.stages.empty() && member.key == kStageColumn) ||
          (case_.is_automatic() && is_among({kGivenUp})) || (case_.rate_follows && is_among({kSpeed})) ||
          (case_.real_time && is_among(columns_of_energies())))
        monitors.fault(member.key, fmt::format("the name '{}' is taken; choose another", member.key));
      // A spreadsheet computes what begins like a formula.
      const bool is_formula = member.key.find_first_of("=+-@") == 0;
      if (member.key.empty() || is_formula || member.key.find_first_of(",\"") != std::string::npos) {
        monitors.fault(
            member.key,
            "the name of a monitor heads a column of a CSV file: no comma or quotation mark in it, and "
            "no = + - @ at its beginning");
      }
      Monitor monitor;
      monitor.name = member.key;
      if (member.value.kind == Entry::Kind::scalar) {
        read_formula(member, monitor);
      } else {
        read_measurement(member.value, monitor);
      }
      case_.monitors.push_back(monitor);
    }
    monitors.finish();
  }

  void read_formula(const Entry::Member& member, Monitor& monitor) {
    try {
      monitor.formula.emplace(member.value.text);
    } catch (const std::invalid_argument& error) {
      faults_.push_back(member.value.fault(fmt::format("monitor '{}': {}", member.key, error.what())));
      return;
    }
    const std::vector<std::string> known = known_values();
    for (const std::string& name : monitor.formula->names()) {
      if (std::find(known.begin(), known.end(), name) != known.end()) continue;
      const std::string guess = nearest(name, known);
      faults_.push_back(member.value.fault(
          fmt::format("monitor '{}': there is no value '{}' before it; {}", member.key, name,
                      guess.empty() ? "it may use " + listed(known) : "did you mean '" + guess + "'?")));
    }
  }

  void read_measurement(const Entry& entry, Monitor& monitor) {
    Section section(entry, fmt::format("monitor '{}'", monitor.name), faults_);
    if (read_structure_monitor(section, parts_, monitor)) return;
    if (section.find("at") != nullptr) {
      read_place_monitor(section, monitor, parts_);
      section.finish();
      return;
    }
    if (read_water_monitor(section, parts_, monitor)) return;
    const std::vector<std::string> on =
        section.words("on", "the name of a boundary or node set, or a list of them");
    const bool reaction = section.find("reaction") != nullptr;
    const bool displacement = section.find("displacement") != nullptr;
    if (reaction == displacement && entry.kind == Entry::Kind::map) {
      faults_.push_back(entry.fault(section.name() +
                                    ": expected either 'reaction' or 'displacement', each one of " +
                                    listed(dof_names(case_.dimension())) + ", or a formula"));
    } else {
      monitor.kind = reaction ? Monitor::Kind::reaction : Monitor::Kind::displacement;
      const std::string dof = section.choice(reaction ? "reaction" : "displacement", known_dofs(parts_));
      if (!dof.empty()) monitor.dof = dof_of(dof);
      if (!dof.empty() && fem::is_rotation(monitor.dof) && is_classical())
        section.fault(
            reaction ? "reaction" : "displacement",
            fmt::format("{}: a cauchy continuum has no micro-rotation, and it stays zero; set 'continuum: "
                        "cosserat', or for the moment in a beam give {{beam: NAME, value: moment}}",
                        dof));
    }
    section.finish();
    monitor.on = on;
    parts_.check_places(section, "on", on);
  }

  void read_output(const Entry& entry) {
    Section output(entry, "output", faults_);
    case_.output_every = output.whole_or("every", 1, 1);
    case_.checkpoint_minutes =
        output.quantity_if("checkpoint_minutes", Dimension::number, Limit::not_negative)
            .value_or(case_.checkpoint_minutes);
    case_.output_points = output.choice_or("points", {"yes", "no"}, "yes") == "yes";
    if (output.find("grains") != nullptr) read_output_grains(output);
    if (output.find("table") != nullptr) {
      case_.table = output.words("table", "a list of monitors");
      const std::vector<std::string> known = known_values();
      for (const std::string& name : case_.table) {
        if (std::find(known.begin(), known.end(), name) != known.end()) continue;
        const std::string guess = nearest(name, known);
        output.fault("table", fmt::format("table: there is no monitor '{}'; {}", name,
                                          guess.empty() ? "there are " + listed(known)
                                                        : "did you mean '" + guess + "'?"));
      }
    }
    output.finish();
  }

  /// Numbers of integration points, and regions for all of theirs.
  void read_output_grains(Section& output) {
    const std::vector<std::string> words =
        output.words("grains", "a list of numbers of integration points, or of regions with cells");
    if (!parts_.has_mesh) return;
    if (case_.dimension() == 3) {
      output.fault("grains", "grains: grains of points in space cannot be shown yet; leave it out");
      return;
    }
    const fem::Mesh<2>& mesh = case_.problem.mesh;
    std::vector<std::size_t> first{0};  // point of each element, and behind the last one the number of all
    for (const fem::Element<2>& element : mesh.elements)
      first.push_back(first.back() + element.type->quadrature.size());
    const auto add_points = [&first](const std::vector<int>& elements, std::set<std::size_t>& points) {
      for (const int element : elements)
        for (std::size_t point = first[static_cast<std::size_t>(element)];
             point < first[static_cast<std::size_t>(element) + 1]; ++point)
          points.insert(point);
    };
    for (const std::string& word : words) {
      if (const auto region = mesh.regions.find(word); region != mesh.regions.end()) {
        add_points(region->second, case_.output_grains);
        continue;
      }
      std::size_t point = 0;
      const auto [end, error] = std::from_chars(word.data(), word.data() + word.size(), point);
      if (error == std::errc() && end == word.data() + word.size() && point < first.back()) {
        case_.output_grains.insert(point);
      } else {
        output.fault(
            "grains",
            fmt::format("grains: '{}' is no region of the mesh ({}) and no integration point of it (0 to {})",
                        word, CaseParts::names_of(mesh.regions), first.back() - 1));
      }
    }
    std::set<std::size_t> with_cells;
    for (const auto& [region, material] : case_.regions) {
      const auto recipe = case_.materials.find(material);
      const auto elements = mesh.regions.find(region);
      if (recipe == case_.materials.end() || recipe->second == nullptr || elements == mesh.regions.end())
        return;
      if (recipe->second->grains() != nullptr) add_points(elements->second, with_cells);
    }
    for (const std::size_t point : case_.output_grains) {
      if (with_cells.contains(point)) continue;
      output.fault("grains", fmt::format("grains: the material of point {} has no cells", point));
      break;
    }
  }

  void read_workers(const Entry& entry) {
    Section workers(entry, "workers", faults_);
    WorkersOfCase of_case;
    read_keys(workers, of_case);
    case_.patience = of_case.patience;
    case_.check_share = of_case.check_share;
    workers.finish();
  }

  /// Without Gc nothing ties the micro-rotations to the continuum: a uniform one costs nothing.
  void check_micro_rotations() {
    if (is_classical()) return;
    const bool fixed = case_.with_problem([](const auto& problem) {
      return std::ranges::any_of(problem.prescribed,
                                 [](const auto& item) { return fem::is_rotation(item.dof); });
    });
    if (fixed) return;
    for (const auto& [name, recipe] : case_.materials) {
      if (recipe->holds_micro_rotations()) return;
    }
    faults_.push_back(
        document_.find("materials")
            ->fault(fmt::format("materials: Gc is zero everywhere and no boundary fixes {0}, so nothing "
                                "holds the micro-rotations; set 'continuum: cauchy', give Gc, or fix {0}",
                                case_.dimension() == 2 ? "w" : "w1, w2 or w3")));
  }

  /// The faults that the finite elements find in the whole.
  void check_whole() {
    const std::string refused = case_.with_problem([](const auto& problem) {
      for (const auto& contribution : problem.contributions)
        if (!contribution->takes_explicit_steps()) return contribution->name();
      return std::string();
    });
    if (!refused.empty() && case_.is_explicit())
      faults_.push_back(document_.find("steps")->fault(fmt::format(
          "steps: explicit steps take no interfaces, beams, anchors or free water yet, here {}; leave out "
          "'method'",
          refused)));
    if (boundary_ != nullptr && case_.with_problem([](const auto& problem) {
          return !problem.quiet.empty() && fem::pore_water_of(problem) != nullptr;
        }))
      faults_.push_back(boundary_->fault(
          "boundary: quiet boundaries know the waves of dry ground alone; leave quiet out, or end 'water' before them"));
    for (const std::string& message :
         case_.with_problem([](const auto& problem) { return fem::faults(problem); })) {
      if (const Entry* const stage = stage_in(document_, message); stage != nullptr) {
        faults_.push_back(stage->fault(message));
      } else {
        faults_.push_back((boundary_ != nullptr ? *boundary_ : document_).fault("boundary: " + message));
      }
    }
  }

  [[nodiscard]] std::vector<std::string> known_values() const {
    std::vector<std::string> known = built_in_values();
    for (const Monitor& monitor : case_.monitors) known.push_back(monitor.name);
    return known;
  }

  template <class Map>
  static std::vector<std::string> keys_of(const Map& map) {
    std::vector<std::string> keys;
    for (const auto& [key, value] : map) keys.push_back(key);
    return keys;
  }
  const Entry& document_;
  Faults& faults_;
  const ScriptRules& scripts_;
  CaseParts parts_;
  Case& case_ = parts_.result;
  const Entry* boundary_ = nullptr;
  std::map<std::string, const Entry::Member*> material_lines_;
};

}  // namespace

const std::vector<std::string>& built_in_values() {
  static const std::vector<std::string> names{"time", "volume_strain", "external_work", "internal_work"};
  return names;
}

const std::vector<std::string>& columns_of_steps() {
  static const std::vector<std::string> names{
      "step",        "time",         "substeps",        "cuts",
      "iterations",  "evaluations",  "force_residual",  "moment_residual",
      "force_noise", "within_noise", "within_rounding", "limited",
      "jumps",       "jump_residual"};
  return names;
}

const std::vector<std::string>& columns_of_explicit_steps() {
  static const std::vector<std::string> names{"explicit_steps",   "rest_steps",        "reaction_difference",
                                              "nodes_unbalanced", "grains_unbalanced", "kinetic_share",
                                              "hot_points",       "error_estimate"};
  return names;
}

const std::vector<std::string>& columns_of_energies() {
  static const std::vector<std::string> names{"supplied_energy", "stress_energy",   "kinetic_energy",
                                              "damped_energy",   "absorbed_energy", "energy_error"};
  return names;
}

bool Case::needs_workers() const {
  return std::any_of(materials.begin(), materials.end(), [](const auto& material) {
    return material.second && material.second->needs_workers();
  });
}

const CaseStage* Case::stage_of(int step) const {
  for (const CaseStage& stage : stages)
    if (stage.first_step <= step && step <= stage.last_step) return &stage;
  return nullptr;
}

Case read_case(const std::filesystem::path& file, const std::vector<std::string>& settings,
               const ScriptRules& scripts) {
  const Entry document = load_document_of(DocumentKind::problem, file, settings);
  Faults faults;
  Case result = CaseReader(file, document, scripts, faults).read();
  result.identity = identity_of(document, file.parent_path());
  // In the order of the file; faults of options and of other files keep their order behind it.
  std::stable_sort(faults.begin(), faults.end(), [&](const Fault& a, const Fault& b) {
    const auto rank = [&](const Fault& fault) {
      return fault.file == file.string() ? fault.line : INT32_MAX;
    };
    return rank(a) < rank(b);
  });
  if (!faults.empty()) throw InputError(faults);
  result.left = std::move(faults.left);
  return result;
}

}  // namespace polargrain::coupler
