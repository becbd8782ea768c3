#include <cmath>

#include "host/model/config/config.hpp"
#include "host/model/config/slit_mouth.hpp"
#include "tests/host/model/config/tables.hpp"

namespace liana::config {
namespace {

double dot(const Vec3& a, const Vec3& b) { return a[0] * b[0] + a[1] * b[1] + a[2] * b[2]; }

// Mission, A8.
// req:A48
TEST(Scene, PanelSlitHasThePlaneOfThePressRodPose) {
  const SceneConfig scene = parse_scene(good_table("scene", "panel_slit").dump(), "s");
  EXPECT_NEAR(scene.slit->normal[0], 0.0036, 1e-4);
  EXPECT_NEAR(scene.slit->normal[1], 0.9925, 1e-4);
  EXPECT_NEAR(scene.slit->normal[2], -0.1219, 1e-4);
  EXPECT_NEAR(scene.slit->offset_m, -0.78450, 1e-5);
  EXPECT_NEAR(scene.rod->pose.position_m[0], 3.3922, 1e-4);
  EXPECT_NEAR(dot(scene.rod->pose.position_m, scene.slit->normal), scene.slit->offset_m, 1e-12);
}

TEST(Scene, APayloadAndItsAdapterAreBothThereOrNeither) {
  for (const std::string lacks : {"payload", "adapter"}) {
    Json scene = good_table("scene", "payload_adapter");
    scene.erase(lacks);
    try {
      parse_scene(scene.dump(), "s");
      FAIL() << "without " << lacks;
    } catch (const std::runtime_error& error) {
      EXPECT_TRUE(names(error.what(), {"payload", "adapter", "add " + lacks}));
    }
  }
}

// req:A47 req:A48
TEST(Scene, PlatesLeaveAGapOf100MillimetresAroundThePlane) {
  const SceneConfig scene = parse_scene(good_table("scene", "panel_slit").dump(), "s");
  for (const SceneBox& box : {scene.boxes[0], scene.boxes[1]}) {
    const double distance_m =
        std::fabs(dot(box.center_m, scene.slit->normal) - scene.slit->offset_m) - box.half_extent_m[1];
    EXPECT_NEAR(distance_m, 0.05, 1e-12) << box.name;
    const double along_m = dot(box.center_m, scene.slit->u_axis);
    EXPECT_NEAR(along_m - box.half_extent_m[0], 1.75, 1e-12) << box.name;
    EXPECT_NEAR(along_m + box.half_extent_m[0], 3.70, 1e-12) << box.name;
  }
  EXPECT_EQ(scene.boxes[0].name, "panel");
  EXPECT_EQ(scene.boxes[1].name, "wall");
  EXPECT_GT(dot(scene.boxes[0].center_m, scene.slit->normal), scene.slit->offset_m);
}

// req:A48
TEST(Scene, TheDriveBoxStandsBehindTheRoot) {
  const SceneConfig scene = parse_scene(good_table("scene", "panel_slit").dump(), "s");
  ASSERT_EQ(scene.boxes.size(), 3u);
  EXPECT_EQ(scene.boxes[2].name, "drive_box");
  EXPECT_LT(scene.boxes[2].center_m[0] + scene.boxes[2].half_extent_m[0], -0.4);
}

// req:A47
TEST(Scene, TheSlitLeavesLinkAxesTheGapLessTheArm) {
  const SceneConfig scene = parse_scene(good_table("scene", "panel_slit").dump(), "s");
  const inverse_kinematics::SlitMouth mouth = slit_mouth(*scene.slit, 0.03);
  EXPECT_NEAR(mouth.half_gap_m, 0.02, 1e-12);
  EXPECT_NEAR(mouth.depth_m, 1.95, 1e-12);
  const Vec3 along = rotate(mouth.frame_in_base.quaternion, {1.0, 0.0, 0.0});
  EXPECT_NEAR(dot(along, scene.slit->u_axis), 1.0, 1e-9);
  EXPECT_NEAR(dot(mouth.frame_in_base.position_m, scene.slit->u_axis), scene.slit->mouth_u_m, 1e-9);
}

TEST(Scene, ASlitHasItsOwnFixturesUnlessTheSceneNamesOthers) {
  const SceneConfig scene = parse_scene(good_table("scene", "panel_slit").dump(), "s");
  ASSERT_EQ(scene.fixtures.size(), 3u);
  EXPECT_EQ(scene.fixtures[0].name, "slit_plane");
  EXPECT_EQ(scene.fixtures[1].name, "slit_walls");
  EXPECT_NEAR(scene.fixtures[1].depth_m, 1.95, 1e-12);
  EXPECT_EQ(scene.fixtures[1].half_gap_m, 0.05);
  const SceneFixture& approach = scene.fixtures[2];
  EXPECT_EQ(approach.name, "slit_approach");
  const Vec3 way = subtract(scene.rod->pose.position_m, approach.frame.position_m);
  EXPECT_NEAR(norm(way), 0.3, 1e-12);
  EXPECT_NEAR(dot(way, scene.slit->normal), 0.0, 1e-9) << "in the slit's plane";
  Json without = good_table("scene", "panel_slit");
  without["fixtures"] = Json::array();
  EXPECT_TRUE(parse_scene(without.dump(), "s").fixtures.empty());
  EXPECT_TRUE(parse_scene(good_table("scene", "none").dump(), "s").fixtures.empty());
}

constexpr const char* kFixtures = R"({"format":1,"kind":"scene","name":"own","boxes":[],"spheres":[],"fixtures":[
  {"name":"middle","kind":"plane","frame":{"position_m":[1,0,0],"quaternion_wxyz":[1,0,0,0]},
   "depth_m":1,"half_width_m":2,"half_gap_m":0.05,"yaw_deg":[-10,20]},
  {"name":"sides","kind":"walls","frame":{"position_m":[1,0,0],"quaternion_wxyz":[1,0,0,0]},
   "depth_m":1,"half_width_m":2,"half_gap_m":0.06},
  {"name":"way_in","kind":"axis","frame":{"position_m":[1,0,0],"quaternion_wxyz":[1,0,0,0]},
   "depth_m":1,"half_width_m":2,"half_gap_m":0.05,"radius_m":0.02}]})";

