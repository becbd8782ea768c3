#include "host/apps/gateway/http_answer.hpp"

#include <unistd.h>

#include <algorithm>
#include <array>
#include <vector>

namespace liana::gateway {
namespace {

constexpr const char* kHtml = "text/html; charset=utf-8";
constexpr int kClose = -1;  // for the library
constexpr std::size_t kHeaderRoom = 2048;

struct Header {
  const char* name;
  const char* value;
};

// The page is one file: it loads nothing, and talks to nobody but us. Its script stands in it, or comes out of it.
constexpr std::array<Header, 6> kHeaders{
    {{"content-security-policy:",
      "default-src 'none'; script-src 'unsafe-inline' blob:; style-src 'unsafe-inline'; img-src data: blob:; "
      "connect-src 'self' data: blob:; worker-src blob:; frame-ancestors 'none'; base-uri 'none'; form-action 'none'"},
     {"x-content-type-options:", "nosniff"},
     {"x-frame-options:", "DENY"},
     {"referrer-policy:", "no-referrer"},
     {"cache-control:", "no-store"},
     {"connection:", "close"}}};

// Two policies hold together: this one takes the origin from a page, and the connections to this gateway.
constexpr Header kForeign{"content-security-policy:", "sandbox allow-scripts allow-downloads; connect-src data: blob:"};

bool add_header(lws* connection, const Header& header, unsigned char** at, unsigned char* end) {
  const auto* name = reinterpret_cast<const unsigned char*>(header.name);
  const auto* value = reinterpret_cast<const unsigned char*>(header.value);
  const int length = static_cast<int>(std::string_view(header.value).size());
  return lws_add_http_header_by_name(connection, name, value, length, at, end) == 0;
}

bool add_headers(lws* connection, unsigned char** at, unsigned char* end) {
  return std::all_of(kHeaders.begin(), kHeaders.end(),
                     [&](const Header& header) { return add_header(connection, header, at, end); });
}

constexpr std::string_view kNoPage =
    "<!DOCTYPE html><html lang=\"en\"><meta charset=\"utf-8\"><title>Liana</title><body "
    "style=\"font-family:sans-serif\">"
    "<h1>The page is not built</h1><p>This gateway runs, and programs can talk to it. Build the page with "
    "<code>./dev view</code> in Liana's folder, then load this again.</p></body></html>";

}  // namespace

int answer_http(lws* connection, unsigned int status, const char* content_type, std::string_view body) {
  std::vector<unsigned char> buffer(LWS_PRE + kHeaderRoom + body.size());
  unsigned char* const start = buffer.data() + LWS_PRE;
  unsigned char* const end = start + kHeaderRoom;
  unsigned char* at = start;
  if (lws_add_http_common_headers(connection, status, content_type, body.size(), &at, end) != 0 ||
      !add_headers(connection, &at, end) || lws_finalize_write_http_header(connection, start, &at, end) != 0)
    return kClose;
  std::copy(body.begin(), body.end(), start);
  lws_write(connection, start, body.size(), LWS_WRITE_HTTP_FINAL);  // what is left of it goes before the end
  return kClose;
}

int answer_page(lws* connection, const std::string& file, PageSource source) {
  if (access(file.c_str(), R_OK) != 0) return answer_http(connection, HTTP_STATUS_OK, kHtml, kNoPage);
  std::array<unsigned char, LWS_PRE + kHeaderRoom> buffer{};
  unsigned char* at = buffer.data() + LWS_PRE;
  unsigned char* const start = at;
  unsigned char* const end = buffer.data() + buffer.size();
  if (!add_headers(connection, &at, end)) return kClose;
  if (source == PageSource::kForeign && !add_header(connection, kForeign, &at, end)) return kClose;
  const int sent = lws_serve_http_file(connection, file.c_str(), kHtml, reinterpret_cast<const char*>(start),
                                       static_cast<int>(at - start));
  return sent == 0 ? 0 : kClose;  // 0: the rest follows
}

}  // namespace liana::gateway
