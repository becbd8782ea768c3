// What the service asks of the arm it serves: everything whose type depends on the kind of arm is behind this.
#pragma once

#include <cstdint>
#include <functional>
#include <optional>
#include <string>
#include <vector>

#include "firmware_like/controller_io.hpp"
#include "host/api/server/arguments.hpp"
#include "host/base/event/event.hpp"
#include "host/base/json/json_fwd.hpp"
#include "host/control/arbiter/path_events.hpp"
#include "host/control/arbiter/retract_events.hpp"
#include "host/control/arbiter/way_points.hpp"
#include "host/control/realtime/link.hpp"
#include "host/control/verification/verdict.hpp"

namespace liana::server {

// When the samples of a hand were taken that a command was made of, by the device's clock.
struct SourceStamp {
  std::int64_t newest_us = 0, oldest_us = 0;
};

// How the last candidate fared.
struct LastVerdict {
  std::uint64_t sequence = 0;
  bool released = false;
  bool goes_on = false;             // what was asked for, though a command of it was refused
  verification::Verdict worst{};    // the refusing end, or the tighter margin
  std::vector<double> twin_js_deg;  // predicted at the end of the candidate's interval
  std::vector<double> stop_js_deg;  // predicted where the arm would stand if nothing came after it
  CommandKind kind = CommandKind::kNone;
  std::uint64_t first_tick = 0;  // from which it is in force
  bool leads_back = false;       // asked for by a retract
  verification::ExecutionVerdict execution{};
  verification::SimulationVerdict simulation{};
  std::optional<SourceStamp> source_stamp{};  // released, and made of what a device said
  bool is_news = true;  // false: a hand that is slowed to a stop, or that is refused for the same again; guidance tells
  bool stops = false;   // an emergency stop: the stop along the path would come to the contact, too
};

// A request about motion, from the owner, that the table of requests has let through.
struct MotionRequest {
  const char* op;
  const api::Arguments& fields;
};

// What the tip camera has seen: frames in the tip frame at capture; nothing where out of sight.
struct CameraObservation {
  double capture_time_s = 0.0;  // arm time
  std::optional<Pose> slit_in_tip, rod_in_tip, target_in_tip;
  std::string target_name = "target";
};

// Why the arm is not homed; the names stand in docs/reference/api.md.
enum class NotHomedReason : std::uint8_t {
  kHomed = 0,
  kDriveNotHeard = 1,
  kOtherPose = 2,          // not that in which the arm is said to lie
  kLengthsContradict = 3,  // those of a segment's cables
  kNotSettled = 4,         // what the encoders say changes too fast
  kOutOfRange = 5,         // a joint beyond its range
};
const char* not_homed_name(NotHomedReason reason);  // snake_case, as the state message has it

struct NotHomed {
  NotHomedReason reason = NotHomedReason::kDriveNotHeard;
  std::string text = "the drives have not been heard yet";  // what contradicts what and what to do; empty while homed
  bool is_homed() const { return reason == NotHomedReason::kHomed; }
};

class ArmServer {
 public:
  virtual ~ArmServer() = default;

  // The real-time side. refresh() takes over what it has published; the references below show that until the next one.
  virtual realtime::Link& link() = 0;
  virtual bool interval_began() const = 0;
  virtual void refresh() = 0;
  virtual void refresh_report() = 0;  // not the image: the newest tick alone
  virtual const realtime::TickStatus& report() const = 0;
  virtual const CycleInputs& inputs() const = 0;
  virtual const CycleOutputs& outputs() const = 0;
  virtual const SupervisorState& supervisor() const = 0;
  // Hands over every tick since the last call: what the drives said, and how to make its packet for the archive.
  using TickSink = std::function<void(const CycleInputs&, const std::function<std::string()>& packet)>;
  virtual void take_ticks(std::uint64_t dropped, const TickSink& sink) = 0;
  // The Controller at the start of this interval, for the archive, and the tick that it computes next.
  virtual std::uint64_t image_tick() const = 0;
  virtual std::string image_packet() const = 0;

  // Once per interval: what changes by itself. `booted`: the drives are.
  virtual void watch(bool booted) = 0;
  virtual const NotHomed& not_homed() const = 0;

  // Empty, or which latched cause a clear would be untrue about; `whole`: somebody has looked at this cable (from 1, 0:
  // none), and it is whole.
  virtual std::string why_not_clear(std::int64_t /*whole*/) { return ""; }
  // Empty when the arm can go back without what it has lost, else why not.
  virtual std::string why_not_recover() const { return "this arm has no cables that it could go back without"; }
  // Whether it does so now: the core has cleared the fault for that.
  virtual bool recovers() const { return false; }
  // Cables that are lost, as this lianad has seen, and those that were called whole and have not taken tension since;
  // 0-based.
  virtual std::vector<std::size_t> lost() const { return {}; }
  // Somebody has looked at a cable that an earlier lianad has lost, and it is whole.
  virtual void call_whole(std::size_t /*cable*/) {}
  // What keeps an arm that is being enabled, beside its drives; empty: nothing.
  virtual std::string why_not_taut() const { return ""; }
  // A cable that was called whole and takes no tension: the arm is not to pull at the others any longer.
  virtual bool is_untrue() const { return false; }

  // Where the tip is commanded to be now.
  virtual const Pose& tip_command() const = 0;
  // Requests about motion that this arm knows; ask() throws RequestError.
  virtual bool knows(const std::string& op) const = 0;
  virtual Json ask(const MotionRequest& request) = 0;
  // Devices of operators (docs/reference/device-protocol.md), which only some arms have. hear_devices() reads what
  // their drivers have sent, at any time, with arm time; devices_fd() is readable when it has something to do, -1:
  // never.
  virtual int devices_fd() const { return -1; }
  virtual void hear_devices(std::int64_t) {}
  // Once per interval: their samples go to the steering; each of them is told the arm's state.
  virtual void take_samples() {}
  virtual void tell_devices(std::int64_t) {}
  // A picture of the tip camera, when every run has it.
  virtual void take_observation(const CameraObservation& picture) = 0;
  // Nothing is asked for any more: stop along the path.
  virtual void hold() = 0;
  // The same, and nobody steers any more.
  virtual void drop_motion() = 0;
  // What the arm is asked to do next, verified twice and, unless it is refused, released; nothing when nothing is asked
  // for, or `may_release` is false. `owner`: role number of who owns motion.
  virtual std::optional<LastVerdict> release_next(bool may_release, std::uint32_t owner) = 0;
  // What has become of paths, and of the way back, since the last call.
  virtual std::vector<arbiter::PathEvents> take_path_news() = 0;
  virtual std::vector<arbiter::RetractEvents> take_way_news() = 0;
  // The verified way back that an earlier lianad has left, before the first interval; and how it has changed since the
  // last call.
  virtual void restore_way(const arbiter::KeptWay& kept) = 0;
  virtual std::optional<arbiter::WayChange> take_way_change() = 0;
  virtual std::size_t joint_count() const = 0;

  // What this kind of arm has to say, once each.
  virtual std::vector<event::Event> take_events() { return {}; }

  // The arm's part of the state message (docs/reference/api.md) and of its entry about one drive.
  virtual void add_state(Json& state) const = 0;
  virtual std::size_t drive_count() const = 0;
  virtual void add_drive_state(std::size_t drive, Json& state) const = 0;
};

}  // namespace liana::server
