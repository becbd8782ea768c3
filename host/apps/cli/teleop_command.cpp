// The arm driven from this terminal: of a running system, or of a simulated arm that it starts.
#include <unistd.h>

#include <cstdio>
#include <functional>
#include <optional>
#include <stdexcept>
#include <string>

#include "host/api/server/client.hpp"
#include "host/apps/cli/commands.hpp"
#include "host/apps/launcher/console_session.hpp"
#include "host/apps/launcher/errors.hpp"
#include "host/apps/launcher/interrupt.hpp"
#include "host/apps/launcher/observer.hpp"
#include "host/apps/launcher/system_layout.hpp"
#include "host/base/clock/steady.hpp"
#include "host/base/json/json.hpp"
#include "host/operator/terminal/gamepad.hpp"
#include "host/operator/terminal/session.hpp"
#include "host/operator/terminal/terminal.hpp"

namespace liana::cli {
namespace {

constexpr double kDraw_s = 0.1;
constexpr double kWelcome_s = 30.0;  // a simulated arm is starting

// True once in `period_s`.
class Beat {
 public:
  explicit Beat(double period_s) : period_s_(period_s) {}
  bool is_due(double now_s) {
    if (now_s < due_s_) return false;
    due_s_ = now_s + period_s_;
    return true;
  }

 private:
  double period_s_, due_s_ = 0.0;
};

void send_all(api::ApiClient& client, const std::vector<Json>& requests) {
  for (const Json& request : requests) client.send(request);
}

// Keys of the terminal and of the gamepad, and where its sticks lean.
void feel(const std::string& typed, std::optional<terminal::Gamepad>& gamepad, terminal::Session& session,
          api::ApiClient& client) {
  for (const terminal::Key& key : terminal::keys_in(typed)) send_all(client, session.press(key, timing::steady_s()));
  if (!gamepad) return;
  for (const terminal::Key& key : gamepad->read(timing::steady_s()))
    send_all(client, session.press(key, timing::steady_s()));
  session.lean(gamepad->is_held() ? std::optional(gamepad->direction()) : std::nullopt);
  if (gamepad->take_silence())
    session.say("the gamepad has said nothing for 2 s: the arm holds; press its shoulder button anew");
  if (!gamepad->is_gone()) return;
  session.say("the gamepad is gone: the arm holds; go on with keys, or plug it in and start anew");
  gamepad.reset();
}

// Until the person or lianad ends it, or `goes_on` says false; whoever leaves gives motion back, and the arm holds.
void drive(const std::string& api, std::optional<terminal::Gamepad>& gamepad, const std::function<bool()>& goes_on) {
  const std::string name = "teleop-" + std::to_string(getpid());
  api::ApiClient client = api::ApiClient::connect(api, kWelcome_s);
  client.send(launcher::hello(name, launcher::Observer::kClient));
  const auto welcome = launcher::wait_for(client, "welcome", kWelcome_s);
  if (!welcome)
    throw std::runtime_error("lianad at " + api + " did not answer within 30 s: see docs/how-to/nothing-answers.md");
  terminal::Session session(name, *welcome, timing::steady_s());
  terminal::Terminal terminal;
  Beat goal(terminal::Session::kPeriod_s), picture(kDraw_s);
  while (goes_on() && !session.wants_end() && !session.is_over() && !terminal.is_gone()) {
    feel(terminal.read(client.fd(), terminal::Session::kPeriod_s), gamepad, session, client);
    while (const auto message = client.receive(0.0)) session.hear(*message, timing::steady_s());
    if (goal.is_due(timing::steady_s())) send_all(client, session.pass(timing::steady_s()));
    if (picture.is_due(timing::steady_s())) terminal.draw(session.lines(terminal.size(), timing::steady_s()));
  }
}

int attach(const std::string& api, std::optional<terminal::Gamepad>& gamepad) {
  const launcher::InterruptGuard interrupts;
  drive(api, gamepad, [&] { return interrupts.count() == 0; });
  return launcher::kExitOk;
}

void simulate_and_drive(const launcher::SystemLayout& plan, std::optional<terminal::Gamepad>& gamepad) {
  launcher::ConsoleSession session(plan);
  session.start();
  drive(plan.api_socket(), gamepad, [&] { return session.go_on(0.0); });
}

int simulate(const SystemSelection& wish, std::optional<terminal::Gamepad>& gamepad) {
  launcher::RunOptions run = wish.run;
  run.time = "paced";
  run.is_session = true;
  const launcher::SystemLayout plan = launcher::make_layout(run);
  std::fprintf(stderr, "a simulated arm is starting\n");
  try {
    simulate_and_drive(plan, gamepad);
  } catch (const launcher::BadInput&) {
    launcher::discard(plan);
    throw;
  } catch (...) {
    std::fprintf(stderr, "liana: logs are kept in %s\n", plan.directory.c_str());
    throw;
  }
  launcher::clean_up(plan, true);
  std::fprintf(stderr, "recorded in %s; liana view makes a page of it\n", plan.directory.c_str());
  return launcher::kExitOk;
}

void open_gamepad(const std::string& file, std::optional<terminal::Gamepad>& gamepad) try {
  if (!file.empty()) gamepad.emplace(file);
} catch (const std::runtime_error& error) {
  throw launcher::BadInput(error.what());
}

}  // namespace

int teleop_command(const TeleopOptions& options) {
  if (isatty(STDIN_FILENO) == 0 || isatty(STDOUT_FILENO) == 0)
    throw launcher::BadInput("teleop: standard input and output have to be a terminal: keys are read one by one");
  std::optional<terminal::Gamepad> gamepad;
  open_gamepad(options.gamepad, gamepad);
  const std::string api = system_to_join("teleop", options.wish);
  return api.empty() ? simulate(options.wish, gamepad) : attach(api, gamepad);
}

}  // namespace liana::cli
