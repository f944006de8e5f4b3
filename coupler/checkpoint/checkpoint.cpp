// SPDX-License-Identifier: GPL-2.0-or-later
#include "coupler/checkpoint/checkpoint.hpp"

#include <fmt/format.h>

#include <array>
#include <set>
#include <system_error>

#include "common/file_in_memory.hpp"
#include "common/sealed_file.hpp"
#include "common/trial.hpp"
#include "common/write_file.hpp"

namespace polargrain::coupler {
namespace {

using hdf5::Handle;
using hdf5::read_array;
using hdf5::write_array;

constexpr std::int64_t kVersion = 10;
constexpr char kEnd = '\0';  ///< behind each word of a list
constexpr std::int64_t kNoState = -1;

std::string text_of(const std::map<std::string, std::string>& pairs) {
  std::string text;
  for (const auto& [key, value] : pairs) text += key + kEnd + value + kEnd;
  return text;
}

template <class Value>
std::string names_of(const std::map<std::string, Value>& arrays) {
  std::string text;
  for (const auto& [name, array] : arrays) text += name + kEnd;
  return text;
}

std::vector<std::string> words_of(const std::string& text) {
  std::vector<std::string> words;
  for (std::size_t begin = 0; begin < text.size();) {
    const std::size_t end = text.find(kEnd, begin);
    if (end == std::string::npos) throw RunError("a list of words has no end");
    words.push_back(text.substr(begin, end - begin));
    begin = end + 1;
  }
  return words;
}

std::map<std::string, std::string> pairs_of(const std::string& text) {
  const std::vector<std::string> words = words_of(text);
  if (words.size() % 2 != 0) throw RunError("a value has no key");
  std::map<std::string, std::string> pairs;
  for (std::size_t i = 0; i < words.size(); i += 2) pairs[words[i]] = words[i + 1];
  return pairs;
}

std::string read_text(hid_t file, const std::string& name) {
  std::string text;
  read_array(file, name, text);
  return text;
}

template <class Value>
std::vector<Value> read_values(hid_t file, const std::string& name) {
  std::vector<Value> values;
  read_array(file, name, values);
  return values;
}

/// The bytes of all different states, one behind the other, in one array.
void write_states(hid_t file, const std::map<std::string, std::vector<StatePointer>>& arrays) {
  std::map<ContentName, std::int64_t> numbers;
  std::vector<StatePointer> different;
  std::vector<std::int64_t> ends;
  std::int64_t bytes = 0;
  for (const auto& [name, states] : arrays) {
    std::vector<std::int64_t> places;
    for (const StatePointer& state : states) {
      if (!state) {
        places.push_back(kNoState);
        continue;
      }
      const auto [place, is_new] =
          numbers.emplace(state->name(), static_cast<std::int64_t>(different.size()));
      if (is_new) {
        different.push_back(state);
        ends.push_back(bytes += static_cast<std::int64_t>(state->bytes().size()));
      }
      places.push_back(place->second);
    }
    write_array(file, "states/of/" + name, places);
  }
  write_array(file, "states/ends", ends);
  const std::string what = "states/bytes";
  const Handle set = hdf5::make_array(file, what, H5T_NATIVE_UINT8, static_cast<hsize_t>(bytes));
  const Handle space(H5Dget_space(set), H5Sclose, what);
  for (std::size_t i = 0; i < different.size(); ++i) {
    const std::span<const std::byte> content = different[i]->bytes();
    if (content.empty()) continue;
    const hsize_t count = content.size();
    const hsize_t begin = static_cast<hsize_t>(ends[i]) - count;
    const Handle memory(H5Screate_simple(1, &count, nullptr), H5Sclose, what);
    hdf5::check(H5Sselect_hyperslab(space, H5S_SELECT_SET, &begin, nullptr, &count, nullptr), what);
    hdf5::check(H5Dwrite(set, H5T_NATIVE_UINT8, memory, space, H5P_DEFAULT, content.data()), what);
  }
}

std::vector<StatePointer> read_different_states(hid_t file) {
  const std::string what = "states/bytes";
  const std::vector<std::int64_t> ends = read_values<std::int64_t>(file, "states/ends");
  const Handle set = hdf5::open_array(file, what);
  const auto bytes = static_cast<std::int64_t>(hdf5::size_of_array(file, set, what, 1));
  const Handle space(H5Dget_space(set), H5Sclose, what);
  std::vector<StatePointer> states;
  std::int64_t begin = 0;
  for (const std::int64_t end : ends) {
    if (end < begin || end > bytes) throw RunError("the lengths of its states are wrong");
    std::vector<std::byte> content(static_cast<std::size_t>(end - begin));
    if (!content.empty()) {
      const hsize_t count = content.size();
      const auto from = static_cast<hsize_t>(begin);
      const Handle memory(H5Screate_simple(1, &count, nullptr), H5Sclose, what);
      hdf5::check(H5Sselect_hyperslab(space, H5S_SELECT_SET, &from, nullptr, &count, nullptr), what);
      hdf5::check(H5Dread(set, H5T_NATIVE_UINT8, memory, space, H5P_DEFAULT, content.data()), what);
    }
    states.push_back(std::make_shared<const State>(std::move(content)));
    begin = end;
  }
  return states;
}

void write_arrays(hid_t file, const MemoryArchive& archive) {
  write_array(file, "numbers/names", names_of(archive.all_doubles()));
  write_array(file, "whole_numbers/names", names_of(archive.all_integers()));
  write_array(file, "states/names", names_of(archive.all_states()));
  for (const auto& [name, values] : archive.all_doubles()) write_array(file, "numbers/of/" + name, values);
  for (const auto& [name, values] : archive.all_integers()) {
    write_array(file, "whole_numbers/of/" + name, values);
  }
  write_states(file, archive.all_states());
}

void read_arrays(hid_t file, MemoryArchive& archive) {
  for (const std::string& name : words_of(read_text(file, "numbers/names"))) {
    archive.write(name, std::span<const double>(read_values<double>(file, "numbers/of/" + name)));
  }
  for (const std::string& name : words_of(read_text(file, "whole_numbers/names"))) {
    archive.write(name,
                  std::span<const std::int64_t>(read_values<std::int64_t>(file, "whole_numbers/of/" + name)));
  }
  const std::vector<StatePointer> different = read_different_states(file);
  for (const std::string& name : words_of(read_text(file, "states/names"))) {
    std::vector<StatePointer> states;
    for (const std::int64_t place : read_values<std::int64_t>(file, "states/of/" + name)) {
      if (place < kNoState || place >= static_cast<std::int64_t>(different.size())) {
        throw RunError("a state it refers to is missing");
      }
      states.push_back(place == kNoState ? nullptr : different[static_cast<std::size_t>(place)]);
    }
    archive.write(name, std::span<const StatePointer>(states));
  }
}

/// Some more than the content has.
std::size_t bytes_of(const Checkpoint& checkpoint) {
  std::size_t bytes = checkpoint.history.size() + checkpoint.costs.size();
  for (const auto& [name, values] : checkpoint.state.all_doubles()) bytes += values.size() * sizeof(double);
  for (const auto& [name, values] : checkpoint.state.all_integers())
    bytes += values.size() * sizeof(std::int64_t);
  std::set<const State*> counted;
  for (const auto& [name, states] : checkpoint.state.all_states())
    for (const StatePointer& state : states)
      if (state && counted.insert(state.get()).second) bytes += state->bytes().size();
  constexpr std::size_t kOfNames = std::size_t{1} << 20;
  return bytes + kOfNames;
}

void write_content(hid_t out, const Checkpoint& checkpoint) {
  write_array(out, "version", std::array<std::int64_t, 1>{kVersion});
  write_array(out, "program", checkpoint.program);
  write_array(out, "case/values", text_of(checkpoint.identity.values));
  write_array(out, "case/files", text_of(checkpoint.identity.files));
  write_array(out, "run/step", std::array<std::int64_t, 1>{checkpoint.step});
  write_array(out, "run/history", checkpoint.history);
  write_array(out, "run/costs", checkpoint.costs);
  write_arrays(out, checkpoint.state);
}

}  // namespace

void write_checkpoint(const std::filesystem::path& file, const Checkpoint& checkpoint,
                      Durability durability) try {
  hdf5::silence();
  hdf5::FileInMemory made(bytes_of(checkpoint));
  write_content(made.file(), checkpoint);
  const std::string_view bytes = made.close();
  const std::string mark = seal_of(bytes);
  write_file(file, std::array<std::string_view, 2>{bytes, mark}, durability, checkpoint_before(file));
} catch (const RunError& error) {
  throw RunError(fmt::format("the checkpoint {}", error.what()));
}

std::filesystem::path checkpoint_before(const std::filesystem::path& file) {
  std::filesystem::path before = file;
  return before.replace_extension(".before" + file.extension().string());
}

namespace {

Checkpoint content_in(const std::filesystem::path& file) {
  const Handle in(H5Fopen(file.c_str(), H5F_ACC_RDONLY, H5P_DEFAULT), H5Fclose, "it is no HDF5 file");
  const std::vector<std::int64_t> version = read_values<std::int64_t>(in, "version");
  if (version != std::vector{kVersion}) {
    throw RunError(fmt::format("it is of version {}; this program reads version {}",
                               version.empty() ? 0 : version.front(), kVersion));
  }
  Checkpoint checkpoint;
  checkpoint.program = read_text(in, "program");
  checkpoint.identity.values = pairs_of(read_text(in, "case/values"));
  checkpoint.identity.files = pairs_of(read_text(in, "case/files"));
  const std::vector<std::int64_t> step = read_values<std::int64_t>(in, "run/step");
  if (step.size() != 1 || step[0] < 0 || step[0] > INT32_MAX) throw RunError("its step is no number");
  checkpoint.step = static_cast<int>(step[0]);
  checkpoint.history = read_text(in, "run/history");
  checkpoint.costs = read_text(in, "run/costs");
  read_arrays(in, checkpoint.state);
  return checkpoint;
}

/// @throws RunError saying what is wrong with the file
Checkpoint read_whole(const std::filesystem::path& file) {
  check_seal(file);
  try_in_own_process([&file] { (void)content_in(file); });  // as for packings: the hash may be a forger's
  return content_in(file);
}

/// The advice when a checkpoint cannot be read.
std::string advice(const std::filesystem::path& file) {
  const std::filesystem::path before = checkpoint_before(file);
  try {
    return fmt::format(
        "the checkpoint before it, {}, is of step {} and can be read: to go on from there, "
        "'mv {} {}' and run with --resume again",
        before.string(), read_whole(before).step, before.string(), file.string());
  } catch (const RunError&) {  // it is missing, or it is no better
    return "run without --resume";
  }
}

}  // namespace

Checkpoint read_checkpoint(const std::filesystem::path& file) {
  hdf5::silence();
  std::error_code error;
  if (!std::filesystem::exists(file, error)) {
    const bool is_kept = std::filesystem::exists(checkpoint_before(file), error);
    throw InputError({file.string(), 0,
                      "there is no checkpoint to go on from; " +
                          (is_kept ? advice(file) : std::string("run without --resume"))});
  }
  try {
    return read_whole(file);
  } catch (const RunError& what) {
    throw InputError(
        {file.string(), 0, fmt::format("this checkpoint cannot be used: {}; {}", what.what(), advice(file))});
  }
}

}  // namespace polargrain::coupler
