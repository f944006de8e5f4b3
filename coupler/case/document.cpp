// SPDX-License-Identifier: GPL-2.0-or-later
#include "coupler/case/document.hpp"

#include <fmt/format.h>
#include <yaml-cpp/eventhandler.h>
#include <yaml-cpp/yaml.h>

#include <algorithm>
#include <array>
#include <charconv>
#include <cmath>
#include <fstream>
#include <map>
#include <optional>
#include <sstream>
#include <string_view>
#include <utility>
#include <vector>

#include "common/plain_text.hpp"
#include "common/regular_file.hpp"
#include "coupler/case/quantity.hpp"

namespace polargrain::coupler {
namespace {

// Bounds on what is read: aliases of aliases can make a short file describe an endless one.
constexpr std::size_t kMostEntries = 100000;
constexpr std::size_t kDeepestSection = 20;
constexpr std::uintmax_t kLargestFile = 10'000'000;

/// The first control character that no value may hold; empty: all are allowed. A text may have several lines, and tabs. Names
/// end up on terminals, in logs, in tables and as names of files, and each of these has characters that steer it.
std::string forbidden_in(const std::string& text) {
  std::string lines = text;
  std::erase_if(lines, [](char c) { return c == '\n' || c == '\r' || c == '\t'; });
  return control_character_in(lines);
}

/// Builds the tree of entries from the parser's events.
class Builder : public YAML::EventHandler {
 public:
  explicit Builder(std::string file) : file_(std::move(file)) {}

  Entry root;
  int first_line = 1;  ///< of the document

  void OnDocumentStart(const YAML::Mark& mark) override { first_line = mark.line + 1; }
  void OnDocumentEnd() override {}
  void OnNull(const YAML::Mark& mark, YAML::anchor_t anchor) override {
    leaf(Entry::Kind::nothing, "", mark, anchor);
  }
  void OnScalar(const YAML::Mark& mark, const std::string&, YAML::anchor_t anchor,
                const std::string& text) override {
    leaf(Entry::Kind::scalar, text, mark, anchor);
  }
  void OnAlias(const YAML::Mark& mark, YAML::anchor_t anchor) override {
    const auto known = anchors_.find(anchor);
    // An alias inside its own anchor has no value yet.
    if (known == anchors_.end())
      refuse(mark, "an alias (*name) stands before the end of the part that it repeats");
    count(mark, known->second.second);
    add(Entry(known->second.first), known->second.second, mark);
  }
  void OnSequenceStart(const YAML::Mark& mark, const std::string&, YAML::anchor_t anchor,
                       YAML::EmitterStyle::value) override {
    open(Entry::Kind::sequence, mark, anchor);
  }
  void OnSequenceEnd() override { close(); }
  void OnMapStart(const YAML::Mark& mark, const std::string&, YAML::anchor_t anchor,
                  YAML::EmitterStyle::value) override {
    open(Entry::Kind::map, mark, anchor);
  }
  void OnMapEnd() override { close(); }

 private:
  struct Open {
    Entry entry;
    YAML::anchor_t anchor;
    YAML::Mark mark;
    std::size_t entries_before;
    bool awaits_value = false;  ///< a map has its next key and waits for the value
  };

  [[noreturn]] void refuse(const YAML::Mark& mark, const std::string& message) const {
    throw InputError({file_, mark.line + 1, message});
  }

  void count(const YAML::Mark& mark, std::size_t entries) {
    entries_ += entries;
    if (entries_ > kMostEntries)
      refuse(mark, fmt::format("more than {} values; this is no case file", kMostEntries));
  }

  Entry made(Entry::Kind kind, const YAML::Mark& mark) const {
    Entry entry;
    entry.kind = kind;
    entry.file = file_;
    entry.line = mark.line + 1;
    return entry;
  }

  void leaf(Entry::Kind kind, const std::string& text, const YAML::Mark& mark, YAML::anchor_t anchor) {
    count(mark, 1);
    if (const std::string character = forbidden_in(text); !character.empty())
      refuse(mark, fmt::format("a text holds the control character {}; remove it", character));
    Entry entry = made(kind, mark);
    entry.text = text;
    if (anchor != YAML::NullAnchor) anchors_[anchor] = {entry, 1};
    add(std::move(entry), 1, mark);
  }

  void open(Entry::Kind kind, const YAML::Mark& mark, YAML::anchor_t anchor) {
    if (open_.size() >= kDeepestSection)
      refuse(mark, fmt::format("nested deeper than {} levels", kDeepestSection));
    if (!open_.empty() && open_.back().entry.kind == Entry::Kind::map && !open_.back().awaits_value) {
      refuse(mark, "a key must be a plain word, here stands a map or a list");
    }
    count(mark, 1);
    open_.push_back({made(kind, mark), anchor, mark, entries_ - 1});
  }

