// Telemetry of a long span, a minute at a time: what is held at once does not grow with it.
#pragma once

#include <cstdint>
#include <functional>
#include <string>

#include "host/storage/archive/reader.hpp"

namespace liana::archive {

class Stretches {
 public:
  // Throws std::runtime_error when there is no telemetry in the span.
  Stretches(const Reader& reader, Span span);
  // Every record with the facts that hold then, in order; returns how many there were.
  std::uint64_t visit(const std::function<void(const std::string& record, const Json& facts)>& take) const;

 private:
  const Reader& reader_;
  Span span_;
};

}  // namespace liana::archive
