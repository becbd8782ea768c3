#include "host/control/server/turns.hpp"

#include <chrono>
#include <stdexcept>
#include <string>
#include <thread>

#include "host/control/realtime/last_stop.hpp"
#include "host/control/realtime/realtime.hpp"

namespace liana::server {

namespace {

// Virtual time stands still now. Clients may read the last state until somebody sends shutdown.
void wait_for_dismissal(Service& service, const Signalled& signalled) {
  constexpr double kPatience_s = 30.0, kLook_s = 0.05;
  service.end_lockstep();
  for (double waited_s = 0.0; waited_s < kPatience_s && !service.dismissed() && !signalled(); waited_s += kLook_s)
    service.idle(kLook_s);
}

// A side that has failed ends the run; before that, the arm is stopped and its drives are off.
[[noreturn]] void end_after_stop(const std::string& side, const std::string& problem) {
  throw std::runtime_error(side + " failed, so the arm was stopped: " + problem);
}

// Fast and paced: one thread alternates service and real-time side, so that runs repeat bit for bit. False when the bus
// has ended.
bool alternate(Service& service, const Ticks& ticks, const Signalled& signalled) {
  for (;;) {
    if (signalled()) service.begin_shutdown("signal");
    service.cycle();
    if (service.finished()) {
      wait_for_dismissal(service, signalled);
      return true;
    }
    do {
      if (!ticks.run_tick()) return false;
    } while (!service.interval_began());
  }
}

// The service runs once per command interval, when the real-time thread has published its image.
void serve_beside(const realtime::ThreadResult& realtime, Service& service, const Signalled& signalled) {
  while (!realtime.over && !service.finished()) {
    if (signalled()) service.begin_shutdown("signal");
    if (service.interval_began()) service.cycle();
    service.idle(0.001);
  }
}

}  // namespace

bool run_lockstep(Service& service, const Ticks& ticks, const Signalled& signalled) {
  try {
    return alternate(service, ticks, signalled);
  } catch (const std::exception& error) {
    ticks.stop_without_service(ticks.run_tick);
    end_after_stop("the service side", error.what());
  }
}

bool run_real(Service& service, const Ticks& ticks, const Signalled& signalled) {
  realtime::ThreadResult end;
  const std::jthread realtime = realtime::start_realtime(
      [&ticks](const std::stop_token& stop) {
        while (!stop.stop_requested() && ticks.run_tick()) {
        }
      },
      end);
  try {
    serve_beside(end, service, signalled);
  } catch (const std::exception& error) {
    ticks.stop_without_service([&] {
      std::this_thread::sleep_for(std::chrono::milliseconds(1));
      return !end.over;
    });
    end_after_stop("the service side", error.what());
  }
  if (!end.over || end.problem.empty()) return service.finished();
  // Without ticks the drives hear nothing more and stop by themselves.
  service.stop_by_itself("the real-time thread failed: " + end.problem);
  service.flush_and_close();
  end_after_stop("the real-time thread", end.problem);
}

}  // namespace liana::server
