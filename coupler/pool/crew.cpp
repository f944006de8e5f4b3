// SPDX-License-Identifier: GPL-2.0-or-later
#include "coupler/pool/crew.hpp"

#include <fmt/format.h>
#include <signal.h>

#include <algorithm>
#include <random>
#include <utility>

#include "common/error.hpp"
#include "coupler/pool/descriptors.hpp"
#include "coupler/pool/log_excerpt.hpp"

namespace polargrain::coupler {
namespace {

/// How long workers may take to end by themselves after Stop; the engine has nothing left to save.
constexpr int kStopMilliseconds = 500;

/// A local worker's place stays empty after five ends in a row without any work done, or a hundred when
/// somebody else ended it.
constexpr int kMostFruitless = 100;
constexpr int kFruitlessEnd = 20;

/// Guests of one key that may be sent away until the key is shut out, and processes of one place until it stays empty.
constexpr int kMostOffences = 3;

/// Messages in a row that make no sense, after which a worker is given up.
constexpr int kMostUnreadable = 3;

constexpr std::chrono::seconds kPingPeriod{1};

/// Of a local worker: its connection, and the end of its process.
constexpr std::size_t kDescriptorsOfWorker = 2;

/// For the log of a worker that starts, and for what is written meanwhile.
constexpr std::size_t kSpareDescriptors = 10;

/// Messages read before the ends of workers and the clocks are looked at again.
constexpr int kMostAtOnce = 1000;

std::uint64_t new_session() {
  std::random_device device;
  const std::uint64_t high = device();
  return (high << 32 | device()) | 1U;  // never 0
}

bool killed_from_outside(std::optional<int> signal) {
  return signal && (*signal == SIGKILL || *signal == SIGTERM || *signal == SIGINT || *signal == SIGHUP);
}

}  // namespace

Crew::Crew(CrewOptions options, CrewEvents& events)
    : options_(std::move(options)),
      events_(events),
      session_(new_session()),
      switchboard_(sockets_.path(), options_.listening, [this](const std::string& text) { say(text); }) {}

Crew::~Crew() {
  for (Member& member : members_) {
    try {
      switchboard_.send(member.address, encode(Stop{}, session_));
    } catch (const std::exception&) {  // it is killed below, or finds the connection closed
    }
  }
  for (Seat& seat : seats_) {
    if (seat.process) seat.process->finish(seat.address.id.empty() ? 0 : kStopMilliseconds);
  }
}

void Crew::start() {
  std::filesystem::create_directories(options_.directory / "logs");
  require_descriptors(kDescriptorsOfWorker * static_cast<std::size_t>(options_.workers) + kSpareDescriptors,
                      options_.workers == 1 ? "one worker" : fmt::format("{} workers", options_.workers));
  for (int k = 1; k <= options_.workers; ++k) {
    Seat& seat = seats_.emplace_back();
    seat.number = k;
    seat.log = options_.directory / "logs" / fmt::format("worker-{}.log", k);
    std::filesystem::remove(seat.log);
    fill(seat);
  }
  const auto waited_for = [](const Seat& seat) { return !seat.has_reported && seat.false_start.empty(); };
  while (std::any_of(seats_.begin(), seats_.end(), waited_for)) listen(std::chrono::milliseconds(100));
  if (!seats_.empty() && !any_has_reported()) throw RunError(seats_.front().false_start);
  starting_ = false;
  for (const Seat& seat : seats_)
    if (!seat.false_start.empty()) say(seat.false_start + "the others go on; it is started again");
}

bool Crew::any_has_reported() const {
  return std::any_of(seats_.begin(), seats_.end(), [](const Seat& seat) { return seat.has_reported; });
}

void Crew::fill(Seat& seat) {
  std::vector<std::string> command = options_.worker_command;
  command.insert(command.end(), {"--connect", switchboard_.local_url()});
  std::error_code none;
  seat.log_start = std::filesystem::exists(seat.log, none) ? std::filesystem::file_size(seat.log, none) : 0;
  seat.started = Clock::now();
  seat.share = {};
  seat.address = {};
  seat.process.emplace(command, seat.log, options_.network);
  switchboard_.watch(seat.process->end_descriptor());
}

void Crew::listen(std::chrono::milliseconds timeout) {
  if (options_.heed) options_.heed();
  if (!seats_are_quiet_) watch_seats();
  ping_guests();
  const bool some_ended = switchboard_.wait(timeout);
  // Messages first: the last words of a worker count.
  receive_all();
  for (Seat& seat : seats_) {
    if (!some_ended) break;
    if (seat.process && seat.process->end()) handle_end(seat);
  }
  while (!unreachable_.empty()) {
    const Address address = *unreachable_.begin();
    unreachable_.erase(unreachable_.begin());
    // The end of a process of our own is reported with its cause, by its descriptor.
    if (address.remote) remove(address, {"left", "its connection is closed", "", true});
  }
}

void Crew::watch_seats() {
  const Clock::time_point now = Clock::now();
  bool any = options_.listening.has_value();
  seats_are_quiet_ = true;
  for (Seat& seat : seats_) {
    if (!seat.process && seat.fruitless < kMostFruitless && now >= seat.due) fill(seat);
    any = any || seat.process || seat.fruitless < kMostFruitless;
    if (seat.process && !seat.address.id.empty()) continue;
    seats_are_quiet_ = false;
    if (!seat.process) continue;
    // Time in which others had the processors is not its fault.
    const double waited = seconds_of(now - seat.started - seat.process->processor_share().waited);
    if (waited < options_.startup_seconds) continue;
    last_end_ = fmt::format("worker {} did not report within {} s of its start; its log {} ends with:\n{}",
                            seat.number, options_.startup_seconds, seat.log.string(),
                            log_excerpt(seat.log, seat.log_start));
    seat.process->finish(0);
    seat.process.reset();
    seat.fruitless += kFruitlessEnd;
    handle_false_start(seat);
  }
  if (!any) throw RunError("no worker is left: each was started several times; the last: " + last_end_);
}

void Crew::handle_end(Seat& seat) {
  const std::string end = seat.process->end().value_or("unknown end");
  const bool outside = killed_from_outside(seat.process->end_signal());
  const Loss loss{
      "died", end,
      fmt::format("; its log {} says:\n{}", seat.log.string(), log_excerpt(seat.log, seat.log_start)),
      outside};
  const Address address = seat.address;
  Member* member = address.id.empty() ? nullptr : member_at(address);
  const bool idle = member == nullptr || member->jobs.empty();
  if (member != nullptr && member->has_answered) seat.fruitless = 0;
  seat.process.reset();
  seat.address = {};
  seats_are_quiet_ = false;
  seat.fruitless = idle ? seat.fruitless + (outside ? 1 : kFruitlessEnd) : 0;
  seat.due =
      Clock::now() + std::chrono::milliseconds(seat.fruitless > kFruitlessEnd ? 10 * seat.fruitless : 0);
  if (member != nullptr) {
    remove(address, loss);
    return;
  }
  last_end_ = fmt::format("worker {} died before it reported: {}{}", seat.number, loss.cause, loss.details);
  if (outside) {
    say(last_end_);
  } else {
    handle_false_start(seat);
  }
}

void Crew::handle_false_start(Seat& seat) {
  seat.false_start = last_end_;
  seat.due = Clock::now() + std::chrono::milliseconds(10 * seat.fruitless);
  seats_are_quiet_ = false;
  if (starting_) return;
  const bool is_given_up = seat.fruitless >= kMostFruitless;
  say(last_end_ + (is_given_up ? "it is not started again" : "it is started again"));
}

void Crew::remove(const Address& address, const Loss& loss) {
  const auto place = places_.find(address);
  if (place == places_.end()) return;
  std::list<Member> gone;
  gone.splice(gone.begin(), members_, place->second);  // nobody gives it work any more
  places_.erase(place);
  last_end_ = fmt::format("{} {}: {}{}", gone.front().name, loss.how, loss.cause, loss.details);
  events_.lost(gone.front(), loss);
}

void Crew::give_up(Member& member, const std::string& cause) {
  const Address address = member.address;
  std::string details;
  bool from_outside = false;
  for (Seat& seat : seats_) {
    if (seat.address != address || address.id.empty()) continue;
    from_outside = seat.process->stopped();
    seat.process->finish(0);
    details = fmt::format("{} (log: {})", from_outside ? "; a signal has stopped its process" : "",
                          seat.log.string());
    seat.process.reset();
    seat.address = {};
    seat.due = Clock::now();
    seats_are_quiet_ = false;
    break;
  }
  remove(address, {"was given up", cause, details, from_outside});
}

void Crew::send_away(Member& member, const std::string& cause) {
  if (member.address.remote) {
    switchboard_.send(member.address, encode(Stop{cause}, session_));
    sent_away_.insert(member.address);
    if (++offences_[member.party] == kMostOffences) {
      switchboard_.shut_out(member.party);
      say(fmt::format(
          "{} guests with the key {} were sent away: nobody else comes in with it during this run",
          kMostOffences, member.party));
    }
  }
  for (Seat& seat : seats_) {
    if (member.address.id.empty() || seat.address != member.address || ++seat.offences < kMostOffences)
      continue;
    seat.fruitless = kMostFruitless;
    say(fmt::format("{} was sent away {} times: it is not started again", member.name, kMostOffences));
  }
  give_up(member, cause);
}

Clock::duration Crew::starved(const Member& member, Clock::duration elapsed) {
  if (member.address.remote) return {};
  for (Seat& seat : seats_) {
    if (seat.address != member.address || !seat.process) continue;
    const ProcessorShare now = seat.process->processor_share();
    return starved_between(std::exchange(seat.share, now), now, elapsed);
  }
  return {};
}

void Crew::send(Member& member, const Message& message) {
  const std::string bytes = encode(message, session_);
  if (!switchboard_.send(member.address, bytes)) unreachable_.insert(member.address);
  bytes_sent_ += static_cast<std::int64_t>(bytes.size());
}

/// A guest that is gone shows when something is sent to it: nothing else tells.
void Crew::ping_guests() {
  if (!options_.listening || Clock::now() - pinged_ < kPingPeriod) return;
  pinged_ = Clock::now();
  for (Member& member : members_) {
    if (member.address.remote) send(member, Welcome{options_.heartbeat_seconds});
  }
}

void Crew::receive_all() {
  Address from;
  zmq::message_t bytes;
  for (int count = 0; count < kMostAtOnce && switchboard_.receive(from, bytes); ++count) {
    bytes_received_ += static_cast<std::int64_t>(bytes.size());
    receive(from, {static_cast<const std::byte*>(bytes.data()), bytes.size()});
  }
}

void Crew::receive(const Address& from, std::span<const std::byte> bytes) {
  Member* member = member_at(from);
  try {
    const Envelope envelope = decode(bytes);
    if (const auto* hello = std::get_if<Hello>(&envelope.message)) {
      greet(from, *hello);
    } else if (member != nullptr && envelope.session == session_) {
      events_.said(*member, envelope.message);
    }  // else a straggler: meant for another session, or from one who was given up; it will say Hello again
  } catch (const FalseMessage& error) {
    if (member != nullptr) send_away(*member, fmt::format("it sent a false message: {}", error.what()));
    return;
  } catch (const ProtocolError& error) {
    if (member == nullptr) return;
    // One broken message is as good as lost and asked for again; a worker that sends nothing else is broken.
    if (++member->unreadable == 1)
      say(fmt::format("{} sent an unusable message: {}", member->name, error.what()));
    if (member->unreadable >= kMostUnreadable) {
      give_up(*member, fmt::format("it sent an unusable message: {}", error.what()));
    }
    return;
  }
  if (Member* still = member_at(from)) still->unreadable = 0;
}

void Crew::greet(const Address& from, const Hello& hello) {
  if (hello.version != kProtocolVersion) {
    const std::string reason = fmt::format(
        "it speaks version {} of the messages instead of {}; use the same polargrain on both sides",
        hello.version, kProtocolVersion);
    if (!from.remote && !any_has_reported()) throw RunError("a worker cannot be used: " + reason);
    say("a worker was sent away: " + reason);
    switchboard_.send(from, encode(Stop{reason}, session_));
    return;
  }
  if (Member* known = member_at(from)) {
    send(*known, Welcome{options_.heartbeat_seconds});
    return;
  }
  if (sent_away_.contains(from)) {
    switchboard_.send(from, encode(Stop{"it was sent away before"}, session_));
    return;
  }
  std::string name;
  if (from.remote) {
    name = fmt::format("guest {} on {}", ++guests_, hello.host);
  } else {
    const auto seat = std::find_if(seats_.begin(), seats_.end(), [&](const Seat& s) {
      return s.process && s.process->id() == hello.process;
    });
    if (seat == seats_.end() || !seat->address.id.empty())
      return;  // not one of our processes, or one that has left already
    seat->address = from;
    seat->has_reported = true;
    name = fmt::format("worker {}", seat->number);
  }
  Member& member = members_.emplace_back(
      Member{name, from, hello.processor, ++last_member_, from.key, StateCache(options_.cache_bytes)});
  places_[from] = std::prev(members_.end());
  if (!hello.unconfined.empty() && said_unconfined_.insert(hello.unconfined).second)
    say(fmt::format("{} runs with more rights than it needs; its system does not allow: {}", name,
                    hello.unconfined));
  send(member, Welcome{options_.heartbeat_seconds});
  events_.joined(member);
}

void Crew::say(const std::string& text) const {
  if (options_.tell) options_.tell(text);
}

bool Crew::is_filling() const {
  return std::any_of(seats_.begin(), seats_.end(), [](const Seat& seat) {
    return seat.address.id.empty() && (seat.process || seat.fruitless < kMostFruitless);
  });
}

Member* Crew::member_at(const Address& address) {
  const auto place = places_.find(address);
  return place == places_.end() ? nullptr : &*place->second;
}

}  // namespace polargrain::coupler
