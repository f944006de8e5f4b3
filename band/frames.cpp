// SPDX-License-Identifier: GPL-2.0-or-later
#include "band/frames.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <charconv>
#include <cmath>
#include <fstream>
#include <map>
#include <stdexcept>

#include "band/local_strain.hpp"
#include "common/csv_table.hpp"
#include "common/error.hpp"
#include "common/plain_text.hpp"
#include "common/regular_file.hpp"
#include "common/words.hpp"

namespace polargrain::band {
namespace {

[[noreturn]] void fail(const std::filesystem::path& file, int line, const std::string& message) {
  throw InputError({file.string(), line, message});
}

double number(const std::string& word, const std::filesystem::path& file, int line) {
  try {
    std::size_t end = 0;
    const double value = std::stod(word, &end);
    if (std::isfinite(value) && (end == word.size() || word[end] == '\r')) return value;
  } catch (const std::exception&) {
  }
  fail(file, line, fmt::format("'{}' is no number", plain_text(word)));
}

std::map<long, double> read_strains(const std::filesystem::path& file, const std::string& column) {
  const CsvTable history(file);
  const std::vector<double> steps = history.numbers("step");
  const std::vector<double> of_rows = history.numbers(column);
  std::map<long, double> strains{{0, 0.0}};
  for (std::size_t row = 0; row < steps.size(); ++row) strains[std::lround(steps[row])] = of_rows[row];
  return strains;
}

}  // namespace

std::map<long, std::filesystem::path> frame_files(const std::filesystem::path& folder,
                                                  const std::string& extension) {
  std::map<long, std::filesystem::path> files;
  std::error_code error;
  for (const auto& entry : std::filesystem::directory_iterator(folder, error)) {
    const std::string stem = entry.path().stem().string();
    if (entry.path().extension() != extension || stem.rfind("step-", 0) != 0) continue;
    long step = 0;
    const char* const end = stem.data() + stem.size();
    if (std::from_chars(stem.data() + 5, end, step).ptr == end) files[step] = entry.path();
  }
  return files;
}

Frame read_grain_dump(const std::filesystem::path& file) {
  if (const std::string reason = why_no_input(file); !reason.empty()) fail(file, 0, reason);
  std::ifstream in(file);
  std::string line;
  int number_of_line = 0;
  const std::string head = "ITEM: ATOMS ";
  do {
    ++number_of_line;
    if (!std::getline(in, line)) fail(file, 0, "a LIGGGHTS dump with a line 'ITEM: ATOMS ...' was expected");
  } while (line.rfind(head, 0) != 0);
  const std::vector<std::string> names = words_of(line.substr(head.size()));
  const auto place = [&](const std::string& name) {
    const auto found = std::find(names.begin(), names.end(), name);
    if (found == names.end()) fail(file, number_of_line, fmt::format("the dump has no column '{}'", name));
    return static_cast<std::size_t>(found - names.begin());
  };
  const std::size_t id = place("id");
  // Positions that go on over periodic sides, where there are any.
  const std::size_t x = place(std::ranges::find(names, "xu") == names.end() ? "x" : "xu");
  const std::size_t y = place("y");
  const std::size_t turned = place("f_turned");
  std::map<long, std::array<double, 3>> grains;
  while (std::getline(in, line)) {
    ++number_of_line;
    const std::vector<std::string> words = words_of(line);
    if (words.size() < names.size()) fail(file, number_of_line, "this line is short of columns");
    const auto value = [&](std::size_t column) { return number(words[column], file, number_of_line); };
    grains[std::lround(value(id))] = {value(x), value(y), value(turned)};
  }
  Frame frame;
  for (const auto& [name, grain] : grains) {
    frame.positions.emplace_back(grain[0], grain[1]);
    frame.rotations.push_back(grain[2]);
  }
  return frame;
}

Frames::Frames(const std::filesystem::path& directory, const std::string& strain_column,
               const FieldUnits& units, double radius)
    : units_(units), radius_(radius) {
  std::map<long, std::filesystem::path> files = frame_files(directory / "grains", ".dump");
  if (!files.empty()) kind_ = FrameKind::grains;
  if (files.empty()) {
    files = frame_files(directory / "displacements", ".csv");
    if (!files.empty()) {
      kind_ = FrameKind::images;
      files.try_emplace(0);  // the reference image: nothing has moved
    }
  }
  if (files.empty()) files = frame_files(directory / "fields", ".vtu");
  if (files.size() < 2)
    fail(directory, 0,
         "a result directory with at least two frames was expected: fields/step-*.vtu, grains/step-*.dump or "
         "displacements/step-*.csv");
  const std::filesystem::path history = directory / "history.csv";
  const std::map<long, double> strains = read_strains(history, strain_column);
  for (const auto& [step, file] : files) {
    const auto strain = strains.find(step);
    if (strain == strains.end())
      fail(history, 0, fmt::format("there is no row of step {}, which {} is of", step, file.string()));
    if (!axial_strains_.empty() && strain->second <= axial_strains_.back())
      continue;  // going back, or at rest
    axial_strains_.push_back(strain->second);
    files_.push_back(file);
  }
  if (files_.size() < 2)
    fail(history, 0, fmt::format("'{}' does not grow from frame to frame", strain_column));
}

std::size_t Frames::nearest(double axial_strain) const {
  std::size_t best = 0;
  for (std::size_t k = 1; k < axial_strains_.size(); ++k)
    if (std::abs(axial_strains_[k] - axial_strain) < std::abs(axial_strains_[best] - axial_strain)) best = k;
  return best;
}

Frame Frames::read(std::size_t index) const {
  return kind_ == FrameKind::grains ? read_grain_dump(files_[index]) : read_element_fields(files_[index]);
}

Samples Frames::grains(const Frame& first, const Frame& from, const Frame& to, bool current) const {
  const std::size_t count = from.positions.size();
  if (count == 0 || to.positions.size() != count || first.positions.size() != count)
    fail(files_.back(), 0, "the dumps do not hold the same grains");
  std::vector<Eigen::Vector2d> displacements;
  for (std::size_t k = 0; k < count; ++k) displacements.push_back(to.positions[k] - from.positions[k]);
  const double area = mean_area(from.positions);
  if (!(area > 0.0 && std::isfinite(area))) fail(files_.back(), 0, "the grains fill no area");
  const std::vector<Eigen::Matrix2d> gradients = displacement_gradients(
      from.positions, displacements, radius_ > 0.0 ? radius_ : kNeighbourhood * std::sqrt(area));
  Samples samples;
  for (std::size_t k = 0; k < count; ++k)
    if (gradients[k].allFinite())  // a grain that was lost from the rest has no strain
      samples.push_back({current ? from.positions[k] : first.positions[k], area, shear_strain(gradients[k]),
                         gradients[k].trace(), to.rotations[k] - from.rotations[k]});
  return samples;
}

FieldIncrement Frames::between(std::size_t from, std::size_t to) const {
  const DisplacementField end = read_displacement_field(files_[to], units_);
  if (files_[from].empty()) return increment_between(nullptr, end);
  const DisplacementField start = read_displacement_field(files_[from], units_);
  return increment_between(&start, end);
}

std::size_t Frames::missing(std::size_t from, std::size_t to) const {
  return kind_ == FrameKind::images ? between(from, to).missing : 0;
}

Samples Frames::increment(std::size_t from, std::size_t to, bool current) const {
  if (kind_ == FrameKind::images) {
    try {
      return samples_of(between(from, to), radius_, current);
    } catch (const std::invalid_argument& error) {
      fail(files_[to], 0, error.what());
    }
  }
  const Frame start = read(from);
  const Frame end = read(to);
  if (kind_ == FrameKind::grains) return grains(from == 0 ? start : read(0), start, end, current);
  if (start.positions.size() != end.positions.size())
    fail(files_[to], 0, "the mesh differs from the frame before");
  Samples samples;
  for (std::size_t k = 0; k < start.positions.size(); ++k) {
    const Eigen::Matrix2d strain = end.strains[k] - start.strains[k];
    samples.push_back({start.positions[k] + (current ? start.displacements[k] : Eigen::Vector2d::Zero()),
                       start.areas[k], shear_strain(strain), strain.trace(),
                       end.rotations[k] - start.rotations[k]});
  }
  return samples;
}

}  // namespace polargrain::band