TEST(Scene, HasFixturesOfThreeKinds) {
  const SceneConfig scene = parse_scene(kFixtures, "s");
  ASSERT_EQ(scene.fixtures.size(), 3u);
  EXPECT_EQ(scene.fixtures[0].kind, FixtureKind::kPlane);
  EXPECT_EQ(scene.fixtures[0].yaw_low_deg, -10.0);
  EXPECT_EQ(scene.fixtures[0].yaw_high_deg, 20.0);
  EXPECT_EQ(scene.fixtures[1].kind, FixtureKind::kWalls);
  EXPECT_EQ(scene.fixtures[1].half_gap_m, 0.06);
  EXPECT_EQ(scene.fixtures[2].kind, FixtureKind::kAxis);
  EXPECT_EQ(scene.fixtures[2].radius_m, 0.02);
  EXPECT_EQ(scene.fixtures[2].opening_deg, 30.0);
}

TEST(Scene, RefusesFixturesByFileFieldValueAndRange) {
  const Json good = Json::parse(kFixtures);
  for (const Spoiled& spoiled :
       {Spoiled{"/fixtures/0/kind", "wall", "fixtures[1].kind", {}},
        Spoiled{"/fixtures/0/depth_m", 0, "fixtures[1].depth_m", {"0", "100"}},
        Spoiled{"/fixtures/1/half_gap_m", -1, "fixtures[2].half_gap_m", {"0", "10"}},
        Spoiled{"/fixtures/1/half_gap_m", nullptr, "fixtures[2].half_gap_m", {}},
        Spoiled{"/fixtures/0/yaw_deg", Json::parse("[5,-5]"), "fixtures[1].yaw_deg", {"5", "-5"}},
        Spoiled{"/fixtures/1/yaw_deg", Json::parse("[-5,5]"), "fixtures[2].yaw_deg", {}},
        Spoiled{"/fixtures/2/radius_m", nullptr, "fixtures[3].radius_m", {}},
        Spoiled{"/fixtures/2/opening_deg", 81, "fixtures[3].opening_deg", {"0", "80"}},
        Spoiled{"/fixtures/2/name", "middle", "fixtures[3].name", {"middle"}},
        Spoiled{"/fixtures/0/frame/quaternion_wxyz",
                Json::parse("[1,1,0,0]"),
                "fixtures[1].frame.quaternion_wxyz",
                {"length"}}}) {
    expect_refused(good, spoiled, [](const std::string& text) { parse_scene(text, "given.json"); });
  }
}

