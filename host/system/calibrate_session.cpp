#include "host/system/calibrate_session.hpp"

#include <cstdio>
#include <stdexcept>

#include "host/json/json.hpp"
#include "host/system/errors.hpp"
#include "host/system/observer.hpp"

namespace liana::system {
namespace {

constexpr double kBoot_s = 20.0;  // of arm time; it takes about 1.5 s
constexpr int kSilence_s = 30;
constexpr double kEndGrace_s = 5.0;
constexpr double kAftermath_s = 0.5;  // between the end of one program and the ends of those that need it
constexpr int kStates = 50;           // one each T_c: torque readings scatter by 0.3 %

void add(const Json& state, calibration::CalibrationReading& sum) {
  std::size_t i = 0;
  for (const Json& drive : state.at("drives")) {
    sum.position_m[i] += drive.at("position_m").get<double>() / kStates;
    sum.tension_N[i] += drive.at("tension_N").get<double>() / kStates;
    sum.serial[i] = drive.at("serial").get<std::uint32_t>();
    ++i;
  }
}

}  // namespace

CalibrateSession::CalibrateSession(const SystemLayout& plan, const InterruptGuard& interrupts)
    : interrupts_(interrupts), system_(plan) {}

CalibrateSession::~CalibrateSession() { system_.end(kEndGrace_s); }

void CalibrateSession::start() {
  const Json hello{
      {"op", "hello"}, {"name", "liana calibrate"}, {"role", "client"}, {"lockstep", true}, {"subscribe", {"state"}}};
  const std::string problem = system_.start(hello, interrupts_.any());
  if (!problem.empty()) give_up(problem);
}

void CalibrateSession::give_up(const std::string& why, double settle_s) {
  if (interrupts_.count() > 0) throw Interrupted("interrupted: nothing was calibrated");
  const auto worst = system_.worst_end([](const ChildProcess&, const ChildEnd&) { return true; }, settle_s);
  if (worst && worst->end.code == kExitBadInput) throw BadInput(worst->text);
  throw std::runtime_error(worst ? worst->text : why);
}

Json CalibrateSession::next_state() {
  for (;;) {
    if (interrupts_.count() > 0) give_up("");
    std::optional<Json> message;
    for (int waited_s = 0; !message && waited_s < kSilence_s; ++waited_s) {
      message = system_.receive(1.0);
      if (!message && (!system_.is_connected() || system_.any_has_ended())) give_up("lianad has left", kAftermath_s);
      if (const auto silence = watch_.silence(system_)) std::fprintf(stderr, "liana: %s\n", silence->c_str());
    }
    if (!message) give_up("lianad has said nothing for " + std::to_string(kSilence_s) + " s");
    watch_.heard();
    if (message->value("op", "") == "state") return *message;
    if (message->value("op", "") == "error") give_up("lianad: " + message->value("message", ""));
  }
}

calibration::CalibrationReading CalibrateSession::read() {
  start();
  calibration::CalibrationReading sum;
  for (int taken = 0; taken < kStates;) {
    const Json state = next_state();
    const std::string name = state.value("state", "");
    if (name == "FAULT" || state.value("time_s", 0.0) > kBoot_s) {
      const Json faults = state.value("faults", Json::array());
      give_up("the drives did not boot: " + (faults.empty() ? "state " + name : faults[0].value("text", "")));
    }
    if (name == "DISABLED") {
      add(state, sum);
      ++taken;
    }
    system_.send({{"op", "done"}, {"tick", state.at("tick")}});
  }
  return sum;
}

}  // namespace liana::system
