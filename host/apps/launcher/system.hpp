// The programs of one system: started in order, joined as a client of lianad, ended together.
#pragma once

#include <functional>
#include <memory>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "host/api/server/client.hpp"
#include "host/apps/launcher/process.hpp"
#include "host/apps/launcher/system_layout.hpp"
#include "host/base/json/json.hpp"

namespace liana::launcher {

// What the sessions share.
constexpr const char* kRecorder = "liana-archive";
constexpr int kMaxRecorders = 5;      // of one run: one that has ended is started again
constexpr double kEndGrace_s = 10.0;  // for lianad to stop the arm, then for the others to end
constexpr double kAftermath_s = 0.5;  // between the end of one program and the ends of those that need it

class System {
 public:
  // Takes in a message of lianad.
  using Sink = std::function<void(const Json& message)>;

  // `layout` must outlive this.
  explicit System(const SystemLayout& layout) : layout_(layout) {}
  // Ends what still runs.
  ~System();
  System(const System&) = delete;
  System& operator=(const System&) = delete;

  // Starts every program of the layout, the next one when the socket of the one before is there, and says `hello` to
  // lianad as soon as it listens. Empty when all run; otherwise which one did not open its socket within 30 s. Stops
  // waiting when `stop` becomes true.
  std::string start(const Json& hello, const std::atomic<bool>& stop);

  // lianad still listens to us.
  bool is_connected() const { return api_.has_value(); }
  // The next message of lianad within `timeout_s`; nothing when none came or lianad has left.
  std::optional<Json> receive(double timeout_s);
  // Sends a message unless lianad has left.
  void send(const Json& message);

  // Starts the program of this name again, which has ended; its log goes on.
  void start_again(std::string_view name);

  // The program that was started last.
  ChildProcess& last() { return *children_.back(); }
  // How the worst of those whose end counts has ended (process.hpp); waits up to `settle_s` before, because whoever
  // ends first pulls the others along.
  using Counts = std::function<bool(const ChildProcess&, const ExitStatus&)>;
  std::optional<NamedResult> worst_end(const Counts& counts, double settle_s = 0.0);
  bool any_has_ended() const;
  // The same, of those that matter.
  bool any_has_ended(const std::function<bool(const ChildProcess&)>& matters) const;
  bool all_have_ended() const;
  // A program of this name was started and has not ended.
  bool is_running(std::string_view name) const;

  // Programs that somebody has stopped, with their processes, in words; empty when there are none.
  std::string standing_still() const;

  // Asks lianad to stop the arm and leave, once.
  void dismiss();
  // Does that unless it was done, waits up to `grace_s` for all programs to end by themselves (bus and bench
  // then write their summaries), and ends those that have not. Where one stands still the others wait in vain, so that
  // nobody is waited for. What lianad still says goes to `sink`; without one nobody listens any more.
  void end(double grace_s, const Sink& sink = {});

 private:
  void remove_stale_entry() const;

  const SystemLayout& layout_;
  std::vector<std::unique_ptr<ChildProcess>> children_;
  std::optional<api::ApiClient> api_;
  bool shutdown_requested_ = false;
};

}  // namespace liana::launcher
