// Every stage of every command, in one ordered file; a thread of its own writes it.
#pragma once

#include <cstdint>
#include <optional>
#include <string>

#include "host/base/event/dispatch.hpp"
#include "host/base/event/line_file.hpp"
#include "host/control/server/arm_server.hpp"

namespace liana::server {

class CommandLog {
 public:
  // Makes the file; throws std::runtime_error.
  explicit CommandLog(const std::string& path);

  // Once per command interval: which command the arm follows by now (0: none).
  void note_active(std::uint64_t tick, std::uint64_t sequence);
  // A command that was asked for by `owner`, with what became of it.
  void note(std::uint64_t tick, const std::string& owner, const LastVerdict& verdict);
  // A request that was answered with an error.
  void note_request(std::uint64_t tick, const event::Event& refusal);
  // As of LineFile.
  std::optional<event::Event> change() { return file_.change(); }

 private:
  void write(const event::Dispatch& dispatch) { file_.append(event::dispatch_line(dispatch)); }
  void write_verdict(event::Stage stage, std::uint64_t tick, const verification::Verdict& verdict, bool has_margins);

  event::LineFile file_;
  std::uint64_t active_ = 0;
};

}  // namespace liana::server
