// SPDX-License-Identifier: GPL-2.0-or-later
#include "common/file_in_memory.hpp"

#include <algorithm>
#include <cstdlib>
#include <cstring>

namespace polargrain::hdf5 {

struct FileInMemory::Image {
  void* bytes = nullptr;
  std::size_t capacity = 0;
  std::size_t expected = 0;
  /// Memory of a size that keeps its content; null where the system has no more.
  void* grown(std::size_t size) {
    if (size <= capacity) return bytes;
    const std::size_t wanted = std::max(size, expected);
    void* const larger = std::realloc(bytes, wanted);
    if (larger == nullptr) return nullptr;
    capacity = wanted;
    return bytes = larger;
  }
  ~Image() { std::free(bytes); }
};

namespace {

/// The library asks for memory in such steps.
constexpr std::size_t kGrowth = std::size_t{4} << 20;

}  // namespace

FileInMemory::FileInMemory(std::size_t expected) : image_(std::make_unique<Image>()) {
  image_->expected = expected;
  const Handle access(H5Pcreate(H5P_FILE_ACCESS), H5Pclose, "access");
  check(H5Pset_fapl_core(access, kGrowth, false), "access");
  H5FD_file_image_callbacks_t calls{};
  calls.image_malloc = [](std::size_t size, H5FD_file_image_op_t, void* image) -> void* {
    return static_cast<Image*>(image)->grown(size);
  };
  calls.image_realloc = [](void*, std::size_t size, H5FD_file_image_op_t, void* image) -> void* {
    return static_cast<Image*>(image)->grown(size);
  };
  calls.image_memcpy = [](void* to, const void* from, std::size_t size, H5FD_file_image_op_t, void*) {
    return std::memcpy(to, from, size);
  };
  calls.image_free = [](void*, H5FD_file_image_op_t, void*) -> herr_t { return 0; };  // it stays
  calls.udata_copy = [](void* image) { return image; };
  calls.udata_free = [](void*) -> herr_t { return 0; };
  calls.udata = image_.get();
  check(H5Pset_file_image_callbacks(access, &calls), "access");
  file_.emplace(H5Fcreate("in_memory", H5F_ACC_TRUNC, H5P_DEFAULT, access), H5Fclose, "a file in memory");
}

FileInMemory::~FileInMemory() = default;

std::string_view FileInMemory::close() {
  check(H5Fflush(*file_, H5F_SCOPE_GLOBAL), "flush");
  const ssize_t size = H5Fget_file_image(*file_, nullptr, 0);
  if (size < 0) throw RunError("size");
  file_.reset();
  return {static_cast<const char*>(image_->bytes), static_cast<std::size_t>(size)};
}

}  // namespace polargrain::hdf5
