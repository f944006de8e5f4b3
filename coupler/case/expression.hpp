// SPDX-License-Identifier: GPL-2.0-or-later
#pragma once
#include <functional>
#include <string>
#include <vector>

namespace polargrain::coupler {

/// A formula of a monitor: numbers (with units, turned into SI), names of other values, + - * / and
/// parentheses. For example `-top_force / (40 mm * 100 kPa)`.
class Expression {
 public:
  /// @throws std::invalid_argument with the fault and its place
  explicit Expression(const std::string& text);

  [[nodiscard]] const std::string& text() const { return text_; }

  /// Names that appear in it, each once, in order.
  [[nodiscard]] const std::vector<std::string>& names() const { return names_; }

  /// @param value_of gives the value of a name. @returns the value; a division by zero follows IEEE.
  [[nodiscard]] double evaluate(const std::function<double(const std::string&)>& value_of) const;

 private:
  friend class ExpressionParser;
  /// In postfix order: operands before their operator.
  struct Step {
    char operation;  ///< '+', '-', '*', '/', '~' (change of sign), 'n' (number), 'v' (name)
    double number = 0.0;
    std::string name = {};
  };
  std::string text_;
  std::vector<Step> steps_;
  std::vector<std::string> names_;
};

}  // namespace polargrain::coupler
