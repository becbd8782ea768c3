// Requests of the API, as the server and the service take them: JSON, stops however they are written, ranges.
#include "host/api/server/request_bounds.hpp"
#include "host/api/server/request_check.hpp"
#include "host/api/server/request_error.hpp"
#include "host/api/server/stop_packet.hpp"
#include "host/base/json/json.hpp"
#include "tests/fuzz/fuzz.hpp"
#include "tests/host/api/server/robots.hpp"

using namespace liana;

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  static const api::RequestBounds kBounds = api::request_bounds(api::zhu2022_json());
  const std::string_view packet = fuzz::text_of(data, size);
  api::read_stop(packet);
  return fuzz::refusing([&] {
    const Json request = Json::parse(packet);
    const Json again = Json::parse(request.dump(-1, Json::BadUtf8::kReplace));
    if (!request.is_object()) return;
    const api::RequestRow& row = api::row_of(again);
    api::checked(row, again, kBounds);
  });
}
