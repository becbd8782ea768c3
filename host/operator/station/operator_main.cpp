// liana-operator: people at the input devices, over the interface that live devices use.
#include <cmath>
#include <cstdio>
#include <fstream>
#include <memory>
#include <sstream>
#include <utility>

#include "host/api/server/client.hpp"
#include "host/base/json/json.hpp"
#include "host/base/options/command_line.hpp"
#include "host/base/text/text_output.hpp"
#include "host/model/config/config.hpp"
#include "host/operator/simulated/own_devices.hpp"
#include "host/operator/station/run_statistics.hpp"
#include "host/operator/station/steering.hpp"

namespace liana::station {
namespace {

constexpr double kWelcomeTimeout_s = 30.0;
constexpr double kPoll_s = 1.0;

// Command line of liana-operator.
struct OperatorOptions {
  std::string api;
  std::string devices;     // empty: beside the API socket
  std::string recordings;  // folders, separated by ':'
  std::string scene;       // empty: the scene lianad runs with
  std::string who = "recorded";
  std::string feedback;  // empty: as every step of the mission says
  std::string passivity = "on";
  std::string fixtures = "on";
  std::string delay = "0,0";
  std::string temper = "gentle";
  std::string figures;  // empty: nobody asks
  std::uint64_t seed = 1;
  bool lockstep = false;
};

Pose pose_of(const config::ScenePose& pose) { return {pose.position_m, pose.quaternion_wxyz}; }

// Without a slit or a rod there is nothing to steer into by hand: the camera never shows it, and the person waits.
simulated::SlitModel drawing_of(const config::SceneConfig& scene) {
  if (!scene.slit || !scene.rod) return {};
  return simulated::slit_drawing(pose_of(scene.slit->frame), pose_of(scene.rod->pose));
}

std::vector<std::string> folders_in(const std::string& list) {
  std::vector<std::string> folders;
  std::istringstream stream(list);
  for (std::string folder; std::getline(stream, folder, ':');) {
    if (!folder.empty()) folders.push_back(folder);
  }
  return folders;
}

Json greet(api::ApiClient& client, const OperatorOptions& options) {
  client.send({{"op", "hello"},
               {"name", "operator"},
               {"role", "operator"},
               {"lockstep", options.lockstep},
               {"subscribe", {"state", "camera"}}});
  const auto welcome = client.receive(kWelcomeTimeout_s);
  if (!welcome || welcome->value("op", "") != "welcome") {
    throw std::runtime_error("lianad at " + options.api + " did not welcome the operator" +
                             (welcome ? ": " + welcome->dump().substr(0, 200) : ""));
  }
  return *welcome;
}

config::SceneConfig scene_of(const OperatorOptions& options, const Json& welcome) {
  return options.scene.empty() ? config::parse_scene(welcome.at("scene").dump(), "scene of " + options.api)
                               : config::load_scene(options.scene);
}

std::unique_ptr<Steering> human(const OperatorOptions& options, const Json& welcome) {
  const auto buses = config::parse_buses(welcome.at("buses").dump(), "buses of " + options.api);
  const auto robot = config::parse_robot(welcome.at("robot").dump(), "robot of " + options.api, "nominal", buses);
  const haptics::Delays delays = haptics::delays_of(options.delay);
  HumanTable table;
  table.feedback = options.feedback;
  table.passivity = options.passivity == "on";
  table.walls = options.fixtures == "on";
  table.there_and_back_s = delays.forward_s + delays.back_s;
  table.seed = options.seed;
  table.temper = simulated::temper_called(options.temper);
  return std::make_unique<HumanSteering>(HumanSession(table, robot, scene_of(options, welcome)), delays, options.seed);
}

std::unique_ptr<Steering> steering_of(const OperatorOptions& options, const Json& welcome) {
  if (options.who == "model") return human(options, welcome);
  return std::make_unique<RecordedSteering>(
      simulated::OperatorSession(folders_in(options.recordings), drawing_of(scene_of(options, welcome)),
                                 simulated::HandGains{}, options.seed, simulated::temper_called(options.temper)));
}

// The devices' clock is the arm's.
std::int64_t time_us(const Json& state) { return std::llround(state.at("time_s").get<double>() * 1e6); }

// One run of the people at their devices.
struct Run {
  api::ApiClient& client;
  simulated::OwnDevices& devices;
  Steering& steering;
  RunStatistics figures{};
  std::vector<Json> pictures{};  // since the last state
};

// Samples first: with `done` lianad takes them into the interval.
void act(Run& run, const Json& state) {
  run.devices.receive(time_us(state));
  News news{state, std::exchange(run.pictures, {}), std::nullopt};
  if (const liana_state* told = run.devices.controller_state(time_us(state))) news.for_device = *told;
  run.figures.arm(state);
  for (const simulated::OperatorAnswer& answer : run.steering.on_news(news)) {
    run.figures.sent(answer);
    run.devices.send(answer.kind, answer.samples);
    run.devices.send(simulated::other_of(answer.kind), answer.aside);
    for (const Json& out : answer.messages) run.client.send(out);
  }
}

// One message in, the answers out; false when lianad stops. The devices leave before the last `done`: a run's events
// do not depend on how quickly this process ends.
bool answer(Run& run, const Json& message, bool lockstep) {
  const std::string op = message.value("op", "");
  if (op == "camera") run.pictures.push_back(message);
  if (op == "error") std::fprintf(stderr, "liana-operator: refused: %s\n", message.value("message", "").c_str());
  if (op != "state") return true;
  act(run, message);
  const bool stopping = message.value("stopping", false);
  if (stopping) run.devices.leave();
  if (lockstep) run.client.send({{"op", "done"}, {"tick", message.at("tick")}});
  return !stopping;
}

void write_figures(const std::string& path, const Json& figures) {
  std::ofstream file(path);
  file << figures.dump(1) << "\n";
  if (!file.flush()) throw std::runtime_error(path + ": cannot be written; give a file in a folder that exists");
}

int operate(const OperatorOptions& options) {
  api::ApiClient client = api::ApiClient::connect(options.api, kWelcomeTimeout_s);
  // Known before the role is taken: missions begin as soon as lianad has its operator.
  simulated::OwnDevices devices(options.devices.empty() ? device::devices_path(options.api) : options.devices,
                                kWelcomeTimeout_s);
  const Json welcome = greet(client, options);
  const std::unique_ptr<Steering> steering = steering_of(options, welcome);
  Run run{client, devices, *steering};
  for (bool running = true; running;) {
    const auto message = client.receive(kPoll_s);
    if (message) running = answer(run, *message, options.lockstep);
  }
  if (!options.figures.empty()) write_figures(options.figures, run.figures.json(steering->figures()));
  return 0;
}

}  // namespace
}  // namespace liana::station

