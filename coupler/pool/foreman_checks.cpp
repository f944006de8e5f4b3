// SPDX-License-Identifier: GPL-2.0-or-later
// Evaluations that two workers must agree on before their answer is used; a third decides where they do not.
#include <fmt/format.h>

#include <algorithm>
#include <utility>

#include "common/error.hpp"
#include "coupler/pool/foreman.hpp"

namespace polargrain::coupler {
namespace {

/// Answers to one evaluation, after which nobody else is asked.
constexpr std::size_t kMostOpinions = 5;

constexpr const char* kCause = "it has sent a false answer, or its machine does not compute like the others";

}  // namespace

void Foreman::take_opinion(const Member& member, Task& task, const CellReply& reply) {
  task.opinions.add({{member.number, member.party, member.name},
                     member.name,
                     member.standing(),
                     reply,
                     name_of_answer(reply)});
  const auto number = static_cast<std::size_t>(&task - tasks_->data());
  waiting_.insert(number);
  if (decide(task)) return;
  queue_.add_first(number);
  give_all();
}

bool Foreman::decide(Task& task) {
  const Opinions& opinions = task.opinions;
  const std::optional<std::size_t> right = opinions.agreed();
  if (!right && opinions.list().size() < kMostOpinions) return false;
  if (!right) {
    settle(task);
    return true;
  }
  const Opinions taken = std::exchange(task.opinions, {});
  waiting_.erase(static_cast<std::size_t>(&task - tasks_->data()));
  std::string agree;
  for (std::size_t o = 0; o < taken.list().size(); ++o) {
    if (!taken.same(o, *right)) continue;
    const Opinion& opinion = taken.list()[o];
    agree += (agree.empty() ? "" : " and ") + opinion.who;
    task.reply = opinion.reply;
    // All who hold the state are told when it is not needed any more; the last one has it.
    if (opinion.reply.state && (present_.contains(opinion.worker.worker) || !task.reply.state))
      task.reply.state = book_.enter(opinion.reply.state, opinion.worker.worker,
                                     {task.definition, task.cell, {opinion.numbers, opinion.who, true}});
  }
  ++done_;
  ++counts.evaluations_checked;
  for (std::size_t o = 0; o < taken.list().size(); ++o) {
    if (taken.same(o, *right)) continue;
    find_false(taken.list()[o], fmt::format("{} answers {} otherwise than {}, who agree to the bit: {}",
                                            taken.list()[o].who, place_of(task), agree, kCause));
  }
  return true;
}

void Foreman::settle_what_waits() {
  if (waiting_.empty() || crew_.is_filling()) return;
  const std::vector<Candidate> there = present();
  for (const std::size_t number : std::set<std::size_t>(waiting_)) {
    if (waiting_.contains(number) && task(number).opinions.others(there).empty()) settle(task(number));
  }
  send_away_the_blamed();
}

void Foreman::settle(Task& task) {
  const Opinions taken = std::exchange(task.opinions, {});
  const auto number = static_cast<std::size_t>(&task - tasks_->data());
  waiting_.erase(number);
  queue_.remove(number);
  const std::vector<Opinion>& list = taken.list();
  // Our own processes are what the user runs anyway: who differs from them is not believed.
  const auto ours = std::ranges::find_if(list, &Opinion::is_ours);
  if (list.size() > 1 && std::ranges::count_if(list, &Opinion::is_ours) != 1) {
    throw FalseResults(
        fmt::format("{} and {} come to different answers at {}, and there is no third worker that could "
                    "say who is right: run again with three workers, or with one",
                    list[0].who, list[1].who, place_of(task)));
  }
  const Opinion& believed = list.size() == 1 ? list.front() : *ours;
  task.answerer = believed.standing;
  task.reply = believed.reply;
  if (believed.reply.state)
    task.reply.state = book_.enter(believed.reply.state, believed.worker.worker,
                                   {task.definition, task.cell, {believed.numbers, believed.who}});
  ++done_;
  for (const Opinion& other : list) {
    if (&other == &believed) continue;
    find_false(other, fmt::format("{} answers {} otherwise than {}, a process of this machine: {}", other.who,
                                  place_of(task), believed.who, kCause));
  }
}

void Foreman::find_false(const Opinion& opinion, const std::string& words) {
  if (present_.contains(opinion.worker.worker)) {
    blamed_.emplace(opinion.worker.worker, words);
  } else {
    tell(words);
  }
  if (const auto used = returned_.find(opinion.standing); used != returned_.end()) {
    throw FalseResults(
        fmt::format("{}. {} of its answers that nobody has checked were used before: files of this "
                    "run may be false",
                    words, used->second));
  }
  std::size_t again = 0;
  for (std::size_t number = 0; number < tasks_->size(); ++number) {
    Task& other = task(number);
    if (waiting_.contains(number)) {
      other.opinions.remove(opinion.standing);
      if (other.opinions.empty()) waiting_.erase(number);
    }
    const bool is_answer = other.kind == Task::Kind::evaluate || other.kind == Task::Kind::rest;
    if (!is_answer || other.answerer != opinion.standing) continue;
    other.answerer.clear();
    other.reply = {};
    --done_;
    ++again;
    enqueue(number);
  }
  if (again > 0) tell(fmt::format("{} other answers of {} are worked out again", again, opinion.who));
  give_all();
}

void Foreman::note_returned() {
  if (options_.check_share <= 0.0) return;
  for (const Task& task : *tasks_)
    if (!task.answerer.empty() && (task.kind == Task::Kind::evaluate || task.kind == Task::Kind::rest))
      ++returned_[task.answerer];
}

}  // namespace polargrain::coupler
