// SPDX-License-Identifier: GPL-2.0-or-later
#include "coupler/pool/worker.hpp"

#include <fmt/format.h>
#include <unistd.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdio>
#include <map>

#include "common/error.hpp"
#include "common/processor.hpp"
#include "common/record_values.hpp"
#include "common/resident_boxes.hpp"
#include "common/seconds.hpp"
#include "coupler/pool/connection.hpp"
#include "coupler/pool/state_cache.hpp"
#include "coupler/protocol/messages.hpp"
#include "coupler/protocol/resident_records.hpp"

namespace polargrain::coupler {
namespace {

/// Time between two Hellos of a worker that nobody has welcomed yet.
constexpr std::chrono::milliseconds kHelloPeriod{500};

/// A worker that has heard nothing for so long says Hello again: its coordinator may have been replaced.
constexpr std::chrono::seconds kSilence{10};

/// A worker never sends NaN or infinity: the coordinator would turn it away as dishonest.
CellReply honest(CellReply reply) {
  const bool finite = is_finite(reply.diagnostics) &&
                      (reply.response.quality == Quality::failed || is_finite(reply.response));
  if (finite) return reply;
  CellReply failed;
  failed.response.quality = Quality::failed;
  failed.response.step_factor = 0.5;
  failed.response.message = "the cell's answer holds numbers that are not finite";
  failed.diagnostics.dem_steps = reply.diagnostics.dem_steps;
  failed.diagnostics.engine_seconds = reply.diagnostics.engine_seconds;
  return failed;
}

/// Turns each message received into the message to send back. One session; see Welcome.
class Desk {
 public:
  /// @param heartbeat called from inside the engine, with the number of the request at work
  Desk(const CellServiceFactory& make_service, std::size_t cache_bytes,
       std::function<void(std::uint64_t)> heartbeat)
      : make_service_(make_service), heartbeat_(std::move(heartbeat)), cache_(cache_bytes) {}

  /// @returns the bytes to send back; empty when the message asks for no answer.
  std::optional<std::string> answer(const Message& message, std::uint64_t session) {
    if (const auto* define = std::get_if<Define>(&message)) {
      if (definitions_.contains(define->definition)) return {};  // sent twice: numbers are never used again
      definitions_[define->definition] = define->cell;
      return {};
    }
    if (const auto* initial = std::get_if<InitialRequest>(&message)) {
      return served(*initial, session, [&] { return at_rest(*initial); });
    }
    if (const auto* evaluate = std::get_if<EvaluateRequest>(&message)) {
      for (const ContentName& name : evaluate->released) cache_.forget(name);
      settle(evaluate->settled);
      return served(*evaluate, session, [&] { return evaluated(*evaluate); });
    }
    if (const auto* move_in = std::get_if<MoveIn>(&message)) {
      settle(move_in->settled);
      return served(*move_in, session, [&] { return moved_in(*move_in); });
    }
    if (const auto* go_on = std::get_if<GoOn>(&message)) {
      settle(go_on->settled);
      return served(*go_on, session, [&] { return gone_on(*go_on); });
    }
    if (const auto* read_out = std::get_if<ReadOut>(&message)) {
      settle(read_out->settled);
      return served(*read_out, session, [&] { return read(*read_out); });
    }
    if (const auto* fetch = std::get_if<FetchRequest>(&message)) return encode(fetched(*fetch), session);
    throw ProtocolError("a message that only workers send");
  }

 private:
  Message at_rest(const InitialRequest& request) {
    CellReply reply = service(request.definition).initial();
    if (reply.state) cache_.keep(reply.state);
    return Reply{request.request, {std::move(reply)}};
  }

  Message evaluated(const EvaluateRequest& request) {
    const std::vector<StatePointer> starts = starts_of(request);
    Missing missing{request.request, false, {}};
    for (std::size_t c = 0; c < starts.size(); ++c) {
      if (!starts[c] && !request.cells[c].from_packing) missing.bases.push_back(request.cells[c].base);
    }
    if (!missing.bases.empty()) return missing;
    CellService& engine = service(request.definition);
    Reply reply{request.request, {}};
    for (std::size_t c = 0; c < starts.size(); ++c) {
      try {
        reply.cells.push_back(honest(engine.evaluate({starts[c], request.cells[c].increment})));
      } catch (const std::exception& error) {
        return Refusal{request.request, static_cast<std::uint32_t>(c), error.what()};
      }
      StatePointer& state = reply.cells.back().state;
      if (state && !request.bring && cache_.hold(state)) {
        state = std::make_shared<const State>(state->name(), state->size());
      } else if (state) {
        cache_.keep(state);  // no room to be its only keeper, or not asked to be
      }
    }
    return reply;
  }

