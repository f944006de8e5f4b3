// SPDX-License-Identifier: GPL-2.0-or-later
#include "common/record_archive.hpp"

namespace polargrain {

void write_values(ArchiveWriter& archive, const std::string& name, const RecordValues& values) {
  // Archives keep no texts: each one as its length and its characters. Nearly all are empty.
  std::vector<std::int64_t> texts;
  for (const std::string& text : values.texts) {
    texts.push_back(static_cast<std::int64_t>(text.size()));
    for (const char character : text) texts.push_back(static_cast<unsigned char>(character));
  }
  archive.write(name + "/numbers", std::span<const double>(values.numbers));
  archive.write(name + "/integers", std::span<const std::int64_t>(values.integers));
  archive.write(name + "/texts", std::span<const std::int64_t>(texts));
  archive.write(name + "/states", std::span<const StatePointer>(values.states));
}

RecordValues read_values(ArchiveReader& archive, const std::string& name) {
  RecordValues values;
  values.numbers = archive.doubles(name + "/numbers");
  values.integers = archive.integers(name + "/integers");
  values.states = archive.states(name + "/states");
  const std::vector<std::int64_t> texts = archive.integers(name + "/texts");
  for (std::size_t place = 0; place < texts.size();) {
    const auto length = static_cast<std::size_t>(texts[place++]);
    if (length > texts.size() - place) throw RunError("a text of '" + name + "' is cut short");
    std::string& text = values.texts.emplace_back();
    for (std::size_t end = place + length; place < end; ++place)
      text.push_back(static_cast<char>(texts[place]));
  }
  return values;
}

}  // namespace polargrain
