// SPDX-License-Identifier: GPL-2.0-or-later
#include "common/packing_file.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstring>
#include <set>
#include <utility>

#include "common/error.hpp"
#include "common/file_in_memory.hpp"
#include "common/record_table.hpp"
#include "common/regular_file.hpp"
#include "common/sealed_file.hpp"
#include "common/state.hpp"
#include "common/trial.hpp"
#include "common/write_file.hpp"

namespace polargrain {

using hdf5::Handle;
using hdf5::read_array;
using hdf5::write_array;

namespace {

constexpr int kPlane = 1;  // versions
constexpr int kSpace = 2;  // with the heights of the grains

/// Values of PackingReached in files of before stress and fabric were among them.
constexpr std::size_t kReachedBefore = 10;

/// The content of a file: named arrays of bytes or doubles, and their hash.
struct Content {
  std::string specification;
  /// Columns are base vectors, one after the other; then the thickness and, in space, the lean (files of
  /// right boxes may lack it).
  std::vector<double> box;
  std::vector<std::int64_t> id;  // of the grains
  std::vector<double> grains;    // x, y, radius, mass, moment of inertia of each
  std::vector<double> reached;   // in the order of the description of PackingReached
  std::vector<std::uint8_t> state;
  std::vector<double> heights;  // of the grains; absent in a plane packing and in its file
  int version = kPlane;

  /// Visits name and array of each part; one list for writing, reading and hashing.
  template <typename Visitor>
  void visit(Visitor visitor) {
    visitor("box", box);
    visitor("grain_id", id);
    visitor("grain_x_y_radius_mass_inertia", grains);
    visitor("reached", reached);
    visitor("contact_state", state);
    visitor("specification", specification);
    if (version == kSpace) visitor("grain_height", heights);
  }

