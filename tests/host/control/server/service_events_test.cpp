// What the service makes an event of, and what not.
#include "host/control/server/service_events.hpp"

#include <gtest/gtest.h>
#include <unistd.h>

#include <algorithm>
#include <chrono>
#include <map>
#include <memory>
#include <thread>

#include "host/api/server/client.hpp"
#include "host/base/event/event_json.hpp"
#include "host/control/server/cable_arm_server.hpp"
#include "host/control/server/host_warning.hpp"
#include "host/control/server/service.hpp"
#include "tests/host/api/server/robots.hpp"
#include "tests/host/control/verification/sim_arm.hpp"
#include "tests/message.hpp"

namespace liana::server {
namespace {

std::vector<std::string> summaries(const std::vector<event::Event>& events) {
  std::vector<std::string> out;
  for (const event::Event& event : events)
    out.push_back(std::string(event::event_kind_name(event.kind)) + " " + std::to_string(event.number) + " " +
                  event.subject);
  return out;
}

config::BusesConfig one_bus() {
  config::BusesConfig buses;
  buses.buses.resize(1);
  buses.buses[0].name = "can0";
  return buses;
}

const config::BusesConfig kBuses = one_bus();
const config::DriveNames kNames(verification::SimArm().table());

TEST(Faults, EachIsAnEventWhenItAppearsAndAgainAfterAClear) {
  FaultMonitor watch;
  FaultList list;
  EXPECT_TRUE(watch.changes(list, kBuses, kNames).empty());
  latch(list, {FaultNumber::kDriveFault, 3, 0x2310, 100});
  latch(list, {FaultNumber::kBusLost, 0, 0, 100});
  const std::vector<event::Event> first = watch.changes(list, kBuses, kNames);
  EXPECT_EQ(summaries(first),
            (std::vector<std::string>{"fault 3003 drive 4 (node 4, segment 2)", "fault 4001 bus can0"}));
  EXPECT_EQ(first[0].values, (std::vector<event::EventValue>{{"detail", 0x2310}, {"tick", 100.0}, {"cause", 0.0}}));
  EXPECT_NE(first[0].text.find(fault_info(FaultNumber::kDriveFault).name), std::string::npos);
  EXPECT_TRUE(watch.changes(list, kBuses, kNames).empty()) << "it is still there";
  latch(list, {FaultNumber::kGateRefused, -1, 0, 101});
  EXPECT_EQ(summaries(watch.changes(list, kBuses, kNames)), (std::vector<std::string>{"fault 6001 "}));
  EXPECT_TRUE(watch.changes(FaultList{}, kBuses, kNames).empty()) << "that they are gone, the clear says";
  FaultList plug;
  latch(plug, {FaultNumber::kDriveSilent, 3, 0, 200});
  latch(plug, {FaultNumber::kDriveMissing, 3, 0, 300});
  EXPECT_EQ(watch.changes(plug, kBuses, kNames)[1].values.back(), (event::EventValue{"cause", 3002.0}));
  FaultList again;
  latch(again, {FaultNumber::kDriveFault, 3, 0x2310, 500});
  EXPECT_EQ(summaries(watch.changes(again, kBuses, kNames)),
            (std::vector<std::string>{"fault 3003 drive 4 (node 4, segment 2)"}));
}

TEST(Faults, ThoseWithoutAPlaceAreCounted) {
  FaultMonitor watch;
  FaultList list;
  for (std::int16_t drive = 0; drive < FaultList::kCapacity + 5; ++drive)
    latch(list, {FaultNumber::kDriveSilent, drive, 0, 7});
  const std::vector<event::Event> events = watch.changes(list, kBuses, kNames);
  ASSERT_EQ(events.size(), FaultList::kCapacity + 1u);
  EXPECT_EQ(events.back().number, 0);
  EXPECT_EQ(events.back().values, (std::vector<event::EventValue>{{"count", 5.0}}));
  EXPECT_TRUE(watch.changes(list, kBuses, kNames).empty());
}

TEST(HostTroubles, EachChangeSaysWhichBusAndHowMuch) {
  config::BusesConfig buses;
  buses.buses.resize(2);
  buses.buses[0].name = "can0";
  buses.buses[1].name = "can1";
  HostWarning trouble;
  realtime::TickStatus report;
  EXPECT_TRUE(trouble.changes(buses, report).empty());
  report.bus[0].state = bus::BusState::kErrorPassive;
  report.bus[1].errors = 4;
  report.bus[1].dropped = 2;
  report.overruns.lost_ticks = 3;
  const std::vector<event::Event> events = trouble.changes(buses, report);
  EXPECT_EQ(summaries(events), (std::vector<std::string>{"host_warning 1 bus can0", "host_warning 2 bus can1",
                                                         "host_warning 3 bus can1", "host_warning 6 control thread"}));
  EXPECT_EQ(events[0].values, (std::vector<event::EventValue>{{"state", 1.0}}));
  EXPECT_EQ(events[1].values, (std::vector<event::EventValue>{{"count", 4.0}}));
  EXPECT_TRUE(names(events[1].text, {"can1", "4", "active"}));
  EXPECT_EQ(events[3].values, (std::vector<event::EventValue>{{"count", 3.0}}));
  EXPECT_TRUE(trouble.changes(buses, report).empty());
  report.bus[0].refused = 6;
  EXPECT_EQ(summaries(trouble.changes(buses, report)), (std::vector<std::string>{"host_warning 4 bus can0"}));
  const std::vector<event::Event> over = trouble.changes(buses, report);
  EXPECT_EQ(summaries(over), (std::vector<std::string>{"host_warning 5 bus can0"}));
  EXPECT_EQ(over[0].values, (std::vector<event::EventValue>{{"count", 6.0}}));
}

// req:C12
TEST(Events, AVerdictSaysWhichEndRefusedAndHowNearTheLimitIs) {
  verification::Verdict verdict;
  verdict.code = verification::Refusal::kTipSpeed;
  verdict.text = "too fast";
  verdict.share = 1.25;
  const event::Event event = verdict_event(17, verdict);
  EXPECT_EQ(summaries({event}), (std::vector<std::string>{"verdict 203 simulation"}));
  EXPECT_EQ(event.values, (std::vector<event::EventValue>{{"command", 17.0}, {"share", 1.25}}));
  EXPECT_TRUE(names(event.text, {"17", "203", "tip_speed", "too fast"}));
  verdict.code = verification::Refusal::kTooSlow;
  EXPECT_EQ(verdict_event(18, verdict).subject, "execution");
}

TEST(Events, AnOwnerThatStandsStillIsNamedWithItsTimeToLive) {
  const event::Event event = stands_still_event("robot hand", 0.25);
  EXPECT_EQ(summaries({event}), (std::vector<std::string>{"owner 4 robot hand"}));
  EXPECT_EQ(event.values, (std::vector<event::EventValue>{{"ttl_s", 0.25}}));
  EXPECT_TRUE(names(event.text, {"servo_cp", "0.25 s"}));
}

// A service in real time, its arm and one client, who reads events.
class ServiceTellsEvents : public testing::Test {
 protected:
  ServiceTellsEvents()
      : desk_(robot(), config::SceneConfig{}, "", timing::TimeMode::kReal, arm_.link,
              {path() + ".devices", std::nullopt}),
        service_(config(), desk_) {
    client_.send({{"op", "hello"}, {"name", "c"}, {"role", "client"}, {"subscribe", {"event"}}, {"events_from", 1}});
  }
  ~ServiceTellsEvents() override { ::unlink(path().c_str()); }

