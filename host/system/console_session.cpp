#include "host/system/console_session.hpp"

#include <csignal>
#include <stdexcept>

#include "host/system/errors.hpp"
#include "host/system/observer.hpp"

namespace liana::system {
namespace {

constexpr double kLook_s = 0.05;
constexpr double kEndGrace_s = 10.0;  // for lianad to stop the arm, then for the others to end
constexpr double kAftermath_s = 0.5;  // between the end of one program and the ends of those that need it

}  // namespace

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

bool ConsoleSession::go_on() {
  system_.receive(kLook_s);
  while (system_.receive(0.0)) {
  }
  if (interrupts_.count() > 0) return false;
  if (system_.any_has_ended()) require_alive();
  return true;
}

void ConsoleSession::require_alive() {
  const auto worst = system_.worst_end([](const ChildProcess&, const ChildEnd&) { return true; }, kAftermath_s);
  if (worst) throw std::runtime_error(worst->text);
}

}  // namespace liana::system