  /// The states that the cells start from; null from the packing, and where the bytes are not here.
  std::vector<StatePointer> starts_of(const EvaluateRequest& request) {
    std::vector<StatePointer> starts;
    for (const CellToEvaluate& cell : request.cells) {
      if (cell.state) cache_.keep(cell.state);
      starts.push_back(cell.from_packing ? nullptr : cell.state ? cell.state : cache_.find(cell.base));
    }
    return starts;
  }

  Message fetched(const FetchRequest& request) {
    States found{request.request, {}};
    for (const ContentName& name : request.names) {
      found.states.push_back(cache_.find(name));
      cache_.let_go(name);
    }
    return found;
  }

  Message moved_in(const MoveIn& request) {
    const Clock::time_point start = Clock::now();
    ResidentBoxes& all = boxes(request.definition);
    if (request.first == 0) all.clear();
    require_count(all, request.first);
    all.move_in(request.starts);
    return ResidentReply{request.request, seconds_since(start), all.time_step(), {}, {}};
  }

  Message gone_on(const GoOn& request) {
    const auto count = static_cast<std::uint32_t>(request.increments.size());
    try {
      const Clock::time_point start = Clock::now();
      ResidentBoxes& all = boxes(request.definition);
      require_count(all, count);
      ResidentReply reply{request.request, 0.0, 0.0, all.go_on(request.dem_steps, request.increments), {}};
      reply.seconds = seconds_since(start);
      for (std::uint32_t k = 0; k < count; ++k)
        if (!is_finite(reply.answers[k])) return not_finite(request.request, k);
      return reply;
    } catch (const std::exception& error) {
      return Refusal{request.request, count, error.what()};  // any of them
    }
  }

  Message read(const ReadOut& request) {
    const Clock::time_point start = Clock::now();
    ResidentReply reply{
        request.request, 0.0, 0.0, {}, boxes(request.definition).read_out(request.first, request.count)};
    reply.seconds = seconds_since(start);
    for (std::uint32_t k = 0; k < request.count; ++k) {
      const ResidentReadOut& box = reply.read_outs[k];
      if (!is_finite(box.motion) || honest(box.reply).response.quality == Quality::failed)
        return not_finite(request.request, k);
    }
    return reply;
  }

  static Refusal not_finite(std::uint64_t request, std::uint32_t place) {
    return {request, place, "the answer of the box holds numbers that are not finite"};
  }

  /// Boxes that the coordinator does not know of, or lacks, would give answers in the place of others.
  static void require_count(const ResidentBoxes& all, std::size_t count) {
    if (all.count() != count)
      throw RunError(fmt::format("the worker has {} boxes instead of {}", all.count(), count));
  }

  /// Drops what nobody is going to ask for.
  void settle(std::uint64_t settled) {
    settled_ = std::max(settled_, settled);
    answers_.erase(answers_.begin(), answers_.upper_bound(settled_));
  }

  /// A request that comes again is answered again, not served again; one that is settled is a straggler.
  template <class Request, class Call>
  std::optional<std::string> served(const Request& request, std::uint64_t session, const Call& call) {
    if (const auto kept = answers_.find(request.request); kept != answers_.end()) return kept->second;
    if (request.request <= settled_) return {};
    if (!definitions_.contains(request.definition)) {
      return encode(Missing{request.request, true, {}}, session);
    }
    Message answer = Refusal{};
    try {
      at_work_ = request.request;
      answer = call();
    } catch (const std::exception& error) {
      answer = Refusal{request.request, 0, error.what()};
    }
    if (std::holds_alternative<Missing>(answer)) return encode(answer, session);
    return answers_[request.request] = encode(answer, session);
  }

  CellService& service(std::uint32_t definition) {
    std::unique_ptr<CellService>& service = services_[definition];
    if (!service) {
      service = make_service_(definitions_.at(definition));
      service->progress = [this] { heartbeat_(at_work_); };
    }
    return *service;
  }

  ResidentBoxes& boxes(std::uint32_t definition) {
    std::unique_ptr<ResidentBoxes>& boxes = boxes_[definition];
    if (!boxes) boxes = service(definition).residents();
    return *boxes;
  }

