// SPDX-License-Identifier: GPL-2.0-or-later
#include "app/pack/made_packings.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <span>

#include "app/calibrate/script_parameters.hpp"
#include "app/element/read_stage.hpp"
#include "app/pack/read_specification.hpp"
#include "common/error.hpp"
#include "common/packing_file.hpp"
#include "common/state.hpp"
#include "coupler/case/data_files.hpp"
#include "coupler/case/section.hpp"

namespace polargrain::app {
namespace {

using coupler::Dimension;
using coupler::Entry;
using coupler::Faults;
using coupler::Limit;
using coupler::Section;

/// Friction of a step over that of the step before.
constexpr double kStep = 0.85;
/// Friction below this share of the loosest packing's makes nothing denser.
constexpr double kLeast = 0.01;
constexpr int kTrials = 10;

std::vector<int> read_seeds(Section& section) {
  const Entry* const entry = section.require("seeds", "a list of whole numbers, a packing each");
  if (entry == nullptr) return {};
  std::vector<int> seeds = section.wholes("seeds", std::max<std::size_t>(1, entry->items.size()), 0);
  std::vector<int> sorted = seeds;
  std::ranges::sort(sorted);
  if (std::ranges::adjacent_find(sorted) != sorted.end())
    section.fault("seeds", "seeds: each makes one packing; name it once");
  return seeds;
}

MadePackings read_made_packings(const Entry& test, const Entry& packing,
                                const std::filesystem::path& directory, const ScriptRules& scripts) {
  Faults faults;
  MadePackings asked;
  Section top(test, "element test", faults);
  asked.void_ratio = top.quantity("void_ratio", Dimension::number, Limit::positive);
  asked.pressure = read_pressure(top, "pressure", Limit::positive);
  asked.script = coupler::read_cell_script("script", top, faults, {directory, scripts});
  Section section(packing, "packing", faults);
  const std::string name = section.text("specification", "a file of `polargrain pack` (YAML)");
  asked.seeds = read_seeds(section);
  asked.lowered = section.text_or("lowered", "friction");
  asked.tolerance = section.quantity_or("void_ratio_tolerance", Dimension::number, Limit::positive, 5e-3);
  section.finish();
  const auto file = coupler::find_data_file(name, directory);
  if (!name.empty() && !file)
    section.fault("specification", fmt::format("specification: there is no file '{}'", name));
  if (!faults.empty()) throw InputError(faults);
  asked.specification = read_packing_specification(*file, {}, scripts);
  if (asked.specification.void_ratio)
    section.fault("specification", fmt::format("specification: {} names a void_ratio; take it out, the "
                                               "tests say theirs",
                                               file->string()));
  if (!(asked.specification.friction > 0.0))
    section.fault("specification", fmt::format("specification: {} needs the friction of the loosest packing, "
                                               "more than 0; it is lowered from there",
                                               file->string()));
  if (const std::string fault = parameter_fault(asked.specification.script, asked.lowered); !fault.empty())
    section.fault("specification", fmt::format("lowered: {}: {}", asked.specification.script_file, fault));
  if (!faults.empty()) throw InputError(faults);
  return asked;
}

std::string hash_of(const std::string& text) {
  return name_of(std::as_bytes(std::span(text))).text().substr(0, 12);
}

/// One seed's way from its loosest packing to denser ones.
class Compaction {
 public:
  Compaction(const MadePackings& asked, int seed, std::filesystem::path folder, const PackingTools& tools,
             const std::function<void(const std::string&)>& tell)
      : asked_(asked), seed_(seed), folder_(std::move(folder)), tools_(tools), tell_(tell) {}

