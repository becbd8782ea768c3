// Only the release step makes telecommands, and only with both verdicts.
#include "host/control/verification/issue_step.hpp"

#include <gtest/gtest.h>

#include <type_traits>

namespace liana::verification {

namespace {

static_assert(!std::is_constructible_v<cable::Telecommand, std::uint64_t, std::uint64_t, std::uint64_t, std::uint32_t,
                                       const cable::Setpoint&>,
              "nobody but Release can make a telecommand");
static_assert(!std::is_constructible_v<Candidate<cable::CableArm>, const cable::Telecommand&>,
              "nobody but ReleaseStep can make a candidate");
static_assert(!std::is_constructible_v<Candidate<cable::CableArm>>);
static_assert(!std::is_constructible_v<cable::Telecommand, const Candidate<cable::CableArm>&>);
static_assert(std::is_default_constructible_v<cable::Telecommand>, "an empty one, which commands nothing");

ExecutionVerdict execution(std::uint64_t sequence, Refusal code = Refusal::kNone) {
  ExecutionVerdict verdict;
  verdict.sequence = sequence;
  verdict.code = code;
  return verdict;
}
SimulationVerdict simulation(std::uint64_t sequence, Refusal code = Refusal::kNone) {
  SimulationVerdict verdict;
  verdict.sequence = sequence;
  verdict.code = code;
  return verdict;
}
cable::Setpoint hold() {
  cable::Setpoint setpoint;
  setpoint.kind = CommandKind::kHold;
  return setpoint;
}

// req:A20 req:C6 req:C10
TEST(IssueStep, BothVerdictsReleaseWhatWasJudged) {
  IssueStep<cable::CableArm> release;
  const Candidate<cable::CableArm> candidate = release.candidate(hold(), 7, 100, 5);
  const auto telecommand = release.release(candidate, execution(1), simulation(1));
  ASSERT_TRUE(telecommand);
  EXPECT_EQ(telecommand->sequence(), 1u);
  EXPECT_EQ(telecommand->first_tick(), 100u);
  EXPECT_EQ(telecommand->expiry_tick(), 105u);
  EXPECT_EQ(telecommand->owner(), 7u);
  EXPECT_EQ(telecommand->setpoint().kind, CommandKind::kHold);
}

// req:A20 req:C12
TEST(IssueStep, OneRefusalIsEnough) {
  IssueStep<cable::CableArm> release;
  const Candidate<cable::CableArm> candidate = release.candidate(hold(), 7, 100, 5);
  EXPECT_FALSE(release.release(candidate, execution(1, Refusal::kGate), simulation(1)));
  EXPECT_FALSE(release.release(candidate, execution(1), simulation(1, Refusal::kTipSpeed)));
}

// req:A20 req:C6
TEST(IssueStep, VerdictsOnOtherCandidatesDoNotCount) {
  IssueStep<cable::CableArm> release;
  const Candidate<cable::CableArm> old = release.candidate(hold(), 7, 100, 5);
  const Candidate<cable::CableArm> candidate = release.candidate(hold(), 7, 105, 5);
  EXPECT_FALSE(release.release(candidate, execution(1), simulation(2)));
  EXPECT_FALSE(release.release(candidate, execution(2), simulation(1)));
  EXPECT_FALSE(release.release(old, execution(1), simulation(1))) << "a newer candidate exists";
}

// req:A20 req:C6
TEST(IssueStep, AnotherInItsPlaceHasItsNumberAndNeedsVerdictsOfItsOwn) {
  IssueStep<cable::CableArm> release;
  const Candidate<cable::CableArm> asked = release.candidate(hold(), 7, 100, 5);
  const Candidate<cable::CableArm> other = release.another(cable::Setpoint{}, asked);
  EXPECT_EQ(other.sequence(), asked.sequence());
  EXPECT_FALSE(release.release(other, execution(1), simulation(1))) << "verdicts on what it replaces";
  ExecutionVerdict executed = execution(1);
  SimulationVerdict simulated = simulation(1);
  executed.trial = simulated.trial = 1;
  EXPECT_FALSE(release.release(asked, execution(1), simulation(1))) << "another one is newer";
  const auto telecommand = release.release(other, executed, simulated);
  ASSERT_TRUE(telecommand);
  EXPECT_EQ(telecommand->first_tick(), 100u);
  EXPECT_EQ(telecommand->expiry_tick(), 105u);
  EXPECT_EQ(telecommand->owner(), 7u);
  EXPECT_EQ(telecommand->setpoint().kind, CommandKind::kNone);
  EXPECT_FALSE(release.release(other, executed, simulated)) << "released already";
}

TEST(IssueStep, NothingIsReleasedTwice) {
  IssueStep<cable::CableArm> release;
  const Candidate<cable::CableArm> candidate = release.candidate(hold(), 7, 100, 5);
  EXPECT_TRUE(release.release(candidate, execution(1), simulation(1)));
  EXPECT_FALSE(release.release(candidate, execution(1), simulation(1)));
}

TEST(IssueStep, AnEmptyVerdictIsNoVerdict) {
  IssueStep<cable::CableArm> release;
  const Candidate<cable::CableArm> candidate = release.candidate(hold(), 7, 100, 5);
  EXPECT_FALSE(release.release(candidate, ExecutionVerdict{}, SimulationVerdict{}));
}

}  // namespace
}  // namespace liana::verification
