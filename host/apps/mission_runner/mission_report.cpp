// Reports of missions, also of those that died.
#include <algorithm>
#include <fstream>
#include <stdexcept>
#include <utility>

#include "host/base/json/json.hpp"

#include "host/apps/mission_runner/mission_run.hpp"

namespace liana::mission_runner {

namespace {

double seconds_since(const Json& step, std::uint64_t tick, double period_s) {
  const std::uint64_t start = step.value("start_tick", std::uint64_t{0});
  return tick > start ? static_cast<double>(tick - start) * period_s : 0.0;
}

// The step lasted at least until the last state that was seen.
void close_step(Json& step, std::uint64_t last_tick, double period_s, const std::string& reason) {
  step["outcome"] = "failed";
  step["reason"] = reason;
  step["duration_s"] = seconds_since(step, last_tick, period_s);
  step["end_tick"] = std::max(step.value("start_tick", std::uint64_t{0}), last_tick);
}

}  // namespace

// The text is {"steps":[ and the steps, then the rest, which is written anew each time.
void GrowingReport::take(Json news) {
  const auto before = std::min(news.at("steps_before").get<std::size_t>(), steps_.size());
  const Json last = news.at("steps");
  for (const char* key : {"steps_before", "steps"}) news.erase(key);
  head_ = std::move(news);
  steps_.resize(before);
  ends_.resize(before);
  const std::size_t from = before == 0 ? 0 : ends_.back();
  std::string text = before == 0 ? R"({"steps":[)" : "";
  for (const Json& step : last) {
    text += (steps_.empty() ? "" : ",") + step.dump();
    steps_.push_back(step);
    ends_.push_back(from + text.size());
  }
  text += "]," + head_.dump().substr(1);
  is_full_ = is_full_ || from + text.size() >= activity_.report.size();
  if (is_full_) return;
  text.copy(activity_.report.data() + from, text.size());
  activity_.report[from + text.size()] = '\0';
}

Json GrowingReport::whole() const {
  Json out = head_;
  out["steps"] = steps_;
  return out;
}

void write_report(const std::string& path, const std::string& report_json) {
  std::ofstream out(path, std::ios::trunc);
  out << report_json << "\n";
  if (!out.flush())
    throw std::runtime_error(path + ": cannot be written: allowed a writable place: choose another --report");
}

std::string failed_report(const Activity& activity, const std::string& mission, const std::string& reason) {
  Json report = Json::parse_or_null(activity.report.data());
  if (!report.is_object()) report = {{"mission", mission}, {"steps", Json::array()}, {"duration_s", 0}};
  report["outcome"] = "failed";
  report["reason"] = reason;
  const std::uint64_t last_tick = activity.tick.load(std::memory_order_relaxed);
  for (auto& step : report["steps"]) {
    if (step.value("outcome", "") == "running") close_step(step, last_tick, activity.period_s, reason);
  }
  if (!report["steps"].empty()) report["duration_s"] = seconds_since(report["steps"][0], last_tick, activity.period_s);
  return report.dump();
}

}  // namespace liana::mission_runner
