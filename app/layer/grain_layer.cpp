// SPDX-License-Identifier: GPL-2.0-or-later
#include "app/layer/grain_layer.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <sstream>

#include "app/commands/in_child.hpp"
#include "band/frames.hpp"
#include "common/csv_table.hpp"
#include "common/error.hpp"
#include "common/words.hpp"
#include "common/write_file.hpp"
#include "coupler/case/data_files.hpp"
#include "coupler/case/document_kind.hpp"
#include "coupler/pool/log_excerpt.hpp"
#include "grains_io/packing_data.hpp"

namespace polargrain::app {
namespace {

constexpr double kRoom = 0.3;  ///< above and below, heights
/// Drag while what the cut surfaces have lost comes to rest, of the critical one of a grain on a contact.
constexpr double kDrag = 0.06;

bool has(const std::vector<std::string>& words, const std::string& word) {
  return std::ranges::find(words, word) != words.end();
}

/// The modulus that a fix property/global gives to contacts of grains of one type; 0 for another line.
double modulus_of(const std::vector<std::string>& words) {
  if (words.size() < 5 || (words[4] != "contactModulus" && words[4] != "youngsModulus")) return 0.0;
  try {
    return std::stod(words.back());
  } catch (const std::exception&) {  // a variable
    return 0.0;
  }
}

double height_of(const Packing& packing) {
  return packing.box.determinant() / packing.box.col(0).norm();
}

/// The packing as a data file, with room above and below.
void open_packing(const Packing& packing, const std::filesystem::path& file) {
  const double height = height_of(packing);
  std::istringstream in(packing_data(packing));
  std::string text;
  for (std::string line; std::getline(in, line);) {
    if (line.ends_with("ylo yhi"))
      line = fmt::format("{:.17g} {:.17g} ylo yhi", -kRoom * height, (1.0 + kRoom) * height);
    // A box that is open above and below has no tilt along them. Across the depth images of spheres stay where they are.
    if (line.ends_with("xy xz yz")) {
      if (packing.dimension == 2) continue;
      line.replace(0, line.find(' '), "0");
    }
    text += line + '\n';
  }
  write_file(file, text);
}

}  // namespace

LayerScript layer_script(const std::string& script, const std::string& file) {
  LayerScript made;
  made.text = "# Made by polargrain layer of the script of a cell, " + file + "\nsuffix fast\n";
  const auto fail = [&](int line, const std::string& message) { throw InputError({file, line, message}); };
  for (const ScriptCommand& command : commands_of_script(script, file)) {
    std::vector<std::string> words = words_of(command.text);
    if (words.empty()) continue;
    if (words[0] == "dimension") {
      made.spheres = has(words, "3");
      made.dimension_line = command.line;
    }
    if (const double modulus = modulus_of(words); modulus > 0.0) made.modulus = modulus;
    if (words[0] == "boundary") words = {"boundary", "p", "f", "p"};
    // The layer integrates its grains itself.
    if (has(words, "nve/sphere") || has(words, "enforce2d")) continue;
    if (words[0] == "pair_style" && has(words, "hooke/radii") && !has(words, "damping")) {
      made.text += "fix contact_damping all property/global contactDampingRatio peratomtypepair 1 0.2\n";
      words.insert(words.end(), {"damping", "on"});
    }
    for (const std::string& word : words) made.text += word + ' ';
    made.text += '\n';
  }
  if (!(made.modulus > 0.0))
    fail(
        0,
        "gives no number for contactModulus or youngsModulus, which the plates of a layer are damped by; write it "
        "out in a line 'fix ID all property/global'");
  if (!made.spheres) made.text += "fix plane all enforce2d\n";
  const auto shear = coupler::find_data_file("specimen/layer_shear.in", {});
  if (!shear)
    fail(0, "specimen/layer_shear.in, which the program brings along, is not there; install it whole");
  made.text += "include " + std::filesystem::absolute(*shear).string() + "\n";
  return made;
}

void refuse_turned_bedding(const PackingSpecification& specification, const std::filesystem::path& file,
                           const std::vector<std::string>& settings) {
  if (!specification.deposition || specification.deposition->bedding_angle == 0.0) return;
  const coupler::Entry document = coupler::load_document_of(coupler::DocumentKind::packing, file, settings);
  throw InputError(
      document.find("deposition")
          ->find("bedding_angle")
          ->fault("bedding_angle: grains are sheared along their bedding planes here, the angle would "
                  "have no effect; leave it out"));
}

void shear_layer(const Packing& packing, const LayerScript& script, const LayerShear& shear,
                 const std::filesystem::path& folder, const PackingTools& tools, bool quiet) {
  const double depth = kPlateDepth * packing.mean_radius();
  shear_between(packing, {depth, height_of(packing) - depth}, script, shear, folder, tools, quiet);
}

void shear_between(const Packing& packing, const Plates& plates, const LayerScript& script,
                   const LayerShear& shear, const std::filesystem::path& folder, const PackingTools& tools,
                   bool quiet) {
  if (std::filesystem::exists(folder / "done")) return;
  std::filesystem::remove_all(folder);
  std::filesystem::create_directories(folder / "grains");
  const std::filesystem::path place = std::filesystem::absolute(folder);
  open_packing(packing, place / "layer.data");
  write_file(place / "layer.in", script.text);
  const double radius = packing.mean_radius();
  double mass = 0.0;
  for (const Grain& grain : packing.grains) mass += grain.mass / static_cast<double>(packing.grains.size());
  // Discs have unit thickness in the engine: mass and force per thickness belong together.
  const double critical = 2.0 * std::sqrt(script.modulus * radius * mass);
  const std::vector<std::pair<std::string, double>> variables{
      {"low", plates.low},
      {"high", plates.high},
      {"rest", static_cast<double>(shear.rest)},
      {"frames", std::ceil(shear.shear / shear.frame - 1e-9)},
      {"frame", shear.frame},
      {"rate", shear.inertial_number / (2.0 * radius) * std::sqrt(shear.pressure / shear.density)},
      {"pressure", shear.pressure},
      {"modulus", script.modulus},
      {"thickness", packing.thickness},
      {"drag", kDrag * critical}};
  std::vector<std::string> words{"polargrain layer",
                                 "-in",
                                 (place / "layer.in").string(),
                                 "-log",
                                 "none",
                                 "-var",
                                 "packing",
                                 (place / "layer.data").string(),
                                 "-var",
                                 "folder",
                                 place.string()};
  for (const auto& [name, value] : variables)
    words.insert(words.end(), {"-var", name, fmt::format("{:.10g}", value)});
  const std::filesystem::path log = place / "log.txt";
  const auto work = [&](ProgressLine&) {
    if (tools.run_script(words) != 0) throw RunError("the engine ended with an error");
  };
  if (!run_in_child(log, work, !quiet))
    throw RunError(fmt::format("the layer could not be sheared (the engine's output is in {}):\n{}",
                               log.string(), coupler::log_excerpt(log)));
  write_file(place / "done", "");
}

Shearing read_layer(const std::filesystem::path& folder, double pressure) {
  const CsvTable history(folder / "history.csv");
  Shearing shearing;
  shearing.displacements = history.numbers("displacement");
  for (const double stress : history.numbers("shear_stress")) shearing.ratios.push_back(stress / pressure);
  const std::vector<double> steps = history.numbers("step");
  for (const auto& [step, file] : band::frame_files(folder / "grains", ".dump")) {
    const auto row = std::ranges::find(steps, static_cast<double>(step));
    if (row == steps.end() && step != 0) continue;  // no row was written yet
    const band::Frame dump = band::read_grain_dump(file);
    Shearing::Frame frame;
    frame.displacement =
        row == steps.end() ? 0.0 : shearing.displacements[static_cast<std::size_t>(row - steps.begin())];
    const auto count = static_cast<Eigen::Index>(dump.positions.size());
    frame.heights.resize(count);
    frame.along.resize(count);
    frame.rotations.resize(count);
    for (Eigen::Index k = 0; k < count; ++k) {
      frame.heights[k] = dump.positions[static_cast<std::size_t>(k)].y();
      frame.along[k] = dump.positions[static_cast<std::size_t>(k)].x();
      frame.rotations[k] = dump.rotations[static_cast<std::size_t>(k)];
    }
    shearing.frames.push_back(std::move(frame));
  }
  return shearing;
}

}  // namespace polargrain::app
