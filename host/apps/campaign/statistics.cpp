#include "host/apps/campaign/statistics.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>

#include "host/model/config/canonical.hpp"

namespace liana::campaign {
namespace {

constexpr std::array kMainFigures{"duration_s",           "tip_error_m",         "min_clearance_m",
                                  "min_slit_clearance_m", "max_contact_force_N", "max_tip_speed_m_s",
                                  "cable_tension_N.max",  "cable_tension_N.min"};

// Continued fraction of the incomplete beta function by Lentz's method; quick for x below (a + 1) / (a + b + 2).
double beta_fraction(double a, double b, double x) {
  constexpr double kTiny = 1e-300, kEnough = 1e-15;
  constexpr int kMaxTerms = 10'000;
  const auto or_tiny = [](double value) { return std::fabs(value) < kTiny ? kTiny : value; };
  double c = 1.0, d = 1.0 / or_tiny(1.0 - (a + b) * x / (a + 1.0)), product = d;
  for (int m = 1; m <= kMaxTerms; ++m) {
    const double even = m * (b - m) * x / ((a + 2 * m - 1.0) * (a + 2 * m));
    const double odd = -(a + m) * (a + b + m) * x / ((a + 2 * m) * (a + 2 * m + 1.0));
    double factor = 1.0;
    for (const double term : {even, odd}) {
      d = 1.0 / or_tiny(1.0 + term * d);
      c = or_tiny(1.0 + term / c);
      factor = c * d;
      product *= factor;
    }
    if (std::fabs(factor - 1.0) < kEnough) break;
  }
  return product;
}

// Share of the beta distribution (a, b) below x.
double beta_below(double a, double b, double x) {
  if (x <= 0.0) return 0.0;
  if (x >= 1.0) return 1.0;
  const double log_front = std::lgamma(a + b) - std::lgamma(a) - std::lgamma(b) + a * std::log(x) + b * std::log1p(-x);
  if (x < (a + 1.0) / (a + b + 2.0)) return std::exp(log_front) * beta_fraction(a, b, x) / a;
  return 1.0 - std::exp(log_front) * beta_fraction(b, a, 1.0 - x) / b;
}

double beta_quantile(double a, double b, double p) {
  double low = 0.0, high = 1.0;
  for (int i = 0; i < 200 && high - low > 1e-16; ++i) {
    const double middle = 0.5 * (low + high);
    (beta_below(a, b, middle) < p ? low : high) = middle;
  }
  return 0.5 * (low + high);
}

bool is_small_bad(const std::string& figure) {
  return figure.find("clearance") != figure.npos || figure.find("min") != figure.npos;
}

}  // namespace

Share exact_share(std::uint64_t count, std::uint64_t of, double confidence) {
  Share share{count, of};
  if (of == 0) return share;
  const auto k = static_cast<double>(count), n = static_cast<double>(of);
  const double beside = 0.5 * (1.0 - confidence);
  if (count > 0) share.low = beta_quantile(k, n - k + 1.0, beside);
  if (count < of) share.high = beta_quantile(k + 1.0, n - k, 1.0 - beside);
  return share;
}

std::map<std::string, Share> outcome_shares(const std::vector<StoredRow>& rows) {
  std::map<std::string, std::uint64_t> counts{{"success", 0}};
  for (const StoredRow& row : rows) ++counts[row.result.outcome];
  std::map<std::string, Share> shares;
  for (const auto& [outcome, count] : counts) shares[outcome] = exact_share(count, rows.size());
  return shares;
}

std::vector<double> values_of(const std::vector<StoredRow>& rows, const std::string& figure) {
  std::vector<double> values;
  for (const StoredRow& row : rows) {
    const Json& value = row.result.figures.member_or_null(figure);
    if (value.is_number()) values.push_back(value.get<double>());
  }
  return values;
}

double quantile(const std::vector<double>& sorted, double p) {
  const double place = p * static_cast<double>(sorted.size() - 1);
  const auto below = static_cast<std::size_t>(place);
  const std::size_t above = std::min(below + 1, sorted.size() - 1);
  return sorted[below] + (place - static_cast<double>(below)) * (sorted[above] - sorted[below]);
}

Spread spread_of(std::vector<double> values) {
  std::sort(values.begin(), values.end());
  return {values.size(),         values.front(),         quantile(values, 0.05), quantile(values, 0.25),
          quantile(values, 0.5), quantile(values, 0.75), quantile(values, 0.95), values.back()};
}

std::vector<std::string> figures_in(const std::vector<StoredRow>& rows, bool main_only) {
  std::map<std::string, std::uint64_t> counts;
  for (const StoredRow& row : rows) {
    for (const auto& [name, value] : row.result.figures.items()) ++counts[name];
  }
  std::vector<std::string> names;
  for (const char* name : kMainFigures) {
    if (counts.count(name) != 0) names.emplace_back(name);
  }
  if (main_only) return names;
  for (const auto& [name, count] : counts) {
    if (std::find(names.begin(), names.end(), name) == names.end()) names.push_back(name);
  }
  return names;
}

std::vector<const StoredRow*> worst_rows(const std::vector<StoredRow>& rows, const std::string& figure,
                                         std::size_t count) {
  constexpr double kNone = std::numeric_limits<double>::lowest();  // a row without the figure is the least bad
  const auto badness = [&](const StoredRow* row) {
    const Json& value = row->result.figures.member_or_null(figure);
    if (!value.is_number()) return kNone;
    return is_small_bad(figure) ? -value.get<double>() : value.get<double>();
  };
  std::vector<const StoredRow*> worst;
  for (const StoredRow& row : rows) worst.push_back(&row);
  std::stable_sort(worst.begin(), worst.end(), [&](const StoredRow* a, const StoredRow* b) {
    if (a->is_success() != b->is_success()) return b->is_success();
    return a->is_success() && badness(a) > badness(b);
  });
  worst.resize(std::min(worst.size(), count));
  return worst;
}

std::map<std::string, std::vector<StoredRow>> by_sweep(const Stored& stored) {
  std::map<std::string, std::vector<StoredRow>> groups;
  const Json& sweep = stored.campaign.table.member_or_null("sweep");
  for (const StoredRow& row : stored.rows) {
    Json point = Json::object();
    if (sweep.is_object()) {
      for (const auto& [key, values] : sweep.items()) point[key] = row.values.member_or_null(key);
    }
    groups[point.empty() ? "" : config::canonical_json(point)].push_back(row);
  }
  return groups;
}

}  // namespace liana::campaign
