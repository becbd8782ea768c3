// A system without mission that is asked one thing after the other, interval by interval of virtual time.
#pragma once

#include <functional>
#include <string>

#include "host/apps/launcher/interrupt.hpp"
#include "host/apps/launcher/state_monitor.hpp"
#include "host/apps/launcher/system.hpp"
#include "host/base/json/json.hpp"

namespace liana::launcher {

class LockstepSession {
 public:
  // `plan`: without a mission; it and `interrupts` must outlive this. `name`: as lianad shows it. `undone`: what an
  // interrupt leaves undone.
  LockstepSession(const SystemLayout& plan, const InterruptGuard& interrupts, std::string name, std::string undone);
  // Ends the programs.
  ~LockstepSession();
  LockstepSession(const LockstepSession&) = delete;
  LockstepSession& operator=(const LockstepSession&) = delete;

  // Starts the programs. All below throw std::runtime_error when a program ends or says nothing; Interrupted at Ctrl-C;
  // BadInput when a program refused what it was given.
  void start();
  // A request that was refused ends the session, where `refusals_count`.
  Json next_state(bool refusals_count = true);
  // Ends the interval of this state.
  void done(const Json& state) { system_.send({{"op", "done"}, {"tick", state.at("tick")}}); }
  void send(const Json& request) { system_.send(request); }
  // The state in which it is done, all states until then shown to `look`; a request without "op" only waits. Throws
  // also when a fault comes, or after a minute of arm time.
  Json ask_and_wait(const Json& request, const std::function<bool(const Json&)>& is_done,
                    const std::function<void(const Json&)>& look = {});
  // Boots, takes motion, enables. The state in which the arm is enabled.
  Json enable();
  [[noreturn]] void give_up(const std::string& why, double settle_s = 0.0);

 private:
  const InterruptGuard& interrupts_;
  std::string name_, undone_;
  System system_;
  StateMonitor watch_;
};

}  // namespace liana::launcher