  std::string name() {
    std::vector<std::byte> bytes;
    visit([&bytes](const char*, const auto& array) {
      const std::size_t size = array.size() * sizeof(array[0]);
      const std::size_t place = bytes.size();
      bytes.resize(place + sizeof(size) + size);
      std::memcpy(&bytes[place], &size, sizeof(size));
      if (size > 0) std::memcpy(&bytes[place + sizeof(size)], array.data(), size);
    });
    return name_of(bytes).text();
  }
};

Content content_of(const PreparedPacking& prepared) {
  const Packing& packing = prepared.packing;
  Content content;
  content.specification = prepared.specification;
  content.box = {packing.box(0, 0), packing.box(1, 0), packing.box(0, 1), packing.box(1, 1),
                 packing.thickness};
  if (packing.dimension == 3) content.box.insert(content.box.end(), {packing.lean.x(), packing.lean.y()});
  for (const Grain& grain : packing.grains) {
    content.id.push_back(grain.id);
    for (const double value :
         {grain.position.x(), grain.position.y(), grain.radius, grain.mass, grain.moment_of_inertia})
      content.grains.push_back(value);
    if (packing.dimension == 3) content.heights.push_back(grain.height);
  }
  content.version = packing.dimension == 3 ? kSpace : kPlane;
  content.reached = values_of(prepared.reached);
  if (packing.state)
    for (const std::byte byte : packing.state->bytes())
      content.state.push_back(std::to_integer<std::uint8_t>(byte));
  return content;
}

PreparedPacking packing_of(const Content& content) {
  const auto require = [](bool fine, const char* what) {
    if (!fine) throw RunError(what);
  };
  constexpr std::size_t kValues = 5;
  const bool leans = content.version == kSpace && content.box.size() == kValues + 2;
  require(content.box.size() == kValues || leans, "the box is no box");
  require(!content.id.empty() && content.grains.size() == kValues * content.id.size(),
          "the grains are incomplete");
  std::vector<double> values_reached = content.reached;
  if (values_reached.size() == kReachedBefore)
    values_reached.resize(names_of_columns<PackingReached>().size());
  require(values_reached.size() == names_of_columns<PackingReached>().size(),
          "the record of the values reached is incomplete");
  require(content.heights.size() == (content.version == kSpace ? content.id.size() : 0),
          "the heights of the grains are incomplete");
  for (const auto* array : {&content.box, &content.grains, &content.reached, &content.heights})
    for (const double value : *array) require(std::isfinite(value), "a value is not finite");
  PreparedPacking prepared;
  prepared.specification = content.specification;
  Packing& packing = prepared.packing;
  packing.dimension = content.version == kSpace ? 3 : 2;
  packing.box << content.box[0], content.box[2], content.box[1], content.box[3];
  packing.thickness = content.box[4];
  if (leans) packing.lean << content.box[5], content.box[6];
  require(packing.volume() > 0.0 && packing.thickness > 0.0, "the box has no volume");
  std::set<std::int64_t> ids;
  for (std::size_t k = 0; k < content.id.size(); ++k) {
    const double* const values = &content.grains[kValues * k];
    const double height = content.heights.empty() ? 0.0 : content.heights[k];
    Grain grain{content.id[k], {values[0], values[1]}, values[2], values[3], values[4], height};
    require(grain.radius > 0.0 && grain.mass > 0.0, "a grain has no radius or mass");
    require(grain.id >= 0 && grain.id <= 2'000'000'000 && ids.insert(grain.id).second,
            "the ids of grains are wrong");
    packing.grains.push_back(grain);
  }
  const RecordValues reached{values_reached, {}, {}, {}};
  prepared.reached = RecordReader(reached, "the record of the values reached", true).read<PackingReached>();
  packing.pressure = std::max(0.0, prepared.reached.pressure);
  if (!content.state.empty()) {
    std::vector<std::byte> bytes(content.state.size());
    std::memcpy(bytes.data(), content.state.data(), bytes.size());
    packing.state = std::make_shared<const State>(std::move(bytes));
  }
  return prepared;
}

Content content_in(const std::filesystem::path& file) {
  const Handle in(H5Fopen(file.c_str(), H5F_ACC_RDONLY, H5P_DEFAULT), H5Fclose, "it cannot be opened");
  std::vector<int> version;
  read_array(in, "version", version);
  if (version != std::vector<int>{kPlane} && version != std::vector<int>{kSpace})
    throw RunError("its version is not known to this program");
  Content content;
  content.version = version.front();
  std::string hash;
  read_array(in, "content_hash", hash);
  content.visit([&](const char* name, auto& array) { read_array(in, name, array); });
  if (content.name() != hash) throw RunError("its content does not match its hash");
  return content;
}

}  // namespace

void write_packing_file(const std::filesystem::path& file, const PreparedPacking& packing) {
  hdf5::silence();
  Content content = content_of(packing);
  hdf5::FileInMemory made;
  const hid_t out = made.file();
  write_array(out, "version", std::array<int, 1>{content.version});
  write_array(out, "content_hash", content.name());
  content.visit([&](const char* name, const auto& array) { write_array(out, name, array); });
  const std::string_view bytes = made.close();
  const std::string mark = seal_of(bytes);
  write_file(file, std::array<std::string_view, 2>{bytes, mark});
}

PreparedPacking read_packing_file(const std::filesystem::path& file) {
  hdf5::silence();
  const auto fail = [&file](const std::string& message) { return InputError({file.string(), 0, message}); };
  if (const std::string reason = why_no_input(file); !reason.empty())
    throw fail(reason + "; expected a packing (HDF5)");
  try {
    check_seal(file);
    // A forger's file has the right hash: HDF5 is not let near it before it has survived it once.
    try_in_own_process([&file] { (void)content_in(file); });
    return packing_of(content_in(file));
  } catch (const RunError& what) {
    throw fail(fmt::format(
        "the packing is damaged or not one of ours ({}); make it again with 'polargrain pack'", what.what()));
  }
}

}  // namespace polargrain
