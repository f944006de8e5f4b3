// SPDX-License-Identifier: GPL-2.0-or-later
#include "app/bench/bench_packings.hpp"

#include <fmt/format.h>

#include <cstdio>
#include <set>

#include "app/bench/bench_settings.hpp"
#include "app/commands/pack.hpp"
#include "app/pack/read_specification.hpp"
#include "common/error.hpp"
#include "common/standard_streams.hpp"
#include "coupler/case/cell_script.hpp"
#include "coupler/case/data_files.hpp"
#include "coupler/case/section.hpp"
#include "fem/output/write_file.hpp"

namespace polargrain::app {
namespace {

void refuse_repeated(const std::vector<int>& values, const char* option) {
  std::set<int> known;
  for (const int value : values) {
    if (!known.insert(value).second)
      throw InputError({option, 0, fmt::format("{} is there twice; give each once", value)});
  }
}

std::vector<std::string> settings_of(int grains, int seed) {
  return {fmt::format("grains={}", grains), fmt::format("seed={}", seed)};
}

/// Whether a material and a specification name libraries of contact laws with the same content, or no library.
bool same_library(const std::string& named, const std::filesystem::path& directory,
                  const ContactLibraryFile& library) {
  if (named.empty() || library.path.empty()) return named.empty() && library.path.empty();
  const auto file = coupler::find_data_file(named, directory);
  return !file ||
         coupler::content_of(*file) == coupler::content_of(library.path);  // read_case names the missing file
}

/// Packings at rest with one contact model are not at rest with another.
void check_script(const BenchOptions& options, const PackingSpecification& specification) {
  const std::vector<MaterialWithCells> materials = materials_with_cells(options);
  if (materials.empty())
    throw InputError({options.cases.front().string(), 0,
                      "has no material with cells, so --pack has no use; leave it out"});
  const coupler::Entry document = coupler::load_document(options.pack);
  const coupler::Entry* entry = document.find("script");
  coupler::Faults faults;
  for (const MaterialWithCells& material : materials) {
    const std::filesystem::path directory = options.cases.front().parent_path();
    if (!same_library(material.contact_library, directory, specification.contact_library))
      faults.push_back(
          entry->fault(fmt::format("contact_library: material '{}' in {} has another one, or only one of the "
                                   "two has any; give both the same, in a copy of the specification",
                                   material.name, options.cases.front().string())));
    const auto file = coupler::find_data_file(material.script, directory);
    if (!file || coupler::text_of_script(*file) == specification.script)
      continue;  // read_case names the missing file
    faults.push_back(entry->fault(
        fmt::format("script: {} has another content than {}, the script of material '{}' in {}; give both "
                    "the same, in a copy of the specification",
                    entry->text, material.script, material.name, options.cases.front().string())));
  }
  if (!faults.empty()) throw InputError(faults);
}

/// All that a packing depends on.
std::string origin_of(const PackingSpecification& specification) {
  return specification.text + "\n# the script:\n" + specification.script + "\n# contact library " +
         specification.contact_library.content + "\n";
}

}  // namespace

std::vector<BenchPacking> bench_packings(const BenchOptions& options) {
  if (options.pack.empty()) return {};
  const PackingSpecification as_written = read_packing_specification(options.pack, {}, options.scripts);
  if (as_written.dimension != 2)
    throw InputError({options.pack.string(), 0, "is of spheres in space; cells are plane (dimension: 2)"});
  check_script(options, as_written);
  const std::vector<int> sizes =
      options.grains.empty() ? std::vector<int>{as_written.grains} : options.grains;
  refuse_repeated(sizes, "--grains");
  refuse_repeated(options.seeds, "--seeds");
  std::vector<BenchPacking> packings;
  for (const int grains : sizes) {
    for (const int seed : options.seeds) {
      read_packing_specification(options.pack, settings_of(grains, seed), options.scripts);
      packings.push_back({grains, seed,
                          std::filesystem::absolute(options.directory / "packings" /
                                                    fmt::format("grains{}-seed{}.h5", grains, seed))});
    }
  }
  return packings;
}

void make_packings(const BenchOptions& options, const std::vector<BenchPacking>& packings,
                   const PackingTools& tools) {
  if (!packings.empty()) std::filesystem::create_directories(packings.front().file.parent_path());
  for (std::size_t k = 0; k < packings.size(); ++k) {
    const BenchPacking& packing = packings[k];
    PackOptions pack_options{options.pack, packing.file, {}, settings_of(packing.grains, packing.seed), true};
    pack_options.scripts = options.scripts;
    const std::string origin =
        origin_of(read_packing_specification(options.pack, pack_options.settings, options.scripts));
    std::filesystem::path note = packing.file;
    note.replace_extension(".txt");
    const bool kept = std::filesystem::exists(packing.file) && coupler::content_of(note) == origin;
    if (!options.quiet)
      tell(stderr, "packing {} of {}: {} grains, seed {}{}\n", k + 1, packings.size(), packing.grains,
           packing.seed, kept ? ", is there" : "");
    if (kept) continue;
    std::filesystem::remove(note);
    pack(pack_options, tools);
    fem::write_file(note, origin);
  }
}

}  // namespace polargrain::app
