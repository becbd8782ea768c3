// The planner for one client of the console: `liana plan` as a process of its own, one at a time, bounded in time.
#pragma once

#include <cstdint>
#include <functional>
#include <memory>
#include <string>

#include "host/apps/launcher/folder_lock.hpp"
#include "host/apps/launcher/process.hpp"
#include "host/base/json/json.hpp"

namespace liana::gateway {

class Planner {
 public:
  static constexpr double kPatience_s = 120.0;    // until a planner that has not ended is ended
  static constexpr double kBetween_s = 1.0;       // between two messages of its progress
  static constexpr std::size_t kMaxPoints = 500;  // that lianad takes in one path

  // Gets the messages to the client: {"op":"plan","number":...,"phase":...}, docs/reference/console-protocol.md.
  using Say = std::function<void(const Json& message)>;

  // `program`: path of `liana`. Removes what gateways that were killed have left.
  Planner(std::string program, Say say);
  // Ends what runs.
  ~Planner();
  Planner(const Planner&) = delete;
  Planner& operator=(const Planner&) = delete;

  // Plans a way for a request {"goal_deg":[...],"number":N}, in the tables of `welcome` and from where the newest
  // `state` of lianad commands the arm to be. Throws api::RequestError when the request is wrong, a planner runs
  // already, the arm moves, or `client` does not own its motion.
  void start(const Json& request, const Json& welcome, const Json& state, const std::string& client, double now_s);
  bool is_running() const { return child_ != nullptr; }
  // Ends the planner and says why; nothing happens where none runs.
  void end(const std::string& why);
  // To be called ten times a second while one runs, with the newest state.
  void tick(const Json& state, const std::string& client, double now_s);

 private:
  void say_progress(double now_s);
  void finish(const launcher::ExitStatus& status);
  void say(Json message);
  void forget();

  std::string program_;
  Say say_;
  std::string folder_;         // of this plan's files; empty: none
  launcher::FolderLock lock_;  // of it
  std::unique_ptr<launcher::ChildProcess> child_;
  Json from_deg_;
  std::int64_t number_ = 0;  // of the goal
  double since_s_ = 0.0, said_s_ = 0.0;
};

}  // namespace liana::gateway
