// The service side of lianad: once per command interval it hears the clients, decides what to ask for, verifies and
// releases it.
#pragma once

#include <cstdint>
#include <deque>
#include <functional>
#include <map>
#include <optional>
#include <string>
#include <vector>

#include "host/api/server/server.hpp"
#include "host/base/clock/time_mode.hpp"
#include "host/base/event/event_file.hpp"
#include "host/base/event/event_log.hpp"
#include "host/base/event/line_file.hpp"
#include "host/base/json/json.hpp"
#include "host/control/server/arm_server.hpp"
#include "host/control/server/command_log.hpp"
#include "host/control/server/host_warning.hpp"
#include "host/control/server/loss_file.hpp"
#include "host/control/server/owner.hpp"
#include "host/control/server/retract_path_file.hpp"
#include "host/control/server/run_lifecycle.hpp"
#include "host/control/server/service_events.hpp"
#include "host/control/server/setpoint_stream.hpp"
#include "host/control/server/state_message.hpp"
#include "host/control/server/tick_watch.hpp"
#include "host/model/config/config.hpp"

namespace liana::server {

// What the service needs to know about the run.
struct ServiceConfig {
  std::string api_path;
  std::optional<gid_t> api_group;  // whose members may use the API, beside the user that lianad runs as
  timing::TimeMode time_mode = timing::TimeMode::kFast;
  std::string robot_json, scene_json;  // canonical
  config::BusesConfig buses;
  config::DriveNames drive_names;
  double camera_latency_s = 0.0;
  std::string events_file;                                            // path; empty: events are not written
  std::string commands_file;                                          // path; empty: commands are not logged
  std::string calibration;                                            // text of its file; empty: none
  std::string way_file;                                               // path; empty: the way back is kept nowhere
  std::string verify_times_file;                                      // path; empty: nobody asks how long commands take
  bool ends_with_mission = false;                                     // stop the arm once the mission has come and gone
  std::function<std::vector<std::string>()> unwatched;                // asked when booting is done: what nobody watches
  std::function<std::vector<realtime::BootProblem>()> boot_problems;  // asked once, when booting has failed
  std::function<std::vector<std::uint32_t>()> serials;                // of the drives; asked once, when they are booted
};

class Service : private api::ApiHandler {
 public:
  // Listens at config.api_path; throws std::runtime_error, also about the files that config names. `desk` must
  // outlive this.
  Service(const ServiceConfig& config, ArmServer& desk);

  // Waits until a client of every named role has said hello, or `stop` returns true: then it returns false. Throws
  // std::runtime_error naming those missing after `timeout_s`.
  bool wait_for(
      const std::vector<api::Role>& roles, double timeout_s, const std::function<bool()>& stop = [] { return false; });
  // One command interval. Lockstep time: returns after every lockstep client has answered.
  void cycle();
  // A new command interval has begun since the last cycle().
  bool interval_began() const { return desk_.interval_began(); }
  // Between intervals, real time only: moves packets and acts on requests at once, waiting up to `timeout_s`.
  void idle(double timeout_s);
  // Stops the arm (stop category stop); finished() becomes true when drives are off, or after 10 s of arm time.
  void begin_shutdown(const std::string& reason);
  bool finished() const { return lifecycle_.is_over(tick(), now()); }
  // An emergency stop by lianad, told to all clients at once; for failures after which no cycle may follow.
  void stop_by_itself(const std::string& reason);
  // There will be no further cycle().
  void end_lockstep() { server_.end_lockstep(); }
  // Gives slow readers a moment to take what was said last; for the end.
  void flush_and_close() { server_.deliver(1.0); }
  // Somebody has asked for the end; otherwise clients may still want to read the last state.
  bool dismissed() const { return lifecycle_.was_asked_to_end(); }

 private:
  using Handler = Json (Service::*)(const api::ClientInfo&, const api::Arguments&);

  Json welcome(const api::ClientInfo& client) override;
  Json handle(const api::ClientInfo& client, const Json& request) override;
  void gone(const api::ClientInfo& client, const std::string& why) override;
  Json act_on(const api::ClientInfo& client, const Json& request);
  Json answer_to(const api::RequestRow& row, const api::ClientInfo& client, const api::Arguments& fields);
  static const std::map<std::string, Handler>& handlers();