  void close() {
    Open done = std::move(open_.back());
    open_.pop_back();
    const std::size_t entries = entries_ - done.entries_before;
    if (done.anchor != YAML::NullAnchor) anchors_[done.anchor] = {done.entry, entries};
    add(std::move(done.entry), entries, done.mark);
  }

  void add(Entry entry, std::size_t, const YAML::Mark& mark) {
    if (open_.empty()) {
      root = std::move(entry);
      return;
    }
    Open& parent = open_.back();
    if (parent.entry.kind == Entry::Kind::sequence) {
      parent.entry.items.push_back(std::move(entry));
    } else if (!parent.awaits_value) {
      if (entry.kind != Entry::Kind::scalar || !control_character_in(entry.text).empty())
        refuse(mark, "a key must be a plain word");
      parent.entry.members.push_back({entry.text, entry.line, {}});
      parent.awaits_value = true;
    } else {
      parent.entry.members.back().value = std::move(entry);
      parent.awaits_value = false;
    }
  }

  std::string file_;
  std::vector<Open> open_;
  std::map<YAML::anchor_t, std::pair<Entry, std::size_t>> anchors_;
  std::size_t entries_ = 0;
};

/// The bracket that is open at the end of a text, with its line; empty where all are closed. Quoted text and comments are
/// passed over.
std::string open_bracket(const std::string& text) {
  std::vector<std::pair<char, int>> open;
  char quote = 0;
  int line = 1;
  for (std::size_t k = 0; k < text.size(); ++k) {
    const char c = text[k];
    if (c == '\n') ++line;
    if (quote != 0) {
      if (c == quote) quote = 0;
      continue;
    }
    const bool after_blank =
        k == 0 || std::string_view(" \t\n{[,:").find(text[k - 1]) != std::string_view::npos;
    if (c == '#' && after_blank)
      k = std::min(text.find('\n', k), text.size()) - 1;
    else if ((c == '"' || c == '\'') && after_blank)
      quote = c;
    else if (c == '{' || c == '[')
      open.emplace_back(c, line);
    else if ((c == '}' || c == ']') && !open.empty())
      open.pop_back();
  }
  if (open.empty()) return {};
  return fmt::format("; the '{}' in line {} is not closed", open.back().first, open.back().second);
}

/// Advice on habits of writing that YAML does not take.
std::string advice_on_line(const std::string& text, int line) {
  std::istringstream in(text);
  std::string found;
  for (int k = 0; k < line; ++k) std::getline(in, found);
  const std::size_t first = found.find_first_not_of(" \t");
  const bool has_tab = found.substr(0, first).find('\t') != std::string::npos;
  return has_tab ? "; the line begins with a tab, and only spaces may stand there" : open_bracket(text);
}

Entry parse(const std::string& text, const std::string& file) {
  std::istringstream in(text);
  Builder builder(file);
  try {
    YAML::Parser parser(in);
    parser.HandleNextDocument(builder);
    Builder second(file);
    if (parser.HandleNextDocument(second))
      throw InputError(
          {file, second.first_line,
           "a second document begins here, behind '---' or '...', and would not be read; remove that line, or "
           "put the rest into a file of its own"});
  } catch (const YAML::Exception& error) {
    const int line = error.mark.is_null() ? 0 : error.mark.line + 1;
    throw InputError({file, line, "this is no YAML: " + error.msg + advice_on_line(text, line)});
  }
  return std::move(builder.root);
}

/// Line numbers mean nothing in the value of an option.
void forget_lines(Entry& entry) {
  entry.line = 0;
  for (Entry& item : entry.items) forget_lines(item);
  for (Entry::Member& member : entry.members) {
    member.line = 0;
    forget_lines(member.value);
  }
}

Entry* step_into(Entry& from, const std::string& key, const Fault& no_such_place) {
  if (from.kind == Entry::Kind::sequence) {
    std::size_t index = 0;
    const auto [end, error] = std::from_chars(key.data(), key.data() + key.size(), index);
    if (error != std::errc() || end != key.data() + key.size() || index >= from.items.size()) {
      throw InputError(no_such_place);
    }
    return &from.items[index];
  }
  if (from.kind == Entry::Kind::nothing) from.kind = Entry::Kind::map;
  if (from.kind != Entry::Kind::map) throw InputError(no_such_place);
  for (auto member = from.members.rbegin(); member != from.members.rend(); ++member) {
    if (member->key == key) return &member->value;
  }
  from.members.push_back({key, 0, {}});
  from.members.back().value.file = no_such_place.file;
  return &from.members.back().value;
}

struct Measured {
  double number;
  std::optional<UnitAhead> unit;
};

/// "5 kPa"; nothing where the text is no number with a unit behind it, or without one.
std::optional<Measured> measured(std::string_view text) {
  Measured found{};
  const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), found.number);
  if (error != std::errc() || found.number == 0.0) return {};
  text.remove_prefix(static_cast<std::size_t>(end - text.data()));
  while (text.starts_with(' ')) text.remove_prefix(1);
  if (text.empty()) return found;
  found.unit = unit_ahead(text);
  if (!found.unit || found.unit->length != text.size()) return {};
  return found;
}

