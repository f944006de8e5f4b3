// SPDX-License-Identifier: GPL-2.0-or-later
#include "app/remarks/formula_units.hpp"

#include <fmt/format.h>

#include <cctype>
#include <charconv>
#include <string_view>

namespace polargrain::app {
namespace {

/// Recursive descent as in coupler/case/expression.cpp, over dimensions in place of numbers.
class UnitsReader {
 public:
  UnitsReader(const std::string& text, const std::function<Powers(const std::string&)>& powers)
      : text_(text), powers_(powers) {
    out.result = sum().powers;
  }
  FormulaUnits out;

 private:
  struct Part {
    Powers powers{};
    bool plain = false;  ///< a number without a unit, which may stand for anything
  };

  Part sum() {
    Part left = product();
    for (char c = peek(); c == '+' || c == '-'; c = peek()) {
      ++at_;
      const Part right = product();
      if (left.powers != right.powers && !left.plain && !right.plain && out.clash.empty())
        out.clash = fmt::format("{} and {}", text_of(left.powers), text_of(right.powers));
      if (left.plain) left = right;
    }
    return left;
  }

  Part product() {
    Part left = factor();
    for (char c = peek(); c == '*' || c == '/'; c = peek()) {
      ++at_;
      const Part right = factor();
      for (std::size_t i = 0; i < 3; ++i) left.powers[i] += c == '*' ? right.powers[i] : -right.powers[i];
      left.plain = left.plain && right.plain;
    }
    return left;
  }

  Part factor() {
    const char c = peek();
    if (c == '-' || c == '+') {
      ++at_;
      return factor();
    }
    if (c == '(') {
      ++at_;
      const Part inner = sum();
      ++at_;  // ')'
      return inner;
    }
    if (std::isdigit(static_cast<unsigned char>(c)) != 0 || c == '.') return number();
    const std::size_t start = at_;
    while (at_ < text_.size() &&
           (std::isalnum(static_cast<unsigned char>(text_[at_])) != 0 || text_[at_] == '_'))
      ++at_;
    if (at_ == start) ++at_;  // no formula after all
    return {powers_(text_.substr(start, at_ - start)), false};
  }

  Part number() {
    const std::size_t start = at_;
    double value = 0.0;
    const auto [end, error] = std::from_chars(text_.data() + at_, text_.data() + text_.size(), value);
    at_ = error == std::errc() ? static_cast<std::size_t>(end - text_.data()) : at_ + 1;
    const std::size_t digits = at_;
    const auto unit = coupler::unit_ahead(std::string_view(text_).substr(skipped()));
    FormulaNumber found{text_.substr(start, digits - start), value, unit.has_value(), value == 1.0,
                        coupler::Dimension::number};
    if (unit) {
      at_ = skipped() + unit->length;
      found.text = text_.substr(start, at_ - start);
      found.value = value * unit->factor;
      found.dimension = unit->dimension;
    }
    out.numbers.push_back(found);
    return {powers_of(found.dimension), !unit};
  }

  [[nodiscard]] std::size_t skipped() const {
    std::size_t at = at_;
    while (at < text_.size() && std::isspace(static_cast<unsigned char>(text_[at])) != 0) ++at;
    return at;
  }
  char peek() {
    at_ = skipped();
    return at_ < text_.size() ? text_[at_] : '\0';
  }

  const std::string& text_;
  const std::function<Powers(const std::string&)>& powers_;
  std::size_t at_ = 0;
};

}  // namespace

Powers powers_of(coupler::Dimension dimension) {
  switch (dimension) {
    case coupler::Dimension::length:
      return {0, 1, 0};
    case coupler::Dimension::pressure:
      return {1, -2, 0};
    case coupler::Dimension::force:
      return {1, 0, 0};
    case coupler::Dimension::force_per_length:
      return {1, -1, 0};
    case coupler::Dimension::moment:
      return {1, 1, 0};
    case coupler::Dimension::unit_weight:
      return {1, -3, 0};
    case coupler::Dimension::duration:
      return {0, 0, 1};
    case coupler::Dimension::flow:
      return {0, 1, -1};
    default:
      return {};
  }
}

Powers powers_of(const coupler::Monitor& monitor, int dimension) {
  if (monitor.kind == coupler::Monitor::Kind::structure) {
    const std::string& value = monitor.value;
    if (value == "mobilised") return {};
    if (value == "lever" || value == "slip" || value == "gap") return {0, 1, 0};
    return dimension == 3 || value == "moment" ? Powers{1, 0, 0} : Powers{1, -1, 0};
  }
  if (monitor.kind == coupler::Monitor::Kind::place) {
    if (monitor.component.unit == "Pa") return {1, -2, 0};
    if (monitor.component.unit == "N/m") return {1, -1, 0};
    return monitor.component.unit == "m" ? Powers{0, 1, 0} : Powers{};
  }
  if (monitor.kind == coupler::Monitor::Kind::water) {
    if (monitor.value == "pressure") return {1, -2, 0};
    return {0, dimension, monitor.value == "flow" ? -1 : 0};
  }
  const bool angle = fem::is_rotation(monitor.dof);
  if (monitor.kind == coupler::Monitor::Kind::displacement) return angle ? Powers{} : Powers{0, 1, 0};
  if (dimension == 3) return angle ? Powers{1, 1, 0} : Powers{1, 0, 0};
  return angle ? Powers{1, 0, 0} : Powers{1, -1, 0};  // of a metre of thickness
}

std::string text_of(const Powers& powers) {
  if (powers == Powers{1, -2, 0}) return "Pa";
  if (powers == Powers{1, -1, 0}) return "N/m";
  constexpr std::array kNames{"N", "m", "s"};
  std::string text;
  for (std::size_t i = 0; i < 3; ++i) {
    if (powers[i] == 0) continue;
    text += fmt::format("{}{}", text.empty() ? "" : " ", kNames[i]);
    if (powers[i] != 1) text += std::to_string(powers[i]);
  }
  return text.empty() ? "a plain number" : text;
}

FormulaUnits units_of_formula(const std::string& formula,
                              const std::function<Powers(const std::string&)>& powers) {
  return UnitsReader(formula, powers).out;
}

}  // namespace polargrain::app