  /// At the void ratio, under the pressure of the specification.
  std::filesystem::path at_void_ratio() {
    const std::filesystem::path file = named(fmt::format("e{:.5g}", asked_.void_ratio));
    if (std::filesystem::exists(file)) return file;
    std::filesystem::path loose = rung(0);
    if (void_ratio_of(loose) + asked_.tolerance < asked_.void_ratio)
      throw RunError(fmt::format(
          "a void ratio of {:.4g} is out of reach: the loosest packing of seed {} has {:.4f}; raise 'friction' "
          "of the specification, or the resistance of its script against rolling",
          asked_.void_ratio, seed_, void_ratio_of(loose)));
    std::filesystem::path dense = loose;
    int step = 0;
    while (void_ratio_of(dense) > asked_.void_ratio) {
      loose = dense;
      if (friction_of(++step) < kLeast * asked_.specification.friction)
        throw RunError(fmt::format(
            "a void ratio of {:.4g} is out of reach: seed {} comes to {:.4f} with nearly no friction",
            asked_.void_ratio, seed_, void_ratio_of(loose)));
      dense = rung(step);
    }
    std::filesystem::copy_file(between(loose, step - 1, dense), file);
    return file;
  }

  /// The same under script and pressure of the test.
  std::filesystem::path for_test() {
    const std::filesystem::path file = named(fmt::format(
        "e{:.5g}-{:.4g}kPa-{}", asked_.void_ratio, 1e-3 * asked_.pressure, hash_of(asked_.script.text)));
    if (std::filesystem::exists(file)) return file;
    PackingSpecification settling = asked_.specification;
    settling.script = asked_.script.text;
    settling.script_file = asked_.script.file;
    settling.pressure = asked_.pressure;
    settle(at_void_ratio(), settling, file);
    return file;
  }

 private:
  [[nodiscard]] std::filesystem::path named(const std::string& what) const {
    return folder_ / fmt::format("seed{}-{}.h5", seed_, what);
  }
  [[nodiscard]] double friction_of(int step) const {
    return asked_.specification.friction * std::pow(kStep, step);
  }
  static double void_ratio_of(const std::filesystem::path& file) {
    return read_packing_file(file).reached.void_ratio;
  }
  [[nodiscard]] double miss(const std::filesystem::path& file) const {
    return std::abs(void_ratio_of(file) - asked_.void_ratio);
  }

  void settle(const std::filesystem::path& from, const PackingSpecification& settling,
              const std::filesystem::path& to) {
    make_packing_file(
        [&](const auto& progress) { return tools_.settle(settling, read_packing_file(from), progress); }, to,
        tools_, true);
    if (tell_) tell_(fmt::format("packing {}: void ratio {:.4f}", to.filename().string(), void_ratio_of(to)));
  }

  std::filesystem::path lowered(const std::filesystem::path& from, double friction) {
    const std::filesystem::path file = named(fmt::format(
        "from-{}-{:.6g}", from.stem().string().substr(from.stem().string().find('-') + 1), friction));
    if (std::filesystem::exists(file)) return file;
    PackingSpecification settling = asked_.specification;
    settling.script = with_parameters(settling.script, {{asked_.lowered, friction}});
    settle(from, settling, file);
    return file;
  }

  /// The packing of a step. Step 0 has the loosest.
  std::filesystem::path rung(int step) {
    const std::filesystem::path file = named(fmt::format("step{}", step));
    if (std::filesystem::exists(file)) return file;
    PackingSpecification specification = asked_.specification;
    specification.seed = static_cast<std::uint64_t>(seed_);
    if (step == 0) {
      make_packing_file([&](const auto& progress) { return tools_.make(specification, progress); }, file,
                        tools_, true);
      if (tell_)
        tell_(fmt::format("packing {}: void ratio {:.4f}", file.filename().string(), void_ratio_of(file)));
      return file;
    }
    specification.script = with_parameters(specification.script, {{asked_.lowered, friction_of(step)}});
    settle(rung(step - 1), specification, file);
    return file;
  }

