// The mission runner's side of the API socket.
#pragma once

#include <string>

#include "host/api/server/client.hpp"
#include "host/apps/mission_runner/bindings.hpp"
#include "host/apps/mission_runner/mission_run.hpp"
#include "host/base/json/json.hpp"

namespace liana::mission_runner {

// Speaks to lianad for one mission; commands of the script go out through it.
class MissionSession : public RequestSink {
 public:
  // Connects and says hello; throws std::runtime_error when lianad is not there or refuses.
  MissionSession(const MissionOptions& options, Activity& activity);

  const Json& welcome() const { return welcome_; }
  Json last_report() const { return report_.whole(); }

  // Next message within half a second, or null.
  Json next();
  // Tells lianad that the state of `tick` is dealt with.
  void done(std::int64_t tick);
  // Asks for a hold; says nothing when lianad is gone.
  void hold_quietly();

  // Throws api::RequestError when too many have been made since the last message: lianad would throw this client out.
  std::int64_t request(const api::RequestRow& row, Json fields) override;
  void progress(const Json& event) override;
  void report(const Json& news) override { report_.take(news); }
  const Json& plan_curve(const Json& request) override;

 private:
  const MissionOptions& options_;
  Activity& activity_;
  GrowingReport report_;
  api::ApiClient client_;
  Json welcome_;
  Json plan_;  // the last one
  std::int64_t last_id_ = 0;
  int made_at_once_ = 0, max_at_once_ = 0;  // requests since the last message
};

}  // namespace liana::mission_runner
