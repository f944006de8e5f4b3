// SPDX-License-Identifier: GPL-2.0-or-later
#include "common/packing_file.hpp"

#include <fmt/format.h>
#include <hdf5.h>

#include <array>
#include <cmath>
#include <cstring>
#include <set>
#include <system_error>
#include <utility>

#include "common/error.hpp"
#include "common/state.hpp"

namespace polargrain {

namespace {

constexpr int kPlane = 1;  // versions
constexpr int kSpace = 2;  // with the heights of the grains
constexpr hsize_t kMostBytes = hsize_t{1} << 31;

/// A handle of the library, closed when it goes.
class Handle {
 public:
  Handle(hid_t id, herr_t (*close)(hid_t), const char* what) : id_(id), close_(close) {
    if (id < 0) throw RunError(what);
  }
  Handle(const Handle&) = delete;
  Handle& operator=(const Handle&) = delete;
  ~Handle() { close_(id_); }
  operator hid_t() const { return id_; }  // NOLINT: it stands for the library's own handle

 private:
  hid_t id_;
  herr_t (*close_)(hid_t);
};

void check(herr_t status, const char* what) {
  if (status < 0) throw RunError(what);
}

/// What a file consists of: named arrays of bytes or doubles, and their hash.
struct Content {
  std::string specification;
  std::vector<double> box;       // columns are base vectors, one after the other; then the thickness
  std::vector<std::int64_t> id;  // of the grains
  std::vector<double> grains;    // x, y, radius, mass, moment of inertia of each
  std::vector<double> reached;   // in the order of PackingReached
  std::vector<std::uint8_t> state;
  std::vector<double> heights;  // of the grains; none in a plane packing, nor in its file
  int version = kPlane;

  /// Visits name, type and array of each part; one list for writing, reading and hashing.
  template <typename Visitor>
  void visit(Visitor visitor) {
    visitor("box", H5T_NATIVE_DOUBLE, box);
    visitor("grain_id", H5T_NATIVE_INT64, id);
    visitor("grain_x_y_radius_mass_inertia", H5T_NATIVE_DOUBLE, grains);
    visitor("reached", H5T_NATIVE_DOUBLE, reached);
    visitor("contact_state", H5T_NATIVE_UINT8, state);
    visitor("specification", H5T_NATIVE_CHAR, specification);
    if (version == kSpace) visitor("grain_height", H5T_NATIVE_DOUBLE, heights);
  }

