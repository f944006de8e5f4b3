// SPDX-License-Identifier: GPL-2.0-or-later
#pragma once
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "coupler/case/document.hpp"
#include "coupler/case/quantity.hpp"

namespace polargrain::coupler {

/// A key that was left out, and the value in its place.
struct KeyLeft {
  std::string section;
  std::string key;
  std::string value;  ///< as a case would have it
};

/// All that reading an input finds: its faults, and the keys that it leaves to their defaults.
class Faults : public std::vector<Fault> {
 public:
  using std::vector<Fault>::vector;
  std::vector<KeyLeft> left;
};

/// The condition on a number beyond finite.
enum class Limit { any, positive, not_negative };

/// "6e-4", "10 min": a value as a case would have it.
std::string value_text(double value, Dimension dimension);

/// Reads keys that are not in use for their faults alone.
template <class Read>
void for_its_faults(Faults& faults, const Read& read) {
  const auto in_use = static_cast<std::ptrdiff_t>(faults.left.size());
  read();
  faults.left.erase(faults.left.begin() + in_use, faults.left.end());
}

/// The known word that `word` was most likely meant to be, by its letters or as another name of the same thing; empty when
/// no word is near.
std::string nearest(const std::string& word, const std::vector<std::string>& known);

/// "a, b, c"
std::string listed(const std::vector<std::string>& words);

/// One map of a case while it is read. Every getter notes the key it asks for, checks the value it finds and puts
/// a fault on the list when that is wrong or missing; reading then goes on, so that all faults show at once.
/// The value a getter returns after a fault is only fit for reading on. finish() reports keys nobody asked for.
class Section {
 public:
  /// @param name how messages call this map, for example "material 'sand'"
  /// A fault when `entry` is no map.
  Section(const Entry& entry, std::string name, Faults& faults);

  /// The entry of a key; null when it is not there.
  const Entry* find(const std::string& key);
  /// The same, with a fault when it is not there. @param expected "a length ...", for the message
  const Entry* require(const std::string& key, const std::string& expected);

  double quantity(const std::string& key, Dimension dimension, Limit limit);
  double quantity_or(const std::string& key, Dimension dimension, Limit limit, double otherwise);
  /// A quantity, or nothing where the key is left out and no number stands for that.
  std::optional<double> quantity_if(const std::string& key, Dimension dimension, Limit limit);
  /// A quantity, or nothing where the value is one of the words.
  std::optional<double> quantity_or_word(const std::string& key, Dimension dimension, Limit limit,
                                         const std::vector<std::string>& words);
  int whole(const std::string& key, int least);
  int whole_or(const std::string& key, int least, int otherwise);
  /// A list of so many quantities, or of so many whole numbers.
  std::vector<double> quantities(const std::string& key, std::size_t count, Dimension dimension, Limit limit);
  std::vector<int> wholes(const std::string& key, std::size_t count, int least);
  /// A list of at least one [first, second]: the first ones rise.
  std::vector<std::pair<double, double>> pairs(const std::string& key, Dimension first, Dimension second,
                                               Limit limit_of_second);
  std::string text(const std::string& key, const std::string& expected);
  std::string text_or(const std::string& key, const std::string& otherwise);
  /// One of the words given.
  std::string choice(const std::string& key, const std::vector<std::string>& words);
  std::string choice_or(const std::string& key, const std::vector<std::string>& words,
                        const std::string& otherwise);
  /// A list of words; a single word counts as a list of one.
  std::vector<std::string> words(const std::string& key, const std::string& expected);

  /// Notes a key that was left out, and the value that the case takes for it. The getters do so where they are given one; flags
  /// are not noted.
  void leave(const std::string& key, const std::string& value);
  /// yes or no; no where it is left out.
  bool flag(const std::string& key);

  /// Puts a fault at the place of a key (of the whole section when the key is not there).
  void fault(const std::string& key, const std::string& message);

  /// Faults where a value that must stay below a bound does not. @param why the meaning of values beyond it
  void require_below(const std::string& key, double bound, const std::string& why);

  /// A fault when the number that the key gives, if it gives one, is positive and below a bound that it may reach.
  void require_at_least(const std::string& key, double bound, const std::string& why);
  /// The fault of a value beyond a bound that it may reach.
  void fault_beyond(const std::string& key, double bound, const std::string& why);

  /// To be called when all keys have been asked for. Keys that nobody asked for are faults, and so are plain numbers
  /// beside others of their dimension that carry a unit (40 beside 10 MPa): a unit was most likely forgotten
  /// (not in options, which scripts write).
  void finish();

  [[nodiscard]] const Entry& entry() const { return entry_; }
  [[nodiscard]] const std::string& name() const { return name_; }
  /// Keys that have been asked for.
  [[nodiscard]] const std::vector<std::string>& asked() const { return asked_; }

 private:
  /// A number of a dimension as it was written.
  struct Written {
    const Entry* entry;
    std::string key;
    Dimension dimension;
    bool has_unit;
    double value;
  };

  void find_forgotten_units();
  std::string scalar(const Entry& entry, const std::string& key, const std::string& expected);
  const Entry* list(const std::string& key, std::size_t count, const std::string& expected);
  /// @param words that may stand there instead, for messages
  double number_of(const Entry& entry, const std::string& key, Dimension dimension, Limit limit,
                   const std::vector<std::string>& words = {});
  int whole_of(const Entry& entry, const std::string& key, int least);
  std::string choice_of(const Entry& entry, const std::string& key, const std::vector<std::string>& words);

  const Entry& entry_;
  std::string name_;
  Faults& faults_;
  std::vector<std::string> asked_;
  std::vector<Written> written_;
};

}  // namespace polargrain::coupler
