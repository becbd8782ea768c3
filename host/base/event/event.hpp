// Why something happened, as data: what the operator's log, recordings, clients and files show is a view of it.
#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <string_view>
#include <type_traits>
#include <vector>

namespace liana::event {

// What an event is about. `number`, `subject` and the names in `values` mean what stands beside the kind.
enum class EventKind : std::uint8_t {
  kBoot,         // number: BootEvent
  kBootProblem,  // number of the fault (docs/reference/faults.md), subject the drive, value `drive`
  kHoming,       // number: HomingEvent
  kFault,        // number of the fault, 0: faults that found no place; subject drive, bus or nothing; `detail`, `tick`,
                 // `cause`: number of the fault that it follows from, 0: none
  kEmergency,    // number: emergency error code of CiA 301; subject the drive, value `drive`
  kClear,        // number: conditions that were not met, as bits, 0: cleared; value `checked`, as bits
  kHostWarning,  // number: HostTroubleEvent; subject the bus, or what else of the host; `count`
  kClient,       // a client is gone; subject its name
  kOwner,        // number: OwnerEvent; subject the client's name; `ttl_s` of one that stands still
  kStep,         // number of the step that begins, 0 when the last is over; subject its name
  kOperator,     // subject the operator's name; what he says
  kDevice,       // number: DeviceEvent; subject the device's name; `rate_hz`, `min_s`, `max_s`, `samples`
  kTool,         // subject the client's name; the command for the repair tool
  kRefusal,      // a request was answered with an error; number: RefusalEvent; subject the client's name
  kVerdict,      // verification refused a command: number M_e; subject which of the two ends; `command`, `share`
  kPath,         // number: PathEvent; subject the path's hash; `share` of its time, `duration_s`
  kRetract,      // number: RetractEvent; `points` of the path, `distance_m` of the arm from it
  kFriction,     // number: 5009 where it is not as declared, 0: as declared again; `mu`, `sd`, `declared_mu`
  kLoadCell,     // number: 5010 where tension is by torque, 0: by the cell again; `cable`
  kStop,         // number: stop category (docs/explanation/fault-detection.md); subject who asked for it
  kShutdown,     // subject who asked for it, or nothing
  kLeftOut,      // subject: a kind of which too many came within one interval; `count` of those without a number
};
constexpr std::size_t kEventKinds = 22;

enum class BootEvent : std::uint8_t {
  kFailed = 0,
  kDone = 1,
  kGoesOn = 2,
  kUnwatched = 3,  // something of a drive is not watched; the text says what
};
enum class HomingEvent : std::uint8_t { kContradicted = 0, kHomed = 1 };
enum class OwnerEvent : std::uint8_t { kAcquired = 1, kReleased = 2, kGone = 3, kStandsStill = 4, kTaken = 5 };
enum class HostTroubleEvent : std::uint8_t {
  kBusState = 1,        // an interface changed its state; `state`: 0 active, 1 error passive, 2 bus off, 3 down
  kErrorFrames = 2,     // an interface reported `count` error frames
  kFramesLost = 3,      // `count` received frames were not fetched in time
  kFramesRefused = 4,   // a transmit queue is full
  kFramesTaken = 5,     // it takes frames again; `count` were refused
  kTicksLost = 6,       // `count` control deadlines were lost
  kEventFile = 7,       // the file of events takes no more
  kEventFileGood = 8,   // it takes events again; `count` are missing in it
  kWayFile = 9,         // the file that keeps the way back takes no more, or what it holds is not used
  kArchive = 10,        // the flight recorder loses something; `count` of it, 0: it makes room on a full disk
  kEnablingWaits = 11,  // a drive or a cable keeps the arm from being enabled
};
enum class DeviceEvent : std::uint8_t {
  kFastAgain = 0,  // as many samples a second again as there have to be
  kSlow = 1,       // fewer than 50 in a second
  kLeft = 2,       // no longer in use: how regularly its samples came
  kConnected = 3,  // its driver has said hello
  kGone = 4,       // its driver has left
  kRefused = 5,    // its driver sent what is not allowed, and was let go
};
enum class PathEvent : std::uint8_t { kRefused = 0, kBegins = 1, kArrives = 2, kStops = 3 };
enum class RetractEvent : std::uint8_t {
  kBegins = 1,   // a retract begins
  kArrives = 2,  // it has gone all the way
  kEnds = 3,     // it is over before its end
  kKept = 4,     // the arm is enabled beside the path, which is kept
  kLost = 5,     // the arm is enabled too far from the path, which is given up
};
// In the order of the codes in docs/reference/api.md.
enum class RefusalEvent : std::uint8_t {
  kOther = 0,
  kBadRequest = 1,
  kNotOwner = 2,
  kNotEnabled = 3,
  kFault = 4,
  kBusy = 5,
  kOutOfRange = 6,
  kRefused = 7,
  kNoDevice = 8,
};

// snake_case, the same in files, recordings, API and docs.
const char* event_kind_name(EventKind kind);
// The kind of that name, or nothing.
std::optional<EventKind> event_kind_from(std::string_view name);
// The number of an error code of the API, kOther for one that is not listed.
RefusalEvent refusal_event(std::string_view code);

// A figure of an event. The unit is in the name.
struct EventValue {
  std::string name;
  double value = 0.0;
  bool operator==(const EventValue&) const = default;
};

struct Event {
  EventKind kind = EventKind::kBoot;
  std::int64_t number = 0;
  std::string subject{};
  std::vector<EventValue> values{};
  std::string text{};          // one sentence for people
  std::uint64_t sequence = 0;  // 1, 2, ... within one life of lianad, without gaps; EventLog gives it
  std::uint64_t tick = 0;      // when it was noted; never less than that of the event before

  bool operator==(const Event&) const = default;
};

// An enumerator as the number of an event.
template <class Number>
requires std::is_enum_v<Number>
constexpr std::int64_t number_of(Number value) { return static_cast<std::int64_t>(value); }

// The heading of a file of such lines.
extern const char* const kEventLineHeading;
// One line without its end: columns as in the heading, separated by tabs and padded with blanks, values as name=number.
// Control characters become blanks. `period_s` is that of the ticks.
std::string event_line(const Event& event, double period_s);

}  // namespace liana::event
