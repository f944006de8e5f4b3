// SPDX-License-Identifier: GPL-2.0-or-later
#pragma once
#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <string>
#include <vector>

#include "coupler/case/quantity.hpp"
#include "coupler/case/section.hpp"

namespace polargrain::coupler {

/// A key of a map in a case, told once. A family of keys is a record with a function beside it, found by its type,
///
///     template <class Visit>
///     void describe_keys(Control& control, Visit&& visit) {
///       visit(Key{.name = "damping", .meaning = "...", .below = 1.0, .beyond = "..."}, control.damping);
///       visit(Key{.name = "loop", .meaning = "..."}, control.loop, Words{"automatic", CellLoop::automatic, ...});
///     }
///
/// From it come reading with its faults and suggestions (read_keys) and the rows of the user guide (rows_of_keys). The default is
/// the value that a new record has.
struct Key {
  const char* name;
  const char* meaning;                      ///< in the words of the user guide
  Dimension dimension = Dimension::number;  ///< of a quantity
  Limit limit = Limit::positive;            ///< of a quantity; a whole number is at least 1
  double below = HUGE_VAL;                  ///< a quantity stays below it
  double most = HUGE_VAL;                   ///< and does not exceed it
  const char* beyond = "";                  ///< the meaning of a value beyond these two
  const char* also = "";                    ///< a further default: "0.03 in explicit steps"
};

/// A word of a key, and the value that it stands for.
template <class Value>
struct Word {
  const char* text;
  Value value;
};

/// Reads each key that is there into its place; other places keep their values.
class KeyReader {
 public:
  explicit KeyReader(Section& section) : section_(section) {}
  void operator()(const Key& key, double& value) const {
    value = section_.quantity_or(key.name, key.dimension, key.limit, value);
    section_.require_below(key.name, key.below, key.beyond);
    if (value > key.most) section_.fault_beyond(key.name, key.most, key.beyond);
  }
  void operator()(const Key& key, int& value) const { value = section_.whole_or(key.name, 1, value); }
  template <class Value, std::size_t count>
  void operator()(const Key& key, Value& value, const std::array<Word<Value>, count>& words) const {
    std::vector<std::string> texts;
    for (const Word<Value>& word : words) texts.emplace_back(word.text);
    const auto left = std::ranges::find(words, value, &Word<Value>::value);
    if (left == words.end() && section_.find(key.name) == nullptr) return;  // a value that no word has
    const std::string found =
        section_.choice_or(key.name, texts, left == words.end() ? texts.front() : left->text);
    for (const Word<Value>& word : words)
      if (found == word.text) value = word.value;
  }

 private:
  Section& section_;
};

template <class Record>
void read_keys(Section& section, Record& record) {
  describe_keys(record, KeyReader(section));
}

/// "| `damping` | 0.12 | against the affine flow ... |"
std::string row_of_key(const Key& key, const std::string& otherwise);

/// Makes a row of each key.
class KeyWriter {
 public:
  explicit KeyWriter(std::string& rows) : rows_(rows) {}
  void operator()(const Key& key, const double& value) const {
    rows_ += row_of_key(key, value_text(value, key.dimension));
  }
  void operator()(const Key& key, const int& value) const { rows_ += row_of_key(key, std::to_string(value)); }
  template <class Value, std::size_t count>
  void operator()(const Key& key, const Value& value, const std::array<Word<Value>, count>& words) const {
    const auto word = std::ranges::find(words, value, &Word<Value>::value);
    rows_ += row_of_key(key, word == words.end() ? "" : word->text);
  }

 private:
  std::string& rows_;
};

/// The rows of a family in the user guide, with the values of the record as defaults.
template <class Record>
std::string rows_of_keys(Record record) {
  std::string rows;
  describe_keys(record, KeyWriter(rows));
  return rows;
}

}  // namespace polargrain::coupler