/// Plain numbers of options are in SI units, as scripts write them. One that is far from the value of the file, and would be near
/// it in the unit there, lacks that unit.
/// @throws InputError where a number of `value` does
void refuse_forgotten_units(const Entry& of_file, const Entry& value) {
  constexpr double kFar = 100.0;  // times; kPa, mm and d are further from their SI units
  if (of_file.kind != value.kind) return;
  if (value.kind == Entry::Kind::sequence && value.items.size() == of_file.items.size())
    for (std::size_t k = 0; k < value.items.size(); ++k)
      refuse_forgotten_units(of_file.items[k], value.items[k]);
  if (value.kind != Entry::Kind::scalar) return;
  const std::optional<Measured> before = measured(of_file.text);
  const std::optional<Measured> now = measured(value.text);
  if (!before || !before->unit || !now || now->unit) return;
  const auto is_far = [](double ratio) { return std::abs(std::log(ratio)) > std::log(kFar); };
  const double ratio = std::abs(now->number / before->number);
  if (!is_far(ratio / before->unit->factor) || is_far(ratio)) return;
  throw InputError(value.fault(fmt::format(
      "'{0}' has no unit and is {0} {1}, where the case has '{2}'; write '{0} {3}', or '{0} {1}' if that is meant",
      value.text, si_unit(before->unit->dimension), of_file.text,
      of_file.text.substr(of_file.text.size() - before->unit->length))));
}

}  // namespace

const Entry* Entry::find(const std::string& key) const {
  for (auto member = members.rbegin(); member != members.rend(); ++member) {
    if (member->key == key) return &member->value;
  }
  return nullptr;
}

Entry load_document(const std::filesystem::path& file) {
  std::error_code error;
  const std::string name = file.string();
  if (const std::string reason = why_no_input(file); !reason.empty())
    throw InputError({name, 0, reason + "; give the path of a case file (case.yaml)"});
  constexpr std::array<std::pair<const char*, const char*>, 5> kOthers{{{".h5", "a packing or a checkpoint"},
                                                                        {".csv", "a table"},
                                                                        {".in", "a LIGGGHTS script"},
                                                                        {".msh", "a mesh"},
                                                                        {".geo", "a script for Gmsh"}}};
  for (const auto& [ending, what] : kOthers)
    if (file.extension() == ending)
      throw InputError(
          {name, 0, fmt::format("this is {} by its name; give a case or a specification, NAME.yaml", what)});
  if (std::filesystem::file_size(file, error) > kLargestFile) {
    throw InputError({name, 0, fmt::format("larger than {} bytes; this is no case file", kLargestFile)});
  }
  std::ifstream in(file, std::ios::binary);
  std::ostringstream text;
  text << in.rdbuf();
  if (!in) throw InputError({name, 0, "cannot be read; check its permissions"});
  Entry document = parse(text.str(), name);
  if (document.kind == Entry::Kind::nothing)
    throw InputError(
        {name, 0, "is empty, or all of it is comments; 'polargrain new biaxial -o FOLDER' writes a case"});
  return document;
}

void apply_setting(Entry& document, const std::string& setting) {
  const std::string file = "--set " + setting;
  const std::size_t equals = setting.find('=');
  if (equals == std::string::npos || equals == 0) {
    throw InputError({file, 0, "expected key=value, for example --set steps.count=10"});
  }
  if (!control_character_in(setting.substr(0, equals)).empty())
    throw InputError({file, 0, "a key must be a plain word; there is a control character in it"});
  Entry value = parse(setting.substr(equals + 1), file);
  forget_lines(value);
  value.file = file;
  Entry* place = &document;
  std::istringstream way(setting.substr(0, equals));
  std::string so_far;
  for (std::string key; std::getline(way, key, '.');) {
    const Fault fault{file, 0,
                      fmt::format("there is no '{}' in {}; items of a list are numbered from 0", key,
                                  so_far.empty() ? "the case" : "'" + so_far + "'")};
    place = step_into(*place, key, fault);
    so_far += (so_far.empty() ? "" : ".") + key;
  }
  refuse_forgotten_units(*place, value);
  *place = std::move(value);
}

}  // namespace polargrain::coupler