int main(int argc, char** argv) {
  liana::text::print_only_text();
  liana::station::OperatorOptions options;
  liana::options::CommandLine line(
      "The operator as data and as a model that looks: recorded VR handles, simulated handles and hand controller");
  line.option("--api", options.api, "API socket of lianad").required();
  line.option("--devices", options.devices, "socket of lianad for devices; .devices behind that of --api without");
  line.option("--recordings", options.recordings, "folders of the .hand files, separated by ':', searched in turn")
      .required();
  line.option("--scene", options.scene, "scene JSON the person has as a drawing; default: the one lianad runs with");
  line.option("--operator", options.who,
              "recorded: VR handles from a file, a simulated person at the hand controller; model: an operator model "
              "at both")
      .one_of({"recorded", "model"});
  line.option("--feedback", options.feedback,
              "of the model: a law (docs/explanation/force-feedback.md), or off; as the mission's steps say where not "
              "given")
      .one_of({"aligned", "claim", "abstract", "off"});
  line.option("--passivity", options.passivity, "of the model: energy tank and damping").one_of({"on", "off"});
  line.option("--fixtures", options.fixtures, "of the model: the walls that lianad tells are felt")
      .one_of({"on", "off"});
  line.option("--delay", options.delay, "of the model: FORWARD_S,RETURN_S of the link to the arm, each 0 to 2");
  line.option("--temper", options.temper,
              "lively: bursts, reversals, drift, tremor, grips lost in motion, both devices")
      .one_of({"gentle", "lively"});
  line.option("--figures", options.figures, "file for what only the operator knows: lag, force at the hand, energy");
  line.option("--seed", options.seed, "seed of tremor, glitches and dropouts");
  line.flag("--lockstep", options.lockstep, "answer every state, so that fast runs repeat");
  if (const auto code = line.parse(argc, argv)) return *code;
  try {
    return liana::station::operate(options);
  } catch (const std::exception& error) {
    std::fprintf(stderr, "liana-operator: %s\n", error.what());
    return 1;
  }
}
