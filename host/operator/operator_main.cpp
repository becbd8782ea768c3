// liana-operator: the recorded and simulated person at the input devices, over the interface that live devices use.
#include <cmath>
#include <cstdio>
#include <fstream>
#include <sstream>

#include "host/api/client.hpp"
#include "host/command_line/command_line.hpp"
#include "host/config/config.hpp"
#include "host/json/json.hpp"
#include "host/operator/operator_session.hpp"
#include "host/operator/own_devices.hpp"

namespace liana::operator_side {
namespace {

constexpr double kWelcomeTimeout_s = 30.0;
constexpr double kPoll_s = 1.0;

// Command line of liana-operator.
struct OperatorOptions {
  std::string api;
  std::string devices;     // empty: beside the API socket
  std::string recordings;  // folders, separated by ':'
  std::string scene;       // empty: the scene lianad runs with
  std::uint64_t seed = 1;
  bool lockstep = false;
};

Pose pose_of(const config::ScenePose& pose) { return {pose.position_m, pose.quaternion_wxyz}; }

// Without a slit or a rod there is nothing to steer into by hand: the camera never shows it, and the person waits.
SlitDrawing drawing_of(const config::SceneConfig& scene) {
  if (!scene.slit || !scene.rod) return {};
  return slit_drawing(pose_of(scene.slit->frame), pose_of(scene.rod->pose));
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

// A picture that cannot be one is not looked at.
void look(OperatorSession& session, const Json& message) {
  try {
    session.on_camera(message);
  } catch (const std::exception& error) {
    std::fprintf(stderr, "liana-operator: %s\n", error.what());
  }
}

// The devices' clock is the arm's.
std::int64_t time_us(const Json& state) { return std::llround(state.at("time_s").get<double>() * 1e6); }

// Samples first: with `done` lianad takes them into the interval.
void act(api::ApiClient& client, OwnDevices& devices, OperatorSession& session, const Json& state) {
  devices.receive(time_us(state));
  const OperatorAnswer answer = session.on_state(state);
  devices.send(answer.kind, answer.samples);
  for (const Json& out : answer.messages) client.send(out);
}

// One message in, the answers out; false when lianad stops.
bool answer(api::ApiClient& client, OwnDevices& devices, OperatorSession& session, const Json& message, bool lockstep) {
  const std::string op = message.value("op", "");
  if (op == "camera") look(session, message);
  if (op == "error") std::fprintf(stderr, "liana-operator: refused: %s\n", message.value("message", "").c_str());
  if (op != "state") return true;
  act(client, devices, session, message);
  if (lockstep) client.send({{"op", "done"}, {"tick", message.at("tick")}});
  return !message.value("stopping", false);
}

int operate(const OperatorOptions& options) {
  api::ApiClient client = api::ApiClient::connect(options.api, kWelcomeTimeout_s);
  // Known before the role is taken: missions begin as soon as lianad has its operator.
  OwnDevices devices(options.devices.empty() ? device::devices_path(options.api) : options.devices, kWelcomeTimeout_s);
  const Json welcome = greet(client, options);
  const config::SceneConfig scene = options.scene.empty()
                                        ? config::parse_scene(welcome.at("scene").dump(), "scene of " + options.api)
                                        : config::load_scene(options.scene);
  OperatorSession session(folders_in(options.recordings), drawing_of(scene), HandGains{}, options.seed);
  for (bool running = true; running;) {
    const auto message = client.receive(kPoll_s);
    if (message) running = answer(client, devices, session, *message, options.lockstep);
  }
  return 0;
}

}  // namespace
}  // namespace liana::operator_side

int main(int argc, char** argv) {
  liana::operator_side::OperatorOptions options;
  liana::command_line::CommandLine line(
      "The operator as data and as a model that looks: recorded VR handles, simulated hand controller");
  line.option("--api", options.api, "API socket of lianad").required();
  line.option("--devices", options.devices, "socket of lianad for devices; .devices behind that of --api without");
  line.option("--recordings", options.recordings, "folders of the .hand files, separated by ':', searched in turn")
      .required();
  line.option("--scene", options.scene, "scene JSON the person has as a drawing; default: the one lianad runs with");
  line.option("--seed", options.seed, "seed of tremor, glitches and dropouts");
  line.flag("--lockstep", options.lockstep, "answer every state, so that fast runs repeat");
  if (const auto code = line.parse(argc, argv)) return *code;
  try {
    return liana::operator_side::operate(options);
  } catch (const std::exception& error) {
    std::fprintf(stderr, "liana-operator: %s\n", error.what());
    return 1;
  }
}
