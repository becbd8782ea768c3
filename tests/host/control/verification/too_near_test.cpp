// Motions of an arm that stands nearer to the scene than it may: away, along beside it, and no nearer.
#include <gtest/gtest.h>

#include <utility>
#include <vector>

#include "host/control/verification/judge_simulated.hpp"

namespace liana::verification {
namespace {

class AnArmBesideABody : public testing::Test {
 protected:
  AnArmBesideABody() {
    rules_.scene.margins.prediction_m = 0.007;
    rules_.scene.spheres.push_back({"ball", {}, 0.1});
  }

  // How far the next motions move the first node.
  void moves(double travel_m) {
    rules_.table.segment_count = 1;
    rules_.table.segment[0].theta_limit_rad = 1.0;
    travel_m_ = travel_m;
  }

  // Of a motion between these distances, nearest at `least_m`, past bodies beside it.
  Refusal goes(double start_m, double least_m, double end_m, std::vector<simulation::BodyBeside> bodies = {}) {
    simulation::Motion motion;
    if (travel_m_ > 0.0) motion.moments.resize(2);
    if (travel_m_ > 0.0) motion.moments.back().node_in_base_m[0] = {travel_m_, 0.0, 0.0};
    motion.distances.bodies = std::move(bodies);
    motion.solved = true;
    motion.distances.scene = {least_m, 3, 0, 0.1};
    motion.distances.scene_at_start_m = start_m;
    motion.distances.scene_at_end_m = end_m;
    motion.distances.self.distance_m = 1.0;
    simulation::JointSequence told;
    told.rows_rad.resize(1);
    told.interval_s = 0.02;
    return judge_simulated(rules_, told, true, motion, too_near_).code;
  }

  // The same between links of its own, the scene far away.
  Refusal folds(double start_m, double least_m, double end_m) {
    simulation::Motion motion;
    if (travel_m_ > 0.0) motion.moments.resize(2);
    if (travel_m_ > 0.0) motion.moments.back().node_in_base_m[0] = {travel_m_, 0.0, 0.0};
    motion.solved = true;
    motion.distances.scene = {1.0, 3, 0, 0.1};
    motion.distances.scene_at_start_m = motion.distances.scene_at_end_m = 1.0;
    motion.distances.self = {least_m, 3, 30, 0.1};
    motion.distances.self_at_start_m = start_m;
    motion.distances.self_at_end_m = end_m;
    simulation::JointSequence told;
    told.rows_rad.resize(1);
    told.interval_s = 0.02;
    return judge_simulated(rules_, told, true, motion, too_near_).code;
  }

