#include "host/apps/launcher/calibrate_session.hpp"

#include "host/base/json/json.hpp"

namespace liana::launcher {
namespace {

constexpr double kBoot_s = 20.0;  // of arm time; it takes about 1.5 s
constexpr int kStates = 50;       // one each T_c: torque readings scatter by 0.3 %

void add(const Json& state, calibration::CalibrationReading& sum) {
  std::size_t i = 0;
  for (const Json& drive : state.at("drives")) {
    sum.position_m[i] += drive.at("position_m").get<double>() / kStates;
    sum.tension_N[i] += drive.value("tension_N", 0.0) / kStates;  // none: a base that feeds
    sum.serial[i] = drive.at("serial").get<std::uint32_t>();
    ++i;
  }
}

}  // namespace

CalibrateSession::CalibrateSession(const SystemLayout& plan, const InterruptGuard& interrupts)
    : session_(plan, interrupts, "liana calibrate", "nothing was calibrated") {}

calibration::CalibrationReading CalibrateSession::read() {
  session_.start();
  calibration::CalibrationReading sum;
  for (int taken = 0; taken < kStates;) {
    const Json state = session_.next_state();
    const std::string name = state.value("state", "");
    if (name == "FAULT" || state.value("time_s", 0.0) > kBoot_s) {
      const Json faults = state.value("faults", Json::array());
      session_.give_up("the drives did not boot: " + (faults.empty() ? "state " + name : faults[0].value("text", "")));
    }
    if (name == "DISABLED") {
      add(state, sum);
      ++taken;
    }
    session_.done(state);
  }
  return sum;
}

void CalibrateSession::disable() {
  session_.ask_and_wait({{"op", "state_command"}, {"command", "disable"}},
                        [](const Json& s) { return s.value("state", "") == "DISABLED"; });
}

}  // namespace liana::launcher
