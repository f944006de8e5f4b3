// SPDX-License-Identifier: GPL-2.0-or-later
#include "coupler/case/expression.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cctype>
#include <charconv>
#include <stdexcept>
#include <string_view>

#include "coupler/case/quantity.hpp"

namespace polargrain::coupler {

/// Recursive descent; fills an Expression.
class ExpressionParser {
 public:
  ExpressionParser(const std::string& text, Expression& into) : text_(text), into_(into) {
    sum();
    if (peek() == '^') wrong("there are no powers, write x * x: expected one of + - * /");
    if (peek() == '(' && is_after_name()) wrong("there are no functions: expected one of + - * /");
    if (peek() != '\0') wrong("expected an operator, one of + - * /,");
  }

 private:
  void sum() {
    product();
    for (char c = peek(); c == '+' || c == '-'; c = peek()) {
      ++at_;
      product();
      into_.steps_.push_back({c});
    }
  }

  void product() {
    factor();
    for (char c = peek(); c == '*' || c == '/'; c = peek()) {
      ++at_;
      factor();
      into_.steps_.push_back({c});
    }
  }

  void factor() {
    // Bounds the recursion by parentheses and signs.
    if (++depth_ > 100) wrong("nested too deeply");
    const char c = peek();
    if (c == '-' || c == '+') {
      ++at_;
      factor();
      if (c == '-') into_.steps_.push_back({'~'});
    } else if (c == '(') {
      ++at_;
      sum();
      if (peek() != ')') wrong("expected ')'");
      ++at_;
    } else if (std::isdigit(static_cast<unsigned char>(c)) != 0 || c == '.') {
      number();
    } else if (is_letter(c)) {
      const std::string name = word();
      into_.steps_.push_back({'v', 0.0, name});
      if (std::find(into_.names_.begin(), into_.names_.end(), name) == into_.names_.end()) {
        into_.names_.push_back(name);
      }
    } else {
      wrong("expected a number, a name or '('");
    }
    --depth_;
  }

  void number() {
    double value = 0.0;
    const auto [end, error] = std::from_chars(text_.data() + at_, text_.data() + text_.size(), value);
    if (error != std::errc()) wrong("expected a number");
    at_ = static_cast<std::size_t>(end - text_.data());
    if (const char c = peek(); is_letter(c) || c == '%') {
      const std::size_t start = at_;
      const auto unit = unit_ahead(std::string_view(text_).substr(at_));
      if (!unit) {
        const std::string text = word();
        at_ = start;
        wrong(fmt::format("'{}' is no unit ({})", text, all_units()));
      }
      at_ += unit->length;
      value *= unit->factor;
    }
    into_.steps_.push_back({'n', value});
  }

  std::string word() {
    const std::size_t start = at_;
    while (at_ < text_.size() &&
           (is_letter(text_[at_]) || std::isdigit(static_cast<unsigned char>(text_[at_])) != 0)) {
      ++at_;
    }
    return text_.substr(start, at_ - start);
  }

  [[nodiscard]] bool is_after_name() const { return at_ > 0 && is_letter(text_[at_ - 1]); }

  static bool is_letter(char c) { return std::isalpha(static_cast<unsigned char>(c)) != 0 || c == '_'; }

  char peek() {
    while (at_ < text_.size() && std::isspace(static_cast<unsigned char>(text_[at_])) != 0) ++at_;
    return at_ < text_.size() ? text_[at_] : '\0';
  }

  [[noreturn]] void wrong(const std::string& message) const {
    throw std::invalid_argument(fmt::format("{} at character {} of '{}'", message, at_ + 1, text_));
  }

  const std::string& text_;
  Expression& into_;
  std::size_t at_ = 0;
  int depth_ = 0;
};

Expression::Expression(const std::string& text) : text_(text) {
  ExpressionParser(text, *this);
}

double Expression::evaluate(const std::function<double(const std::string&)>& value_of) const {
  std::vector<double> stack;
  const auto pop = [&] {
    const double value = stack.back();
    stack.pop_back();
    return value;
  };
  for (const Step& step : steps_) {
    if (step.operation == 'n') {
      stack.push_back(step.number);
    } else if (step.operation == 'v') {
      stack.push_back(value_of(step.name));
    } else if (step.operation == '~') {
      stack.back() = -stack.back();
    } else {
      const double right = pop();
      double& left = stack.back();
      switch (step.operation) {
        case '+':
          left += right;
          break;
        case '-':
          left -= right;
          break;
        case '*':
          left *= right;
          break;
        default:
          left /= right;
      }
    }
  }
  return stack.back();
}

}  // namespace polargrain::coupler