  double travel_m_ = 0.0;  // of the first node
  MotionRules rules_;
  TooNear too_near_;
};

TEST_F(AnArmBesideABody, ThatIsFarEnoughOffIsNotLetNearerThanItMay) {
  EXPECT_EQ(goes(0.0080, 0.0071, 0.0071), Refusal::kNone);
  EXPECT_EQ(goes(0.0071, 0.0069, 0.0069), Refusal::kSceneContact);
}

// The way was free once; with what is known now it may seem to be less so.
TEST_F(AnArmBesideABody, IsRetractedToWhereItIsCertainlyFreeWhateverTheSceneKeepsBeside) {
  rules_.scene.margins.refuse_m = 0.003;
  EXPECT_EQ(goes(0.0120, 0.0101, 0.0101), Refusal::kNone);
  EXPECT_EQ(goes(0.0120, 0.0099, 0.0099), Refusal::kSceneContact);
  too_near_.forget();
  too_near_.retracts = true;
  EXPECT_EQ(goes(0.0120, 0.0071, 0.0071), Refusal::kNone);
  EXPECT_EQ(goes(0.0120, 0.0069, 0.0069), Refusal::kSceneContact);
}

TEST_F(AnArmBesideABody, ThatIsTooNearMayGoAwayAndAlongBesideIt) {
  EXPECT_EQ(goes(0.0050, 0.0049, 0.0060), Refusal::kNone);
  EXPECT_EQ(goes(0.0050, 0.0047, 0.0047), Refusal::kNone) << "measured poses are no better than that";
  EXPECT_EQ(goes(0.0050, 0.0038, 0.0060), Refusal::kSceneContact) << "nearer than the bound may give away";
}

TEST_F(AnArmBesideABody, ComesNoNearerByOneMotionAfterTheOther) {
  EXPECT_EQ(goes(0.0050, 0.0046, 0.0046), Refusal::kNone);
  EXPECT_EQ(goes(0.0046, 0.0041, 0.0041), Refusal::kNone);
  EXPECT_EQ(goes(0.0041, 0.0037, 0.0037), Refusal::kSceneContact) << "1 mm less than it stood off once";
  EXPECT_EQ(goes(0.0060, 0.0051, 0.0051), Refusal::kNone);
  EXPECT_EQ(goes(0.0051, 0.0046, 0.0046), Refusal::kSceneContact) << "it has been farther off meanwhile";
}

TEST_F(AnArmBesideABody, ThatHasCreptNearerAllTheSameOnlyGoesAway) {
  moves(0.010);
  EXPECT_EQ(goes(0.0060, 0.0055, 0.0055), Refusal::kNone);
  EXPECT_EQ(goes(0.0048, 0.0048, 0.0059), Refusal::kNone) << "away by more than the tenth of what it moves";
  EXPECT_EQ(goes(0.0048, 0.0048, 0.0057), Refusal::kSceneContact) << "off by the model's error";
  EXPECT_EQ(goes(0.0055, 0.0051, 0.0051), Refusal::kNone) << "as far off as it has been, but for 1 mm";
}

TEST_F(AnArmBesideABody, RetractsAlongItAgainFromWhereARefusalHasLeftIt) {
  moves(0.010);
  EXPECT_EQ(goes(0.0060, 0.0055, 0.0055), Refusal::kNone);
  EXPECT_EQ(goes(0.0048, 0.0040, 0.0059), Refusal::kSceneContact);
  EXPECT_EQ(goes(0.0045, 0.0044, 0.0044), Refusal::kSceneContact) << "a hand goes away only";
  too_near_.retracts = true;
  EXPECT_EQ(goes(0.0045, 0.0044, 0.0044), Refusal::kNone) << "a way back along the body";
  EXPECT_EQ(goes(0.0044, 0.0042, 0.0042), Refusal::kSceneContact) << "and no nearer by it";
}

TEST_F(AnArmBesideABody, IsNotRetractedNearerByAnyNumberOfRefusals) {
  moves(0.010);
  too_near_.retracts = true;
  double stands_m = 0.0060;
  for (int refused = 0; refused < 1000; ++refused) {
    EXPECT_EQ(goes(stands_m, 0.0, stands_m), Refusal::kSceneContact);
    if (goes(stands_m, stands_m - 0.9 * kCreptDip_m, stands_m) == Refusal::kNone) stands_m -= 0.9 * kCreptDip_m;
  }
  EXPECT_NEAR(stands_m, 0.0060 - kMostCrept_m, kCreptDip_m);
}

// What leads away as simulated may end nearer in truth, and a stop after a refusal come nearer than predicted.
TEST_F(AnArmBesideABody, ThatHasLostThreeMillimetresOnlyRetracts) {
  moves(0.010);
  EXPECT_EQ(goes(0.0060, 0.0055, 0.0055), Refusal::kNone);
  for (const bool was_refused : {false, true}) {
    EXPECT_EQ(goes(0.00301, 0.00301, 0.0060), Refusal::kNone) << was_refused;
    EXPECT_EQ(goes(0.00299, 0.00299, 0.0060), Refusal::kSceneContact) << was_refused;
  }
  too_near_.retracts = true;
  EXPECT_EQ(goes(0.00299, 0.00299, 0.0060), Refusal::kNone);
}

// Stops and enabling in turn would lead it nearer without end.
TEST_F(AnArmBesideABody, GetsNoFurtherMillimetresByBeingDisabled) {
  moves(0.010);
  EXPECT_EQ(goes(0.0060, 0.0055, 0.0055), Refusal::kNone);
  too_near_.disabled();
  EXPECT_EQ(goes(0.0048, 0.0047, 0.0047), Refusal::kSceneContact) << "it stood off 6 mm before";
  EXPECT_EQ(goes(0.0048, 0.0048, 0.0059), Refusal::kNone) << "away";
  too_near_.disabled();
  EXPECT_EQ(goes(0.0025, 0.0025, 0.0060), Refusal::kSceneContact) << "it may be led no more";
  too_near_.retracts = true;
  EXPECT_EQ(goes(0.0025, 0.0024, 0.0024), Refusal::kSceneContact) << "disabled before the last motion, not after it";
  too_near_.disabled();
  EXPECT_EQ(goes(0.0025, 0.0024, 0.0024), Refusal::kNone) << "a way back along the body is there";
  EXPECT_EQ(goes(0.0024, 0.0014, 0.0014), Refusal::kSceneContact);
}

// A stop after a refusal takes more than that.
TEST_F(AnArmBesideABody, ThatStandsNearerThanThreeMillimetresIsLedNoNearer) {
  EXPECT_EQ(goes(0.0031, 0.0022, 0.0022), Refusal::kNone);
  too_near_.forget();
  EXPECT_EQ(goes(0.0029, 0.0028, 0.0028), Refusal::kSceneContact);
  EXPECT_EQ(goes(0.0029, 0.0028, 0.0029), Refusal::kNone);
  too_near_.retracts = true;
  EXPECT_EQ(goes(0.0029, 0.0020, 0.0020), Refusal::kNone);
}

TEST_F(AnArmBesideABody, ThatHasLeftItIsAsOneThatNeverWasThere) {
  EXPECT_EQ(goes(0.0050, 0.0050, 0.0080), Refusal::kNone);
  EXPECT_EQ(goes(0.0080, 0.0069, 0.0069), Refusal::kSceneContact);
  moves(0.010);
  EXPECT_EQ(goes(0.0069, 0.0068, 0.0068), Refusal::kSceneContact) << "it has been 1 mm farther off";
  EXPECT_EQ(goes(0.0100, 0.0100, 0.0100), Refusal::kNone) << "3 mm farther off than it has to be";
  EXPECT_EQ(goes(0.0069, 0.0068, 0.0068), Refusal::kNone);
}

TEST_F(AnArmBesideABody, ThatTouchesOneBodyIsLetOutOfItAndIntoNoOther) {
  rules_.scene.spheres.push_back({"post", {}, 0.1});
  const auto out_of_ball = [&](double post_start_m, double post_least_m) {
    return goes(-0.050, -0.050, -0.030, {{-0.050, {-0.050, 3, 0, 0.1}}, {post_start_m, {post_least_m, 5, 1, 0.4}}});
  };
  EXPECT_EQ(out_of_ball(0.100, 0.0071), Refusal::kNone);
  EXPECT_EQ(out_of_ball(0.100, 0.0059), Refusal::kSceneContact) << "no deeper than in the first, but in another one";
  EXPECT_EQ(out_of_ball(-0.010, -0.0109), Refusal::kNone) << "wedged between both: as far as one can tell no deeper";
  EXPECT_EQ(out_of_ball(-0.010, -0.0111), Refusal::kSceneContact);
}

TEST_F(AnArmBesideABody, ThatOverlapsItselfMayStayAndUnfoldAndFoldsNoFurtherByOneMotionAfterTheOther) {
  EXPECT_EQ(folds(0.0100, -0.0001, 0.0001), Refusal::kSelfContact) << "it stands clear of itself";
  EXPECT_EQ(folds(-0.0200, -0.0201, -0.0201), Refusal::kNone) << "how measured angles tremble";
  EXPECT_EQ(folds(-0.0205, -0.0209, -0.0209), Refusal::kNone);
  EXPECT_EQ(folds(-0.0209, -0.0211, -0.0211), Refusal::kSelfContact) << "1 mm deeper than it stood once";
  EXPECT_EQ(folds(-0.0209, -0.0209, -0.0050), Refusal::kNone);
  EXPECT_EQ(folds(-0.0050, -0.0061, -0.0050), Refusal::kSelfContact) << "on the way";
  EXPECT_EQ(folds(-0.0050, -0.0050, -0.0061), Refusal::kSelfContact) << "it has been less deep meanwhile";
}

TEST_F(AnArmBesideABody, ThatAStopHasFoldedFurtherThanItMayStayGoesApartAndDoesNotCreep) {
  moves(0.010);
  EXPECT_EQ(folds(-0.0010, -0.0010, -0.0010), Refusal::kNone);
  EXPECT_EQ(folds(-0.0045, -0.0050, -0.0036), Refusal::kSelfContact) << "0.9 mm apart of 10 that it moves";
  EXPECT_EQ(folds(-0.0045, -0.0050, -0.0034), Refusal::kNone);
  EXPECT_EQ(folds(-0.0045, -0.0056, -0.0034), Refusal::kSelfContact) << "over 1 mm deeper on the way";
}

}  // namespace
}  // namespace liana::verification