TEST(Scene, MayBeWithoutAnythingButItsBodies) {
  const SceneConfig scene = parse_scene(R"({"format":1,"kind":"scene","name":"own","boxes":[],"spheres":[]})", "s");
  EXPECT_FALSE(scene.slit || scene.rod || scene.camera || scene.contact);
  EXPECT_TRUE(parse_scene(good_table("scene", "none").dump(), "s").camera) << "what liana run needs";
}

constexpr const char* kConvex = R"({"format":1,"kind":"scene","name":"own","boxes":[],"spheres":[],"convex":[
  {"name":"bracket","points_m":[[0,0,0],[1,0,0],[0,1,0],[0,0,1]]},
  {"name":"tank","cylinder":{"from_m":[1,0,0],"to_m":[1,0,2],"radius_m":0.25}},
  {"name":"hose","chain":{"points_m":[[0,0,0],[1,0,0],[1,1,0]],"radius_m":0.02}}]})";

// req:A48
TEST(Scene, NamesWhatItHasAndNothingElse) {
  const SceneConfig bare = parse_scene(R"({"format":1,"kind":"scene","name":"bare"})", "s");
  EXPECT_TRUE(bare.boxes.empty() && bare.spheres.empty() && bare.convex.empty());
  EXPECT_EQ(bare.canonical_json,
            parse_scene(R"({"format":1,"kind":"scene","name":"bare","boxes":[],"spheres":[]})", "s").canonical_json)
      << "who reads it finds the same";
  EXPECT_THROW(parse_scene("[]", "s"), std::runtime_error);
}

TEST(Scene, HasConvexBodiesOfPointsCylindersAndChains) {
  const SceneConfig scene = parse_scene(kConvex, "s");
  ASSERT_EQ(scene.convex.size(), 4u) << "a chain of two pieces is two bodies";
  EXPECT_EQ(scene.convex[0].points_m.size(), 4u);
  EXPECT_EQ(scene.convex[0].half_extent_m, (Vec3{0.5, 0.5, 0.5}));
  const SceneConvex& tank = scene.convex[1];
  EXPECT_EQ(tank.disc_radius_m, 0.25);
  EXPECT_NEAR(tank.half_extent_m[0], 0.25, 1e-15);
  EXPECT_NEAR(tank.half_extent_m[2], 1.0, 1e-15);
  EXPECT_EQ(scene.convex[3].name, "hose");
  EXPECT_EQ(scene.convex[3].round_m, 0.02);
  EXPECT_EQ(scene.convex[3].points_m[1], (Vec3{1, 1, 0}));
}

TEST(Scene, TwoBodiesOfOneNameAreRefusedAndThePiecesOfAChainAreOne) {
  Json table = Json::parse(kConvex);
  EXPECT_NO_THROW(parse_scene(table.dump(), "s"));
  table["spheres"] = {{{"name", "tank"}, {"center_m", {0, 0, 0}}, {"radius_m", 1}}};
  try {
    parse_scene(table.dump(), "s");
    FAIL() << "was taken";
  } catch (const std::runtime_error& error) {
    EXPECT_TRUE(names(error.what(), {"s", "convex[2].name", "tank"}));
  }
}

