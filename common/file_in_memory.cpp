// SPDX-License-Identifier: GPL-2.0-or-later
#include "common/file_in_memory.hpp"

#include <cstdlib>
#include <cstring>

namespace polargrain::hdf5 {

struct FileInMemory::Image {
  void* bytes = nullptr;
  ~Image() { std::free(bytes); }
};

namespace {

/// The library takes memory for the image in such steps. To grow by the system's page tables costs nothing.
constexpr std::size_t kGrowth = std::size_t{4} << 20;

}  // namespace

FileInMemory::FileInMemory() : image_(std::make_unique<Image>()) {
  const Handle access(H5Pcreate(H5P_FILE_ACCESS), H5Pclose, "access");
  check(H5Pset_fapl_core(access, kGrowth, false), "access");
  H5FD_file_image_callbacks_t calls{};
  calls.image_malloc = [](std::size_t size, H5FD_file_image_op_t, void* image) -> void* {
    return static_cast<Image*>(image)->bytes = std::malloc(size);
  };
  calls.image_realloc = [](void*, std::size_t size, H5FD_file_image_op_t, void* image) -> void* {
    void* const grown = std::realloc(static_cast<Image*>(image)->bytes, size);
    if (grown != nullptr) static_cast<Image*>(image)->bytes = grown;
    return grown;
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
