// SPDX-License-Identifier: GPL-2.0-or-later
#include "coupler/case/section.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cctype>
#include <charconv>
#include <cmath>
#include <map>
#include <numbers>
#include <numeric>
#include <sstream>

namespace polargrain::coupler {
namespace {

/// Levenshtein's distance.
std::size_t distance(const std::string& a, const std::string& b) {
  std::vector<std::size_t> row(b.size() + 1);
  std::iota(row.begin(), row.end(), std::size_t{0});
  for (std::size_t i = 1; i <= a.size(); ++i) {
    std::size_t diagonal = row[0];
    row[0] = i;
    for (std::size_t j = 1; j <= b.size(); ++j) {
      const std::size_t above = row[j];
      row[j] = std::min({above + 1, row[j - 1] + 1, diagonal + (a[i - 1] == b[j - 1] ? 0 : 1)});
      diagonal = above;
    }
  }
  return row.back();
}

std::string kind_in_words(const Entry& entry) {
  switch (entry.kind) {
    case Entry::Kind::nothing:
      return "nothing";
    case Entry::Kind::sequence:
      return "a list";
    case Entry::Kind::map:
      return "a map";
    case Entry::Kind::scalar:
      break;
  }
  constexpr std::size_t kMost = 60;  // characters: a file that is no case need not be repeated
  return "'" + (entry.text.size() > kMost ? entry.text.substr(0, kMost) + "..." : entry.text) + "'";
}

constexpr const char* kDecimalComma = "; decimals are written with a point, 1.5";

bool has_decimal_comma(const std::string& text) {
  const auto is_digit = [&](std::size_t at) {
    return at < text.size() && std::isdigit(static_cast<unsigned char>(text[at])) != 0;
  };
  const std::size_t comma = text.find(',');
  return comma != std::string::npos && comma > 0 && is_digit(comma - 1) && is_digit(comma + 1);
}

}  // namespace

namespace {

/// Names that others use for keys of a case: nearer by meaning than any other key is by its letters.
struct OtherName {
  const char* word;
  const char* key;
};
constexpr OtherName kOtherNames[] = {{"dilation_angle", "dilatancy_angle"},
                                     {"dilation", "dilatancy_angle"},
                                     {"dilatancy", "dilatancy_angle"},
                                     {"psi", "dilatancy_angle"},
                                     {"phi", "friction_angle"},
                                     {"young", "E"},
                                     {"youngs_modulus", "E"},
                                     {"young_modulus", "E"},
                                     {"elastic_modulus", "E"},
                                     {"poisson", "nu"},
                                     {"poisson_ratio", "nu"},
                                     {"poissons_ratio", "nu"},
                                     {"shear_modulus", "G"},
                                     {"couple_modulus", "Gc"},
                                     {"cosserat_modulus", "Gc"},
                                     {"internal_length", "lc"},
                                     {"characteristic_length", "lc"},
                                     {"plastic_length", "lp"},
                                     {"skew_stress_limit", "skew_limit"},
                                     {"gamma", "unit_weight"},
                                     {"type", "model"},
                                     {"law", "model"},
                                     {"tol", "tolerance"},
                                     {"impermeable", "impervious"},
                                     {"number", "count"},
                                     {"number_of_steps", "count"},
                                     {"displacement", "move"},
                                     {"load", "traction"},
                                     {"mohr_coulomb", "elastoplastic"},
                                     {"mohr-coulomb", "elastoplastic"},
                                     {"drucker_prager", "elastoplastic"},
                                     {"plastic", "elastoplastic"},
                                     {"linear_elastic", "elastic"},
                                     {"linear", "elastic"},
                                     {"dem", "cell"},
                                     {"grains", "cell"},
                                     {"ux", "u1"},
                                     {"uy", "u2"},
                                     {"u_x", "u1"},
                                     {"u_y", "u2"},
                                     {"x", "u1"},
                                     {"y", "u2"},
                                     {"ur", "w"},
                                     {"rz", "w"},
                                     {"theta", "w"},
                                     {"rotation", "w"}};

std::string with_words(Dimension dimension, const std::vector<std::string>& words) {
  std::string expected = expectation(dimension);
  for (const std::string& word : words) expected += ", or '" + word + "'";
  return expected;
}

std::string in_small_letters(std::string word) {
  std::ranges::transform(word, word.begin(),
                         [](unsigned char c) { return static_cast<char>(std::tolower(c)); });
  return word;
}

/// The number and the unit of `text`, with the unit that is meant: 100 Kpa is 100 kPa. Empty where no unit fits.
std::string with_meant_unit(const std::string& text, Dimension dimension) {
  const std::size_t start = text.find_last_of("0123456789. ") + 1;
  const std::string written = in_small_letters(text.substr(start));
  std::istringstream units(all_units());
  for (std::string unit; units >> unit;) {
    if (unit.ends_with(',')) unit.pop_back();
    const std::string meant = text.substr(0, start) + unit;
    if (in_small_letters(unit) == written && parse_quantity(meant, dimension)) return meant;
  }
  return {};
}

/// Advice on a text that is no quantity.
std::string advice_on_quantity(const std::string& text, Dimension dimension) {
  if (has_decimal_comma(text)) return kDecimalComma;
  for (const char* const dash : {"\u2212", "\u2013", "\u2014"})
    if (text.find(dash) != std::string::npos)
      return "; its dash is not a minus sign: write the '-' of the keyboard";
  for (const char* const space : {"\u00a0", "\u202f", "\u2009"})
    if (text.find(space) != std::string::npos) return "; it holds a special space: write an ordinary one";
  const std::string meant = with_meant_unit(text, dimension);
  return meant.empty() ? "" : "; did you mean '" + meant + "'?";
}

}  // namespace

std::string nearest(const std::string& word, const std::vector<std::string>& known) {
  const std::string small = in_small_letters(word);
  for (const std::string& candidate : known)
    if (in_small_letters(candidate) == small) return candidate;
  for (const OtherName& other : kOtherNames)
    if (small == other.word && std::ranges::find(known, other.key) != known.end()) return other.key;
  // The beginning of one alone.
  std::string best;
  for (const std::string& candidate : known)
    if (word.size() >= 3 && candidate.starts_with(word)) best = best.empty() ? candidate : "?";
  if (!best.empty() && best != "?") return best;
  best.clear();
  // Two letters in the wrong order count two; more than that, or than a third of the letters, is no slip.
  const std::size_t most = word.size() < 4 ? 1 : std::max<std::size_t>(2, word.size() / 3);
  std::size_t least = most + 1;
  for (const std::string& candidate : known) {
    const std::size_t d = distance(word, candidate);
    if (d < least) {
      least = d;
      best = candidate;
    }
  }
  return best;
}

std::string listed(const std::vector<std::string>& words) {
  return fmt::format("{}", fmt::join(words, ", "));
}

std::string value_text(double value, Dimension dimension) {
  if (dimension == Dimension::duration)
    return value >= 60.0 && std::fmod(value, 60.0) == 0.0 ? fmt::format("{:g} min", value / 60.0)
                                                          : fmt::format("{:g} s", value);
  const std::string unit(si_unit(dimension));
  const std::string behind = unit.empty() ? "" : " " + unit;
  constexpr double kSmall = 0.01;
  if (value == 0.0 || std::abs(value) >= kSmall) return fmt::format("{:g}{}", value, behind);
  const double exponent = std::floor(std::log10(std::abs(value)));
  return fmt::format("{:g}e{:g}{}", value / std::pow(10.0, exponent), exponent, behind);
}

Section::Section(const Entry& entry, std::string name, Faults& faults)
    : entry_(entry), name_(std::move(name)), faults_(faults) {
  if (entry.kind != Entry::Kind::map) {
    faults_.push_back(entry.fault(
        fmt::format("{}: expected a map of keys and values, found {}", name_, kind_in_words(entry))));
  }
}

const Entry* Section::find(const std::string& key) {
  if (std::find(asked_.begin(), asked_.end(), key) == asked_.end()) asked_.push_back(key);
  return entry_.find(key);
}

const Entry* Section::require(const std::string& key, const std::string& expected) {
  const Entry* entry = find(key);
  // A section that is no map has had its fault; missing keys would only repeat it.
  if (entry == nullptr && entry_.kind == Entry::Kind::map) {
    faults_.push_back(
        entry_.fault(fmt::format("{}: the key '{}' is missing; give {}", name_, key, expected)));
  }
  return entry;
}

std::string Section::scalar(const Entry& entry, const std::string& key, const std::string& expected) {
  if (entry.kind == Entry::Kind::scalar && !entry.text.empty()) return entry.text;
  faults_.push_back(
      entry.fault(fmt::format("{}: {}: expected {}, found {}", name_, key, expected,
                              entry.kind == Entry::Kind::scalar ? "nothing" : kind_in_words(entry))));
  return {};
}

double Section::number_of(const Entry& entry, const std::string& key, Dimension dimension, Limit limit,
                          const std::vector<std::string>& words) {
  const std::string expected = with_words(dimension, words);
  const std::string text = scalar(entry, key, expected);
  if (text.empty()) return 1.0;
  const std::optional<double> value = parse_quantity(text, dimension);
  if (!value) {
    const std::string guess = nearest(text, words);
    faults_.push_back(entry.fault(fmt::format("{}: {}: expected {}, found '{}'{}{}", name_, key, expected,
                                              text, advice_on_quantity(text, dimension),
                                              guess.empty() ? "" : "; did you mean '" + guess + "'?")));
    return 1.0;
  }
  if (std::abs(*value) > largest_of(dimension)) {
    faults_.push_back(entry.fault(fmt::format(
        "{}: {}: '{}' is larger than any such quantity: at most {:g} {} is taken; correct the number or its unit",
        name_, key, text, largest_of(dimension), si_unit(dimension))));
    return 1.0;
  }
  if (dimension == Dimension::angle && is_plain_number(text) && std::abs(*value) > 2.0 * std::numbers::pi) {
    faults_.push_back(entry.fault(
        fmt::format("{}: {}: '{}' without a unit is in rad, more than a whole turn; write '{} deg'", name_,
                    key, text, text)));
    return 1.0;
  }
  if (dimension != Dimension::number)
    written_.push_back({&entry, key, dimension, !is_plain_number(text), *value});
  const bool fits = limit == Limit::any || *value > 0.0 || (limit == Limit::not_negative && *value == 0.0);
  if (fits) return *value;
  faults_.push_back(
      entry.fault(fmt::format("{}: {}: must be {}, found '{}'", name_, key,
                              limit == Limit::positive ? "greater than zero" : "zero or greater", text)));
  return 1.0;
}

double Section::quantity(const std::string& key, Dimension dimension, Limit limit) {
  const Entry* entry = require(key, expectation(dimension));
  return entry == nullptr ? 1.0 : number_of(*entry, key, dimension, limit);
}

double Section::quantity_or(const std::string& key, Dimension dimension, Limit limit, double otherwise) {
  if (const Entry* const entry = find(key)) return number_of(*entry, key, dimension, limit);
  if (std::isfinite(otherwise)) leave(key, value_text(otherwise, dimension));
  return otherwise;
}

std::optional<double> Section::quantity_if(const std::string& key, Dimension dimension, Limit limit) {
  const Entry* const entry = find(key);
  if (entry == nullptr) return {};
  return number_of(*entry, key, dimension, limit);
}

std::optional<double> Section::quantity_or_word(const std::string& key, Dimension dimension, Limit limit,
                                                const std::vector<std::string>& words) {
  const Entry* entry = require(key, with_words(dimension, words));
  if (entry == nullptr) return 1.0;
  if (entry->kind == Entry::Kind::scalar && std::ranges::find(words, entry->text) != words.end()) return {};
  return number_of(*entry, key, dimension, limit, words);
}

int Section::whole_of(const Entry& entry, const std::string& key, int least) {
  const std::string expected = fmt::format("a whole number of at least {}", least);
  const std::string text = scalar(entry, key, expected);
  if (text.empty()) return least;
  int value = 0;
  const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), value);
  if (error == std::errc() && end == text.data() + text.size() && value >= least) return value;
  faults_.push_back(entry.fault(fmt::format("{}: {}: expected {}, found '{}'", name_, key, expected, text)));
  return least;
}

