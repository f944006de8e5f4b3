// SPDX-License-Identifier: GPL-2.0-or-later
// A worker that misbehaves:   strange_worker version|garbage|nothing|forgets|lies --connect URL
//
// The last two evaluate cells, whose states are their first entry of the increment, but when these are
// fetched they have none, or send others.
#include <unistd.h>

#include <cstdio>
#include <span>
#include <string>
#include <zmq.hpp>

#include "coupler/protocol/messages.hpp"

namespace {

using namespace polargrain;
using namespace polargrain::coupler;

StatePointer state_of(double content) {
  const auto bytes = std::as_bytes(std::span(&content, 1));
  return std::make_shared<const State>(std::vector<std::byte>(bytes.begin(), bytes.end()));
}

Reply evaluated(const EvaluateRequest& request) {
  Reply reply{request.request, {}};
  for (const CellToEvaluate& cell : request.cells) {
    CellReply& answer = reply.cells.emplace_back();
    answer.state = state_of(cell.increment.displacement_gradient(0, 0));
    if (!request.bring) {
      answer.state = std::make_shared<const State>(answer.state->name(), answer.state->size());
    }
  }
  return reply;
}

}  // namespace

int main(int count, char** arguments) {
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
    const auto say = [&](const Message& answer) {
      socket.send(zmq::buffer(encode(answer, envelope.session)));
    };
    const auto* request = std::get_if<EvaluateRequest>(&envelope.message);
    if (way == "garbage" && request != nullptr) socket.send(zmq::str_buffer("\x93garbage"));
    if (way != "forgets" && way != "lies") continue;
    if (request != nullptr) say(evaluated(*request));
    if (const auto* fetch = std::get_if<FetchRequest>(&envelope.message)) {
      say(States{fetch->request, {fetch->names.size(), way == "lies" ? state_of(47.11) : nullptr}});
    }
  }
}
