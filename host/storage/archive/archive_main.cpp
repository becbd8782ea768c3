// liana-archive: the flight recorder of a run. Writes what lianad says into an archive (docs/reference/archive.md),
// every tick into its ring and, with --record, into MCAP files. lianad itself writes none of them.
#include <csignal>
#include <cstdio>
#include <ctime>
#include <exception>
#include <optional>
#include <thread>
#include <utility>

#include "host/api/server/client.hpp"
#include "host/base/json/json.hpp"
#include "host/base/options/command_line.hpp"
#include "host/base/text/text_output.hpp"
#include "host/storage/archive/alarms.hpp"
#include "host/storage/archive/inbox.hpp"
#include "host/storage/archive/recorder.hpp"
#include "host/storage/archive/ring_thread.hpp"
#include "host/storage/recording/build_id.hpp"
#include "host/storage/recording/recording.hpp"
#include "host/storage/recording/state_recording.hpp"

namespace {

using liana::Json;
using liana::archive::Inbox;

volatile std::sig_atomic_t g_stop = 0;
void on_signal(int) { g_stop = 1; }

std::string utc_now() {
  char text[32];
  const std::time_t now = std::time(nullptr);
  std::tm parts{};
  std::strftime(text, sizeof text, "%Y-%m-%dT%H:%M:%SZ", gmtime_r(&now, &parts));
  return text;
}

liana::recording::RecordingInfo info_from(const Json& welcome) {
  if (welcome.value("op", "") != "welcome") throw std::runtime_error("lianad refused the archive: " + welcome.dump());
  return {welcome.at("config_hash"),  welcome.at("robot").dump(), welcome.at("scene").dump(),
          welcome.at("buses").dump(), welcome.at("time_mode"),    welcome.at("period_s")};
}

liana::archive::Life life_from(const liana::recording::RecordingInfo& info) {
  return {info.config_hash, info.robot_json, info.scene_json, info.buses_json,
          info.time_mode,   info.period_s,   utc_now(),       "liana " + liana::recording::build_id()};
}

// Where everything goes: the archive and, with --record, the files of every tick and of every state as it came.
class Books {
 public:
  Books(const std::string& folder, const std::string& record, const Json& welcome, liana::archive::Alarms& alarms)
      : info_(info_from(welcome)),
        life_(life_from(info_)),
        recorder_(folder, life_, welcome.at("interval_ticks"), {}, welcome.at("events").at("next"),
                  [&alarms](const std::string& text, std::uint64_t count) { alarms.add(text, count); }) {
    if (record.empty()) return;
    ticks_.emplace(record, info_);
    states_.emplace(record, info_.period_s);
  }
  void take(Inbox::Letter letter) {
    if (letter.message.is_null()) {
      if (ticks_) ticks_->take(letter.packet);
      return;
    }
    const std::string op = letter.message.value("op", "");
    if (op == "gap") return recorder_.note_gap(liana::archive::gap_from(letter.message));
    if (states_ && (op == "event" || op == "events_lost")) states_->take_event(letter.packet, letter.message);
    if (states_ && op == "state") states_->take(letter.packet, letter.message);
    recorder_.take(std::move(letter.message));
  }
  void finish() {
    recorder_.finish();
    if (ticks_) ticks_->finish();
    if (states_) states_->finish();
  }
  const liana::archive::Life& life() const { return life_; }
  std::uint64_t life_number() const { return recorder_.life(); }
  bool is_whole() const { return !recorder_.was_disk_full(); }
  void tell(const std::string& record) const {
    const auto number = [](std::uint64_t count) { return static_cast<unsigned long long>(count); };
    std::printf("liana-archive: %llu states, %llu events and commands durable, %llu lost\n", number(recorder_.states()),
                number(recorder_.durable()), number(recorder_.lost()));
    if (!ticks_) return;
    std::printf("liana-archive: %llu ticks in %s/%s, %llu dropped, %llu events lost\n", number(ticks_->ticks()),
                record.c_str(), liana::recording::kRecordingFile, number(ticks_->dropped()),
                number(states_->events_lost()));
  }

