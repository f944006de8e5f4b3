// SPDX-License-Identifier: GPL-2.0-or-later
#include "common/content_hash.hpp"

#include <fmt/format.h>
#include <xxhash.h>

#include <fstream>
#include <memory>
#include <vector>

#include "common/error.hpp"
#include "common/regular_file.hpp"

namespace polargrain {

ContentName content_hash(const std::filesystem::path& file) {
  if (const std::string reason = why_no_input(file); !reason.empty())
    throw RunError(fmt::format("{}: {}", file.string(), reason));
  const std::unique_ptr<XXH3_state_t, XXH_errorcode (*)(XXH3_state_t*)> state(XXH3_createState(),
                                                                              XXH3_freeState);
  XXH3_128bits_reset(state.get());
  std::ifstream in(file, std::ios::binary);
  std::vector<char> block(1 << 20);
  while (in.read(block.data(), static_cast<std::streamsize>(block.size())) || in.gcount() > 0)
    XXH3_128bits_update(state.get(), block.data(), static_cast<std::size_t>(in.gcount()));
  if (!in.eof()) throw RunError(fmt::format("{} cannot be read", file.string()));
  const XXH128_hash_t hash = XXH3_128bits_digest(state.get());
  return {hash.high64, hash.low64};
}

}  // namespace polargrain
