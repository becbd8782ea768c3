// What the ground may send: any octets as packets, as a stream, and as telemetry, to an end whose lianad says anything.
#include "host/apps/ground/gaps.hpp"
#include "host/apps/ground/on_board.hpp"
#include "tests/fuzz/fuzz.hpp"

using namespace liana;

namespace {

// A telecommand with a right header and checksum around these octets, so that arguments are reached.
std::string closed(std::string_view data) {
  ground::Telecommand out;
  out.primary.apid = ground::kArmApid;
  out.service = static_cast<std::uint8_t>(fuzz::choice(data));
  out.subtype = static_cast<std::uint8_t>(fuzz::choice(data));
  out.acknowledge = static_cast<std::uint8_t>(fuzz::choice(data));
  out.data = data;
  return ground::telecommand_bytes(out);
}

void receive(ground::OnBoard& end, std::string_view bytes) {
  const unsigned how = fuzz::choice(bytes);
  if (how % 3 == 0) return end.receive(bytes);
  if (how % 3 == 1) return end.receive(closed(bytes));
  ground::PacketStream stream;
  while (!bytes.empty() && !stream.is_lost()) {
    const std::string_view part = bytes.substr(0, 1 + fuzz::choice(bytes));
    stream.add(part);
    bytes.remove_prefix(part.size());
    while (const auto packet = stream.next()) end.receive(*packet);
  }
}

// What comes down is telemetry that the dictionary reads.
void check(const std::string& packet, const ground::Sizes& sizes) {
  const auto telemetry = ground::read_telemetry(packet);
  if (!telemetry || ground::find_report(*telemetry) == nullptr) std::abort();
  (void)ground::report_json(*telemetry, sizes);
}

}  // namespace

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  const std::string_view bytes = fuzz::text_of(data, size);
  ground::Sizes sizes;
  ground::OnBoard end({1.0, 10000}, {[&](const std::string& packet) { check(packet, sizes); },
                                     [](const Json&) { return true; }, [] {}});
  ground::Gaps gaps;
  std::string_view rest = bytes;
  for (double now_s = 0.0; !rest.empty() && now_s < 20.0; now_s += 0.3) {
    end.set_time(now_s, static_cast<std::uint64_t>(1e6 * now_s));
    const std::string_view part = rest.substr(0, 1 + fuzz::choice(rest));
    rest.remove_prefix(part.size());
    receive(end, part);
    end.tick();
    if (const auto telemetry = ground::read_telemetry(part)) gaps.take(*telemetry, now_s);
    (void)gaps.ask(now_s);
  }
  // What a decoder answers: values or a refusal in words.
  for (const ground::CommandRow& row : ground::commands()) {
    if (row.service == 8) fuzz::refusing([&] { (void)ground::request_of(row, {2, 3}, bytes); });
  }
  return fuzz::refusing([&] {
    if (const auto telemetry = ground::read_telemetry(bytes)) (void)ground::report_json(*telemetry, {10, 15});
  });
}
