// SPDX-License-Identifier: GPL-2.0-or-later
#include "common/packing.hpp"

#include <fmt/format.h>

#include <Eigen/LU>
#include <array>
#include <charconv>
#include <cmath>
#include <fstream>
#include <optional>
#include <set>
#include <string>
#include <string_view>

#include "common/error.hpp"
#include "common/packing_file.hpp"

namespace polargrain {

namespace {

constexpr std::string_view kColumns = "id,x,y,r,mass,Izz";

std::string_view trimmed(std::string_view text) {
  const auto is_space = [](char c) { return c == ' ' || c == '\t' || c == '\r'; };
  while (!text.empty() && is_space(text.front())) text.remove_prefix(1);
  while (!text.empty() && is_space(text.back())) text.remove_suffix(1);
  return text;
}

template <typename Number>
std::optional<Number> number(std::string_view text) {
  text = trimmed(text);
  Number value{};
  const auto result = std::from_chars(text.data(), text.data() + text.size(), value);
  if (result.ec != std::errc{} || result.ptr != text.data() + text.size()) return std::nullopt;
  return value;
}

/// The value behind "key=" in the header line.
std::optional<double> header_value(std::string_view line, std::string_view key) {
  const std::string wanted = fmt::format(" {}=", key);
  const std::size_t place = line.find(wanted);
  if (place == std::string_view::npos) return std::nullopt;
  const std::string_view rest = line.substr(place + wanted.size());
  return number<double>(rest.substr(0, rest.find(' ')));
}

class Reader {
 public:
  explicit Reader(const std::filesystem::path& file) : file_(file), stream_(file) {
    if (!stream_)
      fail(0, "cannot be read: no such file, or no permission; a packing is a CSV file of grains");
  }

  Packing read() {
    read_header();
    if (!next() || trimmed(line_) != kColumns)
      fail(line_number_, fmt::format("expected the column names '{}'", kColumns));
    while (next())
      if (!trimmed(line_).empty()) read_grain();
    if (packing_.grains.empty()) fail(line_number_, "the packing has no grains");
    return packing_;
  }

 private:
  [[noreturn]] void fail(int line, const std::string& message) const {
    throw InputError({file_.string(), line, message});
  }

  bool next() {
    ++line_number_;
    return static_cast<bool>(std::getline(stream_, line_));
  }

  void read_header() {
    next();
    std::array<double, 5> values{};
    constexpr std::array<std::string_view, 5> keys{"xx", "xy", "yx", "yy", "z"};
    for (std::size_t k = 0; k < keys.size(); ++k) {
      const std::optional<double> value = header_value(line_, keys[k]);
      if (!value || !std::isfinite(*value))
        fail(1, fmt::format(
                    "expected the cell's base vectors as '# cell xx=... xy=... yx=... yy=... z=...' in m; "
                    "'{}=' is missing or not a number",
                    keys[k]));
      values[k] = *value;
    }
    if (const std::optional<double> pressure = header_value(line_, "p")) {
      if (!(*pressure > 0.0)) fail(1, "the pressure p must be positive, or left out");
      packing_.pressure = *pressure;
    }
    packing_.box << values[0], values[1], values[2], values[3];
    packing_.thickness = values[4];
    if (!(packing_.box.determinant() > 0.0)) fail(1, "the base vectors span no area (or are left-handed)");
    if (!(packing_.thickness > 0.0)) fail(1, "the thickness z must be positive");
  }

  void read_grain() {
    std::array<double, 6> values{};
    std::string_view rest = line_;
    for (std::size_t k = 0; k < values.size(); ++k) {
      const std::size_t comma = rest.find(',');
      if ((comma == std::string_view::npos) != (k + 1 == values.size()))
        fail(line_number_, fmt::format("expected {} values '{}'", values.size(), kColumns));
      const std::optional<double> value = number<double>(rest.substr(0, comma));
      if (!value || !std::isfinite(*value))
        fail(line_number_, fmt::format("'{}' is not a number", trimmed(rest.substr(0, comma))));
      values[k] = *value;
      rest = comma == std::string_view::npos ? std::string_view{} : rest.substr(comma + 1);
    }
    Grain grain;
    grain.id = static_cast<std::int64_t>(values[0]);
    grain.position = {values[1], values[2]};
    grain.radius = values[3];
    grain.mass = values[4];
    grain.moment_of_inertia = values[5];
    if (static_cast<double>(grain.id) != values[0] || grain.id < 0 || grain.id > 2'000'000'000)
      fail(line_number_, "the id must be a whole number from 0 to 2e9");
    if (!ids_.insert(grain.id).second)
      fail(line_number_, fmt::format("grain {} stands here a second time", grain.id));
    if (!(grain.radius > 0.0)) fail(line_number_, "the radius must be positive");
    if (!(grain.mass > 0.0)) fail(line_number_, "the mass must be positive");
    packing_.grains.push_back(grain);
  }

  std::filesystem::path file_;
  std::ifstream stream_;
  std::string line_;
  int line_number_ = 0;
  Packing packing_;
  std::set<std::int64_t> ids_;
};

}  // namespace

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
