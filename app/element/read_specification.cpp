// SPDX-License-Identifier: GPL-2.0-or-later
#include "app/element/read_specification.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <map>

#include "app/element/read_stage.hpp"
#include "coupler/case/document_kind.hpp"
#include "coupler/case/models/cell_definition.hpp"
#include "coupler/case/section.hpp"
#include "coupler/points/law_point.hpp"

namespace polargrain::app {
namespace {

using coupler::Dimension;
using coupler::Entry;
using coupler::Faults;
using coupler::Limit;
using coupler::Section;

/// The document with one packing instead of a list of them.
Entry with_packing(const Entry& document, const Entry& packing) {
  Entry one = document;
  for (Entry::Member& member : one.members)
    if (member.key == "packing") member.value = packing;
  return one;
}

/// A packing's file without folder and ending; a number behind it where that is not its alone.
std::string unique_name(const std::string& file, const std::vector<std::string>& before) {
  const std::string stem = std::filesystem::path(file).stem().string();
  std::string name = stem;
  for (int number = 2; std::ranges::find(before, name) != before.end(); ++number)
    name = fmt::format("{}_{}", stem, number);
  return name;
}

bool is_same_grain(const Grain& one, const Grain& other) {
  return one.position == other.position && one.height == other.height && one.radius == other.radius &&
         one.mass == other.mass;
}

/// In ascending order.
std::vector<double> radii_of_grains(const Packing& packing) {
  std::vector<double> radii;
  for (const Grain& grain : packing.grains) radii.push_back(grain.radius);
  std::ranges::sort(radii);
  return radii;
}

/// Whether the sizes tell the seed: most grains have one of their own. Grains of one size, or of a few, do not.
bool are_drawn(const std::vector<double>& sorted_radii) {
  constexpr std::size_t kFewSizes = 10;
  std::vector<double> sizes = sorted_radii;
  sizes.erase(std::ranges::unique(sizes).begin(), sizes.end());
  return sizes.size() >= kFewSizes && 2 * sizes.size() > sorted_radii.size();
}

/// Whether two packings are copies, settled or made anew as they may be: grains of the same drawn sizes; or else the same grains
/// at the same places of the same box.
bool are_copies(const Packing& one, const Packing& other) {
  const std::vector<double> radii = radii_of_grains(one);
  if (are_drawn(radii)) return radii == radii_of_grains(other);
  return one.box == other.box && one.thickness == other.thickness &&
         std::ranges::equal(one.grains, other.grains, is_same_grain);
}

/// A copy would count as a further sample, and the interval of the mean would be too narrow.
void check_independence(const ElementSpecification& specification, const CellDefinition& cell, Section& top) {
  for (const CellDefinition& before : specification.cells) {
    if (!are_copies(before.packing, cell.packing)) continue;
    top.fault(
        "packing",
        fmt::format("packing: {} has the grains of {}; the two are no independent samples, and the "
                    "interval of their mean would be too narrow. Name each packing once; make others with "
                    "another seed",
                    cell.name, before.name));
    return;
  }
}

/// Cells of all packings under one script. The top section asks for what a definition reads, so that finish() knows it.
void read_cells(const Entry& document, Section& top, ElementSpecification& specification, Faults& faults,
                const coupler::CaseFiles& files) {
  const Entry* const packing = top.require("packing", "a packing (CSV or HDF5), or a list of them");
  if (packing == nullptr) {
    top.require("script", "the path of a LIGGGHTS input script for cells");
    return;
  }
  const std::vector<Entry> packings =
      packing->kind == Entry::Kind::sequence ? packing->items : std::vector<Entry>{*packing};
  if (packings.empty()) top.fault("packing", "packing: the list is empty");
  for (const Entry& one : packings) {
    Faults found;
    const Entry alone = with_packing(document, one);
    Section section(alone, top.name(), found);
    CellDefinition cell = read_cell_definition("cell", section, found, files);
    for (const Fault& fault : found)  // the script's are the same for all
      if (std::ranges::none_of(faults, [&](const Fault& f) { return f.text() == fault.text(); }))
        faults.push_back(fault);
    specification.names.push_back(unique_name(one.text, specification.names));
    cell.name = specification.names.back();
    if (found.empty() && !specification.cells.empty() &&
        cell.packing.dimension != specification.cells.front().packing.dimension)
      top.fault("packing", fmt::format("packing: {} has dimension {}, {} has {}; one test is of one kind",
                                       cell.name, cell.packing.dimension, specification.names.front(),
                                       specification.cells.front().packing.dimension));
    if (found.empty()) check_independence(specification, cell, top);
    specification.cells.push_back(std::move(cell));
  }
  for (const char* const key :
       {"script", "packing", "contact_library", "inertial_number", "unbalanced_force_ratio",
        "unbalanced_moment_ratio", "damping", "least_steps", "most_relaxation_steps", "tangent", "loop"})
    top.find(key);
  if (!specification.cells.empty() && specification.cells.front().packing.dimension == 3)
    specification.room = element::Room::space;
}

void read_material(const Entry& entry, ElementSpecification& specification, Faults& faults,
                   const coupler::CaseFiles& files) {
  Section section(entry, "material", faults);
  std::vector<std::string> names;
  for (const coupler::MaterialModel& model : coupler::material_models()) names.push_back(model.name);
  const std::string name = section.choice("model", names);
  if (name.empty()) return;
  const auto model = std::ranges::find(coupler::material_models(), name, &coupler::MaterialModel::name);
  specification.material = model->read("material", section, faults, files);
  section.finish();
  specification.names = {name};
  // A law with a fault may be of space: no second fault for that.
  specification.room = element::Room::space;
  if (specification.material == nullptr) return;
  specification.room = element::Room::plane_strain;
  if (!specification.material->needs_workers())
    specification.room = coupler::room_of(*specification.material->make(nullptr));
  if (!specification.material->knows_s33()) specification.room = element::Room::discs;
}

/// Of a law. Grains have a void ratio of their own.
void read_void_ratio(Section& top, ElementSpecification& specification) {
  if (top.find("void_ratio") == nullptr) return;
  if (top.find("material") == nullptr)
    top.fault(
        "void_ratio",
        "void_ratio: a packing has its own, and the table gives it (column void_ratio); leave the key out. For "
        "packings of this void ratio write packing: {specification: PACK.yaml, seeds: [1, 2, 3]}");
  else
    specification.void_ratio = top.quantity("void_ratio", Dimension::number, Limit::positive);
}

void read_accuracy(Section& top, element::Accuracy& accuracy) {
  const auto positive = [&top](const char* key, double otherwise) {
    return top.quantity_or(key, Dimension::number, Limit::positive, otherwise);
  };
  accuracy.tolerance = positive("tolerance", accuracy.tolerance);
  accuracy.largest_increment = positive("largest_increment", accuracy.largest_increment);
  accuracy.iterations = top.whole_or("iterations", 2, accuracy.iterations);
  accuracy.cuts = top.whole_or("cuts", 0, accuracy.cuts);
  if (accuracy.cuts > 20) top.fault("cuts", "cuts: at most 20, a millionth of a row");
  accuracy.jumps = top.whole_or("jumps", 0, accuracy.jumps);
}

element::Stage consolidation(double pressure, element::Room room) {
  element::NamedTest test;
  test.name = "isotropic";
  test.pressure = pressure;
  test.rows = 1;
  element::Stage stage = element::stage_of(test, room);
  stage.name = "consolidation";
  return stage;
}

void read_stages(Section& top, ElementSpecification& specification, Faults& faults) {
  std::vector<element::Stage> stages;
  if (const Entry* const list = top.find("stages")) {
    if (list->kind != Entry::Kind::sequence || list->items.empty())
      top.fault("stages", "stages: expected a list of stages, each a named test or components");
    bool extended = false;
    for (std::size_t k = 0; k < list->items.size(); ++k) {
      Section section(list->items[k], fmt::format("stage {}", k + 1), faults);
      stages.push_back(read_stage(section, specification.room, extended));
      extended = element::extends(stages.back(), extended);
      section.finish();
    }
  } else {
    if (top.find("test") == nullptr) {
      top.require("test", "a named test (test: biaxial), or a list of 'stages'");
      return;
    }
    stages.push_back(read_stage(top, specification.room));
  }
  if (!faults.empty()) return;
  stages.front().zero = true;  // strains of the consolidation do not count
  specification.stages.push_back(
      element::completed(consolidation(specification.pressure, specification.room), specification.room));
  for (element::Stage& stage : stages)
    specification.stages.push_back(element::completed(std::move(stage), specification.room));
}

}  // namespace

TableForm form_of(const ElementSpecification& specification) {
  return {specification.room, specification.void_ratio,
          std::ranges::any_of(specification.stages, element::drives_shear)};
}

ElementSpecification read_element_specification(const Entry& document, const std::filesystem::path& directory,
                                                const ScriptRules& scripts) {
  Faults faults;
  ElementSpecification specification;
  coupler::require_kind(document, coupler::DocumentKind::element_test);
  Section top(document, "element test", faults);
  specification.title = top.text_or("title", "");
  const coupler::CaseFiles files{directory, scripts};
  if (const Entry* const material = top.find("material"))
    read_material(*material, specification, faults, files);
  else
    read_cells(document, top, specification, faults, files);
  specification.pressure = read_pressure(top, "pressure", Limit::positive);
  specification.accuracy.pressure = specification.pressure;
  read_void_ratio(top, specification);
  read_accuracy(top, specification.accuracy);
  read_stages(top, specification, faults);
  top.finish();
  std::ranges::stable_sort(faults, {}, [](const Fault& fault) { return std::pair(fault.file, fault.line); });
  if (!faults.empty()) throw InputError(faults);
  return specification;
}

}  // namespace polargrain::app
