#include "host/apps/launcher/console_session.hpp"

#include <csignal>
#include <cstdio>
#include <stdexcept>

#include "host/apps/launcher/errors.hpp"
#include "host/apps/launcher/observer.hpp"

namespace liana::launcher {
namespace {}  // namespace

ConsoleSession::~ConsoleSession() {
  system_.end(interrupts_.count() < 2 ? kEndGrace_s : 0.0, [](const Json&) {});
}

void ConsoleSession::start() {
  std::signal(SIGPIPE, SIG_IGN);
  const std::string problem = system_.start(hello("liana console", Observer::kClient), interrupts_.any());
  if (interrupts_.count() > 0) throw Interrupted("interrupted before the system ran");
  if (problem.empty()) return;
  require_alive();
  throw std::runtime_error(problem);
}

bool ConsoleSession::go_on(double look_s) {
  auto message = system_.receive(look_s);
  while (message) {
    if (message->value("op", "") == "state") {
      has_begun_ = true;
      watch_.heard();
    }
    message = system_.receive(0.0);
  }
  if (interrupts_.count() > 0) return false;
  if (const auto silence = watch_.silence(system_))
    std::fprintf(stderr, "liana: %s; Ctrl-C ends it\n", silence->c_str());
  if (system_.any_has_ended([this](const ChildProcess& child) { return !has_begun_ || child.name() != kRecorder; }))
    require_alive();
  if (system_.any_has_ended()) revive_recorder();
  return true;
}

// Nobody has to stop working because the flight recorder died: a new one goes on where the old one left off.
void ConsoleSession::revive_recorder() {
  if (recorders_ > kMaxRecorders) return;
  if (++recorders_ > kMaxRecorders) {
    std::fprintf(stderr, "liana: %s has ended again and is not started any more: nothing is recorded from now on\n",
                 kRecorder);
    return;
  }
  std::fprintf(stderr, "liana: %s has ended; it is started again, what it missed is a gap in the archive\n", kRecorder);
  system_.start_again(kRecorder);
}

void ConsoleSession::require_alive() {
  const auto worst = system_.worst_end([](const ChildProcess&, const ExitStatus&) { return true; }, kAftermath_s);
  if (worst) throw std::runtime_error(worst->text);
}

}  // namespace liana::launcher
