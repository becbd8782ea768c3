#include "host/apps/ground/on_board.hpp"

#include <algorithm>
#include <cmath>

namespace liana::ground {
namespace {

constexpr std::uint8_t kAcceptance = 1, kStart = 3, kCompletion = 7, kRouting = 9;  // subtypes of service 1
constexpr double kOften_s = 1.0, kSeldom_s = 10.0;                                  // between reports
constexpr std::uint8_t kMaxExponent = 8;
constexpr std::uint64_t kMaxInterval = 1000000;

Ending done() { return {}; }

void append_json(std::string& out, const ReportRow& row, const Json& values) {
  for (const Parameter& each : row.parameters) append_value(out, each, Sizes(), values.member_or_null(each.name));
}

const ReportRow& row_of(std::uint8_t service, std::uint8_t subtype) {
  const auto rows = reports();
  return *std::find_if(rows.begin(), rows.end(), [service, subtype](const ReportRow& row) {
    return row.service == service && row.subtype == subtype;
  });
}

// What follows the function id; service 8 has one.
std::string_view arguments_in(const Telecommand& telecommand) {
  constexpr std::size_t kId = 2;
  const std::string_view data = telecommand.data;
  return telecommand.service == 8 ? data.substr(std::min(kId, data.size())) : data;
}

std::uint64_t function_in(const Telecommand& telecommand) {
  if (telecommand.service != 8) return 0;
  return telecommand.data.size() < 2 ? 0 : read_whole(std::string_view(telecommand.data).substr(0, 2));
}

}  // namespace

OnBoard::OnBoard(const OnBoardConfig& config, Ways ways)
    : config_(config), ways_(std::move(ways)), downlink_(config.store_bytes, ways_.send) {
  for (const std::size_t structure : {1u, 2u, 5u}) periodic_[structure - 1].is_on = true;
}

void OnBoard::set_time(double now_s, std::uint64_t time_us) {
  now_s_ = now_s;
  time_us_ = time_us;
}

void OnBoard::receive(std::string_view packet) {
  if (packet.size() < kPrimaryBytes) {
    ++unreadable_;
    return;
  }
  ++received_;
  Telecommand telecommand;
  const Failure failure = read_telecommand(packet, telecommand);
  if (failure != Failure::kNone) {
    ++rejected_;
    return verify(telecommand, kAcceptance, kAcknowledgeAcceptance,
                  failed(failure, static_cast<std::uint32_t>(packet.size())));
  }
  if (telecommand.service != 15) heard_s_ = now_s_;  // a store that fills its gaps does not fly the arm
  count(telecommand);
  route(telecommand);
}

// Each source counts for itself: a store that fills its gaps does not make a station's counts jump.
void OnBoard::count(const Telecommand& telecommand) {
  const auto [last, is_first] = last_counts_.try_emplace(telecommand.source, telecommand.primary.count);
  const unsigned expected = (last->second + 1u) % kCountModulus;
  if (!is_first && telecommand.primary.count != expected) ++count_jumps_;
  last->second = telecommand.primary.count;
}

void OnBoard::route(const Telecommand& telecommand) {
  if (telecommand.primary.apid != kArmApid) {
    ++rejected_;
    return verify(telecommand, kRouting, 0, failed(Failure::kApid, telecommand.primary.apid));
  }
  const std::uint64_t function = function_in(telecommand);
  const CommandRow* row = find_command(telecommand.service, telecommand.subtype, function);
  Ending ending = row != nullptr ? carry_out(telecommand, *row)
                  : is_known(telecommand.service, telecommand.subtype)
                      ? failed(Failure::kFunction, static_cast<std::uint32_t>(function))
                      : failed(Failure::kService, telecommand.service * 256u + telecommand.subtype);
  if (ending.code == 0) return;
  ++rejected_;
  verify(telecommand, kAcceptance, kAcknowledgeAcceptance, ending);
}

// Acceptance failures are returned; what is accepted reports itself.
Ending OnBoard::carry_out(const Telecommand& telecommand, const CommandRow& row) {
  try {
    if (row.service == 8) return request(telecommand, row);
    const Json values = values_of(arguments_of(row), sizes_, arguments_in(telecommand));
    if (row.service == 3) return housekeeping(telecommand, values);
    if (row.service == 15) return resend(telecommand, values);
    if (row.service == 9) {
      const std::uint64_t exponent = values.value("exponent", std::uint64_t{kMaxExponent + 1});
      if (exponent > kMaxExponent) return failed(Failure::kArgument);
      time_exponent_ = static_cast<std::uint8_t>(exponent);
    }
  } catch (const JsonError& error) {
    return {static_cast<std::uint16_t>(Failure::kArgument), static_cast<std::uint32_t>(telecommand.data.size()),
            error.what()};
  }
  verify(telecommand, kAcceptance, kAcknowledgeAcceptance, done());
  verify(telecommand, kStart, kAcknowledgeStart, done());
  if (row.service == 17) downlink_.report(17, 2, telecommand.source, time_us_, "");
  if (row.service == 9) send_time();
  verify(telecommand, kCompletion, kAcknowledgeCompletion, done());
  return done();
}

Ending OnBoard::housekeeping(const Telecommand& telecommand, const Json& values) {
  const std::uint64_t structure = values.value("structure", std::uint64_t{0});
  const std::uint64_t interval = values.value("interval", std::uint64_t{1});
  if (values.value("entries", std::uint64_t{0}) != 1) return failed(Failure::kArgument);
  if (find_structure(structure) == nullptr) return failed(Failure::kFunction, static_cast<std::uint32_t>(structure));
  if (interval < 1 || interval > kMaxInterval) return failed(Failure::kArgument, static_cast<std::uint32_t>(interval));
  const bool is_ours = structure == kStructures;  // counters, which are here without lianad
  if (telecommand.subtype == 27 && state_.is_null() && !is_ours) return failed(Failure::kAway);
  verify(telecommand, kAcceptance, kAcknowledgeAcceptance, done());
  verify(telecommand, kStart, kAcknowledgeStart, done());
  Periodic& periodic = periodic_[structure - 1];
  if (telecommand.subtype == 5 || telecommand.subtype == 6) periodic.is_on = telecommand.subtype == 5;
  if (telecommand.subtype == 31) periodic.interval = static_cast<std::uint32_t>(interval);
  if (telecommand.subtype == 27) send_structure(structure);
  verify(telecommand, kCompletion, kAcknowledgeCompletion, done());
  return done();
}

Ending OnBoard::resend(const Telecommand& telecommand, const Json& values) {
  if (values.value("entries", std::uint64_t{0}) != 1) return failed(Failure::kArgument);
  if (values.value("store", std::uint64_t{0}) != 1) return failed(Failure::kFunction);
  const auto from_us = values.at("from").get<std::uint64_t>(), to_us = values.at("to").get<std::uint64_t>();
  if (from_us > to_us) return failed(Failure::kArgument);
  if (resend_goes_on_ || !downlink_.begin_resend(from_us, to_us)) return failed(Failure::kTooMany);
  verify(telecommand, kAcceptance, kAcknowledgeAcceptance, done());
  verify(telecommand, kStart, kAcknowledgeStart, done());
  resending_ = telecommand;
  resend_goes_on_ = true;
  return done();
}

Ending OnBoard::request(const Telecommand& telecommand, const CommandRow& row) {
  if (executions_.size() >= kMaxOpen && std::string_view(row.op) != "stop") return failed(Failure::kTooMany);
  if (!is_there_) return failed(Failure::kAway);
  Execution execution{telecommand, &row, request_of(row, sizes_, arguments_in(telecommand)), next_id_++};
  execution.deadline_s = now_s_ + row.limit_s;
  execution.refused_motions = state_.is_null() ? 0 : state_.value("refused_motions", std::uint64_t{0});
  Json request = execution.request;
  request["id"] = execution.id;
  verify(telecommand, kAcceptance, kAcknowledgeAcceptance, done());
  executions_.push_back(std::move(execution));
  if (!ways_.request(request)) {
    verify(telecommand, kStart, kAcknowledgeStart, failed(Failure::kAway));
    executions_.pop_back();
  }
  return done();
}

void OnBoard::welcome(const Json& message) {
  sizes_ = sizes_of(message.at("robot"));
  const double interval_s = message.at("period_s").get<double>() * message.at("interval_ticks").get<double>();
  const auto intervals = [interval_s](double seconds) {
    return static_cast<std::uint32_t>(std::clamp(std::round(seconds / interval_s), 1.0, 1e6));
  };
  if (!is_there_ && last_event_ == 0) {
    for (Periodic& each : periodic_) each.interval = intervals(kOften_s);
    periodic_.back().interval = intervals(kSeldom_s);
  }
  is_there_ = true;
  own_event(OwnEvent::kControllerThere);
}

void OnBoard::take(const Json& message) {
  const std::string op = message.value("op", "");
  if (op == "state") take_state(message);
  if (op == "event") take_event(message);
  if ((op == "ok" || op == "error") && message.contains("id")) answer(message);
}

void OnBoard::answer(const Json& message) {
  const auto id = message.at("id").get<std::uint64_t>();
  const auto found = std::find_if(executions_.begin(), executions_.end(),
                                  [id](const Execution& each) { return each.id == id && !each.is_answered; });
  if (found == executions_.end()) return;
  if (message.value("op", "") == "error") {
    verify(found->telecommand, kStart, kAcknowledgeStart, refused(message));
    executions_.erase(found);
    return;
  }
  verify(found->telecommand, kStart, kAcknowledgeStart, done());
  found->is_answered = true;
  if (replaces_motion(*found)) end_replaced(id);
  if (found->row->completes != Completes::kAnswer) return;
  complete(*found, done());
  executions_.erase(found);
}

// A motion that another telecommand ended has not come to its goal.
void OnBoard::end_replaced(std::uint64_t by) {
  std::erase_if(executions_, [&](const Execution& each) {
    if (each.id >= by || !each.is_answered || !is_motion(each)) return false;
    complete(each, failed(Failure::kNotOwner));
    return true;
  });
}

void OnBoard::take_state(const Json& state) {
  state_ = state;
  std::erase_if(executions_, [&](Execution& each) {
    if (!each.is_answered) return false;
    ++each.states;
    const auto ending = judge(each, state);
    if (ending) complete(each, *ending);
    return ending.has_value();
  });
  for (std::size_t i = 0; i < kStructures; ++i) {
    Periodic& each = periodic_[i];
    if (!each.is_on || ++each.passed < each.interval) continue;
    each.passed = 0;
    send_structure(i + 1);
  }
}

void OnBoard::send_structure(std::size_t structure) {
  const ReportRow& row = *find_structure(structure);
  downlink_.report(3, 25, 0, time_us_, record_of(row, sizes_, structure == kStructures ? counters() : state_));
}

Json OnBoard::counters() const {
  return {{"received", received_},
          {"rejected", rejected_},
          {"unreadable", unreadable_},
          {"count_jumps", count_jumps_},
          {"open", static_cast<std::uint64_t>(executions_.size())},
          {"sent", downlink_.sent()},
          {"stored", static_cast<std::uint64_t>(downlink_.stored())},
          {"dropped", downlink_.dropped()},
          {"links_lost", links_lost_}};
}

void OnBoard::take_event(const Json& event) {
  last_event_ = event.value("sequence", std::uint64_t{0});
  const std::string kind = event.value("kind", "");
  Json values = event;
  values["definition"] = definition_of(kind);
  const std::uint8_t severity = severity_of(kind, event.value("number", std::int64_t{0}));
  std::string data;
  append_json(data, row_of(5, severity), values);
  downlink_.report(5, severity, 0, time_us_, data);
}

void OnBoard::own_event(OwnEvent event, const std::string& more) {
  const OwnEventRow& row = row_of(event);
  std::string data;
  append_json(
      data, row_of(5, row.severity),
      {{"definition", static_cast<std::uint64_t>(event)}, {"subject", kClientName}, {"text", row.meaning + more}});
  downlink_.report(5, row.severity, 0, time_us_, data);
}

void OnBoard::send_time() {
  std::string data;
  append_json(data, row_of(9, 2), {{"exponent", time_exponent_}, {"time", time_us_}, {"status", 0}});
  downlink_.time_packet(time_us_, data);
  time_sent_s_ = now_s_;
}

void OnBoard::controller_gone() {
  if (!is_there_) return;
  is_there_ = false;
  state_ = Json();
  fail_all(Failure::kAway);
  own_event(OwnEvent::kControllerGone, ": it has ended, or closed the connection");
}

void OnBoard::fail_all(Failure failure) {
  for (const Execution& each : executions_) complete(each, failed(failure));
  executions_.clear();
}

// lianad holds an arm whose owner is gone.
void OnBoard::lose_link() {
  if (state_.is_null() || state_.value("owner", "") != kClientName) return;
  ++links_lost_;
  fail_all(Failure::kLinkLost);
  own_event(OwnEvent::kLinkLost, ": ground leaves lianad, which holds the arm");
  is_there_ = false;
  state_ = Json();
  ways_.leave();
}

void OnBoard::tick() {
  if (now_s_ - heard_s_ > config_.silence_s) lose_link();
  if (now_s_ - time_sent_s_ >= std::ldexp(1.0, time_exponent_)) send_time();
  std::erase_if(executions_, [&](const Execution& each) {
    if (now_s_ < each.deadline_s) return false;
    complete(each, failed(Failure::kNoConfirmation));
    return true;
  });
  downlink_.go_on_resending(kResentAtOnce);
  if (!resend_goes_on_ || downlink_.is_resending()) return;
  resend_goes_on_ = false;
  verify(resending_, kCompletion, kAcknowledgeCompletion, done());
}

void OnBoard::complete(const Execution& execution, const Ending& ending) {
  if (execution.is_answered) return verify(execution.telecommand, kCompletion, kAcknowledgeCompletion, ending);
  verify(execution.telecommand, kStart, kAcknowledgeStart, ending);
}

// Failures are always reported, successes where the telecommand asks for it.
void OnBoard::verify(const Telecommand& telecommand, std::uint8_t good_subtype, std::uint8_t asked,
                     const Ending& ending) {
  if (ending.code == 0 && (telecommand.acknowledge & asked) == 0) return;
  const auto subtype = static_cast<std::uint8_t>(good_subtype + (ending.code == 0 ? 0 : 1));
  const std::string head = primary_bytes(telecommand.primary);
  std::string data;
  append_json(data, row_of(1, subtype),
              {{"packet_id", read_whole(std::string_view(head).substr(0, 2))},
               {"sequence_control", read_whole(std::string_view(head).substr(2, 2))},
               {"code", ending.code},
               {"detail", ending.detail},
               {"text", ending.text}});
  downlink_.report(1, subtype, telecommand.source, time_us_, data);
}

}  // namespace liana::ground
