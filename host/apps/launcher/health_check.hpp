// Whether a web server of this machine lives: it is asked for /health every few seconds. Any answer counts, also that
// it ends the connection.
#pragma once

#include "host/base/net/internet_address.hpp"

namespace liana::launcher {

class HealthCheck {
 public:
  static constexpr double kBetween_s = 3.0;      // between two questions
  static constexpr double kLongestStep_s = 0.5;  // counted of the time between two calls: we may have stood still

  // `now_s`: any clock that never goes back.
  HealthCheck(api::InternetAddress at, double now_s);
  // To be called often; never waits. How long nothing has answered, 0 while it does [s].
  double silent_s(double now_s);
  // It was started again.
  void restart(double now_s);

 private:
  void ask(double now_s);
  void look();
  void heard();

  api::InternetAddress at_;
  api::UniqueFd socket_;  // of the question under way
  bool is_sent_ = false;
  double asked_s_ = 0.0, looked_s_ = 0.0, silent_s_ = 0.0;
};

}  // namespace liana::launcher
