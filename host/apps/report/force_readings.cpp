#include "host/apps/report/force_readings.hpp"

#include <algorithm>
#include <cmath>

#include "host/apps/report/line.hpp"

namespace liana::report {
namespace {

constexpr double kNormal95 = 1.96;
constexpr double kSizes_N[] = {1.0, 2.0, 5.0};

const char* name_of(ForceMoment moment) {
  switch (moment) {
    case ForceMoment::kMoving:
      return "moving";
    case ForceMoment::kDithered:
      return "dithered";
    case ForceMoment::kStill:
      break;
  }
  return "still";
}

double quantile(std::vector<double> values, double share) {
  if (values.empty()) return 0.0;
  std::sort(values.begin(), values.end());
  return values[static_cast<std::size_t>(std::lround(share * static_cast<double>(values.size() - 1)))];
}

bool is_of_size(double force_N, double size_N) { return std::fabs(force_N - size_N) < 0.01 * size_N; }

// Errors of some readings, along the axes that are seen.
class Errors {
 public:
  void add(const ForceReading& reading) {
    const double size_N = norm(reading.true_N);
    double square = 0.0, along = 0.0;
    bool all_seen = true;
    for (std::size_t i = 0; i < 3; ++i) {
      if (!reading.told_N[i]) {
        all_seen = false;
        continue;
      }
      const double error_N = *reading.told_N[i] - reading.true_N[i];
      square += error_N * error_N;
      along += error_N * reading.true_N[i] / size_N;
      covered_ += std::fabs(error_N) <= kNormal95 * reading.sd_N[i] ? 1 : 0;
      ++axes_;
    }
    ++count_;
    square_sum_ += square;
    largest_N_ = std::max(largest_N_, std::sqrt(square));
    if (!all_seen) return;
    bias_sum_N_ += along;
    ++whole_;
  }

  Json row(const char* moment, std::optional<double> size_N) const {
    return {{"state", moment},
            {"size_N", size_N ? Json(*size_N) : Json()},
            {"count", count_},
            {"bias_N", whole_ > 0 ? Json(bias_sum_N_ / whole_) : Json()},
            {"rms_N", axes_ > 0 ? Json(std::sqrt(square_sum_ / count_)) : Json()},
            {"largest_N", largest_N_},
            {"within_95", axes_ > 0 ? Json(static_cast<double>(covered_) / axes_) : Json()},
            {"seen", count_ > 0 ? Json(axes_ / (3.0 * count_)) : Json()}};
  }
  int count() const { return count_; }

