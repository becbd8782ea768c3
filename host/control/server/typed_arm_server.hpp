// What the desks of all kinds of arm have in common: the link, verification, and requests about plain motion.
#pragma once

#include <algorithm>
#include <map>
#include <memory>
#include <vector>

#include "firmware_like/math/trig.hpp"
#include "host/api/server/request_error.hpp"
#include "host/base/clock/time_mode.hpp"
#include "host/base/json/json.hpp"
#include "host/control/server/arm_server.hpp"
#include "host/control/server/path_message.hpp"
#include "host/control/server/servo_message.hpp"
#include "host/control/verification/issue_step.hpp"
#include "host/control/verification/model_watch.hpp"
#include "host/control/verification/refusal_table.hpp"
#include "host/control/verification/simulation_verifier.hpp"
#include "host/control/verification/verify.hpp"
#include "host/storage/recording/tick_packet.hpp"
#include "host/storage/recording/visit.hpp"

namespace liana::server {

// `Steering` is the arm's arbiter.
template <class Arm, class Steering>
class TypedArmServer : public ArmServer {
 public:
  realtime::Link& link() override { return link_; }
  bool interval_began() const override { return link_.image.has_new(); }
  void refresh() override {
    link_.report.refresh();
    link_.image.refresh();
  }
  void refresh_report() override { link_.report.refresh(); }
  const realtime::ArmTickStatus<Arm>& report() const override { return link_.report.value(); }
  const liana::Inputs<Arm>& inputs() const override { return report().inputs; }
  const liana::Outputs<Arm>& outputs() const override { return report().outputs; }
  const SupervisorState& supervisor() const override { return link_.image.value().controller.supervisor(); }
  void take_ticks(std::uint64_t dropped, const TickSink& sink) override;
  std::uint64_t image_tick() const override { return link_.image.value().next_tick; }
  std::string image_packet() const override;

  const Pose& tip_command() const override { return outputs().tip_command; }
  bool knows(const std::string& op) const override { return handlers_.count(op) > 0; }
  Json ask(const MotionRequest& request) override;
  void hold() override { arbiter_.hold(); }
  void take_observation(const CameraObservation& picture) override;
  std::optional<LastVerdict> release_next(bool may_release, std::uint32_t owner) override;
  std::vector<arbiter::PathEvents> take_path_news() override { return arbiter_.take_path_news(); }
  std::vector<arbiter::RetractEvents> take_way_news() override;
  void restore_way(const arbiter::KeptWay& kept) override;
  std::optional<arbiter::WayChange> take_way_change() override;
  std::size_t joint_count() const override { return arbiter::ArmTraits<Arm>::joint_count(table_); }
  std::size_t drive_count() const override { return static_cast<std::size_t>(table_.drive_count()); }

 protected:
  using Table = typename Arm::Table;
  using Handler = std::function<void(const MotionRequest&)>;

  // The arbiter is made of the table, the zone and what else it needs.
  template <class... Args>
  TypedArmServer(const Table& table, const arbiter::SpeedZone& zone, timing::TimeMode time_mode,
                 realtime::ArmMailbox<Arm>& link, std::unique_ptr<verification::SimulationVerifier<Arm>> simulation,
                 const Args&... args)
      : table_(table),
        link_(link),
        arbiter_(table, zone, args...),
        zone_(zone),
        simulation_(std::move(simulation)),
        time_mode_(time_mode) {
    handlers_ = {{"move_jp", [this](const MotionRequest& r) { move_joints(r.fields); }},
                 {"move_path", [this](const auto& r) { arbiter_.move_path(outputs(), path_request<Arm>(r.fields)); }},
                 {"move_cp",
                  [this](const auto& r) { arbiter_.move_line(outputs(), r.fields.pose("goal"), swings_of(r.fields)); }},
                 {"servo_cp", [this](const auto& r) { arbiter_.servo_tip(outputs(), r.fields.pose("goal")); }},
                 {"servo_target", [this](const auto& r) { arbiter_.servo_target(outputs(), servo_request(r.fields)); }},
                 {"retract", [this](const MotionRequest& r) { retract(r.fields); }},
                 {"hold", [this](const MotionRequest&) { hold(); }}};
  }

  static arbiter::SearchResult taken(timing::TimeMode time_mode) {
    return time_mode == timing::TimeMode::kReal ? arbiter::SearchResult::kWhenThere
                                                : arbiter::SearchResult::kInItsInterval;
  }

  std::uint64_t tick() const { return report().next_tick; }
  // The angles of the twin at the end of a candidate's interval, in degrees.
  virtual std::vector<double> joints_deg(const liana::Outputs<Arm>& outputs) const = 0;

  Table table_;
  realtime::ArmMailbox<Arm>& link_;
  Steering arbiter_;
  arbiter::SpeedZone zone_;
  std::map<std::string, Handler> handlers_;  // by op
  std::unique_ptr<verification::SimulationVerifier<Arm>> simulation_;

