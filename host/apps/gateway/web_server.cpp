#include "host/apps/gateway/web_server.hpp"

#include <libwebsockets.h>
#include <sys/signalfd.h>
#include <sys/timerfd.h>
#include <unistd.h>

#include <array>
#include <csignal>
#include <cstdio>
#include <cstring>
#include <optional>
#include <stdexcept>
#include <string_view>
#include <vector>

#include "host/apps/gateway/http_handler.hpp"
#include "host/base/net/socket.hpp"
#include "host/base/text/printable.hpp"

namespace liana::gateway {
namespace {

constexpr std::size_t kChunk = 4096;  // of a message, as it is read
constexpr std::size_t kLongestMessage = api::kMaxPacketBytes;
constexpr unsigned int kMaxSockets = 192;                      // clients, strangers, and those who only load the page
constexpr std::uint16_t kPingAfter_s = 10, kGoneAfter_s = 20;  // of silence
constexpr int kLastWord_s = 1;
constexpr long kTick_ns = 100'000'000;
constexpr unsigned int kLongestTurn_s = 10;

// What libwebsockets keeps for every connection.
struct Connection {
  Session* session;
  std::string* message;  // as far as it has been read
};

// The library's log knows no context: what it says goes to the gateway that listened last.
Gateway* told_by_library = nullptr;

void complain(int, const char* line) {
  if (told_by_library != nullptr) told_by_library->complain("libwebsockets", line);
}

// Closes a connection as soon as the library looks at it again.
void drop(lws* wsi) { lws_set_timeout(wsi, PENDING_TIMEOUT_USER_OK, LWS_TO_KILL_ASYNC); }

}  // namespace

struct WebServerInside {
  WebServerInside(const WebOptions& given, Gateway& owner) : options(given), gateway(owner), door(options, owner) {}

  int take(lws* wsi, lws_callback_reasons reason, Connection* connection, void* in, std::size_t length);
  void listen();
  void watch_time_and_signals();
  void run();

  const WebOptions options;
  Gateway& gateway;
  HttpHandler door;
  api::UniqueFd timer, signals;
  bool over = false;
  lws_context* context = nullptr;
  lws_vhost* vhost = nullptr;
  std::vector<unsigned char> buffer;  // of what is being written