  Json on_acquire(const api::ClientInfo& client, const api::Arguments& fields);
  Json on_release(const api::ClientInfo& client, const api::Arguments& fields);
  Json on_state_command(const api::ClientInfo& client, const api::Arguments& fields);
  Json on_tool(const api::ClientInfo& client, const api::Arguments& fields);
  Json on_stop(const api::ClientInfo& client, const api::Arguments& fields);
  Json on_shutdown(const api::ClientInfo& client, const api::Arguments& fields);
  Json on_announce(const api::ClientInfo& client, const api::Arguments& fields);
  Json on_mission_control(const api::ClientInfo& client, const api::Arguments& fields);
  Json on_archive_alarm(const api::ClientInfo& client, const api::Arguments& fields);
  Json on_operator_says(const api::ClientInfo& client, const api::Arguments& fields);
  Json on_camera(const api::ClientInfo& client, const api::Arguments& fields);
  Json on_tool_report(const api::ClientInfo& client, const api::Arguments& fields);
  Json on_timing(const api::ClientInfo& client, const api::Arguments& fields);

  void require_homed() const;
  const CycleOutputs& now() const { return desk_.outputs(); }
  std::uint64_t tick() const { return desk_.report().next_tick; }
  double time_s() const { return static_cast<double>(tick()) * config_.buses.tick_s(); }
  std::int64_t arm_time_us();
  std::uint64_t ticks_in(double time_s) const;
  bool note(event::Event event);  // as EventLog::add
  void note(std::vector<event::Event> events);
  void request(Request what);
  void press_stop() noexcept;
  void order_stop(const StopOrder& order);
  void drop_motion(event::Event why);
  std::string why_taken(const TakeOver& how) const;
  void watch_events_file();
  void watch_arm();
  void watch_homing();
  void watch_enabling();
  void watch_stream();
  void note_clear();
  void note_emergencies(const CycleInputs& inputs);
  void forward_ticks();
  void forward_camera();
  void watch_tool();
  void require_past(const char* field, double said_s) const;
  std::uint64_t certainly_heard_tick(double said_s) const;
  void publish_state();
  void release_next();
  std::optional<LastVerdict> timed_release();
  void tell_of_paths();
  void keep_way();
  void keep_losses();
  std::string why_remembered() const;
  bool remembers(std::int64_t cable) const;
  void recall(std::size_t cable);

  ServiceConfig config_;
  ArmServer& desk_;
  api::RequestBounds bounds_;
  Owner owner_;
  SetpointStream stream_;
  std::optional<std::uint64_t> homing_due_tick_;  // when an arm that is not homed says why
  Notes notes_;
  HostWarning trouble_;
  FaultMonitor faults_;
  event::EventLog log_;
  std::optional<event::EventFile> file_;
  std::optional<CommandLog> dispatch_;
  std::optional<RetractPathFile> way_file_;
  std::optional<LossFile> losses_;
  std::vector<std::size_t> remembered_;  // that an earlier lianad has lost, as far as nobody has called them whole
  std::vector<std::size_t> recalled_;    // cables of these that were called whole, until the arm has been enabled
  bool loss_told_ = false;               // what an earlier one has left
  std::uint64_t next_loss_tick_ = 0;     // when the file is tried again; 0: it has taken all
  std::optional<event::LineFile> verify_times_;
  realtime::BootPhase boot_seen_ = realtime::BootPhase::kBooting;
  bool homed_told_ = false;
  bool image_sent_ = false;
  std::string published_;  // operating state of the last state message
  struct CameraFrame {
    std::uint64_t due_tick;
    std::string packet;
    CameraObservation picture;
  };
  std::deque<CameraFrame> camera_;
  std::uint64_t clear_seen_tick_ = 0;
  TickWatch tick_watch_;
  std::optional<std::int64_t> clock_ahead_us_;  // of arm time, real time only
  realtime::Overruns overruns_before_;          // at the last reset of the timing
  RunLifecycle lifecycle_;
  std::optional<std::uint64_t> enabling_since_;
  bool takes_back_ = false;  // a cable was called whole and is not: it counts as lost again, once the arm is disabled
  std::optional<std::uint64_t> stop_tick_;     // of the last stop, whoever asked for it
  std::optional<std::uint64_t> disable_tick_;  // of the last disable that was asked for
  int mission_asked_ = 0;                      // how often somebody has told the mission something
  api::ApiServer server_;                      // last: its destructor may call gone()
};

}  // namespace liana::server
