// One owner of motion at a time, and when another may take it.
#include "host/control/server/owner.hpp"

#include <gtest/gtest.h>

#include <functional>

#include "host/api/server/request_error.hpp"

namespace liana::server {

namespace {

const Claimant kMission{1, 1, "mission", 4711}, kSecond{2, 5, "second", 12};

std::string refusal_of(const std::function<void()>& ask) {
  try {
    ask();
  } catch (const api::RequestError& error) {
    EXPECT_EQ(error.code(), "not_owner");
    return error.what();
  }
  return "";
}

TEST(Owner, OnlyOneClientOwnsMotion) {
  Owner owner;
  EXPECT_THROW(owner.require(1), api::RequestError) << "nobody owns motion at the start";
  EXPECT_THROW(owner.require(0), api::RequestError) << "nor does nobody";
  owner.acquire(kMission);
  owner.acquire(kMission);
  EXPECT_NO_THROW(owner.require(1));
  EXPECT_THROW(owner.acquire(kSecond), api::RequestError);
  EXPECT_THROW(owner.require(2), api::RequestError);
  EXPECT_THROW(owner.release(2), api::RequestError);
  EXPECT_EQ(owner.name(), "mission");
  owner.release(1);
  EXPECT_FALSE(owner.acquire(kSecond)) << "taken from nobody";
}

TEST(Owner, OnlyTheDeathOfTheOwnerMatters) {
  Owner owner;
  owner.acquire(kMission);
  EXPECT_FALSE(owner.gone(2));
  EXPECT_TRUE(owner.gone(1));
  EXPECT_FALSE(owner.gone(1));
  EXPECT_EQ(owner.client(), 0u);
}

TEST(Owner, EveryRefusalNamesTheOwnerAndItsProcess) {
  Owner owner;
  owner.acquire(kMission);
  for (const std::string& text : {refusal_of([&] { owner.acquire(kSecond); }), refusal_of([&] { owner.require(2); }),
                                  refusal_of([&] { owner.release(2); })}) {
    EXPECT_NE(text.find("'mission'"), std::string::npos) << text;
    EXPECT_NE(text.find("process 4711"), std::string::npos) << text;
  }
}

TEST(Owner, MotionIsTakenByNameAfterAStopOrSilenceAndWithoutItAfterBoth) {
  const double silent_s = kMaxSilence_s, heard_s = kMaxSilence_s - 0.1;
  const struct {
    TakeOver how;
    bool taken;
  } table[]{{{true, "", false, silent_s}, false},       {{true, "", true, heard_s}, false},
            {{true, "", true, silent_s}, true},         {{true, "mission", false, heard_s}, false},
            {{true, "mission", false, silent_s}, true}, {{true, "mission", true, 0.0}, true},
            {{true, "another", true, silent_s}, false}, {{false, "mission", true, silent_s}, false},
            {{false, "", true, silent_s}, false}};
  for (const auto& [how, taken] : table) {
    SCOPED_TRACE(testing::Message() << how.is_allowed << " " << how.from << " " << how.stop_in_force << how.silent_s);
    Owner owner;
    owner.acquire(kMission);
    if (!taken) {
      EXPECT_THROW(owner.acquire(kSecond, how), api::RequestError);
      EXPECT_EQ(owner.name(), "mission");
      continue;
    }
    const auto from = owner.acquire(kSecond, how);
    ASSERT_TRUE(from);
    EXPECT_EQ(from->name, "mission");
    EXPECT_EQ(owner.name(), "second");
    EXPECT_THROW(owner.require(1), api::RequestError);
    EXPECT_FALSE(owner.gone(1)) << "its death is no hold any more";
  }
}

}  // namespace
}  // namespace liana::server
