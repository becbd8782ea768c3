// `liana drive jog`: one motor a short way, before there is a robot table.
#include <unistd.h>

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <iostream>
#include <optional>

#include "host/apps/cli/arguments.hpp"
#include "host/apps/cli/drive_session.hpp"
#include "host/apps/launcher/errors.hpp"
#include "host/base/json/json.hpp"
#include "host/drives/canopen/boot_mismatch.hpp"
#include "host/drives/canopen/emergency.hpp"
#include "host/drives/commissioning/jog_run.hpp"
#include "host/model/config/drive_type.hpp"

namespace liana::cli {
namespace {

using commissioning::JogResult;

constexpr double kMinTurns = 0.001, kMaxTurns = 100.0;  // of a way, and of a way in a second
constexpr double kUsualTurns_per_s = 0.05;              // where no speed is asked for
constexpr double kWindowTurns = 0.02, kWindow_s = 0.1;  // behind its target a motor may be so far, and so long
constexpr double kSettledTurns = 0.0005;
constexpr std::uint16_t kDeadline_ms = 100;  // of targets: a desk has no real-time kernel

// What was asked for, in turns of the motor.
struct Way {
  double by_turns = 0.0;
  double turns_per_s = 0.0;
  std::string unit;
  double per_turn = 1.0;  // units in a turn of the motor
  std::string said(double turns) const {
    char text[64];
    std::snprintf(text, sizeof text, "%+.4g %s", turns * per_turn, unit.c_str());
    return text;
  }
};

double units_in_turn(const JogOptions& jog) {
  if (jog.unit != "mm" && !jog.mm_per_turn.empty())
    throw launcher::BadInput("--mm-per-turn: given, but --by is in " + jog.unit +
                             ": allowed only with --unit mm; add it, or leave this out");
  if (jog.unit == "turns") return 1.0;
  if (jog.unit == "deg") return 360.0;
  if (jog.unit != "mm") throw launcher::BadInput("--unit: " + jog.unit + ": allowed are turns, deg and mm");
  if (jog.mm_per_turn.empty())
    throw launcher::BadInput(
        "--unit: mm needs --mm-per-turn, the way of one turn of the motor: allowed 0.001 to 10000");
  return parse_number_in("--mm-per-turn", jog.mm_per_turn, 0.001, 10000.0, "mm");
}

// An amount that is asked for in the unit of the way: its least is kMinTurns.
struct Amount {
  const char* option;
  const char* max_option;  // raises its most
  double max_turns;
  bool is_signed;
  const char* per;  // behind the unit
};

[[noreturn]] void refuse_turns(const Amount& amount, const std::string& text, bool is_too_much, const Way& way) {
  char range[96];
  std::snprintf(range, sizeof range, "%g to %g ", kMinTurns * way.per_turn, amount.max_turns * way.per_turn);
  const std::string unit = way.unit + amount.per;
  const std::string raise = is_too_much && amount.max_turns < kMaxTurns
                                ? std::string(", or raise ") + amount.max_option + " when nothing can be in the way"
                                : "";
  throw launcher::BadInput(std::string(amount.option) + ": " + text + " " + unit + ": allowed " + range + unit +
                           (amount.is_signed ? " either way" : ", the sign of --by says which way") + ": ask for " +
                           (is_too_much ? "less" : "an amount within it") + raise);
}

double parse_turns(const Amount& amount, const std::string& text, const Way& way) {
  const double turns = parse_number(amount.option, text) / way.per_turn;
  const double size = amount.is_signed ? std::fabs(turns) : turns;
  const bool is_too_much = size > amount.max_turns * (1.0 + 1e-9);
  if (is_too_much || size < kMinTurns * (1.0 - 1e-9)) refuse_turns(amount, text, is_too_much, way);
  return turns;
}

Way way_of(const JogOptions& jog) {
  Way way;
  way.unit = jog.unit;
  way.per_turn = units_in_turn(jog);
  const double most = parse_number_in("--most", jog.most, kMinTurns, kMaxTurns, "turns of the motor");
  const double fastest = parse_number_in("--most-speed", jog.max_speed, kMinTurns, kMaxTurns, "turns/s");
  way.by_turns = parse_turns({"--by", "--most", most, true, ""}, jog.by, way);
  way.turns_per_s = jog.speed.empty() ? std::min(kUsualTurns_per_s, fastest)
                                      : parse_turns({"--speed", "--most-speed", fastest, false, "/s"}, jog.speed, way);
  return way;
}

void ask_for_the_word(const DriveOptions& options, const Way& way) {
  if (options.jog.yes) return;
  if (isatty(STDIN_FILENO) == 0)
    throw launcher::BadInput("drive jog: nothing moves unasked: allowed is --yes, or the word jog typed at a terminal");
  std::fprintf(
      stderr,
      "Node %s will turn the motor of its axis %s by %s, at %s/s, with at most %s permille of its rated torque.\n"
      "Nothing and nobody in the way, its emergency stop in reach? Type jog to move: ",
      options.node.c_str(), options.axis.c_str(), way.said(way.by_turns).c_str(), way.said(way.turns_per_s).c_str() + 1,
      options.jog.torque.c_str());
  std::string word;
  if (!std::getline(std::cin, word) || word != "jog")
    throw launcher::BadInput("drive jog: \"" + word + "\": allowed is the word jog; nothing has moved");
}

// Encoder counts of one turn of the motor: as given, else as the drive says, or its type.
std::uint32_t counts_per_turn(DriveSession& session, commissioning::Place at, const DriveOptions& options) {
  constexpr std::int64_t kMost = 1 << 30;
  if (!options.jog.counts_per_turn.empty())
    return static_cast<std::uint32_t>(parse_whole("--counts-per-turn", options.jog.counts_per_turn, 1, kMost));
  const std::uint16_t encoder = canopen::on_axis(0x608F, at.axis);
  const commissioning::Answer counts = session.desk.read(at, encoder, 1), turns = session.desk.read(at, encoder, 2);
  const std::uint32_t in_turn = counts.value() / std::max(1U, turns.is_done() ? turns.value() : 1U);
  const bool is_known = counts.is_done() && in_turn >= 1 && in_turn <= kMost;
  if (is_known && !drive_type_of(options).units.encoder) return in_turn;
  throw launcher::BadInput("--counts-per-turn: not given, and the drive has no 608F that says it: allowed 1 to " +
                           std::to_string(kMost) + ", from the motor's data sheet");
}

struct Prepared {
  canopen::ExpectedDrive drive;
  commissioning::JogRequest request;
  std::uint32_t counts_per_turn = 1;
};

// Boot and way: the drive's own torque, window and deadline are set narrow, too.
Prepared prepare(DriveSession& session, commissioning::Place at, const DriveOptions& options, const Way& way) {
  Prepared out;
  out.drive = expected_drive(session, at, options);
  const std::uint32_t counts = counts_per_turn(session, at, options);
  const double window = counts * (kWindowTurns + kWindow_s * way.turns_per_s);
  const commissioning::Answer position = session.desk.read(at, canopen::on_axis(0x6064, at.axis), 0);
  if (!position.is_done())
    throw std::runtime_error("drive jog: reading 6064, where the motor is: " + failure_text(position));
  const double here = static_cast<std::int32_t>(position.value());
  const double there = here + counts * way.by_turns;
  if (std::fabs(there) > 2147483647.0) {
    throw std::runtime_error("drive jog: from " + std::to_string(std::lround(here)) +
                             " the way leads beyond what 607A can say: set the encoder's zero with the maker's tool");
  }
  out.counts_per_turn = out.drive.counts_per_turn = counts;
  out.drive.type.max_torque_permille =
      static_cast<std::uint16_t>(parse_whole("--torque", options.jog.torque, 10, 1000, " permille of rated torque"));
  out.drive.demand = {std::min(here, there), std::max(here, there), counts * way.turns_per_s};
  out.drive.following_window_counts = static_cast<std::uint32_t>(std::min(std::ceil(window), 4294967295.0));
  out.drive.rpdo_deadline_ms = std::max(out.drive.rpdo_deadline_ms, kDeadline_ms);
  out.request.by_counts = counts * way.by_turns;
  out.request.counts_per_s = counts * way.turns_per_s;
  out.request.window_counts = window;
  out.request.settled_counts = std::max(2.0, counts * kSettledTurns);
  out.request.most_torque_permille = out.drive.type.max_torque_permille;
  out.request.clears_fault = options.jog.clear;
  return out;
}

std::string emergency_said(std::uint16_t code) {
  if (code == 0) return "no emergency message came, and 603F has no code";
  return "emergency " + hex(code, 4) + ", " + canopen::emergency_text(code);
}

std::string why(const commissioning::JogOutcome& outcome) {
  std::string code = emergency_said(outcome.emergency_code);
  switch (outcome.end) {
    case JogResult::kFaultBefore:
      return "it has a fault: " + code + "; when its cause is gone, --clear makes it forget it";
    case JogResult::kNotEnabled:
      return "not enabled within 5 s: " + code + "; is its STO input closed, and is its power stage supplied?";
    case JogResult::kFault:
      return "the drive stopped by itself: " + code;
    case JogResult::kEmergency:
      return code;
    case JogResult::kReportsLost:
      return "its reports stopped coming: is its cable, or its supply, off?";
    case JogResult::kHeartbeatLost:
      return "its heartbeat stopped, or says that it is not operational any more";
    case JogResult::kOtherMode:
      return "it shows another mode (6061) than 8, csp, which it was told: does something else write its 6060?";
    case JogResult::kRanAway:
      return "the motor is not where it was told to be: is it blocked, too weak for --torque, or is "
             "--counts-per-turn another?";
    case JogResult::kTorque:
      return "it needed more than --torque: is it blocked, or loaded? Does the drive obey 6072?";
    case JogResult::kBounds:
      return "a target was out of bounds and was not sent: a mistake of this program, please report it";
    case JogResult::kNotSettled:
      return "it does not come to its goal: is --torque too low?";
    case JogResult::kNone:
    case JogResult::kArrived:
    case JogResult::kInterrupted:
      break;
  }
  return "interrupted";
}

std::string state_of(std::uint16_t statusword) { return drive_state_name(decode(statusword)); }

Json sample_json(const commissioning::JogSample& sample, double turn, bool has_torque) {
  Json out = {{"time_s", sample.time_s},
              {"position_counts", sample.seen.position_counts},
              {"moved_turns", sample.moved_counts / turn},
              {"status", state_of(sample.seen.statusword)}};
  if (has_torque) out["torque_permille"] = sample.seen.torque_permille;
  if (sample.current_permille) out["current_permille"] = *sample.current_permille;
  return out;
}

// Permille as percent; nothing: the drive does not report it.
std::string percent(std::optional<std::int16_t> permille) {
  char text[16] = "   -";
  if (permille) std::snprintf(text, sizeof text, "%4.1f", 0.1 * *permille);
  return text;
}

void print_sample(const commissioning::JogSample& sample, const Way& way, double turn, bool has_torque) {
  const std::string current = percent(sample.current_permille);
  const std::string torque = percent(has_torque ? std::optional(sample.seen.torque_permille) : std::nullopt);
  std::printf("%6.2f s  %9d counts  %12s  torque %5s %%  current %s %%  %s\n", sample.time_s,
              sample.seen.position_counts, way.said(sample.moved_counts / turn).c_str(), torque.c_str(),
              current.c_str(), state_of(sample.seen.statusword).c_str());
  std::fflush(stdout);
}

int exit_code(const commissioning::JogOutcome& outcome) {
  if (outcome.end == JogResult::kArrived && outcome.is_off) return launcher::ExitCode::kExitOk;
  const bool is_interrupted = outcome.end == JogResult::kInterrupted && outcome.is_off;
  return is_interrupted ? launcher::ExitCode::kExitInterrupted : launcher::ExitCode::kExitFailure;
}

Json outcome_json(const commissioning::JogOutcome& outcome, const Prepared& prepared) {
  Json said = {{"ok", exit_code(outcome) == launcher::ExitCode::kExitOk},
               {"node", prepared.drive.node},
               {"axis", prepared.drive.axis},
               {"counts_per_turn", prepared.counts_per_turn},
               {"start_counts", outcome.start_counts},
               {"moved_counts", outcome.moved_counts},
               {"moved_turns", outcome.moved_counts / static_cast<double>(prepared.counts_per_turn)},
               {"is_off", outcome.is_off},
               {"status", state_of(outcome.statusword)}};
  if (prepared.drive.type.has_torque) said["most_torque_permille"] = outcome.most_torque_permille;
  if (outcome.end != JogResult::kArrived) said["why"] = why(outcome);
  if (outcome.emergency_code != 0) said["emergency_code"] = outcome.emergency_code;
  return said;
}

int tell_outcome(const DriveSession& session, commissioning::Place at, const commissioning::JogOutcome& outcome,
                 const Prepared& prepared, const Way& way, Json* json) {
  if (json != nullptr) {
    Json said = outcome_json(outcome, prepared);
    said["samples"] = *json;
    std::printf("%s\n", said.dump().c_str());
  }
  const std::string moved = way.said(outcome.moved_counts / static_cast<double>(prepared.counts_per_turn));
  const std::string state = state_of(outcome.statusword), where = session.where(at);
  if (outcome.end != JogResult::kArrived) {
    std::fprintf(stderr, "liana: %s: %s; it has moved %s\n", where.c_str(), why(outcome).c_str(), moved.c_str());
  } else if (json == nullptr) {
    std::printf("%s moved %s (%d counts)", where.c_str(), moved.c_str(), outcome.moved_counts);
    if (prepared.drive.type.has_torque)
      std::printf(", at most %.1f %% of its rated torque\n", 0.1 * outcome.most_torque_permille);
    else
      std::printf("; it reports no torque, and nothing watched it\n");
  }
  if (!outcome.is_off) {
    std::fprintf(stderr, "liana: %s does not say that it is disabled (%s): switch off its supply\n", where.c_str(),
                 state.c_str());
  } else if (json == nullptr) {
    std::fprintf(outcome.end == JogResult::kArrived ? stdout : stderr, "disabled: %s\n", state.c_str());
  }
  return exit_code(outcome);
}

int tell_refusals(const DriveSession& session, commissioning::Place at, const canopen::BootNode& node, bool json) {
  Json refusals = Json::array();
  for (const canopen::BootMismatch& mismatch : node.mismatches())
    refusals.push_back(canopen::describe({&mismatch, 1}, 0, session.where(at), canopen::BootReference::kDesk));
  const Json said = {{"ok", false}, {"node", at.node}, {"is_off", true}, {"refusals", refusals}};
  if (json) std::printf("%s\n", said.dump().c_str());
  for (const Json& each : refusals) std::fprintf(stderr, "liana: refused: %s\n", each.text().c_str());
  std::fprintf(stderr, "liana: %s was not enabled: liana drive check says more\n", session.where(at).c_str());
  return launcher::ExitCode::kExitFailure;
}

}  // namespace

int drive_jog_command(const DriveOptions& options) {
  const Way way = way_of(options.jog);
  const config::DriveType type = drive_type_of(options);  // bad input before anything is asked
  if (type.is_cst)
    throw launcher::BadInput(
        "--type: " + options.type +
        ": follows torques, and jog leads positions: allowed is a type that follows positions, such "
        "as cia402_csp; drives that follow torques are moved as such with a robot only");
  parse_whole("--torque", options.jog.torque, 10, 1000, " permille of rated torque");
  const std::uint8_t node = node_of(options), axis = axis_of(options);
  if (const std::string warning = nothing_stops(type); !warning.empty())
    std::fprintf(stderr, "liana: warning: %s\n", warning.c_str());
  ask_for_the_word(options, way);
  DriveSession session(options);
  refuse_beside_a_master(session);
  const commissioning::Place at = session.place(node, axis);
  if (const commissioning::Answer there = session.desk.read(at, 0x1000, 0); !there.is_done())
    return tell_failure(session, at, "reading 1000", there, options.json);
  const Prepared prepared = prepare(session, at, options, way);
  commissioning::JogRun run(session.desk, prepared.drive);
  if (const canopen::BootNode& node = run.boot(); node.phase() != canopen::NodePhase::kOperational)
    return tell_refusals(session, at, node, options.json);
  Json samples = Json::array();
  const double turn = prepared.counts_per_turn;
  const commissioning::JogOutcome outcome = run.jog(prepared.request, [&](const commissioning::JogSample& sample) {
    if (options.json) {
      samples.push_back(sample_json(sample, turn, type.has_torque));
    } else {
      print_sample(sample, way, turn, type.has_torque);
    }
  });
  return tell_outcome(session, at, outcome, prepared, way, options.json ? &samples : nullptr);
}

}  // namespace liana::cli
