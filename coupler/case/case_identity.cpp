// SPDX-License-Identifier: GPL-2.0-or-later
#include "coupler/case/case_identity.hpp"

#include <fmt/format.h>

#include "common/state.hpp"
#include "coupler/case/cell_script.hpp"
#include "coupler/case/data_files.hpp"
#include "coupler/case/measured_interface.hpp"
#include "coupler/case/measured_length.hpp"
#include "grains_io/contact_models.hpp"

namespace polargrain::coupler {
namespace {

/// Files that a script includes are part of it.
std::string name_of_content(const std::filesystem::path& file, const std::string& key) {
  const std::string content = key.ends_with("script") ? text_of_script(file) : content_of(file);
  return name_of(std::as_bytes(std::span(content))).text();
}

void collect(const Entry& entry, const std::string& key, const std::filesystem::path& directory,
             CaseIdentity& identity) {
  const auto below = [&](const std::string& name) { return key.empty() ? name : key + "." + name; };
  for (const Entry::Member& member : entry.members) {
    collect(member.value, below(member.key), directory, identity);
  }
  // `lc: measured` is what stands beside the packing.
  const Entry* const length = entry.find("lc");
  const Entry* const packing = entry.find("packing");
  if (length != nullptr && packing != nullptr && length->text == "measured") {
    if (const auto file = find_data_file(packing->text, directory))
      identity.files[below("lc")] = name_of_content(length_file_of(*file), "");
  }
  for (std::size_t i = 0; i < entry.items.size(); ++i) {
    collect(entry.items[i], below(std::to_string(i)), directory, identity);
  }
  if (entry.kind != Entry::Kind::scalar) return;
  identity.values[key] = entry.text;
  const auto file = find_data_file(entry.text, directory);
  if (!file) return;
  identity.files[key] = name_of_content(*file, key);
  if (!key.ends_with("script")) return;
  if (const std::string springs = springs_of_script(text_of_script(*file)); !springs.empty())
    identity.values[key + kSprings] = springs;
}

void collect_files(const Entry& entry, const std::string& key, const std::filesystem::path& directory,
                   std::vector<std::filesystem::path>& files) {
  for (const Entry::Member& member : entry.members) collect_files(member.value, member.key, directory, files);
  for (const Entry& item : entry.items) collect_files(item, key, directory, files);
  if (entry.kind != Entry::Kind::scalar) return;
  const auto file = find_data_file(entry.text, directory);
  if (!file) return;
  if (key == "script") {
    const std::vector<std::filesystem::path> parts = files_of_script(*file);
    files.insert(files.end(), parts.begin(), parts.end());
    return;
  }
  files.insert(files.end(), {*file, length_file_of(*file), interface_file_of(*file)});
}

bool matters(const std::string& key) {
  return key != "title" && key != "output.checkpoint_minutes" && key.rfind("workers.", 0) != 0 &&
         key.rfind("output.table", 0) != 0 && key.rfind("output.grains", 0) != 0 &&
         !key.ends_with(kSprings);  // another script is told as such
}

std::string shown(const std::map<std::string, std::string>& values, const std::string& key) {
  const auto value = values.find(key);
  return value == values.end() ? "not given" : "'" + value->second + "'";
}

}  // namespace

CaseIdentity identity_of(const Entry& document, const std::filesystem::path& directory) {
  CaseIdentity identity;
  collect(document, "", directory, identity);
  // So is `spread: measured`, of each packing.
  const Entry* const continuum = document.find("continuum");
  const Entry* const spread = continuum == nullptr ? nullptr : continuum->find("spread");
  const Entry* const materials = document.find("materials");
  if (spread != nullptr && spread->text == "measured" && materials != nullptr)
    for (const Entry::Member& member : materials->members) {
      const Entry* const packing = member.value.find("packing");
      const auto file = packing == nullptr ? std::nullopt : find_data_file(packing->text, directory);
      if (file)
        identity.files["materials." + member.key + ".spread"] = name_of_content(length_file_of(*file), "");
    }
  // `friction: measured` is what stands beside the packing.
  const Entry* const interfaces = document.find("interfaces");
  if (interfaces == nullptr) return identity;
  for (const Entry::Member& member : interfaces->members) {
    const Entry* const friction = member.value.find("friction");
    if (friction == nullptr || friction->text != "measured") continue;
    const auto file =
        find_data_file(packing_of_interface(member.value, document.find("materials")), directory);
    if (file)
      identity.files["interfaces." + member.key + ".friction"] =
          name_of_content(interface_file_of(*file), "");
  }
  return identity;
}

std::vector<std::filesystem::path> files_named_in(const Entry& document,
                                                  const std::filesystem::path& directory) {
  std::vector<std::filesystem::path> files;
  collect_files(document, "", directory, files);
  return files;
}

std::vector<std::string> regions_of(const CaseIdentity& identity) {
  const std::string prefix = "regions.";
  std::vector<std::string> names;
  for (const auto& [key, value] : identity.values)
    if (key.starts_with(prefix)) names.push_back(key.substr(prefix.size()));
  return names;
}

std::vector<std::string> differences(const CaseIdentity& before, const CaseIdentity& now) {
  std::map<std::string, std::string> all = before.values;
  all.insert(now.values.begin(), now.values.end());
  std::vector<std::string> lines;
  for (const auto& [key, value] : all) {
    if (!matters(key)) continue;
    const auto file_before = before.files.find(key);
    const auto file_now = now.files.find(key);
    if (file_before != before.files.end() && file_now != now.files.end()) {
      if (file_before->second != file_now->second) {
        lines.push_back(fmt::format("{}: the file {} has another content", key, shown(now.values, key)));
      }
    } else if (shown(before.values, key) != shown(now.values, key)) {
      lines.push_back(
          fmt::format("{}: was {}, is {}", key, shown(before.values, key), shown(now.values, key)));
    }
  }
  return lines;
}

}  // namespace polargrain::coupler
