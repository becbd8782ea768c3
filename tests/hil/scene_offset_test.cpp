// A scene that is not where its table has it: what moves, by how much, and that the camera sees it where it really is.
#include "bench_harness.hpp"

namespace liana::bench {
namespace {

constexpr SceneOffset kOffset{0.010, 1.0 * kRadPerDeg};

Truth start_of(const SceneOffset& offset, nlohmann::json* summary = nullptr) {
  BenchOptions options = options_of(3);
  options.scene_offset = offset;
  options.truth_path = temporary("offset.bin");
  options.summary_path = temporary("offset.json");
  {
    Bench bench(options);
    ScriptedBus bus(5, 0);
    bench.run(bus);
  }
  if (summary != nullptr) *summary = nlohmann::json::parse(content(options.summary_path));
  return read_truth(options.truth_path);
}

TEST(SceneOffset, MovesTheWholeSceneAsOneBodyByExactlyThisMuch) {
  const SceneConfig drawn = fixture_scene();
  const SceneConfig there = displaced(drawn, kOffset, 7);
  EXPECT_NEAR(norm(there.slit_frame->position_m - drawn.slit_frame->position_m), 0.010, 1e-12) << "turned about it";
  EXPECT_NEAR(2.0 * std::acos(std::fabs((conjugate(drawn.slit_frame->attitude) * there.slit_frame->attitude).w)),
              1.0 * kRadPerDeg, 1e-9);
  const Pose rod_before = relative(*drawn.slit_frame, drawn.rod.pose);
  const Pose rod_after = relative(*there.slit_frame, there.rod.pose);
  EXPECT_LT(norm(rod_before.position_m - rod_after.position_m), 1e-12);
  for (std::size_t b = 0; b < drawn.boxes.size(); ++b) {
    const Quat before = conjugate(drawn.slit_frame->attitude), after = conjugate(there.slit_frame->attitude);
    EXPECT_LT(norm(rotate(before, drawn.boxes[b].center_m - drawn.slit_frame->position_m) -
                   rotate(after, there.boxes[b].center_m - there.slit_frame->position_m)),
              1e-12);
    for (std::size_t k = 0; k < 3; ++k)
      EXPECT_LT(norm(rotate(before, drawn.boxes[b].axis[k]) - rotate(after, there.boxes[b].axis[k])), 1e-12);
  }
  EXPECT_GT(norm(there.spheres[0].center_m - drawn.spheres[0].center_m), 0.001);
  EXPECT_GT(norm(displaced(drawn, kOffset, 8).rod.pose.position_m - there.rod.pose.position_m), 0.001)
      << "another seed, another direction";
  EXPECT_EQ(displaced(drawn, {}, 7).rod.pose.position_m.x, drawn.rod.pose.position_m.x) << "no offset: to the bit";
}

TEST(SceneOffset, IsInClearanceDepthAndSummary) {
  nlohmann::json summary;
  const Truth drawn = start_of({});
  const Truth there = start_of(kOffset, &summary);
  EXPECT_EQ(drawn.at(2, "tip_x_m"), there.at(2, "tip_x_m")) << "the arm is where it was";
  EXPECT_GT(std::fabs(drawn.at(2, "slit_clearance_m") - there.at(2, "slit_clearance_m")), 1e-4);
  EXPECT_GT(std::fabs(drawn.at(2, "sphere_clearance_m") - there.at(2, "sphere_clearance_m")), 1e-4);
  EXPECT_GT(std::fabs(drawn.at(2, "slit_depth_m") - there.at(2, "slit_depth_m")), 1e-4);
  const SceneConfig really = displaced(fixture_scene(), kOffset, 3);
  EXPECT_NEAR(summary.at("rod")[0].get<double>(), really.rod.pose.position_m.x, 1e-12);
  EXPECT_NEAR(summary.at("rod")[3].get<double>(), really.rod.pose.attitude.w, 1e-12);
}

TEST(AtTheEnd, DrivesAndArmGoOnUntilTheArmIsAtRest) {
  BenchOptions options = options_of(1);
  options.truth_path = temporary("rest.bin");
  options.run_on_s = 0.1;
  options.rest_within_s = 20.0;
  FaultConfig broken;
  broken.drives = {13};
  broken.kind = FaultKind::kCableBreak;
  broken.at_slot = 145;
  options.faults = {broken};
  const auto rows = [&options] {
    Bench bench(options);
    ScriptedBus bus(150, 0);
    bench.run(bus);
    return read_truth(options.truth_path);
  };
  const Truth swung = rows();
  EXPECT_GT(swung.rows.size(), 400U) << "a broken cable lets the arm swing for seconds";
  const std::size_t last = swung.rows.size() - 1;
  for (std::size_t row = last - 120; row <= last; ++row) EXPECT_LT(swung.at(row, "fastest_deg_s"), 0.1);
  options.faults.clear();
  EXPECT_LT(rows().rows.size(), 400U) << "one at rest ends soon";
  options.rest_within_s = 0.0;
  EXPECT_EQ(rows().rows.size(), 175U);
}

}  // namespace
}  // namespace liana::bench