  std::string name() {
    std::vector<std::byte> bytes;
    visit([&bytes](const char*, hid_t, const auto& array) {
      const std::size_t size = array.size() * sizeof(array[0]);
      const std::size_t place = bytes.size();
      bytes.resize(place + sizeof(size) + size);
      std::memcpy(&bytes[place], &size, sizeof(size));
      if (size > 0) std::memcpy(&bytes[place + sizeof(size)], array.data(), size);
    });
    return name_of(bytes).text();
  }
};

template <typename Array>
void write_array(hid_t file, const char* name, hid_t type, const Array& array) {
  const hsize_t size = array.size();
  const Handle space(H5Screate_simple(1, &size, nullptr), H5Sclose, "no data space");
  // Times of writing would make equal packings differ.
  const Handle properties(H5Pcreate(H5P_DATASET_CREATE), H5Pclose, "no properties");
  check(H5Pset_obj_track_times(properties, false), "times");
  const Handle set(H5Dcreate2(file, name, type, space, H5P_DEFAULT, properties, H5P_DEFAULT), H5Dclose, name);
  if (size > 0) check(H5Dwrite(set, type, H5S_ALL, H5S_ALL, H5P_DEFAULT, array.data()), name);
}

template <typename Array>
void read_array(hid_t file, const char* name, hid_t type, Array& array) {
  const Handle set(H5Dopen2(file, name, H5P_DEFAULT), H5Dclose, name);
  const Handle space(H5Dget_space(set), H5Sclose, name);
  const hssize_t size = H5Sget_simple_extent_npoints(space);
  if (H5Sget_simple_extent_ndims(space) != 1 || size < 0 ||
      static_cast<hsize_t>(size) * sizeof(array[0]) > kMostBytes)
    throw RunError(name);
  array.resize(static_cast<std::size_t>(size));
  if (size > 0) check(H5Dread(set, type, H5S_ALL, H5S_ALL, H5P_DEFAULT, array.data()), name);
}

Content content_of(const PreparedPacking& prepared) {
  const Packing& packing = prepared.packing;
  const PackingReached& r = prepared.reached;
  Content content;
  content.specification = prepared.specification;
  content.box = {packing.box(0, 0), packing.box(1, 0), packing.box(0, 1), packing.box(1, 1),
                 packing.thickness};
  for (const Grain& grain : packing.grains) {
    content.id.push_back(grain.id);
    for (const double value :
         {grain.position.x(), grain.position.y(), grain.radius, grain.mass, grain.moment_of_inertia})
      content.grains.push_back(value);
    if (packing.dimension == 3) content.heights.push_back(grain.height);
  }
  content.version = packing.dimension == 3 ? kSpace : kPlane;
  content.reached = {r.void_ratio,
                     r.coordination_number,
                     r.rattlers,
                     r.pressure,
                     r.anisotropy,
                     r.shear,
                     r.unbalanced_force_ratio,
                     r.unbalanced_moment_ratio,
                     r.friction,
                     r.dem_steps};
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
  require(content.box.size() == kValues, "the box is no box");
  require(!content.id.empty() && content.grains.size() == kValues * content.id.size(),
          "the grains are incomplete");
  require(content.reached.size() == 10, "what was reached is incomplete");
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
  const std::vector<double>& r = content.reached;
  prepared.reached = {r[0], r[1], r[2], r[3], r[4], r[5], r[6], r[7], r[8], r[9]};
  if (!content.state.empty()) {
    std::vector<std::byte> bytes(content.state.size());
    std::memcpy(bytes.data(), content.state.data(), bytes.size());
    packing.state = std::make_shared<const State>(std::move(bytes));
  }
  return prepared;
}

/// The library prints its errors by itself unless told not to.
void silence() {
  H5Eset_auto2(H5E_DEFAULT, nullptr, nullptr);
}

}  // namespace

void write_packing_file(const std::filesystem::path& file, const PreparedPacking& packing) {
  silence();
  std::filesystem::path temporary = file;
  temporary += ".part";
  try {
    Content content = content_of(packing);
    const Handle out(H5Fcreate(temporary.c_str(), H5F_ACC_TRUNC, H5P_DEFAULT, H5P_DEFAULT), H5Fclose,
                     "no file");
    write_array(out, "version", H5T_NATIVE_INT, std::array<int, 1>{content.version});
    write_array(out, "content_hash", H5T_NATIVE_CHAR, content.name());
    content.visit(
        [&](const char* name, hid_t type, const auto& array) { write_array(out, name, type, array); });
    check(H5Fflush(out, H5F_SCOPE_GLOBAL), "flush");
  } catch (const RunError&) {
    throw RunError(fmt::format("cannot write {}: is there room, and may you write there?", file.string()));
  }
  std::error_code error;
  std::filesystem::rename(temporary, file, error);
  if (error) throw RunError(fmt::format("cannot put {} in place: {}", file.string(), error.message()));
}

PreparedPacking read_packing_file(const std::filesystem::path& file) {
  silence();
  const auto fail = [&file](const std::string& message) { return InputError({file.string(), 0, message}); };
  std::error_code error;
  if (!std::filesystem::is_regular_file(file, error))
    throw fail("there is no such file; expected a packing (HDF5)");
  if (H5Fis_hdf5(file.c_str()) <= 0)
    throw fail(
        "this is no HDF5 file, or it was cut short; make it again with 'polargrain pack', or give a CSV "
        "file");
  std::vector<int> version;
  try {
    const Handle in(H5Fopen(file.c_str(), H5F_ACC_RDONLY, H5P_DEFAULT), H5Fclose, "it cannot be opened");
    read_array(in, "version", H5T_NATIVE_INT, version);
    Content content;
    if (version != std::vector<int>{kPlane} && version != std::vector<int>{kSpace})
      throw RunError("its version is not known to this program");
    content.version = version.front();
    std::string hash;
    read_array(in, "content_hash", H5T_NATIVE_CHAR, hash);
    content.visit([&](const char* name, hid_t type, auto& array) { read_array(in, name, type, array); });
    if (content.name() != hash) throw RunError("its content does not match its hash");
    return packing_of(content);
  } catch (const RunError& what) {
    throw fail(fmt::format(
        "the packing is damaged or not one of ours ({}); make it again with 'polargrain pack'", what.what()));
  }
}

}  // namespace polargrain