  static std::string path() { return testing::TempDir() + "liana_service_events_" + std::to_string(::getpid()); }
  config::RobotConfig robot() const {
    config::RobotConfig robot;
    robot.table = arm_.table();
    return robot;
  }
  ServiceConfig config() const {
    ServiceConfig config;
    config.time_mode = timing::TimeMode::kReal;
    config.api_path = path();
    config.robot_json = api::zhu2022_json().dump();
    config.scene_json = config.buses.canonical_json = "{}";
    config.buses.rate_hz = 1.0 / arm_.table().tick_s;
    config.buses.command_interval_s = arm_.table().interval_ticks * arm_.table().tick_s;
    config.serials = [] { return std::vector<std::uint32_t>(15, 7); };
    config.boot_problems = [] { return std::vector<realtime::BootProblem>{}; };
    return config;
  }
  void intervals(int count) {
    for (int i = 0; i < count; ++i) {
      service_.cycle();
      arm_.interval();
      hear();
    }
  }
  void hear() {
    for (auto message = client_.receive(0.0); message; message = client_.receive(0.0)) {
      if (message->value("op", "") == "event") heard_.push_back(event::event_from_json(*message));
    }
  }
  std::vector<event::Event> heard(event::EventKind kind) const {
    std::vector<event::Event> out;
    for (const event::Event& event : heard_) {
      if (event.kind == kind) out.push_back(event);
    }
    return out;
  }
  std::vector<event::Event> refusals(verification::Refusal refusal) const {
    std::vector<event::Event> out;
    for (const event::Event& event : heard(event::EventKind::kVerdict)) {
      if (event.number == event::number_of(refusal)) out.push_back(event);
    }
    return out;
  }
  // Until a command is released. A loaded machine may have no verdict in time: it is asked again, as the message says.
  void move() {
    client_.send({{"op", "acquire"}});
    intervals(10);
    client_.send({{"op", "state_command"}, {"command", "enable"}});
    for (int i = 0; i < 400 && arm_.now().state != OperatingState::kEnabled; ++i) intervals(1);
    intervals(50);
    Json goal = Json::array();
    for (const double theta_rad : arm_.now().theta_command_rad) {
      if (goal.size() < 10) goal.push_back(theta_rad / kDegree);
    }
    goal[0] = goal[0].get<double>() + 2.0;
    for (std::size_t asked = 0; asked < 50 && arm_.now().active_sequence == 0; ++asked) {
      client_.send({{"op", "move_jp"}, {"goal_deg", goal}});
      // Its way is looked at first, by a thread that takes its time where every access is checked.
      for (int i = 0; i < 2000 && arm_.now().active_sequence == 0; ++i) {
        intervals(1);
        if (refusals(verification::Refusal::kNoVerdict).size() > asked) break;
        if (i >= 100) std::this_thread::sleep_for(std::chrono::milliseconds(5));
      }
    }
  }

