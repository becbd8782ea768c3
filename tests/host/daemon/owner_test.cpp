// One owner of motion at a time.
#include "host/daemon/owner.hpp"

#include <gtest/gtest.h>

#include "host/api/request_error.hpp"

namespace liana::daemon {

namespace {

TEST(Owner, OnlyOneClientOwnsMotion) {
  Owner owner;
  EXPECT_THROW(owner.require(1), api::RequestError) << "nobody owns motion at the start";
  owner.acquire(1, 1, "mission");
  owner.acquire(1, 1, "mission");
  EXPECT_NO_THROW(owner.require(1));
  EXPECT_THROW(owner.acquire(2, 5, "second"), api::RequestError);
  EXPECT_THROW(owner.require(2), api::RequestError);
  EXPECT_THROW(owner.release(2), api::RequestError);
  EXPECT_EQ(owner.name(), "mission");
  owner.release(1);
  EXPECT_NO_THROW(owner.acquire(2, 5, "second"));
}

TEST(Owner, OnlyTheDeathOfTheOwnerMatters) {
  Owner owner;
  owner.acquire(1, 1, "mission");
  EXPECT_FALSE(owner.gone(2));
  EXPECT_TRUE(owner.gone(1));
  EXPECT_FALSE(owner.gone(1));
  EXPECT_EQ(owner.client(), 0u);
}

TEST(Owner, TheRefusalNamesTheOwner) {
  Owner owner;
  owner.acquire(1, 1, "mission");
  try {
    owner.acquire(2, 5, "second");
    FAIL();
  } catch (const api::RequestError& error) {
    EXPECT_EQ(error.code(), "not_owner");
    EXPECT_NE(std::string(error.what()).find("mission"), std::string::npos);
  }
}

}  // namespace
}  // namespace liana::daemon
