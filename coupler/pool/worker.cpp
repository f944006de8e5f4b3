// SPDX-License-Identifier: GPL-2.0-or-later
#include "coupler/pool/worker.hpp"

#include <fmt/format.h>
#include <unistd.h>

#include <map>
#include <zmq.hpp>

#include "common/error.hpp"
#include "coupler/pool/state_cache.hpp"
#include "coupler/protocol/messages.hpp"

namespace polargrain::coupler {
namespace {

/// Turns each message received into the message to send back.
class Desk {
 public:
  Desk(const CellServiceFactory& make_service, std::size_t cache_bytes)
      : make_service_(make_service), cache_(cache_bytes) {}

  /// @returns false when there is nothing to send back
  bool answer(const Message& message, Message& reply) {
    if (const auto* define = std::get_if<Define>(&message)) {
      definitions_[define->definition] = define->cell;
      services_.erase(define->definition);
      return false;
    }
    if (const auto* initial = std::get_if<InitialRequest>(&message)) {
      reply = served(*initial, [&](CellService& service) { return service.initial(); });
      return true;
    }
    if (const auto* evaluate = std::get_if<EvaluateRequest>(&message)) {
      reply = evaluated(*evaluate);
      return true;
    }
    throw ProtocolError("a worker was sent a message that only workers send");
  }

 private:
  Message evaluated(const EvaluateRequest& request) {
    CellRequest cell{nullptr, request.increment};
    if (!request.from_packing) {
      if (request.state) cache_.keep(request.state);
      cell.state = request.state ? request.state : cache_.find(request.base);
      if (!cell.state) return MissingState{request.request};
    }
    return served(request, [&](CellService& service) { return service.evaluate(cell); });
  }

  template <class Request, class Call>
  Message served(const Request& request, const Call& call) {
    try {
      Reply reply{request.request, call(service(request.definition))};
      if (reply.cell.state) cache_.keep(reply.cell.state);
      return reply;
    } catch (const std::exception& error) {
      return Refusal{request.request, error.what()};
    }
  }

  CellService& service(std::uint32_t definition) {
    const auto cell = definitions_.find(definition);
    if (cell == definitions_.end())
      throw RunError(fmt::format("no definition {} was sent before", definition));
    std::unique_ptr<CellService>& service = services_[definition];
    if (!service) service = make_service_(cell->second);
    return *service;
  }

  const CellServiceFactory& make_service_;
  StateCache cache_;
  std::map<std::uint32_t, CellDefinition> definitions_;
  std::map<std::uint32_t, std::unique_ptr<CellService>> services_;
};

void send(zmq::socket_t& socket, const Message& message) {
  socket.send(zmq::buffer(encode(message)), zmq::send_flags::none);
}

}  // namespace

void serve(const std::string& url, const CellServiceFactory& make_service, std::size_t cache_bytes) try {
  zmq::context_t context;
  zmq::socket_t socket(context, zmq::socket_type::dealer);
  // What is still unsent when a worker is told to stop is of no use to anybody.
  socket.set(zmq::sockopt::linger, 0);
  socket.set(zmq::sockopt::maxmsgsize, static_cast<std::int64_t>(kLongestMessage));
  socket.connect(url);
  send(socket, Hello{kProtocolVersion, getpid()});
  Desk desk(make_service, cache_bytes);
  for (zmq::message_t bytes;;) {
    if (!socket.recv(bytes)) continue;
    const Message message = decode({static_cast<const std::byte*>(bytes.data()), bytes.size()});
    if (std::holds_alternative<Stop>(message)) return;
    Message reply = Stop{};
    if (desk.answer(message, reply)) send(socket, reply);
  }
} catch (const zmq::error_t& error) {
  throw RunError(fmt::format("the connection to the coordinator at {} failed: {}", url, error.what()));
}

}  // namespace polargrain::coupler
