// SPDX-License-Identifier: GPL-2.0-or-later
// A worker that misbehaves:   strange_worker WAY --connect URL [--key FILE]
//
//     version      speaks another version
//     garbage      answers with bytes that are no message
//     nothing      never answers
//     works        says for ever that it works
//
// The others answer like the fake engine, but for one thing:
//
//     forgets      has no state when it is asked for one
//     lies         brings another state than the one it named
//     nan          its states hold a NaN
//     short, empty, huge   its states have 100 bytes, none, 20 MB
//     misnames     names states that its cells do not come to, and goes when they are fetched
//     falsifies    the same, and its stresses are a little off
//     diagnostics  a NaN among its diagnostics
//     refuses      answers nothing
//     shouts       answers nothing, with 5 MB of words that steer a terminal
//     misses       wants everything sent again and again
#include <unistd.h>

#include <cmath>
#include <cstdio>
#include <cstring>
#include <limits>
#include <map>
#include <optional>
#include <span>
#include <string>
#include <utility>
#include <zmq.hpp>

#include "coupler/pool/keys.hpp"
#include "coupler/protocol/messages.hpp"
#include "tests/integration/fake_engine.hpp"

namespace {

using namespace polargrain;
using namespace polargrain::coupler;

constexpr std::size_t kHuge = 20'000'000;

StatePointer state_of(std::vector<double> content) {
  const auto bytes = std::as_bytes(std::span(content));
  return std::make_shared<const State>(std::vector<std::byte>(bytes.begin(), bytes.end()));
}

class Stranger {
 public:
  explicit Stranger(std::string way) : way_(std::move(way)) {}

  std::optional<Message> answer(const Message& message) {
    if (const auto* define = std::get_if<Define>(&message)) {
      engines_[define->definition] = testing::make_fake_engine(define->cell);
    } else if (const auto* initial = std::get_if<InitialRequest>(&message)) {
      if (way_ == "refuses" || way_ == "shouts") return refusal(initial->request);
      return Reply{initial->request, {falsified(engines_.at(initial->definition)->initial())}};
    } else if (const auto* evaluate = std::get_if<EvaluateRequest>(&message)) {
      return evaluated(*evaluate);
    } else if (const auto* fetch = std::get_if<FetchRequest>(&message)) {
      return fetched(*fetch);
    }
    return std::nullopt;
  }

 private:
  [[nodiscard]] Message refusal(std::uint64_t request) const {
    std::string words = "I would rather not";
    if (way_ == "shouts")
      while (words.size() < 5'000'000) words += "\x1b[31mALARM\x1b[0m\a\r\n";
    return Refusal{request, 0, words};
  }

  Message evaluated(const EvaluateRequest& request) {
    if (way_ == "refuses" || way_ == "shouts") return refusal(request.request);
    if (way_ == "misses") return Missing{request.request, true, {}};
    Reply reply{request.request, {}};
    Missing missing{request.request, false, {}};
    for (const CellToEvaluate& cell : request.cells) {
      if (cell.state) known_[cell.base] = cell.state;
      if (!cell.from_packing && !known_.contains(cell.base)) missing.bases.push_back(cell.base);
    }
    if (!missing.bases.empty()) return missing;
    for (const CellToEvaluate& cell : request.cells) {
      const CellRequest asked{cell.from_packing ? nullptr : known_.at(cell.base), cell.increment};
      CellReply& answer =
          reply.cells.emplace_back(falsified(engines_.at(request.definition)->evaluate(asked)));
      known_[answer.state->name()] = answer.state;
      if (!request.bring && way_ != "short" && way_ != "empty" && way_ != "huge")
        answer.state = std::make_shared<const State>(answer.state->name(), answer.state->size());
    }
    return reply;
  }

  Message fetched(const FetchRequest& request) {
    if (way_ == "misnames" || way_ == "falsifies") std::_Exit(0);
    States found{request.request, {}};
    for (const ContentName& name : request.names) {
      found.states.push_back(way_ == "forgets" ? nullptr
                             : way_ == "lies"  ? state_of({0, 0, 0, 0, 0, 47.11})
                                               : known_.at(name));
    }
    return found;
  }

  [[nodiscard]] CellReply falsified(CellReply reply) {
    std::vector<std::byte> bytes(reply.state->bytes().begin(), reply.state->bytes().end());
    if (way_ == "short") bytes.resize(100);
    if (way_ == "empty") bytes.clear();
    if (way_ == "huge" && !std::exchange(was_huge_, true)) bytes.resize(kHuge);
    const double nan = std::numeric_limits<double>::quiet_NaN();
    if (way_ == "nan") std::memcpy(bytes.data() + 16, &nan, sizeof nan);
    if (way_ == "misnames" || way_ == "falsifies") bytes[20] ^= std::byte{1};
    if (way_ == "falsifies") reply.response.stress(1, 1) *= 1.0 + 1e-9;
    if (way_ == "diagnostics") reply.diagnostics.void_ratio = nan;
    reply.state = std::make_shared<const State>(std::move(bytes));
    return reply;
  }

  std::string way_;
  bool was_huge_ = false;  ///< one such state is enough: a message may have 1 GB
  std::map<std::uint32_t, std::unique_ptr<CellService>> engines_;
  std::map<ContentName, StatePointer> known_;
};

void prove(zmq::socket_t& socket, const char* file) {
  const WorkerKey key = read_worker_key(file);
  socket.set(zmq::sockopt::curve_publickey, key.public_key);
  socket.set(zmq::sockopt::curve_secretkey, key.secret_key);
  socket.set(zmq::sockopt::curve_serverkey, key.coordinator_key);
}

}  // namespace

int main(int count, char** arguments) {
  if (count != 4 && count != 6) return 2;
  const std::string way = arguments[1];
  const std::string first = arguments[2];
  const char* const url = first == "--connect" ? arguments[3] : arguments[5];
  zmq::context_t context;
  zmq::socket_t socket(context, zmq::socket_type::dealer);
  socket.set(zmq::sockopt::linger, 0);
  if (count == 6) prove(socket, first == "--key" ? arguments[3] : arguments[5]);
  socket.connect(url);
  const std::string hello =
      encode(Hello{way == "version" ? kProtocolVersion + 1 : kProtocolVersion, getpid(), "here"});
  socket.send(zmq::buffer(hello));
  Stranger stranger(way);
  for (zmq::message_t bytes; socket.recv(bytes);) {
    const Envelope envelope = decode({static_cast<const std::byte*>(bytes.data()), bytes.size()});
    if (const auto* stop = std::get_if<Stop>(&envelope.message)) {
      std::printf("%s\n", stop->reason.c_str());
      return stop->reason.empty() ? 0 : 1;
    }
    if (way == "garbage" && std::holds_alternative<EvaluateRequest>(envelope.message))
      socket.send(zmq::str_buffer("\x93garbage"));
    if (const auto* request = std::get_if<EvaluateRequest>(&envelope.message);
        way == "works" && request != nullptr) {
      for (;; usleep(50000)) {
        zmq::message_t word;
        if (socket.recv(word, zmq::recv_flags::dontwait) &&
            std::holds_alternative<Stop>(
                decode({static_cast<const std::byte*>(word.data()), word.size()}).message))
          return 1;
        socket.send(zmq::buffer(encode(Working{request->request}, envelope.session)),
                    zmq::send_flags::dontwait);
      }
    }
    if (way == "garbage" || way == "nothing") continue;
    if (const auto answer = stranger.answer(envelope.message))
      socket.send(zmq::buffer(encode(*answer, envelope.session)));
  }
}
