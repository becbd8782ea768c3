// What lianad says, into the archive and out again (req:A25).
#include "host/storage/archive/recorder.hpp"

#include "host/api/telemetry/record.hpp"
#include "host/storage/archive/reader.hpp"
#include "host/storage/archive/segments.hpp"
#include "tests/host/storage/archive/archive_folder.hpp"
#include "tests/message.hpp"

namespace liana::archive {
namespace {

class Archive : public ArchiveFolder {
 protected:
  Recorder recorder(TelemetryLimits limits = {}) { return {folder_, life(), kInterval, limits}; }
  static void states(Recorder& recorder, std::uint64_t first, std::uint64_t last) {
    for (std::uint64_t tick = first; tick <= last; tick += kInterval) recorder.take(state_at(tick));
  }
  Reader reader() const { return Reader(folder_); }
};

TEST_F(Archive, TellsTheLifeAndWhatItsRecordsHold) {
  Recorder recorder = this->recorder();
  states(recorder, 0, 100);
  EXPECT_FALSE(reader().is_finished());
  recorder.finish();
  const Reader read = reader();
  EXPECT_TRUE(read.is_finished());
  EXPECT_EQ(read.life().config_hash, "hash");
  EXPECT_EQ(read.life().period_s, kPeriod_s);
  ASSERT_TRUE(read.layout());
  EXPECT_EQ(read.layout()->places.at(0).field.path, "measured_js_deg");
  EXPECT_EQ(read.recorded()->last, 100u);
}

TEST_F(Archive, GivesBackTheRecordsOfAStretchAcrossFiles) {
  Recorder recorder = this->recorder({.file_s = 2.0});
  states(recorder, 0, 2500);
  recorder.finish();
  ASSERT_GT(segments_in(folder_).size(), 2u);
  const Reader read = reader();
  const std::vector<std::string> records = read.telemetry(read.span_of(1.0, 9.0));
  ASSERT_EQ(records.size(), 401u);
  const telemetry::Place& angles = read.layout()->places.at(0);
  for (std::size_t i = 0; i < records.size(); ++i) {
    const std::uint64_t tick = 250 + i * kInterval;
    EXPECT_EQ(telemetry::header_of(records[i]).tick, static_cast<double>(tick));
    EXPECT_EQ(telemetry::value_of(records[i], angles, 3), state_at(tick)["measured_js_deg"][3].get<float>());
  }
}

TEST_F(Archive, GivesFactsThatHoldAtTheBeginOfAStretchAndThoseThatFollow) {
  Recorder recorder = this->recorder({.file_s = 2.0});
  states(recorder, 0, 1000);
  recorder.take(state_at(1005, "FAULT"));
  states(recorder, 1010, 2000);
  recorder.finish();
  const std::vector<Facts> late = reader().facts({1900, 2000}), around = reader().facts({500, 1005});
  ASSERT_EQ(late.size(), 1u);
  EXPECT_EQ(late[0].state["state"], "ENABLED");
  EXPECT_EQ(late[0].number, 3u);
  ASSERT_EQ(around.size(), 2u);
  EXPECT_EQ(around[1].tick, 1005u);
  EXPECT_EQ(around[1].state["state"], "FAULT");
  EXPECT_EQ(reader().facts().size(), 3u);
}

TEST_F(Archive, AnEventCanBeReadAsSoonAsItIsTaken) {
  Recorder recorder = this->recorder();
  states(recorder, 0, 10);
  recorder.take(event_of(1, 12));
  EXPECT_EQ(recorder.durable(), 1u);
  const std::vector<event::Event> events = reader().events();
  ASSERT_EQ(events.size(), 1u);
  EXPECT_EQ(events[0].kind, event::EventKind::kStop);
  EXPECT_EQ(events[0].subject, "liana estop");
  EXPECT_EQ(events[0].values, (std::vector<event::EventValue>{{"drive", 3.0}}));
}

TEST_F(Archive, ARefusedCommandCanBeReadAtOnceAndAReleasedOneWithinASecond) {
  Recorder recorder = this->recorder();
  Json released = state_at(5), refused = state_at(10);
  released["verdict"] = verdict(1, true);
  recorder.take(released);
  EXPECT_EQ(recorder.durable(), 0u);
  refused["verdict"] = verdict(2, false);
  recorder.take(refused);
  EXPECT_EQ(recorder.durable(), 2u);
  const std::vector<Command> commands = reader().commands(kAll, true);
  ASSERT_EQ(commands.size(), 1u);
  EXPECT_EQ(commands[0].code, 104);
  EXPECT_EQ(commands[0].text, "12 mm too little");
  EXPECT_EQ(reader().commands().size(), 2u);
}

TEST_F(Archive, ACommandStandsThereOnceThoughManyStatesTellOfIt) {
  Recorder recorder = this->recorder();
  for (std::uint64_t tick = 5; tick < 500; tick += kInterval) {
    Json state = state_at(tick);
    state["verdict"] = verdict(7, true);
    recorder.take(state);
  }
  recorder.finish();
  ASSERT_EQ(reader().commands().size(), 1u);
  EXPECT_EQ(reader().commands()[0].tick, 5u);
}

TEST_F(Archive, StatesAndEventsThatAreMissingAreCounted) {
  Recorder recorder = this->recorder();
  states(recorder, 0, 100);
  states(recorder, 150, 200);
  recorder.take({{"op", "events_lost"}, {"from", 1}, {"to", 33}, {"count", 33}});
  recorder.finish();
  const std::vector<Gap> gaps = reader().gaps();
  ASSERT_EQ(gaps.size(), 2u);
  EXPECT_EQ(gaps[0].what, "states");
  EXPECT_EQ(gaps[0].first_tick, 105u);
  EXPECT_EQ(gaps[0].last_tick, 145u);
  EXPECT_EQ(gaps[0].count, 9u);
  EXPECT_EQ(gaps[1].what, "events");
  EXPECT_EQ(gaps[1].count, 33u);
}

TEST_F(Archive, TelemetryIsNotDenserThan50Hz) {
  Recorder recorder(folder_, life(), 1);
  for (std::uint64_t tick = 0; tick < 1000; ++tick) recorder.take(state_at(tick));
  recorder.finish();
  EXPECT_EQ(reader().telemetry().size(), 200u);
  EXPECT_EQ(recorder.states(), 1000u);
}

TEST_F(Archive, EverySecondHasItsLeastMeanAndLargestInATableThatSqlReads) {
  Recorder recorder = this->recorder({.file_s = 2.0});
  states(recorder, 0, 1245);
  recorder.finish();
  std::size_t rows = 0;
  for (const Segment& file : segments_in(folder_)) {
    const Database database(file.path, Database::Open::kRead);
    Statement row(database,
                  "SELECT first_tick, time_s, count, measured_js_deg_4_min, measured_js_deg_4_mean, "
                  "measured_js_deg_4_max FROM tm_1s ORDER BY first_tick");
    while (row.step()) {
      ASSERT_EQ(row.count(0), rows * 250);
      EXPECT_DOUBLE_EQ(row.real(1), static_cast<double>(rows));
      EXPECT_EQ(row.count(2), 50u);
      double least = 2.0, most = -2.0, sum = 0.0;
      for (std::uint64_t tick = rows * 250; tick < (rows + 1) * 250; tick += kInterval) {
        const double value = static_cast<double>(state_at(tick)["measured_js_deg"][3].get<float>());
        least = std::min(least, value);
        most = std::max(most, value);
        sum += value;
      }
      EXPECT_EQ(row.real(3), least);
      EXPECT_DOUBLE_EQ(row.real(4), sum / 50.0);
      EXPECT_EQ(row.real(5), most);
      ++rows;
    }
  }
  EXPECT_EQ(rows, 5u);
}

TEST_F(Archive, ANumberThatIsNotThereForASecondIsNullInIt) {
  Recorder recorder = this->recorder();
  for (std::uint64_t tick = 0; tick < 500; tick += kInterval) {
    Json state = state_at(tick);
    state["clearance"] = tick < 250 ? Json() : Json{{"distance_m", 0.25}};
    recorder.take(state);
  }
  recorder.finish();
  const Database database(segments_in(folder_).at(0).path, Database::Open::kRead);
  Statement row(database, "SELECT clearance_distance_m_min, clearance_distance_m_mean FROM tm_1s ORDER BY first_tick");
  ASSERT_TRUE(row.step());
  EXPECT_TRUE(row.is_null(0) && row.is_null(1));
  ASSERT_TRUE(row.step());
  EXPECT_EQ(row.real(1), 0.25);
}

TEST_F(Archive, ASecondLifeInTheSameFolderIsApartFromTheFirst) {
  for (const std::uint64_t last : {500u, 250u}) {
    Recorder recorder = this->recorder();
    states(recorder, 0, last);
    recorder.take(event_of(1, last));
    recorder.finish();
  }
  EXPECT_EQ(reader().life_number(), 2u);
  EXPECT_EQ(reader().recorded()->last, 250u);
  EXPECT_EQ(reader().events().size(), 1u);
  EXPECT_EQ(Reader(folder_, 1).recorded()->last, 500u);
}

TEST_F(Archive, OneThatWasCutOffIsGoneOnWithAndWhatIsMissingIsSaid) {
  {
    Recorder recorder = this->recorder();
    states(recorder, 0, 500);
    recorder.take(event_of(1, 500));
  }  // not finished: as if killed; the second that was open is lost
  Recorder recorder(folder_, life(), kInterval, {}, 3);
  for (const std::uint64_t sequence : {1u, 2u}) recorder.take(event_of(sequence, 500));
  states(recorder, 1000, 1500);
  recorder.finish();
  const Reader read = reader();
  EXPECT_EQ(read.lives(), 1u);
  EXPECT_EQ(read.events().size(), 2u);
  ASSERT_EQ(read.gaps().size(), 1u);
  EXPECT_EQ(read.gaps()[0].first_tick, 500u);
  EXPECT_EQ(read.gaps()[0].last_tick, 995u);
  EXPECT_TRUE(names(read.gaps()[0].text, {"recorder"}));
  EXPECT_EQ(read.facts().size(), 2u);
  EXPECT_EQ(read.recorded()->last, 1500u);
}

TEST_F(Archive, ANewLianadBeginsANewLifeAlsoWhereTheLastOneWasCutOff) {
  for (int i = 0; i < 2; ++i) {
    Recorder recorder(folder_, life(), kInterval, {}, 1);
    recorder.take(event_of(1, 0));
  }
  EXPECT_EQ(reader().lives(), 2u);
}

TEST_F(Archive, AFolderWithoutOneIsRefusedByName) {
  try {
    reader();
    FAIL();
  } catch (const std::runtime_error& error) {
    EXPECT_NE(std::string(error.what()).find("archive.db"), std::string::npos) << error.what();
  }
}

}  // namespace
}  // namespace liana::archive
