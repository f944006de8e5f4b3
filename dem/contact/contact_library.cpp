// SPDX-License-Identifier: GPL-2.0-or-later
#include "dem/contact/contact_library.hpp"

#include <dlfcn.h>
#include <fmt/format.h>
#include <unistd.h>

#include <array>
#include <filesystem>
#include <fstream>
#include <iterator>
#include <span>

#include "common/contact_library_file.hpp"
#include "common/error.hpp"
#include "common/state.hpp"
#include "dem/contact/contact_recorder.hpp"
#include "dem/engine/quiet_errors.hpp"

namespace polargrain::dem {
namespace {

std::string host_name() {
  std::array<char, 256> name{};
  gethostname(name.data(), name.size() - 1);
  return name.data();
}

[[noreturn]] void fail(const std::string& file, const std::string& reason) {
  throw RunError(fmt::format("the contact library {} cannot be used on {}: {}", file, host_name(), reason));
}

/// @param content the name that its bytes must have, if any
void require_content(const std::string& file, const std::string& content) {
  if (!std::filesystem::is_regular_file(file))
    fail(file, "there is no such file; every machine that computes needs it under the same path");
  if (content.empty()) return;
  std::ifstream stream(file, std::ios::binary);
  const std::string bytes{std::istreambuf_iterator<char>(stream), {}};
  if (name_of(std::as_bytes(std::span(bytes))).text() != content)
    fail(file,
         "it is another one than the coordinator found when the run began; put the same file on every "
         "machine, and build it again only between runs");
}

const ContactLibrary& load(const std::string& file) {
  // An absolute path: a name without a slash would be looked for among the libraries of the system.
  const std::string path = std::filesystem::absolute(file).string();
  void* const handle = dlopen(path.c_str(), RTLD_NOW | RTLD_LOCAL | RTLD_NODELETE);
  if (handle == nullptr) fail(file, fmt::format("it cannot be loaded ({}); build it again", dlerror()));
  const auto* const library = static_cast<const ContactLibrary*>(dlsym(handle, kContactLibraryName));
  if (library == nullptr)
    fail(file,
         "it is no library of contact laws; build it with polargrain_contact_laws() of polargrain's CMake "
         "package");
  if (library->version != std::string(POLARGRAIN_VERSION) || library->contact_bytes != sizeof(Contact))
    fail(file, fmt::format("it was built for polargrain {}, this is {}; build it again", library->version,
                           POLARGRAIN_VERSION));
  return *library;
}

}  // namespace

void add_contact_library(const ContactLibraryFile& file) {
  if (file.path.empty()) return;
  require_content(file.path, file.content);
  const ContactLibrary& library = load(file.path);
  const QuietErrors quiet;
  if (const std::string reason = library.add_models(); !reason.empty()) fail(file.path, reason);
}

}  // namespace polargrain::dem
