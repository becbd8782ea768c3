#include "host/apps/ground/ground_store.hpp"

#include <poll.h>
#include <sys/socket.h>

#include <array>
#include <cerrno>
#include <chrono>
#include <utility>

#include "host/base/clock/steady.hpp"

namespace liana::ground {
namespace {

constexpr int kPatience_ms = 100;
constexpr double kConnect_s = 1.0, kCommit_s = 0.5, kRemove_s = 60.0;
constexpr std::uint16_t kStoreSource = 15;  // of its telecommands

constexpr const char* kTable =
    "CREATE TABLE IF NOT EXISTS packets (apid INTEGER NOT NULL, count INTEGER NOT NULL, time_us INTEGER NOT NULL, "
    "service INTEGER, subtype INTEGER, packet BLOB NOT NULL, PRIMARY KEY (time_us, apid, count)) WITHOUT ROWID";

std::string question(std::uint16_t count, const Gaps::Span& span) {
  Telecommand out;
  out.primary.apid = kArmApid;
  out.primary.count = count;
  out.service = 15;
  out.subtype = 9;
  out.source = kStoreSource;
  append_whole(out.data, 1, 1);
  append_whole(out.data, 1, 1);
  append_time(out.data, span.from_us);
  append_time(out.data, span.to_us);
  return telecommand_bytes(out);
}

class Keeper {
 public:
  Keeper(const StoreConfig& config, const std::function<void(const std::string&)>& news)
      : config_(config), news_(news), file_(config.file, archive::Database::Open::kQuick) {
    file_.begin(gaps_, timing::steady_s());
  }

  void step() {
    now_s_ = timing::steady_s();
    connect();
    read();
    ask();
    if (now_s_ - committed_s_ > kCommit_s) commit();
    if (gaps_.open() != reported_) report();
  }
  StoreCounts end() {
    file_.commit();
    counts_.found = gaps_.found();
    counts_.filled = gaps_.filled();
    counts_.lost = gaps_.lost() + (gaps_.found() - gaps_.filled() - gaps_.lost());
    return counts_;
  }

 private:
  void connect() {
    if (fd_.get() >= 0 || now_s_ - tried_s_ < kConnect_s) return;
    tried_s_ = now_s_;
    stream_ = PacketStream();
    fd_ = api::connect_at(api::Transport::kTcp, config_.telemetry);
  }

  void read() {
    pollfd watched{fd_.get(), POLLIN, 0};
    ::poll(&watched, 1, kPatience_ms);
    if (fd_.get() < 0 || watched.revents == 0) return;
    std::array<char, 65536> bytes{};
    const ssize_t count = ::recv(fd_.get(), bytes.data(), bytes.size(), 0);
    if (count < 0 && (errno == EAGAIN || errno == EINTR)) return;
    if (count > 0) stream_.add({bytes.data(), static_cast<std::size_t>(count)});
    while (const auto packet = stream_.next()) take(*packet);
    if (count <= 0 || stream_.is_lost()) fd_ = api::UniqueFd();
  }

  void take(const std::string& packet) {
    const auto telemetry = read_telemetry(packet);
    if (!telemetry) {
      ++counts_.unreadable;
      return;
    }
    ++(file_.add(*telemetry, packet) ? counts_.packets : counts_.again);
    gaps_.take(*telemetry, now_s_);
  }

  // Where no network leads there yet nothing counts as asked for.
  void ask() {
    if (asks_.get() < 0) asks_ = api::connect_at(api::Transport::kUdp, config_.telecommand);
    if (asks_.get() < 0) return;
    const auto span = gaps_.ask(now_s_);
    if (!span) return;
    const std::string packet = question(static_cast<std::uint16_t>(counts_.questions++ % kCountModulus), *span);
    (void)::send(asks_.get(), packet.data(), packet.size(), MSG_NOSIGNAL);
  }

  void commit() {
    committed_s_ = now_s_;
    if (now_s_ - removed_s_ > kRemove_s) {
      removed_s_ = now_s_;
      file_.remove_old(config_.keep_s);
    }
    file_.commit();
  }

  void report() {
    reported_ = gaps_.open();
    news_(std::to_string(reported_) + " gaps open; " + std::to_string(gaps_.found()) + " packets were missing, " +
          std::to_string(gaps_.filled()) + " of them have come, " + std::to_string(gaps_.lost()) + " are lost");
  }

  StoreConfig config_;
  std::function<void(const std::string&)> news_;
  PacketFile file_;
  Gaps gaps_;
  StoreCounts counts_;
  api::UniqueFd fd_, asks_;
  PacketStream stream_;
  std::size_t reported_ = 0;
  double now_s_ = 0.0, tried_s_ = -1e9, committed_s_ = 0.0, removed_s_ = 0.0;
};

}  // namespace

PacketFile::PacketFile(const std::string& path, archive::Database::Open how) : database_(path, how) {
  if (how == archive::Database::Open::kRead) return;
  database_.run(kTable);
  insert_.emplace(database_, "INSERT OR IGNORE INTO packets VALUES (?, ?, ?, ?, ?, ?) RETURNING 1");
}

bool PacketFile::add(const Telemetry& telemetry, const std::string& packet) {
  if (!transaction_) transaction_.emplace(database_);
  const PrimaryHeader& primary = telemetry.primary;
  const archive::Blob blob{packet};
  if (primary.has_secondary) {
    insert_->bind(primary.apid, primary.count, time_of(telemetry), telemetry.service, telemetry.subtype, blob);
  } else {
    insert_->bind(primary.apid, primary.count, time_of(telemetry), nullptr, nullptr, blob);
  }
  const bool is_new = insert_->step();
  while (insert_->step()) {
  }
  return is_new;
}

void PacketFile::commit() {
  if (transaction_) transaction_->commit();
  transaction_.reset();
}

void PacketFile::remove_old(double keep_s) {
  archive::Statement(database_, "DELETE FROM packets WHERE time_us < (SELECT max(time_us) FROM packets) - ?")
      .run(static_cast<std::int64_t>(1e6 * keep_s));
}

void PacketFile::begin(Gaps& gaps, double now_s) const {
  std::vector<Telemetry> together;
  read([&](const std::string& packet) {
    auto telemetry = read_telemetry(packet);
    if (!telemetry) return;
    if (!together.empty() && time_of(*telemetry) != time_of(together.front()))
      gaps.take_together(std::exchange(together, {}), now_s);
    together.push_back(std::move(*telemetry));
  });
  gaps.take_together(std::move(together), now_s);
}

void PacketFile::read(const std::function<void(const std::string& packet)>& take) const {
  archive::Statement all(database_, "SELECT packet FROM packets ORDER BY time_us, apid, count");
  all.bind();
  while (all.step()) take(all.text(0));
}

StoreCounts keep_telemetry(const StoreConfig& config, const std::atomic<bool>& ended,
                           const std::function<void(const std::string& line)>& news) {
  Keeper keeper(config, news);
  while (!ended) keeper.step();
  return keeper.end();
}

}  // namespace liana::ground
