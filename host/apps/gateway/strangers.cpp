#include "host/apps/gateway/strangers.hpp"

#include <algorithm>
#include <utility>

namespace liana::gateway {

std::optional<Strangers::Id> Strangers::come(Id who, std::string address, double now_s) {
  all_.push_back({who, std::move(address), now_s});
  if (all_.size() <= kMost) return std::nullopt;
  const auto from = [this](const One& one) {
    return std::count_if(all_.begin(), all_.end(), [&](const One& other) { return other.address == one.address; });
  };
  std::vector<std::ptrdiff_t> sizes;
  for (const One& one : all_) sizes.push_back(from(one));
  const auto most = std::max_element(sizes.begin(), sizes.end());  // the first of them: the oldest
  const auto gone = all_.begin() + (most - sizes.begin());
  const Id chosen = gone->who;
  all_.erase(gone);
  return chosen;
}

void Strangers::asked(Id who) {
  for (One& one : all_) one.has_asked = one.has_asked || one.who == who;
}

void Strangers::leave(Id who) {
  std::erase_if(all_, [who](const One& one) { return one.who == who; });
}

std::vector<Strangers::Id> Strangers::overdue(double now_s) const {
  std::vector<Id> late;
  for (const One& one : all_) {
    if (now_s - one.since_s > (one.has_asked ? kHello_s : kRequest_s)) late.push_back(one.who);
  }
  return late;
}

}  // namespace liana::gateway
