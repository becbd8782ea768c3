// The mission runner's side of the API socket.
#pragma once

#include <nlohmann/json.hpp>
#include <string>

#include "host/api/client.hpp"
#include "host/lua/bindings.hpp"
#include "host/lua/mission_run.hpp"

namespace liana {

// Speaks to lianad for one mission; commands of the script go out through it.
class MissionSession : public RequestSink {
 public:
  // Connects and says hello; throws std::runtime_error when lianad is not there or refuses.
  MissionSession(const MissionOptions& options, Activity& activity);

  const nlohmann::json& welcome() const { return welcome_; }
  const nlohmann::json& last_report() const { return report_; }

  // Next message within half a second, or null.
  nlohmann::json next();
  // Tells lianad that the state of `tick` is dealt with.
  void done(std::int64_t tick);
  // Asks for a hold; says nothing when lianad is gone.
  void hold_quietly();

  std::int64_t request(const Binding& binding, nlohmann::json fields) override;
  void progress(const nlohmann::json& event) override;
  void report(const nlohmann::json& report) override;

 private:
  const MissionOptions& options_;
  Activity& activity_;
  ApiClient client_;
  nlohmann::json welcome_;
  nlohmann::json report_;
  std::int64_t last_id_ = 0;
};

}  // namespace liana