int Section::whole(const std::string& key, int least) {
  const Entry* entry = require(key, fmt::format("a whole number of at least {}", least));
  return entry == nullptr ? least : whole_of(*entry, key, least);
}

int Section::whole_or(const std::string& key, int least, int otherwise) {
  if (const Entry* const entry = find(key)) return whole_of(*entry, key, least);
  leave(key, std::to_string(otherwise));
  return otherwise;
}

void Section::leave(const std::string& key, const std::string& value) {
  faults_.left.push_back({name_, key, value});
}

const Entry* Section::list(const std::string& key, std::size_t count, const std::string& expected) {
  const std::string whole = fmt::format("a list of {}, each {}", count, expected);
  const Entry* entry = require(key, whole);
  if (entry == nullptr || (entry->kind == Entry::Kind::sequence && entry->items.size() == count))
    return entry;
  const std::string found = entry->kind == Entry::Kind::sequence
                                ? fmt::format("a list of {}", entry->items.size())
                                : kind_in_words(*entry);
  // [0,4 m, 0,8 m] has four items.
  const bool commas = entry->kind == Entry::Kind::sequence && entry->items.size() == 2 * count;
  faults_.push_back(entry->fault(
      fmt::format("{}: {}: expected {}, found {}{}", name_, key, whole, found, commas ? kDecimalComma : "")));
  return nullptr;
}

