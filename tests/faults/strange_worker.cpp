// SPDX-License-Identifier: GPL-2.0-or-later
// A worker that misbehaves:   strange_worker version|garbage|nothing --connect URL
#include <unistd.h>

#include <cstdio>
#include <string>
#include <zmq.hpp>

#include "coupler/protocol/messages.hpp"

int main(int count, char** arguments) {
  using namespace polargrain::coupler;
  if (count != 4) return 2;
  const std::string way = arguments[1];
  zmq::context_t context;
  zmq::socket_t socket(context, zmq::socket_type::dealer);
  socket.connect(arguments[3]);
  const std::string hello =
      encode(Hello{way == "version" ? kProtocolVersion + 1 : kProtocolVersion, getpid(), "here"});
  socket.send(zmq::buffer(hello));
  for (zmq::message_t bytes; socket.recv(bytes);) {
    const Envelope envelope = decode({static_cast<const std::byte*>(bytes.data()), bytes.size()});
    if (const auto* stop = std::get_if<Stop>(&envelope.message)) {
      std::printf("%s\n", stop->reason.c_str());
      return 0;
    }
    const bool request = std::holds_alternative<EvaluateRequest>(envelope.message);
    if (way == "garbage" && request) socket.send(zmq::str_buffer("\x93garbage"));
  }
}