  /// Starting from the loose one, whose void ratio is too large; with the friction of the next step it is too small.
  std::filesystem::path between(const std::filesystem::path& loose, int step,
                                const std::filesystem::path& dense) {
    std::filesystem::path best = miss(loose) < miss(dense) ? loose : dense;
    double high = friction_of(step);
    double low = friction_of(step + 1);
    double above = void_ratio_of(loose);
    double below = void_ratio_of(dense);
    for (int trial = 0; trial < kTrials && miss(best) > asked_.tolerance; ++trial) {
      // The secant, but no nearer to an end than a tenth: grains give way in jumps.
      const double way = std::clamp((above - asked_.void_ratio) / (above - below), 0.1, 0.9);
      const double friction = trial % 3 == 2 ? 0.5 * (high + low) : high + way * (low - high);
      const std::filesystem::path made = lowered(loose, friction);
      if (miss(made) < miss(best)) best = made;
      const double reached = void_ratio_of(made);
      (reached > asked_.void_ratio ? high : low) = friction;
      (reached > asked_.void_ratio ? above : below) = reached;
    }
    if (miss(best) > asked_.tolerance)
      throw RunError(fmt::format(
          "no packing of seed {} has a void ratio of {:.4g} within {:.1e}; the closest is {:.1e} off. Raise "
          "void_ratio_tolerance, take more grains or another seed",
          seed_, asked_.void_ratio, asked_.tolerance, miss(best)));
    return best;
  }

  const MadePackings& asked_;
  int seed_;
  std::filesystem::path folder_;
  const PackingTools& tools_;
  const std::function<void(const std::string&)>& tell_;
};

}  // namespace

coupler::Entry with_made_packings(Entry test, const std::filesystem::path& directory,
                                  const ScriptRules& scripts, const PackingsOf& packings_of) {
  const Entry* const packing = test.find("packing");
  if (packing == nullptr || packing->kind != Entry::Kind::map) return test;
  Entry files;
  files.kind = Entry::Kind::sequence;
  files.file = packing->file;
  files.line = packing->line;
  for (const std::filesystem::path& file :
       packings_of(read_made_packings(test, *packing, directory, scripts))) {
    Entry one;
    one.kind = Entry::Kind::scalar;
    one.text = std::filesystem::absolute(file).string();
    one.file = files.file;
    one.line = files.line;
    files.items.push_back(std::move(one));
  }
  // The void ratio of the packings is no longer asked for: it is theirs.
  std::erase_if(test.members, [](const Entry::Member& member) { return member.key == "void_ratio"; });
  for (Entry::Member& member : test.members)
    if (member.key == "packing") member.value = files;
  return test;
}

std::vector<std::filesystem::path> stand_ins(const MadePackings& asked, const std::filesystem::path& folder) {
  PreparedPacking prepared;
  prepared.packing.dimension = asked.specification.dimension;
  prepared.packing.box = 4.0 * Eigen::Matrix2d::Identity();
  prepared.packing.thickness = 4.0;
  for (int k = 0; k < 4; ++k) {
    Grain grain;
    grain.id = k;
    grain.position = {1.0 + 2.0 * (k % 2), 1.0 + 2.0 * (k / 2)};
    grain.radius = grain.mass = grain.moment_of_inertia = 1.0;
    grain.height = asked.specification.dimension == 3 ? 2.0 : 0.0;
    prepared.packing.grains.push_back(grain);
  }
  std::vector<std::filesystem::path> files;
  for (const int seed : asked.seeds) {
    // Packings of two seeds differ. Copies are refused as samples.
    prepared.packing.grains.front().mass = 1.0 + seed;
    files.push_back(folder / fmt::format("seed{}-e{:.5g}.h5", seed, asked.void_ratio));
    write_packing_file(files.back(), prepared);
  }
  return files;
}

std::vector<std::filesystem::path> make_packings(const MadePackings& asked,
                                                 const std::filesystem::path& folder,
                                                 const PackingTools& tools,
                                                 const std::function<void(const std::string&)>& tell) {
  const std::filesystem::path own = folder / hash_of(asked.specification.text + asked.specification.script +
                                                     asked.lowered + fmt::format("{:.6g}", asked.tolerance));
  std::filesystem::create_directories(own);
  std::vector<std::filesystem::path> files;
  for (const int seed : asked.seeds) files.push_back(Compaction(asked, seed, own, tools, tell).for_test());
  return files;
}

}  // namespace polargrain::app