std::vector<double> Section::quantities(const std::string& key, std::size_t count, Dimension dimension,
                                        Limit limit) {
  std::vector<double> values(count, 1.0);
  if (const Entry* entry = list(key, count, expectation(dimension))) {
    for (std::size_t i = 0; i < count; ++i) values[i] = number_of(entry->items[i], key, dimension, limit);
  }
  return values;
}

std::vector<int> Section::wholes(const std::string& key, std::size_t count, int least) {
  std::vector<int> values(count, least);
  if (const Entry* entry = list(key, count, fmt::format("a whole number of at least {}", least))) {
    for (std::size_t i = 0; i < count; ++i) values[i] = whole_of(entry->items[i], key, least);
  }
  return values;
}

std::vector<std::pair<double, double>> Section::pairs(const std::string& key, Dimension first,
                                                      Dimension second, Limit limit_of_second) {
  std::vector<std::pair<double, double>> values;
  const Entry* entry = find(key);
  if (entry == nullptr || entry->kind != Entry::Kind::sequence || entry->items.empty()) {
    fault(key, fmt::format("{}: expected a list of pairs, such as [[0, 1], [1, 2]]", key));
    return values;
  }
  for (const Entry& item : entry->items) {
    if (item.kind != Entry::Kind::sequence || item.items.size() != 2) {
      faults_.push_back(item.fault(fmt::format("{}: {}: expected a pair of values, such as [0, 1], found {}",
                                               name_, key, kind_in_words(item))));
      continue;
    }
    const std::size_t before = faults_.size();
    const double x = number_of(item.items[0], key, first, Limit::any);
    const bool is_known = faults_.size() == before;
    const double y = number_of(item.items[1], key, second, limit_of_second);
    if (!is_known) continue;  // a wrong value has no order
    if (!values.empty() && x <= values.back().first) {
      faults_.push_back(
          item.fault(fmt::format("{}: {}: the first value of a pair must be larger than in the "
                                 "pair before, {}; found {}",
                                 name_, key, values.back().first, x)));
      continue;
    }
    values.emplace_back(x, y);
  }
  return values;
}

