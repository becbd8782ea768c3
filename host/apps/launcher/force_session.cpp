#include "host/apps/launcher/force_session.hpp"

#include <cmath>
#include <optional>

#include "host/apps/launcher/force_times.hpp"

namespace liana::launcher {
namespace {

using report::ForceMoment;

std::array<std::optional<double>, 3> told(const Json& contact) {
  std::array<std::optional<double>, 3> out;
  for (std::size_t i = 0; i < out.size(); ++i)
    if (contact.at("force_N")[i].is_number()) out[i] = contact.at("force_N")[i].get<double>();
  return out;
}

double size_of(const std::array<std::optional<double>, 3>& told_N) {
  double square = 0.0;
  for (const auto& axis : told_N) square += axis ? *axis * *axis : 0.0;
  return std::sqrt(square);
}

// One push after the other, by the clock of the arm.
class Trial {
 public:
  Trial(LockstepSession& session, const ForcePlan& plan, const config::RobotConfig& robot, report::ForceReadings& all)
      : session_(session), plan_(plan), robot_(robot), all_(all) {}

  void run() {
    session_.enable();
    for (const PlannedPush& push : plan_.pushes) {
      if (!run(push)) return;
      begin_s_ += kBlock_s;
    }
  }

 private:
  // False when a fault has ended it.
  bool run(const PlannedPush& push) {
    push_ = &push;
    next_ = 0;
    rest_ = {ForceMoment::kStill, norm(push.force_N), std::nullopt};
    move_ = {ForceMoment::kMoving, norm(push.force_N), std::nullopt};
    bool tensions_valid = true;
    // A fault ends the trial, but not the push: the arm holds, feels on, and may find what pushes it.
    while (now_s_ < begin_s_ + kBlock_s && (tensions_valid || (push.link == 0 && pushed_N() > 0.0))) {
      const Json state = session_.next_state(false);  // a dither may be refused where a push has loosened a cable
      now_s_ = state.at("time_s").get<double>();
      tensions_valid ? look(state) : look_for_push(told(state.at("contact")), now_s_ - begin_s_);
      if (tensions_valid && !state.at("faults").empty())
        all_.faults.push_back({state.at("faults")[0].at("number").get<int>(), pushed_N()});
      tensions_valid = tensions_valid && state.at("faults").empty() && state.at("state") == "ENABLED";
      if (tensions_valid) act();
      session_.done(state);
    }
    if (push.link != 0) {
      all_.body.push_back({segment_of(push.link), is_felt_, named_});
      return tensions_valid;
    }
    const double passed_s = now_s_ - begin_s_;
    if (passed_s > kAtRest.begin_s + kRise_s) all_.found.push_back(rest_);
    if (passed_s > kOnTheMove.begin_s + kRise_s) all_.found.push_back(move_);
    return tensions_valid;
  }

  void act() {
    const double passed_s = now_s_ - begin_s_;
    constexpr double kWhen_s[] = {kGo_s, kDither_s, kMove_s};
    if (next_ >= std::size(kWhen_s) || passed_s < kWhen_s[next_]) return;
    if (next_ == 1) {
      session_.send({{"op", "dither"}});
    } else {
      session_.send({{"op", "move_jp"}, {"goal_deg", next_ == 0 ? push_->rest_deg : push_->move_deg}});
    }
    ++next_;
  }

  void look(const Json& state) {
    const double passed_s = now_s_ - begin_s_;
    const Json& contact = state.at("contact");
    if (push_->link != 0) {
      is_felt_ = is_felt_ || contact.at("on_body").get<bool>();
      if (contact.at("segment").get<int>() > 0) named_ = contact.at("segment").get<std::int32_t>();
    }
    const auto told_N = told(contact);
    if (is_free(passed_s)) {
      const bool moves = contact.at("state") == "moving";
      if (now_s_ > kFirstBlock_s) (moves ? all_.free_moving_N : all_.free_resting_N).push_back(size_of(told_N));
      return;
    }
    if (push_->link != 0) return;
    look_for_push(told_N, passed_s);
    read_at(kReadStill_s, passed_s, ForceMoment::kStill, contact);
    read_at(kReadDithered_s, passed_s, ForceMoment::kDithered, contact);
    read_at(kReadMoving_s, passed_s, ForceMoment::kMoving, contact);
    before_s_ = passed_s;
  }

  static bool is_free(double passed_s) {
    for (const PushTimes& times : {kAtRest, kOnTheMove})
      if (passed_s >= times.begin_s && passed_s < times.end_s + kFading_s) return false;
    return true;
  }

  void look_for_push(const std::array<std::optional<double>, 3>& told_N, double passed_s) {
    note_found(told_N, passed_s, kAtRest, rest_);
    note_found(told_N, passed_s, kOnTheMove, move_);
  }

  void note_found(const std::array<std::optional<double>, 3>& told_N, double passed_s, const PushTimes& times,
                  report::ForceFound& found) const {
    const bool lasts = passed_s >= times.begin_s && passed_s < times.end_s;
    if (lasts && !found.after_s && size_of(told_N) >= report::kForceFound_N) found.after_s = passed_s - times.begin_s;
  }

  void read_at(double when_s, double passed_s, ForceMoment moment, const Json& contact) {
    if (!(before_s_ < when_s && passed_s >= when_s)) return;
    if (moment == ForceMoment::kDithered && contact.at("state") != "dithered") return;
    report::ForceReading reading{moment, plan_.number, push_->force_N, told(contact), {}};
    for (std::size_t i = 0; i < 3; ++i) reading.sd_N[i] = contact.at("sd_N")[i].get<double>();
    all_.readings.push_back(reading);
  }

  double pushed_N() const {
    const double passed_s = now_s_ - begin_s_;
    for (const PushTimes& times : {kAtRest, kOnTheMove})
      if (passed_s >= times.begin_s && passed_s < times.end_s)
        return norm(push_->force_N) * std::fmin(1.0, (passed_s - times.begin_s) / kRise_s);
    return 0.0;
  }

  std::int32_t segment_of(std::int32_t link) const {
    std::int32_t segment = 1;
    for (; link > robot_.table.segment[static_cast<std::size_t>(segment - 1)].modules; ++segment)
      link -= robot_.table.segment[static_cast<std::size_t>(segment - 1)].modules;
    return segment;
  }

  LockstepSession& session_;
  const ForcePlan& plan_;
  const config::RobotConfig& robot_;
  report::ForceReadings& all_;
  const PlannedPush* push_ = nullptr;
  double begin_s_ = kFirstBlock_s, now_s_ = 0.0, before_s_ = 0.0;
  std::size_t next_ = 0;
  report::ForceFound rest_, move_;
  bool is_felt_ = false;
  std::int32_t named_ = 0;
};

}  // namespace

void feel_forces(LockstepSession& session, const ForcePlan& plan, const config::RobotConfig& robot,
                 report::ForceReadings& all) {
  Trial(session, plan, robot, all).run();
}

}  // namespace liana::launcher
