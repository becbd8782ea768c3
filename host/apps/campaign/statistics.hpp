// Shares, intervals and quantiles of a campaign's rows.
#pragma once

#include <cstdint>
#include <map>
#include <string>
#include <vector>

#include "host/apps/campaign/store.hpp"

namespace liana::campaign {

// A share of all and its exact (Clopper-Pearson) interval.
struct Share {
  std::uint64_t count = 0, of = 0;
  double low = 0.0, high = 1.0;

  double value() const { return of == 0 ? 0.0 : static_cast<double>(count) / static_cast<double>(of); }
};

constexpr double kConfidence = 0.95;  // of every interval

// The interval with `confidence` (0 to 1, both excluded) for `count` of `of`; 0 to 1 where `of` is 0.
Share exact_share(std::uint64_t count, std::uint64_t of, double confidence = kConfidence);

// Outcomes of rows, each with its share.
std::map<std::string, Share> outcome_shares(const std::vector<StoredRow>& rows);

// How the values of one figure are spread over the rows that have it.
struct Spread {
  std::uint64_t count = 0;
  double least = 0.0, p05 = 0.0, p25 = 0.0, median = 0.0, p75 = 0.0, p95 = 0.0, most = 0.0;
};

// The values of one figure in the order of the rows; rows without it are left out.
std::vector<double> values_of(const std::vector<StoredRow>& rows, const std::string& figure);

// The value below which a share `p` of the sorted values lies, between neighbours in a straight line. `sorted` holds
// one or more.
double quantile(const std::vector<double>& sorted, double p);

// Of one value or more.
Spread spread_of(std::vector<double> values);

// Figures that more than one row has, by name; `main_only`: those that a page has room for.
std::vector<std::string> figures_in(const std::vector<StoredRow>& rows, bool main_only);

// The rows with the worst results, the worst first: failures by number, then successes by `figure`, of which a small
// value is bad where its name says clearance or min_, a large one elsewhere. At most `count`.
std::vector<const StoredRow*> worst_rows(const std::vector<StoredRow>& rows, const std::string& figure,
                                         std::size_t count);

// Rows by their swept values, as JSON text; one group without a name where nothing is swept.
std::map<std::string, std::vector<StoredRow>> by_sweep(const Stored& stored);

}  // namespace liana::campaign