  verification::SimArm arm_;
  CableArmServer desk_;
  Service service_;
  api::ApiClient client_ = api::ApiClient::connect(path());
  std::vector<event::Event> heard_;
};

// req:C12
TEST_F(ServiceTellsEvents, ARefusedVerdictIsAnEventAndAReleasedOneIsNone) {
  move();
  ASSERT_GT(arm_.now().active_sequence, 0u) << "commands were released";
  EXPECT_EQ(heard(event::EventKind::kVerdict).size(), refusals(verification::Refusal::kNoVerdict).size());
  auto late = arm_.link.report.value();  // the verdict comes when its interval is over
  late.next_tick += 100;
  arm_.link.report.publish(late);
  service_.cycle();
  hear();
  const std::vector<event::Event> verdicts = refusals(verification::Refusal::kTooSlow);
  ASSERT_EQ(verdicts.size(), 1u);
  EXPECT_EQ(verdicts[0].subject, "execution");
  EXPECT_GT(verdicts[0].values[0].value, 0.0);
}

// req:C12
TEST(Faults, ThatFindNoPlaceAreNotAnEventOfEveryInterval) {
  FaultMonitor watch;
  FaultList list;
  std::vector<event::Event> told;
  event::EventLog log([&told](const event::Event& event) { told.push_back(event); }, 0.004);
  for (std::uint64_t tick = 0; tick < 5000; ++tick) {  // 20 s after a plug was loose
    for (std::int16_t drive = 0; drive < FaultList::kCapacity + 9; ++drive)
      latch(list, {FaultNumber::kDriveSilent, drive, 0, 7});
    if (tick % 5 != 4) continue;
    for (event::Event& event : watch.changes(list, kBuses, kNames)) log.add(tick, std::move(event));
    log.begin_interval(tick);
  }
  EXPECT_EQ(told.size(), FaultList::kCapacity + 1u);
  EXPECT_EQ(summaries({told.front()}), (std::vector<std::string>{"fault 3002 drive 1 (node 1, segment 1)"}));
  log.add(5000, {.kind = event::EventKind::kClear, .number = 0});
  ASSERT_EQ(told.size(), FaultList::kCapacity + 3u);
  const auto count = std::ranges::find(told[told.size() - 2].values, "count", &event::EventValue::name);
  EXPECT_EQ(told[FaultList::kCapacity].values[0].value + count->value, list.dropped);
}

TEST_F(ServiceTellsEvents, TheyAreNumberedWithoutGapsWhateverComesFirst) {
  move();
  for (int i = 0; i < 60; ++i) client_.send({{"op", "stop"}});
  client_.send({{"op", "release"}});
  intervals(20);
  intervals(static_cast<int>(1.5 * event::EventLog::kOver_s / (arm_.table().interval_ticks * arm_.table().tick_s)));
  // How many stops one interval takes depends on the machine; those that are not told are counted.
  std::map<std::uint64_t, std::uint32_t> stops_at_tick;
  std::int64_t stops = 0;
  for (const event::Event& stop : heard(event::EventKind::kStop)) {
    ++stops_at_tick[stop.tick];
    const auto times = std::ranges::find(stop.values, "times", &event::EventValue::name);
    stops += times == stop.values.end() ? 1 : static_cast<std::int64_t>(times->value);
  }
  for (const auto& [tick, count] : stops_at_tick) EXPECT_LE(count, event::EventLog::kMaxPerInterval) << tick;
  for (const event::Event& left_out : heard(event::EventKind::kLeftOut)) stops += left_out.number;
  EXPECT_EQ(stops, 60);
  EXPECT_EQ(heard(event::EventKind::kOwner).back().number, event::number_of(event::OwnerEvent::kReleased));
  for (std::size_t i = 0; i < heard_.size(); ++i) EXPECT_EQ(heard_[i].sequence, i + 1);
}

}  // namespace
}  // namespace liana::server
