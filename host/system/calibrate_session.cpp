#include "host/system/calibrate_session.hpp"

#include <stdexcept>

#include "host/json/json.hpp"
#include "host/system/errors.hpp"
#include "host/system/observer.hpp"

namespace liana {
namespace {

constexpr double kBoot_s = 20.0;  // of arm time; it takes about 1.5 s
constexpr int kSilence_s = 30;
constexpr double kEndGrace_s = 5.0;
constexpr int kStates = 50;  // one each T_c: torque readings scatter by 0.3 %

void add(const Json& state, CalibrationReading& sum) {
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
    : plan_(plan), interrupts_(interrupts) {}

CalibrateSession::~CalibrateSession() {
  try {
    if (api_) api_->send({{"op", "shutdown"}});
  } catch (const std::runtime_error&) {  // lianad has left
  }
  api_.reset();
  for (auto child = children_.rbegin(); child != children_.rend(); ++child) (*child)->end(kEndGrace_s);
}

void CalibrateSession::start() {
  for (const ProgramCall& call : plan_.programs) {
    children_.push_back(std::make_unique<ChildProcess>(call.name, call.argv, plan_.file(call.name + ".log")));
    if (call.name == "liana-bench") continue;
    const std::string socket = call.name == "lianad" ? plan_.api_socket() : plan_.bus_socket();
    if (!wait_for_socket(socket, *children_.back(), interrupts_.any())) give_up(call.name + " did not open its socket");
  }
  api_ = ApiClient::connect(plan_.api_socket());
  api_->send(
      {{"op", "hello"}, {"name", "liana calibrate"}, {"role", "client"}, {"lockstep", true}, {"subscribe", {"state"}}});
}

void CalibrateSession::give_up(const std::string& why) {
  if (interrupts_.count() > 0) throw Interrupted("interrupted: nothing was calibrated");
  const auto worst = worst_end(children_, [](const ChildProcess&, const ChildEnd&) { return true; });
  if (worst && worst->end.code == kExitBadInput) throw BadInput(worst->text);
  throw std::runtime_error(worst ? worst->text : why);
}

Json CalibrateSession::next_state() {
  for (;;) {
    if (interrupts_.count() > 0) give_up("");
    std::optional<Json> message;
    try {
      for (int waited_s = 0; !message && waited_s < kSilence_s; ++waited_s) {
        message = api_->receive(1.0);
        if (!message && worst_end(children_, [](const ChildProcess&, const ChildEnd&) { return true; })) break;
      }
    } catch (const std::runtime_error& error) {
      for (const auto& child : children_) child->wait(0.5);  // whoever ended first pulled lianad along
      give_up(error.what());
    }
    if (!message) give_up("lianad says nothing");
    if (message->value("op", "") == "state") return *message;
    if (message->value("op", "") == "error") give_up("lianad: " + message->value("message", ""));
  }
}

CalibrationReading CalibrateSession::read() {
  start();
  CalibrationReading sum;
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
    api_->send({{"op", "done"}, {"tick", state.at("tick")}});
  }
  return sum;
}

}  // namespace liana