std::string Section::text(const std::string& key, const std::string& expected) {
  const Entry* entry = require(key, expected);
  return entry == nullptr ? std::string() : scalar(*entry, key, expected);
}

bool Section::flag(const std::string& key) {
  const Entry* const entry = find(key);
  return entry != nullptr && choice_of(*entry, key, {"yes", "no"}) == "yes";
}

std::string Section::text_or(const std::string& key, const std::string& otherwise) {
  if (const Entry* const entry = find(key)) return scalar(*entry, key, "a text");
  if (!otherwise.empty()) leave(key, otherwise);
  return otherwise;
}

std::string Section::choice_of(const Entry& entry, const std::string& key,
                               const std::vector<std::string>& words) {
  const std::string expected = "one of " + listed(words);
  const std::string text = scalar(entry, key, expected);
  if (text.empty() || std::find(words.begin(), words.end(), text) != words.end()) return text;
  const std::string guess = nearest(text, words);
  faults_.push_back(entry.fault(fmt::format("{}: {}: expected {}, found '{}'{}", name_, key, expected, text,
                                            guess.empty() ? "" : "; did you mean '" + guess + "'?")));
  return {};
}

std::string Section::choice(const std::string& key, const std::vector<std::string>& words) {
  const Entry* entry = require(key, "one of " + listed(words));
  std::string chosen = entry == nullptr ? std::string() : choice_of(*entry, key, words);
  // The choice decides which keys there are; without it no key can be called unknown.
  if (chosen.empty())
    for (const Entry::Member& member : entry_.members) asked_.push_back(member.key);
  return chosen;
}