 private:
  liana::recording::RecordingInfo info_;
  liana::archive::Life life_;
  liana::archive::Recorder recorder_;
  std::optional<liana::recording::Recording> ticks_;
  std::optional<liana::recording::StateRecording> states_;
};

// Until lianad ends or a signal comes. A state is answered with done, so that in lockstep time no tick is ever lost.
void read_until_end(liana::api::ApiClient& client, Inbox& inbox, liana::archive::RingThread& ring,
                    liana::archive::Alarms& alarms, bool records_ticks) {
  std::string packet;
  while (g_stop == 0 && !inbox.is_closed()) {
    if (!client.receive_bytes(packet, 0.5)) continue;
    Json message;
    if (packet[0] == '{') message = Json::parse(packet);
    if (message.is_object() && message.value("op", "") == "state") {
      if (const auto alarm = alarms.take()) client.send(*alarm);
      client.send({{"op", "done"}, {"tick", message.at("tick")}});
    }
    ring.take(packet, message);
    if (!message.is_null() || records_ticks) inbox.put({std::move(packet), std::move(message)});
  }
}

// Writes until the inbox is closed and empty; what goes wrong closes it.
std::exception_ptr write_until_closed(Books& books, Inbox& inbox) {
  try {
    while (auto letter = inbox.take()) books.take(std::move(*letter));
    return nullptr;
  } catch (...) {
    inbox.close();
    return std::current_exception();
  }
}

Json hello() {
  return {{"op", "hello"},
          {"name", "archive"},
          {"role", "archive"},
          {"lockstep", true},
          {"subscribe", {"state", "event", "tick"}},
          {"events_from", 1}};
}

int run(const std::string& api, const std::string& folder, const std::string& record) {
  liana::api::ApiClient client = liana::api::ApiClient::connect(api, 10.0);
  client.send(hello());
  const std::optional<Json> welcome = client.receive(30.0);
  if (!welcome) throw std::runtime_error("lianad did not answer the archive's hello within 30 s");
  liana::archive::Alarms alarms;
  Books books(folder, record, *welcome, alarms);
  Inbox inbox;
  std::exception_ptr problem;
  std::thread writer([&] { problem = write_until_closed(books, inbox); });
  liana::archive::RingThread ring(folder, books.life_number(), books.life(), inbox);
  try {
    read_until_end(client, inbox, ring, alarms, !record.empty());
  } catch (const std::runtime_error& gone) {
    std::fprintf(stderr, "liana-archive: %s; finishing the recording\n", gone.what());
  }
  ring.finish();
  inbox.close();
  writer.join();
  books.finish();
  if (problem) std::rethrow_exception(problem);
  books.tell(record);
  ring.tell();
  return books.is_whole() && ring.is_good() ? 0 : 1;
}

}  // namespace

int main(int argc, char** argv) {
  liana::text::print_only_text();
  std::string api, folder, record;
  liana::options::CommandLine line("The flight recorder: events, commands, telemetry and every tick of a run");
  line.option("--api", api, "API socket of lianad").required();
  line.option("--archive", folder, "folder for archive.db, telemetry and ring; where not given, that of --record")
      .existing_folder();
  line.option("--record", record, "folder for ticks.mcap, snapshots.mcap and state.mcap").existing_folder();
  if (const auto code = line.parse(argc, argv)) return *code;
  if (folder.empty()) folder = record;
  if (folder.empty()) {
    std::fputs("liana-archive: nowhere to write; give --archive or --record\n", stderr);
    return 2;
  }
  std::signal(SIGXFSZ, SIG_IGN);
  std::signal(SIGTERM, on_signal);
  std::signal(SIGINT, on_signal);
  try {
    return run(api, folder, record);
  } catch (const std::exception& error) {
    std::fprintf(stderr, "liana-archive: %s\n", error.what());
    return 1;
  }
}