  const CellServiceFactory& make_service_;
  std::function<void(std::uint64_t)> heartbeat_;
  StateCache cache_;
  std::map<std::uint32_t, CellDefinition> definitions_;
  std::map<std::uint32_t, std::unique_ptr<CellService>> services_;
  std::map<std::uint32_t, std::unique_ptr<ResidentBoxes>> boxes_;  ///< they use the services
  std::uint64_t at_work_ = 0;
  std::uint64_t settled_ = 0;
  std::map<std::uint64_t, std::string> answers_;  ///< to requests that are not settled, by their numbers
};

std::string host_name() {
  std::array<char, 256> name{};
  gethostname(name.data(), name.size() - 1);
  std::string host = name.data();
  std::erase_if(
      host, [](char c) { return std::isalnum(static_cast<unsigned char>(c)) == 0 && c != '-' && c != '.'; });
  return host;
}

/// One worker and its line.
class Worker {
 public:
  Worker(const std::string& url, const CellServiceFactory& make_service, const ServeOptions& options)
      : url_(url), make_service_(make_service), options_(options), connection_(url, options.key) {}

  void work() {
    for (;;) {
      if (connection_.renewed()) send_hello();
      zmq::message_t bytes;
      if (connection_.receive(bytes, kHelloPeriod)) {
        heard_ = Clock::now();
        if (!take({static_cast<const std::byte*>(bytes.data()), bytes.size()})) return;
        continue;
      }
      if (connection_.refused()) {
        throw RunError(
            fmt::format("the coordinator at {} refuses this worker's key; add it to workers.allowed in "
                        "the folder of its keys ('polargrain keys' does) and start the run again",
                        url_));
      }
      if (connection_.lost_seconds() > options_.patience_seconds) give_up();
      if (session_ == 0 || Clock::now() - heard_ > kSilence) send_hello();
    }
  }

 private:
  void send_hello() {
    connection_.send(
        encode(Hello{kProtocolVersion, getpid(), host_name(), processor_model(), options_.unconfined}));
  }

  [[noreturn]] void give_up() const {
    throw RunError(
        fmt::format("no coordinator at {} for {:.0f} s{}", url_, options_.patience_seconds,
                    connection_.met_a_stranger()
                        ? "; somebody answers there who cannot prove to be the coordinator of the key "
                          "file: make sure that both use keys from the same folder"
                        : ""));
  }

  /// @returns false when it was told to stop
  bool take(std::span<const std::byte> bytes) {
    try {
      const Envelope envelope = decode(bytes);
      if (const auto* welcome = std::get_if<Welcome>(&envelope.message)) {
        begin_session(envelope.session, *welcome);
        return true;
      }
      if (const auto* stop = std::get_if<Stop>(&envelope.message)) {
        if (!stop->reason.empty()) throw RunError("the coordinator sends this worker away: " + stop->reason);
        return false;
      }
      if (envelope.session != session_ || !desk_) return true;  // of another session: a straggler
      const auto answer = desk_->answer(envelope.message, session_);
      if (answer) connection_.send(*answer);
    } catch (const ProtocolError& error) {
      // As good as lost: the coordinator sends it again.
      std::fprintf(stderr, "polargrain: a message that cannot be used: %s\n", error.what());
    }
    return true;
  }

  void begin_session(std::uint64_t session, const Welcome& welcome) {
    if (session == session_) return;
    session_ = session;
    const auto period = std::chrono::duration_cast<Clock::duration>(
        std::chrono::duration<double>(std::min(welcome.heartbeat_seconds, 3600.0)));
    desk_.emplace(make_service_, options_.cache_bytes, [this, period](std::uint64_t request) {
      if (Clock::now() - beat_ < period) return;
      beat_ = Clock::now();
      connection_.send(encode(Working{request}, session_));
    });
  }

  const std::string& url_;
  const CellServiceFactory& make_service_;
  const ServeOptions& options_;
  Connection connection_;
  std::uint64_t session_ = 0;
  std::optional<Desk> desk_;
  Clock::time_point heard_ = Clock::now();
  Clock::time_point beat_ = Clock::now();
};

}  // namespace

void serve(const std::string& url, const CellServiceFactory& make_service, const ServeOptions& options) try {
  Worker(url, make_service, options).work();
} catch (const zmq::error_t& error) {
  throw RunError(fmt::format("the connection to the coordinator at {} failed: {}", url, error.what()));
}

}  // namespace polargrain::coupler
