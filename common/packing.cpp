// SPDX-License-Identifier: GPL-2.0-or-later
#include "common/packing.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <Eigen/LU>
#include <array>
#include <charconv>
#include <cmath>
#include <numbers>
#include <optional>
#include <set>
#include <string>
#include <string_view>

#include "common/csv_table.hpp"
#include "common/packing_file.hpp"

namespace polargrain {

namespace {

constexpr std::string_view kColumns = "id,x,y,r,mass,Izz";
constexpr std::string_view kColumnsInSpace = "id,x,y,z,r,mass,Izz";

/// The value behind "key=" in the header line.
std::optional<double> header_value(std::string_view line, std::string_view key) {
  const std::string wanted = fmt::format(" {}=", key);
  const std::size_t place = line.find(wanted);
  if (place == std::string_view::npos) return std::nullopt;
  std::string_view text = line.substr(place + wanted.size());
  text = text.substr(0, text.find_first_of(" \t\r"));
  double value = 0.0;
  const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), value);
  if (error != std::errc{} || end != text.data() + text.size()) return std::nullopt;
  return value;
}

class Reader {
 public:
  explicit Reader(const std::filesystem::path& file) : table_(file) {}

  Packing read() {
    const std::string names = fmt::format("{}", fmt::join(table_.names(), ","));
    if (names == kColumnsInSpace) packing_.dimension = 3;
    read_header();
    if (names != kColumns && names != kColumnsInSpace)
      table_.fail(
          table_.line_of_names(),
          fmt::format("expected the column names '{}', of spheres in space '{}'", kColumns, kColumnsInSpace));
    for (std::size_t row = 0; row < table_.rows(); ++row) read_grain(row);
    if (packing_.grains.empty()) table_.fail(table_.line_of_names(), "the packing has no grains");
    return packing_;
  }

 private:
  void read_header() {
    const std::string line = table_.comments().empty() ? "" : table_.comments().front();
    const auto value_of = [&](std::string_view key, std::string_view expected) {
      const std::optional<double> value = header_value(line, key);
      if (!value || !std::isfinite(*value))
        table_.fail(
            1, fmt::format("expected the cell's base vectors as '# cell {}' in m; '{}=' is missing or not "
                           "a number",
                           expected, key));
      return *value;
    };
    const bool space = packing_.dimension == 3;
    constexpr std::string_view kPlane = "xx=... xy=... yx=... yy=... z=...";
    constexpr std::string_view kSpace = "xx=... xy=... xz=... yx=... yy=... yz=... zx=... zy=... zz=...";
    const auto value = [&](std::string_view key) { return value_of(key, space ? kSpace : kPlane); };
    // One by one: a list of values that is left by an exception half way is an error of its own for Eigen.
    packing_.box(0, 0) = value("xx");
    packing_.box(0, 1) = value("xy");
    packing_.box(1, 0) = value("yx");
    packing_.box(1, 1) = value("yy");
    packing_.thickness = value(space ? "zz" : "z");
    if (const std::optional<double> pressure = header_value(line, "p")) {
      if (!(*pressure > 0.0)) table_.fail(1, "the pressure p must be positive, or left out");
      packing_.pressure = *pressure;
    }
    if (space) {
      packing_.lean(0) = value("xz");
      packing_.lean(1) = value("yz");
      if (value("zx") != 0.0 || value("zy") != 0.0)
        table_.fail(
            1,
            "the first two base vectors of a packing in space must lie in the plane of x and y: zx and zy "
            "must be 0; turn the packing");
    }
    if (!(packing_.box.determinant() > 0.0))
      table_.fail(1, "the base vectors span no area (or are left-handed)");
    if (!(packing_.thickness > 0.0)) table_.fail(1, "the thickness z must be positive");
  }

  void read_grain(std::size_t row) {
    std::array<double, 7> values{};
    const bool space = packing_.dimension == 3;
    for (std::size_t k = 0; k < values.size(); ++k)
      values[k] = space ? table_.number(row, k) : k == 3 ? 0.0 : table_.number(row, k > 3 ? k - 1 : k);
    const auto fail = [&](const std::string& message) { table_.fail(table_.line_of(row), message); };
    Grain grain;
    grain.position = {values[1], values[2]};
    grain.height = values[3];
    grain.radius = values[4];
    grain.mass = values[5];
    grain.moment_of_inertia = values[6];
    if (!(values[0] >= 0.0 && values[0] <= 2e9) || std::floor(values[0]) != values[0])
      fail("the id must be a whole number from 0 to 2e9");
    grain.id = static_cast<std::int64_t>(values[0]);
    if (!ids_.insert(grain.id).second) fail(fmt::format("grain {} stands here a second time", grain.id));
    if (!(grain.radius > 0.0)) fail("the radius must be positive");
    if (!(grain.mass > 0.0)) fail("the mass must be positive");
    packing_.grains.push_back(grain);
  }

  CsvTable table_;
  Packing packing_;
  std::set<std::int64_t> ids_;
};

}  // namespace

Eigen::Matrix3d Packing::base_vectors() const {
  Eigen::Matrix3d columns = Eigen::Matrix3d::Zero();
  columns.topLeftCorner<2, 2>() = box;
  columns.topRightCorner<2, 1>() = lean;
  columns(2, 2) = thickness;
  return columns;
}

double Packing::grain_volume() const {
  double sum = 0.0;
  for (const Grain& grain : grains) {
    const double area = std::numbers::pi * grain.radius * grain.radius;
    sum += area * (dimension == 3 ? 4.0 / 3.0 * grain.radius : thickness);
  }
  return sum;
}

double Packing::grain_mass() const {
  double sum = 0.0;
  for (const Grain& grain : grains) sum += grain.mass;
  return sum;
}

double Packing::mean_radius() const {
  double sum = 0.0;
  for (const Grain& grain : grains) sum += grain.radius;
  return sum / static_cast<double>(grains.size());
}

Packing read_packing(const std::filesystem::path& file) {
  if (file.extension() == ".h5") return read_packing_file(file).packing;
  return Reader(file).read();
}

}  // namespace polargrain