std::string Section::choice_or(const std::string& key, const std::vector<std::string>& words,
                               const std::string& otherwise) {
  if (const Entry* const entry = find(key)) return choice_of(*entry, key, words);
  leave(key, otherwise);
  return otherwise;
}

std::vector<std::string> Section::words(const std::string& key, const std::string& expected) {
  const Entry* entry = require(key, expected);
  if (entry == nullptr) return {};
  if (entry->kind != Entry::Kind::sequence) {
    const std::string word = scalar(*entry, key, expected);
    return word.empty() ? std::vector<std::string>{} : std::vector<std::string>{word};
  }
  std::vector<std::string> found;
  for (const Entry& item : entry->items) {
    if (std::string word = scalar(item, key, expected); !word.empty()) found.push_back(std::move(word));
  }
  if (entry->items.empty()) fault(key, fmt::format("{}: expected {}, found an empty list", key, expected));
  return found;
}

void Section::fault(const std::string& key, const std::string& message) {
  const Entry* entry = entry_.find(key);
  faults_.push_back((entry != nullptr ? *entry : entry_).fault(name_ + ": " + message));
}

void Section::require_below(const std::string& key, double bound, const std::string& why) {
  const Entry* const entry = entry_.find(key);
  if (entry == nullptr) return;  // another key gives it, and has the fault
  const std::optional<double> value = parse_quantity(entry->text, Dimension::number);
  if (!value || *value < bound) return;  // a text that is no number is a fault already
  fault(key, fmt::format("{}: must be below {:g}, found '{}': {}", key, bound, entry->text, why));
}

void Section::require_at_least(const std::string& key, double bound, const std::string& why) {
  const Entry* const entry = entry_.find(key);
  if (entry == nullptr) return;
  const std::optional<double> value = parse_quantity(entry->text, Dimension::number);
  if (!value || *value <= 0.0 || *value >= bound) return;  // others are faults already
  fault(key, fmt::format("{}: must be at least {:g}, found '{}': {}", key, bound, entry->text, why));
}

void Section::fault_beyond(const std::string& key, double bound, const std::string& why) {
  if (const Entry* const entry = entry_.find(key); entry != nullptr)
    fault(key, fmt::format("{}: must be at most {:g}, found '{}': {}", key, bound, entry->text, why));
}

void Section::find_forgotten_units() {
  for (const Written& plain : written_) {
    const bool by_option = plain.entry->line == 0;  // --set, which scripts write, in SI units
    if (plain.has_unit || plain.value == 0.0 || by_option) continue;
    const auto with_unit = std::ranges::find_if(
        written_, [&](const Written& other) { return other.has_unit && other.dimension == plain.dimension; });
    if (with_unit == written_.end()) continue;
    const bool same_key = with_unit->key == plain.key;
    faults_.push_back(plain.entry->fault(
        fmt::format("{}: {}: '{}' has no unit, '{}'{} has one; write '{} {}' if that is its unit", name_,
                    plain.key, plain.entry->text, with_unit->entry->text,
                    same_key ? "" : " of " + with_unit->key, plain.entry->text, si_unit(plain.dimension))));
  }
}

void Section::finish() {
  find_forgotten_units();
  std::map<std::string, int> lines;
  bool listed_before = false;
  for (const Entry::Member& member : entry_.members) {
    const auto [first, is_new] = lines.emplace(member.key, member.line);
    const std::string& file = member.line > 0 ? entry_.file : member.value.file;
    if (!is_new) {
      faults_.push_back({file, member.line,
                         fmt::format("{}: the key '{}' was given before, in line {}; remove one of them",
                                     name_, member.key, first->second)});
    } else if (std::find(asked_.begin(), asked_.end(), member.key) == asked_.end()) {
      const std::string guess = nearest(member.key, asked_);
      faults_.push_back({file, member.line,
                         fmt::format("{}: unknown key '{}'; {}", name_, member.key,
                                     !guess.empty()  ? "did you mean '" + guess + "'?"
                                     : listed_before ? "the known keys stand above"
                                                     : "known keys are " + listed(asked_))});
      listed_before = listed_before || guess.empty();
    }
  }
}

}  // namespace polargrain::coupler
