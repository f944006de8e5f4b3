// SPDX-License-Identifier: GPL-2.0-or-later
#pragma once
#include <hdf5.h>

#include <cstddef>
#include <cstdint>
#include <string>
#include <type_traits>

#include "common/error.hpp"

namespace polargrain::hdf5 {

/// The common format of packings and checkpoints: one-dimensional arrays by name. Every function @throws RunError with
/// the name of the array that failed; the caller says which file.

/// A handle of the library, closed when it goes.
class Handle {
 public:
  Handle(hid_t id, herr_t (*close)(hid_t), const std::string& what) : id_(id), close_(close) {
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

inline void check(herr_t status, const std::string& what) {
  if (status < 0) throw RunError(what);
}

/// The library prints its errors by itself unless told not to.
inline void silence() {
  H5Eset_auto2(H5E_DEFAULT, nullptr, nullptr);
}

/// The native type of the elements of an array.
template <class Value>
hid_t native_type() {
  if constexpr (std::is_same_v<Value, double>) return H5T_NATIVE_DOUBLE;
  if constexpr (std::is_same_v<Value, std::int64_t>) return H5T_NATIVE_INT64;
  if constexpr (std::is_same_v<Value, std::uint8_t> || std::is_same_v<Value, std::byte>)
    return H5T_NATIVE_UINT8;
  if constexpr (std::is_same_v<Value, char>) return H5T_NATIVE_CHAR;
  if constexpr (std::is_same_v<Value, int>) return H5T_NATIVE_INT;
}

/// A new array of so many elements. Groups on the way are made.
inline Handle make_array(hid_t file, const std::string& name, hid_t type, hsize_t size) {
  const Handle space(H5Screate_simple(1, &size, nullptr), H5Sclose, name);
  // Times of writing would make equal files differ.
  const Handle properties(H5Pcreate(H5P_DATASET_CREATE), H5Pclose, name);
  check(H5Pset_obj_track_times(properties, false), name);
  const Handle link(H5Pcreate(H5P_LINK_CREATE), H5Pclose, name);
  check(H5Pset_create_intermediate_group(link, 1), name);
  return {H5Dcreate2(file, name.c_str(), type, space, link, properties, H5P_DEFAULT), H5Dclose, name};
}

template <class Array>
void write_array(hid_t file, const std::string& name, const Array& array) {
  const hid_t type = native_type<typename Array::value_type>();
  const Handle set = make_array(file, name, type, array.size());
  if (array.size() > 0) check(H5Dwrite(set, type, H5S_ALL, H5S_ALL, H5P_DEFAULT, array.data()), name);
}

/// Opens an array. HDF5 lets a file name other files, by links or as the place of values, and would read whatever they
/// are: no link to another file is followed.
inline Handle open_array(hid_t file, const std::string& name) {
  const Handle access(H5Pcreate(H5P_DATASET_ACCESS), H5Pclose, name);
  const H5L_elink_traverse_t refuse = [](const char*, const char*, const char*, const char*, unsigned*, hid_t,
                                         void*) -> herr_t { return -1; };
  check(H5Pset_elink_cb(access, refuse, nullptr), name);
  return {H5Dopen2(file, name.c_str(), access), H5Dclose, name};
}

/// @throws RunError when the values of an array do not lie in the file itself, one behind the other, as this program
/// writes them
inline void check_place(hid_t set, const std::string& name) {
  const Handle made(H5Dget_create_plist(set), H5Pclose, name);
  const H5D_layout_t layout = H5Pget_layout(made);
  if ((layout != H5D_CONTIGUOUS && layout != H5D_COMPACT) || H5Pget_external_count(made) != 0)
    throw RunError(name + ": its values do not lie in the file itself");
}

/// Number of elements of an array of a file. @throws RunError when it is not of one dimension, or larger than
/// the file, as only a damaged one can be
inline hsize_t size_of_array(hid_t file, hid_t set, const std::string& name, std::size_t bytes_each) {
  check_place(set, name);
  const Handle space(H5Dget_space(set), H5Sclose, name);
  const hssize_t size = H5Sget_simple_extent_npoints(space);
  hsize_t most = 0;
  check(H5Fget_filesize(file, &most), name);
  if (H5Sget_simple_extent_ndims(space) != 1 || size < 0 || static_cast<hsize_t>(size) > most / bytes_each)
    throw RunError(name);
  return static_cast<hsize_t>(size);
}

template <class Array>
void read_array(hid_t file, const std::string& name, Array& array) {
  using Value = typename Array::value_type;
  const Handle set = open_array(file, name);
  array.resize(static_cast<std::size_t>(size_of_array(file, set, name, sizeof(Value))));
  if (!array.empty())
    check(H5Dread(set, native_type<Value>(), H5S_ALL, H5S_ALL, H5P_DEFAULT, array.data()), name);
}

}  // namespace polargrain::hdf5
