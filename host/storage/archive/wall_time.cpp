#include <ctime>
#include <stdexcept>

#include "host/storage/archive/export.hpp"

namespace liana::archive {

double begin_utc_s(const Life& life) {
  std::tm parts{};
  const char* const end = strptime(life.started_utc.c_str(), "%Y-%m-%dT%H:%M:%SZ", &parts);
  if (end == nullptr || *end != '\0')
    throw std::runtime_error("archive: began at '" + life.started_utc +
                             "': allowed a time like 2026-01-31T12:00:00Z: leave --wall-time out");
  return static_cast<double>(timegm(&parts));
}

}  // namespace liana::archive
