// SPDX-License-Identifier: GPL-2.0-or-later
// Whatever bytes arrive, decode either refuses them or gives a message that travels unchanged.
#include "coupler/protocol/messages.hpp"

#include <cstdint>
#include <cstdlib>
#include <span>

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  using namespace polargrain::coupler;
  try {
    const Envelope envelope = decode(std::as_bytes(std::span(data, size)));
    const std::string bytes = encode(envelope.message, envelope.session);
    const Envelope again = decode(std::as_bytes(std::span(bytes)));
    if (encode(again.message, again.session) != bytes) std::abort();
  } catch (const ProtocolError&) {  // refused, as it should be
  }
  return 0;
}
