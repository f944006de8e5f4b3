// SPDX-License-Identifier: GPL-2.0-or-later
#pragma once
#include <chrono>
#include <cstdint>
#include <deque>
#include <filesystem>
#include <functional>
#include <list>
#include <map>
#include <optional>
#include <set>
#include <string>
#include <vector>

#include "common/seconds.hpp"
#include "coupler/pool/private_directory.hpp"
#include "coupler/pool/process.hpp"
#include "coupler/pool/state_cache.hpp"
#include "coupler/pool/switchboard.hpp"
#include "coupler/protocol/messages.hpp"

namespace polargrain::coupler {

struct CrewOptions {
  int workers = 1;                                    ///< local ones
  std::filesystem::path directory;                    ///< gets logs/worker-K.log
  std::vector<std::string> worker_command;            ///< the crew adds `--connect URL`
  Process::Network network = Process::Network::none;  ///< of local workers
  double startup_seconds = 60.0;
  std::size_t cache_bytes = 0;         ///< the memory that a worker is taken to have for states
  double heartbeat_seconds = 1.0;      ///< asked of working workers
  std::optional<Listening> listening;  ///< for workers of other machines
  std::function<void(const std::string&)> tell;
  std::function<void()> heed;  ///< called before each wait; may throw
};

/// The tasks of one message to a worker.
struct Job {
  std::vector<std::size_t> tasks;
  std::uint64_t request = 0;  ///< number on the wire, never used twice
  Clock::time_point sent;     ///< or when the job before it was answered
  Clock::time_point heard;    ///< last sign of life, or `sent`
  Clock::time_point resent;   ///< last time it was sent, or sent again
  Clock::duration excused{};  ///< since `sent`: nobody could have answered, or heard of it
  bool begun = false;         ///< it has said Working
  int supplied = 0;           ///< times it was sent again because something was missing
};

/// A worker that has been welcomed.
struct Member {
  std::string name;  ///< "worker 3", "worker 12 on node7"
  Address address;
  std::string processor = {};            ///< its kind, as the worker says
  std::uint64_t number = 0;              ///< never given twice
  std::string party;                     ///< whose it is: the key of a guest; empty for our own processes
  StateCache known;                      ///< names of the states it was sent and should still have
  std::set<std::uint32_t> defined = {};  ///< definitions it was sent
  std::deque<Job> jobs = {};             ///< the first is being worked on, the others lie ready with it
  bool has_answered = false;
  int unreadable = 0;  ///< messages in a row that made no sense

  /// The key for which its answers count: a guest may come again under another name, but not with another key.
  [[nodiscard]] const std::string& standing() const { return address.remote ? party : name; }
};

/// How a worker was lost.
struct Loss {
  std::string how;      ///< "died" or "was given up"
  std::string cause;    ///< "exit status 1"
  std::string details;  ///< "; its log L says:\n..." or nothing
  /// Whether the loss came from outside (a signal to kill, a broken connection) rather than from the work.
  bool from_outside = false;
};

/// The listener to the crew.
class CrewEvents {
 public:
  virtual ~CrewEvents() = default;
  virtual void joined(Member& member) = 0;
  /// @throws ProtocolError when the message makes no sense
  virtual void said(Member& member, const Message& message) = 0;
  /// The member is gone after this call.
  virtual void lost(Member& member, const Loss& loss) = 0;
};

/// The workers of a coordinator: processes of its own, which it starts and starts again when they die, and
/// guests, who come by TCP and leave as they like. Knows nothing of the work.
class Crew {
 public:
  Crew(CrewOptions options, CrewEvents& events);
  /// Tells all to stop; waits shortly, then kills.
  ~Crew();
  Crew(const Crew&) = delete;
  Crew& operator=(const Crew&) = delete;

  /// Starts the local workers and waits until each has reported or failed to.
  /// @throws RunError when all of them fail to: a program that cannot start
  void start();
  /// Waits for something to happen, not longer than `timeout`, and handles it.
  /// @throws RunError when no worker is left and no other can come; exceptions of CrewOptions::heed
  void listen(std::chrono::milliseconds timeout);
  /// A member that cannot be reached is lost at the next listen.
  void send(Member& member, const Message& message);
  /// Does without a member: kills it if it is ours (another is started), forgets it otherwise.
  void give_up(Member& member, const std::string& cause);
  /// The same with a member that gave a false answer. A guest is told, is not let in again by this
  /// connection, and its key is shut out of the run when that happens too often; so is the place of one of ours.
  void send_away(Member& member, const std::string& cause);
  /// How much of the time since `elapsed` ago, when this was asked last, a process of ours was ready to run and others
  /// had the processors. Zero for guests: nobody here sees their machine.
  [[nodiscard]] Clock::duration starved(const Member& member, Clock::duration elapsed);
  /// Local workers that have answered get their number of restarts back.
  static void praise(Member& member) { member.has_answered = true; }

  [[nodiscard]] std::list<Member>& members() { return members_; }
  /// Whether a process of our own is on its way, or about to be started.
  [[nodiscard]] bool is_filling() const;
  [[nodiscard]] const Switchboard& switchboard() const { return switchboard_; }
  [[nodiscard]] std::int64_t bytes_sent() const { return bytes_sent_; }
  [[nodiscard]] std::int64_t bytes_received() const { return bytes_received_; }

 private:
  /// The place of a local worker, filled anew when its process dies.
  struct Seat {
    int number = 0;
    std::filesystem::path log;
    std::uintmax_t log_start = 0;  ///< where in the log the present process began
    std::optional<Process> process = {};
    Address address = {};  ///< of its member; empty before its Hello
    Clock::time_point started = {};
    ProcessorShare share = {};     ///< of the process, when it was looked at last
    Clock::time_point due = {};    ///< when an empty seat is to be filled
    int fruitless = 0;             ///< counts ends without a job since it last answered
    int offences = 0;              ///< times that it was sent away
    bool has_reported = false;     ///< one of its processes has
    std::string false_start = {};  ///< how its last process ended that did not report; empty: all reported
  };

  void fill(Seat& seat);
  void watch_seats();
  void receive_all();
  void receive(const Address& from, std::span<const std::byte> bytes);
  void greet(const Address& from, const Hello& hello);
  [[nodiscard]] bool any_has_reported() const;
  void handle_end(Seat& seat);
  /// A process did not come as far as its Hello; `last_end_` says how it ended.
  void handle_false_start(Seat& seat);
  void remove(const Address& address, const Loss& loss);
  void ping_guests();
  void say(const std::string& text) const;
  Member* member_at(const Address& address);

  CrewOptions options_;
  CrewEvents& events_;
  std::uint64_t session_;
  PrivateDirectory sockets_;
  Switchboard switchboard_;
  std::list<Seat> seats_;
  bool seats_are_quiet_ = false;  ///< all are filled and have reported: only an end changes that
  std::list<Member> members_;
  std::map<Address, std::list<Member>::iterator> places_;  ///< of the members
  std::set<Address> unreachable_;
  std::string last_end_;  ///< how the last process ended, for the message when no process is left
  bool starting_ = true;
  std::set<Address> sent_away_;
  std::map<std::string, int> offences_;  ///< by party
  int guests_ = 0;
  std::set<std::string> said_unconfined_;  ///< Hello::unconfined
  std::uint64_t last_member_ = 0;
  Clock::time_point pinged_ = Clock::now();
  std::int64_t bytes_sent_ = 0;
  std::int64_t bytes_received_ = 0;
};

}  // namespace polargrain::coupler
