// Dispatch as data: what becomes of every command, stage by stage, in one ordered log.
#pragma once

#include <array>
#include <cstdint>
#include <optional>
#include <string>
#include <string_view>

namespace liana::event {

// A stage in the life of a command. `number` and `subject` mean what stands beside it.
enum class Stage : std::uint8_t {
  kSetpoint,    // asked for; number: its CommandKind, subject: who owns motion
  kExecution,   // judged by the twin of the controller; number: M_e, 0 passed; share, margins, text
  kSimulation,  // judged by the simulation; as above
  kRelease,     // let out to the arm; number: the tick from which it is in force
  kStart,       // the arm has begun to follow it
  kComplete,    // its interval is over
  kRefusal,     // not released; number: M_e, subject: action, text
  kRequest,     // a request was answered with an error, no command came of it; number: RefusalEvent, subject: client
};
constexpr std::size_t kStages = 8;

// What is left of the limits at the tightest place of the motion; not a number where nothing was looked at.
constexpr std::size_t kMargins = 5;
constexpr std::array<const char*, kMargins> kMarginNames{"clearance_m", "joint_deg", "rate_deg_s", "tension_N",
                                                         "time_us"};

struct Dispatch {
  Stage stage = Stage::kSetpoint;
  std::uint64_t tick = 0;     // when it was noted; never less than that of the line before
  std::uint64_t command = 0;  // sequence of the command; 0: none came of it
  std::int64_t number = 0;
  std::string subject{};
  double share = 0.0;  // of the limit that the motion comes nearest to
  std::optional<std::array<double, kMargins>> margins{};
  std::string text{};

  bool operator==(const Dispatch&) const = default;
};

// snake_case.
const char* stage_name(Stage stage);

// The heading of a file of such lines, and one line without its end: columns separated by tabs, what is not there left
// empty. Control characters become blanks.
extern const char* const kDispatchHeading;
std::string dispatch_line(const Dispatch& dispatch);
// The line's content to the figures' four digits, or nothing when it is none.
std::optional<Dispatch> dispatch_from_line(std::string_view line);

}  // namespace liana::event
