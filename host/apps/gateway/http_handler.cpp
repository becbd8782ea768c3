#include "host/apps/gateway/http_handler.hpp"

#include <strings.h>

#include <array>
#include <string_view>

#include "host/apps/gateway/http_answer.hpp"
#include "host/apps/gateway/metrics.hpp"
#include "host/apps/gateway/run_pages.hpp"
#include "host/apps/gateway/web_origin.hpp"
#include "host/base/json/json.hpp"

namespace liana::gateway {
namespace {

constexpr const char* kPlain = "text/plain; charset=utf-8";
constexpr const char* kJson = "application/json";
constexpr std::string_view kRun = "/run/";

std::string header(lws* wsi, lws_token_indexes which) {
  const int length = lws_hdr_total_length(wsi, which);
  if (length <= 0) return "";
  std::string text(static_cast<std::size_t>(length) + 1, '\0');
  const int copied = lws_hdr_copy(wsi, text.data(), length + 1, which);
  text.resize(copied > 0 ? static_cast<std::size_t>(copied) : 0);
  return text;
}

std::string query(lws* wsi, const char* name) {
  std::array<char, 128> text{};
  const char* found = lws_get_urlarg_by_name(wsi, name, text.data(), static_cast<int>(text.size()));
  return found == nullptr ? "" : found;
}

}  // namespace

std::string peer_of(lws* wsi) {
  std::array<char, 64> text{};
  lws_get_peer_simple(wsi, text.data(), text.size());
  return text.data();
}

// What is wrong with who asks, whatever is asked for.
std::optional<std::string> HttpHandler::problem(lws* wsi, const char** what) const {
  const std::string host = header(wsi, WSI_TOKEN_HOST), origin = header(wsi, WSI_TOKEN_ORIGIN);
  *what = "plain_http";
  if (options_.is_tls() && lws_is_ssl(wsi) == 0) return "use https: nothing is served in the clear here";
  *what = "host";
  const bool is_named = host == options_.listen.web_host() + ":" + std::to_string(port);
  if (options_.listen.is_loopback() && !is_named && !is_loopback_host(host, port))
    return "host '" + host + "': allowed are 127.0.0.1, localhost and [::1] with the port";
  *what = "cross_origin";
  if (!is_own_origin(origin, options_.is_tls() ? "https" : "http", host))
    return "origin '" + origin + "': allowed are pages of this gateway";
  return std::nullopt;
}

int HttpHandler::refuse(lws* wsi, const char* what, unsigned int status, const std::string& why) {
  gateway_.refused(what, peer_of(wsi), why);
  return answer_http(wsi, status, kPlain, why + "\n");
}

// The library asks for every upgrade that it knows (HTTP/2, too), and once more after it has refused one that it does
// not know: by then the request is gone.
int HttpHandler::admit(lws* wsi) {
  strangers.asked(wsi);
  const std::string wanted = header(wsi, WSI_TOKEN_UPGRADE);
  if (wanted.empty()) return -1;
  const char* what = "";
  if (const auto why = problem(wsi, &what)) return refuse(wsi, what, HTTP_STATUS_FORBIDDEN, *why);
  if (strcasecmp(wanted.c_str(), "websocket") != 0)
    return refuse(wsi, "protocol", HTTP_STATUS_BAD_REQUEST, "upgrade to '" + wanted + "': allowed is websocket");
  const std::string path = header(wsi, WSI_TOKEN_GET_URI);
  if (path != "/ws") return refuse(wsi, "path", HTTP_STATUS_NOT_FOUND, "'" + path + "': the WebSocket is /ws");
  if (header(wsi, WSI_TOKEN_PROTOCOL) != kProtocol)
    return refuse(wsi, "protocol", HTTP_STATUS_BAD_REQUEST, std::string("the subprotocol is ") + kProtocol);
  if (gateway_.is_full())
    return refuse(wsi, "too_many", HTTP_STATUS_SERVICE_UNAVAILABLE, "32 clients are connected already");
  return 0;
}

int HttpHandler::look_at(lws* wsi) {
  const bool has_body = lws_hdr_total_length(wsi, WSI_TOKEN_HTTP_CONTENT_LENGTH) != 0 ||
                        lws_hdr_total_length(wsi, WSI_TOKEN_HTTP_TRANSFER_ENCODING) != 0;
  if (lws_hdr_total_length(wsi, WSI_TOKEN_GET_URI) != 0 && !has_body) return 0;
  return refuse(wsi, "method", HTTP_STATUS_METHOD_NOT_ALLOWED, "allowed is GET without a body");
}

int HttpHandler::serve(lws* wsi, const std::string& path) {
  strangers.asked(wsi);
  if (path == "/health")
    return answer_http(wsi, HTTP_STATUS_OK, kPlain, "ok\n");  // for everybody: it says nothing else
  const char* what = "";
  if (const auto why = problem(wsi, &what)) return refuse(wsi, what, HTTP_STATUS_FORBIDDEN, *why);
  if (path == "/") return answer_page(wsi, options_.page, PageSource::kOwn);
  const bool about_runs = !options_.runs.empty() && (path == "/runs" || path.starts_with(kRun));
  const bool is_metrics = path == "/metrics";
  const std::string ticket = query(wsi, "ticket="), run = about_runs && path != "/runs" ? path.substr(kRun.size()) : "";
  if ((about_runs || is_metrics) && !gateway_.lets_in(ticket, run))
    return refuse(wsi, "no_token", HTTP_STATUS_FORBIDDEN,
                  "'" + path + "': takes ?ticket= of " + (run.empty() ? "the welcome" : "this run in /runs"));
  if (is_metrics) return answer_http(wsi, HTTP_STATUS_OK, kMetricsType, gateway_.metrics());
  if (about_runs && path == "/runs")
    return answer_http(wsi, HTTP_STATUS_OK, kJson, run_list(options_.runs, ticket).dump());
  if (about_runs) strangers.leave(wsi);
  const auto page = about_runs ? run_page(options_.runs, run) : std::nullopt;
  if (page) return answer_page(wsi, *page, PageSource::kForeign);
  return refuse(wsi, "path", HTTP_STATUS_NOT_FOUND, "'" + path + "': nothing is there");
}

}  // namespace liana::gateway
