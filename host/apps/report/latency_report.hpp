// What `liana latency` says of a measurement.
#pragma once

#include <string>

#include "host/apps/report/doctor.hpp"
#include "host/apps/report/latency_measurement.hpp"
#include "host/model/config/config.hpp"

namespace liana::report {

// The measurement as JSON: rate_hz, seconds, buses, enabled, ticks, wakeup_us, tick_us, overruns, overrun_causes,
// realtime.
Json latency_report(const LatencyMeasurement& measured, const config::BusesConfig& buses, double seconds,
                    const std::vector<Finding>& realtime);

// The report for people: table, histogram, verdict, and what the machine lacks.
std::string latency_text(const Json& report);

// Lines of a histogram with bins 0, 1, 2-3, 4-7, ... us from buckets [[us,count],...]; bars grow with the logarithm of
// the count, so that one late wake-up in a million is seen. Empty bins at both ends are left out.
std::string histogram_text(const Json& buckets);

}  // namespace liana::report