TEST(Scene, ConvexBodiesAreRefusedWithFieldValueRangeAndAdvice) {
  const Json flat = {{0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {1, 1, 0}};
  const std::vector<Spoiled> cases = {
      {"/convex", 5, "convex", {"list"}},
      {"/convex/0/name", nullptr, "convex[1].name", {"missing"}},
      {"/convex/0/points_m", {{0, 0, 0}, {1, 0, 0}}, "convex[1].points_m", {"4", "256"}},
      {"/convex/0/points_m", flat, "convex[1].points_m", {"plane"}},
      {"/convex/0/points_m/2", {0, 1}, "convex[1].points_m[3]", {"3"}},
      {"/convex/0/points_m", nullptr, "convex[1].name", {"points_m", "cylinder", "chain"}},
      {"/convex/0/chain", {1}, "convex[1].name", {"points_m", "cylinder", "chain"}},
      {"/convex/1/cylinder/to_m", {1, 0, 0}, "convex[2].cylinder.to_m", {"point"}},
      {"/convex/1/cylinder/radius_m", 0, "convex[2].cylinder.radius_m", {"1e-04", "100"}},
      {"/convex/2/chain/points_m", {{0, 0, 0}}, "convex[3].chain.points_m", {"2", "64"}},
      {"/convex/2/chain/length", 1, "convex[3].chain.length", {"field"}},
      {"/convex/2/stl", "a.stl", "convex[3].stl", {"field"}}};
  for (const Spoiled& spoiled : cases) {
    expect_refused(Json::parse(kConvex), spoiled, [](const std::string& text) { parse_scene(text, "given.json"); });
  }
}

TEST(Scene, IsRefusedWithFileFieldValueRangeAndAdvice) {
  const Json good = good_table("scene", "panel_slit");
  const std::vector<Spoiled> cases = {
      {"/format", "1", "format", {"number"}},
      {"/sphere", 1, "sphere", {"field"}},
      {"/spheres", "none", "spheres", {"list"}},
      {"/spheres/0/radius_m", 0.00009, "spheres[1].radius_m", {"1e-04", "100"}},
      {"/spheres/0/center_m", {1, 2}, "spheres[1].center_m", {"3"}},
      {"/spheres/0/name", nullptr, "spheres[1].name", {"missing"}},
      {"/boxes/0/half_extent_m/1", -0.01, "boxes[1].half_extent_m[2]", {"1e-04", "100"}},
      {"/boxes/1/rotation/0", {1, 0, 0.5}, "boxes[2].rotation", {"orthonormal"}},
      {"/boxes/1/rotation", {{1, 0, 0}, {0, 1, 0}, {0, 0, -1}}, "boxes[2].rotation", {"orthonormal"}},
      {"/slit/normal", {0, 1, 0}, "slit.w_axis", {"u", "n"}},
      {"/slit/end_u_m", 1.0, "slit.end_u_m", {"1.75"}},
      {"/slit/half_gap_m", 0, "slit.half_gap_m", {"0"}},
      {"/slit/frame/quaternion_wxyz", {1, 0, 0, 0}, "slit.frame.quaternion_wxyz", {"axes"}},
      {"/slit/frame/position_m/0", 0.0, "slit.frame.position_m", {}},
      {"/rod/quaternion_wxyz", {1, 0, 0, 1}, "rod.quaternion_wxyz", {"length"}},
      {"/camera/rate_hz", 0, "camera.rate_hz", {"1", "1000"}},
      {"/contact/friction", -0.2, "contact.friction", {"0", "2"}},
      {"/margins/shift_m", -0.001, "margins.shift_m", {"0", "0.1"}},
      {"/margins/turn_deg", 11, "margins.turn_deg", {"0", "10"}},
      {"/margins/slow_m", -0.001, "margins", {"slow_m", "refuse_m"}},
      {"/margins/slowly_m", 0.001, "margins.slowly_m", {"field"}},
      {"/camera", 5, "camera", {"fields"}}};
  for (const Spoiled& spoiled : cases) {
    expect_refused(good, spoiled, [](const std::string& text) { parse_scene(text, "given.json"); });
  }
}

// Each body is legal; a client gets all of them in one packet.
TEST(Scene, BodiesThatTogetherFillMoreThanAPacketAreRefusedWithTheBytes) {
  const auto scene_of = [](int bodies, double digits) {
    Json scene{{"format", 1}, {"kind", "scene"}, {"name", "own"}, {"boxes", Json::array()}, {"spheres", Json::array()}};
    scene["convex"] = Json::array();
    for (int body = 0; body < bodies; ++body) {
      Json points = Json::array();
      for (int i = 0; i < 256; ++i) points.push_back({std::cos(i) + digits, std::sin(i) + digits, i / 256.0 + digits});
      scene["convex"].push_back({{"name", "b" + std::to_string(body)}, {"points_m", points}});
    }
    return scene.dump();
  };
  EXPECT_NO_THROW(parse_scene(scene_of(7, 1.0 / 3.0), "own"));
  try {
    parse_scene(scene_of(9, 1.0 / 3.0), "own");
    FAIL() << "9 bodies of 256 points are larger than a packet";
  } catch (const std::runtime_error& error) {
    EXPECT_TRUE(names(error.what(), {"own", "122880"}));
  }
}

}  // namespace
}  // namespace liana::config
