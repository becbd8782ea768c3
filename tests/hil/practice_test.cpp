// Faults that a person has happen while the bench runs.
#include "hil/bench/practice.hpp"

#include <sys/socket.h>
#include <sys/stat.h>

#include <map>

#include "bench_harness.hpp"
#include "hil/bench/cable_plant.hpp"
#include "tests/message.hpp"

namespace liana::bench {
namespace {

// A master beside which somebody sends packets to the bench, each before a slot, and keeps the answers.
class PractisedBus final : public Bus {
 public:
  PractisedBus(std::uint32_t slots, std::string socket, std::map<std::uint32_t, std::string> packets)
      : master_(slots, 0), socket_(std::move(socket)), packets_(std::move(packets)) {}

  bool wait(Wake& wake) override {
    if (!master_.wait(wake)) return false;
    hear();
    if (const auto found = packets_.find(wake.slot); found != packets_.end()) {
      if (!client_.open()) client_ = connect_local(socket_, 0);
      EXPECT_GT(::send(client_.descriptor(), found->second.data(), found->second.size(), 0), 0);
    }
    return true;
  }
  void send(const FrameList& frames) override { master_.send(frames); }
  bool lockstep() const override { return true; }
  std::uint32_t period_us() const override { return 4000; }
  std::uint64_t refused() const override { return 0; }

  std::vector<nlohmann::json> answers;

 private:
  void hear() {
    std::array<char, 65536> packet;
    const ssize_t size = client_.open() ? ::recv(client_.descriptor(), packet.data(), packet.size(), MSG_DONTWAIT) : 0;
    if (size > 0) answers.push_back(nlohmann::json::parse(packet.data(), packet.data() + size));
  }

  ScriptedBus master_;
  std::string socket_;
  std::map<std::uint32_t, std::string> packets_;
  Socket client_;
};

struct Practised {
  std::vector<nlohmann::json> answers;
  nlohmann::json faults;  // of the summary
};

Practised practised(const std::map<std::uint32_t, std::string>& packets, std::uint32_t slots = 80) {
  BenchOptions options = options_of(1);
  options.summary_path = temporary("summary.json");
  options.practice_socket = temporary("practice");
  ::unlink(options.practice_socket.c_str());
  PractisedBus bus(slots, options.practice_socket, packets);
  Bench bench(options);
  bench.run(bus);
  return {bus.answers, nlohmann::json::parse(content(options.summary_path)).at("faults")};
}

TEST(Practice, AFaultBeginsWithTheSlotInWhichItIsReadAndStaysWhereItCannotEnd) {
  const Practised run = practised({{60, R"([{"kind":"cable_break","drive":5}])"}, {70, R"("end")"}});
  ASSERT_EQ(run.answers.size(), 2U);
  const nlohmann::json on = nlohmann::json::parse(R"([{"kind":"cable_break","drives":[5],"can_end":false}])");
  EXPECT_EQ(run.answers[0].at("op"), "ok");
  EXPECT_EQ(run.answers[0].at("on"), on);
  EXPECT_EQ(run.answers[1].at("on"), on);
  EXPECT_EQ(run.faults.at(0).at("begun_slot"), 60);
  EXPECT_TRUE(run.faults.at(0).at("ended_slot").is_null());
}

TEST(Practice, EndEndsWithItsSlotAllThatCanEnd) {
  const Practised run = practised(
      {{60, R"([{"kind":"silent","drive":[1,15]},{"kind":"slack","drive":2}])"}, {61, "[]"}, {65, R"("end")"}});
  ASSERT_EQ(run.answers.size(), 3U);
  EXPECT_EQ(run.answers[1].at("on").size(), 2U);
  EXPECT_EQ(run.answers[1].at("on").at(0).at("drives"), nlohmann::json::parse("[1,15]"));
  EXPECT_TRUE(run.answers[2].at("on").empty());
  for (const nlohmann::json& fault : run.faults) {
    EXPECT_EQ(fault.at("begun_slot"), 60);
    EXPECT_EQ(fault.at("ended_slot"), 65);
  }
}

TEST(Practice, WithoutASocketNobodyIsHeardAndASocketIsForThisUserAlone) {
  Practice none("");
  const std::string path = temporary("practice_mode");
  ::unlink(path.c_str());
  Practice some(path);
  struct stat status {};
  ASSERT_EQ(::stat(path.c_str(), &status), 0);
  EXPECT_EQ(status.st_mode & 0777, 0600U);
  EXPECT_THROW(Practice again(path), std::runtime_error);
  EXPECT_THROW(Practice(std::string(200, 'x')), std::runtime_error);
}

// As `liana console` with faults does: the bench is asked first whether it can read them.
TEST(Practice, ThatHasEndedLeavesItsPathToTheNext) {
  const std::string path = temporary("practice_again");
  { Practice asked(path); }
  struct stat status {};
  EXPECT_NE(::stat(path.c_str(), &status), 0);
  EXPECT_NO_THROW(Practice runs(path));
}

class APacket : public testing::Test {
 protected:
  BenchOptions options_ = options_of(1);
  CablePlant plant_{options_.robot, options_.scene, options_.buses, options_, {}, 1};
  FaultInjector injector_{{}};
  nlohmann::json answer(const std::string& packet) {
    return nlohmann::json::parse(practise(packet, 7, plant_, injector_));
  }
};

TEST_F(APacket, ThatIsNoFaultOfThisArmIsRefusedInWordsAndChangesNothing) {
  const char* rows[][2] = {{"", "not JSON"},
                           {"{}", "list"},
                           {"\"stop\"", "list"},
                           {"\xff\"", "not JSON"},
                           {R"([{"kind":"cable_brake","drive":1}])", "cable_break"},
                           {R"([{"kind":"cable_break","drive":0}])", "drive"},
                           {R"([{"kind":"cable_break","drive":16}])", "drive"},
                           {R"([{"kind":"cable_break","drive":1,"at_slot":9}])", "at_slot"},
                           {R"([{"kind":"cable_break","drive":1,"when":{"moving":true}}])", "when"},
                           {R"([{"kind":"encoder_jump","drive":1}])", "counts"},
                           {R"([{"kind":"jam","pin":1,"depth_m":0.01}])", "payload"},
                           {R"([{"kind":"load_cell_failed","drive":1}])", "load_cell_failed"},
                           {R"([{"kind":"external_force","x_N":1,"link":99}])", "link"}};
  for (const auto& [packet, named] : rows) {
    const nlohmann::json refused = answer(packet);
    EXPECT_EQ(refused.at("op"), "error") << packet;
    EXPECT_NE(refused.at("message").get<std::string>().find(named), std::string::npos) << refused;
  }
  EXPECT_TRUE(injector_.faults().empty());
}

TEST_F(APacket, IsTakenUntilTheBenchHasHadItsMostFaults) {
  injector_.add(std::vector<FaultConfig>(Practice::kMaxFaults - 1));
  EXPECT_EQ(answer(R"([{"kind":"fault","drive":1},{"kind":"fault","drive":2}])").at("op"), "error");
  EXPECT_EQ(answer(R"([{"kind":"fault","drive":15}])").at("op"), "ok");
  EXPECT_EQ(answer(R"([{"kind":"fault","drive":15}])").at("op"), "error");
  EXPECT_EQ(answer("[]").at("op"), "ok");
}

TEST_F(APacket, SaysNothingOfAFaultOfTheListThatHasNotBegun) {
  FaultConfig later;
  later.at_slot = 8;
  injector_.add({later});
  EXPECT_TRUE(answer("[]").at("on").empty());
}

}  // namespace
}  // namespace liana::bench
