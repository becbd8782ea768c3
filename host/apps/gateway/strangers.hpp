// Connections that have not said hello yet: how many there may be, and for how long. Knows nothing of the web.
#pragma once

#include <cstddef>
#include <optional>
#include <string>
#include <vector>

namespace liana::gateway {

class Strangers {
 public:
  using Id = const void*;                     // a connection
  static constexpr std::size_t kMost = 96;    // for one more another goes
  static constexpr double kRequest_s = 10.0;  // from its begin until its first request is whole, TLS included
  static constexpr double kHello_s = 30.0;    // from its begin until it has said hello, or has loaded the page

  // One has come. Who has to go for it, if anybody: the oldest from the address that has most of them, so that who
  // fills all places loses his own. `now_s`: any clock that never goes back.
  std::optional<Id> come(Id who, std::string address, double now_s);
  // Its first request is whole.
  void asked(Id who);
  // It is gone, or no stranger any more.
  void leave(Id who);
  // Whose time is over; they are named again until they leave.
  std::vector<Id> overdue(double now_s) const;
  std::size_t count() const { return all_.size(); }

 private:
  struct One {
    Id who;
    std::string address;
    double since_s;
    bool has_asked = false;
  };
  std::vector<One> all_;  // in the order in which they came
};

}  // namespace liana::gateway
