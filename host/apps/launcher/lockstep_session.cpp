#include "host/apps/launcher/lockstep_session.hpp"

#include <cstdio>
#include <stdexcept>
#include <utility>

#include "host/apps/launcher/errors.hpp"
#include "host/apps/launcher/observer.hpp"
#include "host/base/event/fault_groups.hpp"

namespace liana::launcher {
namespace {

constexpr int kSilence_s = 30;
constexpr double kLockstepEndGrace_s = 5.0;
constexpr double kRequestPatience_s = 60.0;  // of arm time in which nothing comes of a request
constexpr double kLongestMotion_s = 3600.0;  // of arm time: slow arms take minutes

bool is_in(const Json& state, const char* wanted) { return state.value("state", "") == wanted; }

}  // namespace

LockstepSession::LockstepSession(const SystemLayout& plan, const InterruptGuard& interrupts, std::string name,
                                 std::string undone)
    : interrupts_(interrupts), name_(std::move(name)), undone_(std::move(undone)), system_(plan) {}

LockstepSession::~LockstepSession() { system_.end(kLockstepEndGrace_s); }

void LockstepSession::start() {
  const Json hello{{"op", "hello"}, {"name", name_}, {"role", "client"}, {"lockstep", true}, {"subscribe", {"state"}}};
  const std::string problem = system_.start(hello, interrupts_.any());
  if (!problem.empty()) give_up(problem);
}

void LockstepSession::give_up(const std::string& why, double settle_s) {
  if (interrupts_.count() > 0) throw Interrupted("interrupted: " + undone_);
  const auto worst = system_.worst_end([](const ChildProcess&, const ExitStatus&) { return true; }, settle_s);
  if (worst && worst->end.code == kExitBadInput) throw BadInput(worst->text);
  throw std::runtime_error(worst ? worst->text : why);
}

Json LockstepSession::next_state(bool refusals_count) {
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
    if (refusals_count && message->value("op", "") == "error") give_up("lianad: " + message->value("message", ""));
  }
}

Json LockstepSession::ask_and_wait(const Json& request, const std::function<bool(const Json&)>& is_done,
                                   const std::function<void(const Json&)>& look) {
  bool asked = !request.contains("op");
  double idle_since_s = -1.0;
  for (double since_s = -1.0;;) {
    const Json state = next_state();
    const double now_s = state.value("time_s", 0.0);
    if (since_s < 0.0) since_s = now_s;
    if (idle_since_s < 0.0 || state.value("is_busy", false)) idle_since_s = now_s;
    const Json faults = state.value("faults", Json::array());
    if (!faults.empty())
      give_up("fault " + event::fault_groups(faults).front().alarm() + ": " + faults[0].value("text", ""));
    if (now_s - idle_since_s > kRequestPatience_s || now_s - since_s > kLongestMotion_s)
      give_up("the arm did not answer " + request.dump());
    if (look) look(state);
    // A state that was on its way when the request was sent says nothing of it.
    const bool is_over = asked && now_s - since_s > 0.1 && is_done(state);
    if (!asked) send(request);
    asked = true;
    done(state);
    if (is_over) return state;
  }
}

Json LockstepSession::enable() {
  start();
  ask_and_wait(Json::object(), [](const Json& s) { return is_in(s, "DISABLED") && s.value("is_homed", false); });
  ask_and_wait({{"op", "acquire"}}, [this](const Json& s) { return s.value("owner", "") == name_; });
  return ask_and_wait({{"op", "state_command"}, {"command", "enable"}},
                      [](const Json& s) { return is_in(s, "ENABLED"); });
}

}  // namespace liana::launcher
