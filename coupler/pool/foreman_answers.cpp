// SPDX-License-Identifier: GPL-2.0-or-later
// The foreman's treatment of answers, and who is to blame for a task without one.
#include <fmt/format.h>

#include <algorithm>
#include <utility>

#include "common/error.hpp"
#include "coupler/pool/foreman.hpp"

namespace polargrain::coupler {
namespace {

/// Times that a request is sent again because its worker misses something: its definition, and its states.
constexpr int kMostSupplied = 3;

/// States that evaluations of one cell may come to, beside the one that was named first.
constexpr std::size_t kMostOtherStates = 2;

/// The job of a request, if the worker has it: other answers are late or doubled, and of no use.
std::deque<Job>::iterator find_job(Member& member, std::uint64_t request) {
  return std::find_if(member.jobs.begin(), member.jobs.end(),
                      [&](const Job& job) { return job.request == request; });
}

}  // namespace

// ---- their answers

void Foreman::take_replies(Member& member, const Reply& reply) {
  const auto found = find_job(member, reply.request);
  if (found == member.jobs.end()) return;
  const Task& first = first_of(*found);
  if (first.kind == Task::Kind::fetch || first.kind == Task::Kind::resident ||
      reply.cells.size() != found->tasks.size()) {
    throw FalseMessage("a reply that does not fit its request");
  }
  for (std::size_t c = 0; c < reply.cells.size(); ++c) {
    const StatePointer& state = reply.cells[c].state;
    if (first.kind != Task::Kind::evaluate && state && !state->is_here()) {
      throw FalseMessage("a reply without the bytes that were asked for");
    }
    check_state(task(found->tasks[c]), state);
  }
  const Job job = finished(member, reply.request);
  for (std::size_t c = 0; c < job.tasks.size(); ++c) {
    take_reply(member, task(job.tasks[c]), reply.cells[c]);
  }
  give_next(member, kJobsAtHand);
}

void Foreman::take_reply(Member& member, Task& done, const CellReply& reply) {
  ++counts.evaluations;
  WorkerRecord& record = records[member.name];
  record.processor = member.processor;
  ++record.evaluations;
  counts.dem_steps += reply.diagnostics.dem_steps;
  counts.engine_seconds += reply.diagnostics.engine_seconds;
  if (done.kind == Task::Kind::again) {
    ++counts.evaluations_again;
    if (!reply.state || reply.state->name() != done.wanted->name()) {
      take_other_state(member, done, reply);
      return;
    }
  }
  blame_others(member, done);
  done.checked ? take_opinion(member, done, reply) : accept(member, done, reply);
}

void Foreman::accept(const Member& member, Task& done, const CellReply& reply) {
  done.answerer = member.standing();
  done.reply = reply;
  if (reply.state) {
    done.reply.state = done.kind == Task::Kind::again
                           ? book_.arrived(reply.state, member.number)
                           : book_.enter(reply.state, member.number,
                                         {done.definition, done.cell, {name_of_answer(reply), member.name}});
  }
  ++done_;
}

/// The worker that named the state first may have named a false one: then two others agree on the true one,
/// and the numbers that came with it are those that were used.
void Foreman::take_other_state(Member& member, Task& done, const CellReply& reply) {
  const std::string& first = done.evidence.who;
  const std::string text = fmt::format(
      "{} evaluates {} again, whose state {} does not bring, and comes to "
      "another state",
      member.name, place_of(done), first);
  Attempt attempt{Attempt::End::other_state, member.number, member.party, text};
  if (done.evidence.confirmed) {  // two have said what is true: this one is wrong
    done.attempts.add(std::move(attempt));
    queue_.add_first(static_cast<std::size_t>(&done - tasks_->data()));
    const Candidate worker{member.number, member.party, member.name};
    return find_false({worker, member.name, member.standing(), reply, {}},
                      text + ", though two agreed on the first");
  }
  if (!reply.state) return end_attempt(done, std::move(attempt));
  const ContentName name = reply.state->name();
  if (std::find(done.others.begin(), done.others.end(), name) == done.others.end()) {
    done.others.push_back(name);
    if (done.others.size() > kMostOtherStates)
      throw RunError(text + ": the machines of the workers do not compute alike");
    done.attempts.add(std::move(attempt));
    say_again(text, 1);
    queue_.add_first(static_cast<std::size_t>(&done - tasks_->data()));
    give_all();
    return;
  }
  if (name_of_answer(reply) != done.evidence.answer)
    throw RunError(
        fmt::format("{}, and to other numbers than {} gave, which are in the results of this step: {} "
                    "has sent a false answer, or the machines of the workers do not compute alike",
                    text, first, first));
  tell(fmt::format("{}, as another evaluation did: {} named a false state; its numbers were right", text,
                   first));
  for (const Member& other : crew_.members())
    if (other.name == first) blamed_.emplace(other.number, "it named a state that its cell does not come to");
  done.reply = reply;
  done.reply.state = book_.enter(reply.state, member.number, {done.definition, done.cell, {}});
  ++done_;
}

void Foreman::check_state(const Task& at, const StatePointer& state) const {
  if (!state || !options_.state_fault) return;
  const std::string fault = options_.state_fault(definitions_[at.definition].cell, *state);
  if (!fault.empty()) throw FalseMessage(fmt::format("for {}, {}", place_of(at), fault));
}

void Foreman::blame_others(const Member& member, const Task& done) {
  for (const Attempt& attempt : done.attempts.list()) {
    const bool contradicted =
        attempt.end == Attempt::End::refused || attempt.end == Attempt::End::other_state;
    if (contradicted && attempt.worker != member.number && present_.contains(attempt.worker))
      blamed_.emplace(attempt.worker,
                      fmt::format("{} answers the same request: {}", member.name, attempt.words));
  }
}

void Foreman::send_away_the_blamed() {
  while (!blamed_.empty()) {
    const auto [number, cause] = *blamed_.begin();
    blamed_.erase(blamed_.begin());
    std::list<Member>& members = crew_.members();
    const auto member = std::find_if(members.begin(), members.end(),
                                     [&, n = number](const Member& each) { return each.number == n; });
    if (member != members.end()) crew_.send_away(*member, cause);
  }
}

void Foreman::take_states(Member& member, const States& answer) {
  const auto found = find_job(member, answer.request);
  if (found == member.jobs.end()) return;
  if (first_of(*found).kind != Task::Kind::fetch || answer.states.size() != found->tasks.size()) {
    throw FalseMessage("states that do not fit their request");
  }
  for (std::size_t s = 0; s < answer.states.size(); ++s) {
    const StatePointer& state = answer.states[s];
    if (state && state->name() != task(found->tasks[s]).wanted->name()) {
      throw FalseMessage("the bytes of a state do not have its name");
    }
    check_state(task(found->tasks[s]), state);
  }
  const Job job = finished(member, answer.request);
  for (std::size_t s = 0; s < job.tasks.size(); ++s) {
    Task& done = task(job.tasks[s]);
    if (!answer.states[s]) {  // dropped: somebody makes it again
      done.kind = Task::Kind::again;
      enqueue(job.tasks[s]);
      give_all();
      continue;
    }
    ++counts.states_fetched;
    done.reply.state = book_.arrived(answer.states[s], member.number);
    ++done_;
  }
  give_next(member, kJobsAtHand);
}

void Foreman::take_resident_reply(Member& member, const ResidentReply& reply) {
  const auto found = find_job(member, reply.request);
  if (found == member.jobs.end()) return;
  Task& done = first_of(*found);
  if (done.kind != Task::Kind::resident) throw FalseMessage("a reply that does not fit its request");
  ResidentWork& work = *done.residents;
  const auto* const step = std::get_if<GoOn>(&work.message);
  const bool reads = std::holds_alternative<ReadOut>(work.message);
  if (reply.answers.size() != (step != nullptr ? work.boxes : 0) ||
      reply.read_outs.size() != (reads ? work.boxes : 0)) {
    throw FalseMessage("a reply that does not fit its request");
  }
  for (const ResidentReadOut& box : reply.read_outs) check_state(done, box.reply.state);
  finished(member, reply.request);
  counts.engine_seconds += reply.seconds;
  counts.states_fetched += static_cast<std::int64_t>(reply.read_outs.size());
  WorkerRecord& record = records[member.name];
  record.processor = member.processor;
  if (step != nullptr) {
    const auto boxes = static_cast<std::int64_t>(work.boxes);
    counts.evaluations += boxes;
    counts.dem_steps += boxes * step->dem_steps;
    record.evaluations += boxes;
  }
  work.reply = reply;
  ++done_;
  give_next(member, kJobsAtHand);
}

Job Foreman::finished(Member& member, std::uint64_t request) {
  const auto found = find_job(member, request);
  Job job = std::move(*found);
  const bool was_current = found == member.jobs.begin();
  member.jobs.erase(found);
  const Clock::time_point now = Clock::now();
  if (was_current && !member.jobs.empty()) {
    Job& next = member.jobs.front();
    next.sent = next.heard = next.resent = now;
    next.excused = {};
  }
  Crew::praise(member);
  const double busy = was_current ? seconds_of(now - job.sent) : 0.0;
  counts.busy_seconds += busy;
  if (first_of(job).kind == Task::Kind::evaluate) {
    Definition& definition = definitions_[first_of(job).definition];
    definition.longest = std::max(definition.longest, busy);
    definition.seconds += busy;
    definition.answers += static_cast<std::int64_t>(job.tasks.size());
  }
  return job;
}

/// The worker lacks what it was thought to have: all is sent again, lest what comes drives out what is there.
void Foreman::supply(Member& member, const Missing& missing) {
  const auto job = find_job(member, missing.request);
  if (job == member.jobs.end()) return;
  if (first_of(*job).kind == Task::Kind::fetch || ++job->supplied > kMostSupplied)
    throw FalseMessage("it misses something for no reason");
  job->resent = Clock::now();
  if (missing.definition) member.defined.erase(first_of(*job).definition);
  for (const std::size_t number : job->tasks) {
    if (const StatePointer& state = task(number).cell.state) member.known.forget(state->name());
    task(number).home = 0;
  }
  send(member, *job);
}

void Foreman::take_refusal(Member& member, const Refusal& refusal) {
  const auto found = find_job(member, refusal.request);
  if (found == member.jobs.end()) return;
  const Task& first = first_of(*found);
  const std::size_t places = first.residents ? first.residents->boxes + 1 : found->tasks.size();
  if (refusal.place >= places || first.kind == Task::Kind::fetch)
    throw FalseMessage("a refusal that does not fit its request");
  if (first.residents) end_refused(member, first, refusal);
  Job job = finished(member, refusal.request);
  Task& refused = task(job.tasks[refusal.place]);
  job.tasks.erase(job.tasks.begin() + refusal.place);
  put_back(job);
  end_attempt(refused, {Attempt::End::refused, member.number, member.party,
                        fmt::format("{} refuses {}: {}", member.name, place_of(refused), refusal.message)});
  give_all();
}

// ---- what cannot be carried to its end

void Foreman::put_back(const Job& job) {
  for (auto number = job.tasks.rbegin(); number != job.tasks.rend(); ++number) {
    if (task(*number).kind == Task::Kind::fetch) task(*number).kind = Task::Kind::again;
    queue_.add_first(*number);
  }
}

void Foreman::drop_jobs() {
  for (Member& member : crew_.members()) member.jobs.clear();
  queue_.clear();
}

void Foreman::end_refused(const Member& member, const Task& refused, const Refusal& refusal) const {
  Task place = refused;
  ResidentWork& boxes = *place.residents;
  if (refusal.place < boxes.boxes) {
    boxes.first += refusal.place;
    boxes.boxes = 1;
  }
  throw RunError(fmt::format("{} refuses {}: {}", member.name, place_of(place), refusal.message));
}

/// Somebody could not carry a task to its end.
void Foreman::end_attempt(Task& ended, Attempt attempt) {
  const std::string text = attempt.words;
  ended.attempts.add(std::move(attempt));
  // Two that end at a cell outweigh the one that has answered it.
  if (!ended.attempts.are_enough(ended.opinions.others(present()))) {
    say_again(text, 1);
    queue_.add_first(static_cast<std::size_t>(&ended - tasks_->data()));
    return;
  }
  if (ended.kind != Task::Kind::evaluate) throw RunError(text);
  tell(text + "\nno worker can answer it: the cell counts as failed");
  waiting_.erase(static_cast<std::size_t>(&ended - tasks_->data()));
  ended.reply.response.quality = Quality::failed;
  ended.reply.response.step_factor = 0.5;
  ended.reply.response.message = text;
  ++done_;
}

/// A task that somebody has tried in vain goes to who differs most from those.
bool Foreman::may_take(const Member& member, const Task& next) {
  const Candidate worker{member.number, member.party, member.name};
  const std::vector<Candidate> others = next.opinions.others(present());
  if (next.attempts.empty()) return next.opinions.may_answer(worker, others);
  return next.attempts.may_try(worker, others) &&
         std::ranges::any_of(others, [&](const Candidate& other) { return other.worker == worker.worker; });
}

std::vector<Candidate> Foreman::present() {
  std::vector<Candidate> workers;
  for (const Member& member : crew_.members())
    if (!blamed_.contains(member.number)) workers.push_back({member.number, member.party, member.name});
  if (crew_.is_filling()) workers.push_back({0, "", "a process of ours that is on its way"});
  return workers;
}

void Foreman::say_again(const std::string& text, std::size_t cells) const {
  tell(text + (text.ends_with('\n') ? "" : "; ") +
       (cells == 1 ? "its cell goes to another worker" : "its cells go to other workers"));
}

std::string Foreman::place_of(const Task& at) const {
  const CellDefinition& cell = definitions_[at.definition].cell;
  if (at.residents && at.residents->boxes > 1) {
    const std::size_t first = at.residents->first;
    return fmt::format("points {} to {} of material '{}' ({})", first, first + at.residents->boxes - 1,
                       cell.name, cell.script_file);
  }
  const std::optional<std::size_t> point = at.residents ? at.residents->first : at.point;
  const std::string what = point ? fmt::format("point {}", *point) : "a cell";
  return fmt::format("{} of material '{}' ({})", what, cell.name, cell.script_file);
}

std::string Foreman::place_of(const Job& job) const {
  const std::string first = place_of(task(job.tasks.front()));
  return job.tasks.size() == 1 ? first : fmt::format("{} cells from {} on", job.tasks.size(), first);
}

}  // namespace polargrain::coupler