  void open(lws* wsi, Connection& connection);
  int read(lws* wsi, Connection& connection, std::string_view piece);
  int write(lws* wsi, Connection& connection);
  int end(lws* wsi, const Session& session);
  void closed(Connection& connection);
  void meet(lws* wsi);
  void drop_overdue();
};

void WebServerInside::meet(lws* wsi) {
  const auto gone = door.strangers.come(wsi, peer_of(wsi), gateway.now_s());
  if (!gone) return;
  lws* const chosen = const_cast<lws*>(static_cast<const lws*>(*gone));
  gateway.refused("too_many", peer_of(chosen), "made room for others before it said hello");
  drop(chosen);
}

void WebServerInside::drop_overdue() {
  for (const Strangers::Id late : door.strangers.overdue(gateway.now_s())) {
    lws* const wsi = const_cast<lws*>(static_cast<const lws*>(late));
    gateway.refused("slow", peer_of(wsi), "said too little in its time");
    drop(wsi);
  }
}

void WebServerInside::open(lws* wsi, Connection& connection) {
  connection.message = new std::string;
  connection.session = &gateway.open(peer_of(wsi), [wsi, &connection] {
    const Session* session = connection.session;
    if (session != nullptr && !session->has_said_much()) lws_rx_flow_control(wsi, 1);
    if (session != nullptr && session->end().code != 0)
      lws_set_timeout(wsi, PENDING_TIMEOUT_CLOSE_SEND, kLastWord_s);  // it may not read any more
    lws_callback_on_writable(wsi);
  });
}

int WebServerInside::end(lws* wsi, const Session& session) {
  std::string reason(text::whole_characters(session.end().text, 120));  // RFC 6455, section 5.5: at most 123 bytes
  lws_close_reason(wsi, static_cast<lws_close_status>(session.end().code),
                   reinterpret_cast<unsigned char*>(reason.data()), reason.size());
  return -1;
}

int WebServerInside::read(lws* wsi, Connection& connection, std::string_view piece) {
  Session& session = *connection.session;
  std::string& message = *connection.message;
  if (session.end().code != 0) return end(wsi, session);
  if (message.size() + piece.size() > kLongestMessage) {
    session.refuse_oversized(gateway.now_s());
    return end(wsi, session);
  }
  message += piece;
  if (lws_remaining_packet_payload(wsi) != 0 || lws_is_final_fragment(wsi) == 0) return 0;
  if (lws_frame_is_binary(wsi) != 0) {
    session.take_binary(message, gateway.now_s());
  } else {
    session.take_text(message, gateway.now_s());
  }
  if (session.is_greeted()) door.strangers.leave(wsi);
  if (session.has_said_much()) lws_rx_flow_control(wsi, 0);
  message.clear();
  if (message.capacity() > kChunk) message.shrink_to_fit();
  return 0;
}

int WebServerInside::write(lws* wsi, Connection& connection) {
  Session& session = *connection.session;
  if (session.end().code != 0) return end(wsi, session);
  const std::optional<Outgoing> next = session.next(gateway.now_s());
  if (!next) return 0;
  buffer.resize(LWS_PRE + next->bytes.size());
  std::memcpy(buffer.data() + LWS_PRE, next->bytes.data(), next->bytes.size());
  const lws_write_protocol kind = next->is_binary ? LWS_WRITE_BINARY : LWS_WRITE_TEXT;
  if (lws_write(wsi, buffer.data() + LWS_PRE, next->bytes.size(), kind) < 0) return -1;
  if (session.has_more()) lws_callback_on_writable(wsi);
  return 0;
}

void WebServerInside::closed(Connection& connection) {
  if (connection.session != nullptr) gateway.gone(*connection.session);
  delete connection.message;
  connection = {};
}

int WebServerInside::take(lws* wsi, lws_callback_reasons reason, Connection* connection, void* in, std::size_t length) {
  const std::string_view bytes(static_cast<const char*>(in), in == nullptr ? 0 : length);
  switch (reason) {
    case LWS_CALLBACK_RAW_RX_FILE:
      gateway.run_ready();
      return 0;
    case LWS_CALLBACK_SERVER_NEW_CLIENT_INSTANTIATED:
      meet(wsi);
      return 0;
    case LWS_CALLBACK_WSI_DESTROY:
      door.strangers.leave(wsi);
      return 0;
    case LWS_CALLBACK_RAW_ADOPT:  // of a CONNECT: nothing would ever end such a connection
    case LWS_CALLBACK_RAW_RX:
      return -1;
    case LWS_CALLBACK_HTTP:
      return door.serve(wsi, std::string(bytes));
    case LWS_CALLBACK_FILTER_HTTP_CONNECTION:
      return door.look_at(wsi);
    case LWS_CALLBACK_HTTP_BODY:
    case LWS_CALLBACK_HTTP_BODY_COMPLETION:
    case LWS_CALLBACK_HTTP_FILE_COMPLETION:
      return -1;
    case LWS_CALLBACK_HTTP_CONFIRM_UPGRADE:
      return door.admit(wsi);
    case LWS_CALLBACK_ESTABLISHED:
      open(wsi, *connection);
      return 0;
    case LWS_CALLBACK_RECEIVE:
      return read(wsi, *connection, bytes);
    case LWS_CALLBACK_SERVER_WRITEABLE:
      return write(wsi, *connection);
    case LWS_CALLBACK_CLOSED:
      closed(*connection);
      return 0;
    default:
      return 0;
  }
}

namespace {

// No exception may cross the library, which is C.
int on_event(lws* wsi, lws_callback_reasons reason, void* user, void* in, std::size_t length) {
  auto* inside = static_cast<WebServerInside*>(lws_context_user(lws_get_context(wsi)));
  try {
    return inside == nullptr ? 0 : inside->take(wsi, reason, static_cast<Connection*>(user), in, length);
  } catch (const std::exception& error) {
    std::fprintf(stderr, "liana-gateway: %s\n", error.what());
    return -1;
  }
}

constexpr lws_protocols protocol(const char* name, std::size_t bytes) {
  lws_protocols made{};
  made.name = name;
  made.callback = on_event;
  made.per_session_data_size = bytes;
  made.rx_buffer_size = kChunk;
  return made;
}

constexpr std::array<lws_protocols, 3> kProtocols{
    {protocol("http", 0), protocol(HttpHandler::kProtocol, sizeof(Connection)), lws_protocols{}}};
constexpr lws_retry_bo_t kIdle{nullptr, 0, 0, kPingAfter_s, kGoneAfter_s, 0};

}  // namespace

void WebServerInside::listen() {
  told_by_library = &gateway;
  lws_set_log_level(LLL_ERR, complain);
  lws_context_creation_info info{};
  info.iface = options.listen.host.c_str();
  info.port = options.listen.port;
  info.protocols = kProtocols.data();
  info.user = this;
  info.pt_serv_buf_size = kChunk;
  info.fd_limit_per_thread = kMaxSockets;
  info.retry_and_idle_policy = &kIdle;
  info.alpn = "http/1.1";  // nothing here needs HTTP/2, and the library's ends the process for some frames
  info.options = LWS_SERVER_OPTION_SKIP_SERVER_CANONICAL_NAME | LWS_SERVER_OPTION_FAIL_UPON_UNABLE_TO_BIND;
  if (options.listen.host.find(':') == std::string::npos) info.options |= LWS_SERVER_OPTION_DISABLE_IPV6;
  if (options.is_tls()) {
    info.ssl_cert_filepath = options.certificate.c_str();
    info.ssl_private_key_filepath = options.key.c_str();
    // Who asks in the clear gets a refusal that can be read, and is logged: HttpHandler.
    info.options |= LWS_SERVER_OPTION_DO_SSL_GLOBAL_INIT | LWS_SERVER_OPTION_ALLOW_NON_SSL_ON_SSL_PORT |
                    LWS_SERVER_OPTION_ALLOW_HTTP_ON_HTTPS_LISTENER;
  }
  context = lws_create_context(&info);
  vhost = context != nullptr ? lws_get_vhost_by_name(context, "default") : nullptr;
  if (vhost == nullptr)
    throw std::runtime_error("--listen " + options.listen.web_host() + ":" + std::to_string(options.listen.port) +
                             ": cannot listen there; take another port (0: a free one), an address of this machine, "
                             "and a certificate and key that can be read");
  door.port = static_cast<std::uint16_t>(lws_get_vhost_listen_port(vhost));
  lws_sock_file_fd_type others{};
  others.filefd = ::dup(gateway.poller().fd());  // the library closes it
  if (lws_adopt_descriptor_vhost(vhost, LWS_ADOPT_RAW_FILE_DESC, others, "http", nullptr) == nullptr)
    throw std::runtime_error("the library does not wait for lianad");
}

void WebServerInside::watch_time_and_signals() {
  timer = api::UniqueFd(timerfd_create(CLOCK_MONOTONIC, TFD_CLOEXEC | TFD_NONBLOCK));
  const itimerspec every{{0, kTick_ns}, {0, kTick_ns}};
  timerfd_settime(timer.get(), 0, &every, nullptr);
  gateway.poller().watch(timer.get(), EPOLLIN, [this](std::uint32_t) {
    std::uint64_t count = 0;
    if (::read(timer.get(), &count, sizeof count) <= 0) return;
    gateway.tick();
    drop_overdue();
  });
  sigset_t wanted;
  sigemptyset(&wanted);
  sigaddset(&wanted, SIGTERM);
  sigaddset(&wanted, SIGINT);
  sigprocmask(SIG_BLOCK, &wanted, nullptr);
  signals = api::UniqueFd(signalfd(-1, &wanted, SFD_CLOEXEC | SFD_NONBLOCK));
  gateway.poller().watch(signals.get(), EPOLLIN, [this](std::uint32_t) { over = true; });
}

// A turn ends ten times a second at least. One that does not is ended by the system: whoever started this process
// starts it again, and a process that hangs would never be.
void WebServerInside::run() {
  while (!over && lws_service(context, 0) >= 0) ::alarm(kLongestTurn_s);
  ::alarm(0);
}

WebServer::WebServer(const WebOptions& options, Gateway& gateway)
    : inside_(std::make_unique<WebServerInside>(options, gateway)) {
  inside_->watch_time_and_signals();
  inside_->listen();
}

WebServer::~WebServer() {
  lws_context_destroy(inside_->context);
  told_by_library = nullptr;
}

std::string WebServer::address() const {
  return std::string(inside_->options.is_tls() ? "https://" : "http://") + inside_->options.listen.web_host() + ":" +
         std::to_string(inside_->door.port) + "/";
}

void WebServer::run() { inside_->run(); }

void WebServer::serve_waiting() {
  constexpr int kAtOnce = -1;  // without waiting for anything to happen
  lws_service(inside_->context, kAtOnce);
}

bool WebServer::take_connection(int fd) {
  lws_sock_file_fd_type socket{};
  socket.sockfd = fd;
  const int tls = inside_->options.is_tls() ? LWS_ADOPT_ALLOW_SSL : 0;
  const auto kind = static_cast<lws_adoption_type>(LWS_ADOPT_SOCKET | LWS_ADOPT_HTTP | tls);
  return lws_adopt_descriptor_vhost(inside_->vhost, kind, socket, nullptr, nullptr) != nullptr;
}

}  // namespace liana::gateway