 private:
  using Command = liana::Telecommand<typename Arm::Setpoint>;

  void move_joints(const api::Arguments& fields);
  void retract(const api::Arguments& fields);
  LastVerdict verify_and_release(const typename Arm::Setpoint& setpoint, std::uint32_t owner);
  LastVerdict verified(const verification::Candidate<Arm>& candidate);
  verification::StopSwings stop_swings(const LastVerdict& refused);

  double patience_s(std::uint64_t first_tick) const;

  timing::TimeMode time_mode_;
  verification::IssueStep<Arm> release_;
  std::vector<Command> released_;             // not yet due at the newest image
  verification::Prediction<Arm> prediction_;  // of the last command
  verification::Prediction<Arm> stop_;        // of no command in its place
};

template <class Arm, class Steering>
void TypedArmServer<Arm, Steering>::take_ticks(std::uint64_t dropped, const TickSink& sink) {
  const std::uint64_t lost = report().records_lost + dropped;
  while (const recording::TickRecord<Arm>* record = link_.ticks.front()) {
    sink(record->inputs, [&] { return recording::tick_packet(*record, lost, recording::counts_of(table_)); });
    link_.ticks.pop();
  }
}

template <class Arm, class Steering>
std::string TypedArmServer<Arm, Steering>::image_packet() const {
  const verification::TwinSnapshot<Arm>& image = link_.image.value();
  return image.fresh ? liana::recording::image_packet<Arm>(image.next_tick, table_)
                     : liana::recording::image_packet(image.next_tick, image.controller);
}

template <class Arm, class Steering>
Json TypedArmServer<Arm, Steering>::ask(const MotionRequest& request) {
  handlers_.at(request.op)(request);
  return Json::object();
}

template <class Arm, class Steering>
void TypedArmServer<Arm, Steering>::move_joints(const api::Arguments& fields) {
  const std::vector<double> goal_deg = fields.numbers("goal_deg");
  arbiter::Joints<Arm> goal_rad{};
  for (std::size_t i = 0; i < goal_deg.size(); ++i) goal_rad[i] = goal_deg[i] * kDegree;
  arbiter_.move_joints(outputs(), goal_rad, fields.number("rate_deg_s") * kDegree, swings_of(fields));
}

template <class Arm, class Steering>
void TypedArmServer<Arm, Steering>::retract(const api::Arguments& fields) {
  arbiter_.retract(outputs(), static_cast<std::uint64_t>(fields.integer("until_tick")));
}

template <class Arm, class Steering>
std::vector<arbiter::RetractEvents> TypedArmServer<Arm, Steering>::take_way_news() {
  std::vector<arbiter::RetractEvents> news = arbiter_.take_way_news();
  for (const arbiter::RetractEvents& one : news)
    if (one.what == event::RetractEvent::kLost) simulation_->led_astray();
  return news;
}

template <class Arm, class Steering>
void TypedArmServer<Arm, Steering>::take_observation(const CameraObservation& picture) {
  const auto show = [&](const std::string& name, const std::optional<Pose>& in_tip) {
    if (in_tip) arbiter_.see_target(name, picture.capture_time_s, *in_tip);
  };
  show("slit", picture.slit_in_tip);
  show("rod", picture.rod_in_tip);
  show(picture.target_name, picture.target_in_tip);
}

template <class Arm, class Steering>
void TypedArmServer<Arm, Steering>::restore_way(const arbiter::KeptWay& kept) {
  std::vector<arbiter::PathPoint<arbiter::Joints<Arm>>> points(kept.points.size());
  for (std::size_t k = 0; k < points.size(); ++k) {
    const arbiter::WayPoint& point = kept.points[k];
    std::copy(point.joint_rad.begin(), point.joint_rad.end(), points[k].joint_rad.begin());
    points[k].begins = point.begins;
  }
  arbiter_.path_history().restore(kept.first, points);
}

template <class Arm, class Steering>
std::optional<arbiter::WayChange> TypedArmServer<Arm, Steering>::take_way_change() {
  if (!arbiter_.path_history().has_change()) return std::nullopt;
  const auto change = arbiter_.path_history().take_change();
  arbiter::WayChange out{change.first, change.kept, {}};
  const auto joints = static_cast<std::ptrdiff_t>(joint_count());
  for (const auto& point : change.added)
    out.added.push_back({point.begins, {point.joint_rad.begin(), point.joint_rad.begin() + joints}});
  return out;
}

// While a stop is on its way to the next tick, the arm is given nothing else.
template <class Arm, class Steering>
std::optional<LastVerdict> TypedArmServer<Arm, Steering>::release_next(bool may_release, std::uint32_t owner) {
  const auto setpoint = arbiter_.next_setpoint(tick(), outputs());
  simulation_->watch(link_.image.value());
  const std::uint64_t next_tick = link_.image.value().next_tick;
  std::erase_if(released_, [next_tick](const Command& t) { return t.first_tick() < next_tick; });
  if (!setpoint || !may_release || link_.stop.is_pressed()) return std::nullopt;
  return verify_and_release(*setpoint, owner);
}

// In virtual time the service waits for the simulation, so that runs repeat bit for bit; in real time until the arm
// would need the command.
template <class Arm, class Steering>
double TypedArmServer<Arm, Steering>::patience_s(std::uint64_t first_tick) const {
  if (time_mode_ != timing::TimeMode::kReal) return verification::kWhenever;
  const std::uint64_t now = tick();
  return now < first_tick ? static_cast<double>(first_tick - now) * table_.tick_s : 0.0;
}

// What is refused for how the arm swings may pass beside its stop, and what a hand asks for more slowly: at last by
// stopping, where nothing speaks against the stop itself. The refusal that is told is the first.
template <class Arm, class Steering>
LastVerdict TypedArmServer<Arm, Steering>::verify_and_release(const typename Arm::Setpoint& setpoint,
                                                              std::uint32_t owner) {
  const auto interval = static_cast<std::uint64_t>(table_.interval_ticks);
  const auto candidate = release_.candidate(setpoint, owner, link_.image.value().next_tick + interval, interval);
  LastVerdict asked = verified(candidate);
  LastVerdict last = asked;
  using verification::StopSwings;
  StopSwings stop = verification::is_of_swing(last.worst.code) ? stop_swings(last) : StopSwings::kUnknown;
  if (stop != StopSwings::kUnknown) last = verified(release_.another(setpoint, candidate));
  while (!last.released && verification::is_of_motion(last.worst.code)) {
    const auto slower = arbiter_.slower(outputs(), verification::row_of(last.worst.code).name);
    if (!slower) break;
    last = verified(release_.another(*slower, candidate));
  }
  if (last.released) return last;
  if (arbiter_.leads_hand() && verification::is_of_motion(last.worst.code)) {
    const bool stands = arbiter_.stands_refused();
    if (!stands && stop == StopSwings::kUnknown) stop = stop_swings(last);
    asked.is_news = !stands && stop != StopSwings::kPasses;
  }
  const bool collides = verification::row_of(asked.worst.code).action == verification::RefusalAction::kStop;
  if (collides && !asked.leads_back && stop == StopSwings::kUnknown) stop = stop_swings(last);
  asked.goes_on = arbiter_.refused(asked.worst.text, verification::may_pass_slower(asked.worst.code));
  // The way back tries again, and so does a hand, which the arm waits for.
  asked.stops = collides && stop == StopSwings::kTouches && !asked.leads_back && !asked.goes_on;
  return asked;
}

// Of what becomes of the arm when this stays refused.
template <class Arm, class Steering>
verification::StopSwings TypedArmServer<Arm, Steering>::stop_swings(const LastVerdict& refused) {
  const verification::TwinSnapshot<Arm>& image = link_.image.value();
  const std::uint64_t first_tick = refused.first_tick;
  verification::Twin<Arm>::stop(image, released_, first_tick, verification::max_stop_ticks(table_.tick_s), stop_);
  return simulation_->look_at_stop(image, first_tick, stop_, patience_s(first_tick));
}

template <class Arm, class Steering>
LastVerdict TypedArmServer<Arm, Steering>::verified(const verification::Candidate<Arm>& candidate) {
  const verification::TwinSnapshot<Arm>& image = link_.image.value();
  verification::Twin<Arm>::run(image, released_, candidate, verification::max_stop_ticks(table_.tick_s), prediction_);
  const bool leads_back = arbiter_.is_going_back();
  simulation_->begin(image, candidate, prediction_, leads_back);
  verification::ExecutionVerdict execution = verification::judge_execution<Arm>(table_, candidate, prediction_, zone_);
  const verification::SimulationVerdict simulation = simulation_->verdict(patience_s(candidate.first_tick()));
  verification::judge_model(table_, image.last_outputs, prediction_.ticks.back(), leads_back, execution);
  if (time_mode_ == timing::TimeMode::kReal) {
    link_.report.refresh();
    verification::judge_time(candidate.first_tick(), tick(), execution);
  }
  const std::optional<Command> telecommand = release_.release(candidate, execution, simulation);
  const bool released = telecommand && link_.released.push(*telecommand);
  verification::Verdict worst = execution.passed() ? static_cast<const verification::Verdict&>(simulation) : execution;
  worst.margins = simulation.margins;
  worst.slowly = simulation.slowly;
  if (released) released_.push_back(*telecommand);
  return {candidate.sequence(),
          released,
          released,
          worst,
          joints_deg(prediction_.ticks[prediction_.command_ticks - 1]),
          joints_deg(prediction_.ticks.back()),
          candidate.setpoint().kind,
          candidate.first_tick(),
          leads_back,
          execution,
          simulation};
}

}  // namespace liana::server