 private:
  int count_ = 0, whole_ = 0, axes_ = 0, covered_ = 0;
  double square_sum_ = 0.0, bias_sum_N_ = 0.0, largest_N_ = 0.0;
};

Json error_rows(const ForceReadings& all) {
  Json rows = Json::array();
  for (const ForceMoment moment : {ForceMoment::kStill, ForceMoment::kMoving, ForceMoment::kDithered}) {
    Errors together;
    for (const double size_N : kSizes_N) {
      Errors errors;
      for (const ForceReading& reading : all.readings)
        if (reading.moment == moment && is_of_size(norm(reading.true_N), size_N)) errors.add(reading);
      if (errors.count() > 0) rows.push_back(errors.row(name_of(moment), size_N));
    }
    for (const ForceReading& reading : all.readings)
      if (reading.moment == moment) together.add(reading);
    if (together.count() > 0) rows.push_back(together.row(name_of(moment), std::nullopt));
  }
  return rows;
}

Json found_rows(const ForceReadings& all) {
  Json rows = Json::array();
  for (const ForceMoment moment : {ForceMoment::kStill, ForceMoment::kMoving}) {
    for (const double size_N : kSizes_N) {
      std::vector<double> delays_s;
      int count = 0;
      for (const ForceFound& found : all.found) {
        if (found.moment != moment || !is_of_size(found.size_N, size_N)) continue;
        ++count;
        if (found.after_s) delays_s.push_back(*found.after_s);
      }
      if (count == 0) continue;
      rows.push_back({{"state", name_of(moment)},
                      {"size_N", size_N},
                      {"count", count},
                      {"found", static_cast<double>(delays_s.size()) / count},
                      {"median_s", quantile(delays_s, 0.5)},
                      {"latest_s", quantile(delays_s, 1.0)}});
    }
  }
  return rows;
}

Json free_row(const std::vector<double>& told_N) {
  const auto false_alarms = std::count_if(told_N.begin(), told_N.end(), [](double f) { return f >= kForceFound_N; });
  return {{"looks", told_N.size()},
          {"median_N", quantile(told_N, 0.5)},
          {"p99_N", quantile(told_N, 0.99)},
          {"largest_N", quantile(told_N, 1.0)},
          {"found", false_alarms}};
}

Json body_row(const ForceReadings& all) {
  int felt = 0, named = 0, right = 0;
  for (const BodyNamed& body : all.body) {
    felt += body.is_felt ? 1 : 0;
    named += body.named > 0 ? 1 : 0;
    right += body.named == body.segment ? 1 : 0;
  }
  return {{"count", all.body.size()}, {"felt", felt}, {"named", named}, {"right", right}};
}

std::string figure(const Json& value, const char* format) {
  return value.is_number() ? line(format, value.get<double>()) : "-";  // NOLINT(format-nonliteral)
}

}  // namespace

Json force_json(const ForceReadings& all) {
  Json faults = Json::array();
  for (const ForceFault& fault : all.faults) faults.push_back({{"number", fault.number}, {"pushed_N", fault.pushed_N}});
  return {{"errors", error_rows(all)},
          {"found_from_N", kForceFound_N},
          {"found", found_rows(all)},
          {"free", {{"moving", free_row(all.free_moving_N)}, {"resting", free_row(all.free_resting_N)}}},
          {"watchdogs", faults},
          {"body", body_row(all)}};
}

std::string force_text(const Json& table) {
  std::string text = "state     push  count   bias    RMS  largest  within 95 %  seen\n";
  for (const Json& row : table.at("errors"))
    text += line("%-8s %5s %6d %6s %6s %8.2f %12s %5s\n", row.at("state").text().c_str(),
                 row.at("size_N").is_number() ? figure(row.at("size_N"), "%.0f N").c_str() : "all",
                 row.at("count").get<int>(), figure(row.at("bias_N"), "%.2f").c_str(),
                 figure(row.at("rms_N"), "%.2f").c_str(), row.at("largest_N").get<double>(),
                 figure(row.at("within_95"), "%.3f").c_str(), figure(row.at("seen"), "%.2f").c_str());
  text += line("found from %.1f N told:\n", table.at("found_from_N").get<double>());
  for (const Json& row : table.at("found"))
    text += line("  %-8s %.0f N: %5.1f %% of %d, after %.2f s (latest %.2f s)\n", row.at("state").text().c_str(),
                 row.at("size_N").get<double>(), 100.0 * row.at("found").get<double>(), row.at("count").get<int>(),
                 row.at("median_s").get<double>(), row.at("latest_s").get<double>());
  for (const char* how : {"moving", "resting"}) {
    const Json& row = table.at("free").at(how);
    text += line("free, %-7s: median %.2f, 99 %% %.2f, largest %.2f N; found in %d of %d looks\n", how,
                 row.at("median_N").get<double>(), row.at("p99_N").get<double>(), row.at("largest_N").get<double>(),
                 row.at("found").get<int>(), row.at("looks").get<int>());
  }
  for (const Json& fault : table.at("watchdogs"))
    text += line("fault %d at %.1f N\n", fault.at("number").get<int>(), fault.at("pushed_N").get<double>());
  const Json& body = table.at("body");
  text += line("pushes on the body: %d felt and %d named right of %d\n", body.at("felt").get<int>(),
               body.at("right").get<int>(), body.at("count").get<int>());
  return text;
}

}  // namespace liana::report
