#include <charconv>
#include <cmath>

#include "host/api/telemetry/record.hpp"
#include "host/base/file/out_file.hpp"
#include "host/storage/archive/export.hpp"
#include "host/storage/archive/stretches.hpp"

namespace liana::archive {
namespace {

// The shortest text that is read back as the same number.
template <class Number>
void add_number(std::string& line, Number value) {
  line += ',';
  if (!std::isfinite(value)) return;
  char text[32];
  line.append(text, std::to_chars(text, text + sizeof text, value).ptr);
}

std::string heading(const telemetry::Layout& layout, bool is_utc) {
  std::string line = is_utc ? "tick,utc_s,state,step" : "tick,time_s,state,step";
  for (const telemetry::Place& place : layout.places) {
    for (std::size_t i = 1; i <= place.count; ++i) {
      line += ',' + std::string(place.field.path);
      if (place.count > 1) line += '_' + std::to_string(i);
    }
  }
  return line + '\n';
}

std::string line_of(const std::string& record, const telemetry::Layout& layout, const Json& facts, double zero_s) {
  const telemetry::Header header = telemetry::header_of(record);
  std::string line = std::to_string(static_cast<std::uint64_t>(header.tick));
  add_number(line, zero_s + header.time_s);
  line += ',' + facts.value("state", "") + ',';
  if (const Json& index = facts.member_or_null("step").member_or_null("index"); !index.is_null()) line += index.dump();
  for (const telemetry::Place& place : layout.places) {
    for (std::size_t i = 0; i < place.count; ++i) add_number(line, telemetry::value_of(record, place, i));
  }
  return line + '\n';
}

}  // namespace

std::uint64_t write_csv(const Reader& reader, Span span, const std::string& path, double zero_s) {
  Stretches stretches(reader, span);
  file::OutFile out(path);
  out.write(heading(*reader.layout(), zero_s != 0.0));
  const std::uint64_t rows = stretches.visit([&](const std::string& record, const Json& facts) {
    out.write(line_of(record, *reader.layout(), facts, zero_s));
  });
  out.finish();
  return rows;
}

}  // namespace liana::archive
