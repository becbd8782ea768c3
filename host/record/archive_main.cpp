// liana-archive: takes tick records from lianad and writes what lasts. lianad itself writes no files.
#include <csignal>
#include <cstdio>

#include "host/api/client.hpp"
#include "host/command_line/command_line.hpp"
#include "host/json/json.hpp"
#include "host/record/recording.hpp"
#include "host/record/state_recording.hpp"

namespace {

volatile std::sig_atomic_t g_stop = 0;
void on_signal(int) { g_stop = 1; }

liana::record::RecordingInfo info_from(const liana::Json& welcome) {
  if (welcome.value("op", "") != "welcome") throw std::runtime_error("lianad refused the archive: " + welcome.dump());
  return {welcome.at("config_hash"),  welcome.at("robot").dump(), welcome.at("scene").dump(),
          welcome.at("buses").dump(), welcome.at("time_mode"),    welcome.at("period_s")};
}

// Until lianad ends or a signal comes. A state is answered with done, so that in lockstep time no tick is ever lost.
void record_until_end(liana::api::ApiClient& client, liana::record::Recording& recording,
                      liana::record::StateRecording& states) {
  std::string packet;
  while (g_stop == 0) {
    if (!client.receive_bytes(packet, 0.5)) continue;
    if (packet[0] != '{') {
      recording.take(packet);
      continue;
    }
    const liana::Json message = liana::Json::parse(packet);
    const std::string op = message.value("op", "");
    if (op == "event" || op == "events_lost") states.take_event(packet, message);
    if (op != "state") continue;
    client.send({{"op", "done"}, {"tick", message.at("tick")}});
    states.take(packet, message);
  }
}

int run(const std::string& api, const std::string& directory) {
  liana::api::ApiClient client = liana::api::ApiClient::connect(api, 10.0);
  client.send({{"op", "hello"},
               {"name", "archive"},
               {"role", "archive"},
               {"lockstep", true},
               {"subscribe", {"tick", "state", "event"}},
               {"events_from", 1}});
  const std::optional<liana::Json> welcome = client.receive(30.0);
  if (!welcome) throw std::runtime_error("lianad did not answer the archive's hello within 30 s");
  const liana::record::RecordingInfo info = info_from(*welcome);
  liana::record::Recording recording(directory, info);
  liana::record::StateRecording states(directory, info.period_s);
  try {
    record_until_end(client, recording, states);
  } catch (const std::runtime_error& gone) {
    std::fprintf(stderr, "liana-archive: %s; finishing the recording\n", gone.what());
  }
  recording.finish();
  states.finish();
  std::printf("liana-archive: %llu ticks in %s/%s, %llu dropped, %llu events lost\n",
              static_cast<unsigned long long>(recording.ticks()), directory.c_str(), liana::record::kRecordingFile,
              static_cast<unsigned long long>(recording.dropped()),
              static_cast<unsigned long long>(states.events_lost()));
  return 0;
}

}  // namespace

int main(int argc, char** argv) {
  std::string api, directory;
  liana::command_line::CommandLine line("Writes the recording of a run (ticks.mcap)");
  line.option("--api", api, "API socket of lianad").required();
  line.option("--record", directory, "folder for ticks.mcap").required().existing_folder();
  if (const auto code = line.parse(argc, argv)) return *code;
  std::signal(SIGTERM, on_signal);
  std::signal(SIGINT, on_signal);
  try {
    return run(api, directory);
  } catch (const std::exception& error) {
    std::fprintf(stderr, "liana-archive: %s\n", error.what());
    return 1;
  }
}
